//! From settings to the words that the state machine reads.

use shutter_curve::{Pulse, ScheduleError};

use crate::limits::{LATEST, LONGEST_FRAME, MIN_LOW, MIN_PULSE, MOST_PULSES, TICK_HZ};
use crate::refused::Refused;
use crate::settings::{Edge, Light, Settings};

/// With room for one pulse too many, which only a planted fault asks for.
const CAPACITY: usize = 1 + 2 * (MOST_PULSES + 1);

/// What one edge starts, planned: the number of pulses less 1, and for each pulse its length and the time before it, both less
/// what the program takes anyway. `firmware/src/output.rs` has the program.
pub struct Frame {
    words: [u32; CAPACITY],
    length: usize,
    edge: Edge,
}

impl Frame {
    /// A frame that is yet to be planned.
    pub const EMPTY: Self = Self { words: [0; CAPACITY], length: 0, edge: Edge::Rising };

    /// What the state machine is to read.
    pub fn words(&self) -> &[u32] {
        &self.words[..self.length]
    }

    /// The edge that it waits for.
    pub fn edge(&self) -> Edge {
        self.edge
    }

    /// Plans the frame anew, whatever it was.
    ///
    /// # Errors
    /// Too many pulses, or pulses too close to each other or too late; the frame is empty then.
    pub fn plan(&mut self, settings: &Settings) -> Result<(), Refused> {
        self.length = 0;
        let mut pulses = [Pulse::default(); LONGEST_FRAME + 1];
        let n = settings.pulses as usize;
        let Some(planned) = pulses[..LONGEST_FRAME].get_mut(..n) else {
            let capacity = LONGEST_FRAME as u32;
            return Err(Refused::Schedule(ScheduleError::CapacityExceeded { capacity }));
        };
        let count = settings.frames.count as usize;
        if count.checked_mul(n).is_none_or(|all| all > MOST_PULSES) {
            return Err(Refused::TooMany);
        }
        place(planned, settings)?;
        check_frames(planned, settings)?;
        #[cfg(feature = "faults")]
        let n = crate::fault::spoil(&mut pulses, n);

        self.edge = settings.edge;
        self.push((count * n) as u32 - 1);
        // The state machine counts from the end of one pulse to the start of the next.
        let mut ready = 0;
        for frame in 0..u64::from(settings.frames.count) {
            let base = u64::from(settings.delay) + frame * u64::from(settings.frames.period);
            for &Pulse { on, off } in &pulses[..n] {
                let start = base + u64::from(on);
                self.push(off - on - MIN_PULSE);
                // Not more than 2³¹, for that was checked.
                self.push(start.saturating_sub(ready) as u32);
                ready = start + u64::from(off - on) + u64::from(MIN_LOW);
            }
        }
        Ok(())
    }

    fn push(&mut self, word: u32) {
        self.words[self.length] = word;
        self.length += 1;
    }
}

/// The pulses of one frame, as many as there are places.
fn place(pulses: &mut [Pulse], settings: &Settings) -> Result<(), Refused> {
    let curve = settings.curve.get();
    match settings.light {
        Light::Equal(length) => {
            let mut ticks = [0; LONGEST_FRAME];
            let ticks = &mut ticks[..pulses.len()];
            let gap = settings.gap.max(length.saturating_add(MIN_LOW));
            curve.ticks_into(ticks, TICK_HZ, gap).map_err(|error| match error {
                ScheduleError::GapTooSmall { .. } => {
                    match curve.most_triggers(settings.pulses, TICK_HZ, gap) {
                        Ok(most) => Refused::Gap { error, most },
                        Err(error) => Refused::Schedule(error),
                    }
                }
                _ => Refused::Schedule(error),
            })?;
            for (pulse, &mut on) in pulses.iter_mut().zip(ticks) {
                // The last one may end beyond all ticks; no other does, for it keeps the gap.
                *pulse = Pulse { on, off: on.checked_add(length).ok_or(Refused::TooLate)? };
            }
            Ok(())
        }
        Light::Doses(duty) => {
            let gap = settings.gap.max(MIN_LOW);
            curve.pulses_into(pulses, duty, TICK_HZ, shutter_curve::PulseLimits { min_pulse: MIN_PULSE, min_gap: gap }).map_err(Refused::Schedule)
        }
    }
}

/// From frame to frame the same gap is kept as within them, and the last pulse is not too late.
fn check_frames(pulses: &[Pulse], settings: &Settings) -> Result<(), Refused> {
    let (Some(first), Some(last)) = (pulses.first(), pulses.last()) else { return Ok(()) };
    let frames = settings.frames;
    let after = u64::from(frames.count - 1) * u64::from(frames.period);
    if u64::from(settings.delay) + after + u64::from(last.on) > LATEST {
        return Err(Refused::TooLate);
    }
    let busy = match settings.light {
        Light::Equal(length) => {
            u64::from(last.on) + u64::from(settings.gap).max(u64::from(length) + u64::from(MIN_LOW))
        }
        Light::Doses(_) => u64::from(last.off) + u64::from(settings.gap.max(MIN_LOW)),
    };
    let least = busy.saturating_sub(u64::from(first.on));
    match frames.count > 1 && u64::from(frames.period) < least {
        true => Err(Refused::Overlap { least }),
        false => Ok(()),
    }
}
