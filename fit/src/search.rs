//! The best signal of every kind: the solver from each kind's starts.

use crate::curve::Curve;
use crate::signal::{Kind, Signal};
use crate::solve::{Problem, Solution};
use crate::starts::{from_simpler, through_crossings};
use crate::trace::Crossings;

/// So many of the starts are followed, those that are best as they are.
const FOLLOWED: usize = 6;

/// What is searched for: a problem, and the pulse that the starts are laid through.
pub struct Search<'a> {
    pub problem: &'a Problem,
    pub crossings: &'a Crossings,
    /// The sampling interval.
    pub step: f64,
}

impl Search<'_> {
    /// Every kind's best signal, simplest first. What is not the curve's starts as it is in `like`, for each kind anew: a hum's
    /// frequency, say, that the misfit of a simple kind has led astray is not handed on to the next.
    pub fn every_kind(&self, like: &Signal, progress: &mut dyn FnMut(f64)) -> Vec<Solution> {
        let mut found: Vec<Solution> = Vec::new();
        for kind in Kind::ALL {
            progress(found.len() as f64 / Kind::ALL.len() as f64);
            let simpler = found.last().map(|simpler| simpler.signal.curve);
            found.push(self.best(kind, simpler, like));
        }
        found
    }

    /// The best signal of a kind near its starts, and near the best curve of the next simpler kind.
    fn best(&self, kind: Kind, simpler: Option<Curve>, like: &Signal) -> Solution {
        let signal = |curve: Curve| Signal { kind, curve, ..*like };
        let starts = through_crossings(kind, self.crossings, self.step);
        let mut ranked: Vec<(f64, Curve)> =
            starts.into_iter().map(|curve| (self.problem.at(&signal(curve)).cost, curve)).collect();
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
        let followed = ranked.iter().map(|(_, curve)| *curve).take(FOLLOWED);
        let nested = simpler.map(|simpler| from_simpler(kind, &simpler, self.step));
        followed
            .chain(nested)
            .map(|curve| self.problem.minimise(&signal(curve)))
            .reduce(|best, next| if next.cost < best.cost { next } else { best })
            .expect("every kind has a start")
    }
}
