//! What the noise makes of the results: standard errors from the normal equations, and beside them what a ramp's foot,
//! a low peak and the model's own shape leave unknown. [`results`] is the way in; all in the frame's own units.

use crate::curve::{AREA, CLOSING, CONTROLS, Curve, LENGTH, OPENING, PARAMETERS, PLATEAU, START, Whole, fractions};
use crate::frame::FrameFits;
use crate::hum;
use crate::missed::least_open;
use crate::signal::{Flicker, Hum, Kind};
use crate::solve::Cholesky;
use crate::trace::Timing;
use crate::units::Units;

/// Below this openness nobody knows a ramp's shape, unless it is straight: the time that it spends there is the
/// standard error of its end beside the noise's, and this openness for so long that of its light.
const FOOT: f64 = 0.005;
/// A plateau that is shorter than this share of the whole is a peak, or may be.
const PEAK: f64 = 0.1;
/// What a hum of few periods leaves unknown, as a share of it, where its frequency was not given.
const SHORT_HUM: f64 = 0.1;
/// What a lamp's flicker leaves unknown, as a share of it, where a period of it is in the pulse.
const FLICKER: f64 = 0.2;

/// A value and its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The value.
    pub value: f64,
    /// One standard deviation of it.
    pub error: f64,
}

impl Measured {
    fn scaled(self, factor: f64) -> Self {
        Self { value: self.value * factor, error: self.error * factor }
    }

    /// With an error more.
    pub(super) fn widen(&mut self, by: f64) {
        self.error = self.error.hypot(by);
    }
}

#[derive(Clone, Debug)]
pub struct Results {
    pub exposure: Measured,
    pub efficiency: Measured,
    pub start: Measured,
    /// How long the curve opens, is fully open, and closes.
    pub parts: [Measured; 3],
    pub triggers: Vec<Measured>,
}

impl Results {
    fn all(&mut self) -> impl Iterator<Item = &mut Measured> {
        let Self { exposure, efficiency, start, parts, triggers } = self;
        [exposure, efficiency, start].into_iter().chain(parts).chain(triggers)
    }

    fn times(&mut self) -> impl Iterator<Item = &mut Measured> {
        self.triggers.iter_mut().chain([&mut self.start])
    }

    /// The same in seconds, and of full light where the pulse's peak is this share of it.
    pub fn outside(self, units: &Units, peak: f64) -> Self {
        let seconds = |m: Measured| Measured { value: units.seconds(m.value), error: units.pulse * m.error };
        Self {
            exposure: self.exposure.scaled(units.pulse * peak),
            efficiency: self.efficiency.scaled(peak),
            start: seconds(self.start),
            parts: self.parts.map(|part| part.scaled(units.pulse)),
            triggers: self.triggers.into_iter().map(seconds).collect(),
        }
    }

    /// With what no curve knows of: the steps of the values, which may shift the dark and the light alike, and the
    /// lamp.
    pub fn widened(mut self, fits: &FrameFits, kind: Kind) -> Self {
        let signal = fits.of(kind).solution.signal;
        let is_short = |hum: &Hum| hum.range.0 < hum.range.1 && hum::periods(fits.bins(), hum) < hum::FEWEST;
        let of_hum = |hum: Hum| SHORT_HUM * hum.amplitude() / signal.gain;
        let hum = signal.hum.filter(is_short).map_or(0.0, of_hum);
        let of_lamp = |lamp: Flicker| FLICKER * lamp.amplitude() / lamp.frequency;
        let lamp = signal.flicker.map_or(0.0, of_lamp);
        let share = (2f64.sqrt() * fits.rounding).hypot(lamp).hypot(hum);
        for result in [&mut self.exposure, &mut self.efficiency] {
            result.widen(share * result.value);
        }
        let late = fits.rounding.hypot(0.3 * lamp).hypot(hum) * self.exposure.value;
        self.times().for_each(|time| time.widen(late));
        self.parts.iter_mut().for_each(|part| part.widen(late));
        self
    }

    /// With structure that the tests do not tell, which moves triggers and exposure by these shares of the exposure.
    pub fn with_hidden(mut self, [triggers, exposure]: [f64; 2]) -> Self {
        let of = self.exposure.value;
        self.triggers.iter_mut().for_each(|trigger| trigger.widen(triggers * of));
        self.exposure.widen(exposure * of);
        self
    }

    /// With what is not known of the clock, in seconds.
    pub fn timed(mut self, timing: &Timing) -> Self {
        for span in self.parts.iter_mut().chain([&mut self.exposure]) {
            span.widen(timing.pace * span.value);
            span.widen(2f64.sqrt() * timing.each);
        }
        self.times().for_each(|time| time.widen(timing.error.hypot(timing.each)));
        self
    }

    /// A model's that do not explain the samples: how far they lie from the samples' own belongs to their errors.
    pub fn apart_from(mut self, samples: &Self) -> Self {
        self.exposure.widen(self.exposure.value - samples.exposure.value);
        for (trigger, other) in self.triggers.iter_mut().zip(&samples.triggers) {
            trigger.widen(trigger.value - other.value);
        }
        self
    }
}

/// The exposure, the efficiency and the times of `n` triggers of a kind's curve.
///
/// That a freer kind might be true belongs to the error: Burnham and Anderson's variance, in which each kind counts by
/// its Akaike weight, with its own variance and how far it lies from this one.
pub fn results(fits: &FrameFits, kind: Kind, n: u32) -> Results {
    let mut chosen = of_kind(fits, kind, n);
    let freer = &Kind::ALL[kind as usize..];
    let least = freer.iter().map(|k| fits.aic(*k)).fold(f64::INFINITY, f64::min);
    let weights = freer.iter().map(|k| (*k, (0.5 * (least - fits.aic(*k))).exp()));
    let sum: f64 = weights.clone().map(|(_, weight)| weight).sum();
    let mut variances = vec![0.0; chosen.all().count()];
    for (k, weight) in weights.filter(|(_, weight)| *weight > 1e-3 * sum) {
        let mut other = if k == kind { chosen.clone() } else { of_kind(fits, k, n) };
        for ((variance, to), of) in variances.iter_mut().zip(chosen.all()).zip(other.all()) {
            *variance += weight / sum * (of.error.powi(2) + (of.value - to.value).powi(2));
        }
    }
    chosen.all().zip(variances).for_each(|(to, variance)| to.error = variance.sqrt());
    chosen.widened(fits, kind)
}

/// One kind's curve by itself.
fn of_kind(fits: &FrameFits, kind: Kind, n: u32) -> Results {
    let integral = fits.exposure(kind);
    let curve = integral.curve;
    let Curve { opening, plateau, closing, .. } = curve;
    let (whole, area, all) = (integral.whole().moves, integral.area(), curve.length());
    let covariance = Covariance::new(fits, kind);
    let is_straight = kind <= Kind::Trapezoid;
    // Noise hides how high a peak is, and so what full light is.
    let is_peak = plateau < PEAK * all;
    // For how long nobody knows the shape of each ramp's foot, and the light that it may hold or not.
    let feet = if is_straight { [0.0; 2] } else { integral.feet(FOOT) };
    let unseen = feet.map(|time| FOOT * time);
    let searched = |whole: Whole, is_linear: bool| {
        let linear = covariance.error(&whole(&curve).1);
        if is_linear { linear } else { searched(fits, kind, whole, linear, covariance.variance) }
    };
    // By the noise.
    let length = searched(LENGTH, is_straight);
    let light = unseen.into_iter().fold(searched(AREA, !is_peak), f64::hypot);
    let exposure = Measured { value: area, error: light };

    let value = area / all;
    // Where both are linear in the samples, what they have in common cancels; else the two errors are taken apart.
    let error = if is_straight && !is_peak {
        covariance.error(&std::array::from_fn(|k| (whole[k] - value * Curve::LENGTH[k]) / all))
    } else {
        let ends = feet.into_iter().fold(length, f64::hypot);
        (light / all).hypot(value * ends / all)
    };
    let efficiency = Measured { value, error };

    // A time of the curve. Soft ramps hide it as they hide the length, and each ramp as much of it as it is long. The
    // linear error counts as well, but where a shape makes up for a shift it is too large: the length's serves as its
    // bound.
    let time = |parameter: usize, value: f64, ramps: f64, beside: f64| {
        let mut moves = [0.0; PARAMETERS];
        moves[parameter] = 1.0;
        let linear = covariance.error(&moves);
        // Where there is no ramp, nothing says where the length is hidden.
        let share = if opening + closing > 0.0 { ramps / (opening + closing) } else { 1.0 };
        let noise = if is_straight { linear } else { (length * share).hypot(linear.min(length)) };
        Measured { value, error: noise.hypot(beside) }
    };
    // Nobody knows a ramp's shape near full light either.
    let near = integral.feet(1.0 - FOOT);
    let [first, last] = if is_straight { [0.0; 2] } else { [opening - near[0], closing - near[1]] };
    let edges = covariance.edges.map(f64::sqrt);
    let parts = [
        time(OPENING, opening, opening, feet[0].hypot(first).hypot(edges[0])),
        time(PLATEAU, plateau, opening + closing, first.hypot(last)),
        time(CLOSING, closing, closing, feet[1].hypot(last).hypot(edges[1])),
    ];

    let trigger = |u: f64| {
        let (value, moves) = integral.trigger(u);
        // More light in the first foot makes a trigger earlier, more in the last one makes it later.
        let light = ((1.0 - u) * unseen[0]).hypot(u * unseen[1]);
        let by_feet = light / least_open(&integral, value);
        Measured { value, error: covariance.error(&moves).hypot(by_feet) }
    };
    let triggers = fractions(n).map(trigger).collect();
    Results { exposure, efficiency, start: time(START, curve.start, opening, feet[0]), parts, triggers }
}

/// The standard error of what is not linear in the samples, by how far the sum of squares lets it go either way.
///
/// Where a soft ramp starts is such a thing: a control number makes up for most of a shift, and only the square of
/// the shift shows. So the 95 % interval is looked for, and 1.96 standard errors are said to be its longer side.
fn searched(fits: &FrameFits, kind: Kind, whole: Whole, linear: f64, variance: f64) -> f64 {
    const SIDE: f64 = 1.96;
    let signal = fits.of(kind).solution.signal;
    let value = whole(&signal.curve).0;
    let (least, most) = (1e-4 * value, 0.5 * value);
    let side = |way: f64| {
        // Where the linear error is unknown, not a number, `min` takes the other.
        let mut by = (SIDE * linear).min(0.1 * value).max(least);
        let mut near = signal;
        for _ in 0..8 {
            let cost = fits.cost_of(kind, whole, way * by, &mut near) / (SIDE * SIDE * variance);
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

/// How the parameters of a fitted curve vary together.
struct Covariance {
    kind: Kind,
    /// Of the parameters that are on no bound.
    moving: Vec<usize>,
    factor: Cholesky,
    /// What the inverse is multiplied by: the noise's variance, for correlated samples.
    variance: f64,
    /// The variance of each edge beside it: a sample tells an edge's side, not its place.
    edges: [f64; 2],
}

impl Covariance {
    fn new(fits: &FrameFits, kind: Kind) -> Self {
        let fitted = fits.of(kind);
        let solution = &fitted.solution;
        let (packed, bounds) = (solution.signal.pack(), solution.signal.bounds());
        // A ramp of no length has nothing to vary. A control number on its bound has: one way, and that counts as both.
        let on_bound = |k: &usize| {
            let (low, high) = bounds[*k];
            low == high || *k < CONTROLS && packed[*k] <= low
        };
        let moving: Vec<usize> = (0..packed.len()).filter(|k| !on_bound(k)).collect();
        // The degrees of freedom: a parameter takes an independent sample.
        let n = fits.samples.len() as f64;
        let free = (n - packed.len() as f64 * fits.correlation).max(0.5 * n);
        let curve = solution.signal.curve;
        let edge = |ramp: f64| fits.step * fits.step / 12.0 * (1.0 - ramp / (2.0 * fits.step)).max(0.0);
        Self {
            kind,
            factor: Cholesky::stiffened(&solution.normal_of(&moving)),
            moving,
            variance: fitted.squares / free * fits.correlation,
            edges: [edge(curve.opening), edge(curve.closing)],
        }
    }

    /// The standard error of what moves so with a curve's parameters.
    fn error(&self, moves: &[f64; PARAMETERS]) -> f64 {
        let mut gathered = vec![0.0; self.kind.parameters()];
        self.kind.gather(moves, &mut gathered);
        let row: Vec<f64> = self.moving.iter().map(|k| gathered.get(*k).copied().unwrap_or(0.0)).collect();
        let noise: f64 = self.factor.solve(&row).iter().zip(&row).map(|(a, b)| a * b).sum();
        // The opening edge moves the start and leaves the end; the closing one lengthens the plateau.
        let (opening, closing) = (moves[START] - moves[PLATEAU], moves[PLATEAU]);
        let edges = opening * opening * self.edges[0] + closing * closing * self.edges[1];
        (noise * self.variance + edges).sqrt()
    }
}
