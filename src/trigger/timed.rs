//! A curve on a timer, which plans frames of triggers or pulses.

use crate::error::{ScheduleError, tried};
use crate::inverse::Inverse;
use crate::rate::Hz;
use crate::trigger::iterator::{PulseTicks, TriggerTicks};
use crate::trigger::pulse::{Pulse, Pulses};
use crate::trigger::ticks::{Frame, MOST_TRIGGERS, TickScale};

/// A curve on a timer of a known rate, from [`ShutterCurve::at`](crate::ShutterCurve::at): it plans frames of triggers
/// and pulses, in the timer's ticks.
///
/// Ticks count from the curve's `open_start`. Add your timer's count at that moment, with `wrapping_add`.
///
/// *Triggers* divide the exposure into equal shares, and each is in the middle of its share: trigger `i` of `n` is at
/// the fraction `u = (2i + 1) / (2n)`. Use them while the camera's own shutter stays open.
///
/// *Pulses* are for a steady lamp that shines through this shutter. All send the same light through it: each covers
/// the fraction `duty` of its share, in the middle. Pulse `i` starts at `u = (i + 1/2 - duty/2) / n` and ends at
/// `u = (i + 1/2 + duty/2) / n`. Where the shutter is partly open, a pulse lasts longer.
///
/// Ticks never decrease, and pulses never overlap. If a typical curve has at most 2²⁴ ticks, each trigger is within
/// 0.85 tick of the exact time. On longer curves the error can be many ticks: 8 were seen at 2²⁹ ticks, and 32 at 2³¹.
/// [`accuracy`](crate::accuracy) has a promise for every curve.
///
/// # Checks
///
/// A frame keeps [`min_gap`](Self::min_gap) and [`min_pulse`](Self::min_pulse). Both are 1 tick unless you set them:
/// two triggers on one tick, or an empty pulse, often mean that the rate is wrong. A frame has at most 2²² triggers or
/// pulses. A frame that breaks a rule is refused with a [`ScheduleError`], whose text names the trigger or pulse and
/// what to change.
///
/// ```
/// use shutter_curve::{Hz, ScheduleError, ShutterCurve, TimedCurve, expect};
/// static SHUTTER: ShutterCurve = expect!(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
/// // A lamp that needs 1 ms between two flashes, on a timer that counts µs.
/// const FLASH: TimedCurve = expect!(SHUTTER.at(Hz(1_000_000))).min_gap(1_000);
/// const TICKS: [u32; 5] = expect!(FLASH.ticks());
/// assert_eq!(TICKS, [1936, 3500, 5000, 6500, 8064]);
/// // Sixteen are too many.
/// let error = FLASH.ticks::<16>().unwrap_err();
/// assert_eq!(error, ScheduleError::GapTooSmall { trigger: 1, gap: 792, min_gap: 1_000 });
/// assert_eq!(FLASH.max_triggers(16), 7);
/// ```
#[derive(Clone, Copy)]
pub struct TimedCurve<'a, const OCTAVES: usize = 8> {
    inverse: &'a Inverse<OCTAVES>,
    scale: TickScale,
    /// The exposure in ticks, rounded down with a margin: never more than the true one.
    exposure_ticks: u32,
    min_gap: u32,
    min_pulse: u32,
}

impl<'a, const OCTAVES: usize> TimedCurve<'a, OCTAVES> {
    pub(crate) const fn new(inverse: &'a Inverse<OCTAVES>, rate: Hz, exposure: f32) -> Result<Self, ScheduleError> {
        let scale = tried!(TickScale::new(inverse, rate));
        // Relative errors: 2⁻²³ of `exposure`, and 2⁻²⁴ of the rate and of each product. 3 · 2⁻²³ is more than all.
        let exposure_ticks = (exposure * rate.0 as f32 * (1.0 - 3.0 / (1 << 23) as f32)) as u32;
        Ok(Self { inverse, scale, exposure_ticks, min_gap: 1, min_pulse: 1 })
    }

    /// Sets the minimum gap between two triggers, and from the end of a pulse to the start of the next, in ticks. With
    /// 0, triggers may share a tick, and pulses may touch.
    #[must_use]
    pub const fn min_gap(mut self, ticks: u32) -> Self {
        self.min_gap = ticks;
        self
    }

    /// Sets the minimum length of a pulse, in ticks. With 0, a pulse may start and end at the same tick.
    #[must_use]
    pub const fn min_pulse(mut self, ticks: u32) -> Self {
        self.min_pulse = ticks;
        self
    }

    /// The tick at which the shutter is closed, at most 2³¹. No trigger or pulse is later.
    ///
    /// A 16-bit timer can tell whether a tick is still to come if this is at most 2¹⁵. A constant can check that:
    /// `const _: () = assert!(FLASH.length() <= 1 << 15);`
    #[must_use]
    pub const fn length(&self) -> u32 {
        self.scale.length(self.inverse)
    }

    /// The ticks of a frame of `n` triggers, as an iterator.
    ///
    /// Often the exposure alone shows that `n` triggers keep the gap. Otherwise the call computes the whole frame to
    /// check it, as [`ticks_into`](Self::ticks_into) does.
    ///
    /// # Errors
    /// Returns a [`ScheduleError`] if `n` is above 2²², or if a gap is too small.
    pub const fn trigger_ticks(&self, n: u32) -> Result<TriggerTicks<'a, OCTAVES>, ScheduleError> {
        let frame = tried!(self.frame(n));
        if !self.surely_keep(self.exposure_ticks, n, self.min_gap) {
            tried!(frame.check(self.min_gap));
        }
        Ok(TriggerTicks { frame, left: 0..n })
    }

    /// Fills `ticks` with the ticks of a frame: as many triggers as it has places.
    ///
    /// # Errors
    /// Returns a [`ScheduleError`] if there are more than 2²² places, or if a gap is too small. In the latter case, the
    /// slice holds part of the frame.
    pub const fn ticks_into(&self, ticks: &mut [u32]) -> Result<(), ScheduleError> {
        let frame = tried!(self.frame(saturated(ticks.len())));
        frame.fill(ticks, self.min_gap)
    }

    /// The ticks of a frame of `N` triggers, as an array.
    ///
    /// # Errors
    /// Returns the errors of [`ticks_into`](Self::ticks_into).
    pub const fn ticks<const N: usize>(&self) -> Result<[u32; N], ScheduleError> {
        let mut ticks = [0; N];
        tried!(self.ticks_into(&mut ticks));
        Ok(ticks)
    }

    /// The ticks of a frame of `n` triggers, in a `heapless::Vec`. This needs the feature `heapless-v0_9`.
    ///
    /// # Errors
    /// Returns a [`ScheduleError`] if `n` is above `N`, and the errors of [`ticks_into`](Self::ticks_into).
    #[cfg(feature = "heapless-v0_9")]
    pub fn ticks_vec<const N: usize>(&self, n: u32) -> Result<heapless::Vec<u32, N>, ScheduleError> {
        let mut ticks = heapless::Vec::new();
        let fits = usize::try_from(n).is_ok_and(|n| ticks.resize(n, 0).is_ok());
        if !fits {
            return Err(ScheduleError::TooMany {
                max: if N < MOST_TRIGGERS as usize { N as u32 } else { MOST_TRIGGERS },
            });
        }
        self.ticks_into(&mut ticks)?;
        Ok(ticks)
    }

    /// A number of triggers, up to `wanted`, that keep the gap. If it is below both `wanted` and 2²², one more would
    /// not keep the gap. It is 0 only if `wanted` is 0.
    ///
    /// If ticks are coarse, a smaller number may break the gap, and a number larger by two or more may keep it.
    ///
    /// Often the exposure alone shows that `wanted` triggers keep the gap. Otherwise the call computes at most 23
    /// frames to find the number.
    #[must_use]
    pub const fn max_triggers(&self, wanted: u32) -> u32 {
        let wanted = if wanted < MOST_TRIGGERS { wanted } else { MOST_TRIGGERS };
        let sure = self.exposure_ticks / self.room(self.min_gap);
        if wanted <= 1 || wanted <= sure || self.min_gap == 0 {
            return wanted;
        }
        // First all that are wanted, then by bisection. One trigger keeps any gap.
        let (mut keep, mut fail, mut n) = (if sure > 1 { sure } else { 1 }, wanted + 1, wanted);
        while fail - keep > 1 {
            let keeps = matches!(self.frame(n), Ok(frame) if frame.check(self.min_gap).is_ok());
            *(if keeps { &mut keep } else { &mut fail }) = n;
            n = keep + (fail - keep) / 2;
        }
        keep
    }

    /// A frame of `n` pulses, as an iterator. With a duty of 1, they touch; this needs a
    /// [`min_gap`](Self::min_gap) of 0.
    ///
    /// Often the exposure alone shows that `n` pulses are long and far enough apart. Otherwise the call computes the
    /// whole frame to check it, as [`pulses_into`](Self::pulses_into) does.
    ///
    /// # Errors
    /// Returns a [`ScheduleError`] if the duty is NaN, 0 or less, or above 1, if `n` is above 2²², or if a pulse or a
    /// gap is too short.
    pub const fn pulse_ticks(&self, n: u32, duty: f32) -> Result<PulseTicks<'a, OCTAVES>, ScheduleError> {
        let frame = tried!(self.pulse_frame(n, duty));
        let lit = (self.exposure_ticks as f32 * duty) as u32;
        let dark = (self.exposure_ticks as f32 * (1.0 - duty)) as u32;
        if !(self.surely_keep(lit, n, self.min_pulse) && self.surely_keep(dark, n, self.min_gap)) {
            tried!(frame.check(self.min_gap, self.min_pulse));
        }
        Ok(PulseTicks { frame, left: 0..n })
    }

    /// Fills `pulses` with a frame: as many pulses as it has places.
    ///
    /// # Errors
    /// Returns a [`ScheduleError`] if the duty is out of range, if there are more than 2²² places, or if a pulse or a
    /// gap is too short. In the last case, the slice holds part of the frame.
    pub const fn pulses_into(&self, pulses: &mut [Pulse], duty: f32) -> Result<(), ScheduleError> {
        let frame = tried!(self.pulse_frame(saturated(pulses.len()), duty));
        frame.fill(pulses, self.min_gap, self.min_pulse)
    }

    /// A frame of `N` pulses, as an array.
    ///
    /// ```
    /// use shutter_curve::{Hz, Pulse, ShutterCurve, TimedCurve, expect};
    /// static SHUTTER: ShutterCurve = expect!(ShutterCurve::linear(0.0, 0.002, 0.006, 0.008));
    /// const LAMP: TimedCurve = expect!(SHUTTER.at(Hz(1_000_000))).min_gap(1_000).min_pulse(1_000);
    /// const PULSES: [Pulse; 3] = expect!(LAMP.pulses(0.5));
    /// // Where the shutter is partly closed, a pulse lasts longer.
    /// assert_eq!(PULSES[..2], [Pulse { on: 1414, off: 2500 }, Pulse { on: 3500, off: 4500 }]);
    /// ```
    ///
    /// # Errors
    /// Returns the errors of [`pulses_into`](Self::pulses_into).
    pub const fn pulses<const N: usize>(&self, duty: f32) -> Result<[Pulse; N], ScheduleError> {
        let mut pulses = [Pulse { on: 0, off: 0 }; N];
        tried!(self.pulses_into(&mut pulses, duty));
        Ok(pulses)
    }

    const fn frame(&self, n: u32) -> Result<Frame<'a, OCTAVES>, ScheduleError> {
        Frame::new(self.inverse, self.scale, n)
    }

    const fn pulse_frame(&self, n: u32, duty: f32) -> Result<Pulses<'a, OCTAVES>, ScheduleError> {
        Pulses::new(tried!(self.frame(n)), duty)
    }

    /// How many ticks of exposure each trigger needs, so that the next is surely `least` later.
    ///
    /// Of these 1.04 ticks may be lost by rounding two, and one by what the shift cuts; and of `exposure_ticks` 2⁻²¹:
    /// by two ulp of a fraction at two ends 2⁻²² (accuracy.md), by rounding it, `1 - duty` and their product 3 · 2⁻²⁴.
    const fn room(&self, least: u32) -> u32 {
        least.saturating_add(3 + (self.exposure_ticks >> 21))
    }

    /// Are `least` ticks kept by each of `n` equal shares of a `part` of the exposure, whatever the curve? Openness is
    /// at most 1, so a share takes `part / n` ticks or more.
    const fn surely_keep(&self, part: u32, n: u32, least: u32) -> bool {
        n == 0 || least == 0 || part / n >= self.room(least)
    }
}

const fn saturated(n: usize) -> u32 {
    if (n as u64) < u32::MAX as u64 { n as u32 } else { u32::MAX }
}

impl<const OCTAVES: usize> core::fmt::Debug for TimedCurve<'_, OCTAVES> {
    fn fmt(&self, out: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let mut out = out.debug_struct("TimedCurve");
        let out = out.field("length", &self.length()).field("min_gap", &self.min_gap);
        out.field("min_pulse", &self.min_pulse).finish_non_exhaustive()
    }
}

#[cfg(feature = "defmt")]
impl<const OCTAVES: usize> defmt::Format for TimedCurve<'_, OCTAVES> {
    fn format(&self, out: defmt::Formatter<'_>) {
        let (length, gap, pulse) = (self.length(), self.min_gap, self.min_pulse);
        defmt::write!(out, "TimedCurve {{ length: {}, min_gap: {}, min_pulse: {}, .. }}", length, gap, pulse);
    }
}
