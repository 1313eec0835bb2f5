//! All names that instruments give to times, units and rates and that are read, in one table: each with who writes it,
//! and a line of that. What is not here is asked for: the unit, the rate or the columns.

use crate::unit::Unit;

/// What a name means: in the name of a column, or of a setting above the rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Means {
    /// The column holds times.
    Time,
    /// It holds them in this unit.
    In(Unit),
    /// It counts rows.
    Count,
    /// It is a signal's unit, in a row of units.
    Signal,
    /// The setting is the time from one sample to the next, in seconds or with its own unit.
    Step,
    /// The samples in a second, with a unit.
    Rate,
    /// The first sample's time, in seconds or with its own unit.
    Start,
    /// The same, if it stands below the name.
    StartBelow,
    /// The unit of the screen's scale, and of times that have none of their own. Of no other setting.
    ScaleUnit,
    /// The unit of all times. Only seconds are read.
    TimeUnit,
    /// The columns' names follow it.
    Names,
}

/// Name, meaning, who writes it, and a line of that.
type Known = (&'static str, Means, &'static str, &'static str);

use Means::{Count, In, Names, Rate, ScaleUnit, Signal, Start, StartBelow, Step, Time, TimeUnit};

/// Names of columns by their words, of settings without blanks and marks.
#[rustfmt::skip]
pub const KNOWN: &[Known] = &[
    ("time", Time, "Tektronix, LeCroy", "TIME,CH1"),
    ("t", Time, "OpenHantek", "t / s,CH1 / V"),
    ("x", Time, "Rigol DS1000Z", "X,CH1"),
    ("axis", Time, "Keysight", "x-axis,1"),
    ("in", Time, "Rohde & Schwarz RTB", "in s,CH1 in V"),
    ("s", In(Unit::Second), "Saleae", "Time [s],Channel 0"),
    ("sec", In(Unit::Second), "data loggers", "Time (sec),V"),
    ("second", In(Unit::Second), "Rigol, Siglent, Keysight", "Second,Volt"),
    ("seconds", In(Unit::Second), "data loggers, sketches", "time_seconds,V"),
    ("ms", In(Unit::Millisecond), "PicoScope", "(ms),(V)"),
    ("msec", In(Unit::Millisecond), "AcqKnowledge", "msec,CH1"),
    ("millis", In(Unit::Millisecond), "Arduino", "millis,adc"),
    ("us", In(Unit::Microsecond), "PicoScope 6", "(us),(V)"),
    ("µs", In(Unit::Microsecond), "PicoScope 7", "(µs),(mV)"),
    ("micros", In(Unit::Microsecond), "Arduino", "micros,adc"),
    ("ns", In(Unit::Nanosecond), "PicoScope", "(ns),(V)"),
    ("sequence", Count, "Rigol DS1000Z", "Sequence,VOLT"),
    ("v", Signal, "Rohde & Schwarz RTM, Fluke", "s,V"),
    ("volt", Signal, "Rigol, Siglent, Keysight", "second,Volt"),
    ("ampere", Signal, "Keysight", "second,Ampere"),
    ("tracename", Names, "Yokogawa", "\"TraceName\",\"CH1\",\"CH2\""),
    ("sampleinterval", Step, "Tektronix, Siglent", "Sample Interval,1.0e-05"),
    ("samplingperiod", Step, "GW Instek", "Sampling Period,1.0E-05"),
    ("increment", Step, "Rigol DS1000Z", "X,CH1,Start,Increment\nSequence,VOLT,-6.0e-03,1.0e-05"),
    ("hresolution", Step, "Yokogawa", "\"HResolution\",1.0E-05"),
    ("deltax", Step, "LabVIEW", "Delta_X,1.0E-5"),
    ("xincr", Step, "Tektronix, a waveform's preamble", "XZERO,-6.0E-3\nXINCR,1.0E-5"),
    ("samplerate", Rate, "Audacity, sigrok, WaveForms", "Sample Rate: 100000 Hz. Sample values on linear scale."),
    ("start", StartBelow, "Rigol DS1000Z", "X,CH1,Start,Increment\nSequence,VOLT,-6.0e-03,1.0e-05"),
    ("hoffset", Start, "Yokogawa", "\"HResolution\",1.0E-05\n\"HOffset\",-6.0E-03"),
    ("xzero", Start, "Tektronix, a waveform's preamble", "XZERO,-6.0E-3\nXINCR,1.0E-5"),
    ("horizontalunits", ScaleUnit, "Tektronix, Siglent, GW Instek", "Horizontal Units,s\nTIME,CH1"),
    ("hunit", TimeUnit, "Yokogawa", "\"HResolution\",1.0E-05\n\"HUnit\",\"s\""),
    ("xunits", TimeUnit, "Keysight Infiniium", "XUnits:,Second\nSample Interval,1.0e-05"),
];

fn meaning(name: &str) -> Option<Means> {
    KNOWN.iter().find(|(known, ..)| *known == name).map(|(_, means, ..)| *means)
}

/// A text's words in lower case, with one letter for micro.
pub fn words(text: &str) -> Vec<String> {
    let text = text.to_ascii_lowercase().replace(['μ', char::REPLACEMENT_CHARACTER], "µ");
    text.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).map(String::from).collect()
}

/// The unit of time that a word is the name of.
pub fn unit_of(word: &str) -> Option<Unit> {
    match meaning(&words(word).join(" "))? {
        In(unit) => Some(unit),
        _ => None,
    }
}

/// What a setting of this name tells, be it `Units` or `Unit`.
pub fn setting(name: &str) -> Option<Means> {
    let is_one = |means: &Means| matches!(means, Step | Rate | Start | StartBelow | ScaleUnit | TimeUnit | Names);
    let name = words(name).concat();
    meaning(&name).or_else(|| meaning(&(name + "s"))).filter(is_one)
}

/// What stands in the last brackets of a name, and what before.
fn parts(name: &str) -> (&str, Option<&str>) {
    let name = name.trim();
    let inside = name.strip_suffix([')', ']', '}']).and_then(|rest| Some((rest, rest.rfind(['(', '[', '{'])?)));
    match inside.map(|(rest, at)| (&rest[..at], rest[at + 1..].trim())) {
        Some((before, inside)) if inside.contains(|c: char| !c.is_ascii_digit()) => (before, Some(inside)),
        _ => (name, None),
    }
}

/// What the name of a column says, by a unit in brackets, or where each of its words is a time's or a unit: it holds
/// times, perhaps in a unit, or counts. None of something else, or of times in a unit that is not read, as `min`.
pub fn said(name: &str) -> Option<Means> {
    let (name, inside) = parts(name);
    let all = words(name);
    if let Some(unit) = inside {
        // `x10` makes another unit of it.
        let is_factor = |word: &String| word.strip_prefix('x').is_some_and(|x| x.starts_with(char::is_numeric));
        let is_plain = !name.contains(['*', '×', '/']) && !all.iter().any(is_factor);
        return unit_of(unit).filter(|_| is_plain).map(In);
    }
    let mut said = None;
    for word in &all {
        said = match (meaning(word)?, said) {
            (Time, said) => said.or(Some(Time)),
            (In(unit), None | Some(Time)) => Some(In(unit)),
            (Count, None) if all.len() == 1 => Some(Count),
            _ => return None,
        }
    }
    said
}

/// Is it a unit alone, as in a row of units below the names?
pub fn is_unit(field: &str) -> bool {
    let (before, inside) = parts(field);
    let is_known = || matches!(meaning(&words(field).concat()), Some(In(_) | Signal | Count));
    before.is_empty() && inside.is_some() || is_known()
}
