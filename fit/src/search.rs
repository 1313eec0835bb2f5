//! The best signal of every kind: the solver from each kind's starts.

use crate::curve::Curve;
use crate::signal::{Kind, Signal};
use crate::solve::{Problem, Solution};
use crate::starts::{from_simpler, through_crossings};
use crate::trace::Crossings;

/// So many of the starts are followed, those that are best as they are.
const FOLLOWED: usize = 6;

/// Every kind's best signal, simplest first, in pulses with these crossings and samples a `step` apart: near each kind's starts, and
/// near the best curve of the next simpler kind. What is not the curve's starts as it is in `like`, for each kind anew: a hum's
/// frequency, say, that the misfit of a simple kind has led astray is not handed on to the next.
pub fn every_kind(
    problem: &Problem,
    crossings: &Crossings,
    step: f64,
    like: &Signal,
    progress: &mut dyn FnMut(f64),
) -> Vec<Solution> {
    let mut found: Vec<Solution> = Vec::new();
    for kind in Kind::ALL {
        progress(found.len() as f64 / Kind::ALL.len() as f64);
        let signal = |curve: Curve| Signal { kind, curve, ..*like };
        let cost = |curve: Curve| (problem.at(&signal(curve)).cost, curve);
        let mut ranked: Vec<_> =
            through_crossings(kind, crossings, step).into_iter().map(cost).collect();
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
        let nested = found.last().map(|it| from_simpler(kind, &it.signal.curve, step));
        let followed = ranked.iter().map(|(_, curve)| *curve).take(FOLLOWED).chain(nested);
        let all = followed.map(|curve| problem.minimise(&signal(curve)));
        let best = all.reduce(|best, next| if next.cost < best.cost { next } else { best });
        found.push(best.expect("every kind has a start"));
    }
    found
}
