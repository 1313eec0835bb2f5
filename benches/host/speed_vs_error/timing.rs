//! Host time a sample: medians of interleaved repeats, so that a busy machine hits all methods alike.

use std::hint::black_box;
use std::time::Instant;

use crate::curves::CURVES;
use crate::methods::METHODS;
use crate::support::cases::shutter;
use crate::support::curves::Rng;
use crate::support::oracle::{Curve, Exact};
use crate::support::peers::{Parts, animation};

pub fn curve(index: usize) -> Curve {
    let (_, opening, closing) = CURVES[index];
    Curve::shutter(opening, closing)
}

/// More than a branch predictor learns by heart, so that every branch on u is taken by surprise.
const COUNT: usize = 1 << 16;

/// Nanoseconds a sample.
#[derive(Clone, Copy, Debug)]
pub struct Time {
    pub single: f64,
    pub slice: f64,
}

fn inputs() -> Vec<f32> {
    let mut rng = Rng::new(1, 0);
    (0..COUNT).map(|_| rng.unit() as f32).collect()
}

fn nanoseconds(call: impl FnOnce()) -> f64 {
    let start = Instant::now();
    call();
    start.elapsed().as_nanos() as f64 / COUNT as f64
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// For every method, its times on the curve.
pub fn inverses(curve: &Curve, repeats: usize, tick: impl Fn()) -> Vec<Time> {
    let (u, mut t) = (inputs(), vec![0.0; COUNT]);
    let methods: Vec<_> = METHODS.iter().map(|method| (method.build)(curve)).collect();
    let mut times = vec![(Vec::new(), Vec::new()); METHODS.len()];
    for _ in 0..repeats {
        for (method, times) in methods.iter().zip(&mut times) {
            times.0.push(nanoseconds(|| method.singles(&u)));
            times.1.push(nanoseconds(|| method.slice(&u, black_box(&mut t))));
        }
        tick();
    }
    let times = times.into_iter();
    times.map(|(single, slice)| Time { single: median(single), slice: median(slice) }).collect()
}

/// What is timed by [`forwards`].
pub const FORWARDS: [&str; 4] =
    ["`opening`", "`cdf`", "opening, 8 Newton steps", "cdf, 8 Newton steps"];

/// The time and the greatest error of the openness and of the cdf, by this crate and by the usual solver of
/// animation curves.
pub fn forwards(curve: &Curve, repeats: usize) -> [(f64, f64); 4] {
    let (ours, exact) = (shutter::<8>(curve), Exact::new(curve));
    let parts = Parts::<f32>::new(curve.opening, curve.closing);
    let solve = |ramp: &_, t| animation(ramp, t, 1e-6).unwrap_or(0.0);
    let length = curve.close_end() - curve.open_start();
    let times: Vec<f32> = inputs().iter().map(|u| curve.open_start() + u * length).collect();
    let openness = |t: f32| exact.openness(t).hi;
    let cdf = |t: f32| exact.cdf(t).hi;
    [
        forward(&times, repeats, |t| ours.opening(t), openness),
        forward(&times, repeats, |t| ours.cdf(t), cdf),
        forward(&times, repeats, |t| parts.openness(t, solve), openness),
        forward(&times, repeats, |t| parts.cdf(t, solve), cdf),
    ]
}

fn forward(
    times: &[f32],
    repeats: usize,
    call: impl Fn(f32) -> f32,
    truth: impl Fn(f32) -> f64,
) -> (f64, f64) {
    let run = || {
        for &t in times {
            black_box(call(black_box(t)));
        }
    };
    let time = median((0..repeats).map(|_| nanoseconds(run)).collect());
    let errors = times.iter().step_by(8).map(|&t| (f64::from(call(t)) - truth(t)).abs());
    (time, errors.fold(0.0, f64::max))
}
