//! A ramp as the octaves of one side see it: openness, time and fraction of the exposure as polynomials of the Bezier's
//! parameter, in `f64`.
//!
//! Seen so, an error is judged without inverting anything: each place on the path has its time and its fraction, and
//! what a polynomial of the fraction is off by is itself a polynomial of the place
//! ([`certificate`](crate::octave::certificate)). Only ends and nodes are inverted, and those need not be exact.

use crate::exposure::Exposure;
use crate::fraction::Side;
use crate::ramp::cubic::Cubic;
use crate::ramp::shape::Shape;

/// As close as single precision comes: a step of Newton's below this share of its place is the last one.
const CLOSE: f32 = 1.0 / (1 << 20) as f32;
/// So many bisections alone would come as close to places from 2⁻²⁰ on. What is not as close takes more steps outwards,
/// or costs a certificate.
const MOST_STEPS: usize = 40;
/// The first step outwards from a place that one more step of Newton's, in `f64`, has brought closer, as a share of it.
const OUTWARDS: f64 = 1.0 / (1u64 << 36) as f64;

/// A side of the curve, as its octaves are built.
pub(crate) struct View<'a> {
    pub(crate) exposure: &'a Exposure,
    pub(crate) shapes: &'a [Shape; 2],
    pub(crate) side: Side,
    /// The exponent of the unit of time.
    pub(crate) unit: i32,
}

impl View<'_> {
    pub(crate) const fn path(&self, ramp: Side) -> Path {
        Path::new(self.exposure, &self.shapes[ramp as usize], self.side, ramp)
    }
}

/// A ramp, or a stretch of one, by powers of a place on it. A ramp has fractions of the exposure and times of the curve;
/// the stretch of an octave has positions ([`Span::counted`](crate::octave::span::Span::counted)), and for its certificate the
/// unit of time in which the polynomial has its coefficients.
#[derive(Clone, Copy)]
pub(crate) struct Path {
    pub(crate) openness: [f64; 4],
    /// The time since the outer end.
    pub(crate) time: [f64; 4],
    /// The fraction collected since then.
    pub(crate) fraction: [f64; 7],
}

impl Path {
    /// The ramp with this shape and index: places count from 0 at the end that faces a side to 1 at the other one.
    pub(crate) const fn new(exposure: &Exposure, shape: &Shape, side: Side, ramp: Side) -> Self {
        let shape = shape.from(side);
        let way = exposure.join(side.other()) as f64 - exposure.end(side) as f64;
        let (t0, u0) =
            if ramp.is(side) { (0.0, 0.0) } else { (way.abs(), exposure.joins(side)[1]) };
        let Cubic { value: f, c: [f1, f2, f3] } = shape.openness();
        let Cubic { c: [t1, t2, t3], .. } = shape.time();
        let [u1, u2, u3, u4, u5, u6] = shape.mass();
        // All by one scale, the first there and back, so that one loop does it.
        let mut fraction = [u0 * exposure.area, u1, u2, u3, u4, u5, u6];
        scale(&mut fraction, 1.0 / exposure.area, 1.0);
        Self { openness: [f, f1, f2, f3], time: [t0, t1, t2, t3], fraction }
    }

    /// A place in [0, 1] at which the fraction is `u` at most or, if `up`, at least; 0 or 1 where none is found. Close,
    /// but not the closest: farther out, a certificate is only stricter.
    #[inline(never)]
    pub(crate) const fn place(&self, u: f64, up: bool) -> f64 {
        let single = singles(&self.fraction, u, 1.0);
        let [p, slope] = root(&single, [0.0, 1.0], 0.5);
        let (mut p, slope) = (p as f64, slope as f64);
        p += (u - value(&self.fraction, p)) / slope;
        // Outwards until it is certain.
        let mut step = if up { p * OUTWARDS } else { -p * OUTWARDS };
        loop {
            p += step;
            if !(p > 0.0 && p < 1.0) {
                return if up { 1.0 } else { 0.0 };
            }
            let missing = u - value(&self.fraction, p);
            if if up { missing <= 0.0 } else { missing >= 0.0 } {
                return p;
            }
            step *= 2.0;
        }
    }

    /// The stretch between two places, by powers of a place that runs from -1 to 1 on it.
    #[inline(never)]
    pub(crate) const fn stretch(&self, [first, last]: [f64; 2]) -> Self {
        let (middle, half) = (0.5 * (first + last), 0.5 * (last - first));
        let mut stretch = *self;
        recentred(&mut stretch.openness, middle, half);
        recentred(&mut stretch.time, middle, half);
        recentred(&mut stretch.fraction, middle, half);
        stretch
    }
}

/// The coefficients of a polynomial by powers of `x` as those by powers of `x / unit`, times `factor`.
#[inline(never)]
pub(crate) const fn scale(c: &mut [f64], factor: f64, unit: f64) {
    let (mut factor, mut k) = (factor, 0);
    while k < c.len() {
        c[k] *= factor;
        factor *= unit;
        k += 1;
    }
}

/// The coefficients by powers of `(x - middle) / unit`: synthetic division, whose k-th pass leaves the k-th Taylor
/// coefficient.
#[inline(never)]
const fn recentred(c: &mut [f64], middle: f64, unit: f64) {
    let mut pass: &mut [f64] = c;
    while !pass.is_empty() {
        sum_down(pass, middle);
        let Some((_, rest)) = pass.split_first_mut() else { break };
        pass = rest;
    }
    scale(c, 1.0, unit);
}

/// One pass: each coefficient, from the highest down, plus `x` times the sum above it.
#[inline(never)]
const fn sum_down(mut c: &mut [f64], x: f64) {
    let mut above = 0.0;
    while let Some((next, lower)) = c.split_last_mut() {
        above = *next + x * above;
        *next = above;
        c = lower;
    }
}

/// The value at `x` of a polynomial by its coefficients, from the constant one up.
#[inline(never)]
pub(crate) const fn value(c: &[f64], x: f64) -> f64 {
    let (mut value, mut c) = (0.0, c);
    while let [lower @ .., next] = c {
        value = value * x + *next;
        c = lower;
    }
    value
}

/// In single precision, less `shift` and times `factor`. It takes up to seven coefficients, and those that are not there
/// are 0.
#[inline(never)]
pub(crate) const fn singles(c: &[f64], shift: f64, factor: f64) -> [f32; 7] {
    let (mut single, mut k) = ([0.0; 7], 0);
    while k < c.len() && k < single.len() {
        let c = if k == 0 { c[k] - shift } else { c[k] };
        single[k] = (c * factor) as f32;
        k += 1;
    }
    single
}

/// Where a polynomial that increases is nearly 0, between two places, and its slope about there: Newton's steps inside
/// a bracket, which a step that leaves it halves.
#[inline(never)]
pub(crate) const fn root(c: &[f32; 7], [mut low, mut high]: [f32; 2], guess: f32) -> [f32; 2] {
    let (mut x, mut last, mut steps) = (guess, 0.0, 0);
    while steps < MOST_STEPS {
        let (mut value, mut slope, mut left): (f32, f32, &[f32]) = (0.0, 0.0, c);
        while let [lower @ .., next] = left {
            slope = slope * x + value;
            value = value * x + *next;
            left = lower;
        }
        *(if value < 0.0 { &mut low } else { &mut high }) = x;
        let next = x - value / slope;
        let next = if next > low && next < high { next } else { 0.5 * (low + high) };
        let is_there = (next - x).abs() <= CLOSE * x.abs();
        (x, last) = (next, slope);
        steps = if is_there { MOST_STEPS } else { steps + 1 };
    }
    [x, last]
}

/// A bound of all values within `x` of 0, by the coefficients without their signs.
#[inline(never)]
pub(crate) const fn absolute(c: &[f32], x: f32) -> f32 {
    let (mut value, mut c) = (0.0, c);
    while let [lower @ .., next] = c {
        value = value * x + next.abs();
        c = lower;
    }
    value
}
