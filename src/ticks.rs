//! From fractions of the exposure to the ticks of a timer.

use crate::by_u64::{Direct, PlateauU64};
use crate::error::ScheduleError;
use crate::exposure::FOR_TICK;
use crate::fraction::{Edge, Fractions};
use crate::moment::Moment;
use crate::pair::Pair;
use crate::plan::Plan;
use crate::units::fixed;

/// In an interval of more than 2^`DIRECT_TICKS` ticks a polynomial may be off by more than a quarter of a tick: there
/// all triggers are searched for.
const DIRECT_TICKS: i32 = 24;
/// An interval has at most 2^`MOST_TICKS` ticks: half of what a timer of 32 bits counts, so that it tells before from
/// after.
const MOST_TICKS: i32 = 31;
/// In frames of more triggers all are searched for. Up to here triggers are four ulp of an `f32` apart or more, so that
/// polynomials, whose error in `u` is up to half of one, keep their order. That searches keep it, too, where triggers
/// are closer than their proven error, is measured, not proven (docs/proofs.md).
pub(crate) const DIRECT_TRIGGERS: u32 = 1 << 22;

/// What places the triggers of one frame.
#[derive(Clone)]
pub(crate) struct Ticks<'a, const CELLS: usize> {
    pub(crate) plan: &'a Plan<CELLS>,
    pub(crate) fractions: Fractions,
    tick_hz: u32,
    pub(crate) plateau: PlateauU64,
    /// None if all triggers of the frame are searched for.
    pub(crate) scale: Option<TickScale>,
}

impl<'a, const CELLS: usize> Ticks<'a, CELLS> {
    pub(crate) fn new(plan: &'a Plan<CELLS>, n: u32, tick_hz: u32) -> Result<Self, ScheduleError> {
        if tick_hz == 0 {
            return Err(ScheduleError::TickRateZero);
        }
        let start = plan.outer_in_units(0);
        let length = (plan.outer_in_units(1) - start) as u64;
        let exponent = exponent_of_ticks(length, tick_hz, plan.unit());
        if exponent > MOST_TICKS {
            return Err(too_high(length, tick_hz, plan.unit()));
        }
        let searched = n > DIRECT_TRIGGERS || exponent > DIRECT_TICKS;
        let scale = (!searched).then(|| TickScale::new(start, length, tick_hz, plan.unit()));
        let (fractions, plateau) = (Fractions::new(n), plan.plateau_u64());
        Ok(Self { plan, fractions, tick_hz, plateau, scale })
    }

    pub(crate) fn n(&self) -> u32 {
        self.fractions.n
    }

    /// The tick of trigger `i`, at the fraction `(2i + 1) / 2n`: a pulse without length, so either of its ends.
    #[inline(always)]
    pub(crate) fn at(&self, i: u32) -> u32 {
        self.edge(i, &Edge::TRIGGER)
    }

    /// The tick of one end of a pulse around trigger `i`.
    #[inline(always)]
    pub(crate) fn edge(&self, i: u32, edge: &Edge) -> u32 {
        match self.direct(i, edge) {
            Some(tick) => tick,
            None => self.searched(2 * i as u64 + 1, edge),
        }
    }

    /// The tick of one end of a pulse, if no search is needed.
    #[inline(always)]
    pub(crate) fn direct(&self, i: u32, edge: &Edge) -> Option<u32> {
        let scale = self.scale.as_ref()?;
        // A frame of which some are direct has so few that this fits.
        let odd = i.wrapping_mul(2) | 1;
        let u = self.fractions.in_u64(odd, edge);
        let time = match self.plan.direct_u64(u, &self.plateau)? {
            Direct::Line => self.plan.on_line((u >> 32) as u32),
            Direct::Octave(octave) => octave.time(u),
        };
        Some(scale.tick(time))
    }

    /// The tick of one end of the pulse around the trigger at `odd / 2n`, by a search. Out of line, so that the direct way
    /// saves no registers for it.
    #[cold]
    #[inline(never)]
    pub(crate) fn searched(&self, odd: u64, edge: &Edge) -> u32 {
        let unit = self.plan.unit();
        let moment = moment(self.plan, &self.fractions, odd, edge);
        let delay = moment.since(self.plan.exposure.outer(0), unit);
        if let Some(scale) = &self.scale {
            // Rounded as the direct way rounds, so that neighbours keep their order.
            return scale.tick_of_delay(fixed(delay.hi, 0) + fixed(delay.lo, 0));
        }
        let Pair { hi, lo } = delay.times(Pair::from_u32(self.tick_hz)).shifted(unit);
        // A product's second half may be some ulp of the first.
        let ticks = Pair::sum(hi, lo);
        // An `f32` above 2²⁴ is an integer, and what the second half adds to it is below 2⁸.
        let whole = ticks.hi as u32;
        let rest = (ticks.hi - whole as f32) + ticks.lo + 0.5;
        // Made positive first, since the cast cuts towards 0.
        (whole + (rest + 256.0) as u32).saturating_sub(256)
    }
}

/// The moment of the fraction `odd / 2n`, or of one end of a pulse around it, by a search.
#[inline(never)]
pub(crate) fn moment<const CELLS: usize>(
    plan: &Plan<CELLS>,
    fractions: &Fractions,
    odd: u64,
    edge: &Edge,
) -> Moment {
    let (side, a) = fractions.exactly(odd, edge);
    if a.hi == 0.0 {
        // The end itself, though no light may fall there.
        return Moment::at(plan.exposure.outer(side));
    }
    plan.exposure.at_fraction(side, a, FOR_TICK)
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
    /// The power of two that brings the delay, the time since the start, to 31 bits in the upper word.
    power: u32,
    /// The ticks in a unit of that word, in units of 2⁻⁶⁴.
    factor: u64,
}

impl TickScale {
    /// For an interval that starts at `start` and is `length` long, in units of `2^unit`.
    pub(crate) fn new(start: i64, length: u64, tick_hz: u32, unit: i32) -> Self {
        // The length or one of the ends is at least 2⁶¹ units (`time_unit`). If an end is, the next `f32` is at least
        // 2³⁷ units away. So an interval has from 2³⁷ to 2⁶² units.
        let up = length.leading_zeros().wrapping_sub(1) & 31;
        // 32 for the upper word, and 64 for the unit of the factor.
        let shift = unit + 96 - up as i32;
        let rate = tick_hz as u64;
        let factor = if shift < 0 {
            rate.checked_shr(shift.unsigned_abs())
        } else {
            rate.checked_shl(shift.unsigned_abs())
        };
        // If a tick is much longer than the interval, the factor is 0, and so are all ticks.
        Self { start, power: 1 << up, factor: factor.unwrap_or(0) }
    }

    /// The tick of a time.
    #[inline(always)]
    pub(crate) fn tick(&self, time: i64) -> u32 {
        self.tick_of_delay(time.wrapping_sub(self.start))
    }

    /// The same by the delay. That and the factor are cut, which costs 2⁻⁶ tick.
    // proofs/ticks.py: tick
    #[inline(always)]
    fn tick_of_delay(&self, delay: i64) -> u32 {
        let (high, low) = ((delay as u64 >> 32) as u32, delay as u32 as u64);
        let low = ((low * self.power as u64) >> 32) as u32;
        // Not below 0, whatever the last units of a time are. And below 2³¹, since no time is beyond the
        // end: a polynomial's would be off by all of `1 - u` in exposure, and its certificate allows half an ulp of
        // that; the plateau's line is rounded down; and `Moment::since` stops searches.
        let delay = (high.wrapping_mul(self.power).wrapping_add(low) as i32).max(0) as u64;
        let low = (delay * (self.factor as u32 as u64)) >> 32;
        ((delay * (self.factor >> 32) + low + (1 << 31)) >> 32) as u32
    }
}
