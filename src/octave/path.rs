//! A ramp in `f64`, seen from a side: openness, time and fraction as polynomials of the Bezier's parameter `p`.
//!
//! So an error is judged without an inverse: each `p` has its time and its fraction. Only nodes and the ends of
//! stretches are found by an inverse, and neither has to be exact.

use crate::curve::Curve;
use crate::fixed::WORD;
use crate::fraction::Side;
use crate::octave::span::Span;
use crate::ramp::bezier::CubicBezier;
use crate::ramp::shape::Shape;

/// [`root`] ends with a step below this share of `x`, about as close as an `f32` comes, or after [`MOST_ROUNDS`].
const CLOSE: f32 = 1.0 / (1 << 20) as f32;
/// 40 bisections come that close to a root above 2⁻²⁰. A worse one only widens a stretch, or moves a node, which may
/// cost the polynomial.
const MOST_ROUNDS: usize = 40;
/// The first step outwards of [`Path::parameter_at`], as a share of `p`: small, as each further one is twice as long.
const OUTWARDS: f64 = 1.0 / (1u64 << 36) as f64;

/// A ramp, seen from a side of the curve, for which octaves are built: by powers of `p`, from 0 at the end that faces
/// the side to 1. Coefficients from the constant up.
pub(crate) struct Path<'a> {
    pub(crate) curve: &'a Curve,
    pub(crate) side: Side,
    pub(crate) ramp: Side,
    openness: [f64; 4],
    /// The time since the side's end.
    time: [f64; 4],
    /// The fraction from the side.
    pub(crate) fraction: [f64; 7],
}

/// The part of a path that has all fractions of a span, by powers of an `s` from -1 to 1.
pub(crate) struct Stretch {
    pub(crate) span: Span,
    pub(crate) openness: [f64; 4],
    /// The time since the side's end.
    pub(crate) time: [f64; 4],
    /// The position in the octave, not rounded.
    pub(crate) position: [f64; 7],
    /// Does it reach the ramp's join?
    pub(crate) is_joined: bool,
}

impl<'a> Path<'a> {
    pub(crate) const fn new(curve: &'a Curve, ramps: &[CubicBezier; 2], side: Side, ramp: Side) -> Self {
        let shape = Shape::new(&ramps[ramp as usize], side);
        let until_far = curve.join_time(side.other()) as f64 - curve.end_time(side) as f64;
        // At p = 0: the side's end, or the far ramp's join.
        let (t0, u0) = if ramp.is(side) { (0.0, 0.0) } else { (until_far.abs(), curve.join_fractions(side)[1]) };
        let [t1, t2, t3] = shape.time;
        let [u1, u2, u3, u4, u5, u6] = shape.mass();
        let mut fraction = [0.0, u1, u2, u3, u4, u5, u6];
        scale(&mut fraction, curve.per_area, 1.0);
        fraction[0] = u0;
        Self { curve, side, ramp, openness: shape.openness, time: [t0, t1, t2, t3], fraction }
    }

    /// What an error in time is relative to, at a time since the side's end: |time|; or, if time 0 lies inside the
    /// curve, where that would ask for too much, the greater |time| of both ends. Both at most the interval:
    /// so FORWARD_ERROR of it is below 0.19 tick, in an interval of 2²⁴.
    #[inline(never)]
    pub(crate) const fn size_of_time(&self, since_end: f64) -> f32 {
        let [start, end] = [self.curve.end_time(Side::Start), self.curve.end_time(Side::End)];
        let size = if !(start < 0.0 && end > 0.0) {
            let time = if self.side.is_end() { end as f64 - since_end } else { start as f64 + since_end };
            (time as f32).abs()
        } else if end > -start {
            end
        } else {
            -start
        };
        if size < end - start { size } else { end - start }
    }

    /// A `p` with a fraction of at most `u`, or at least `u` if `up`; where none is found 0, or 1 if `up`. It is near,
    /// not the nearest: farther out, a certificate is only stricter.
    #[inline(never)]
    const fn parameter_at(&self, u: f64, up: bool) -> f64 {
        let single = singles(&self.fraction, u, 1.0);
        let (p, slope) = root(&single, [0.0, 1.0], 0.5);
        // Both are good to about 2⁻²⁰, so a step of Newton's in doubles leaves about 2⁻⁴⁰.
        let (mut p, slope) = (p as f64, slope as f64);
        p += (u - value(&self.fraction, p)) / slope;
        // Outwards, each step twice the one before, until the fraction is past `u`.
        let mut step = if up { p * OUTWARDS } else { -p * OUTWARDS };
        loop {
            p += step;
            if !(p > 0.0 && p < 1.0) {
                return if up { 1.0 } else { 0.0 };
            }
            let missing = u - value(&self.fraction, p);
            let is_past = if up { missing <= 0.0 } else { missing >= 0.0 };
            if is_past {
                return p;
            }
            step *= 2.0;
        }
    }

    /// The stretch of a span: all that is known along the path, by powers of `s`.
    #[inline(never)]
    pub(crate) const fn stretch(&self, span: Span) -> Stretch {
        let Span { middle, half, power, .. } = span;
        let first = self.parameter_at((middle - half) as f64, false);
        let last = self.parameter_at((middle + half) as f64, true);
        let (middle_p, half_p) = (0.5 * (first + last), 0.5 * (last - first));
        let Self { mut openness, mut time, fraction: mut position, .. } = *self;
        recentred(&mut openness, middle_p, half_p);
        recentred(&mut time, middle_p, half_p);
        recentred(&mut position, middle_p, half_p);
        position[0] -= power as f64;
        scale(&mut position, (WORD / power) as f64, 1.0);
        Stretch {
            span,
            openness,
            time,
            position,
            is_joined: if self.ramp.is(self.side) { last == 1.0 } else { first == 0.0 },
        }
    }
}

/// `c[k] *= factor · width^k`: the polynomial times `factor`, by powers of `x / width`.
#[inline(never)]
pub(crate) const fn scale(c: &mut [f64], factor: f64, width: f64) {
    let (mut factor, mut k) = (factor, 0);
    while k < c.len() {
        c[k] *= factor;
        factor *= width;
        k += 1;
    }
}

/// By powers of `(x - middle) / width`: the k-th pass of synthetic division leaves the k-th Taylor coefficient.
#[inline(never)]
const fn recentred(c: &mut [f64], middle: f64, width: f64) {
    let mut pass: &mut [f64] = c;
    while !pass.is_empty() {
        sum_down(pass, middle);
        let Some((_, rest)) = pass.split_first_mut() else { break };
        pass = rest;
    }
    scale(c, 1.0, width);
}

/// One pass: `c[k] += x c[k + 1]`, from the highest down.
#[inline(never)]
const fn sum_down(mut c: &mut [f64], x: f64) {
    let mut above = 0.0;
    while let Some((next, lower)) = c.split_last_mut() {
        above = *next + x * above;
        *next = above;
        c = lower;
    }
}

/// `Σ c[k] x^k`
#[inline(never)]
pub(crate) const fn value(c: &[f64], x: f64) -> f64 {
    let (mut value, mut c) = (0.0, c);
    while let [lower @ .., next] = c {
        value = value * x + *next;
        c = lower;
    }
    value
}

/// The polynomial less `constant`, times `factor`, in single precision; zeros fill the seven coefficients.
#[inline(never)]
pub(crate) const fn singles(c: &[f64], constant: f64, factor: f64) -> [f32; 7] {
    let (mut single, mut k) = ([0.0; 7], 0);
    while k < c.len() && k < single.len() {
        let c = if k == 0 { c[k] - constant } else { c[k] };
        single[k] = (c * factor) as f32;
        k += 1;
    }
    single
}

/// Where an increasing polynomial is nearly 0, in `[low, high]`, and the slope before the last step: by Newton's
/// method, or by bisection where that would leave the bracket.
#[inline(never)]
pub(crate) const fn root(c: &[f32; 7], [mut low, mut high]: [f32; 2], guess: f32) -> (f32, f32) {
    let (mut x, mut last, mut rounds) = (guess, 0.0, 0);
    while rounds < MOST_ROUNDS {
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
        rounds = if is_there { MOST_ROUNDS } else { rounds + 1 };
    }
    (x, last)
}
