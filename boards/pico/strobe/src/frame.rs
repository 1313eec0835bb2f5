//! From settings to the words that the state machine reads.

use shutter_curve::ScheduleError;

use crate::change::Refused;
use crate::limits::{LONGEST_FRAME, MIN_LOW, MIN_PULSE, TICK_HZ};
use crate::settings::Settings;

/// With room for one pulse too many, which only a planted fault asks for.
const CAPACITY: usize = 1 + 2 * (LONGEST_FRAME + 1);

/// A planned frame: the number of pulses less 1, and for each pulse its length and the time before it, both less what
/// the program takes anyway. `firmware/src/output.rs` has the program.
pub struct Frame {
    words: [u32; CAPACITY],
    length: usize,
}

impl Frame {
    /// A frame that is yet to be planned.
    pub const EMPTY: Self = Self { words: [0; CAPACITY], length: 0 };

    /// What the state machine is to read.
    pub fn words(&self) -> &[u32] {
        &self.words[..self.length]
    }

    /// Plans the frame anew, whatever it was.
    ///
    /// # Errors
    /// Too many pulses, or pulses too close to each other; the frame is empty then.
    pub fn plan(&mut self, settings: &Settings) -> Result<(), Refused> {
        self.length = 0;
        let mut ticks = [0; LONGEST_FRAME + 1];
        let n = settings.pulses as usize;
        let Some(planned) = ticks[..LONGEST_FRAME].get_mut(..n) else {
            let capacity = LONGEST_FRAME as u32;
            return Err(Refused::Schedule(ScheduleError::CapacityExceeded { capacity }));
        };
        let gap = settings.gap.max(settings.length.saturating_add(MIN_LOW));
        let curve = settings.curve.get();
        curve.schedule_into(planned, TICK_HZ, gap).map_err(|error| match error {
            ScheduleError::GapTooSmall { .. } => {
                match curve.most_triggers(settings.pulses, TICK_HZ, gap) {
                    Ok(most) => Refused::Gap { error, most },
                    Err(error) => Refused::Schedule(error),
                }
            }
            _ => Refused::Schedule(error),
        })?;
        #[cfg(feature = "faults")]
        let n = crate::fault::spoil(&mut ticks, n, settings.length);

        self.push(n as u32 - 1);
        // The state machine counts from the end of one pulse to the start of the next.
        let mut ready = 0;
        for tick in &ticks[..n] {
            self.push(settings.length - MIN_PULSE);
            self.push(tick - ready);
            // It is beyond the counter after the last pulse at most: the others keep the gap.
            ready = tick.saturating_add(settings.length).saturating_add(MIN_LOW);
        }
        Ok(())
    }

    fn push(&mut self, word: u32) {
        self.words[self.length] = word;
        self.length += 1;
    }
}
