//! When to trigger: equal shares of the exposure, as times, as timer ticks, as a checked schedule.

use core::ops::Range;

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
    /// The `n` times that split the exposure evenly, each in the middle of its share, in the curve's unit:
    /// `inverse_cdf((i + 1/2) / n)`; never a step back.
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, valid};
    /// // A box of 8 ms, its times in ms.
    /// let curve: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.0, 8.0, 8.0));
    /// assert!(curve.trigger_times(4).eq([1.0, 3.0, 5.0, 7.0]));
    /// // From the back, or any one at once: each costs the same.
    /// assert_eq!(curve.trigger_times(4).next_back(), Some(7.0));
    /// assert_eq!(curve.trigger_times(4_000_000_000).nth(2_000_000_000), Some(4.0));
    /// ```
    pub fn trigger_times(&self, n: u32) -> TriggerTimes<'_, CELLS> {
        TriggerTimes { frame: Times { curve: self, fractions: Fractions::new(n) }, left: 0..n }
    }

    /// A number of triggers that keeps `min_gap` between their exact times: `max(1, floor(A / min_gap))`, since the openness is
    /// at most 1 (a curve whose control points pass 1 by their rounding may miss the gap by 2⁻²² of it). A curve that never
    /// fully opens may take more. The gap is in the curve's unit; [`most_triggers`](Self::most_triggers) takes one in ticks.
    /// `u32::MAX` where nothing is required: for a gap of 0, a negative one, or NaN.
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, valid};
    /// // In ms: an exposure of 7.5 ms has room for a pulse every 0.5 ms, 15 times.
    /// static SHUTTER: ShutterCurve = valid(ShutterCurve::linear(0.0, 2.5, 7.5, 10.0));
    /// const N: u32 = SHUTTER.max_triggers(0.5);
    /// assert_eq!(N, 15);
    /// ```
    pub const fn max_triggers(&self, min_gap: f32) -> u32 {
        if min_gap <= 0.0 || min_gap.is_nan() {
            return u32::MAX;
        }
        // The area is known to about 2⁻⁵¹, so a quotient so near to the next integer counts as that. The cast rounds down, and
        // saturates.
        let trace = 1.0 + 1.0 / (1u64 << 50) as f64;
        let most = (self.plan.exposure.area * trace / min_gap as f64) as u32;
        if most > 1 { most } else { 1 }
    }

    /// Each trigger of a frame of up to so many costs at most the worst direct answer: it is placed by a polynomial or by the
    /// plateau's line, never by a search. This holds for [`trigger_times`](Self::trigger_times), and for
    /// [`trigger_ticks`](Self::trigger_ticks) on intervals of up to 2²⁴ ticks. The README has both costs in cycles.
    ///
    /// It is 255 or more for most shutters with `CELLS = 8`, and doubles with each octave more. 0 says that there is no such
    /// frame: with `CELLS = 0`, unless the shutter is open all of the time, and on curves too difficult for polynomials.
    ///
    /// Being constant, it makes a deadline that the compiler checks:
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, valid};
    /// static SHUTTER: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// const _: () = assert!(SHUTTER.direct_triggers() >= 64);
    /// ```
    ///
    /// The same with a shutter whose ramps nearly stand still, which needs searches, does not compile:
    ///
    /// ```compile_fail,E0080
    /// use shutter_curve::{CubicBezier, ShutterCurve, valid};
    /// static SHUTTER: ShutterCurve = valid(ShutterCurve::new(
    ///     CubicBezier::new([(0.0, 0.0), (0.0025, 0.0), (0.0, 1.0), (0.0025, 1.0)]),
    ///     CubicBezier::new([(0.0075, 1.0), (0.010, 1.0), (0.0075, 0.0), (0.010, 0.0)]),
    /// ));
    /// const _: () = assert!(SHUTTER.direct_triggers() >= 64);
    /// ```
    pub const fn direct_triggers(&self) -> u32 {
        let least = [self.plan.least_direct(0), self.plan.least_direct(1)];
        let least = if least[0] > least[1] { least[0] } else { least[1] };
        // The first and the last trigger come nearest to the ends: 1/2n away, in units of 2⁻⁶⁴, and as `f32` 2⁻²⁴ less.
        // It saturates, so that the compiler sees that it is not 0.
        let least = ((least * 18446744073709551616.0) as u64).saturating_add(1 << 40);
        let most = (1 << 63) / least;
        if most < DIRECT_TRIGGERS as u64 { most as u32 } else { DIRECT_TRIGGERS }
    }

    /// The `n` trigger times in ticks of a timer, counted from [`open_start`](Self::open_start); never a step back. Add the
    /// timer's own base with `wrapping_add`.
    ///
    /// `tick_hz` is the number of ticks in one unit of the curve's time: for a curve in seconds the timer's rate in Hz, for a
    /// curve in ms a thousandth of that. No error can tell a rate that was meant for another unit.
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, valid};
    /// // The same box of 8 ms in seconds and in ms, on a timer of 1 MHz.
    /// let in_s: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.0, 0.008, 0.008));
    /// assert!(in_s.trigger_ticks(4, 1_000_000)?.eq([1000, 3000, 5000, 7000]));
    /// let in_ms: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.0, 8.0, 8.0));
    /// assert!(in_ms.trigger_ticks(4, 1_000)?.eq([1000, 3000, 5000, 7000]));
    /// // A million ticks in a millisecond are a timer of 1 GHz.
    /// assert!(in_ms.trigger_ticks(4, 1_000_000)?.eq([1_000_000, 3_000_000, 5_000_000, 7_000_000]));
    /// # Ok::<(), shutter_curve::ScheduleError>(())
    /// ```
    ///
    /// Each is rounded to the nearest tick of a time within 1/4 tick of the exact one, so it is at most
    /// 3/4 tick from that, for intervals of any length up to 2³¹ ticks: above 2²⁴, the direct polynomials are
    /// left aside for the solver, which places to a thousandth of a tick. Only where the openness touches 0 between the
    /// ends, so that many times have next to the same exposure, it is this that is kept: to 2⁻³⁰ by proof, to 2⁻³⁶ in all tests.
    ///
    /// # Errors
    /// A rate of 0, or one at which the interval has more than 2³¹ ticks.
    pub fn trigger_ticks(
        &self,
        n: u32,
        tick_hz: u32,
    ) -> Result<TriggerTicks<'_, CELLS>, ScheduleError> {
        Ok(TriggerTicks { frame: Ticks::new(&self.plan, n, tick_hz)?, left: 0..n })
    }

    /// A checked schedule: as many triggers as `ticks` has places, at the ticks of [`trigger_ticks`](Self::trigger_ticks), no
    /// two closer than `min_gap` ticks. `tick_hz` counts ticks in one unit of the curve's time, as there.
    ///
    /// ```
    /// use shutter_curve::{ScheduleError, ShutterCurve, valid};
    /// static SHUTTER: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// let mut ticks = [0; 5];
    /// SHUTTER.schedule_into(&mut ticks, 1_000_000, 1_000)?;
    /// assert_eq!(ticks, [1936, 3500, 5000, 6500, 8064]);
    /// // Too many for a gap of 1 ms, and how many are not.
    /// let error = SHUTTER.schedule_into(&mut [0; 16], 1_000_000, 1_000).unwrap_err();
    /// assert_eq!(error, ScheduleError::GapTooSmall { trigger: 1, gap: 792, min_gap: 1_000 });
    /// assert_eq!(SHUTTER.most_triggers(16, 1_000_000, 1_000), Ok(7));
    /// # Ok::<(), ScheduleError>(())
    /// ```
    ///
    /// # Errors
    /// A gap not kept, more places than `u32::MAX`, and those of [`trigger_ticks`](Self::trigger_ticks). What the slice then
    /// holds is no schedule.
    pub fn schedule_into(
        &self,
        ticks: &mut [u32],
        tick_hz: u32,
        min_gap: u32,
    ) -> Result<(), ScheduleError> {
        let Ok(n) = u32::try_from(ticks.len()) else {
            return Err(ScheduleError::CapacityExceeded { capacity: u32::MAX });
        };
        let frame = Ticks::new(&self.plan, n, tick_hz)?;
        let mut earliest = 0;
        for (i, place) in (0..n).zip(ticks) {
            let tick = frame.at(i);
            if tick < earliest {
                return Err(frame.too_close(i, min_gap));
            }
            *place = tick;
            // What is beyond 32 bits is beyond all ticks.
            earliest = tick.saturating_add(min_gap);
        }
        Ok(())
    }

    /// [`schedule_into`](Self::schedule_into) a vector of its own, of `n` triggers, with feature `heapless-v0_9`.
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, valid};
    /// let curve: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// let ticks: heapless::Vec<u32, 16> = curve.schedule(5, 1_000_000, 1_000)?;
    /// assert_eq!(ticks, [1936, 3500, 5000, 6500, 8064]);
    /// # Ok::<(), shutter_curve::ScheduleError>(())
    /// ```
    ///
    /// # Errors
    /// More triggers than `N`, and those of [`schedule_into`](Self::schedule_into).
    #[cfg(feature = "heapless-v0_9")]
    pub fn schedule<const N: usize>(
        &self,
        n: u32,
        tick_hz: u32,
        min_gap: u32,
    ) -> Result<heapless::Vec<u32, N>, ScheduleError> {
        let mut schedule = heapless::Vec::new();
        let fits = usize::try_from(n).is_ok_and(|n| schedule.resize(n, 0).is_ok());
        if !fits {
            return Err(ScheduleError::CapacityExceeded { capacity: N as u32 });
        }
        self.schedule_into(&mut schedule, tick_hz, min_gap)?;
        Ok(schedule)
    }

    /// As many of `wanted` triggers as keep a gap of `min_gap` ticks: all of them, or so many that keep it while one more does
    /// not; at least 1, unless none are wanted. `tick_hz` counts ticks in one unit of the curve's time.
    ///
    /// It tries frames, each up to where the gap is too small: those around the exposure over the gap, which is next to the
    /// answer for a shutter that opens fully, and from there on by doubled steps and bisection. So it costs a few frames
    /// at best, and `2 log2(wanted)` at worst.
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, valid};
    /// let curve: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// // A lamp that needs 1 ms between two flashes, on a timer of 1 MHz.
    /// assert_eq!(curve.most_triggers(16, 1_000_000, 1_000), Ok(7));
    /// ```
    ///
    /// # Errors
    /// Those of [`trigger_ticks`](Self::trigger_ticks).
    pub fn most_triggers(
        &self,
        wanted: u32,
        tick_hz: u32,
        min_gap: u32,
    ) -> Result<u32, ScheduleError> {
        if self.keeps(wanted, tick_hz, min_gap)? {
            return Ok(wanted);
        }
        // One trigger keeps any gap, so at least two are wanted, and a gap of at least 1.
        let (mut keep, mut fail) = (1, wanted);
        let guess = tick_hz as f32 / (self.normalization() * min_gap as f32);
        let mut n = (guess as u32).min(wanted - 1).max(2);
        let mut step = 1u32;
        while fail - keep > 1 {
            let keeps = self.keeps(n, tick_hz, min_gap)?;
            *(if keeps { &mut keep } else { &mut fail }) = n;
            let middle = keep + (fail - keep) / 2;
            n = if keeps {
                middle.min(keep.saturating_add(step))
            } else {
                middle.max(fail.saturating_sub(step))
            };
            step = step.saturating_mul(2);
        }
        Ok(keep)
    }

    /// Do the ticks of `n` triggers keep the gap?
    fn keeps(&self, n: u32, tick_hz: u32, min_gap: u32) -> Result<bool, ScheduleError> {
        let mut last = None;
        Ok(self.trigger_ticks(n, tick_hz)?.all(|tick| {
            let gap = last.map_or(u32::MAX, |last| tick - last);
            last = Some(tick);
            gap >= min_gap
        }))
    }
}

/// The times of a frame's triggers, of [`ShutterCurve::trigger_times`]: any of them in constant time, from either end.
#[derive(Clone)]
pub struct TriggerTimes<'a, const CELLS: usize = 8> {
    frame: Times<'a, CELLS>,
    left: Range<u32>,
}

/// The ticks of a frame's triggers, of [`ShutterCurve::trigger_ticks`]: any of them in constant time, from either end.
///
/// An interrupt handler can keep one of a curve in a `static`, and take a tick whenever one has been served:
///
/// ```
/// use shutter_curve::{ScheduleError, ShutterCurve, TriggerTicks, valid};
/// use std::sync::Mutex;
///
/// static SHUTTER: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
/// const _: () = assert!(SHUTTER.direct_triggers() >= 16);
/// static FRAME: Mutex<Option<TriggerTicks<'static>>> = Mutex::new(None);
///
/// fn begin() -> Result<(), ScheduleError> {
///     *FRAME.lock().unwrap() = Some(SHUTTER.trigger_ticks(16, 1_000_000)?);
///     Ok(())
/// }
///
/// fn on_interrupt(base: u32, set_compare: impl Fn(u32)) {
///     if let Some(tick) = FRAME.lock().unwrap().as_mut().and_then(Iterator::next) {
///         set_compare(base.wrapping_add(tick));
///     }
/// }
/// # begin()?;
/// # on_interrupt(5, |tick| assert_eq!(tick, 5 + 1083));
/// # Ok::<(), ScheduleError>(())
/// ```
#[derive(Clone)]
pub struct TriggerTicks<'a, const CELLS: usize = 8> {
    frame: Ticks<'a, CELLS>,
    left: Range<u32>,
}

impl<const CELLS: usize> TriggerTicks<'_, CELLS> {
    /// Is trigger `i` of the frame placed without a search? For measurements.
    #[doc(hidden)]
    pub fn is_direct(&self, i: u32) -> bool {
        self.frame.direct(i).is_some()
    }
}

/// The iterators: what is left of a frame, whose trigger `i` is at `frame.at(i)`.
macro_rules! iterate {
    ($name:ident, $item:ty) => {
        impl<const CELLS: usize> Iterator for $name<'_, CELLS> {
            type Item = $item;

            // Into the one loop that there mostly is.
            #[inline(always)]
            fn next(&mut self) -> Option<$item> {
                let i = self.left.next()?;
                Some(self.frame.at(i))
            }

            #[inline]
            fn nth(&mut self, n: usize) -> Option<$item> {
                let i = self.left.nth(n)?;
                Some(self.frame.at(i))
            }

            #[inline]
            fn size_hint(&self) -> (usize, Option<usize>) {
                self.left.size_hint()
            }

            #[inline]
            fn count(self) -> usize {
                self.left.count()
            }

            #[inline]
            fn last(mut self) -> Option<$item> {
                self.next_back()
            }
        }

        impl<const CELLS: usize> DoubleEndedIterator for $name<'_, CELLS> {
            #[inline]
            fn next_back(&mut self) -> Option<$item> {
                let i = self.left.next_back()?;
                Some(self.frame.at(i))
            }

            #[inline]
            fn nth_back(&mut self, n: usize) -> Option<$item> {
                let i = self.left.nth_back(n)?;
                Some(self.frame.at(i))
            }
        }

        impl<const CELLS: usize> ExactSizeIterator for $name<'_, CELLS> {}

        impl<const CELLS: usize> core::iter::FusedIterator for $name<'_, CELLS> {}

        impl<const CELLS: usize> core::fmt::Debug for $name<'_, CELLS> {
            fn fmt(&self, out: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                let (n, left) = (self.frame.n(), &self.left);
                out.debug_struct(stringify!($name))
                    .field("n", &n)
                    .field("left", left)
                    .finish_non_exhaustive()
            }
        }

        #[cfg(feature = "defmt")]
        impl<const CELLS: usize> defmt::Format for $name<'_, CELLS> {
            fn format(&self, out: defmt::Formatter<'_>) {
                let (n, left) = (self.frame.n(), &self.left);
                defmt::write!(
                    out,
                    "{=str} {{ n: {}, left: {}..{}, .. }}",
                    stringify!($name),
                    n,
                    left.start,
                    left.end
                );
            }
        }
    };
}
pub(crate) use iterate;

iterate!(TriggerTimes, f32);
iterate!(TriggerTicks, u32);

/// Frames of more triggers are searched for throughout: a polynomial might put neighbours in the wrong order.
const DIRECT_TRIGGERS: u32 = 1 << 22;

/// The fractions `(2i + 1) / 2n` of the exposure.
#[derive(Clone)]
pub(crate) struct Fractions {
    pub(crate) n: u32,
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
    fn in_words(&self, odd: u32) -> u64 {
        self.share.wrapping_mul(odd as u64)
    }

    /// The fraction `odd / 2n`, or half a pulse before or behind it, counted from its nearer side, in [`WHOLE`], to 2⁻⁴⁵.
    fn exactly(&self, odd: u64, edge: Edge) -> (usize, Pair) {
        let n = self.n as u64;
        let (side, near) =
            if odd < n || odd == n && !edge.is_off { (0, odd) } else { (1, 2 * n - odd) };
        // By words: near times a number of 96 bits, at most 2⁹⁵.
        let low = near * self.rest as u64;
        let middle = near * (self.share as u32 as u64) + (low >> 32);
        let words = (near * (self.share >> 32) + (middle >> 32)) << 32 | middle as u32 as u64;
        // The pulse's half is at most as much.
        let (words, low) = if edge.is_off == (side == 0) {
            let (low, carry) = (low as u32).overflowing_add(edge.rest);
            (words.wrapping_add(edge.half).wrapping_add(carry as u64), low)
        } else {
            let (low, borrow) = (low as u32).overflowing_sub(edge.rest);
            (words.saturating_sub(edge.half).saturating_sub(borrow as u64), low)
        };
        // The 64 bits from the first that is set ...
        let (words, low, down) =
            if words >> 32 == 0 { (words << 32 | low as u64, 0, 32) } else { (words, low, 0) };
        let zeros = words.leading_zeros() & 63;
        let bits = words << zeros | (low as u64) << zeros >> 32;
        // ... of which a pair takes 48.
        let [hi, lo] = [bits >> 40, bits >> 16 & 0xFF_FFFF].map(|half| half as u32 as f32);
        let unit = power_of_two(WHOLE_EXPONENT - 24 - down - zeros as i32);
        (side, Pair { hi: hi * unit, lo: lo * (unit / (1 << 24) as f32) })
    }

    /// The ends of a pulse that takes the part `duty`, above 0 and at most 1, of each share: when it goes on, and off.
    pub(crate) fn edges(&self, duty: f32) -> [Edge; 2] {
        let bits = duty.to_bits();
        let (significand, down) = (bits & 0x7F_FFFF | 1 << 23, 150 - (bits >> 23));
        // Below 2¹²⁰.
        let share = (self.share as u128) << 32 | self.rest as u128;
        let half = (share * significand as u128).checked_shr(down).unwrap_or(0);
        let edge = |is_off| Edge { half: (half >> 32) as u64, rest: half as u32, is_off };
        [edge(false), edge(true)]
    }
}

/// One end of a pulse: so far from the middle of its share, in units of 2⁻⁶⁴ and 2⁻⁹⁶, and on which side. A trigger is a pulse without
/// length.
#[derive(Clone, Copy)]
pub(crate) struct Edge {
    half: u64,
    rest: u32,
    is_off: bool,
}

impl Edge {
    const TRIGGER: Self = Self { half: 0, rest: 0, is_off: false };
}

/// What times the triggers of one frame.
#[derive(Clone)]
struct Times<'a, const CELLS: usize> {
    curve: &'a ShutterCurve<CELLS>,
    fractions: Fractions,
}

impl<const CELLS: usize> Times<'_, CELLS> {
    fn n(&self) -> u32 {
        self.fractions.n
    }

    /// The time of trigger `i`.
    #[inline(always)]
    fn at(&self, i: u32) -> f32 {
        let n = self.fractions.n;
        if n <= EXACT_HALVES {
            self.curve.inverse_cdf((i as f32 + 0.5) / n as f32)
        } else {
            place(&self.curve.plan, &self.fractions, 2 * i as u64 + 1, Edge::TRIGGER).time()
        }
    }
}

/// What places the triggers of one frame.
#[derive(Clone)]
pub(crate) struct Ticks<'a, const CELLS: usize> {
    plan: &'a Plan<CELLS>,
    pub(crate) fractions: Fractions,
    tick_hz: u32,
    plateau: Words,
    /// None for frames that are searched for throughout.
    direct: Option<Direct>,
}

impl<'a, const CELLS: usize> Ticks<'a, CELLS> {
    pub(crate) fn new(plan: &'a Plan<CELLS>, n: u32, tick_hz: u32) -> Result<Self, ScheduleError> {
        if tick_hz == 0 {
            return Err(ScheduleError::TickRateZero);
        }
        let start = plan.start_in_units(0);
        let length = (plan.start_in_units(1) - start) as u64;
        let exponent = exponent_of_ticks(length, tick_hz, plan.unit());
        if exponent > MOST_TICKS {
            return Err(too_high(length, tick_hz, plan.unit()));
        }
        let searched = n > DIRECT_TRIGGERS || exponent > DIRECT_TICKS;
        let direct = (!searched).then(|| Direct::new(start, length, tick_hz, plan.unit()));
        let (fractions, plateau) = (Fractions::new(n), plan.plateau_in_words());
        Ok(Self { plan, fractions, tick_hz, plateau, direct })
    }

    pub(crate) fn n(&self) -> u32 {
        self.fractions.n
    }

    /// The tick of trigger `i`, at the fraction `(2i + 1) / 2n`.
    #[inline(always)]
    fn at(&self, i: u32) -> u32 {
        match self.direct(i) {
            Some(tick) => tick,
            None => self.searched(2 * i as u64 + 1, Edge::TRIGGER),
        }
    }

    /// The tick of one end of a pulse around trigger `i`.
    pub(crate) fn at_edge(&self, i: u32, edge: Edge) -> u32 {
        let odd = 2 * i as u64 + 1;
        if let Some(direct) = &self.direct {
            let middle = self.fractions.share.wrapping_mul(odd);
            let u = if edge.is_off {
                middle.wrapping_add(edge.half)
            } else {
                middle.wrapping_sub(edge.half)
            };
            if let Some(time) = self.plan.direct_in_words(u, &self.plateau) {
                return direct.tick(time);
            }
        }
        self.searched(odd, edge)
    }

    /// The same frame for pulses that take the part `duty` of each share. If ends of pulses come too close for the polynomials, all are
    /// searched for.
    pub(crate) fn of_pulses(self, duty: f32) -> Self {
        let dark = if duty < 1.0 { 1.0 - duty } else { 1.0 };
        let closest = if duty < dark { duty } else { dark };
        let is_direct = self.fractions.n as f32 <= closest * DIRECT_TRIGGERS as f32;
        Self { direct: if is_direct { self.direct } else { None }, ..self }
    }

    /// The tick of trigger `i`, if no search is needed.
    #[inline(always)]
    fn direct(&self, i: u32) -> Option<u32> {
        let direct = self.direct.as_ref()?;
        // A frame of which some are direct has so few that this fits.
        let odd = i.wrapping_mul(2) | 1;
        let time = self.plan.direct_in_words(self.fractions.in_words(odd), &self.plateau)?;
        Some(direct.tick(time))
    }

    /// The error of trigger `i`, which comes too soon after the one before.
    #[cold]
    #[inline(never)]
    fn too_close(&self, i: u32, min_gap: u32) -> ScheduleError {
        let gap = self.at(i) - self.at(i.saturating_sub(1));
        ScheduleError::GapTooSmall { trigger: i, gap, min_gap }
    }

    /// The same by a search; out of line, so that the direct way saves no registers for it.
    #[cold]
    #[inline(never)]
    fn searched(&self, odd: u64, edge: Edge) -> u32 {
        let unit = self.plan.unit();
        let place = place(self.plan, &self.fractions, odd, edge);
        let delay = place.since(self.plan.exposure.start(0), unit);
        if let Some(direct) = &self.direct {
            // Rounded as the direct way rounds, so that neighbours keep their order.
            return direct.tick(direct.start + fixed(delay.hi, 0) + fixed(delay.lo, 0));
        }
        let Pair { hi, lo } = scaled(delay.times(Pair::from_u32(self.tick_hz)), unit);
        // A product's second half may be some ulp of the first.
        let ticks = Pair::sum(hi, lo);
        // What is above 2²⁴ in f32 has no fraction; what the second half adds to it is below 2⁸ then.
        let whole = ticks.hi as u32;
        let rest = (ticks.hi - whole as f32) + ticks.lo + 0.5;
        // The cast rounds down what is above 0.
        (whole + (rest + 256.0) as u32).saturating_sub(256)
    }
}

/// The place of the fraction `odd / 2n`, or of one end of a pulse around it, by a search.
#[inline(never)]
fn place<const CELLS: usize>(
    plan: &Plan<CELLS>,
    fractions: &Fractions,
    odd: u64,
    edge: Edge,
) -> Place {
    let (side, a) = fractions.exactly(odd, edge);
    if a.hi == 0.0 {
        // The end itself, though no light may fall there.
        let end = plan.exposure.start(side);
        return Place::on_way(end, end, false, Pair::ZERO, 0);
    }
    plan.exposure.at_fraction(side, a, FOR_TICK)
}

/// The least exponent of a power of two that a `length`, in units of `2^unit` of the curve's time, does not exceed in ticks.
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
struct Direct {
    start: i64,
    /// What brings a time after the start to 31 bits above 2³², and the ticks in a unit of these, which count 2⁻⁶⁴.
    up: u32,
    factor: u64,
}

impl Direct {
    /// For an interval that starts at `start` and is `length` long, in units of `2^unit`.
    fn new(start: i64, length: u64, tick_hz: u32, unit: i32) -> Self {
        // An `f32` interval has from 2³⁷ units to 2⁶².
        let up = length.leading_zeros().wrapping_sub(1) & 31;
        let down = unit + 96 - up as i32;
        let rate = tick_hz as u64;
        let factor = if down < 0 {
            rate.checked_shr(down.unsigned_abs())
        } else {
            rate.checked_shl(down.unsigned_abs())
        };
        // Where a tick is next to all of the interval, nothing is left of it, and all is tick 0, to which it rounds.
        Self { start, up: 1 << up, factor: factor.unwrap_or(0) }
    }

    #[inline(always)]
    fn tick(&self, time: i64) -> u32 {
        let delay = time.wrapping_sub(self.start);
        if delay < 0 {
            return 0;
        }
        let (high, low) = ((delay as u64 >> 32) as u32, delay as u32 as u64);
        let low = ((low * self.up as u64) >> 32) as u32;
        let delay = high.wrapping_mul(self.up).wrapping_add(low) as u64;
        let low = (delay * (self.factor as u32 as u64)) >> 32;
        ((delay * (self.factor >> 32) + low + (1 << 31)) >> 32) as u32
    }
}
