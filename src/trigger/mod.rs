//! Triggers and pulses: the ticks of a timer at which equal shares of the exposure are due.

pub(crate) mod iterator;
pub(crate) mod pulse;
pub(crate) mod ticks;
pub(crate) mod timed;
