//! What may be added to a shutter's signal where the samples show it: a drift, a hum, the lamp's flicker.

use crate::bins::Bin;
use crate::hum::{self, Mains};
use crate::kind::KindFit;
use crate::lag::passes_for_columns;
use crate::noise::correlation;
use crate::signal::{Flicker, Signal};
use crate::solve::Problem;

/// A column is kept if the criterion falls by more than this.
const WORTH: f64 = 10.0;
/// So many standard errors between the drift and the dark before are no chance.
const UNLIKE: f64 = 4.0;
/// How often a lamp on the mains flickers, in hertz.
const MAINS: [f64; 2] = [100.0, 120.0];
/// Less than so many periods of it in a pulse cannot be told from the shutter's own shape.
const FEWEST: f64 = 2.0;

/// The fit with a drift and a hum, if they are worth it, or none where neither is.
pub fn with_columns(
    problem: &Problem,
    plain: &KindFit,
    samples: &[Bin],
    step: f64,
    mains: Mains,
) -> Option<KindFit> {
    let start = Signal { drift: Some(0.0), ..plain.solution.signal };
    let drifting = if_worth_it(problem, &start, plain, samples);
    let drifting = drifting.filter(|found| {
        drifts_before(found, samples) && !passes_for_columns(&found.solution, &problem.bins, step)
    });
    let humming = |without: &KindFit| {
        let found = humming(problem, without, samples, mains);
        found.filter(|found| !passes_for_columns(&found.solution, &problem.bins, step))
    };
    let alone = humming(plain);
    let Some(drifting) = drifting else { return alone };
    let both = humming(&drifting);
    // A hum of few periods may be all of the drift.
    let best = alone.filter(|alone| is_better(alone, &drifting, 0.0)).unwrap_or(drifting);
    Some(both.filter(|both| is_better(both, &best, WORTH)).unwrap_or(best))
}

/// Is the drift in the dark before the pulse as well, as far as that shows? What is in the dark after alone is a tail.
fn drifts_before(found: &KindFit, samples: &[Bin]) -> bool {
    let curve = found.solution.signal.curve;
    let before = samples.partition_point(|bin| bin.to < curve.start);
    let times = samples[..before].iter().map(|bin| bin.middle());
    let left: Vec<(f64, f64)> = times.zip(found.residuals.iter().copied()).collect();
    let n = left.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| left.iter().map(of).sum::<f64>() / n;
    let (time, level) = (mean(|x| x.0), mean(|x| x.1));
    let squares: f64 = left.iter().map(|(t, _)| (t - time).powi(2)).sum();
    let slope = left.iter().map(|(t, r)| (t - time) * (r - level)).sum::<f64>() / squares;
    let variance = found.variance() * correlation(&found.residuals);
    // Of two samples there is no slope to speak of.
    left.len() < 8 || slope.abs() <= UNLIKE * (variance / squares).sqrt()
}

/// With the strongest hum, if that is in the dark as well: what is in the pulse alone is the shutter's own.
fn humming(problem: &Problem, without: &KindFit, samples: &[Bin], mains: Mains) -> Option<KindFit> {
    let signal = without.solution.signal;
    let all = hum::strongest(&problem.bins, &signal, mains).into_iter();
    let found = all
        .filter_map(|hum| {
            let start = Signal { hum: Some(hum), ..signal };
            if_worth_it(problem, &start, without, samples)
        })
        .min_by(|a, b| a.squares.total_cmp(&b.squares))?;
    hum::is_one(&problem.bins, &found.solution.signal).then_some(found)
}

/// With the flicker of a lamp on the mains, if that is worth it. A unit of time is `second` seconds.
pub fn flickering(
    problem: &Problem,
    without: &KindFit,
    samples: &[Bin],
    second: f64,
) -> Option<KindFit> {
    let seen = MAINS.into_iter().filter(|hertz| hertz * second > FEWEST);
    let found = seen.filter_map(|hertz| {
        let flicker = Some(Flicker { frequency: hertz * second, terms: [0.0; 4] });
        let start = Signal { flicker, ..without.solution.signal };
        if_worth_it(problem, &start, without, samples)
    });
    found.min_by(|a, b| a.squares.total_cmp(&b.squares))
}

/// The best signal near `start`, which has more columns than `without`, if that is worth it.
fn if_worth_it(
    problem: &Problem,
    start: &Signal,
    without: &KindFit,
    samples: &[Bin],
) -> Option<KindFit> {
    let with = KindFit::new(problem.minimise(start), samples);
    is_better(&with, without, WORTH).then_some(with)
}

/// Is the criterion of one fit lower by so much? What it explains must not count as correlated noise.
fn is_better(with: &KindFit, without: &KindFit, by: f64) -> bool {
    let correlation = correlation(&with.residuals);
    with.bic(correlation) < without.bic(correlation) - by
}
