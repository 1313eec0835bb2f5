//! The search: where a series reaches a target, and the proof that it does.
//!
//! A series `S` here increases along the ramp and is known twice: in pairs from one end of the ramp, to measure by, and in
//! single precision from an [`Anchor`] near the target, to search by. One search is
//!
//! 1. Halley's steps in single precision, inside a bracket, until next to nothing is missing;
//! 2. what is missing, measured in pairs;
//! 3. one more step for that, and a computed bound of what it leaves, which accepts the answer or not.
//!
//! Where it is too great, 2 and 3 are repeated from the place that was reached. There are two more ways out: the anchor
//! itself, where no more is sought than half of the error, and the cap on evaluations, which no search is known to reach.
//!
//! **The bound.** Let `c` be the anchor's coefficients, `x` the distance from it, `d_k` the Taylor coefficients there, and
//! `r` what is missing. After a step `s` there is missing `r - d_1 s - d_2 s² - ...`, the k-th term being `Σ_j C(j,k) c_j
//! x^(j-k) s^k`. Let `Y = |x| + |s|` and `E = Σ_{j>=3} j |c_j| Y^(j-3)`. From the third on the terms are together at most
//! `3.4 E |s|³`, because `Σ_{k>=3} C(j,k) |x|^(j-k) |s|^k <= C(j,3) |s|³ Y^(j-3)`, and `C(j,3) <= 10/3 j`. The first two are known
//! in single precision: wrong by at most 2⁻²⁰ `|s| D`, where `D = |c_1| + 2 |c_2| Y + E Y²` bounds all slopes on the way,
//! because some 14 roundings of 2⁻²⁴ lead to them, 10 of Horner's rule. Where `x` is itself rounded, by `m`, the slopes
//! are wrong by `5 m (2 |c_2| + E Y)` more, since `j - 1 <= 5`. So what is left is at most
//!
//! `|r - s (d_1 + d_2 s)| + |s| (2⁻²⁰ D + 5 m (2 |c_2| + E Y) + 3.4 E s²)`
//!
//! and what measuring `r` missed: 2⁻⁴¹ of the sum of the series' terms without their signs ([`Series::at`]). A non-negative
//! polynomial's increasing integral bounds that sum (Markov): for degree 6 it is at most 1083 times the series, the greatest
//! quotient of the integrals over [-1, 0] and [0, 1] of `x s²` or `(1 - x) s²` with a quadratic `s`. So measuring misses less than
//! 2⁻³⁰ of the target, within the quarter of an error of 2⁻²⁶ that is left for it. A search for a smaller error is as exact as
//! pairs are; where a step is within an ulp of its place, there is no better one, and the greater error is asked for.
//!
//! **The end.** From `NEWTON` evaluations on each measured place halves a bracket of certain signs. When that is as narrow as
//! neighbouring `f32`, `s` is at most 2⁻²³ of the place, and on a series from an end the bound's terms without `r` are below
//! 2⁻²⁷ of it, so that the step, which solves the first two terms, is accepted. Around a minimum inside it is by search that
//! this is known. Hence [`MAX_EVALUATIONS`]; the searches of the tests take 6 at most.

use crate::pair::{Pair, Series};

/// How far a ramp goes: places along it count from 0 at one end to this at the other.
///
/// The least `f32` u then still leads to a place that is a normal number, and the last coefficient's second half is one.
pub(crate) const ONE: f32 = (1 << 30) as f32;

/// Evaluations before all of them are measured in pairs and the bracket has to keep up with what bisection would make of it.
const NEWTON: u32 = 10;
/// Bisections that bring any bracket between 0 and [`ONE`] down to neighbours, taken by their bits; each takes two
/// evaluations.
const BISECTION: u32 = 31;
/// The most evaluations of the polynomial that one search takes, in single precision and in pairs.
pub const MAX_EVALUATIONS: u32 = NEWTON + 2 * BISECTION;

/// Where less than this share of what is sought is missing, it is measured in pairs. Halley's step leaves some tenth of the
/// cube: 2⁻⁴².
const NEAR: f32 = 1.0 / 8192.0;

/// A step leads at most this many times as far from the anchor: Newton overshoots where the density dips ahead.
const FARTHER: f32 = 2.5;

/// What rounding makes of the first two Taylor coefficients, as a share of their terms: see the module's text.
const ROUNDING: f32 = 1.0 / (1 << 20) as f32;

/// The distance from the anchor may be rounded by this share of it.
const MOVED: f32 = 1.0 / (1 << 16) as f32;

/// The distance between neighbours, relative to them, at most.
const ULP: f32 = f32::EPSILON;

/// Where a search starts: a place on the ramp, and the series around it.
pub(crate) struct Anchor<const N: usize> {
    pub(crate) place: Pair,
    /// What is collected from here, by powers of the distance, which is negative on the way back.
    pub(crate) c: [f32; N],
    /// What is to be collected from here; negative if the target lies before it.
    pub(crate) sought: f32,
}

impl<const N: usize> Anchor<N> {
    /// How far from the anchor a place is.
    #[inline(always)]
    const fn distance(&self, p: f32) -> f32 {
        (p - self.place.hi) - self.place.lo
    }
}

/// Where a search ended: at the place `x + rest`.
#[derive(Clone, Copy)]
pub(crate) struct Offset {
    pub(crate) x: f32,
    pub(crate) rest: f32,
    pub(crate) evaluations: u32,
}

impl Offset {
    /// The series' value there. The second term is at most 2⁻²³ of the first, so single precision is enough for it.
    #[inline(always)]
    pub(crate) const fn value(&self, series: Series) -> Pair {
        let Pair { hi, lo } = series.at(self.x);
        Pair { hi, lo: lo + series.slope(self.x) * self.rest }
    }
}

/// The first Taylor coefficients around a place.
struct Taylor {
    value: f32,
    d1: f32,
    d2: f32,
}

impl Taylor {
    /// Of `c[0] x + c[1] x² + ...`, by synthetic division: each pass leaves one more coefficient.
    #[inline(always)]
    const fn new<const N: usize>(c: &[f32; N], x: f32) -> Self {
        let mut c = *c;
        divide(&mut c, x, 0);
        let value = c[0] * x;
        divide(&mut c, x, 0);
        divide(&mut c, x, 1);
        Self { value, d1: c[0], d2: c[1] }
    }

    /// The step to make up for `missing`: Halley's `n / (1 + b)`, from Newton's step `n`, with the quotient's series up to
    /// `b²`. A division is dear, and where `b` is too great for the series the bracket holds.
    #[inline(always)]
    const fn step(&self, missing: f32) -> f32 {
        let inverse = 1.0 / self.d1;
        let newton = missing * inverse;
        let bend = self.d2 * newton * inverse;
        newton * (1.0 - bend * (1.0 - bend))
    }
}

/// Horner's rule at `x`, down to the coefficient `to`, with all that it passes kept.
#[inline(always)]
const fn divide<const N: usize>(c: &mut [f32; N], x: f32, to: usize) {
    let mut k = N - 1;
    while k > to {
        k -= 1;
        c[k] += c[k + 1] * x;
    }
}

/// The bound of what is missing after the step `s`, where `x` is rounded by `moved`: see the module's text.
#[inline(always)]
const fn left<const N: usize>(
    c: &[f32; N],
    [x, moved]: [f32; 2],
    local: &Taylor,
    missing: f32,
    s: f32,
) -> f32 {
    let c = core::hint::black_box(c);
    let size = s.abs();
    let y = x.abs() + size;
    let (mut cubes, mut j) = (0.0, N);
    while j > 2 {
        cubes = cubes * y + j as f32 * c[j - 1].abs();
        j -= 1;
    }
    let bends = cubes * y + 2.0 * c[1].abs();
    let slopes = bends * y + c[0].abs();
    let first = (missing - s * (local.d1 + local.d2 * s)).abs();
    first + size * (ROUNDING * slopes + 5.0 * moved.abs() * bends + 3.4 * cubes * (s * s))
}

/// The place where `series` reaches `target`, but for an `error`, of which a quarter is for measuring.
#[inline(always)]
pub(crate) const fn solve<const N: usize>(
    series: Series,
    target: Pair,
    anchor: &Anchor<N>,
    seed: f32,
    [error, most]: [f32; 2],
) -> Offset {
    let Anchor { place, ref c, sought } = *anchor;
    // The anchor itself, whose mass is known as well as any is measured.
    if sought.abs() <= 0.5 * error {
        return Offset { x: place.hi, rest: place.lo, evaluations: 0 };
    }
    let near = NEAR * sought.abs() + error;
    // The bracket, as distances: from the anchor to the end of the ramp.
    let is_ahead = sought > 0.0;
    let (mut low, mut high) = if is_ahead { (0.0, ONE - place.hi) } else { (-place.hi, 0.0) };
    // At the end of the ramp the density may be 0.
    let most_at_first = 0.75 * (high - low);
    let x = if seed < most_at_first { seed } else { most_at_first };
    let mut x = if is_ahead { x } else { -x };
    let (mut is_near, mut p, mut moved) = (false, 0.0, 0.0f32);
    let mut evaluations = 0;
    loop {
        let local = Taylor::new(c, x);
        evaluations += 1;
        let mut missing = sought - local.value;
        if !is_near && (missing.abs() <= near || evaluations >= NEWTON) {
            is_near = true;
            // What the bracket was made of may have been rounding; from here on signs are certain.
            (low, high) = (-place.hi, ONE - place.hi);
            // Only a place that is an `f32` can be measured.
            p = place.hi + x;
            let distance = anchor.distance(p);
            moved = distance - x;
            if moved.abs() > MOVED * x.abs() {
                (x, moved) = (distance, 0.0);
                continue;
            }
        }
        if is_near {
            missing = target.difference(series.at(p));
            evaluations += 1;
        }
        *(if missing > 0.0 { &mut low } else { &mut high }) = x;
        let mut step = local.step(missing);
        let (mut least, mut greatest) = (low, high);
        if !is_near {
            let far = FARTHER * x;
            if is_ahead {
                greatest = if high < far { high } else { far };
            } else {
                least = if low > far { low } else { far };
            }
        }
        // Written so that a NaN is no step.
        if !(x + step >= least && x + step <= greatest) {
            step = 0.5 * (least + greatest) - x;
        }
        if !is_near {
            x += step;
            continue;
        }
        let is_last = evaluations >= MAX_EVALUATIONS - 1;
        let error = if step.abs() <= ULP * p { most } else { error };
        if is_last || left(c, [x, moved], &local, missing, step) <= 0.75 * error {
            let Pair { hi, lo } = Pair::sum(p, step);
            return Offset { x: hi, rest: lo, evaluations };
        }
        p = if evaluations < NEWTON { p + step } else { middle(place.hi + low, place.hi + high) };
        (x, moved) = (anchor.distance(p), 0.0);
    }
}

/// The middle of two places by their bits: half of the `f32` between lie on either side.
#[inline(always)]
const fn middle(low: f32, high: f32) -> f32 {
    let low = if low > 0.0 { low.to_bits() } else { 0 };
    f32::from_bits(low + high.to_bits().saturating_sub(low) / 2)
}
