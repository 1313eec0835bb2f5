//! One frame fitted by every kind of curve, with the columns that it asks for, in units of its own.

use super::bins::{self, Bin};
use super::columns::with_columns;
use super::curve::{Exposure, Whole, fractions};
use super::noise::{self, correlation};
use super::search::Search;
use super::signal::{Kind, Signal};
use super::solve::{Held, Problem, Solution};
use super::units::Units;
use crate::trace::{Frame, Pulses, sampling_interval};

/// A kind's best signal.
#[derive(Clone, Debug)]
pub struct KindFit {
    pub solution: Solution,
    /// What each sample is missed by.
    pub residuals: Vec<f64>,
    /// The sum of their squares.
    pub squares: f64,
}

impl KindFit {
    pub fn new(solution: Solution, samples: &[Bin]) -> Self {
        let mut moves = vec![0.0; solution.signal.len()];
        let mut means = solution.signal.means();
        let residuals: Vec<f64> =
            samples.iter().map(|bin| bin.mean - means.over(bin.from, bin.to, &mut moves)).collect();
        let squares = residuals.iter().map(|r| r * r).sum();
        Self { solution, residuals, squares }
    }

    fn all(solutions: Vec<Solution>, samples: &[Bin]) -> Vec<Self> {
        solutions.into_iter().map(|solution| Self::new(solution, samples)).collect()
    }

    /// The mean of the residuals' squares.
    pub fn variance(&self) -> f64 {
        self.squares / self.residuals.len() as f64
    }

    /// Schwarz's criterion, where so many samples stand for an independent one.
    pub fn bic(&self, correlation: f64) -> f64 {
        let effective = self.residuals.len() as f64 / correlation;
        let variance = self.variance().max(noise::LEAST * noise::LEAST);
        effective * variance.ln() + self.solution.signal.len() as f64 * effective.ln()
    }
}

/// A frame's fits.
#[derive(Clone, Debug)]
pub struct FrameFits {
    pub units: Units,
    /// The samples, each with the time that it owns.
    pub samples: Vec<Bin>,
    /// The sampling interval.
    pub step: f64,
    /// What was solved.
    problem: Problem,
    /// Of each kind, simplest first.
    kinds: Vec<KindFit>,
    /// How many samples stand for one that is independent of the others, by the freest kind's residuals.
    pub correlation: f64,
}

impl FrameFits {
    /// Fits every kind; `progress` is told the share that is done, as far as that is known.
    pub fn new(pulses: &Pulses, frame: &Frame, progress: &mut dyn FnMut(f64)) -> Self {
        let units = Units::new(frame, pulses.levels);
        let crossings = frame.crossings.map(|t| units.time(t));
        let trace = units.inside(pulses.trace.part(&frame.samples));
        let step = sampling_interval(&trace.times);

        let samples = bins::each(&trace);
        let bins = bins::shared(&samples, &crossings, step);
        let noise = pulses.relative_noise().max(noise::LEAST);
        // A control number is 0.5 of the way around a straight ramp's, give or take.
        let problem = Problem { bins, prior: 4.0 * noise * noise, held: None };

        // If a column turns out to be worth it, the search comes twice, half of the way each.
        let search = Search { problem: &problem, crossings: &crossings, step };
        let plain = search.every_kind(&Signal::plain(), &mut |done| progress(0.5 * done));
        let mut kinds = KindFit::all(plain, &samples);
        if let Some(free) = with_columns(&problem, &kinds[Kind::Free as usize], &samples) {
            let like = &free.solution.signal;
            let found = search.every_kind(like, &mut |done| progress(0.5 + 0.5 * done));
            kinds = KindFit::all(found, &samples);
            // What is known already may be better than where the search ends.
            let last = &mut kinds[Kind::Free as usize];
            if free.solution.cost < last.solution.cost {
                *last = free;
            }
        }
        let correlation = correlation(&kinds[Kind::Free as usize].residuals);
        Self { units, samples, step, problem, kinds, correlation }
    }

    /// A kind's best signal.
    pub fn of(&self, kind: Kind) -> &KindFit {
        &self.kinds[kind as usize]
    }

    /// So many samples count.
    pub fn effective(&self) -> f64 {
        self.samples.len() as f64 / self.correlation
    }

    /// Schwarz's criterion.
    pub fn bic(&self, kind: Kind) -> f64 {
        self.of(kind).bic(self.correlation)
    }

    /// Akaike's criterion.
    pub fn aic(&self, kind: Kind) -> f64 {
        let parameters = self.of(kind).solution.signal.len() as f64;
        self.bic(kind) + parameters * (2.0 - self.effective().ln())
    }

    /// A kind's curve with its integral.
    pub fn exposure(&self, kind: Kind) -> Exposure {
        Exposure::new(&self.of(kind).solution.signal.curve)
    }

    /// A kind's `n` trigger times.
    pub fn triggers(&self, kind: Kind, n: u32) -> Vec<f64> {
        let exposure = self.exposure(kind);
        fractions(n).map(|u| exposure.trigger(u).0).collect()
    }

    /// By how much a kind's sum of squares grows if its curve is to have so much more of something.
    pub fn cost_of(&self, kind: Kind, whole: Whole, more: f64) -> f64 {
        let solution = &self.of(kind).solution;
        let target = whole.of(&solution.signal.curve).0 + more;
        // Stiff enough to be kept to a hundredth.
        let weight = 1e4 * solution.cost / (more * more);
        let held = Some(Held { whole, target, weight });
        let stiff = Problem { held, ..self.problem.clone() };
        self.problem.at(&stiff.minimise(&solution.signal).signal).cost - solution.cost
    }
}
