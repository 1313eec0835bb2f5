//! Pulses that get equal doses of a steady lamp through the shutter: on and off, as timer ticks.

use core::ops::Range;

use crate::error::{ScheduleError, tried};
use crate::shutter::ShutterCurve;
use crate::trigger::iterator::iterate;
use crate::trigger::ticks::{MOST_TRIGGERS, Ticks};

/// The ticks at which a pulse goes on and off, counted from the start of opening.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Pulse {
    /// When it goes on.
    pub on: u32,
    /// When it goes off.
    pub off: u32,
}

impl<const OCTAVES: usize> ShutterCurve<OCTAVES> {
    /// `n` pulses for a shutter in the light's path, as the ticks at which a steady lamp goes on and off. Each sends
    /// the same dose through the shutter, `duty · A / n`. A pulse lights the middle of its share of the exposure, the
    /// part `duty` of it (above 0, at most 1): from `F⁻¹((i + 1/2 - duty/2) / n)` to `F⁻¹((i + 1/2 + duty/2) / n)`.
    ///
    /// Pulses are in order, never overlap, and none has a negative length; at a duty of 1 they touch. A pulse that is
    /// shorter than a tick may go on and off at the same one. Ticks are counted and rounded as
    /// [`trigger_ticks`](Self::trigger_ticks) does it, but the fraction of a pulse's end may be off by two ulp.
    ///
    /// ```
    /// use shutter_curve::{Pulse, ShutterCurve, valid};
    /// // In seconds. Next to the ends, where the shutter is half closed, a pulse takes longer.
    /// static SHUTTER: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.002, 0.006, 0.008));
    /// let pulses: Vec<Pulse> = SHUTTER.pulse_ticks(3, 0.5, 1_000_000)?.collect();
    /// assert_eq!(pulses[0], Pulse { on: 1414, off: 2500 });
    /// assert_eq!(pulses[1], Pulse { on: 3500, off: 4500 });
    /// # Ok::<(), shutter_curve::ScheduleError>(())
    /// ```
    ///
    /// # Errors
    /// A duty of 0 or less, above 1, or NaN; and those of [`trigger_ticks`](Self::trigger_ticks).
    pub const fn pulse_ticks(
        &self,
        n: u32,
        duty: f32,
        ticks_per_unit: u32,
    ) -> Result<PulseTicks<'_, OCTAVES>, ScheduleError> {
        if !(duty > 0.0 && duty <= 1.0) {
            return Err(ScheduleError::DutyOutOfRange);
        }
        let ticks = tried!(Ticks::new(&self.plan, n, ticks_per_unit));
        Ok(PulseTicks { frame: Pulses { ticks, duty }, left: 0..n })
    }

    /// A checked schedule of pulses: as many as `pulses` has places, at the ticks of
    /// [`pulse_ticks`](Self::pulse_ticks), none shorter than `min_pulse_ticks` and none sooner than `min_gap_ticks`
    /// after the one before has gone off.
    ///
    /// ```
    /// use shutter_curve::{Pulse, ScheduleError, ShutterCurve, valid};
    /// static SHUTTER: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.002, 0.006, 0.008));
    /// let mut pulses = [Pulse::default(); 3];
    /// SHUTTER.pulses_into(&mut pulses, 0.5, 1_000_000, 1_000, 1_000)?;
    /// let error = SHUTTER.pulses_into(&mut pulses, 0.5, 1_000_000, 1_001, 1_000).unwrap_err();
    /// assert_eq!(error, ScheduleError::PulseTooShort { pulse: 1, length: 1_000, min_pulse: 1_001 });
    /// # Ok::<(), ScheduleError>(())
    /// ```
    ///
    /// # Errors
    /// A pulse or a gap that is too short: then the slice holds a part of the schedule. The errors of
    /// [`pulse_ticks`](Self::pulse_ticks): then the slice is unchanged.
    pub const fn pulses_into(
        &self,
        pulses: &mut [Pulse],
        duty: f32,
        ticks_per_unit: u32,
        min_pulse_ticks: u32,
        min_gap_ticks: u32,
    ) -> Result<(), ScheduleError> {
        if pulses.len() > MOST_TRIGGERS as usize {
            return Err(ScheduleError::TooManyTriggers { most: MOST_TRIGGERS });
        }
        let (n, min_pulse, min_gap) = (pulses.len() as u32, min_pulse_ticks, min_gap_ticks);
        let PulseTicks { frame, .. } = tried!(self.pulse_ticks(n, duty, ticks_per_unit));
        let (mut i, mut last) = (0, 0);
        while i < pulses.len() {
            let pulse = frame.at(i as u32);
            let length = pulse.off.saturating_sub(pulse.on);
            if length < min_pulse {
                return Err(ScheduleError::PulseTooShort { pulse: i as u32, length, min_pulse });
            }
            let gap = pulse.on.saturating_sub(last);
            if i > 0 && gap < min_gap {
                return Err(ScheduleError::PulsesTooClose { pulse: i as u32, gap, min_gap });
            }
            pulses[i] = pulse;
            (i, last) = (i + 1, pulse.off);
        }
        Ok(())
    }
}

/// An iterator over a frame's pulses, from [`ShutterCurve::pulse_ticks`]. It goes from either end, and to any pulse at
/// once.
#[derive(Clone)]
pub struct PulseTicks<'a, const OCTAVES: usize = 8> {
    frame: Pulses<'a, OCTAVES>,
    left: Range<u32>,
}

/// What places the pulses of one frame.
#[derive(Clone)]
struct Pulses<'a, const OCTAVES: usize> {
    ticks: Ticks<'a, OCTAVES>,
    duty: f32,
}

impl<const OCTAVES: usize> Pulses<'_, OCTAVES> {
    /// Pulse `i`. Its ends are in order, and so are neighbouring pulses, since rounding keeps the order of
    /// `2i + 1 - duty` and `2i + 1 + duty`, and so does all that follows.
    const fn at(&self, i: u32) -> Pulse {
        Pulse { on: self.ticks.around(i, -self.duty), off: self.ticks.around(i, self.duty) }
    }
}

iterate!(PulseTicks, Pulse);
