//! Host time a call: medians of interleaved repeats, in runs so short that a busy machine interrupts few of them.

use std::hint::black_box;
use std::time::Instant;

use crate::methods::{METHODS, Method};
use crate::support::curves::Rng;

/// Calls a run.
const RUN: usize = 1 << 11;

/// Nanoseconds a call of every method, at fractions in no order, and more than a branch predictor learns by heart.
pub fn times(repeats: usize) -> Vec<f64> {
    let mut rng = Rng::new(1, 0);
    let us: Vec<_> = (0..1 << 16).map(|_| rng.unit() as f32).collect();
    let methods = METHODS.each_ref().map(Method::of_cost);
    let mut times = vec![vec![Vec::new(); us.len() / RUN]; methods.len()];
    for (run, us) in (0..repeats).flat_map(|_| us.chunks(RUN).enumerate()) {
        for (inverse, times) in methods.iter().zip(&mut times) {
            let start = Instant::now();
            black_box(inverse(us));
            times[run].push(start.elapsed().as_nanos() as f64);
        }
    }
    let median = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    times.iter_mut().map(|runs| runs.iter_mut().map(median).sum::<f64>() / us.len() as f64).collect()
}
