//! Numbers as people write them.

/// A unit of time, by how many of it are a second.
#[derive(Clone, Copy)]
pub struct Unit {
    /// As it is written.
    pub name: &'static str,
    /// How many are a second.
    pub per_second: f64,
}

const UNITS: [Unit; 4] = [
    Unit { name: "s", per_second: 1.0 },
    Unit { name: "ms", per_second: 1e3 },
    Unit { name: "µs", per_second: 1e6 },
    Unit { name: "ns", per_second: 1e9 },
];

impl Unit {
    /// The largest that `seconds` has at least one of.
    pub fn fit(seconds: f64) -> Self {
        let fits = |unit: &Self| seconds * unit.per_second >= 1.0;
        UNITS.into_iter().find(fits).unwrap_or(UNITS[3])
    }

    /// A time without its unit.
    pub fn of(self, seconds: impl Into<f64>) -> f64 {
        seconds.into() * self.per_second
    }

    /// A time with its unit, to five digits.
    pub fn show(self, seconds: impl Into<f64>) -> String {
        format!("{} {}", short(self.of(seconds), 5), self.name)
    }
}

/// `x` to so many significant digits, without the zeros that say nothing.
pub fn short(x: f64, digits: i32) -> String {
    if x != 0.0 && !(1e-6..1e12).contains(&x.abs()) {
        return format!("{x:.0$e}", digits as usize - 1);
    }
    trimmed(x, decimals(x, digits))
}

/// `x` to so many decimals, without the zeros that say nothing.
pub fn trimmed(x: f64, places: usize) -> String {
    let fixed = format!("{x:.places$}");
    let number = match fixed.contains('.') {
        true => fixed.trim_end_matches('0').trim_end_matches('.'),
        false => &fixed,
    };
    if number == "-0" { "0".into() } else { number.into() }
}

/// How many decimals show `digits` significant digits of `x`.
pub fn decimals(x: f64, digits: i32) -> usize {
    let leading = if x == 0.0 { 0 } else { x.abs().log10().floor() as i32 + 1 };
    (digits - leading).max(0) as usize
}
