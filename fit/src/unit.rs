//! Units of time, and numbers as people write them.

use serde::{Deserialize, Serialize};

/// A unit of time, by the name that it has in a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Unit {
    /// `s`
    #[serde(rename = "s")]
    #[cfg_attr(feature = "clap", value(name = "s", help = None))]
    Second,
    /// `ms`
    #[serde(rename = "ms")]
    #[cfg_attr(feature = "clap", value(name = "ms", help = None))]
    Millisecond,
    /// `µs`, with the micro sign or the Greek letter, or `us`
    #[serde(rename = "µs", alias = "μs", alias = "us")]
    #[cfg_attr(feature = "clap", value(name = "us", aliases = ["µs", "μs"], help = None))]
    Microsecond,
    /// `ns`
    #[serde(rename = "ns")]
    #[cfg_attr(feature = "clap", value(name = "ns", help = None))]
    Nanosecond,
}

impl Unit {
    /// All, the largest first.
    pub const ALL: [Self; 4] = [Self::Second, Self::Millisecond, Self::Microsecond, Self::Nanosecond];

    /// As it is written.
    pub const fn name(self) -> &'static str {
        ["s", "ms", "µs", "ns"][self as usize]
    }

    /// How many of it are a second.
    pub const fn per_second(self) -> f64 {
        [1.0, 1e3, 1e6, 1e9][self as usize]
    }

    /// The largest that `seconds` has at least one of.
    pub fn fit(seconds: f64) -> Self {
        let fits = |unit: &Self| seconds * unit.per_second() >= 1.0;
        Self::ALL.into_iter().find(fits).unwrap_or(Self::Nanosecond)
    }

    /// A time without its unit.
    pub fn of(self, seconds: impl Into<f64>) -> f64 {
        seconds.into() * self.per_second()
    }

    /// The seconds of a time in this unit; divided, so that 2.5 ms is the number nearest to 0.0025.
    pub fn seconds(self, time: f64) -> f64 {
        time / self.per_second()
    }

    /// A time in seconds and its standard error, as [`plus_minus`] writes them.
    pub fn plus_minus(self, value: f64, error: f64) -> String {
        plus_minus(self.of(value), self.of(error), self.name())
    }

    /// A time with its unit, to five digits.
    pub fn show(self, seconds: impl Into<f64>) -> String {
        format!("{} {}", short(self.of(seconds), 5), self.name())
    }
}

/// So many things by their name: `1 trigger`, `2 triggers`.
pub fn count(n: impl Into<u64>, thing: &str) -> String {
    let n = n.into();
    format!("{n} {thing}{}", if n == 1 { "" } else { "s" })
}

/// `x` to so many significant digits, without the zeros that say nothing.
pub fn short(x: f64, digits: i32) -> String {
    if x != 0.0 && !(1e-6..1e12).contains(&x.abs()) {
        let text = format!("{x:.0$e}", digits as usize - 1);
        let Some((digits, exponent)) = text.split_once('e') else { return text };
        return format!("{}e{exponent}", digits.trim_end_matches('0').trim_end_matches('.'));
    }
    trimmed(x, decimals(x, digits))
}

/// The number that [`short`] writes.
pub fn rounded(x: f64, digits: i32) -> f64 {
    let scale = 10f64.powi(decimals(x, digits) as i32);
    let rounded = (x * scale).round() / scale;
    if rounded.is_finite() { rounded } else { x }
}

/// `x` to so many decimals; a zero has no sign.
pub fn fixed(x: f64, places: usize) -> String {
    let fixed = format!("{x:.places$}");
    match fixed.strip_prefix('-') {
        Some(zero) if zero.bytes().all(|byte| matches!(byte, b'0' | b'.')) => zero.into(),
        _ => fixed,
    }
}

/// The same without the zeros that say nothing.
pub fn trimmed(x: f64, places: usize) -> String {
    let fixed = fixed(x, places);
    match fixed.contains('.') {
        true => fixed.trim_end_matches('0').trim_end_matches('.').into(),
        false => fixed,
    }
}

/// `x`, or 0 where it is what rounding leaves of a sum whose terms are as large as `beside`.
pub fn without_dust(x: f64, beside: f64) -> f64 {
    if x.abs() < 1e-9 * beside.abs() { 0.0 } else { x }
}

/// How many decimals show `digits` significant digits of `x`.
pub fn decimals(x: f64, digits: i32) -> usize {
    let leading = if x == 0.0 { 0.0 } else { x.abs().log10().floor() + 1.0 };
    // No `f64` has more, whatever its least digit.
    ((f64::from(digits) - leading) as usize).min(340)
}

/// So many stops, to the hundredth that a tester tells, and never as -0.
pub fn stops(ev: f64) -> String {
    format!("{:+.2}", (100.0 * ev).round() / 100.0 + 0.0)
}

/// No number with an error has more decimals, however small that is.
pub const MOST_PLACES: usize = 12;

/// A value and its standard error, to the digits that the error leaves.
pub fn plus_minus(value: f64, error: f64, unit: &str) -> String {
    let places = if error > 0.0 && error.is_finite() { decimals(error, 2) } else { decimals(value, 5) };
    let places = places.min(MOST_PLACES);
    format!("{} ± {error:.places$} {unit}", fixed(value, places))
}
