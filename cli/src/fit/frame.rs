//! One frame fitted: every kind of curve, with the columns that the frame asks for, in units of the frame's own.

use super::bins::{self, Bin};
use super::curve::{Curve, Exposure, Whole};
use super::hum;
use super::signal::{Hum, Kind, Signal};
use super::solve::{Problem, Solution};
use super::starts::{self, Crossings};
use crate::trace::{Frame, Pulses};

/// A column is kept if the criterion falls by more than this.
const WORTH: f64 = 10.0;
/// The least standard deviation that counts, as a share of the light: below, rounding and the model's own limits rule.
const LEAST: f64 = 1e-5;

/// The frame's own units: time counts from the pulse's middle in pulses, the signal from the dark in light.
#[derive(Clone, Copy, Debug)]
pub struct Units {
    middle: f64,
    pulse: f64,
    dark: f64,
    light: f64,
}

impl Units {
    fn new(frame: &Frame, (dark, light): (f64, f64)) -> Self {
        let [_, rise, .., fall, _] = frame.crossings;
        Self { middle: 0.5 * (rise + fall), pulse: fall - rise, dark, light }
    }

    /// A time in seconds from one in pulses.
    pub fn seconds(&self, t: f64) -> f64 {
        self.middle + self.pulse * t
    }

    fn time(&self, seconds: f64) -> f64 {
        (seconds - self.middle) / self.pulse
    }

    fn value(&self, v: f64) -> f64 {
        (v - self.dark) / self.light
    }

    /// How many seconds the unit of time is.
    pub fn pulse(&self) -> f64 {
        self.pulse
    }

    /// The signal in the trace's units, its drift and its hum around the pulse's middle.
    pub fn outside(&self, signal: &Signal) -> Signal {
        Signal {
            kind: signal.kind,
            curve: signal.curve.mapped(self.pulse, self.middle),
            dark: self.dark + self.light * signal.dark,
            gain: self.light * signal.gain,
            drift: signal.drift.map(|drift| drift * self.light / self.pulse),
            hum: signal.hum.map(|Hum { frequency, cosine, sine }| Hum {
                frequency: frequency / self.pulse,
                cosine: cosine * self.light,
                sine: sine * self.light,
            }),
        }
    }
}

/// A kind's best signal.
#[derive(Clone, Debug)]
pub struct Fitted {
    pub solution: Solution,
    /// What each sample is missed by.
    pub residuals: Vec<f64>,
    /// The sum of their squares.
    pub squares: f64,
}

/// A frame's fits.
#[derive(Clone, Debug)]
pub struct FrameFit {
    pub units: Units,
    /// The samples, each with the time that it owns.
    pub samples: Vec<Bin>,
    /// What was fitted of them.
    bins: Vec<Bin>,
    prior: f64,
    /// The sampling interval.
    pub step: f64,
    /// Of each kind, simplest first.
    pub kinds: Vec<Fitted>,
    /// How many samples stand for one that is independent of the others, by the freest kind's residuals.
    pub correlation: f64,
}

impl FrameFit {
    /// Fits every kind; `progress` is told the share that is done, as far as that is known.
    pub fn new(pulses: &Pulses, frame: &Frame, progress: &mut dyn FnMut(f64)) -> Self {
        let units = Units::new(frame, pulses.levels);
        let times: Vec<f64> =
            pulses.trace.times[frame.samples.clone()].iter().map(|t| units.time(*t)).collect();
        let values: Vec<f64> =
            pulses.trace.values[frame.samples.clone()].iter().map(|v| units.value(*v)).collect();
        let crossings = frame.crossings.map(|t| units.time(t));
        let samples = bins::each(&times, &values);
        let step = (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64;
        let bins = bins::shared(&samples, around(&crossings, step));
        let noise = (pulses.noise / pulses.light()).max(LEAST);
        // A control number is 0.5 of the way around a straight ramp's, give or take.
        let prior = 4.0 * noise * noise;
        let problem = Problem { bins: &bins, prior, held: None };

        let plain = Signal {
            kind: Kind::Box,
            curve: Curve::trapezoid(0.0, 0.0, 1.0, 0.0),
            dark: 0.0,
            gain: 1.0,
            drift: None,
            hum: None,
        };
        // If a column turns out to be worth it, all of this comes twice.
        let mut solutions = every_kind(&problem, &crossings, step, &plain, &mut |done| {
            progress(0.5 * done);
        });
        let mut free = Fitted::new(solutions[Kind::Free as usize].clone(), &samples);
        let mut columns = false;
        for column in [Column::Drift, Column::Hum] {
            if let Some(better) = column.add(&problem, &free, &samples) {
                free = better;
                columns = true;
            }
        }
        if columns {
            solutions =
                every_kind(&problem, &crossings, step, &free.solution.signal, &mut |done| {
                    progress(0.5 + 0.5 * done);
                });
            let last = &mut solutions[Kind::Free as usize];
            if free.solution.cost < last.cost {
                *last = free.solution;
            }
        }
        let kinds: Vec<Fitted> =
            solutions.into_iter().map(|solution| Fitted::new(solution, &samples)).collect();
        let correlation = correlation(&kinds[Kind::Free as usize].residuals);
        Self { units, samples, bins, prior, step, kinds, correlation }
    }

    /// By how much a kind's sum of squares grows if its curve is to have so much more of something.
    pub fn cost_of(&self, kind: Kind, whole: Whole, more: f64) -> f64 {
        let solution = &self.kinds[kind as usize].solution;
        // Stiff enough to be kept to a hundredth.
        let stiff = 1e4 * solution.cost / (more * more);
        let target = whole.of(&solution.signal.curve).0 + more;
        let problem = |held| Problem { bins: &self.bins, prior: self.prior, held };
        let held = problem(Some((whole, target, stiff))).minimise(&solution.signal);
        problem(None).at(&held.signal).cost - solution.cost
    }

    /// So many samples count.
    pub fn effective(&self) -> f64 {
        self.samples.len() as f64 / self.correlation
    }

    /// A kind's exposure.
    pub fn area(&self, kind: Kind) -> f64 {
        Exposure::new(&self.kinds[kind as usize].solution.signal.curve).area()
    }

    /// A kind's `n` trigger times.
    pub fn triggers(&self, kind: Kind, n: u32) -> Vec<f64> {
        let exposure = Exposure::new(&self.kinds[kind as usize].solution.signal.curve);
        fractions(n).map(|u| exposure.trigger(u).0).collect()
    }

    /// The trigger times as the samples have them: those of the freest kind, put right by what it misses.
    pub fn measured_triggers(&self, n: u32) -> Vec<f64> {
        let missed = Missed::new(self, Kind::Free);
        fractions(n)
            .map(|u| missed.exposure.trigger(u).0)
            .zip(fractions(n))
            .map(|(t, u)| t + missed.off(u, t))
            .collect()
    }

    /// Schwarz's criterion.
    pub fn bic(&self, kind: Kind) -> f64 {
        self.kinds[kind as usize].bic(self.samples.len() as f64, self.correlation)
    }

    /// Akaike's criterion.
    pub fn aic(&self, kind: Kind) -> f64 {
        let parameters = self.kinds[kind as usize].solution.signal.len() as f64;
        self.bic(kind) + parameters * (2.0 - self.effective().ln())
    }
}

impl Fitted {
    fn new(solution: Solution, samples: &[Bin]) -> Self {
        let mut moves = vec![0.0; solution.signal.len()];
        let mut means = solution.signal.means();
        let residuals: Vec<f64> =
            samples.iter().map(|bin| bin.mean - means.over(bin.from, bin.to, &mut moves)).collect();
        let squares = residuals.iter().map(|r| r * r).sum();
        Self { solution, residuals, squares }
    }

    fn bic(&self, samples: f64, correlation: f64) -> f64 {
        let effective = samples / correlation;
        let variance = (self.squares / samples).max(LEAST * LEAST);
        effective * variance.ln() + self.solution.signal.len() as f64 * effective.ln()
    }
}

/// The fractions of the exposure at which `n` triggers come.
pub fn fractions(n: u32) -> impl Iterator<Item = f64> {
    (0..n).map(move |i| (f64::from(i) + 0.5) / f64::from(n))
}

/// What a kind's curve misses of the samples, added up along the pulse.
pub struct Missed {
    pub exposure: Exposure,
    gain: f64,
    /// Up to each time.
    sums: Vec<(f64, f64)>,
}

impl Missed {
    pub fn new(fit: &FrameFit, kind: Kind) -> Self {
        let fitted = &fit.kinds[kind as usize];
        let signal = fitted.solution.signal;
        let [start, _, _, end] = signal.curve.times();
        let inside = fit.samples.iter().zip(&fitted.residuals);
        let inside = inside.filter(|(bin, _)| bin.to > start && bin.from < end);
        let mut sum = 0.0;
        let sums = inside
            .map(|(bin, residual)| {
                sum += residual * (bin.to - bin.from);
                (bin.to, sum)
            })
            .collect();
        Self { exposure: Exposure::new(&signal.curve), gain: signal.gain, sums }
    }

    /// The openness times the light at a time, not too near to 0.
    pub fn slope(&self, t: f64) -> f64 {
        self.exposure.openness(t).max(1e-3) * self.gain
    }

    /// By how much the samples put the time at which `u` is collected later than the curve, which says `t`.
    pub fn off(&self, u: f64, t: f64) -> f64 {
        let until = &self.sums[..self.sums.partition_point(|(to, _)| *to <= t)];
        let here = until.last().map_or(0.0, |(_, sum)| *sum);
        let whole = self.sums.last().map_or(0.0, |(_, sum)| *sum);
        (u * whole - here) / self.slope(t)
    }
}

/// Every kind's best signal. Levels and columns start as they are in `like`: a hum's frequency, say, that the misfit of
/// a simple kind has led astray is not handed on to the next.
fn every_kind(
    problem: &Problem,
    crossings: &Crossings,
    step: f64,
    like: &Signal,
    progress: &mut dyn FnMut(f64),
) -> Vec<Solution> {
    let mut found: Vec<Solution> = Vec::new();
    for kind in Kind::ALL {
        progress(found.len() as f64 / Kind::ALL.len() as f64);
        found.push(starts::search(problem, kind, crossings, step, found.last(), like));
    }
    found
}

/// What may be added to a shutter's signal.
#[derive(Clone, Copy)]
enum Column {
    Drift,
    Hum,
}

impl Column {
    /// The signal with the column, if that is worth it.
    fn add(self, problem: &Problem, without: &Fitted, samples: &[Bin]) -> Option<Fitted> {
        let signal = without.solution.signal;
        let start = match self {
            Self::Drift => Signal { drift: Some(0.0), ..signal },
            Self::Hum => Signal { hum: Some(hum::strongest(problem.bins, signal)?), ..signal },
        };
        let with = Fitted::new(problem.minimise(&start), samples);
        let n = samples.len() as f64;
        // What the column explains must not count as correlated noise.
        let correlation = correlation(&with.residuals);
        (with.bic(n, correlation) < without.bic(n, correlation) - WORTH).then_some(with)
    }
}

/// Where intervals are to be short: a ramp's quarters and as much again on both sides, and the far tail that a
/// slow end may have.
fn around(crossings: &Crossings, step: f64) -> [(f64, f64); 2] {
    let [up25, _, up75, down75, _, down25] = *crossings;
    let wide = |a: f64, b: f64| 1.5 * (b - a) + 10.0 * step;
    let (up, down) = (wide(up25, up75), wide(down75, down25));
    [(up25 - up, up75 + up), (down75 - down, down25 + down)]
}

/// How many samples stand for an independent one: the power of the residuals at frequency 0 over their variance.
///
/// By an autoregressive model (Yule and Walker's equations, solved by Levinson and Durbin, the order by Akaike's criterion):
/// the sum of the residuals' correlations itself comes out too low, because a fit takes the slowest part of the noise away.
pub fn correlation(residuals: &[f64]) -> f64 {
    let n = residuals.len();
    let lagged = |lag: usize| -> f64 {
        residuals[lag.min(n)..].iter().zip(residuals).map(|(a, b)| a * b).sum()
    };
    let squares = lagged(0);
    if squares <= 0.0 {
        return 1.0;
    }
    let most = (10.0 * (n as f64).log10()) as usize;
    let rho: Vec<f64> = (0..=most).map(|lag| lagged(lag) / squares).collect();
    let (mut weights, mut left): (Vec<f64>, f64) = (Vec::new(), 1.0);
    let (mut best, mut least) = (1.0, 0.0);
    for order in 1..=most {
        let known: f64 = weights.iter().zip(rho[1..order].iter().rev()).map(|(w, r)| w * r).sum();
        let next = (rho[order] - known) / left;
        let turned: Vec<f64> = weights.iter().rev().map(|w| next * w).collect();
        weights.iter_mut().zip(turned).for_each(|(w, t)| *w -= t);
        weights.push(next);
        left *= 1.0 - next * next;
        if left <= 0.0 {
            break;
        }
        let criterion = n as f64 * left.ln() + 2.0 * order as f64;
        if criterion < least {
            least = criterion;
            best = left / (1.0 - weights.iter().sum::<f64>()).powi(2);
        }
    }
    // Fewer than twenty independent samples would tell nothing of a curve with twelve parameters.
    best.clamp(1.0, (n as f64 / 20.0).max(1.0))
}
