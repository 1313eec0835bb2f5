//! What the noise makes of the results: standard errors from the normal equations.

use super::curve::{CONTROLS, Curve, Exposure, PARAMETERS, Whole};
use super::frame::{FrameFit, Missed, fractions};
use super::signal::Kind;
use super::solve::Cholesky;

/// Below this openness nobody knows a ramp's shape, unless it is straight: the time that it spends there is the standard error
/// of its end beside the noise's, and this openness for so long that of its light.
const FOOT: f64 = 0.005;
/// A plateau that is shorter than this share of the whole is a peak, or may be.
const PEAK: f64 = 0.1;

/// A value and its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The value.
    pub value: f64,
    /// One standard deviation of it.
    pub error: f64,
}

/// How the parameters of a fitted curve vary together.
pub struct Covariance {
    kind: Kind,
    /// Of the parameters that are on no bound.
    moving: Vec<usize>,
    factor: Option<Cholesky>,
    /// What the inverse is multiplied by: the noise's variance, for correlated samples.
    variance: f64,
    /// The variance of each edge beside it: a sample tells an edge's side, not its place.
    edges: [f64; 2],
}

impl Covariance {
    pub fn new(fit: &FrameFit, kind: Kind) -> Self {
        let fitted = &fit.kinds[kind as usize];
        let solution = &fitted.solution;
        let (packed, bounds) = (solution.signal.pack(), solution.signal.bounds());
        // A ramp of no length has nothing to vary. A control number on its bound has: one way, and that counts as both.
        let on_bound = |k: &usize| *k < CONTROLS && packed[*k] <= bounds[*k].0;
        let moving: Vec<usize> = (0..packed.len()).filter(|k| !on_bound(k)).collect();
        let cell =
            |i: usize, j: usize| solution.normal[i][j] * if i == j { 1.0 + 1e-10 } else { 1.0 };
        let matrix: Vec<Vec<f64>> =
            moving.iter().map(|i| moving.iter().map(|j| cell(*i, *j)).collect()).collect();
        let n = fit.samples.len() as f64;
        let free = (n - packed.len() as f64 * fit.correlation).max(0.5 * n);
        let curve = solution.signal.curve;
        let edge =
            |ramp: f64| fit.step * fit.step / 12.0 * (1.0 - ramp / (2.0 * fit.step)).max(0.0);
        Self {
            kind,
            moving,
            factor: Cholesky::new(matrix),
            variance: fitted.squares / free * fit.correlation,
            edges: [edge(curve.opening), edge(curve.closing)],
        }
    }

    /// The standard error of what moves so with a curve's parameters.
    pub fn error(&self, moves: &[f64; PARAMETERS]) -> f64 {
        let mut gathered = vec![0.0; self.kind.parameters()];
        self.kind.gather(moves, &mut gathered);
        let row: Vec<f64> =
            self.moving.iter().map(|k| gathered.get(*k).copied().unwrap_or(0.0)).collect();
        let Some(factor) = &self.factor else { return f64::INFINITY };
        let noise: f64 = factor.solve(&row).iter().zip(&row).map(|(a, b)| a * b).sum();
        // The opening edge moves the start and leaves the end; the closing one lengthens the plateau.
        let (opening, closing) = (moves[0] - moves[2], moves[2]);
        let edges = opening * opening * self.edges[0] + closing * closing * self.edges[1];
        (noise * self.variance + edges).sqrt()
    }
}

/// What a curve is good for, in the frame's unit of time.
pub struct Results {
    pub exposure: Measured,
    pub efficiency: Measured,
    pub triggers: Vec<Measured>,
}

/// The exposure, the efficiency and the times of `n` triggers of a kind's curve.
///
/// That a freer kind might be true belongs to the error: Burnham and Anderson's variance, in which each kind counts by its
/// Akaike weight, with its own variance and how far it lies from this one.
pub fn results(fit: &FrameFit, kind: Kind, n: u32) -> Results {
    let mut chosen = of_kind(fit, kind, n);
    let freer = || Kind::ALL.into_iter().filter(|k| *k >= kind);
    let least = freer().map(|k| fit.aic(k)).fold(f64::INFINITY, f64::min);
    let weights: Vec<f64> = freer().map(|k| (0.5 * (least - fit.aic(k))).exp()).collect();
    let sum: f64 = weights.iter().sum();
    let all: Vec<(f64, Results)> = freer()
        .zip(weights)
        .filter(|(_, weight)| *weight > 1e-3 * sum)
        .map(|(k, weight)| (weight / sum, of_kind(fit, k, n)))
        .collect();
    let widen = |to: &mut Measured, of: &dyn Fn(&Results) -> Measured| {
        let variance = |m: Measured| m.error * m.error + (m.value - to.value).powi(2);
        to.error = all.iter().map(|(w, results)| w * variance(of(results))).sum::<f64>().sqrt();
    };
    widen(&mut chosen.exposure, &|results| results.exposure);
    widen(&mut chosen.efficiency, &|results| results.efficiency);
    for (i, trigger) in chosen.triggers.iter_mut().enumerate() {
        widen(trigger, &|results| results.triggers[i]);
    }
    chosen
}

fn of_kind(fit: &FrameFit, kind: Kind, n: u32) -> Results {
    let covariance = Covariance::new(fit, kind);
    let curve = fit.kinds[kind as usize].solution.signal.curve;
    let exposure = Exposure::new(&curve);
    let whole = exposure.whole().moves;
    let (area, length) = (exposure.area(), curve.length());
    let linear = |moves: &[f64; PARAMETERS]| covariance.error(moves);
    let searched = |of: Whole, linear| searched_error(fit, kind, of, linear, covariance.variance);
    // Noise hides how high a peak is, and so what full light is: without much of a plateau, that is not linear.
    let is_peak = curve.plateau < PEAK * length;
    let noise = if is_peak { searched(Whole::Area, linear(&whole)) } else { linear(&whole) };
    let is_straight = kind <= Kind::Trapezoid;
    let feet = if is_straight { [0.0; 2] } else { exposure.feet(FOOT) };
    let unseen = feet.map(|time| FOOT * time);
    let light = unseen.into_iter().fold(noise, f64::hypot);
    let ratio = std::array::from_fn(|k| (whole[k] - area / length * Curve::LENGTH[k]) / length);
    let share = if is_straight && !is_peak {
        linear(&ratio)
    } else {
        let noise = linear(&Curve::LENGTH);
        let noise = if is_straight { noise } else { searched(Whole::Length, noise) };
        let ends = feet.into_iter().fold(noise, f64::hypot);
        (light / length).hypot(area / length * ends / length)
    };
    let mut triggers: Vec<Measured> = fractions(n)
        .map(|u| {
            let (value, moves) = exposure.trigger(u);
            Measured { value, error: linear(&moves) }
        })
        .collect();
    let beside = misfit(fit, kind, &triggers);
    for (u, trigger) in fractions(n).zip(&mut triggers) {
        // More light in the first foot makes a trigger earlier, more in the last one makes it later.
        let [before, after] = [(1.0 - u) * unseen[0], u * unseen[1]];
        let foot = before.hypot(after) / exposure.openness(trigger.value).max(1e-3);
        trigger.error = trigger.error.hypot(beside).hypot(foot);
    }
    Results {
        exposure: Measured { value: area, error: light },
        efficiency: Measured { value: area / length, error: share },
        triggers,
    }
}

/// The standard error of what is not linear in the samples, by how far the sum of squares lets it go either way.
///
/// Where a soft ramp starts is such a thing: a control number makes up for most of a shift, and only the square of the shift
/// shows. So the 95 % interval is looked for, and 1.96 standard errors are said to be its longer side.
fn searched_error(fit: &FrameFit, kind: Kind, whole: Whole, linear: f64, variance: f64) -> f64 {
    const SIDE: f64 = 1.96;
    let value = whole.of(&fit.kinds[kind as usize].solution.signal.curve).0;
    let (least, most) = (1e-4 * value, 0.5 * value);
    let side = |way: f64| {
        let mut by = if linear.is_finite() {
            (SIDE * linear).clamp(least, 0.1 * value)
        } else {
            0.1 * value
        };
        for _ in 0..8 {
            let cost = fit.cost_of(kind, whole, way * by) / (SIDE * SIDE * variance);
            if (0.8..1.25).contains(&cost) {
                break;
            }
            // Between a square and the fourth power.
            by = (by * cost.max(1e-3).powf(-1.0 / 3.0)).clamp(least, most);
        }
        by
    };
    side(1.0).max(side(-1.0)) / SIDE
}

/// What the model's shape itself is wrong by, as the samples show it: the standard deviation of the triggers' times beyond
/// what noise makes of them.
///
/// The residuals add up to what the model's integral misses. By that each trigger is off, and noise alone would put it off
/// by a random walk whose ends are tied.
fn misfit(fit: &FrameFit, kind: Kind, triggers: &[Measured]) -> f64 {
    let fitted = &fit.kinds[kind as usize];
    let [start, _, _, end] = fitted.solution.signal.curve.times();
    let variance = fitted.squares / fit.samples.len() as f64 * fit.correlation * fit.step;
    let missed = Missed::new(fit, kind);
    let excess = fractions(triggers.len() as u32).zip(triggers).map(|(u, trigger)| {
        let t = trigger.value;
        let (off, slope) = (missed.off(u, t), missed.slope(t));
        let walk = variance * (u * u * (end - t) + (1.0 - u) * (1.0 - u) * (t - start));
        off * off - (walk / (slope * slope) - trigger.error * trigger.error).max(0.0)
    });
    (excess.sum::<f64>() / triggers.len() as f64).max(0.0).sqrt()
}
