//! Quantities as people write them in arguments: `1.5ms`, `84MHz`, `1/250`.

use clap::ValueEnum;
use shutter_fit::unit::Unit;

/// A finite number, and the unit behind it.
fn split(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    // The `e` of an exponent belongs to the number.
    let is_unit = |c: char| c.is_alphabetic() && !matches!(c, 'e' | 'E');
    let (number, unit) = text.split_at(text.find(is_unit).unwrap_or(text.len()));
    let number = number.trim().replace('_', "").parse().ok().filter(|x: &f64| x.is_finite())?;
    Some((number, unit))
}

/// The unit of this name.
pub fn unit(name: &str) -> Option<Unit> {
    Unit::from_str(name, false).ok()
}

fn seconds(text: &str) -> Option<f64> {
    match split(text)? {
        (0.0, "") => Some(0.0),
        (number, name) => Some(unit(name)?.seconds(number)),
    }
}

/// A time in seconds, written with its unit; 0 needs none.
pub fn time(text: &str) -> Result<f64, String> {
    seconds(text).ok_or_else(|| "write a time as in 0, 1.5ms, -20us, 2e-5s".into())
}

/// What a speed is called: a part of a second, or a time.
pub fn speed(text: &str) -> Result<f64, String> {
    let seconds = match text.trim().strip_prefix("1/") {
        Some(part) => split(part).filter(|(_, unit)| matches!(*unit, "" | "s")).map(|it| 1.0 / it.0),
        None => seconds(text),
    };
    let is_speed = |seconds: &f64| *seconds > 0.0 && seconds.is_finite();
    seconds.filter(is_speed).ok_or_else(|| "write a speed as in 1/250, 4ms, 2s".into())
}

/// A rate above 0 in hertz, which need not be named.
pub fn rate(text: &str) -> Result<f64, String> {
    let hertz = split(text).and_then(|(number, unit)| match unit.to_ascii_lowercase().as_str() {
        "" | "hz" => Some(number),
        "khz" => Some(1e3 * number),
        "mhz" => Some(1e6 * number),
        "ghz" => Some(1e9 * number),
        _ => None,
    });
    let is_rate = |hertz: &f64| *hertz > 0.0;
    hertz.filter(is_rate).ok_or_else(|| "write a rate above 0 as in 48000, 32.768kHz, 84MHz".into())
}

/// A timer's rate.
pub fn whole_rate(text: &str) -> Result<u32, String> {
    let hertz = rate(text)?;
    // A decimal fraction of a kHz may be off by its rounding.
    let whole = hertz.round();
    if (hertz - whole).abs() < 1e-6 && (1.0..=u32::MAX.into()).contains(&whole) {
        return Ok(whole as u32);
    }
    Err(format!("a whole number of Hz up to {} is required", u32::MAX))
}
