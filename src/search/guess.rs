//! The first guess of a search: the root of one term.
//!
//! An increasing `S(x) = Σ c_k x^k` reaches `sought` near the least of the `(sought / c_k)^(1/k)` over the positive
//! coefficients. For `0.001 x + x³ = 0.125` these are 125 and 0.5, and the answer is 0.4993.
//!
//! The bits of an `f32`, taken as an integer, are nearly its logarithm, so a root is a quotient of integers. That is
//! good to about a tenth, and one step of Halley's makes it a thousandth. An exact root would save nothing.

/// A logarithm has 20 fraction bits, so that four times the difference of two fits 32 bits.
const LOG_ONE: i32 = 1 << 20;

/// [`power`] comes out too great by up to 0.086 in the logarithm. A root is lowered by the middle of that: so it is as
/// often too small as too great.
const MIDDLE: i32 = (0.043 * LOG_ONE as f32) as i32;

/// `2³⁰ / k`, rounded up, for `k` from 1 to 6.
const RECIPROCALS: [i32; 8] = [0, 1 << 30, 1 << 29, 357913942, 1 << 28, 214748365, 178956971, 0];

/// The distance at which the series with the coefficients `c` reaches about `sought`.
pub(crate) const fn guess(c: &[f32], sought: f32) -> f32 {
    let log = rough_log(sought);
    let (mut least, mut i) = (i32::MAX, 0);
    while i < c.len() {
        let root = divided(log - rough_log(c[i]), i as i32 + 1);
        least = if root < least { root } else { least };
        i += 1;
    }
    power(least - MIDDLE)
}

/// The base-2 logarithm, linear between powers of two: the bits of exponent and significand as they stand.
///
/// 0 is taken for 2⁻¹²⁷, and a negative number for far less. As 2⁸⁰ of mass or 2⁶⁴ of time lie on a ramp of 2³⁰ places,
/// the root of such a coefficient is too great to be the least.
const fn rough_log(x: f32) -> i32 {
    (x.to_bits() as i32 >> 3) - 127 * LOG_ONE
}

/// `x / k` within 4/3 of its last place, for `k` from 1 to 6 and the difference `x` of two logarithms. (The compiler
/// would check the divisor of a division.)
// proofs/guess.py: divided
pub(crate) const fn divided(x: i32, k: i32) -> i32 {
    (((x << 2) as i64 * RECIPROCALS[(k & 7) as usize] as i64) >> 32) as i32
}

/// The number with this linear logarithm, at least 0; beyond all `f32` it is infinite or NaN.
const fn power(log: i32) -> f32 {
    let log = log + 127 * LOG_ONE;
    let log = if log < 0 { 0 } else { log };
    f32::from_bits(if log < 1 << 28 { (log as u32) << 3 } else { f32::INFINITY.to_bits() })
}
