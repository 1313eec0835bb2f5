//! The first guess of a search: a k-th root.
//!
//! Near its anchor a series is nearly its leading term, `S(x) ≈ c_k x^k`, so `x` is near the least `(sought /
//! c_k)^(1/k)` over the positive coefficients. The bits of a floating-point number, taken as an integer, are nearly its
//! logarithm. So the least root is found to about a tenth, which one step of Halley's makes a thousandth. If it is a
//! second or fourth root, and the feature is on, `libm` or `micromath` takes it. The search that follows is the same,
//! and so, to the last bit or so, is its answer.

/// Logarithms here have 20 fraction bits, so that a difference of two fits 32 bits.
const LOG_ONE: i32 = 1 << 20;

/// The base-2 logarithm, linear between powers of two: the exponent and the significand's upper bits, as they stand.
/// The sign bit of a negative number makes it less by 256, and the root greater by a factor of at least 2^(256/6):
/// never the least one.
#[inline(always)]
const fn rough_log(x: f32) -> i32 {
    (x.to_bits() as i32 >> 3) - 127 * LOG_ONE
}

/// By how much a logarithm is above the linear one on average.
const MEAN: i32 = (0.043 * LOG_ONE as f32) as i32;

/// 2³⁰ over `k`, rounded up.
const RECIPROCALS: [i32; 8] = [0, 1 << 30, 1 << 29, 357913942, 1 << 28, 214748365, 178956971, 0];

/// `x / k` for `k` up to 6, within 4/3, where `x` is the difference of two logarithms: without a division, which the
/// compiler would check.
#[inline(always)]
const fn divided(x: i32, k: i32) -> i32 {
    // proofs/seeds.py: divided
    (((x << 2) as i64 * RECIPROCALS[(k & 7) as usize] as i64) >> 32) as i32
}

/// Does a feature take square roots? Then it has to be known which root is the least.
const ROOTS: bool = cfg!(any(feature = "libm", feature = "micromath"));

/// The least root's linear logarithm; with its `k` for the lowest bits, if that is asked for.
#[inline(always)]
const fn least_root(c: &[f32], log: i32) -> i32 {
    let mut least = i32::MAX;
    let mut i = 0;
    while i < c.len() {
        let k = i as i32 + 1;
        let root = divided(log - rough_log(c[i]), k);
        let root = if ROOTS { root & !7 | k } else { root };
        if root < least {
            least = root;
        }
        i += 1;
    }
    least
}

/// The number with a linear logarithm, at least 0; what is beyond all `f32` is infinite or NaN.
#[inline(always)]
const fn power(log: i32) -> f32 {
    let log = log + 127 * LOG_ONE;
    let log = if log < 0 { 0 } else { log };
    f32::from_bits(if log < 1 << 28 { (log as u32) << 3 } else { f32::INFINITY.to_bits() })
}

/// The guess of a distance by the root that the features choose.
#[inline(always)]
pub(crate) fn seed(c: &[f32], sought: f32) -> f32 {
    let log = rough_log(sought);
    let root = least_root(c, log);
    #[cfg(any(feature = "libm", feature = "micromath"))]
    {
        let k = root & 7;
        let i = (k - 1) as usize;
        if (k == 2 || k == 4) && i < c.len() {
            let divisor = rough_log(c[i].abs());
            // The exponents divide by k up to a remainder, which the root takes in with the significands.
            let exponent = (log >> 20) - (divisor >> 20);
            let (whole, rest) = (exponent >> (k / 2), exponent & (k - 1));
            let significand = |log: i32| power(log & (LOG_ONE - 1));
            let root = square_root(significand(log) / significand(divisor) * (1 << rest) as f32);
            let root = if k == 4 { square_root(root) } else { root };
            return power(rough_log(root) + whole * LOG_ONE);
        }
    }
    power(root - MEAN)
}

#[cfg(feature = "libm")]
fn square_root(x: f32) -> f32 {
    libm::sqrtf(x)
}

#[cfg(all(feature = "micromath", not(feature = "libm")))]
fn square_root(x: f32) -> f32 {
    micromath::F32Ext::sqrt(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::tests::rows;

    /// What `proofs/seeds.py` takes for the quotient is it.
    #[test]
    fn quotients_are_as_transcribed() {
        for [x, k, quotient] in rows(include_str!("../proofs/vectors/seeds.csv")) {
            assert_eq!(divided(x as i32, k as i32), quotient as i32);
        }
    }
}
