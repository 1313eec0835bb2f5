//! A second formulation of a curve in doubles, for times that move slowly: the `p` of one is the guess for the next, so
//! that a Newton step or two give the exact answer. Fast enough for every `f32`, and judged by the oracle where it
//! finds the greatest errors.

use crate::support::oracle::{Curve, Points, ulp_f32};

/// The exact cdf and openness of a curve.
pub struct Follower {
    /// The opening and the closing ramp.
    ramps: [Ramp; 2],
    /// What the opening ramp collects, and all.
    opened: f64,
    area: f64,
    /// When the curve starts, the plateau starts and ends, and the curve ends.
    joins: [f64; 4],
}

impl Follower {
    pub fn new(curve: &Curve) -> Self {
        let [a, b, c, d] = curve.closing;
        let ramps = [Ramp::new(curve.opening, 1.0), Ramp::new([d, c, b, a], -1.0)];
        let joins = [curve.open_start(), curve.open_end(), curve.close_start(), curve.close_end()].map(f64::from);
        let masses = ramps.each_ref().map(|ramp| horner(&ramp.mass, 1.0).0);
        let area = masses[0] + masses[1] + (joins[2] - joins[1]);
        Self { ramps, opened: masses[0], area, joins }
    }

    /// What errors at a time are relative to: where the curve runs across time 0, an ulp of the greater end.
    pub fn ulp(&self, t: f64) -> f64 {
        let [start, .., end] = self.joins;
        ulp_f32(if start < 0.0 && end > 0.0 { end.max(-start) } else { t })
    }

    /// The cdf and the openness at a time.
    pub fn values(&mut self, t: f64) -> [f64; 2] {
        let [start, open, close, end] = self.joins;
        let [opening, closing] = &mut self.ramps;
        if t < start {
            [0.0, 0.0]
        } else if t > end {
            [1.0, 0.0]
        } else if t < open || (t == open && open == close && start < open) {
            let [mass, openness] = opening.at_time(t);
            [mass / self.area, openness]
        } else if t <= close && open < close {
            [(self.opened + (t - open)) / self.area, 1.0]
        } else {
            let [mass, openness] = closing.at_time(t);
            [(self.area - mass) / self.area, openness]
        }
    }
}

/// A ramp in powers of the `x` that counts from the curve's end.
struct Ramp {
    time: f64,
    /// Whether time passes so, 1, or backwards, -1.
    sign: f64,
    /// The way in time and the mass from here; the openness.
    way: [f64; 4],
    mass: [f64; 7],
    openness: [f64; 4],
    /// Where the last answer was.
    x: f64,
}

impl Ramp {
    fn new(points: Points, sign: f64) -> Self {
        let powers = |first: f64, x: [f64; 4]| {
            let d = [x[1] - x[0], x[2] - x[1], x[3] - x[2]];
            [first, 3.0 * d[0], 3.0 * (d[1] - d[0]), d[2] - 2.0 * d[1] + d[0]]
        };
        let (t, f) = (points.map(|p| f64::from(p.0)), points.map(|p| f64::from(p.1)));
        let (way, openness) = (powers(0.0, t.map(|t| sign * t)), powers(f[0], f));
        let mut mass = [0.0; 7];
        for i in 0..4 {
            for j in 1..4 {
                mass[i + j] += openness[i] * way[j] * j as f64 / (i + j) as f64;
            }
        }
        Self { time: t[0], sign, way, mass, openness, x: 0.5 }
    }

    /// The mass from the curve's end to a time, and the openness there.
    fn at_time(&mut self, t: f64) -> [f64; 2] {
        let x = self.solve(self.sign * (t - self.time));
        [horner(&self.mass, x).0, horner(&self.openness, x).0]
    }

    /// The `x` at a way from here: by Newton's steps from the last, or where those fail by bisection.
    fn solve(&mut self, way: f64) -> f64 {
        if way <= 0.0 {
            return 0.0;
        }
        for _ in 0..20 {
            let (value, slope) = horner(&self.way, self.x);
            let step = (way - value) / slope;
            self.x += step;
            if !(self.x > 0.0 && self.x <= 1.0) {
                break;
            }
            // The square of a step this small is beyond a double.
            if step.abs() <= 1e-8 * self.x {
                return self.x;
            }
        }
        // By the middle of the bit patterns, which halves exponents first.
        let (mut low, mut high) = (0.0f64, 1.0f64);
        while high.to_bits() - low.to_bits() > 1 {
            let middle = f64::from_bits((low.to_bits() + high.to_bits()) / 2);
            *(if horner(&self.way, middle).0 < way { &mut low } else { &mut high }) = middle;
        }
        self.x = high;
        high
    }
}

/// The polynomial with these coefficients, the constant first, and its derivative.
fn horner<const N: usize>(c: &[f64; N], x: f64) -> (f64, f64) {
    c.iter().rev().fold((0.0, 0.0), |(value, slope), c| (value * x + c, slope * x + value))
}
