//! A measured trace: how its file is read, what is wrong with it, and where its pulses are.

mod pulse;
mod read;
mod told;

pub use pulse::{Frame, Light, Pulses, pulses};
pub use read::{Column, Options, decode, read};
pub use told::{Refusal, Warning};

/// No time and no signal is larger than this: squares and sums of them stay far from the end of `f64`.
const LARGEST: f64 = 1e30;

/// A signal over time: seconds, in order, no two the same; values in the file's own unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// In seconds.
    pub times: Vec<f64>,
    /// As measured.
    pub values: Vec<f64>,
}
