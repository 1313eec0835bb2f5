//! What a closing ramp adds that follows the fitted one with a lag: the pattern that stands for all tails; and how much
//! of it is in the samples, with all that the signal's own parameters could explain of it left out.

use crate::bins::Bin;
use crate::curve::Exposure;
use crate::signal::Signal;
use crate::solve::{Cholesky, Solution};

/// The lag's time constant, in closing ramps. From 0.4 to 1.6 it tells the same.
pub const LAG: f64 = 0.8;

/// What a lag adds to the closing ramp, in each bin.
pub fn lagging(solution: &Solution, bins: &[Bin], step: f64) -> Option<Vec<f64>> {
    let exposure = Exposure::new(&solution.signal.curve);
    let curve = exposure.curve;
    let constant = LAG * curve.closing;
    if constant < 2.0 * step {
        return None;
    }
    let (mut last, mut open, mut lag) = (curve.close_start(), 1.0, 0.0);
    let mean = |bin: &Bin| {
        let width = bin.to - last;
        if width <= 0.0 {
            return 0.0;
        }
        // A lag falls by its time constant and grows by what the ramp falls, evenly over a bin.
        let falls = open - exposure.openness(bin.to);
        let pass = (-width / constant).exp();
        let next = lag * pass + falls * (1.0 - pass) * constant / width;
        let mean = constant * (lag + falls - next) / width;
        (last, open, lag) = (bin.to, open - falls, next);
        solution.signal.gain * mean
    };
    Some(bins.iter().map(mean).collect())
}

/// A signal's parameters, as far as they can move, at each bin.
pub struct Movable<'a> {
    solution: &'a Solution,
    bins: &'a [Bin],
    places: Vec<usize>,
    factor: Cholesky,
    /// How each bin moves with each.
    rows: Vec<Vec<f64>>,
    /// What each bin is missed by.
    pub missed: Vec<f64>,
}

impl<'a> Movable<'a> {
    pub fn new(solution: &'a Solution, bins: &'a [Bin], keep: impl Fn(usize) -> bool) -> Self {
        let places: Vec<usize> = solution.moving().into_iter().filter(|k| keep(*k)).collect();
        let factor = Cholesky::stiffened(&solution.normal_of(&places));
        let mut means = solution.signal.means();
        let mut moves = vec![0.0; solution.signal.len()];
        let (mut rows, mut missed) = (Vec::new(), Vec::new());
        for bin in bins {
            missed.push(bin.mean - means.over(bin.from, bin.to, &mut moves).0);
            rows.push(places.iter().map(|k| moves[*k]).collect());
        }
        Self { solution, bins, places, factor, rows, missed }
    }

    /// How the parameters would make up for a pattern.
    fn answer(&self, pattern: &[f64]) -> Vec<f64> {
        let mut right = vec![0.0; self.places.len()];
        for ((bin, row), p) in self.bins.iter().zip(&self.rows).zip(pattern) {
            right.iter_mut().zip(row).for_each(|(sum, m)| *sum += bin.samples * m * p);
        }
        self.factor.solve(&right)
    }

    /// What is left of a pattern.
    pub fn rest(&self, pattern: &[f64]) -> Vec<f64> {
        self.less(pattern, &self.answer(pattern))
    }

    /// The pattern less what the curve's parameters make up for, which is how the light itself changes.
    pub fn without_levels(&self, pattern: &[f64]) -> Vec<f64> {
        let mut by = self.answer(pattern);
        let of_curve = self.solution.signal.kind.parameters();
        let levels = self.places.iter().zip(&mut by).filter(|(place, _)| **place >= of_curve);
        levels.for_each(|(_, by)| *by = 0.0);
        self.less(pattern, &by)
    }

    fn less(&self, pattern: &[f64], by: &[f64]) -> Vec<f64> {
        let explained = |row: &Vec<f64>| row.iter().zip(by).map(|(m, by)| m * by).sum::<f64>();
        pattern.iter().zip(&self.rows).map(|(p, row)| p - explained(row)).collect()
    }
}

/// How much of a pattern is in what is missed, and in itself.
pub fn score(pattern: &[f64], missed: &[f64], bins: &[Bin]) -> (f64, f64) {
    let (mut along, mut square) = (0.0, f64::MIN_POSITIVE);
    for ((bin, p), missed) in bins.iter().zip(pattern).zip(missed) {
        along += bin.samples * p * missed;
        square += bin.samples * p * p;
    }
    (along, square)
}

/// What a capacitor's charge takes from each bin: as much as has come by then, to first order.
pub fn charge(solution: &Solution, bins: &[Bin]) -> Vec<f64> {
    let exposure = Exposure::new(&solution.signal.curve);
    bins.iter().map(|bin| -exposure.amount(bin.middle())).collect()
}

/// What the sum of squares falls by with a pattern in place of the signal's drift and hum, and what with these; less
/// than nothing where the pattern would have to be turned round.
pub fn falls(solution: &Solution, bins: &[Bin], pattern: &[f64]) -> Option<(f64, f64)> {
    let Signal { kind, drift, hum, .. } = solution.signal;
    let columns = drift.map_or(0, |_| 1) + hum.map_or(0, |_| 3);
    let place = kind.parameters() + 2;
    let movable = Movable::new(solution, bins, |k| !(place..place + columns).contains(&k));
    let beside = |bin: &Bin| {
        let t = bin.middle();
        drift.unwrap_or(0.0) * t + hum.map_or(0.0, |hum| hum.at(t))
    };
    let beside: Vec<f64> = bins.iter().map(beside).collect();
    let missed: Vec<f64> = movable.missed.iter().zip(&beside).map(|(missed, b)| missed + b).collect();
    let falls = |pattern: &[f64]| {
        let (along, square) = score(&movable.rest(pattern), &missed, bins);
        along * along.abs() / square
    };
    (columns > 0).then(|| (falls(pattern), falls(&beside).abs()))
}
