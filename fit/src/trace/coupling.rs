//! A recorder that is coupled by a capacitor: one high-pass pole, whose time constant is the one that makes the dark
//! after the pulse what it was before, undone.
//!
//! Such a recorder shows `y = x - q`, where the capacitor's charge `q` grows by `y/tau` in a unit of time. So `x` is
//! `y` and the integral of `y` over `tau`; in the dark that has to be one level.

use super::pulse::{Light, Pulses, pulses};
use super::samples::Trace;
use crate::noise::mean;
use crate::solve::Cholesky;

/// The dark on either side is looked at in so many parts.
const PARTS: usize = 16;
/// The square sum of the dark has to fall so far by it, against a drift's, that chance does not do that: by five
/// standard deviations.
const FALLS: f64 = 3.0;
/// A pulse's tails are no dark: so many pulses on either side are left out.
const ROOM: f64 = 0.15;

/// The pulses with the coupling undone, its time constant in seconds and its relative error; none where the dark does
/// not ask for it.
pub fn undone(trace: &Trace) -> Option<(Pulses, f64, f64)> {
    let Trace { times, values } = trace;
    let n = times.len();
    let few = (n / 50).max(3);
    let (first, last) = (mean(&values[..few]), mean(&values[n - few..]));
    let integral = integral(times, values, first);
    // A first guess, from the ends alone.
    let whole = mean(&integral[n - few..]);
    let rate = (first - last) / whole;
    if !(rate > 0.0 && rate.is_finite()) {
        return None;
    }
    let guess = pulses(&with(trace, &integral, rate, 0.0), Light::Auto).ok()?;
    let (start, end) = (guess.frames.first()?.crossings[0], guess.frames.last()?.crossings[5]);
    let room = ROOM * (end - start);
    let is_dark = |t: f64| t < start - room || t > end + room;
    let parts = [0..times.partition_point(|t| is_dark(*t) && *t < end), times.partition_point(|t| *t <= end + room)..n];
    // Time counts from the middle, in units of the whole.
    let unit = times[n - 1] - times[0];
    let mut rows = Vec::new();
    for part in parts {
        if part.len() < 2 * PARTS {
            return None;
        }
        let length = part.len() / PARTS;
        for k in 0..PARTS {
            let few = part.start + k * length..part.start + (k + 1) * length;
            let time = (mean(&times[few.clone()]) - times[0]) / unit;
            rows.push(([1.0, time, mean(&integral[few.clone()]) / whole], mean(&values[few])));
        }
    }
    let (_, by_drift) = least_squares::<2>(&rows.iter().map(|(x, y)| ([x[0], x[1]], *y)).collect::<Vec<_>>())?;
    let ([_, slope, step], by_pole) = least_squares(&rows)?;
    let rate = -step / whole;
    let is_asked_for = rate > 0.0 && by_drift > FALLS * by_pole && rate * unit < 100.0;
    if !is_asked_for {
        return None;
    }
    let found = pulses(&with(trace, &integral, rate, slope / unit), Light::Auto).ok()?;
    let error = (by_pole / (by_drift - by_pole) / (rows.len() - 3) as f64).sqrt();
    (!found.frames.is_empty()).then_some((found, 1.0 / rate, error))
}

/// What has come above a level by each sample's time.
fn integral(times: &[f64], values: &[f64], level: f64) -> Vec<f64> {
    let mut sum = 0.0;
    let mut sums = vec![0.0];
    for k in 1..times.len() {
        sum += (times[k] - times[k - 1]) * (0.5 * (values[k] + values[k - 1]) - level);
        sums.push(sum);
    }
    sums
}

fn with(trace: &Trace, integral: &[f64], rate: f64, slope: f64) -> Trace {
    let Trace { times, values } = trace;
    let undone = |k: usize| values[k] + rate * integral[k] - slope * (times[k] - times[0]);
    Trace { times: times.clone(), values: (0..times.len()).map(undone).collect() }
}

/// What a `y` is made of.
type Row<const N: usize> = ([f64; N], f64);

/// How much of each `y` is made of, and the sum of squares that is left.
fn least_squares<const N: usize>(rows: &[Row<N>]) -> Option<([f64; N], f64)> {
    let sum = |of: &dyn Fn(&Row<N>) -> f64| rows.iter().map(of).sum::<f64>();
    let cell = |i: usize, j: usize| sum(&|(x, _)| x[i] * x[j]);
    let normal = (0..N).map(|i| (0..N).map(|j| cell(i, j)).collect()).collect();
    let right: Vec<f64> = (0..N).map(|i| sum(&|(x, y)| x[i] * y)).collect();
    let found: [f64; N] = Cholesky::new(normal)?.solve(&right).try_into().ok()?;
    let missed = |(x, y): &Row<N>| y - x.iter().zip(found).map(|(x, by)| x * by).sum::<f64>();
    Some((found, sum(&|row| missed(row).powi(2))))
}
