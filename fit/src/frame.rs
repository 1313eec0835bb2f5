//! One frame fitted by every kind of curve, in units of its own.

use crate::bins::{self, Bin};
use crate::curve::{Exposure, Whole, fractions};
use crate::noise::{self, slow_correlation};
use crate::search::every_kind;
use crate::signal::{Coupling, Kind, Signal};
use crate::solve::{Held, Problem, Solution};
use crate::trace::{Crossings, Frame, Pulses, Rates, Trace, sampling_interval, undone};
use crate::units::Units;

#[derive(Clone, Debug)]
pub struct FrameFits {
    pub units: Units,
    /// The samples, each with the time that it owns.
    pub samples: Vec<Bin>,
    /// The sampling interval.
    pub step: f64,
    /// What was solved.
    pub problem: Problem,
    crossings: Crossings,
    /// Of each kind, simplest first.
    kinds: Vec<KindFit>,
    /// How many samples stand for one that is independent of the others: by the freest kind's residuals where that
    /// explains them, else by those in the dark.
    pub correlation: f64,
    /// The standard deviation that a step of the values puts into all of a plateau alike, as a share of the light.
    pub rounding: f64,
}

impl FrameFits {
    /// Fits every kind without columns; `progress` is told the share that is done.
    pub fn new(pulses: &Pulses, frame: &Frame, progress: &mut dyn FnMut(f64)) -> Self {
        let units = Units::new(frame, pulses.levels);
        let crossings = units.crossings(frame);
        let trace = units.inside(pulses.recorded().part(&frame.samples));
        let step = sampling_interval(&trace.times);

        let samples = bins::each(&trace);
        let bins = bins::shared(&samples, &crossings, step);
        let noise = pulses.relative_noise().max(noise::LEAST);
        // A control number is 0.5 of the way around a straight ramp's, give or take.
        let problem = Problem { bins, prior: 4.0 * noise * noise, held: None };
        let rounding = pulses.rounding / pulses.light();
        let (kinds, correlation) = (Vec::new(), 1.0);
        let mut fits = Self { units, samples, step, problem, crossings, kinds, correlation, rounding };

        let coupled = |(_, rates): &(_, Rates)| Coupling {
            charge: 0.0,
            rates: rates.map(|rate| rate.map(|rate| rate * units.pulse)),
            held: false,
        };
        let coupling = pulses.coupled.as_ref().map(coupled);
        fits.search(&Signal { coupling, ..Signal::plain() }, progress);
        fits
    }

    /// Searches for every kind's best signal, from what `like` has beside its curve.
    fn search(&mut self, like: &Signal, progress: &mut dyn FnMut(f64)) {
        let found = every_kind(&self.problem, &self.crossings, self.step, like, progress);
        self.kinds = found.into_iter().map(|best| KindFit::new(best, &self.samples)).collect();
        self.correlation = slow_correlation(&self.of(Kind::Free).residuals);
    }

    /// The same from the columns of a fit of the freest kind, which may be better than where the search ends.
    pub fn search_with(&mut self, free: KindFit, progress: &mut dyn FnMut(f64)) {
        self.search(&free.solution.signal, progress);
        let last = &mut self.kinds[Kind::Free as usize];
        if free.solution.cost < last.solution.cost {
            *last = free;
            self.correlation = slow_correlation(&last.residuals);
        }
    }

    /// The same with another fit of the freest kind.
    pub fn with(&self, free: KindFit) -> Self {
        let mut others = self.clone();
        others.correlation = slow_correlation(&free.residuals);
        others.kinds[Kind::Free as usize] = free;
        others
    }

    /// Each sample as an openness, by a kind's levels, drift, hum and flicker.
    pub fn opened(&self, kind: Kind) -> Vec<f64> {
        let fitted = self.of(kind);
        let signal = fitted.solution.signal;
        let integral = self.exposure(kind);
        let mut missed = fitted.residuals.clone();
        for rate in signal.coupling.iter().flat_map(Coupling::rates) {
            let mut charge = 0.0;
            for (bin, r) in self.samples.iter().zip(&mut missed) {
                // A capacitor takes its share of what is missed as well.
                charge += rate * bin.width() * *r;
                *r += charge - 0.5 * rate * bin.width() * *r;
            }
        }
        let each = self.samples.iter().zip(missed);
        each.map(|(bin, r)| {
            let lamp = signal.lamp(bin.middle(), bin.width());
            integral.mean(bin.from, bin.to) + r / (signal.gain * lamp.max(0.1))
        })
        .collect()
    }

    /// The fitted samples with what the freest kind's capacitors took, and with the dark at its first level.
    pub fn uncoupled(&self, recorded: Trace) -> Trace {
        let Signal { dark, coupling, .. } = self.units.outside(&self.of(Kind::Free).solution.signal);
        let Some(Coupling { charge, rates, .. }) = coupling else { return recorded };
        undone(&recorded, rates, dark + charge)
    }

    /// The samples, as far as neighbours share a bin.
    pub fn bins(&self) -> &[Bin] {
        &self.problem.bins
    }

    pub fn of(&self, kind: Kind) -> &KindFit {
        &self.kinds[kind as usize]
    }

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

    /// By how much a kind's sum of squares grows if its curve is to have so much more of something. `near` becomes the
    /// best signal with that.
    pub fn cost_of(&self, kind: Kind, whole: Whole, more: f64, near: &mut Signal) -> f64 {
        let solution = &self.of(kind).solution;
        let target = whole(&solution.signal.curve).0 + more;
        // Stiff enough to be kept to a hundredth, without any noise too.
        let least = self.samples.len() as f64 * noise::LEAST * noise::LEAST;
        let weight = 1e4 * solution.cost.max(least) / (more * more);
        let held = Some(Held { whole, target, weight });
        let stiff = Problem { held, ..self.problem.clone() };
        *near = stiff.minimise(near).signal;
        self.problem.at(near).cost - solution.cost
    }
}

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
        let residuals = solution.signal.missed(samples);
        let squares = residuals.iter().map(|r| r * r).sum();
        Self { solution, residuals, squares }
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
