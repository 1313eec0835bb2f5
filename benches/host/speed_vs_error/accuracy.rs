//! The error of every method.

use crate::methods::{METHODS, Method, leaf};
use crate::support::aimed::{FAMILIES, aimed, aimed_us};
use crate::support::cases::{CASES, Case};
use crate::support::curves::{Kind, Rng, hard_us, named, random_typical};
use crate::support::oracle::{Curve, Exact, rounding_cell};
use crate::support::promise::LEAST_FRACTION;

const SEED: u64 = 4;

/// One method's figures over all curves.
#[derive(Clone, Default)]
pub struct Figures {
    /// On how many curves it was measured.
    pub curves: usize,
    /// The greatest |t - exact| in ulp(t).
    pub forward: f64,
    /// The greatest error as a fraction of the interval, and the mean of those at uniform fractions.
    pub of_interval: (f64, f64),
    /// Of a million neighbouring u.
    pub steps_back: f64,
}

/// The named typical curves, and random ones.
pub fn curves(random: u64) -> Vec<Curve> {
    let named = named().into_iter().filter(|named| named.kind == Kind::Typical);
    let random = (0..random).map(|i| random_typical(SEED, i));
    named.map(|named| named.curve).chain(random).collect()
}

fn length(curve: &Curve) -> f64 {
    f64::from(curve.close_end()) - f64::from(curve.open_start())
}

/// The time as a caller has it who mends what can be seen: NaN, and times outside the interval.
fn mended(curve: &Curve, t: f32) -> f32 {
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
            let tail = ((u * 2f64.powf(-20.0 * rng.unit())) as f32).max(LEAST_FRACTION);
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
        for (method, figures) in METHODS.iter().zip(&mut all) {
            let Some(inverse) = (method.build)(curve) else { continue };
            figures.curves += 1;
            for (i, &(u, truth)) in us.iter().enumerate() {
                let t = mended(curve, inverse.inverse_cdf(u));
                let error = (f64::from(t) - truth.hi).abs() / length(curve);
                figures.of_interval.0 = figures.of_interval.0.max(error);
                figures.of_interval.1 += if is_uniform(i) { error } else { 0.0 };
                // No error is relative to a time of 0.
                if truth.hi != 0.0 {
                    figures.forward = figures.forward.max(exact.forward_ulp(t, truth));
                }
            }
            let neighbours = (0..=samples as u32).map(|i| f32::from_bits(first + i));
            let times: Vec<f32> = neighbours.map(|u| inverse.inverse_cdf(u)).collect();
            figures.steps_back += times.windows(2).filter(|pair| pair[1] < pair[0]).count() as f64;
        }
    }
    for figures in &mut all {
        let count = (figures.curves * samples) as f64;
        figures.of_interval.1 /= 0.5 * count;
        figures.steps_back *= 1e6 / count;
    }
    all
}

/// The greatest error of what firmware asks, frames of up to 64 triggers of a leaf shutter, as a fraction of the
/// interval.
pub fn of_triggers(method: &Method) -> Option<f64> {
    let curve = leaf();
    let (inverse, exact) = ((method.build)(&curve)?, Exact::new(&curve));
    let frames = (1..=64).flat_map(|n| (0..n).map(move |i| (i as f32 + 0.5) / n as f32));
    let error = |u| (f64::from(inverse.inverse_cdf(u)) - exact.inverse_cdf(u).hi).abs() / length(&curve);
    Some(frames.map(error).fold(0.0, f64::max))
}

/// Each method's greatest error on so many hard curves that it serves, the hard cases first, and then curves that meet
/// difficulties exactly: beyond the rounding of the exact time to an `f32`, as a fraction of the interval.
pub fn of_hard_curves(count: usize) -> Vec<f64> {
    let errors = (0..count).map(|i| {
        let rng = &mut Rng::new(1, i as u64);
        let curve = CASES.get(i).map_or_else(|| aimed(i % FAMILIES.len(), 1, i as u64), Case::curve);
        let exact = Exact::new(&curve);
        let mut us = if i < CASES.len() { hard_us(&exact, SEED, 400) } else { aimed_us(&exact, rng) };
        us.retain(|u| *u == 0.0 || *u >= LEAST_FRACTION);
        let truths: Vec<_> = us.iter().map(|u| exact.inverse_cdf(*u).hi).collect();
        let worst = METHODS.iter().map(|method| {
            let Some(inverse) = (method.build)(&curve) else { return 0.0 };
            let errors = us.iter().zip(&truths).map(|(u, truth)| {
                let [low, high] = rounding_cell(mended(&curve, inverse.inverse_cdf(*u)));
                (low - truth).max(truth - high)
            });
            errors.fold(0.0, f64::max) / length(&curve)
        });
        worst.collect::<Vec<_>>()
    });
    errors.reduce(|a, b| a.into_iter().zip(b).map(|(a, b)| a.max(b)).collect()).unwrap_or_default()
}
