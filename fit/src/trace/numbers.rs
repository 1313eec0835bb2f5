//! Fields, and the numbers, units and rates that stand in them.

use std::iter::once;

use crate::unit::Unit;

/// The fields of a line, without blanks and quotes around them. A quote that is never closed must not swallow the rest of the
/// file: so quotes count only where a line has them in pairs.
pub fn split(line: &str, delimiter: char) -> impl Iterator<Item = &str> {
    let quotes = if delimiter == ',' { line.matches('"').count() } else { 0 };
    let is_quoted = quotes > 0 && quotes.is_multiple_of(2);
    let mut rest = Some(line.trim_end_matches(['\r', '\n']));
    let fields = std::iter::from_fn(move || {
        let line = rest?;
        let from = match line.trim_start().strip_prefix('"').filter(|_| is_quoted) {
            Some(inside) => line.len() - inside.len() + inside.find('"').unwrap_or(0),
            None => 0,
        };
        let end = line[from..].find(delimiter).map(|k| from + k);
        rest = end.map(|k| &line[k + delimiter.len_utf8()..]);
        Some(&line[..end.unwrap_or(line.len())])
    });
    let blank = delimiter == ' ';
    let fields = fields.map(|field| field.trim().trim_matches('"').trim());
    fields.filter(move |field| !(blank && field.is_empty()))
}

/// A number with a decimal point, or a decimal comma where that is said; NaN and infinities are numbers here.
pub fn number(field: &str, comma: bool) -> Option<f64> {
    if comma && field.contains(',') {
        return field.replacen(',', ".", 1).parse().ok();
    }
    field.parse().ok().or_else(|| overload(field))
}

/// The signs by which an instrument says that a signal is too large for it.
fn overload(field: &str) -> Option<f64> {
    let (sign, size) = match field.strip_prefix('-') {
        Some(size) => (-1.0, size),
        None => (1.0, field.strip_prefix('+').unwrap_or(field)),
    };
    let is_sign = ["∞", "1.#inf", "1.#inf00", "ol", "ovl", "overload", "overflow"]
        .contains(&size.to_lowercase().as_str());
    is_sign.then_some(sign * f64::INFINITY)
}

/// Is it a number with a decimal comma?
pub fn is_decimal(field: &str) -> bool {
    field.contains(',') && !field.contains('.') && number(field, true).is_some()
}

/// Is it a number whose commas may part its thousands: `1,234` or `12,345,678.9`?
pub fn is_grouped(field: &str) -> bool {
    let whole = field.trim_start_matches(['-', '+']);
    let whole = whole.split_once('.').map_or(whole, |(whole, _)| whole);
    let mut groups = whole.split(',');
    let digits = |group: &str| group.bytes().all(|b| b.is_ascii_digit());
    let first = groups.next().unwrap_or_default();
    let mut more = groups.peekable();
    (1..=3).contains(&first.len())
        && digits(first)
        && !first.starts_with('0')
        && more.peek().is_some()
        && more.all(|group| group.len() == 3 && digits(group))
}

/// The unit that a column's name holds, as in `Time [ms]`, `time_us`, `TimeMs` or `Second`; none in a sentence with numbers.
pub fn unit_in(name: &str) -> Option<Unit> {
    let name = name.to_lowercase();
    let words = || name.split(|c: char| !(c.is_alphanumeric() || c == char::REPLACEMENT_CHARACTER));
    if words().any(|word| word.parse::<f64>().is_ok()) {
        return None;
    }
    words().rev().find_map(|word| {
        // `TimeMs` and `tms`, but not `ts`, which is a time stamp.
        let short = word.strip_prefix("time").or_else(|| word.strip_prefix('t'));
        unit_of(word).or_else(|| short.filter(|unit| unit.len() > 1).and_then(unit_of))
    })
}

/// The unit that a word is the name of.
fn unit_of(word: &str) -> Option<Unit> {
    Some(match word {
        "s" | "sec" | "second" | "seconds" | "secs" | "sek" | "sekunden" => Unit::Second,
        "ms" | "msec" | "msecs" | "millis" | "millisec" | "millisecond" | "milliseconds" => {
            Unit::Millisecond
        }
        "us" | "µs" | "μs" | "\u{fffd}s" | "usec" | "usecs" | "micros" | "microsec"
        | "microsecond" | "microseconds" => Unit::Microsecond,
        "ns" | "nsec" | "nsecs" | "nanos" | "nanosecond" | "nanoseconds" => Unit::Nanosecond,
        _ => return None,
    })
}

/// The time from one sample to the next that a line above the numbers tells: `Sample rate: 44100 Hz`, `#CLOCK=10.0uS`,
/// `Samplerate: 1 MHz`, `Sample Interval,1e-05`.
pub fn step_in(line: &str) -> Option<f64> {
    let line = line.to_lowercase();
    let is_not = ["bandwidth", "baud", "bit rate", "frame rate", "filter", "trig", "cutoff"];
    if is_not.iter().any(|word| line.contains(word)) {
        return None;
    }
    let period = ["interval", "increment", "period", "clock", "tinc", "xincr"];
    let is_period = period.iter().any(|word| line.contains(word));
    let is_rate = ["rate", "sampl", "freq", "fs"].iter().any(|word| line.contains(word));
    let start = line.find(|c: char| c.is_ascii_digit())?;
    let before = line[..start].trim_matches(|c: char| !c.is_alphanumeric());
    let is_part = |c: char| c.is_ascii_digit() || matches!(c, '.' | '+' | '-' | 'e');
    let end = line[start..].find(|c: char| !is_part(c)).map_or(line.len(), |k| start + k);
    let x: f64 = line[start..end].trim_end_matches('e').parse().ok()?;
    let unit = line[end..].trim_start_matches(|c: char| !c.is_alphanumeric() && c != 'µ');
    let unit = unit.split(|c: char| !(c.is_alphanumeric() || matches!(c, '/' | 'µ' | 'μ'))).next();
    let unit = unit.unwrap_or_default();
    let step = match (hertz(unit), unit_of(unit)) {
        (Some(each), _) if is_rate || is_period || before.is_empty() => 1.0 / (each * x),
        (None, Some(unit)) if is_period => unit.seconds(x),
        (None, None) if is_period && unit.is_empty() => x,
        (None, None) if line.contains("rate") && unit.is_empty() => 1.0 / x,
        _ => return None,
    };
    (step > 0.0 && step.is_finite()).then_some(step)
}

/// How many hertz the unit of a rate is.
fn hertz(unit: &str) -> Option<f64> {
    let (prefix, rest) = match unit.chars().next()? {
        'k' => (1e3, &unit[1..]),
        'm' => (1e6, &unit[1..]),
        'g' => (1e9, &unit[1..]),
        _ => (1.0, unit),
    };
    ["hz", "sa/s", "s/s", "sps", "samples/s"].contains(&rest).then_some(prefix)
}

/// As much of a field as a message can hold.
pub fn short_of(field: &str) -> String {
    let mut chars = field.chars().map(|c| if c.is_control() { '?' } else { c });
    let start: String = chars.by_ref().take(24).collect();
    let more = chars.next().map(|_| '…');
    start.chars().chain(once(more).flatten()).collect()
}
