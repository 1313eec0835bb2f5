//! When to trigger: equal shares of the exposure, as timer ticks, as a checked schedule.

use core::ops::Range;

use crate::error::{ScheduleError, tried};
use crate::fraction::Side;
use crate::number::units::DOUBLE_WORD;
use crate::shutter::ShutterCurve;
use crate::trigger::iterator::iterate;
use crate::trigger::ticks::{MOST_TRIGGERS, Ticks};

impl<const OCTAVES: usize> ShutterCurve<OCTAVES> {
    /// Frames of up to this many triggers need no search: the plateau's line or a polynomial places each trigger. The
    /// README says how many cycles such a tick costs at most.
    ///
    /// It is at most 2²². With 8 octaves it is 127 or more on typical curves, and up to twice that for each octave more.
    /// It is 0 on curves too difficult for polynomials, and with `OCTAVES = 0` unless the middle of the exposure lies on
    /// the plateau.
    ///
    /// In a constant the compiler checks it:
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, valid};
    /// static SHUTTER: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// const _: () = assert!(SHUTTER.direct_triggers() >= 64);
    /// ```
    ///
    /// A frame that would need searches does not compile:
    ///
    /// ```compile_fail,E0080
    /// # use shutter_curve::{ShutterCurve, valid};
    /// # static SHUTTER: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// const _: () = assert!(SHUTTER.direct_triggers() >= 4096);
    /// ```
    #[must_use]
    pub const fn direct_triggers(&self) -> u32 {
        let [first, last] =
            [self.plan.least_direct(Side::Start), self.plan.least_direct(Side::End)];
        let least = if first > last { first } else { last };
        // The first and the last trigger are 1/2n from the ends, and 1/2n > least is needed, with a slack of 2⁻²⁴, as
        // fractions are rounded to `f32`. In 2⁻⁶⁴; saturating shows the compiler that the divisor is not 0.
        let most = (1 << 63) / ((least * DOUBLE_WORD) as u64).saturating_add(1 << 40);
        if most < MOST_TRIGGERS as u64 { most as u32 } else { MOST_TRIGGERS }
    }

    /// The `n` triggers that split the exposure evenly, each in the middle of its share, in ticks of a timer. They count
    /// from [`open_start`](Self::open_start), so add the timer's own base with `wrapping_add`, and never step back.
    ///
    /// Their times, in the curve's unit, are
    /// `(0..n).map(|i| curve.inverse_cdf((2 * i + 1) as f32 / (2 * n) as f32))`, up to 2²² of them.
    ///
    /// `ticks_per_unit` is the number of ticks in one unit of the curve's time: the timer's rate in Hz for a curve in
    /// seconds, a thousandth of it for one in ms. No error can tell a rate that was meant for another unit. **Seconds
    /// are recommended.**
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
    /// On typical curves each tick is within 0.8 tick of the exact time, in intervals of up to 2²⁴ ticks. In longer
    /// intervals an ulp may be many ticks: 8 were seen at 2²⁹, and 32 at 2³¹. On every curve the tick of trigger `i` is
    /// within 0.52 tick of the exact time of some fraction within one ulp of `u = (2i + 1) / 2n`. That is an ulp of `u`
    /// or of `1 - u`, whichever is less.
    ///
    /// # Errors
    /// A rate of 0, or one at which the interval has more than 2³¹ ticks; more than 2²² triggers.
    pub const fn trigger_ticks(
        &self,
        n: u32,
        ticks_per_unit: u32,
    ) -> Result<TriggerTicks<'_, OCTAVES>, ScheduleError> {
        let frame = tried!(Ticks::new(&self.plan, n, ticks_per_unit));
        Ok(TriggerTicks { frame, left: 0..n })
    }

    /// A checked schedule: as many triggers as `ticks` has places, at the ticks of
    /// [`trigger_ticks`](Self::trigger_ticks), no two closer than `min_gap_ticks`.
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
    /// A gap that is too small: then the slice holds a part of the schedule. The errors of
    /// [`trigger_ticks`](Self::trigger_ticks): then the slice is unchanged.
    pub const fn schedule_into(
        &self,
        ticks: &mut [u32],
        ticks_per_unit: u32,
        min_gap_ticks: u32,
    ) -> Result<(), ScheduleError> {
        if ticks.len() > MOST_TRIGGERS as usize {
            return Err(ScheduleError::TooManyTriggers { most: MOST_TRIGGERS });
        }
        let frame = tried!(Ticks::new(&self.plan, ticks.len() as u32, ticks_per_unit));
        let (mut i, mut last) = (0, 0);
        while i < ticks.len() {
            let tick = frame.at(i as u32);
            let gap = tick.saturating_sub(last);
            if i > 0 && gap < min_gap_ticks {
                let trigger = i as u32;
                return Err(ScheduleError::GapTooSmall { trigger, gap, min_gap: min_gap_ticks });
            }
            ticks[i] = tick;
            (i, last) = (i + 1, tick);
        }
        Ok(())
    }

    /// The schedule of [`schedule_into`](Self::schedule_into), as an array. In a constant, for a frame that never
    /// changes, the compiler checks it.
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, valid};
    /// static SHUTTER: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// const TICKS: [u32; 5] = match SHUTTER.ticks(1_000_000, 1_000) {
    ///     Ok(ticks) => ticks,
    ///     Err(_) => panic!("the gap is not kept"),
    /// };
    /// assert_eq!(TICKS, [1936, 3500, 5000, 6500, 8064]);
    /// ```
    ///
    /// # Errors
    /// Those of [`schedule_into`](Self::schedule_into).
    pub const fn ticks<const N: usize>(
        &self,
        ticks_per_unit: u32,
        min_gap_ticks: u32,
    ) -> Result<[u32; N], ScheduleError> {
        let mut ticks = [0; N];
        tried!(self.schedule_into(&mut ticks, ticks_per_unit, min_gap_ticks));
        Ok(ticks)
    }

    /// The schedule of [`schedule_into`](Self::schedule_into) for `n` triggers, as a `heapless::Vec`. It takes the
    /// feature `heapless-v0_9`.
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
        ticks_per_unit: u32,
        min_gap_ticks: u32,
    ) -> Result<heapless::Vec<u32, N>, ScheduleError> {
        let mut schedule = heapless::Vec::new();
        let fits = usize::try_from(n).is_ok_and(|n| schedule.resize(n, 0).is_ok());
        if !fits {
            return Err(ScheduleError::CapacityExceeded { capacity: N as u32 });
        }
        self.schedule_into(&mut schedule, ticks_per_unit, min_gap_ticks)?;
        Ok(schedule)
    }

    /// How many triggers, up to `wanted`, keep a gap of `min_gap_ticks`. If the answer is less than `wanted`, one more
    /// breaks the gap. The answer is at least 1, unless none are wanted.
    ///
    /// It places one frame after another, each up to the first gap that is too small: usually a few frames, at most
    /// `2 log2(wanted)`. For a gap of 0 it places none.
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
    pub const fn most_triggers(
        &self,
        wanted: u32,
        ticks_per_unit: u32,
        min_gap_ticks: u32,
    ) -> Result<u32, ScheduleError> {
        let mut frame = tried!(Ticks::new(&self.plan, wanted, ticks_per_unit));
        if wanted <= 1 || min_gap_ticks == 0 {
            return Ok(wanted);
        }
        // As many triggers as the exposure has gaps: next to the answer for a shutter that opens fully.
        let guess = ticks_per_unit as f32 / (self.normalization() * min_gap_ticks as f32);
        // First the whole frame, then the guess, then doubled steps and bisection. One trigger keeps any gap.
        let (mut keep, mut fail, mut n, mut step) = (1, wanted + 1, wanted, 0u32);
        while fail - keep > 1 {
            frame.n = n;
            let keeps = frame.keeps(min_gap_ticks);
            *(if keeps { &mut keep } else { &mut fail }) = n;
            n = if step == 0 {
                guess as u32
            } else if keeps {
                keep.saturating_add(step)
            } else {
                fail.saturating_sub(step)
            };
            if n <= keep || n >= fail {
                n = keep + (fail - keep) / 2;
            }
            step = step.saturating_mul(2) | 1;
        }
        Ok(keep)
    }
}

/// An iterator over the ticks of a frame's triggers, from [`ShutterCurve::trigger_ticks`]. It goes from either end, and
/// to any trigger at once.
///
/// If the curve is a `static`, a `static` can hold the iterator, too. An interrupt handler takes one tick after the
/// other from it:
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
pub struct TriggerTicks<'a, const OCTAVES: usize = 8> {
    pub(crate) frame: Ticks<'a, OCTAVES>,
    left: Range<u32>,
}

iterate!(TriggerTicks, u32);
