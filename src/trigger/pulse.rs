//! Pulses of a steady lamp that send equal light through the shutter: on and off, as timer ticks.

use crate::error::ScheduleError;
use crate::trigger::ticks::Frame;

/// The ticks at which a pulse starts and ends. They count from [`open_start`](crate::ShutterCurve::open_start).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Pulse {
    /// The tick at which the lamp goes on.
    pub on: u32,
    /// The tick at which the lamp goes off.
    pub off: u32,
}

/// What places the pulses of one frame.
#[derive(Clone)]
pub(crate) struct Pulses<'a, const OCTAVES: usize> {
    frame: Frame<'a, OCTAVES>,
    duty: f32,
}

impl<'a, const OCTAVES: usize> Pulses<'a, OCTAVES> {
    pub(crate) const fn new(frame: Frame<'a, OCTAVES>, duty: f32) -> Result<Self, ScheduleError> {
        if duty > 0.0 && duty <= 1.0 { Ok(Self { frame, duty }) } else { Err(ScheduleError::DutyOutOfRange) }
    }

    /// Pulse `i`. Its ends are in order, and so are neighbouring pulses, since rounding keeps the order of
    /// `2i + 1 - duty` and `2i + 1 + duty`, and so does all that follows.
    pub(crate) const fn at(&self, i: u32) -> Pulse {
        Pulse { on: self.frame.tick_at(i, -self.duty), off: self.frame.tick_at(i, self.duty) }
    }

    /// Are all pulses and gaps long enough?
    #[inline(never)]
    pub(crate) const fn check(&self, min_gap: u32, min_pulse: u32) -> Result<(), ScheduleError> {
        self.fill(&mut [], min_gap, min_pulse)
    }

    /// Checks that all pulses and gaps are long enough, and stores the pulses where the slice has places for them.
    #[inline(always)]
    pub(crate) const fn fill(&self, pulses: &mut [Pulse], min_gap: u32, min_pulse: u32) -> Result<(), ScheduleError> {
        let (mut i, mut last) = (0, 0);
        while i < self.frame.n {
            let pulse = self.at(i);
            let length = pulse.off.saturating_sub(pulse.on);
            if length < min_pulse {
                return Err(ScheduleError::PulseTooShort { pulse: i, length, min_pulse });
            }
            let gap = pulse.on.saturating_sub(last);
            if i > 0 && gap < min_gap {
                return Err(ScheduleError::PulsesTooClose { pulse: i, gap, min_gap });
            }
            if (i as usize) < pulses.len() {
                pulses[i as usize] = pulse;
            }
            (i, last) = (i + 1, pulse.off);
        }
        Ok(())
    }
}
