//! What may be added to a shutter's signal where the samples show it: a drift, a hum.

use super::bins::Bin;
use super::frame::KindFit;
use super::hum;
use super::noise::correlation;
use super::signal::Signal;
use super::solve::Problem;

/// A column is kept if the criterion falls by more than this.
const WORTH: f64 = 10.0;

/// The fit with the columns that are worth it, or none where none is.
pub fn with_columns(problem: &Problem, plain: &KindFit, samples: &[Bin]) -> Option<KindFit> {
    let start = Signal { drift: Some(0.0), ..plain.solution.signal };
    let drifting = if_worth_it(problem, &start, plain, samples);

    let without = drifting.as_ref().unwrap_or(plain);
    let signal = without.solution.signal;
    let humming = hum::strongest(&problem.bins, &signal).and_then(|hum| {
        let start = Signal { hum: Some(hum), ..signal };
        if_worth_it(problem, &start, without, samples)
    });
    humming.or(drifting)
}

/// The best signal near `start`, which has one more column than `without`, if that is worth it.
fn if_worth_it(
    problem: &Problem,
    start: &Signal,
    without: &KindFit,
    samples: &[Bin],
) -> Option<KindFit> {
    let with = KindFit::new(problem.minimise(start), samples);
    // What the column explains must not count as correlated noise.
    let correlation = correlation(&with.residuals);
    (with.bic(correlation) < without.bic(correlation) - WORTH).then_some(with)
}
