//! The settings above the rows that tell when the samples were taken. A unit belongs to the number on its own line.

use super::names::{Means, setting, unit_of, words};
use super::numbers::{Form, is_grouped, short_of};
use super::told::Refusal;
use crate::unit::Unit;

/// A number with its unit.
enum Value {
    Plain(f64),
    Seconds(f64),
    Hertz(f64),
}

/// The number that a text begins with, and its unit, as in `100 kHz`, `10.0uS` or `Analog:1e-5`; none where something
/// else follows. Several traces may have the same number each.
fn value(text: &str, form: Form) -> Option<Value> {
    let text = text.rsplit(':').next()?.trim();
    let is_part = |c: char| c.is_ascii_digit() || matches!(c, '.' | ',' | '+' | '-' | 'e' | 'E');
    let (digits, behind) = text.split_at(text.find(|c| !is_part(c)).unwrap_or(text.len()));
    let (x, behind) = (form.number(digits)?, behind.trim());
    if behind.split_whitespace().all(|other| other == digits) {
        return Some(Value::Plain(x));
    }
    let (unit, rest) = behind.split_at(behind.find(|c: char| !c.is_alphanumeric()).unwrap_or(behind.len()));
    if rest.starts_with('/') || rest.contains(char::is_numeric) {
        return None;
    }
    Some(match unit.to_ascii_lowercase().as_str() {
        // Of `50.000 Hz` it stays open what the point means.
        "hz" if is_grouped(digits, '.') => return None,
        "hz" => Value::Hertz(x),
        "khz" => Value::Hertz(1e3 * x),
        "mhz" if unit.starts_with('M') => Value::Hertz(1e6 * x),
        "ghz" => Value::Hertz(1e9 * x),
        _ => Value::Seconds(unit_of(unit)?.seconds(x)),
    })
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
                let Some(means) = setting(name) else { continue };
                let beside = format!("{beside} {}", fields[c + 1..].join(" "));
                let below = lines.get(k + 1).and_then(|(_, below)| below.get(c)).map_or("", String::as_str);
                if means == Means::StartBelow || settings.add(means, &said, &beside, form).is_none() {
                    settings.add(means, &short_of(&format!("{field} {below}")), below, form);
                }
            }
            let words = line.to_ascii_lowercase();
            let has = |parts: &[&str]| parts.iter().any(|part| words.contains(part));
            if settings.steps.len() > known || !line.contains(|c: char| c.is_ascii_digit()) {
                continue;
            }
            if has(&["decimation", "downsampl", "subsampl"]) {
                settings.decimation = Some(said);
            } else if has(&["sampl", "rate", "interval", "inc", "delta", "clock", "step"]) {
                settings.unread.get_or_insert(said);
            }
        }
        settings
    }

    /// Adds what a setting tells, if its text is a value.
    fn add(&mut self, means: Means, said: &str, text: &str, form: Form) -> Option<()> {
        let said = said.to_string();
        if let Means::ScaleUnit | Means::TimeUnit = means {
            let words = words(text);
            let unit = unit_of(words.first()?).filter(|_| words.iter().all(|word| *word == words[0]));
            match unit {
                Some(unit) if means == Means::ScaleUnit || unit == Unit::Second => self.unit = Some((said, unit)),
                _ => self.no_time = Some(said),
            }
            return Some(());
        }
        let seconds = match (means, value(text, form)?) {
            (Means::Rate, Value::Hertz(x)) => 1.0 / x,
            (Means::Rate, _) | (_, Value::Hertz(_)) => return None,
            // Without a unit a step of a second or more may be of anything.
            (Means::Step, Value::Plain(x)) if x >= 1.0 => return None,
            (_, Value::Plain(x) | Value::Seconds(x)) => x,
        };
        match means {
            Means::Start | Means::StartBelow if seconds.is_finite() => self.start = Some(seconds),
            // No recorder takes samples less than a femtosecond or more than years apart.
            Means::Step | Means::Rate if (1e-15..1e9).contains(&seconds) => self.steps.push((said, seconds)),
            _ => return None,
        }
        Some(())
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
