//! Pulses that get equal doses of a steady lamp through the shutter: on and off, as timer ticks.

use core::ops::Range;

use crate::error::ScheduleError;
use crate::frame::iterate;
use crate::shutter::ShutterCurve;
use crate::ticks::Ticks;

impl<const CELLS: usize> ShutterCurve<CELLS> {
    /// `n` pulses for a shutter in the light's path, as the ticks at which a steady lamp goes on and off. Through the
    /// shutter each lets the same dose, `duty · A / n`: it takes the part `duty`, above 0 and at most 1, out of the
    /// middle of its share of the exposure, from `F⁻¹((i + 1/2 - duty/2) / n)` to `F⁻¹((i + 1/2 + duty/2) / n)`. At 1
    /// they touch; they never overlap.
    ///
    /// Ticks are counted and rounded as [`trigger_ticks`](Self::trigger_ticks) does it, with the same accuracy, and
    /// `tick_hz` is the number of them in one unit of the curve's time. A pulse that is shorter than a tick may have
    /// its on and its off in the same one.
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, valid};
    /// // In seconds. Next to the ends, where the shutter is half closed, a pulse takes longer.
    /// static SHUTTER: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.002, 0.006, 0.008));
    /// let pulses: Vec<(u32, u32)> = SHUTTER.pulse_ticks(3, 0.5, 1_000_000)?.collect();
    /// assert_eq!(pulses, [(1414, 2500), (3500, 4500), (5500, 6586)]);
    /// # Ok::<(), shutter_curve::ScheduleError>(())
    /// ```
    ///
    /// # Errors
    /// A duty that is not above 0 and at most 1, and those of [`trigger_ticks`](Self::trigger_ticks).
    pub fn pulse_ticks(
        &self,
        n: u32,
        duty: f32,
        tick_hz: u32,
    ) -> Result<PulseTicks<'_, CELLS>, ScheduleError> {
        if !(duty > 0.0 && duty <= 1.0) {
            return Err(ScheduleError::DutyOutOfRange);
        }
        let frame = Pulses { ticks: Ticks::new(&self.plan, n, tick_hz)?, n, duty };
        Ok(PulseTicks { frame, left: 0..n })
    }

    /// A checked schedule of pulses: as many as `pulses` has places, at the ticks of
    /// [`pulse_ticks`](Self::pulse_ticks), none shorter than `min_pulse` ticks and none sooner than `min_gap` ticks
    /// after the one before has gone off.
    ///
    /// ```
    /// use shutter_curve::{ScheduleError, ShutterCurve, valid};
    /// static SHUTTER: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.002, 0.006, 0.008));
    /// let mut pulses = [(0, 0); 3];
    /// SHUTTER.pulses_into(&mut pulses, 0.5, 1_000_000, 1_000, 1_000)?;
    /// let error = SHUTTER.pulses_into(&mut pulses, 0.5, 1_000_000, 1_001, 1_000).unwrap_err();
    /// assert_eq!(error, ScheduleError::PulseTooShort { pulse: 1, length: 1_000, min_pulse: 1_001 });
    /// # Ok::<(), ScheduleError>(())
    /// ```
    ///
    /// # Errors
    /// A pulse or a gap that is too short, more places than `u32::MAX`, and those of
    /// [`pulse_ticks`](Self::pulse_ticks). The slice then holds a part of the schedule, and else what it held.
    pub fn pulses_into(
        &self,
        pulses: &mut [(u32, u32)],
        duty: f32,
        tick_hz: u32,
        min_pulse: u32,
        min_gap: u32,
    ) -> Result<(), ScheduleError> {
        let Ok(n) = u32::try_from(pulses.len()) else {
            return Err(ScheduleError::CapacityExceeded { capacity: u32::MAX });
        };
        let mut last: Option<u32> = None;
        for (i, (place, (on, off))) in
            (0..n).zip(pulses.iter_mut().zip(self.pulse_ticks(n, duty, tick_hz)?))
        {
            let length = off - on;
            if length < min_pulse {
                return Err(ScheduleError::PulseTooShort { pulse: i, length, min_pulse });
            }
            let gap = last.map_or(u32::MAX, |last| on.saturating_sub(last));
            if gap < min_gap {
                return Err(ScheduleError::GapTooSmall { trigger: i, gap, min_gap });
            }
            *place = (on, off);
            last = Some(off);
        }
        Ok(())
    }
}

/// The ticks at which a frame's pulses go on and off, of [`ShutterCurve::pulse_ticks`]: any of them in constant time,
/// from either end.
#[derive(Clone)]
pub struct PulseTicks<'a, const CELLS: usize = 8> {
    frame: Pulses<'a, CELLS>,
    left: Range<u32>,
}

/// What places the pulses of one frame.
#[derive(Clone)]
struct Pulses<'a, const CELLS: usize> {
    ticks: Ticks<'a, CELLS>,
    n: u32,
    duty: f32,
}

impl<const CELLS: usize> Pulses<'_, CELLS> {
    /// The ticks of pulse `i`. They are in order, and so are those of neighbours, since rounding keeps the order of
    /// `2i + 1 - duty` and `2i + 1 + duty`, and so does all that follows.
    fn at(&self, i: u32) -> (u32, u32) {
        (self.ticks.tick(i, -self.duty), self.ticks.tick(i, self.duty))
    }
}

iterate!(PulseTicks, (u32, u32));
