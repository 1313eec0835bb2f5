//! The error of every method.

use crate::methods::{Inverse, METHODS, Method, curve};
use crate::support::curves::{Rng, named};
use crate::support::families::{FAMILIES, aimed, random_typical};
use crate::support::oracle::{Curve, Exact, rounding_cell};
use crate::support::promise::LEAST_FRACTION;
use crate::support::questions::{aimed_us, hard_us};

const SEED: u64 = 4;

/// One method's errors.
#[derive(Clone, Default)]
pub struct Errors {
    /// How many typical curves it serves.
    pub curves: usize,
    /// On these the greatest |t - exact| in ulp(t).
    pub forward: f64,
    /// The greatest as a fraction of the interval, and the mean of those at uniform fractions.
    pub greatest: f64,
    pub mean: f64,
    /// Of a million neighbouring u.
    pub steps_back: f64,
    /// On hard curves the greatest as a fraction of the interval, beyond the rounding of the exact time to an `f32`.
    pub hard: f64,
}

/// The named typical curves, and random ones.
pub fn curves(random: u64) -> Vec<Curve> {
    let random = (0..random).map(|i| random_typical(SEED, i));
    named("typical").into_iter().map(|one| one.curve).chain(random).collect()
}

fn length(curve: &Curve) -> f64 {
    f64::from(curve.close_end()) - f64::from(curve.open_start())
}

/// The times as a caller has them who mends what can be seen: NaN, and times outside the interval.
fn mended(inverse: Inverse, curve: &Curve, us: &[f32]) -> Vec<f32> {
    let (start, end) = (curve.open_start(), curve.close_end());
    inverse(us).into_iter().map(|t| if t >= start { t.min(end) } else { start }).collect()
}

/// Uniform fractions, and as many towards both ends on a scale of octaves: where tables and absolute tolerances fail.
fn fractions(count: usize, rng: &mut Rng) -> Vec<f32> {
    let half = (0..count / 2).map(|_| rng.unit() as f32).collect::<Vec<_>>();
    let tails = (0..count / 2).map(|i| {
        let tail = ((rng.unit() * 2f64.powf(-20.0 * rng.unit())) as f32).max(LEAST_FRACTION);
        if i % 2 == 0 { tail } else { 1.0 - tail }
    });
    half.into_iter().chain(tails).collect()
}

/// Of each method, on the curves that it serves: at so many fractions of a curve, and as many neighbours of the first.
pub fn errors(curves: &[Curve], samples: usize, hard: usize) -> Vec<Errors> {
    let mut all = vec![Errors::default(); METHODS.len()];
    for (index, curve) in curves.iter().enumerate() {
        let exact = Exact::new(curve);
        let us = fractions(samples, &mut Rng::new(SEED, index as u64));
        let truths: Vec<_> = us.iter().map(|u| exact.inverse_cdf(*u)).collect();
        let first = us[0].min(0.999).to_bits();
        let neighbours: Vec<_> = (0..=samples as u32).map(|i| f32::from_bits(first + i)).collect();
        for (method, errors) in METHODS.iter().zip(&mut all) {
            let Some(inverse) = (method.build)(curve) else { continue };
            errors.curves += 1;
            let times = inverse(&neighbours);
            errors.steps_back += times.windows(2).filter(|pair| pair[1] < pair[0]).count() as f64;
            for (i, (t, truth)) in mended(inverse, curve, &us).into_iter().zip(&truths).enumerate() {
                let error = (f64::from(t) - truth.hi).abs() / length(curve);
                errors.greatest = errors.greatest.max(error);
                errors.mean += if i < samples / 2 { error } else { 0.0 };
                // No error is relative to a time of 0.
                if truth.hi != 0.0 {
                    errors.forward = errors.forward.max(exact.forward_ulp(t, *truth));
                }
            }
        }
    }
    for errors in &mut all {
        let count = (errors.curves * samples) as f64;
        errors.mean /= 0.5 * count;
        errors.steps_back *= 1e6 / count;
    }
    on_hard_curves(hard, &mut all);
    all
}

/// The greatest error of what firmware asks, frames of up to 64 triggers of a leaf shutter, as a fraction of the
/// interval.
pub fn of_triggers(method: &Method) -> Option<f64> {
    let curve = curve("dslr_leaf");
    let exact = Exact::new(&curve);
    let us: Vec<_> = (1..=64).flat_map(|n| (0..n).map(move |i| (i as f32 + 0.5) / n as f32)).collect();
    let times = (method.build)(&curve)?(&us);
    let errors = us.iter().zip(times).map(|(u, t)| (f64::from(t) - exact.inverse_cdf(*u).hi).abs() / length(&curve));
    Some(errors.fold(0.0, f64::max))
}

/// The hard cases first, and then curves that meet difficulties exactly.
fn on_hard_curves(count: usize, all: &mut [Errors]) {
    let cases = named("case");
    for i in 0..count {
        let curve = cases.get(i).map_or_else(|| aimed(i % FAMILIES.len(), 1, i as u64), |case| case.curve);
        let exact = Exact::new(&curve);
        let rng = &mut Rng::new(1, i as u64);
        let mut us = if i < cases.len() { hard_us(&exact, SEED, 400) } else { aimed_us(&exact, rng) };
        us.retain(|u| *u == 0.0 || *u >= LEAST_FRACTION);
        let truths: Vec<_> = us.iter().map(|u| exact.inverse_cdf(*u).hi).collect();
        for (method, errors) in METHODS.iter().zip(&mut *all) {
            let Some(inverse) = (method.build)(&curve) else { continue };
            for (t, truth) in mended(inverse, &curve, &us).into_iter().zip(&truths) {
                let [low, high] = rounding_cell(t);
                errors.hard = errors.hard.max((low - truth).max(truth - high) / length(&curve));
            }
        }
    }
}
