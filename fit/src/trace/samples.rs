//! The trace itself, and what is asked of one.

use std::borrow::Borrow;
use std::ops::Range;

/// No time and no signal is larger than this: squares and sums of them stay far from the end of `f64`.
pub const LARGEST: f64 = 1e30;
/// The least contrast of a pulse, in standard deviations of the (smoothed) noise.
pub(super) const CONTRAST: f64 = 8.0;

/// A signal over time: seconds, in order, no two the same; values in the file's own unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// In seconds.
    pub times: Vec<f64>,
    /// As measured.
    pub values: Vec<f64>,
}

impl Trace {
    /// Moves all times.
    pub(crate) fn shift(&mut self, by: f64) {
        self.times.iter_mut().for_each(|t| *t += by);
    }

    /// Some of the samples.
    pub(crate) fn part(&self, samples: &Range<usize>) -> Self {
        Self { times: self.times[samples.clone()].to_vec(), values: self.values[samples.clone()].to_vec() }
    }
}

/// The least and the greatest of some values; infinite and the wrong way round of none.
pub(super) fn range(values: impl IntoIterator<Item: Borrow<f64>>) -> (f64, f64) {
    let none = (f64::INFINITY, f64::NEG_INFINITY);
    values.into_iter().fold(none, |(low, high), v| (low.min(*v.borrow()), high.max(*v.borrow())))
}

/// From one sample to the next, by the median: a gap between two shots does not count.
pub(crate) fn sampling_interval(times: &[f64]) -> f64 {
    median(times.windows(2).map(|pair| pair[1] - pair[0]).collect())
}

/// The middle one of some values, which are not none.
pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// The noise, by the median of what neighbours differ by: edges and hum hardly count in it. At least what rounding to
/// the least step of the values makes.
pub(super) fn noise(values: &[f64]) -> f64 {
    let steps = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    (median(steps) / 0.6745 / 2f64.sqrt()).max(least_step(values) / 12f64.sqrt())
}

/// The least step from one value to the next; 0 of a gate or a logic level, whose two values round nothing.
pub fn least_step(values: &[f64]) -> f64 {
    let steps = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).filter(|s| *s > 0.0);
    let least = steps.reduce(f64::min).unwrap_or(0.0);
    let (low, high) = range(values);
    if 1.5 * least < high - low { least } else { 0.0 }
}
