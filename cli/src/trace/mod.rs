//! A measured trace: how its file is read, what is wrong with it, and where its pulses are.

mod pulse;
mod read;
mod samples;
mod told;

pub use pulse::{Frame, Light, Pulses, pulses};
pub use read::{Column, Options, decode, read};
pub use samples::Trace;
pub use told::{Refusal, Warning};
