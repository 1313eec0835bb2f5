//! Host time a sample: medians of interleaved repeats, in runs so short that a busy machine interrupts few of them.

use std::ops::Range;
use std::time::Instant;

use crate::methods::{METHODS, fractions};
use crate::support::oracle::Curve;

/// Samples a run.
const RUN: usize = 1 << 11;

/// A call's time for a sample, by the medians of its runs; each call is told which samples to take.
fn medians(calls: &mut [Box<dyn FnMut(Range<usize>) + '_>], samples: usize, repeats: usize) -> Vec<f64> {
    let mut times = vec![vec![Vec::new(); samples / RUN]; calls.len()];
    for run in (0..repeats).flat_map(|_| 0..samples / RUN) {
        for (call, times) in calls.iter_mut().zip(&mut times) {
            let start = Instant::now();
            call(run * RUN..(run + 1) * RUN);
            times[run].push(start.elapsed().as_nanos() as f64);
        }
    }
    let median = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    times.iter_mut().map(|runs| runs.iter_mut().map(median).sum::<f64>() / samples as f64).collect()
}

/// Nanoseconds a sample of every method on a curve, if it serves that.
pub fn times(curve: &Curve, repeats: usize) -> Vec<Option<f64>> {
    let u = &fractions();
    let methods = METHODS.map(|method| method.build(curve));
    let mut calls: Vec<Box<dyn FnMut(Range<usize>)>> = Vec::new();
    for method in methods.iter().flatten() {
        calls.push(Box::new(|run| method.singles(&u[run])));
    }
    let mut medians = medians(&mut calls, u.len(), repeats).into_iter();
    methods.iter().map(|method| method.as_ref().and_then(|_| medians.next())).collect()
}
