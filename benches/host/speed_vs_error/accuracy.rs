//! The error of every method, on the typical curves.

use crate::methods::METHODS;
use crate::support::curves::{Kind, Rng, named, random_typical};
use crate::support::oracle::{Curve, Exact};

const SEED: u64 = 4;

/// One method's figures over all curves.
#[derive(Clone, Debug, Default)]
pub struct Figures {
    /// |t - exact| in ulp(t), of all samples, in order.
    pub forward: Vec<f32>,
    /// The same with its sign.
    pub signed: Vec<f32>,
    /// The greatest and the mean error as a fraction of the interval.
    pub of_interval: (f64, f64),
    /// The greatest error in ulp(u), once half an ulp(t) is forgiven.
    pub backward: f64,
    /// Of neighbouring u.
    pub steps_back: f64,
    /// Mean and worst number of evaluations.
    pub evaluations: (f64, u32),
    /// NaN, outside the interval, or off by more than 1 % of it.
    pub failures: f64,
}

impl Figures {
    /// The error that this share of the samples does not exceed.
    pub fn quantile(&self, share: f64) -> f64 {
        let last = self.forward.len() - 1;
        f64::from(self.forward[(share * last as f64) as usize])
    }

    pub fn mean(&self) -> f64 {
        self.forward.iter().map(|e| f64::from(*e)).sum::<f64>() / self.forward.len() as f64
    }
}

/// How much is measured.
pub struct Amount {
    pub random_curves: u64,
    pub samples: usize,
    pub neighbours: u32,
}

/// The named typical curves, and random ones.
fn curves(amount: &Amount) -> Vec<Curve> {
    let named = named().into_iter().filter(|named| named.kind == Kind::Typical);
    let random = (0..amount.random_curves).map(|i| random_typical(SEED, i));
    named.map(|named| named.curve).chain(random).collect()
}

/// Uniform, and towards both ends on a scale of octaves: where tables and absolute tolerances fail.
fn fractions(rng: &mut Rng, count: usize) -> Vec<f32> {
    (0..count)
        .map(|i| {
            let u = rng.unit();
            let tail = (u * 2f64.powf(-20.0 * rng.unit())) as f32;
            match i % 4 {
                0 => tail,
                1 => 1.0 - tail,
                _ => u as f32,
            }
        })
        .collect()
}

pub fn measure(amount: &Amount, tick: impl Fn()) -> Vec<Figures> {
    let mut all = vec![Figures::default(); METHODS.len()];
    let curves = curves(amount);
    for (index, curve) in curves.iter().enumerate() {
        let (exact, mut rng) = (Exact::new(curve), Rng::new(SEED, index as u64));
        let us = fractions(&mut rng, amount.samples);
        let truth: Vec<_> = us.iter().map(|&u| exact.inverse_cdf(u)).collect();
        let first = us[0].min(0.999).to_bits();
        let (start, end) = (curve.open_start(), curve.close_end());
        let length = f64::from(end) - f64::from(start);
        for (method, figures) in METHODS.iter().zip(&mut all) {
            let inverse = (method.build)(curve);
            for (&u, &truth) in us.iter().zip(&truth) {
                let t = inverse.inverse_cdf(u);
                let evaluations = inverse.evaluations(u);
                figures.evaluations.0 += f64::from(evaluations);
                figures.evaluations.1 = figures.evaluations.1.max(evaluations);
                let error = (f64::from(t) - truth.hi).abs();
                if !(t >= start && t <= end && error / length <= 0.01) {
                    figures.failures += 1.0;
                }
                // The errors are those of a caller who mends what can be seen: NaN, and times outside.
                let t = if t >= start { t.min(end) } else { start };
                let error = f64::from(t) - truth.hi;
                let of_interval = error.abs() / length;
                figures.of_interval.0 = figures.of_interval.0.max(of_interval);
                figures.of_interval.1 += of_interval;
                // No error is relative to a time of 0.
                if truth.hi != 0.0 {
                    let forward = exact.forward_ulp(t, truth);
                    figures.forward.push(forward as f32);
                    figures.signed.push(forward.copysign(error) as f32);
                }
                figures.backward = figures.backward.max(exact.judge(u, t).backward);
            }
            let neighbours = (0..=amount.neighbours).map(|i| f32::from_bits(first + i));
            let times: Vec<f32> = neighbours.map(|u| inverse.inverse_cdf(u)).collect();
            let back = times.windows(2).filter(|pair| pair[1] < pair[0]);
            figures.steps_back += back.count() as f64;
        }
        tick();
    }
    let samples = (curves.len() * amount.samples) as f64;
    let pairs = (curves.len() as f64) * f64::from(amount.neighbours);
    for figures in &mut all {
        figures.forward.sort_by(f32::total_cmp);
        figures.of_interval.1 /= samples;
        figures.evaluations.0 /= samples;
        figures.failures *= 1e6 / samples;
        figures.steps_back *= 1e6 / pairs;
    }
    all
}

/// How many curves are measured, for the progress bar and the report.
pub fn count(amount: &Amount) -> usize {
    curves(amount).len()
}
