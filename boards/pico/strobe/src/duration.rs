//! Durations as people write them, in ticks of 8 ns.

use core::fmt;

use crate::limits::TICK_HZ;

/// Which tick a duration between two of them is.
#[derive(Clone, Copy, PartialEq)]
pub enum Rounding {
    /// The later one, for what has to last at least so long.
    Up,
    /// The one that is nearer.
    Nearest,
}

/// The ticks of a duration such as `100us` or `4.247ms`; none where it is not one, has 2³² ticks or more, or more digits than
/// can be counted exactly.
pub fn parse(text: &str, rounding: Rounding) -> Option<u32> {
    let end = text.find(|c: char| !c.is_ascii_digit() && c != '.')?;
    let (number, unit) = text.split_at(end);
    let nanoseconds: u64 = match unit {
        "ns" => 1,
        "us" => 1_000,
        "ms" => 1_000_000,
        "s" => 1_000_000_000,
        _ => return None,
    };
    let (whole, fraction) = match number.split_once('.') {
        // A point has digits on either side.
        Some((whole, fraction)) if fraction.is_empty() || whole.is_empty() => return None,
        Some(parts) => parts,
        None => (number, "0"),
    };
    let scale = 10u64.checked_pow(u32::try_from(fraction.len()).ok()?)?;
    let number =
        whole.parse::<u64>().ok()?.checked_mul(scale)?.checked_add(fraction.parse().ok()?)?;
    let (over, under) = (number.checked_mul(nanoseconds)?, scale.checked_mul(NANOSECONDS)?);
    let ticks = match rounding {
        Rounding::Up => over.div_ceil(under),
        Rounding::Nearest => over.checked_add(under / 2)? / under,
    };
    u32::try_from(ticks).ok()
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
