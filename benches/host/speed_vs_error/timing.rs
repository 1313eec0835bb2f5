//! Host time a call: medians of interleaved repeats, in runs so short that a busy machine interrupts few of them.

use std::time::Instant;

use crate::methods::{METHODS, curve, fractions};

/// Calls a run.
const RUN: usize = 1 << 11;

/// Nanoseconds a call of every method.
pub fn times(repeats: usize) -> Vec<f64> {
    let us = fractions(1 << 16);
    let methods = METHODS.map(|method| (method.build)(&curve(method.curve())).expect("it serves that curve"));
    let mut times = vec![vec![Vec::new(); us.len() / RUN]; methods.len()];
    for (run, us) in (0..repeats).flat_map(|_| us.chunks(RUN).enumerate()) {
        for (method, times) in methods.iter().zip(&mut times) {
            let start = Instant::now();
            method.each(us);
            times[run].push(start.elapsed().as_nanos() as f64);
        }
    }
    let median = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    times.iter_mut().map(|runs| runs.iter_mut().map(median).sum::<f64>() / us.len() as f64).collect()
}
