//! What a detector shows of a shutter: a level in the dark, so much more in full light, and perhaps a drift and a hum.

use std::f64::consts::{PI, TAU};

use crate::bins::Bin;
use crate::curve::{CONTROLS, Collected, Curve, Exposure, PARAMETERS, PLATEAU, START};
use crate::ramp::{BOUNDS, STRAIGHT};

/// The candidates, simplest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Kind {
    /// All open or all closed.
    Box,
    /// Straight ramps.
    Trapezoid,
    /// Cubic ramps that mirror each other but for their length.
    Symmetric,
    /// Any cubic ramps.
    Free,
}

impl Kind {
    /// All of them, simplest first.
    pub const ALL: [Self; 4] = [Self::Box, Self::Trapezoid, Self::Symmetric, Self::Free];

    /// As a reader is told.
    pub const fn title(self) -> &'static str {
        ["box", "straight ramps", "symmetric cubic ramps", "free cubic ramps"][self as usize]
    }

    /// As `--model` has it.
    pub const fn name(self) -> &'static str {
        ["box", "trapezoid", "symmetric", "free"][self as usize]
    }

    /// How many numbers describe its curve.
    pub const fn parameters(self) -> usize {
        [2, CONTROLS, CONTROLS + 4, PARAMETERS][self as usize]
    }

    /// By which of this kind's parameters each of a curve's is held, if any.
    fn holder(self, parameter: usize) -> Option<usize> {
        match (self, parameter) {
            (Self::Box, START) => Some(0),
            (Self::Box, PLATEAU) => Some(1),
            (Self::Box, _) => None,
            (Self::Trapezoid, CONTROLS..) => None,
            (Self::Symmetric, CONTROLS..) => Some(CONTROLS + (parameter - CONTROLS) % 4),
            _ => Some(parameter),
        }
    }

    /// Each of a curve's parameters that is not fixed, with the place of the one that holds it.
    fn held(self) -> impl DoubleEndedIterator<Item = (usize, usize)> {
        (0..PARAMETERS).filter_map(move |k| Some((k, self.holder(k)?)))
    }

    /// This kind's parameters of a curve; of a curve that is not of this kind, some of them.
    fn pack(self, curve: &Curve) -> Vec<f64> {
        let (mut packed, p) = (vec![0.0; self.parameters()], curve.parameters());
        self.held().rev().for_each(|(k, holder)| packed[holder] = p[k]);
        packed
    }

    /// The curve with these parameters.
    fn unpack(self, packed: &[f64]) -> Curve {
        let mut p = Curve::trapezoid(0.0, 0.0, 0.0, 0.0).parameters();
        self.held().for_each(|(k, holder)| p[k] = packed[holder]);
        Curve::from_parameters(&p)
    }

    /// Moves with this kind's parameters, from moves with a curve's.
    pub(super) fn gather(self, moves: &[f64; PARAMETERS], into: &mut [f64]) {
        into[..self.parameters()].fill(0.0);
        self.held().for_each(|(k, holder)| into[holder] += moves[k]);
    }
}

/// A sine that is added to the signal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hum {
    /// Periods in a unit of time.
    pub frequency: f64,
    /// Where that has to lie.
    pub range: Bounds,
    /// What its cosine is multiplied by.
    pub cosine: f64,
    /// What its sine is multiplied by.
    pub sine: f64,
}

impl Hum {
    /// Half of what it spans.
    pub fn amplitude(&self) -> f64 {
        self.cosine.hypot(self.sine)
    }

    /// The sine's value at a time.
    pub fn at(&self, t: f64) -> f64 {
        self.mean(t, 0.0).0
    }

    /// Its mean over an interval, and how that moves with the frequency, the cosine and the sine.
    fn mean(&self, middle: f64, width: f64) -> (f64, [f64; 3]) {
        let Self { frequency, cosine, sine, .. } = *self;
        let (s, c) = (TAU * frequency * middle).sin_cos();
        let value = cosine * c + sine * s;
        let turned = sine * c - cosine * s;
        let half = PI * frequency * width;
        // sin(x)/x, by which the mean is less than the middle's value, and its slope.
        let (less, slope) = if half.abs() < 1e-4 {
            (1.0 - half * half / 6.0, -half / 3.0)
        } else {
            (half.sin() / half, (half.cos() - half.sin() / half) / half)
        };
        let by_frequency = turned * TAU * middle * less + value * slope * PI * width;
        (value * less, [by_frequency, c * less, s * less])
    }
}

/// A lamp's own ups and downs at a frequency and twice that: by `1 + flicker(t)` the light is multiplied.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flicker {
    /// Periods in a unit of time; it is known, and not fitted.
    pub frequency: f64,
    /// What cosine and sine, and those of twice the frequency, are multiplied by.
    pub terms: [f64; 4],
}

impl Flicker {
    /// Half of what the first frequency spans, as a share of the light.
    pub fn amplitude(&self) -> f64 {
        self.terms[0].hypot(self.terms[1])
    }

    /// Cosines and sines, each as its mean over an interval.
    fn waves(&self, middle: f64, width: f64) -> [f64; 4] {
        let wave = |frequency: f64| {
            let (s, c) = (TAU * frequency * middle).sin_cos();
            let half = PI * frequency * width;
            let less = if half.abs() < 1e-4 { 1.0 } else { half.sin() / half };
            [less * c, less * s]
        };
        let ([a, b], [c, d]) = (wave(self.frequency), wave(2.0 * self.frequency));
        [a, b, c, d]
    }
}

/// A recorder that is coupled by capacitors, one behind the other: each takes its charge `q` away, which follows what
/// comes in as `dq/dt = rate (x - q)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupling {
    /// By how much the dark begins below where it ends: what the first holds of light that came before.
    pub charge: f64,
    /// One over a time constant, of the first and perhaps of a second.
    pub rates: [Option<f64>; 2],
    /// The rates are known, and not fitted.
    pub held: bool,
}

impl Coupling {
    pub(super) fn rates(&self) -> impl Iterator<Item = f64> + use<> {
        self.rates.into_iter().flatten()
    }
}

/// `v = dark + gain f(t) (1 + flicker(t)) + drift t + hum(t)`, where a coupling lets only changes of the light pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Signal {
    /// Which curves it may have.
    pub kind: Kind,
    /// `f`
    pub curve: Curve,
    /// The level in the dark.
    pub dark: f64,
    /// What full light adds.
    pub gain: f64,
    /// By a unit of time.
    pub drift: Option<f64>,
    /// Beside the light.
    pub hum: Option<Hum>,
    /// Of the light.
    pub flicker: Option<Flicker>,
    /// Of the light, with its flicker.
    pub coupling: Option<Coupling>,
}

/// A range that a parameter stays in.
pub type Bounds = (f64, f64);
const ANY: Bounds = (f64::NEG_INFINITY, f64::INFINITY);
/// Of a capacitor, by pulses: one that is faster passes nothing but edges.
const RATES: Bounds = (0.0, 20.0);

impl Signal {
    /// A box in the frame's own units, as the crossings have it.
    pub(super) fn plain() -> Self {
        Self {
            kind: Kind::Box,
            curve: Curve::trapezoid(-0.5, 0.0, 1.0, 0.0),
            dark: 0.0,
            gain: 1.0,
            drift: None,
            hum: None,
            flicker: None,
            coupling: None,
        }
    }

    /// By what its flicker multiplies the light over an interval.
    pub(super) fn lamp(&self, middle: f64, width: f64) -> f64 {
        let Some(flicker) = self.flicker else { return 1.0 };
        let waves = flicker.waves(middle, width).into_iter().zip(flicker.terms);
        1.0 + waves.map(|(wave, term)| wave * term).sum::<f64>()
    }

    /// How many numbers it takes.
    pub(super) fn len(&self) -> usize {
        self.pack().len()
    }

    /// Its numbers but the curve's, each with its bounds.
    fn beside(&mut self) -> Vec<(&mut f64, Bounds)> {
        let any = |number| (number, ANY);
        let mut all = vec![any(&mut self.dark), any(&mut self.gain)];
        all.extend(self.drift.iter_mut().map(any));
        if let Some(Hum { frequency, range, cosine, sine }) = &mut self.hum {
            all.extend([(frequency, *range), any(cosine), any(sine)]);
        }
        all.extend(self.flicker.iter_mut().flat_map(|flicker| &mut flicker.terms).map(any));
        if let Some(Coupling { charge, rates, held }) = &mut self.coupling {
            all.push(any(charge));
            for rate in rates.iter_mut().flatten() {
                let bounds = if *held { (*rate, *rate) } else { RATES };
                all.push((rate, bounds));
            }
        }
        all
    }

    /// Its numbers, the curve's first.
    pub(super) fn pack(&self) -> Vec<f64> {
        let mut packed = self.kind.pack(&self.curve);
        packed.extend(self.clone().beside().into_iter().map(|(number, _)| *number));
        packed
    }

    /// The same with other numbers, as `pack` orders them.
    pub(super) fn unpack(&self, packed: &[f64]) -> Self {
        let (curve, beside) = packed.split_at(self.kind.parameters());
        let mut other = Self { curve: self.kind.unpack(curve), ..*self };
        other.beside().into_iter().zip(beside).for_each(|((number, _), to)| *number = *to);
        other
    }

    /// The bounds of each: no length below 0, control numbers and a hum's frequency in their range.
    pub(super) fn bounds(&self) -> Vec<Bounds> {
        let of_curve = |k| match k {
            START => ANY,
            CONTROLS.. => BOUNDS[(k - CONTROLS) % 4],
            _ => (0.0, f64::INFINITY),
        };
        let mut bounds: Vec<Bounds> = (0..self.kind.parameters()).map(of_curve).collect();
        bounds.extend(self.clone().beside().into_iter().map(|(_, bounds)| bounds));
        bounds
    }

    /// The parameters that are control numbers, and what each is on a straight ramp.
    pub(super) fn controls(&self) -> impl Iterator<Item = (usize, f64)> {
        let n = self.kind.parameters();
        (CONTROLS..n.max(CONTROLS)).map(|k| (k, STRAIGHT[(k - CONTROLS) % 4]))
    }

    /// What it misses of each bin.
    pub(super) fn missed(&self, bins: &[Bin]) -> Vec<f64> {
        let (mut means, mut moves) = (self.means(), vec![0.0; self.len()]);
        bins.iter().map(|bin| bin.mean - means.over(bin.from, bin.to, &mut moves).0).collect()
    }

    /// What works the signal's means out.
    pub(super) fn means(&self) -> Means<'_> {
        let stages = self.coupling.iter().flat_map(Coupling::rates);
        let stages = stages.map(|rate| Stage { rate, charge: 0.0, moves: vec![0.0; self.len()] });
        let mut means = Means {
            signal: self,
            exposure: Exposure::new(&self.curve),
            last: None,
            stages: stages.collect(),
            until: f64::INFINITY,
        };
        if let (Some(coupling), Some(first)) = (self.coupling, means.stages.first_mut()) {
            let place = first.moves.len() - 1 - coupling.rates().count();
            (first.charge, first.moves[place]) = (coupling.charge, 1.0);
        }
        means
    }
}

/// A signal's mean over one interval after another.
pub struct Means<'a> {
    signal: &'a Signal,
    exposure: Exposure,
    /// Where the last interval ended, and what is collected by then: mostly the next one begins there.
    last: Option<(f64, Collected)>,
    /// The capacitors, one behind the other, and where the last interval ended.
    stages: Vec<Stage>,
    until: f64,
}

/// A capacitor.
struct Stage {
    rate: f64,
    /// Its charge, and how that moves with each parameter.
    charge: f64,
    moves: Vec<f64>,
}

impl Stage {
    /// The mean that passes it in an interval of this width, of so much that comes in; `moves` are those of what comes
    /// in, and become those of what passes. `place` is that of its rate. It counts as even over the interval: the
    /// squares of a ramp's own steps are left out, of which the other ramp has as many.
    fn pass(&mut self, width: f64, mean: f64, moves: &mut [f64], place: usize) -> f64 {
        let z = self.rate * width;
        let keeps = (-z).exp();
        // The share that passes of what comes in beyond the charge, and its slope.
        let (passes, slope) = if z < 1e-4 {
            (1.0 - 0.5 * z, -0.5 + z / 3.0)
        } else {
            let passes = -(-z).exp_m1() / z;
            (passes, (keeps - passes) / z)
        };
        let beyond = mean - self.charge;
        for (each, charge) in moves.iter_mut().zip(&mut self.moves) {
            let (comes, held) = (*each, *charge);
            *each = passes * (comes - held);
            *charge = comes + keeps * (held - comes);
        }
        moves[place] += width * slope * beyond;
        self.moves[place] += width * keeps * beyond;
        self.charge = mean - keeps * beyond;
        passes * beyond
    }
}

impl Means<'_> {
    /// The mean over [`from`, `to`], how it moves with each parameter, and the first of these that it moves with: where
    /// the curve is flat, none of the curve's.
    ///
    /// A coupling asks for the intervals in order.
    pub fn over(&mut self, from: f64, to: f64, moves: &mut [f64]) -> (f64, usize) {
        let Signal { kind, dark, drift, hum, coupling, .. } = *self.signal;
        let (width, middle) = (to - from, 0.5 * (from + to));
        let is_flat = self.exposure.is_flat(from, to);
        let gap = from - self.until;
        if gap > 1e-6 * width && !self.stages.is_empty() {
            // What comes in a gap charges as well.
            let light = self.light(self.until, from, moves);
            self.coupled(gap, light, moves);
        }
        self.until = to;
        let light = self.light(from, to, moves);
        let mut mean = dark + self.coupled(width, light, moves);
        // In the order of `Signal::pack`.
        let places = kind.parameters();
        moves[places] = 1.0;
        let mut columns = &mut moves[places + 2..];
        if let Some(drift) = drift {
            columns[0] = middle;
            columns = &mut columns[1..];
            mean += drift * middle;
        }
        if let Some(hum) = hum {
            let (value, moves) = hum.mean(middle, width);
            columns[..3].copy_from_slice(&moves);
            mean += value;
        }
        if let Some(coupling) = coupling {
            mean += coupling.charge;
            moves[moves.len() - 1 - self.stages.len()] += 1.0;
        }
        (mean, if is_flat && self.stages.is_empty() { places } else { 0 })
    }

    /// The light's mean alone, and how it moves.
    fn light(&mut self, from: f64, to: f64, moves: &mut [f64]) -> f64 {
        let Signal { kind, gain, drift, hum, flicker, .. } = *self.signal;
        let (width, middle) = (to - from, 0.5 * (from + to));
        let lamp = self.signal.lamp(middle, width);
        moves.fill(0.0);
        let (of_curve, beside) = moves.split_at_mut(kind.parameters());
        let is_flat = self.exposure.is_flat(from, to);
        let openness = if is_flat {
            self.exposure.mean(from, to)
        } else {
            let start = match self.last {
                Some((end, collected)) if end == from => collected,
                _ => self.exposure.collected(from),
            };
            let end = self.exposure.collected(to);
            let each = std::array::from_fn(|k| gain * lamp / width * (end.moves[k] - start.moves[k]));
            kind.gather(&each, of_curve);
            self.last = Some((to, end));
            (end.amount - start.amount) / width
        };
        beside[1] = openness * lamp;
        if let Some(flicker) = flicker {
            let columns = &mut beside[2 + drift.map_or(0, |_| 1) + hum.map_or(0, |_| 3)..][..4];
            columns.copy_from_slice(&flicker.waves(middle, width).map(|wave| gain * openness * wave));
        }
        gain * openness * lamp
    }

    /// What passes the capacitors of that.
    fn coupled(&mut self, width: f64, light: f64, moves: &mut [f64]) -> f64 {
        let first = moves.len() - self.stages.len();
        let stages = self.stages.iter_mut().enumerate();
        stages.fold(light, |light, (k, stage)| stage.pass(width, light, moves, first + k))
    }
}
