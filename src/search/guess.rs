//! The first guess of a search: a k-th root.
//!
//! Near its anchor a series is nearly its leading term, `S(x) ≈ c_k x^k`, so `x` is near the least `(sought /
//! c_k)^(1/k)` over the positive coefficients. The bits of a floating-point number, taken as an integer, are nearly its
//! logarithm. So the least root is found to about a tenth, which one step of Halley's makes a thousandth. An exact root
//! would save nothing.

/// Logarithms here have 20 fraction bits, so that a difference of two fits 32 bits.
const LOG_ONE: i32 = 1 << 20;

/// About half of the most, 0.086, by which a logarithm is above the linear one.
const MIDDLE: i32 = (0.043 * LOG_ONE as f32) as i32;

/// 2³⁰ over `k`, rounded up.
const RECIPROCALS: [i32; 8] = [0, 1 << 30, 1 << 29, 357913942, 1 << 28, 214748365, 178956971, 0];

/// A distance at which the series with the coefficients `c` may reach what is sought.
#[inline(always)]
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

/// The base-2 logarithm, linear between powers of two: the exponent and the significand's upper bits, as they stand.
/// The sign bit of a negative number makes it less by 256, and the root greater by a factor of at least 2^(256/6).
/// So that is never the least one, as no term of an increasing series is that much greater than the sum. A 0 counts as
/// 2⁻¹²⁷, whose root is far beyond the others, too.
#[inline(always)]
const fn rough_log(x: f32) -> i32 {
    (x.to_bits() as i32 >> 3) - 127 * LOG_ONE
}

/// `x / k` for `k` up to 6, within 4/3 of its last place, where `x` is the difference of two logarithms: without a
/// division, which the compiler would check.
// proofs/guess.py: divided
#[inline(always)]
pub(crate) const fn divided(x: i32, k: i32) -> i32 {
    (((x << 2) as i64 * RECIPROCALS[(k & 7) as usize] as i64) >> 32) as i32
}

/// The number with this linear logarithm, at least 0; what is beyond all `f32` is infinite or NaN.
#[inline(always)]
const fn power(log: i32) -> f32 {
    let log = log + 127 * LOG_ONE;
    let log = if log < 0 { 0 } else { log };
    f32::from_bits(if log < 1 << 28 { (log as u32) << 3 } else { f32::INFINITY.to_bits() })
}
