//! A closing ramp that ends more slowly than its cubic: creeping blades, a relaxing crystal, a slow sensor.
//!
//! One pattern stands for all of these: what a ramp adds that follows the fitted one with a lag. How much of it is in the samples
//! is tested with all that the signal's own parameters could explain of it left out (a score test), which finds a tail that
//! no block of samples shows by itself.

use super::bins::Bin;
use super::curve::{Exposure, fractions};
use super::frame::FrameFits;
use super::missed::least_open;
use super::noise::{LEAST, correlation};
use super::signal::Kind;
use super::solve::{Cholesky, Problem, Solution};
use super::structure::{Parts, fast, normal_of};

/// The test, which is looked for by one pattern alone, so many are: a normal number is there once in 1400 times, on one side.
pub const BEYOND: f64 = 3.2;
/// A tail matters where the triggers move so much with it, as a share of the exposure.
pub const MATTERS: f64 = 1e-3;
/// The lag's time constant, in closing ramps. From 0.4 to 1.6 it tells the same.
const LAG: f64 = 0.8;
/// After so many time constants nothing is left of a tail that noise would not hide.
const ENDS: f64 = 2.0;
/// In fewer samples of dark the noise is not known.
const LEAST_DARK: usize = 16;

/// The tail that the samples show.
pub struct Tail {
    /// How far that is from chance, in standard deviations; below 0 where light is missing.
    pub sigma: f64,
    /// By how much the triggers move with it, the root of their mean square, as a share of the exposure.
    pub moves: f64,
    /// Where it is highest: its share of the light, and when.
    pub share: f64,
    pub at: f64,
}

/// When the tail that the samples show has come to its end, if they show one.
pub fn end(fits: &FrameFits, kind: Kind) -> Option<f64> {
    let curve = fits.of(kind).solution.signal.curve;
    let found = tail(fits, kind).filter(|tail| tail.sigma > BEYOND && tail.moves > MATTERS);
    found.map(|_| curve.end() + ENDS * LAG * curve.closing)
}

/// The tail in what a kind's curve misses; none where that has no ramp to speak of, or too little dark.
pub fn tail(fits: &FrameFits, kind: Kind) -> Option<Tail> {
    let solution = &fits.of(kind).solution;
    let bins = fits.bins();
    let lagging = lagging(solution, bins, fits.step)?;
    let movable = Movable::new(solution, bins, |_| true);
    let rest = movable.rest(&lagging);
    let Score { along, square } = Score::new(&rest, &movable.missed, bins);
    let noise = Noise::new(fits, kind)?;
    let rounding: f64 = bins.iter().zip(&rest).map(|(bin, r)| bin.samples * r.abs()).sum::<f64>()
        * fits.rounding
        * solution.signal.gain;
    let usual = noise.along(&rest, bins, &fits.exposure(kind)).sqrt() + rounding;
    let off = along / usual;
    let amount = along / square;
    let (k, highest) =
        lagging.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0));
    Some(Tail {
        sigma: normal_of(off * off, (1.0, noise.known)) * off.signum(),
        moves: amount.abs() * moves(fits, kind, &movable.without_levels(&lagging)),
        share: amount * highest / solution.signal.gain,
        at: bins[k].from,
    })
}

/// Does a tail explain as much as the drift does that a signal was given?
pub fn passes_for_drift(problem: &Problem, solution: &Solution, step: f64) -> bool {
    let (signal, bins) = (solution.signal, &problem.bins);
    let (Some(drift), Some(lagging)) = (signal.drift, lagging(solution, bins, step)) else {
        return false;
    };
    let place = signal.kind.parameters() + 2;
    let movable = Movable::new(solution, bins, |k| k != place);
    let line: Vec<f64> = bins.iter().map(|bin| 0.5 * (bin.from + bin.to)).collect();
    let missed: Vec<f64> =
        movable.missed.iter().zip(&line).map(|(missed, t)| missed + drift * t).collect();
    // What the sum of squares falls by, and the way.
    let falls = |pattern: &[f64]| {
        let Score { along, square } = Score::new(&movable.rest(pattern), &missed, bins);
        along * along.abs() / square
    };
    falls(&lagging) >= falls(&line).abs()
}

/// What a lag adds to the closing ramp, in each bin.
fn lagging(solution: &Solution, bins: &[Bin], step: f64) -> Option<Vec<f64>> {
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
struct Movable<'a> {
    solution: &'a Solution,
    bins: &'a [Bin],
    /// Which.
    places: Vec<usize>,
    factor: Cholesky,
    /// How each bin moves with each.
    rows: Vec<Vec<f64>>,
    /// What each bin is missed by.
    missed: Vec<f64>,
}

impl<'a> Movable<'a> {
    fn new(solution: &'a Solution, bins: &'a [Bin], keep: impl Fn(usize) -> bool) -> Self {
        let places: Vec<usize> = solution.moving().into_iter().filter(|k| keep(*k)).collect();
        let row =
            |i: &usize| places.iter().map(|j| solution.normal[*i.max(j)][*i.min(j)]).collect();
        let factor = Cholesky::stiffened(&places.iter().map(row).collect::<Vec<_>>());
        let mut means = solution.signal.means();
        let mut moves = vec![0.0; solution.signal.len()];
        let (mut rows, mut missed) = (Vec::new(), Vec::new());
        for bin in bins {
            missed.push(bin.mean - means.over(bin.from, bin.to, &mut moves));
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
    fn rest(&self, pattern: &[f64]) -> Vec<f64> {
        self.less(pattern, &self.answer(pattern))
    }

    /// The pattern less what the curve's parameters make up for, which is how the light itself changes.
    fn without_levels(&self, pattern: &[f64]) -> Vec<f64> {
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

/// How much of a pattern is in what is missed.
struct Score {
    along: f64,
    square: f64,
}

impl Score {
    fn new(pattern: &[f64], missed: &[f64], bins: &[Bin]) -> Self {
        let (mut along, mut square) = (0.0, f64::MIN_POSITIVE);
        for ((bin, p), missed) in bins.iter().zip(pattern).zip(missed) {
            along += bin.samples * p * missed;
            square += bin.samples * p * p;
        }
        Self { along, square }
    }
}

/// The noise's power at the slow end, as the dark shows it.
struct Noise {
    power: f64,
    /// So many times as much of it is in full light.
    in_light: f64,
    /// By so many independent samples.
    known: f64,
}

impl Noise {
    fn new(fits: &FrameFits, kind: Kind) -> Option<Self> {
        let parts = Parts::new(fits, kind);
        let residuals = &fits.of(kind).residuals;
        let dark = [&residuals[parts.before], &residuals[parts.after]].concat();
        if dark.len() < LEAST_DARK {
            return None;
        }
        let n = dark.len() as f64;
        let level = dark.iter().sum::<f64>() / n;
        let dark: Vec<f64> = dark.iter().map(|r| r - level).collect();
        let correlation = correlation(&dark);
        let gain = fits.of(kind).solution.signal.gain;
        let least = (LEAST * gain).powi(2);
        let squares = dark.iter().map(|r| r * r).sum::<f64>();
        let power = correlation * (squares / (n - correlation) + least);
        let in_light = (fast(&residuals[parts.pulse]) + least) / (fast(&dark) + least);
        // How well a correlated noise's power is known was worked out for one that goes on from one sample to the next.
        Some(Self { power, in_light: in_light.max(1.0), known: n / (2.0 * correlation - 1.0) })
    }

    /// The variance that it gives a pattern's score.
    fn along(&self, pattern: &[f64], bins: &[Bin], exposure: &Exposure) -> f64 {
        let light =
            |bin: &Bin| 1.0 + (self.in_light - 1.0) * exposure.openness(0.5 * (bin.from + bin.to));
        bins.iter().zip(pattern).map(|(bin, p)| self.power * light(bin) * bin.samples * p * p).sum()
    }
}

/// By how much triggers move with such a change of the light, the root of their mean square, as a share of the exposure.
fn moves(fits: &FrameFits, kind: Kind, light: &[f64]) -> f64 {
    const TRIGGERS: u32 = 16;
    let exposure = fits.exposure(kind);
    let gain = fits.of(kind).solution.signal.gain;
    let mut sum = 0.0;
    let more = |(bin, light): (&Bin, &f64)| {
        sum += light / gain * (bin.to - bin.from);
        (bin.to, sum)
    };
    let sums: Vec<(f64, f64)> = fits.bins().iter().zip(light).map(more).collect();
    let off = |u: f64| {
        let t = exposure.trigger(u).0;
        let here = sums[..sums.partition_point(|(to, _)| *to <= t)].last().map_or(0.0, |x| x.1);
        (u * sum - here) / (least_open(&exposure, t) * exposure.area())
    };
    let squares = fractions(TRIGGERS).map(|u| off(u).powi(2)).sum::<f64>();
    (squares / f64::from(TRIGGERS)).sqrt()
}
