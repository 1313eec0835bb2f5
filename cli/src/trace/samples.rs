//! The trace itself.

use std::ops::Range;

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

impl Trace {
    /// Some of the samples.
    pub(crate) fn part(&self, samples: &Range<usize>) -> Self {
        Self {
            times: self.times[samples.clone()].to_vec(),
            values: self.values[samples.clone()].to_vec(),
        }
    }
}

/// From one sample to the next, on average.
pub(crate) fn sampling_interval(times: &[f64]) -> f64 {
    (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64
}
