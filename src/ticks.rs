//! From fractions of the exposure to the ticks of a timer.

use crate::error::ScheduleError;
use crate::fraction::Fraction;
use crate::octave::NO_TIME;
use crate::plan::Plan;

/// An interval has at most 2^`MOST_TICKS` ticks: half of what a timer of 32 bits counts, so that it tells before from
/// after.
const MOST_TICKS: i32 = 31;
/// The most triggers in a frame: twice as many is a whole number of 24 bits, and so is each `2i + 1`.
pub(crate) const MOST_TRIGGERS: u32 = 1 << 22;

/// What places the triggers of one frame.
#[derive(Clone)]
pub(crate) struct Ticks<'a, const CELLS: usize> {
    pub(crate) plan: &'a Plan<CELLS>,
    pub(crate) n: u32,
    scale: TickScale,
}

impl<'a, const CELLS: usize> Ticks<'a, CELLS> {
    pub(crate) fn new(plan: &'a Plan<CELLS>, n: u32, tick_hz: u32) -> Result<Self, ScheduleError> {
        if tick_hz == 0 {
            return Err(ScheduleError::TickRateZero);
        }
        if n > MOST_TRIGGERS {
            return Err(ScheduleError::TooManyTriggers { most: MOST_TRIGGERS });
        }
        let start = plan.outer_in_units(0);
        let length = (plan.outer_in_units(1) - start) as u64;
        if exponent_of_ticks(length, tick_hz, plan.unit()) > MOST_TICKS {
            return Err(too_high(length, tick_hz, plan.unit()));
        }
        Ok(Self { plan, n, scale: TickScale::new(start, length, tick_hz, plan.unit()) })
    }

    /// The tick of trigger `i`.
    #[inline(always)]
    pub(crate) fn at(&self, i: u32) -> u32 {
        self.tick(i, 0.0)
    }

    /// Does trigger `i` need no search?
    pub(crate) fn is_direct(&self, i: u32) -> bool {
        self.plan.direct(self.fraction(i, 0.0)) != NO_TIME
    }

    /// The tick of the fraction `(2i + 1 + more) / 2n`.
    #[inline(always)]
    pub(crate) fn tick(&self, i: u32, more: f32) -> u32 {
        self.scale.tick(self.plan.time_at(self.fraction(i, more)))
    }

    #[inline(always)]
    fn fraction(&self, i: u32, more: f32) -> Fraction {
        Fraction::new(2 * i + 1, more, 2 * self.n)
    }
}

/// The least `e` for which a `length`, in units of `2^unit` of the curve's time, is at most 2^e ticks.
fn exponent_of_ticks(length: u64, tick_hz: u32, unit: i32) -> i32 {
    // Below 2⁹⁶.
    let ticks = length as u128 * tick_hz as u128;
    u128::BITS as i32 - ticks.saturating_sub(1).leading_zeros() as i32 + unit
}

/// The error of a rate at which the interval has too many ticks, with the greatest at which it has not.
#[cold]
#[inline(never)]
fn too_high(length: u64, tick_hz: u32, unit: i32) -> ScheduleError {
    let (mut most, mut fail) = (0, tick_hz);
    while fail - most > 1 {
        let middle = most + (fail - most) / 2;
        let fits = exponent_of_ticks(length, middle, unit) <= MOST_TICKS;
        *(if fits { &mut most } else { &mut fail }) = middle;
    }
    ScheduleError::TickRateTooHigh { most }
}

/// From times in the plan's unit to ticks, in fixed point.
#[derive(Clone)]
pub(crate) struct TickScale {
    start: i64,
    /// What moves the delay, the time since the start, up until the whole interval has 63 bits.
    up: u32,
    /// The rate, moved up until it has 32 bits.
    rate: u32,
    /// What moves the upper 64 bits of their product down to half ticks.
    down: u32,
}

impl TickScale {
    /// For an interval that starts at `start` and is `length` long, in units of `2^unit`, and has at most 2³¹ ticks.
    pub(crate) fn new(start: i64, length: u64, tick_hz: u32, unit: i32) -> Self {
        // The length or one of the ends is at least 2⁶¹ units (`time_unit`). If an end is, the next `f32` is at least
        // 2³⁷ units away. So an interval has from 2³⁷ to 2⁶² units.
        let up = length.leading_zeros().wrapping_sub(1) & 31;
        let zeros = tick_hz.leading_zeros();
        let down = (up + zeros) as i32 - unit - 33;
        // An interval that is much shorter than a tick has none.
        Self { start, up, rate: tick_hz << zeros, down: if down < 63 { down as u32 } else { 63 } }
    }

    /// The nearest tick to a time.
    // proofs/ticks.py: tick
    #[inline(always)]
    pub(crate) fn tick(&self, time: i64) -> u32 {
        // Not below 0, whatever the last units of a time are. And not beyond the end, since no time is: a polynomial's
        // would be off by all of `1 - u` in exposure, and its certificate allows half an ulp of that; the plateau's line
        // is rounded down; and `Moment::in_units` stops searches.
        let delay = time.wrapping_sub(self.start).max(0) as u64;
        let delay = delay << self.up;
        let (high, low) = (delay >> 32, delay & 0xFFFF_FFFF);
        let product = high * self.rate as u64 + ((low * self.rate as u64) >> 32);
        (((product >> self.down) + 1) >> 1) as u32
    }
}
