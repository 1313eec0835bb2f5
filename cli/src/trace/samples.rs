//! The trace itself.

/// No time and no signal is larger than this: squares and sums of them stay far from the end of `f64`.
pub const LARGEST: f64 = 1e30;

/// A signal over time: seconds, in order, no two the same; values in the file's own unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// In seconds.
    pub times: Vec<f64>,
    /// As measured.
    pub values: Vec<f64>,
}
