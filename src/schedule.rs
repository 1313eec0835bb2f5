//! When to trigger: equal shares of the exposure, as times, as timer ticks, as a checked schedule.

use crate::error::ScheduleError;
use crate::exposure::FOR_TICK;
use crate::pair::{Pair, fixed, power_of_two};
use crate::plan::{Plan, Words};
use crate::ramp::{Place, WHOLE_EXPONENT, scaled};
use crate::shutter::ShutterCurve;

/// Intervals of more than 2 to this ticks are beyond what a direct polynomial places to a quarter of a tick.
const DIRECT_TICKS: i32 = 24;
/// Up to here `i + 1/2` is an `f32`.
const EXACT_HALVES: u32 = 1 << 23;
/// An interval may have 2 to this ticks.
const MOST_TICKS: i32 = 31;

impl<const CELLS: usize> ShutterCurve<CELLS> {
    /// The `n` times that split the exposure evenly, each in the middle of its share:
    /// `inverse_cdf((i + 1/2) / n)`; never a step back.
    pub fn trigger_times(&self, n: u32) -> impl ExactSizeIterator<Item = f32> {
        let fractions = Fractions::new(n);
        (0..n).map(move |i| {
            if n <= EXACT_HALVES {
                self.inverse_cdf((i as f32 + 0.5) / n as f32)
            } else {
                place(&self.plan, &fractions, 2 * i as u64 + 1).time()
            }
        })
    }

    /// So many triggers are sure to keep `min_gap` between their exact times: `max(1, floor(A / min_gap))`, since
    /// the openness is at most 1; a curve that never fully opens may take more. `u32::MAX` where nothing is
    /// required, that is a gap of 0, below, or NaN.
    pub const fn max_triggers(&self, min_gap: f32) -> u32 {
        if min_gap <= 0.0 || min_gap.is_nan() {
            return u32::MAX;
        }
        // The cast rounds down and saturates.
        // The area is known to some 2⁻⁵¹, so what is so near to the next number is that.
        let trace = 1.0 + 1.0 / (1u64 << 50) as f64;
        let most = (self.plan.exposure.area * trace / min_gap as f64) as u32;
        if most > 1 { most } else { 1 }
    }

    /// The `n` trigger times in ticks of a timer that runs at `tick_hz`, counted from
    /// [`open_start`](Self::open_start), for times in seconds; never a step back. Add the timer's own base
    /// with `wrapping_add`.
    ///
    /// Each is rounded to the nearest tick of a time within 1/4 tick of the exact one, so it is at most
    /// 3/4 tick from that, for intervals of any length up to 2³¹ ticks: above 2²⁴, the direct polynomials are
    /// left aside for the solver, which places to a thousandth of a tick. Only where the openness touches 0 between the
    /// ends, so that many times have next to the same exposure, it is this that is kept, to 2⁻³⁸.
    ///
    /// # Errors
    /// A rate of 0, or one at which the interval has more than 2³¹ ticks.
    pub fn trigger_ticks(
        &self,
        n: u32,
        tick_hz: u32,
    ) -> Result<impl ExactSizeIterator<Item = u32>, ScheduleError> {
        let ticks = Ticks::new(&self.plan, n, tick_hz)?;
        Ok((0..n).map(move |i| ticks.at(i)))
    }

    /// A checked schedule: the ticks of [`trigger_ticks`](Self::trigger_ticks), no two closer than
    /// `min_gap` ticks.
    ///
    /// # Errors
    /// More triggers than `N`; a gap not kept, with how many triggers would keep it; and those of
    /// [`trigger_ticks`](Self::trigger_ticks).
    #[cfg(feature = "heapless-v0_9")]
    pub fn schedule<const N: usize>(
        &self,
        n: u32,
        tick_hz: u32,
        min_gap: u32,
    ) -> Result<heapless::Vec<u32, N>, ScheduleError> {
        let mut schedule = heapless::Vec::new();
        if n as usize > N {
            return Err(ScheduleError::CapacityExceeded);
        }
        let ticks = Ticks::new(&self.plan, n, tick_hz)?;
        for i in 0..n {
            let tick = ticks.at(i);
            if schedule.last().is_some_and(|last| tick - last < min_gap) {
                return Err(ScheduleError::GapTooSmall { most: self.most(n, tick_hz, min_gap)? });
            }
            let _ = schedule.push(tick);
        }
        Ok(schedule)
    }

    /// So many triggers keep `min_gap`, and one more does not, where `n` do not: by bisection, in log2(n) schedules.
    #[cfg(feature = "heapless-v0_9")]
    #[cold]
    #[inline(never)]
    fn most(&self, n: u32, tick_hz: u32, min_gap: u32) -> Result<u32, ScheduleError> {
        let (mut keep, mut fail) = (1, n);
        while fail - keep > 1 {
            let middle = keep + (fail - keep) / 2;
            let mut last = None;
            let keeps = self.trigger_ticks(middle, tick_hz)?.all(|tick| {
                let gap = last.map_or(u32::MAX, |last| tick - last);
                last = Some(tick);
                gap >= min_gap
            });
            *(if keeps { &mut keep } else { &mut fail }) = middle;
        }
        Ok(keep)
    }
}

/// Frames of more triggers are searched for throughout: a polynomial might put neighbours in the wrong order.
const DIRECT_TRIGGERS: u32 = 1 << 22;

/// The fractions `(2i + 1) / 2n` of the exposure.
struct Fractions {
    n: u32,
    /// `1 / 2n` in units of 2⁻⁶⁴, rounded down, ...
    share: u64,
    /// ... and what is missing of it, in units of 2⁻⁹⁶.
    rest: u32,
}

impl Fractions {
    /// A 64-bit division is dear on a small processor, so only this one is made.
    fn new(n: u32) -> Self {
        let divisor = n as u64 | (n == 0) as u64;
        let share = (1 << 63) / divisor;
        // The remainder over n is the remainder times 2/2n.
        let remainder = (1 << 63) - share * divisor;
        Self { n, share, rest: ((remainder * share) >> 31) as u32 }
    }

    /// The fraction `odd / 2n` from below, in units of 2⁻⁶⁴: by less than `odd` of these.
    #[inline(always)]
    fn in_words(&self, odd: u64) -> u64 {
        odd.wrapping_mul(self.share)
    }

    /// The fraction `odd / 2n` counted from its nearer side, in [`WHOLE`], to 2⁻⁴⁵.
    fn exactly(&self, odd: u64) -> (usize, Pair) {
        let n = self.n as u64;
        let (side, near) = if odd <= n { (0, odd) } else { (1, 2 * n - odd) };
        // By words: near times a number of 96 bits, at most 2⁹⁵.
        let low = near * self.rest as u64;
        let middle = near * (self.share as u32 as u64) + (low >> 32);
        let words = near * (self.share >> 32) + (middle >> 32) << 32 | middle as u32 as u64;
        // The first 48 bits, halved; at least 2⁻³³ of all.
        let zeros = words.leading_zeros() & 63;
        let bits = words << zeros | (low as u32 as u64) << zeros >> 32;
        let [hi, lo] = [bits >> 40, bits >> 16 & 0xFF_FFFF].map(|half| half as u32 as f32);
        let unit = power_of_two(WHOLE_EXPONENT - 24 - zeros as i32);
        (side, Pair { hi: hi * unit, lo: lo * (unit / (1 << 24) as f32) })
    }
}

/// What places the triggers of one frame.
struct Ticks<'a, const CELLS: usize> {
    plan: &'a Plan<CELLS>,
    fractions: Fractions,
    tick_hz: u32,
    plateau: Words,
    direct: Option<Direct>,
}

impl<'a, const CELLS: usize> Ticks<'a, CELLS> {
    fn new(plan: &'a Plan<CELLS>, n: u32, tick_hz: u32) -> Result<Self, ScheduleError> {
        if tick_hz == 0 {
            return Err(ScheduleError::TickRateZero);
        }
        let start = plan.start_in_units(0);
        let length = (plan.start_in_units(1) - start) as u64;
        if exceeds(length, tick_hz, plan.unit(), MOST_TICKS) {
            return Err(ScheduleError::TickRateTooHigh);
        }
        let searched = n > DIRECT_TRIGGERS || exceeds(length, tick_hz, plan.unit(), DIRECT_TICKS);
        let direct = if searched { None } else { Direct::new(start, length, tick_hz, plan.unit()) };
        let (fractions, plateau) = (Fractions::new(n), plan.plateau_in_words());
        Ok(Self { plan, fractions, tick_hz, plateau, direct })
    }

    /// The tick of trigger `i`, at the fraction `(2i + 1) / 2n`.
    #[inline(always)]
    fn at(&self, i: u32) -> u32 {
        let odd = 2 * i as u64 + 1;
        if let Some(direct) = &self.direct
            && let Some(time) =
                self.plan.direct_in_words(self.fractions.in_words(odd), &self.plateau)
        {
            return direct.tick(time);
        }
        self.searched(odd)
    }

    /// The same by a search; out of line, so that the direct way saves no registers for it.
    #[cold]
    #[inline(never)]
    fn searched(&self, odd: u64) -> u32 {
        let unit = self.plan.unit();
        let place = place(self.plan, &self.fractions, odd);
        let delay = place.since(self.plan.exposure.start(0), unit);
        if let Some(direct) = &self.direct {
            // Rounded as the direct way rounds, so that neighbours keep their order.
            return direct.tick(direct.start + fixed(delay.hi, 0) + fixed(delay.lo, 0));
        }
        let ticks = scaled(delay.times(Pair::from_u32(self.tick_hz)), unit);
        // What is above 2²⁴ in f32 has no fraction; what the second half adds to it is below 2⁸ then.
        let whole = ticks.hi as u32;
        let rest = (ticks.hi - whole as f32) + ticks.lo + 0.5;
        // The cast rounds down what is above 0.
        (whole + (rest + 256.0) as u32).saturating_sub(256)
    }
}

/// The place of the fraction `odd / 2n`, by a search.
#[inline(never)]
fn place<const CELLS: usize>(plan: &Plan<CELLS>, fractions: &Fractions, odd: u64) -> Place {
    let (side, a) = fractions.exactly(odd);
    plan.exposure.at_fraction(side, a, FOR_TICK)
}

/// Is `length`, in units of `2^unit` of the curve's time, more than `2^most` ticks?
fn exceeds(length: u64, tick_hz: u32, unit: i32, most: i32) -> bool {
    // Below 2⁹⁶.
    let ticks = length as u128 * tick_hz as u128;
    let shift = most - unit;
    shift < 96 && ticks > if shift < 0 { 0 } else { 1 << shift }
}

/// From times in the plan's unit to ticks, in fixed point.
struct Direct {
    start: i64,
    /// What brings a time after the start down to 31 bits, and the ticks in a unit of these, which count 2⁻⁶⁴.
    down: u32,
    factor: u64,
}

impl Direct {
    /// For an interval that starts at `start` and is `length` long, in units of `2^unit`; none where a tick is next to
    /// all of it.
    fn new(start: i64, length: u64, tick_hz: u32, unit: i32) -> Option<Self> {
        let down = 33u32.saturating_sub(length.leading_zeros());
        let up = unit + 64 + down as i32;
        let rate = tick_hz as u64;
        let factor = if up < 0 {
            rate.checked_shr(up.unsigned_abs())
        } else {
            rate.checked_shl(up.unsigned_abs())
        };
        let factor = factor.unwrap_or(0);
        (factor >> 32 != 0).then_some(Self { start, down, factor })
    }

    #[inline(always)]
    fn tick(&self, time: i64) -> u32 {
        let delay = time.wrapping_sub(self.start);
        if delay < 0 {
            return 0;
        }
        // `down` is below 32; where it is 0, so is the upper word.
        let delay = delay as u64;
        let high = ((delay >> 32) as u32) << (self.down.wrapping_neg() & 31);
        let delay = (high | delay as u32 >> (self.down & 31)) as u64;
        let low = (delay * (self.factor as u32 as u64)) >> 32;
        ((delay * (self.factor >> 32) + low + (1 << 31)) >> 32) as u32
    }
}
