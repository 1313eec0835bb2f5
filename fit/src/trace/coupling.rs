//! A recorder that is coupled by capacitors (AC, a sound card): how fast they charge, roughly, and the light without
//! them. That finds the pulses, and shows them; what is fitted are the samples as they are, with the capacitors in the
//! model.
//!
//! Such a recorder shows `y = x - q`, where the charge `q` grows by `rate y` in a unit of time. So `x` is `y` and the
//! integral of `y` times the rate.

use super::samples::{Trace, median, noise, range};
use crate::noise::mean;

/// The corners that are tried, in hertz: so many, from the lowest on, by this factor.
const CORNERS: (usize, f64, f64) = (24, 0.5, 1.25);
/// Samples are taken together until so many are left.
const MOST: usize = 20_000;
/// A second capacitor has to leave so much less.
const LESS: f64 = 0.9;
/// So many time constants at a level within so many standard deviations of the noise are the dark.
const SETTLED: f64 = 15.0;
const QUIET: f64 = 5.0;

/// The rates of one capacitor or of two, each one over a time constant.
pub type Rates = [Option<f64>; 2];

/// The rates with which the light comes nearest to a signal of two levels.
pub fn guessed(trace: &Trace) -> Option<Rates> {
    let together = trace.times.len().div_ceil(MOST);
    let few = |values: &[f64]| values.chunks_exact(together).map(mean).collect();
    let few = Trace { times: few(&trace.times), values: few(&trace.values) };
    let level = start(&few);
    let left = |rates: Rates| {
        let values = undone(&few, rates, level).values;
        let (low, high) = range(&values);
        let sign = if high - level > level - low { 1.0 } else { -1.0 };
        let light: Vec<f64> = values.iter().map(|v| sign * (v - level)).collect();
        let most = range(&light).1;
        let full = median(light.iter().copied().filter(|v| *v >= 0.5 * most).collect());
        light.iter().map(|v| v.abs().min((v - full).abs())).sum::<f64>() / full
    };
    let (count, lowest, factor) = CORNERS;
    let rate = |k: usize| Some(std::f64::consts::TAU * lowest * factor.powi(k as i32));
    let best = |all: &mut dyn Iterator<Item = Rates>| {
        all.map(|rates| (left(rates), rates)).filter(|it| it.0.is_finite()).min_by(|a, b| a.0.total_cmp(&b.0))
    };
    let one = best(&mut (0..count).map(|k| [rate(k), None]))?;
    let two = best(&mut (0..count).flat_map(|a| (0..=a).map(move |b| [rate(a), rate(b)])))?;
    Some(if two.0 < LESS * one.0 { two.1 } else { one.1 })
}

/// The level at the beginning.
pub fn start(trace: &Trace) -> f64 {
    mean(&trace.values[..(trace.values.len() / 50).max(3)])
}

/// The light, where all began at this `level`. After so long at it that nothing is left of a charge, none is, whatever
/// the noise has added up to.
pub fn undone(trace: &Trace, rates: Rates, level: f64) -> Trace {
    let Trace { times, mut values } = trace.clone();
    let settled = SETTLED / rates.into_iter().flatten().fold(f64::INFINITY, f64::min);
    let quiet = QUIET * noise(&values);
    let mut since = times[0];
    let settles = times.iter().zip(&values).map(|(t, v)| {
        since = if (v - level).abs() > quiet { *t } else { since };
        t - since > settled
    });
    let settles: Vec<bool> = settles.collect();
    for rate in rates.into_iter().flatten() {
        let (mut charge, mut before) = (0.0, values[0] - level);
        for k in 1..times.len() {
            let now = values[k] - level;
            charge += 0.5 * rate * (times[k] - times[k - 1]) * (now + before);
            charge = if settles[k] { 0.0 } else { charge };
            (before, values[k]) = (now, values[k] + charge);
        }
    }
    Trace { times, values }
}
