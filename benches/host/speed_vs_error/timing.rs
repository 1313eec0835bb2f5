//! Host time a sample: medians of interleaved repeats, in runs so short that a busy machine interrupts few of them.

use std::hint::black_box;
use std::ops::Range;
use std::time::Instant;

use crate::methods::{FORWARDS, METHODS, fractions};
use crate::support::oracle::{Curve, Exact};

/// Samples a run.
const RUN: usize = 1 << 11;

/// A call's time for a sample, by the medians of its runs; each call is told which samples to take.
fn medians(
    calls: &mut [Box<dyn FnMut(Range<usize>) + '_>],
    samples: usize,
    repeats: usize,
) -> Vec<f64> {
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

/// Nanoseconds a sample of the methods that serve a curve, and the same and errors of [`FORWARDS`].
pub type Times = (Vec<Option<f64>>, Vec<(f64, f64)>);

/// For every method its time on the curve; and of [`FORWARDS`] the times and the greatest errors.
pub fn times(curve: &Curve, repeats: usize) -> Times {
    let u = fractions();
    let length = curve.close_end() - curve.open_start();
    let ts: Vec<f32> = u.iter().map(|u| curve.open_start() + u * length).collect();
    let methods = METHODS.map(|method| method.build(curve));
    let forwards = FORWARDS.map(|(_, build)| build(curve));
    let (u, ts) = (&u, &ts);
    let mut calls: Vec<Box<dyn FnMut(Range<usize>)>> = Vec::new();
    for method in methods.iter().flatten() {
        calls.push(Box::new(|run| method.singles(&u[run])));
    }
    for forward in &forwards {
        let mut out = vec![0.0; u.len()];
        calls.push(Box::new(move |run| forward(&ts[run.clone()], black_box(&mut out[run]))));
    }
    let medians = medians(&mut calls, u.len(), repeats);
    let (inverses, times) = medians.split_at(methods.iter().flatten().count());
    let mut inverses = inverses.iter().copied();
    let inverses = methods.iter().map(|method| method.as_ref().and_then(|_| inverses.next()));
    let inverses: Vec<Option<f64>> = inverses.collect();
    let exact = Exact::new(curve);
    let forwards = forwards.iter().zip(times).enumerate().map(|(i, (forward, time))| {
        let truth = |t| if i % 2 == 0 { exact.openness(t).hi } else { exact.cdf(t).hi };
        let mut out = vec![0.0; ts.len()];
        forward(ts, &mut out);
        let some = ts.iter().zip(&out).step_by(8);
        let errors = some.map(|(t, got)| (f64::from(*got) - truth(*t)).abs());
        (*time, errors.fold(0.0, f64::max))
    });
    (inverses, forwards.collect())
}
