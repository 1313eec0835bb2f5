//! A ramp as the octaves of one side see it: openness, time and fraction of the exposure as polynomials of the Bezier's
//! parameter, in `f64`.
//!
//! Seen so, nothing has to be inverted: each place on the path has its time and its fraction, and what a polynomial of
//! the fraction is off by is itself a polynomial of the place ([`certificate`](crate::certificate)).

use crate::cubic::Cubic;
use crate::exposure::Exposure;
use crate::shape::Shape;

/// A ramp, or a stretch of one, by powers of a place on it.
#[derive(Clone, Copy)]
pub(crate) struct Path {
    pub(crate) openness: [f64; 4],
    /// The time since the side's start.
    pub(crate) elapsed: [f64; 4],
    /// The fraction collected since then.
    pub(crate) fraction: [f64; 7],
}

impl Path {
    /// The ramp with this shape and index: places count from 0 at the end that faces a side to 1 at the other one.
    pub(crate) const fn new(exposure: &Exposure, shape: &Shape, side: usize, ramp: usize) -> Self {
        let shape = if side == 0 { *shape } else { shape.reversed() };
        let way = exposure.plateau_start(side ^ 1) as f64 - exposure.start(side) as f64;
        let (t0, u0) = if ramp == side { (0.0, 0.0) } else { (way.abs(), exposure.exact_joins(side)[1]) };
        let Cubic { value: f, c: [f1, f2, f3] } = shape.openness();
        let Cubic { c: [t1, t2, t3], .. } = shape.elapsed();
        let [u1, u2, u3, u4, u5, u6] = shape.collected();
        let mut fraction = [u0 * exposure.area, u1, u2, u3, u4, u5, u6];
        scale(&mut fraction, 1.0 / exposure.area, 1.0);
        Self { openness: [f, f1, f2, f3], elapsed: [t0, t1, t2, t3], fraction }
    }

    /// A place in [0, 1] at which the fraction is `u` at most or, if `up`, at least; 0 or 1 where there is none. Close,
    /// but not the closest.
    #[inline(never)]
    pub(crate) const fn place(&self, u: f64, up: bool) -> f64 {
        // Newton's steps inside a bracket, which a step that leaves it halves.
        let (mut low, mut high) = (0.0, 1.0);
        let (mut p, mut i) = (0.5, 0);
        while i < MOST_STEPS {
            let missing = u - value(&self.fraction, p);
            *(if missing > 0.0 { &mut low } else { &mut high }) = p;
            let next = p + missing / slope(&self.fraction, p);
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            let is_there = (next - p).abs() <= p * CLOSE;
            p = next;
            i = if is_there { MOST_STEPS } else { i + 1 };
        }
        // Outwards until it is certain.
        let mut step = if up { p * CLOSE } else { -p * CLOSE };
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

    /// The stretch between two places, by powers of a place that runs from -1 to 1 on it; and a bound of what rounding
    /// makes of a fraction there.
    #[inline(never)]
    pub(crate) const fn stretch(&self, first: f64, last: f64) -> (Self, f64) {
        let (middle, half) = (0.5 * (first + last), 0.5 * (last - first));
        let mut stretch = *self;
        let noise = absolute(&self.fraction, last) * NOISE;
        recentred(&mut stretch.openness, middle, half);
        recentred(&mut stretch.elapsed, middle, half);
        recentred(&mut stretch.fraction, middle, half);
        (stretch, noise)
    }
}

/// A step of Newton's below this share of its place is the last one.
const CLOSE: f64 = 1.0 / (1 << 20) as f64;
/// Bisections alone would come as close.
const MOST_STEPS: u32 = 60;
/// More than 60 roundings of an `f64` make of the sum of a fraction's terms, of which the shift to another middle takes
/// 21 and a value 12.
const NOISE: f64 = 1.0 / (1u64 << 47) as f64;

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
    let mut k = 0;
    while k < c.len() {
        let mut j = c.len() - 1;
        // The second condition always holds. With it the compiler drops the checks of bounds.
        while j > k && j < c.len() {
            let above = c[j];
            j -= 1;
            c[j] += middle * above;
        }
        k += 1;
    }
    scale(c, 1.0, unit);
}

/// The value at `x` of a polynomial by its coefficients, from the constant one up.
#[inline(never)]
pub(crate) const fn value(mut c: &[f64], x: f64) -> f64 {
    let mut value = 0.0;
    while let [lower @ .., highest] = c {
        value = value * x + *highest;
        c = lower;
    }
    value
}

/// The slope there.
#[inline(never)]
const fn slope(mut c: &[f64], x: f64) -> f64 {
    let (mut value, mut slope) = (0.0, 0.0);
    while let [lower @ .., highest] = c {
        slope = slope * x + value;
        value = value * x + *highest;
        c = lower;
    }
    slope
}

/// The value of the coefficients without their signs: a bound of all values within `x` of 0.
#[inline(never)]
pub(crate) const fn absolute(mut c: &[f64], x: f64) -> f64 {
    let mut value = 0.0;
    while let [lower @ .., highest] = c {
        value = value * x + highest.abs();
        c = lower;
    }
    value
}
