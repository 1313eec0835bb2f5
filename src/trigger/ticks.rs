//! From fractions of the exposure to the ticks of a timer.
//!
//! 1. Trigger `i` of `n` is due at the fraction `(2i + 1) / 2n`, counted from the curve's nearer end ([`Frame`]).
//! 2. Its time, in units ([`Inverse::time_units`]).
//! 3. The delay since the curve's start, times the rate, in half ticks, rounded down ([`TickScale`]).
//! 4. The nearest tick.

use crate::error::ScheduleError;
use crate::fixed::DOUBLE_WORD;
use crate::fraction::{Fraction, Side};
use crate::inverse::Inverse;
use crate::rate::Hz;

/// An interval has at most 2^`TICK_BITS` ticks: half of what a timer of 32 bits counts, so that the timer tells before
/// from after.
const TICK_BITS: i32 = 31;
/// The most triggers in a frame: so `2i + 1` and `2n` are whole numbers of 24 bits, exact as `f32`.
pub(crate) const MOST_TRIGGERS: u32 = 1 << 22;

/// The ticks of one frame: of the triggers, or the pulses, of one exposure.
#[derive(Clone)]
pub(crate) struct Frame<'a, const OCTAVES: usize> {
    inverse: &'a Inverse<OCTAVES>,
    /// The number of triggers or pulses.
    pub(crate) n: u32,
    scale: TickScale,
}

impl<'a, const OCTAVES: usize> Frame<'a, OCTAVES> {
    pub(crate) const fn new(inverse: &'a Inverse<OCTAVES>, scale: TickScale, n: u32) -> Result<Self, ScheduleError> {
        if n > MOST_TRIGGERS {
            return Err(ScheduleError::TooMany { max: MOST_TRIGGERS });
        }
        Ok(Self { inverse, n, scale })
    }

    /// The tick of trigger `i`.
    #[inline(always)]
    pub(crate) const fn at(&self, i: u32) -> u32 {
        self.tick_at(i, 0.0)
    }

    /// The tick of the fraction `(2i + 1 + by) / 2n`: `by` is 0 for a trigger, and ±duty for the ends of a pulse.
    #[inline(always)]
    pub(crate) const fn tick_at(&self, i: u32, by: f32) -> u32 {
        self.scale.tick(self.inverse.time_units(self.fraction(i, by)))
    }

    /// Does trigger `i` need no search?
    #[cfg(feature = "_measure")]
    pub(crate) const fn is_direct(&self, i: u32) -> bool {
        i < self.n && self.inverse.direct_units(self.fraction(i, 0.0)).is_some()
    }

    /// The fraction `(2i + 1 + by) / 2n`: of a trigger the nearest `f32`, of an end of a pulse within one and a half
    /// ulp (proofs/ticks.py).
    #[inline(always)]
    const fn fraction(&self, i: u32, by: f32) -> Fraction {
        let (odd, whole) = (2 * i + 1, 2 * self.n);
        Fraction::of_parts(odd as f32 + by, (whole - odd) as f32 - by, whole as f32)
    }

    /// Do all triggers keep a gap?
    #[inline(never)]
    pub(crate) const fn check(&self, min_gap: u32) -> Result<(), ScheduleError> {
        self.fill(&mut [], min_gap)
    }

    /// Checks that all triggers keep a gap, and stores their ticks where `ticks` has places for them.
    #[inline(always)]
    pub(crate) const fn fill(&self, ticks: &mut [u32], min_gap: u32) -> Result<(), ScheduleError> {
        let (mut i, mut last) = (0, 0);
        while i < self.n {
            let tick = self.at(i);
            let gap = tick.saturating_sub(last);
            if i > 0 && gap < min_gap {
                return Err(ScheduleError::GapTooSmall { trigger: i, gap, min_gap });
            }
            if (i as usize) < ticks.len() {
                ticks[i as usize] = tick;
            }
            (i, last) = (i + 1, tick);
        }
        Ok(())
    }
}

/// A number of triggers up to which no frame needs a search.
pub(crate) const fn direct_triggers<const OCTAVES: usize>(inverse: &Inverse<OCTAVES>) -> u32 {
    let [first, last] = [inverse.least_direct(Side::Start), inverse.least_direct(Side::End)];
    let least = if first > last { first } else { last };
    // The first and the last trigger are 1 / 2n from the ends, so 1 / 2n > least is enough. With a margin of 2⁻²⁴, more
    // than an `f32` rounds, n = 1 / (2 (least + 2⁻²⁴)), here in 2⁻⁶⁴. As `least` is 2⁻²³ or more, half of the least
    // top, that is at most 2²³ / 3. (The sum saturates: so the compiler sees a divisor that is not 0.)
    ((1 << 63) / ((least as f64 * DOUBLE_WORD) as u64).saturating_add(1 << 40)) as u32
}

/// The least `e` for which the time `length_units · 2^exponent` is at most 2^e ticks.
const fn exponent_of_ticks(length_units: u64, rate: u32, exponent: i32) -> i32 {
    // Of the 96 bits of length_units · rate the upper 64, rounded up.
    let (high, low, rate) = (length_units >> 32, length_units & 0xFFFF_FFFF, rate as u64);
    let product = high * rate + (low * rate).div_ceil(1 << 32);
    96 - product.wrapping_sub(1).leading_zeros() as i32 + exponent
}

/// The error of a rate at which the interval has too many ticks, with the greatest at which it has not, or 0.
#[cold]
#[inline(never)]
const fn too_high(length_units: u64, rate: u32, exponent: i32) -> ScheduleError {
    let (mut max, mut fail) = (0, rate);
    while fail - max > 1 {
        let middle = max + (fail - max) / 2;
        let fits = exponent_of_ticks(length_units, middle, exponent) <= TICK_BITS;
        *(if fits { &mut max } else { &mut fail }) = middle;
    }
    ScheduleError::RateTooHigh { max: Hz(max) }
}

/// From times in units to ticks, in fixed point.
#[derive(Clone, Copy)]
pub(crate) struct TickScale {
    start_units: i64,
    /// The bits by which a delay, the time since the start, moves up, so that the interval has 62 or 63 bits.
    up: u32,
    /// The rate, moved up until it has 32 bits.
    rate: u32,
    /// The product `delay · rate / 2³²`, of both moved up, is shifted down by this, and is then in half ticks.
    down: u32,
}

impl TickScale {
    pub(crate) const fn new<const OCTAVES: usize>(
        inverse: &Inverse<OCTAVES>,
        Hz(rate): Hz,
    ) -> Result<Self, ScheduleError> {
        if rate == 0 {
            return Err(ScheduleError::RateZero);
        }
        let curve = &inverse.curve;
        let [start_units, end_units] =
            [curve.in_units(curve.end_time(Side::Start)), curve.in_units(curve.end_time(Side::End))];
        let (length_units, exponent) = ((end_units - start_units) as u64, curve.units.exponent());
        if exponent_of_ticks(length_units, rate, exponent) > TICK_BITS {
            return Err(too_high(length_units, rate, exponent));
        }
        // An interval has 2⁴⁵ units at least (`domain::LEAST_INTERVAL`), and 2⁶² at most.
        let up = length_units.leading_zeros().wrapping_sub(1) & 31;
        // One bit is not worth a 64-bit shift, which takes several instructions: most curves need none.
        let up = if up > 1 { up } else { 0 };
        let zeros = rate.leading_zeros() & 31;
        // Half ticks are delay · rate · 2^(exponent + 1), and the product is delay · rate · 2^(up + zeros - 32). For
        // the whole interval it is 2⁶⁰ or more, and half ticks are 2³² or fewer: so it moves down by 28 or more.
        let down = (up + zeros) as i32 - exponent - 33;
        // More than 63 would mean that all of the interval is tick 0, and a shift by 63 gives that, too.
        let down = if down < 63 { down as u32 } else { 63 };
        Ok(Self { start_units, up, rate: rate << zeros, down })
    }

    /// The tick at which the curve ends.
    pub(crate) const fn length<const OCTAVES: usize>(&self, inverse: &Inverse<OCTAVES>) -> u32 {
        self.tick(inverse.curve.in_units(inverse.curve.end_time(Side::End)))
    }

    /// The nearest tick to a time.
    // proofs/ticks.py: tick
    #[inline(always)]
    pub(crate) const fn tick(&self, time_units: i64) -> u32 {
        // No time is outside the interval, so nothing wraps (proofs/ticks.py).
        let delay = time_units.wrapping_sub(self.start_units) as u64;
        let delay = if self.up > 1 { delay << (self.up & 31) } else { delay };
        let (high, low) = (delay >> 32, delay & 0xFFFF_FFFF);
        let product = high * self.rate as u64 + ((low * self.rate as u64) >> 32);
        (((product >> (self.down & 63)) + 1) >> 1) as u32
    }
}
