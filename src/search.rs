//! A polynomial of the place along a ramp, and the search for the place where it reaches a target.
//!
//! A search guesses where one term alone reaches the target ([`guess`]), and takes steps of Halley's in single
//! precision. Once a step is short, what is missing is measured in fixed point: within the error, the search ends. From
//! [`FREE_STEPS`] on it halves a bracket instead. So it always ends (proofs/search.py).

use crate::fixed::{WORD, power_of_two, product, product_up, single};

/// From this step on each halves a bracket, at first the whole ramp. Searches seldom take as many.
const FREE_STEPS: u32 = 16;
/// After a step of more than this share of the place, single precision tells what is missing.
const FAR: f32 = 0.1;
/// The most steps of a search. Each evaluates the polynomial once at most in fixed point.
pub const MAX_STEPS: u32 = FREE_STEPS + 63;
/// Within this error, a search for a mass always ends: between neighbouring places the mass grows by less than 3, and
/// [`Series::at`] is low by less than 7681: together less than twice this error (proofs/search.py).
pub(crate) const LEAST_ERROR: i64 = 1 << 12;

/// A polynomial of the place `p`, which counts as 0 to 1 here: `c[0] p + c[1] p² + ...`.
pub(crate) struct Series<'a, const N: usize> {
    /// The coefficients, in `2^shift`. No sum of Horner's rule reaches 2⁶³ (proofs/search.py).
    pub(crate) c: &'a [i64; N],
    pub(crate) shift: u32,
}

impl<const N: usize> Series<'_, N> {
    /// The value at a place; low by less than `3 (N - 1) 2^shift` times the place, plus 1.
    // proofs/search.py
    #[inline(always)]
    pub(crate) const fn at(&self, p: u64) -> i64 {
        let (mut sum, mut k) = (self.c[N - 1], N - 1);
        while k > 0 {
            k -= 1;
            sum = product(sum, p) + self.c[k];
        }
        // The last product keeps its bits.
        product_up(sum, p, self.shift)
    }

    /// The place where the series, which grows from 0, reaches a target, within an error; and, for tests, the
    /// steps.
    #[inline(always)]
    pub(crate) const fn solve(&self, target: i64, error: i64) -> (u64, u32) {
        if target <= error {
            return (0, 0);
        }
        let (mut c, mut k) = ([0.0; N], 0);
        while k < N {
            c[k] = single(self.c[k]);
            k += 1;
        }
        // What is missing is estimated in single precision, in the coefficients' unit (`sought`, `missing`), or
        // measured in fixed point, not shifted (`target`, `error`, `measured`).
        let unit = power_of_two(-(self.shift as i32));
        let sought = single(target) * unit;
        let guess = guess(&c, sought);
        // Well before the other end, where the slope may be 0 and a first step would be wasted.
        let mut p = place(if guess < 0.75 { guess } else { 0.75 });
        let (mut low, mut high, mut steps) = (0, u64::MAX, 0);
        let (mut missing, mut is_far) = (0.0, true);
        loop {
            steps += 1;
            let x = ((p >> 32) as u32 as f32 + p as u32 as f32 / WORD) / WORD;
            if is_far {
                missing = sought - value(&c, x);
            }
            let step = step(&c, x, missing);
            let length = place(step.abs());
            // Half way to the end, where the step would leave.
            let room = if step < 0.0 { p } else { u64::MAX - p };
            let length = if length < room { length } else { room / 2 };
            p = if step < 0.0 { p - length } else { p + length };
            is_far = steps < FREE_STEPS && step.abs() > FAR * x;
            if is_far {
                continue;
            }
            if steps >= FREE_STEPS {
                p = low + (high - low) / 2;
            }
            let measured = target - self.at(p);
            let off = measured.abs();
            if off <= error || steps >= MAX_STEPS {
                return (p, steps);
            }
            if steps >= FREE_STEPS {
                *(if measured > 0 { &mut low } else { &mut high }) = p;
            }
            missing = single(off) * if measured > 0 { unit } else { -unit };
        }
    }
}

/// A place from single precision; 1 is 2⁶⁴ - 2³², and more than 1 the greatest.
#[inline(always)]
const fn place(x: f32) -> u64 {
    let x = x * WORD;
    let high = x as u32;
    (high as u64) << 32 | ((x - high as f32) * WORD) as u32 as u64
}

#[inline(always)]
const fn value<const N: usize>(c: &[f32; N], x: f32) -> f32 {
    let (mut value, mut k) = (0.0, N);
    while k > 0 {
        k -= 1;
        value = (value + c[k]) * x;
    }
    value
}

/// Halley's step from `x` for what is missing there of `Σ c[k - 1] x^k`: `newton / (1 + bend)`, with Newton's step and
/// `bend = newton d2 / 2 d1`, by both derivatives. Up to a `bend` of 1/2 it is `newton (1 - bend + bend²)`, since a
/// division is slow; for a negative bend that falls short. Beyond 1/2 it would grow again, and a search might swing.
/// The place stays inside by what [`Series::solve`] makes of a step that leads out.
#[inline(always)]
const fn step<const N: usize>(c: &[f32; N], x: f32, missing: f32) -> f32 {
    let (mut d1, mut d2, mut k) = (c[N - 1] * N as f32, 0.0, N - 1);
    while k > 0 {
        d2 = d2 * x + d1;
        d1 = d1 * x + c[k - 1] * k as f32;
        k -= 1;
    }
    // Towards the target, even if rounding makes the slope negative.
    let inverse = 1.0 / d1.abs();
    let newton = missing * inverse;
    let bend = 0.5 * d2 * newton * inverse;
    if bend > 0.5 { newton / (1.0 + bend) } else { newton * (1.0 - bend * (1.0 - bend)) }
}

/// A logarithm has 20 fraction bits, so that four times the difference of two fits 32 bits.
const LOG_ONE: i32 = 1 << 20;

/// `2³⁰ / k`, rounded up, for `k` from 1 to 6.
const RECIPROCALS: [i32; 8] = [0, 1 << 30, 1 << 29, 357913942, 1 << 28, 214748365, 178956971, 0];

/// The place at which the series with the coefficients `c` reaches about `sought`.
///
/// One term alone, `c[k - 1] x^k`, reaches it at `(sought / c[k - 1])^(1/k)`. The least of these is the guess. The bits
/// of an `f32`, as an integer, are nearly its logarithm: so a k-th root is a division by `k`, good to a tenth. Where
/// one term outweighs the others, the guess is as good, and one step of Halley's makes it good to a thousandth.
const fn guess(c: &[f32], sought: f32) -> f32 {
    let log = rough_log(sought);
    let (mut least, mut i) = (i32::MAX, 0);
    while i < c.len() {
        let root = divided(log - rough_log(c[i]), i as i32 + 1);
        least = if root < least { root } else { least };
        i += 1;
    }
    from_log(least)
}

/// The base-2 logarithm, linear between powers of two: the bits of exponent and significand as they stand. 0 is taken
/// for 2⁻¹²⁷, and a negative number for far less: the root of such a coefficient is too great to be the least.
const fn rough_log(x: f32) -> i32 {
    (x.to_bits() as i32 >> 3) - 127 * LOG_ONE
}

/// `x / k` within 4/3 of its last place, for `k` from 1 to 6 and the difference `x` of two logarithms. (The compiler
/// would check the divisor of a division.)
// proofs/search.py: divided
const fn divided(x: i32, k: i32) -> i32 {
    (((x << 2) as i64 * RECIPROCALS[(k & 7) as usize] as i64) >> 32) as i32
}

/// The number with this linear logarithm, at least 0; beyond all `f32` it is infinite or NaN.
const fn from_log(log: i32) -> f32 {
    let log = log + 127 * LOG_ONE;
    let log = if log < 0 { 0 } else { log };
    f32::from_bits(if log < 1 << 28 { (log as u32) << 3 } else { f32::INFINITY.to_bits() })
}
