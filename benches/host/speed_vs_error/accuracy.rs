//! The error of every method, on the typical curves.

use crate::methods::{METHODS, Method, leaf};
use crate::support::curves::{Kind, Rng, hard_us, named, random_typical};
use crate::support::oracle::{Curve, Exact, rounding_cell};

const SEED: u64 = 4;

/// One method's figures over all curves.
#[derive(Clone, Debug, Default)]
pub struct Figures {
    /// On how many curves it was measured.
    pub curves: usize,
    /// The greatest |t - exact| in ulp(t).
    pub forward: f64,
    /// The greatest error as a fraction of the interval, and the mean of those at uniform fractions.
    pub of_interval: (f64, f64),
    /// Of neighbouring u.
    pub steps_back: f64,
    /// NaN, outside the interval, or off by more than 1 % of it.
    pub failures: f64,
}

/// The named typical curves, and random ones.
pub fn curves(random: u64) -> Vec<Curve> {
    let named = named().into_iter().filter(|named| named.kind == Kind::Typical);
    let random = (0..random).map(|i| random_typical(SEED, i));
    named.map(|named| named.curve).chain(random).collect()
}

/// What an inverse does on a curve.
#[derive(Clone, Copy, Debug, Default)]
pub struct Verdict {
    /// The greatest error beyond the rounding of the exact time to an `f32`: as a fraction of the interval, and in
    /// ulp(u).
    pub of_interval: f64,
    pub backward: f64,
    /// The `u` with the greatest backward error.
    pub at: f32,
    pub steps_back: u32,
}

/// The `u` that are likely to break an inverse, in order.
pub fn breaking_us(exact: &Exact) -> Vec<f32> {
    let mut us = hard_us(exact, 4, 400);
    us.sort_by(f32::total_cmp);
    us
}

/// Judges an inverse on the `u` that are likely to break it.
pub fn judge(exact: &Exact, inverse: impl Fn(f32) -> f32) -> Verdict {
    judge_on(exact, inverse, &breaking_us(exact))
}

/// Judges an inverse on these `u`, in order.
pub fn judge_on(exact: &Exact, inverse: impl Fn(f32) -> f32, us: &[f32]) -> Verdict {
    let (start, end) = (exact.curve().open_start(), exact.curve().close_end());
    let length = f64::from(end) - f64::from(start);
    let mut verdict = Verdict::default();
    let mut last = start;
    for &u in us {
        let t = inverse(u);
        verdict.steps_back += u32::from(t < last);
        last = t;
        let errors = exact.judge(u, t);
        let [low, high] = rounding_cell(t);
        let beyond = (low - errors.exact.hi).max(errors.exact.hi - high).max(0.0);
        // No number is as bad as can be.
        let beyond = if t.is_finite() { beyond } else { f64::INFINITY };
        verdict.of_interval = verdict.of_interval.max(beyond / length);
        if errors.backward > verdict.backward {
            (verdict.backward, verdict.at) = (errors.backward, u);
        }
    }
    verdict
}

/// The time as a caller has it who mends what can be seen: NaN, and times outside the interval.
pub fn mended(curve: &Curve, t: f32) -> f32 {
    if t >= curve.open_start() { t.min(curve.close_end()) } else { curve.open_start() }
}

/// Half of the samples are.
const fn is_uniform(sample: usize) -> bool {
    sample % 4 >= 2
}

/// Of so many samples a curve, and as many neighbours of the first, on each curve that a method serves.
pub fn measure(curves: &[Curve], samples: usize) -> Vec<Figures> {
    let mut all = vec![Figures::default(); METHODS.len()];
    for (index, curve) in curves.iter().enumerate() {
        let (exact, mut rng) = (Exact::new(curve), Rng::new(SEED, index as u64));
        // Uniform, and towards both ends on a scale of octaves: where tables and absolute tolerances fail.
        let us = (0..samples).map(|i| {
            let u = rng.unit();
            let tail = (u * 2f64.powf(-20.0 * rng.unit())) as f32;
            if is_uniform(i) {
                u as f32
            } else if i % 4 == 0 {
                tail
            } else {
                1.0 - tail
            }
        });
        let us: Vec<_> = us.map(|u| (u, exact.inverse_cdf(u))).collect();
        let first = us[0].0.min(0.999).to_bits();
        let (start, end) = (curve.open_start(), curve.close_end());
        let length = f64::from(end) - f64::from(start);
        for (method, figures) in METHODS.iter().zip(&mut all) {
            let Some(inverse) = method.build(curve) else { continue };
            figures.curves += 1;
            for (i, &(u, truth)) in us.iter().enumerate() {
                let t = inverse.inverse_cdf(u);
                let error = |t: f32| (f64::from(t) - truth.hi).abs() / length;
                figures.failures += f64::from(!(t >= start && t <= end && error(t) <= 0.01));
                let t = mended(curve, t);
                figures.of_interval.0 = figures.of_interval.0.max(error(t));
                figures.of_interval.1 += if is_uniform(i) { error(t) } else { 0.0 };
                // No error is relative to a time of 0.
                if truth.hi != 0.0 {
                    figures.forward = figures.forward.max(exact.forward_ulp(t, truth));
                }
            }
            let neighbours = (0..=samples as u32).map(|i| f32::from_bits(first + i));
            let times: Vec<f32> = neighbours.map(|u| inverse.inverse_cdf(u)).collect();
            let back = times.windows(2).filter(|pair| pair[1] < pair[0]);
            figures.steps_back += back.count() as f64;
        }
    }
    for figures in &mut all {
        let count = (figures.curves * samples) as f64;
        figures.of_interval.1 /= 0.5 * count;
        figures.failures *= 1e6 / count;
        figures.steps_back *= 1e6 / count;
    }
    all
}

/// The greatest error of what firmware asks, frames of up to 64 triggers of a leaf shutter, as a fraction of the
/// interval.
pub fn of_triggers(method: Method) -> Option<f64> {
    let curve = leaf();
    let (inverse, exact) = (method.build(&curve)?, Exact::new(&curve));
    let frames = (1..=64).flat_map(|n| (0..n).map(move |i| (i as f32 + 0.5) / n as f32));
    let length = f64::from(curve.close_end()) - f64::from(curve.open_start());
    let error = |u| (f64::from(inverse.inverse_cdf(u)) - exact.inverse_cdf(u).hi).abs() / length;
    Some(frames.map(error).fold(0.0, f64::max))
}
