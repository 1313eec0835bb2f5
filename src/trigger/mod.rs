//! Triggers and pulses: the ticks of a timer at which equal shares of the exposure are due.

mod iterator;
mod pulse;
mod schedule;
pub(crate) mod ticks;

pub use pulse::{Pulse, PulseTicks};
pub use schedule::TriggerTicks;
