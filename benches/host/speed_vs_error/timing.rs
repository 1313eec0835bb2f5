//! Host time a call: medians of interleaved repeats, in runs so short that a busy machine interrupts few of them.

use std::time::Instant;

use crate::methods::{Inverse, fractions};

/// Calls a run.
const RUN: usize = 1 << 11;

/// Nanoseconds a call of each, at so many random fractions.
pub fn times(all: &[&dyn Inverse], count: usize, repeats: usize) -> Vec<f64> {
    let us = fractions(count);
    let mut times = vec![vec![Vec::new(); us.len().div_ceil(RUN)]; all.len()];
    for (run, us) in (0..repeats).flat_map(|_| us.chunks(RUN).enumerate()) {
        for (one, times) in all.iter().zip(&mut times) {
            let start = Instant::now();
            one.each(us);
            times[run].push(start.elapsed().as_nanos() as f64);
        }
    }
    let median = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    times.iter_mut().map(|runs| runs.iter_mut().map(median).sum::<f64>() / us.len() as f64).collect()
}
