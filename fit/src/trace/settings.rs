//! The settings above the rows that tell when the samples were taken: a closed list of names, each with a number and
//! its unit.

use super::names::{has, unit_of, words};
use super::numbers::{is_grouped, number, short_of};
use super::told::Refusal;
use crate::unit::Unit;

/// What a setting gives.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// Samples in a second.
    Rate,
    /// The time from one sample to the next.
    Step,
    /// The same, if it has a unit of time: else it is another thing's.
    Clock,
    /// The first sample's time.
    Start,
    /// The same, by a name that may also count samples.
    Begin,
    /// So many samples come before time 0.
    Trigger,
    /// Where time 0 is, counted from nobody says where.
    Zero,
    /// The times' unit, and that of a step that has none.
    Unit,
    /// So many samples become one.
    Decimation,
}

/// The names without blanks and marks. What is not here, such as a `Max. sampling rate`, is another number.
const NAMES: [(Kind, &str); 9] = [
    (
        Kind::Rate,
        "samplerate samplesrate samplingrate samplefrequency samplingfrequency samplefreq samplingfreq sampleclock \
                  samplespersecond scanrate acquisitionrate abtastrate abtastfrequenz fs",
    ),
    (
        Kind::Step,
        "sampleinterval samplinginterval sampleperiod samplingperiod sampletime samplingtime samplespacing timestep \
                  abtastintervall timeinterval timeincrement increment wfincrement tinc xinc xincr xincrement \
                  hresolution deltax deltat dt",
    ),
    (Kind::Clock, "clock interval"),
    (Kind::Start, "t0 x0 hoffset xzero xorg xorigin xstart starttime wfstartoffset"),
    (Kind::Begin, "start"),
    (Kind::Trigger, "triggerpoint triggerposition triggeraddress triggersample triggerindex zeroindex"),
    (Kind::Zero, "triggeroffset triggertime triggerdelay horizontaldelay pretrigger"),
    (Kind::Unit, "horizontalunits horizontalunit hunit xunits xunit timeunit timeunits zeiteinheit"),
    (Kind::Decimation, "decimation decimationfactor decimationrate decimationratio downsampling subsampling"),
];

/// A unit of time or of a rate.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Measure {
    Time(Unit),
    /// So many hertz.
    Hertz(f64),
}

impl Measure {
    fn parse(word: &str) -> Option<Self> {
        let word = word.to_lowercase();
        let (prefix, rest) = match word.chars().next()? {
            'k' => (1e3, &word[1..]),
            'm' => (1e6, &word[1..]),
            'g' => (1e9, &word[1..]),
            _ => (1.0, word.as_str()),
        };
        let is_rate = ["hz", "sa/s", "s/s", "sps", "samples/s", "samples/second"].contains(&rest);
        if is_rate { Some(Self::Hertz(prefix)) } else { unit_of(&word).map(Self::Time) }
    }
}

/// The kind of a setting's name, and the unit that it holds: in brackets, or as its last word.
fn named(name: &str) -> Option<(Kind, Option<Measure>)> {
    let (name, mut unit) = match name.split_once(['(', '[']) {
        Some((name, inside)) => {
            let inside = inside.trim_end().trim_end_matches([')', ']', ':']).trim();
            (name, Some(Measure::parse(inside)?))
        }
        None => (name, None),
    };
    let mut words = words(name);
    if let (None, [_, .., last]) = (unit, words.as_slice()) {
        unit = Measure::parse(last);
        words.truncate(words.len() - usize::from(unit.is_some()));
    }
    if words.len() > 1 && words.last().is_some_and(|word| word == "in") {
        words.pop();
    }
    let name = words.concat();
    NAMES.iter().find(|(_, names)| has(names, &name)).map(|(kind, _)| (*kind, unit))
}

/// Is it the name of a setting?
pub fn is_setting(name: &str) -> bool {
    named(name).is_some()
}

/// A number and the unit behind it, as in `100 kHz`, `10.0uS` or `Analog:1e-5`; none where what stands behind it is no
/// unit.
fn value(text: &str, comma: bool) -> Option<(f64, Option<Measure>)> {
    let text = text.rsplit(':').next()?.trim();
    let is_part = |c: char| c.is_ascii_digit() || matches!(c, '.' | ',' | '+' | '-' | '\u{2212}' | 'e' | 'E');
    let end = text.find(|c| !is_part(c)).unwrap_or(text.len());
    let digits = text[..end].trim_end_matches(['e', 'E']);
    let x = number(digits, comma)?;
    let is_unit = |c: &char| c.is_alphanumeric() || matches!(c, '/' | 'µ' | 'μ' | '\u{fffd}');
    let behind = text[end..].trim_start();
    let unit: String = behind.chars().take_while(is_unit).collect();
    if let Some(each) = unit.to_lowercase().strip_suffix("/sample").and_then(unit_of) {
        return Some((1.0 / each.seconds(x), Some(Measure::Hertz(1.0))));
    }
    // Another rate behind the first leaves open which one is meant.
    let others = behind[unit.len()..].split([' ', '(', ')', ',', ';']);
    let mut others = others.filter_map(Measure::parse);
    // Of `50.000 Hz` it stays open what the point means.
    let unit = Measure::parse(&unit);
    let is_bare = matches!(unit, None | Some(Measure::Hertz(1.0)));
    match unit {
        None if end < text.len() => None,
        _ if is_bare && digits.contains('.') && is_grouped(&digits.replace('.', ",")) => None,
        _ if others.any(|other| matches!(other, Measure::Hertz(_))) => None,
        unit => Some((x, unit)),
    }
}

/// What the settings above the rows say of the times.
#[derive(Debug, Default)]
pub struct Settings {
    /// The times from one sample to the next, each with the words that give it; in seconds, or without a unit.
    steps: Vec<(String, f64, bool)>,
    /// What says where time 0 is, the likeliest first: with its kind, and has it a unit?
    zeros: Vec<(Kind, f64, bool)>,
    /// The times' unit, and the words that give it.
    pub unit: Option<(String, Unit)>,
    decimation: Option<String>,
    /// Words that may give a rate, but fit no rule.
    pub unread: Option<String>,
}

impl Settings {
    /// From lines, each with its fields; what stands in the next line below a name may be its value.
    pub fn new(lines: &[(&str, Vec<String>)], comma: bool) -> Self {
        let mut settings = Self::default();
        let is_digit = |c: char| c.is_ascii_digit();
        for (k, (line, fields)) in lines.iter().enumerate() {
            let below = lines.get(k + 1).map_or(&[][..], |(_, fields)| fields);
            let known = settings.steps.len();
            let is_alone = fields.iter().filter(|field| !field.is_empty()).count() == 1;
            let several = line.matches('=').count() > 1;
            for (c, field) in fields.iter().enumerate() {
                let at = |k: usize| fields.get(k).map_or("", String::as_str);
                let unit = Some(at(c + 2)).filter(|unit| Measure::parse(unit).is_some());
                let beside = format!("{} {}", at(c + 1), unit.unwrap_or_default());
                let below = below.get(c).map_or("", String::as_str);
                let digit = field.find(is_digit).unwrap_or(field.len());
                let mark = field.find(['=', ':']).filter(|k| !field[k + 1..].trim().is_empty());
                // Of `100,000 Hz` it stays open what the comma means.
                let goes_on = at(c + 1).starts_with(is_digit);
                let words = if several { field } else { *line };
                let mut add = |words: &str, name, text| settings.add(words, name, text, comma);
                let _ = match mark {
                    Some(at) => !goes_on && add(words, &field[..at], &field[at + 1..]),
                    None => {
                        add(line, field, &beside)
                            || add(&format!("{field} {below}"), field, below)
                            || !goes_on && (is_alone || digit > 0) && add(line, &field[..digit], &field[digit..])
                    }
                };
            }
            let words = line.to_lowercase();
            let is_near = ["sampl", "rate", "interval", "increment", "delta"].iter().any(|it| words.contains(it));
            if is_near && settings.steps.len() == known && line.contains(is_digit) {
                settings.unread.get_or_insert(short_of(line.trim()));
            }
        }
        // Without a unit a step of a second or more may be of anything.
        if settings.unit.is_none() && matches!(settings.steps[..], [(_, 1.0.., false)]) {
            settings.unread = settings.steps.pop().map(|(words, ..)| words);
        }
        settings
    }

    /// Is it a setting of the list, with a value?
    fn add(&mut self, words: &str, name: &str, text: &str, comma: bool) -> bool {
        let words = || short_of(&words.replace('"', "").split_whitespace().collect::<Vec<_>>().join(" "));
        let kind = named(name);
        if let Some((Kind::Unit, None)) = kind {
            let unit = unit_of(&text.trim().trim_matches('"').to_lowercase());
            self.unit = self.unit.take().or(unit.map(|unit| (words(), unit)));
            return unit.is_some();
        }
        let Some((x, behind)) = value(text, comma) else { return false };
        // A rate may stand alone.
        let lone = name.is_empty() && matches!(behind, Some(Measure::Hertz(_)));
        let Some((kind, before)) = kind.or(lone.then_some((Kind::Rate, None))) else {
            return false;
        };
        if before.is_some() && behind.is_some() && before != behind {
            return false;
        }
        let unit = before.or(behind);
        let x = match (kind, unit) {
            // Less than one a second may be a step by a wrong name.
            (Kind::Rate, None) if x < 1.0 => return false,
            (Kind::Rate, None) => 1.0 / x,
            (Kind::Rate, Some(Measure::Hertz(each))) => 1.0 / (each * x),
            (Kind::Rate | Kind::Trigger, Some(_)) | (Kind::Clock, None) | (_, Some(Measure::Hertz(_))) => return false,
            (_, Some(Measure::Time(unit))) => unit.seconds(x),
            (_, None) => x,
        };
        let is_sure = unit.is_some() || kind == Kind::Rate;
        match kind {
            // No recorder takes samples less than a femtosecond or more than years apart.
            Kind::Rate | Kind::Step | Kind::Clock if (1e-15..1e9).contains(&x) => {
                self.steps.push((words(), x, is_sure))
            }
            Kind::Start | Kind::Begin | Kind::Trigger | Kind::Zero if x.is_finite() => {
                self.zeros.push((kind, x, is_sure))
            }
            Kind::Decimation if x != 1.0 => self.decimation = Some(words()),
            _ => (),
        }
        true
    }

    /// The first sample's time, where the samples come so many seconds apart; none where nothing tells it.
    pub fn start(&self, step: f64) -> Option<f64> {
        let of = |kind: Kind| self.zeros.iter().find(|zero| zero.0 == kind);
        match [Kind::Start, Kind::Trigger, Kind::Zero, Kind::Begin].into_iter().find_map(of)? {
            (Kind::Zero, ..) => None,
            (Kind::Trigger, samples, _) => Some(-samples * step),
            (_, time, is_sure) => Some(self.seconds(*time, *is_sure)),
        }
    }

    /// In the unit of the times, where it has none of its own.
    fn seconds(&self, time: f64, is_sure: bool) -> f64 {
        let unit = self.unit.as_ref().filter(|_| !is_sure);
        unit.map_or(time, |(_, unit)| unit.seconds(time))
    }

    /// The seconds from one sample to the next, and the words that give it.
    ///
    /// # Errors
    /// Two that differ.
    pub fn step(&self) -> Result<Option<(String, f64)>, Refusal> {
        let mut steps = self.steps.iter().map(|(words, step, is_sure)| (words, self.seconds(*step, *is_sure)));
        let Some((first, step)) = steps.next() else { return Ok(None) };
        let other = steps.find(|(_, other)| (other / step - 1.0).abs() > 1e-3).map(|(words, _)| words);
        match other.or(self.decimation.as_ref()) {
            Some(second) => Err(Refusal::TwoRates { first: first.clone(), second: second.clone() }),
            None => Ok(Some((first.clone(), step))),
        }
    }
}
