//! From fractions of the exposure to the ticks of a timer.

use crate::answer::plan::Plan;
use crate::error::ScheduleError;
use crate::fraction::{Fraction, Side};

/// An interval has at most 2^`TICK_BITS` ticks: half of what a timer of 32 bits counts, so that it tells before from
/// after.
const TICK_BITS: i32 = 31;
/// The most triggers in a frame: so `2i + 1` and `2n` are whole numbers of 24 bits, exact as `f32`.
pub(crate) const MOST_TRIGGERS: u32 = 1 << 22;

/// The ticks of one frame: of the triggers, or the pulses, of one exposure.
#[derive(Clone)]
pub(crate) struct Ticks<'a, const OCTAVES: usize> {
    plan: &'a Plan<OCTAVES>,
    pub(crate) n: u32,
    scale: TickScale,
}

impl<'a, const OCTAVES: usize> Ticks<'a, OCTAVES> {
    pub(crate) const fn new(
        plan: &'a Plan<OCTAVES>,
        n: u32,
        ticks_per_unit: u32,
    ) -> Result<Self, ScheduleError> {
        if ticks_per_unit == 0 {
            return Err(ScheduleError::TickRateZero);
        }
        if n > MOST_TRIGGERS {
            return Err(ScheduleError::TooManyTriggers { most: MOST_TRIGGERS });
        }
        let (start, unit) = (plan.end_in_units(Side::Start), plan.unit());
        let length = (plan.end_in_units(Side::End) - start) as u64;
        if exponent_of_ticks(length, ticks_per_unit, unit) > TICK_BITS {
            return Err(too_high(length, ticks_per_unit, unit));
        }
        Ok(Self { plan, n, scale: TickScale::new(start, length, ticks_per_unit, unit) })
    }

    /// The tick of trigger `i`.
    #[inline(always)]
    pub(crate) const fn at(&self, i: u32) -> u32 {
        self.around(i, 0.0)
    }

    /// The tick of the fraction `(2i + 1 + more) / 2n`, where `more` is ±duty for the ends of a pulse.
    #[inline(always)]
    pub(crate) const fn around(&self, i: u32, more: f32) -> u32 {
        self.scale.tick(self.plan.time_at(self.fraction(i, more)))
    }

    /// Do all triggers keep a gap?
    pub(crate) const fn keeps(&self, min_gap: u32) -> bool {
        let (mut i, mut last) = (1, self.at(0));
        while i < self.n {
            let tick = self.at(i);
            if tick.saturating_sub(last) < min_gap {
                return false;
            }
            (i, last) = (i + 1, tick);
        }
        true
    }

    /// Does trigger `i` need no search?
    pub(crate) const fn is_direct(&self, i: u32) -> bool {
        i < self.n && self.plan.direct(self.fraction(i, 0.0)).is_some()
    }

    #[inline(always)]
    const fn fraction(&self, i: u32, more: f32) -> Fraction {
        Fraction::new(2 * i + 1, more, self.n)
    }
}

/// The least `e` for which a `length`, in units of `2^unit` of the curve's time, is at most 2^e ticks.
const fn exponent_of_ticks(length: u64, ticks_per_unit: u32, unit: i32) -> i32 {
    // Of the 96 bits of length · rate the upper 64, rounded up.
    let (high, low, rate) = (length >> 32, length & 0xFFFF_FFFF, ticks_per_unit as u64);
    let ticks = high * rate + (low * rate).div_ceil(1 << 32);
    96 - ticks.saturating_sub(1).leading_zeros() as i32 + unit
}

/// The error of a rate at which the interval has too many ticks, with the greatest at which it has not.
#[cold]
#[inline(never)]
const fn too_high(length: u64, ticks_per_unit: u32, unit: i32) -> ScheduleError {
    let (mut most, mut fail) = (0, ticks_per_unit);
    while fail - most > 1 {
        let middle = most + (fail - most) / 2;
        let fits = exponent_of_ticks(length, middle, unit) <= TICK_BITS;
        *(if fits { &mut most } else { &mut fail }) = middle;
    }
    ScheduleError::TickRateTooHigh { most }
}

/// From times in the plan's unit to ticks, in fixed point.
#[derive(Clone)]
pub(crate) struct TickScale {
    start: i64,
    /// The bits by which a delay, the time since the start, moves up, so that the interval has 62 or 63 bits.
    up: u32,
    /// The rate, moved up until it has 32 bits.
    rate: u32,
    /// The bits by which `delay · rate / 2³²` moves down to half ticks, where both are moved up.
    down: u32,
}

impl TickScale {
    /// For an interval that starts at `start` and is `length` long, in units of `2^unit`, and has at most 2³¹ ticks.
    pub(crate) const fn new(start: i64, length: u64, ticks_per_unit: u32, unit: i32) -> Self {
        // The length or one of the ends is at least 2⁶¹ units (`time_unit`). If an end is, the next `f32` is at least
        // 2³⁷ units away. So an interval has from 2³⁷ to 2⁶² units.
        let up = length.leading_zeros().wrapping_sub(1) & 31;
        // One bit is not worth a shift: most curves need none.
        let up = if up > 1 { up } else { 0 };
        let zeros = ticks_per_unit.leading_zeros() & 31;
        // Half ticks are delay · rate · 2^(unit + 1), and the product is delay · rate · 2^(up + zeros - 32).
        let down = (up + zeros) as i32 - unit - 33;
        // More than 63 would mean that all of the interval is tick 0, and a shift by 63 gives that, too.
        let down = if down < 63 { down as u32 } else { 63 };
        Self { start, up, rate: ticks_per_unit << zeros, down }
    }

    /// The nearest tick to a time.
    // proofs/ticks.py: tick
    #[inline(always)]
    pub(crate) const fn tick(&self, time: i64) -> u32 {
        let delay = time.wrapping_sub(self.start);
        // A time's last units may be wrong, and place it before the start. But no time is beyond the end: for a
        // polynomial's that would be an error in exposure of all of `1 - u`, and its certificate allows half an ulp of
        // that; the plateau's line is rounded down; `Moment::in_units` stops a search's there.
        let delay = if delay > 0 { delay as u64 } else { 0 };
        // Most curves need no shift. `up` is never 1 (see `new`).
        let delay = if self.up > 1 { delay << (self.up & 31) } else { delay };
        let (high, low) = (delay >> 32, delay & 0xFFFF_FFFF);
        let product = high * self.rate as u64 + ((low * self.rate as u64) >> 32);
        (((product >> (self.down & 63)) + 1) >> 1) as u32
    }
}
