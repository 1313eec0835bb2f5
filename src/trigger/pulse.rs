//! Pulses that get equal doses of a steady lamp through the shutter: on and off, as timer ticks.

use crate::error::{ScheduleError, tried};
use crate::inverse::Inverse;
use crate::trigger::ticks::Ticks;

/// The ticks at which a pulse starts and ends. They count from [`open_start`](crate::ShutterCurve::open_start).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Pulse {
    /// The tick at which the lamp goes on.
    pub on: u32,
    /// The tick at which the lamp goes off.
    pub off: u32,
}

/// The shortest pulse and gap that a lamp allows, in ticks. 0 allows any.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PulseLimits {
    /// The minimum length of a pulse.
    pub min_pulse: u32,
    /// The minimum time from the end of a pulse to the start of the next.
    pub min_gap: u32,
}

/// What places the pulses of one frame.
#[derive(Clone)]
pub(crate) struct Pulses<'a, const OCTAVES: usize> {
    ticks: Ticks<'a, OCTAVES>,
    duty: f32,
}

impl<'a, const OCTAVES: usize> Pulses<'a, OCTAVES> {
    pub(crate) const fn new(
        inverse: &'a Inverse<OCTAVES>,
        n: u32,
        duty: f32,
        timer_hz: u32,
    ) -> Result<Self, ScheduleError> {
        if !(duty > 0.0 && duty <= 1.0) {
            return Err(ScheduleError::DutyOutOfRange);
        }
        Ok(Self { ticks: tried!(Ticks::new(inverse, n, timer_hz)), duty })
    }

    /// Pulse `i`. Its ends are in order, and so are neighbouring pulses, since rounding keeps the order of
    /// `2i + 1 - duty` and `2i + 1 + duty`, and so does all that follows.
    pub(crate) const fn at(&self, i: u32) -> Pulse {
        Pulse { on: self.ticks.around(i, -self.duty), off: self.ticks.around(i, self.duty) }
    }

    /// All pulses, as many as the slice has places; an error at the first pulse or gap that is too short.
    pub(crate) const fn pulses_into(
        &self,
        pulses: &mut [Pulse],
        PulseLimits { min_pulse, min_gap }: PulseLimits,
    ) -> Result<(), ScheduleError> {
        let (mut i, mut last) = (0, 0);
        while i < pulses.len() {
            let pulse = self.at(i as u32);
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
