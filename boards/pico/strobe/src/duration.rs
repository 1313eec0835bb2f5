//! Durations as people write them, in ticks of 8 ns.

use core::fmt;

use crate::limits::TICK_HZ;

/// The ticks of a duration such as `100us`, rounded up; none where it is not one, or has 2³² ticks or more.
pub fn parse(text: &str) -> Option<u32> {
    let digits = text.find(|c: char| !c.is_ascii_digit())?;
    let (number, unit) = text.split_at(digits);
    let nanoseconds = match unit {
        "ns" => 1,
        "us" => 1_000,
        "ms" => 1_000_000,
        "s" => 1_000_000_000,
        _ => return None,
    };
    let nanoseconds = number.parse::<u64>().ok()?.checked_mul(nanoseconds)?;
    u32::try_from(nanoseconds.div_ceil(NANOSECONDS)).ok()
}

const NANOSECONDS: u64 = 1_000_000_000 / TICK_HZ as u64;

/// Prints ticks as [`parse`] reads them, in the largest unit that leaves no fraction.
pub struct Duration(pub u32);

impl fmt::Display for Duration {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (mut number, mut unit) = (u64::from(self.0) * NANOSECONDS, "ns");
        for larger in ["us", "ms", "s"] {
            if number == 0 || number % 1_000 != 0 {
                break;
            }
            (number, unit) = (number / 1_000, larger);
        }
        write!(out, "{number}{unit}")
    }
}
