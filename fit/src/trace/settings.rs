//! The settings above the rows that tell when the samples were taken. A unit belongs to the number on its own line.

use super::names::{Means, setting, unit_of, words};
use super::numbers::{Form, is_grouped, short_of};
use super::told::Refusal;
use crate::unit::Unit;

/// A unit of time or of a rate.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Measure {
    Time(Unit),
    /// So many hertz.
    Hertz(f64),
}

impl Measure {
    fn parse(word: &str) -> Option<Self> {
        let hertz = word.strip_suffix(['z', 'Z']).and_then(|word| word.strip_suffix(['h', 'H']));
        match hertz {
            Some("") => Some(Self::Hertz(1.0)),
            Some("k" | "K") => Some(Self::Hertz(1e3)),
            Some("M") => Some(Self::Hertz(1e6)),
            Some("G") => Some(Self::Hertz(1e9)),
            _ => unit_of(word).map(Self::Time),
        }
    }
}

/// The number that a text begins with, and its unit, as in `100 kHz`, `10.0uS` or `Analog:1e-5`; none where something
/// else follows. Several traces may have the same number each.
fn value(text: &str, form: Form) -> Option<(f64, Option<Measure>)> {
    let text = text.rsplit(':').next()?.trim();
    let is_part = |c: char| c.is_ascii_digit() || matches!(c, '.' | ',' | '+' | '-' | 'e' | 'E');
    let end = text.find(|c| !is_part(c)).unwrap_or(text.len());
    let (digits, behind) = (&text[..end], text[end..].trim());
    let x = form.number(digits)?;
    if behind.split_whitespace().all(|other| other == digits) {
        return Some((x, None));
    }
    let (unit, rest) = behind.split_at(behind.find(|c: char| !c.is_alphanumeric()).unwrap_or(behind.len()));
    let unit = Measure::parse(unit).filter(|_| !rest.starts_with('/') && !rest.contains(char::is_numeric))?;
    // Of `50.000 Hz` it stays open what the point means.
    let is_open = unit == Measure::Hertz(1.0) && is_grouped(digits, '.');
    (!is_open).then_some((x, Some(unit)))
}

/// What the settings above the rows say of the times.
#[derive(Debug, Default)]
pub struct Settings {
    /// The seconds from one sample to the next, each with the words that give it.
    steps: Vec<(String, f64)>,
    /// The first sample's time, in seconds.
    pub start: Option<f64>,
    /// The scale's unit, and the words that give it.
    pub unit: Option<(String, Unit)>,
    /// The words that say that times are none, or in a unit that is not read.
    pub no_time: Option<String>,
    /// Those that say that so many samples became one.
    decimation: Option<String>,
    /// Those that may give a rate, but fit no rule.
    pub unread: Option<String>,
}

impl Settings {
    /// From lines, each with its fields; what stands in the next line below a name may be its value.
    pub fn new(lines: &[(&str, Vec<String>)], form: Form) -> Self {
        let mut settings = Self::default();
        for (k, (line, fields)) in lines.iter().enumerate() {
            let known = settings.steps.len();
            let said = short_of(&line.replace('"', "").split_whitespace().collect::<Vec<_>>().join(" "));
            for (c, field) in fields.iter().enumerate() {
                let (name, beside) = field.split_once([':', '=']).unwrap_or((field, ""));
                let beside = format!("{beside} {}", fields[c + 1..].join(" "));
                let below = lines.get(k + 1).and_then(|(_, below)| below.get(c)).map_or("", String::as_str);
                if let Some(means) = setting(name) {
                    let is_beside = means != Means::StartBelow && settings.add(means, &said, &beside, form);
                    let _ = is_beside || settings.add(means, &short_of(&format!("{field} {below}")), below, form);
                }
            }
            let words = line.to_lowercase();
            let has = |parts: &[&str]| parts.iter().any(|part| words.contains(part));
            let is_number = line.contains(|c: char| c.is_ascii_digit());
            if is_number && settings.steps.len() == known {
                if has(&["decimation", "downsampl", "subsampl"]) {
                    settings.decimation = Some(said);
                } else if has(&["sampl", "rate", "interval", "inc", "delta", "clock", "step"]) {
                    settings.unread.get_or_insert(said);
                }
            }
        }
        settings
    }

    /// Adds what a setting tells, if its text is a value.
    fn add(&mut self, means: Means, said: &str, text: &str, form: Form) -> bool {
        let said = || said.to_string();
        if let Means::ScaleUnit | Means::TimeUnit = means {
            let words = words(text);
            let Some(first) = words.first() else { return false };
            match unit_of(first).filter(|_| words.iter().all(|word| word == first)) {
                Some(unit) if means == Means::ScaleUnit || unit == Unit::Second => self.unit = Some((said(), unit)),
                _ => self.no_time = Some(said()),
            }
            return true;
        }
        let Some((x, unit)) = value(text, form) else { return false };
        let seconds = match (means, unit) {
            (Means::Rate, Some(Measure::Hertz(each))) => 1.0 / (each * x),
            (Means::Rate, _) | (_, Some(Measure::Hertz(_))) => return false,
            (_, Some(Measure::Time(unit))) => unit.seconds(x),
            // Without a unit a step of a second or more may be of anything.
            (Means::Step, None) if x >= 1.0 => return false,
            (_, None) => x,
        };
        match means {
            Means::Start | Means::StartBelow if seconds.is_finite() => self.start = Some(seconds),
            // No recorder takes samples less than a femtosecond or more than years apart.
            Means::Step | Means::Rate if (1e-15..1e9).contains(&seconds) => self.steps.push((said(), seconds)),
            _ => return false,
        }
        true
    }

    /// The seconds from one sample to the next, and the words that give it.
    ///
    /// # Errors
    /// Two that differ.
    pub fn step(&self) -> Result<Option<(String, f64)>, Refusal> {
        let Some((first, step)) = self.steps.first() else { return Ok(None) };
        let other = self.steps.iter().find(|(_, other)| (other / step - 1.0).abs() > 1e-3).map(|(words, _)| words);
        match other.or(self.decimation.as_ref()) {
            Some(second) => Err(Refusal::TwoRates { first: first.clone(), second: second.clone() }),
            None => Ok(Some((first.clone(), *step))),
        }
    }
}
