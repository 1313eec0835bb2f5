//! Pairs: unevaluated sums `hi + lo` of two `f32`, some 48 bits, for processors whose only fast float is `f32`.
//!
//! Every machine computes the same bits: plain sums and products, none fused, and what each loses (Knuth 1969, Dekker
//! 1971). Functions that round state their error for operands whose `lo` is at most half an ulp of `hi`;
//! `proofs/pairs.py` proves it, and what holds for a greater `lo`. Answers of `sum`, `plus`, `minus` and `from_f64`
//! have such a `lo`; that of `minus_loose` may exceed `hi`; other ones are a few ulp. Nothing may overflow or become
//! subnormal: callers scale by powers of two.

use crate::number::units::power_of_two;

/// `hi + lo`
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pair {
    pub(crate) hi: f32,
    pub(crate) lo: f32,
}

impl Pair {
    pub(crate) const ZERO: Self = Self { hi: 0.0, lo: 0.0 };

    pub(crate) const fn new(x: f32) -> Self {
        Self { hi: x, lo: 0.0 }
    }

    /// `x`, to 2⁻⁴⁹.
    // proofs/pairs.py: from_f64
    pub(crate) const fn from_f64(x: f64) -> Self {
        let hi = x as f32;
        Self { hi, lo: (x - hi as f64) as f32 }
    }

    pub(crate) const fn to_f64(self) -> f64 {
        self.hi as f64 + self.lo as f64
    }

    /// `a + b`, exactly.
    #[inline(always)]
    pub(crate) const fn sum(a: f32, b: f32) -> Self {
        let hi = a + b;
        Self { hi, lo: lost_by_sum(hi, a, b) }
    }

    /// `self + other`, to 2⁻⁴⁶ of the greater one.
    // proofs/pairs.py: plus
    #[inline(always)]
    pub(crate) const fn plus(self, other: Self) -> Self {
        let sum = Self::sum(self.hi, other.hi);
        Self::sum(sum.hi, sum.lo + (self.lo + other.lo))
    }

    /// `self - other`, to 2⁻⁴⁶ of the greater one.
    // proofs/pairs.py: minus
    #[inline(always)]
    pub(crate) const fn minus(self, other: Self) -> Self {
        self.plus(other.scaled(-1.0))
    }

    /// `self - other`, as exact as [`minus`](Self::minus); `lo` may exceed `hi` where the two nearly cancel.
    #[inline(always)]
    pub(crate) const fn minus_loose(self, other: Self) -> Self {
        let Self { hi, lo } = Self::sum(self.hi, -other.hi);
        Self { hi, lo: lo + (self.lo - other.lo) }
    }

    /// `self - other` in single precision, with its sign; within a factor of two, to one rounding and 2⁻⁴⁸ of the
    /// greater.
    #[inline(always)]
    pub(crate) const fn difference(self, other: Self) -> f32 {
        (self.hi - other.hi) + (self.lo - other.lo)
    }

    /// `3 self`; `lo` is rounded twice.
    #[inline(always)]
    pub(crate) const fn thrice(self) -> Self {
        let Self { hi, lo } = Self::sum(self.hi, 2.0 * self.hi);
        Self { hi, lo: lo + 3.0 * self.lo }
    }

    /// `-self` if `sign` is the sign bit, `self` if it is 0.
    #[inline(always)]
    pub(crate) const fn flipped(self, sign: u32) -> Self {
        Self { hi: flipped(self.hi, sign), lo: flipped(self.lo, sign) }
    }

    /// `x self` for a power of two `x`, exactly.
    #[inline(always)]
    pub(crate) const fn scaled(self, x: f32) -> Self {
        Self { hi: self.hi * x, lo: self.lo * x }
    }

    /// `self · 2ⁿ`, where 2ⁿ may not be a normal number itself.
    #[inline(always)]
    pub(crate) const fn shifted(self, n: i32) -> Self {
        let half = n >> 1;
        self.scaled(power_of_two(half)).scaled(power_of_two(n - half))
    }

    /// `self · x`, to 2⁻⁴⁵ (Dekker).
    // proofs/pairs.py: times
    #[inline(always)]
    pub(crate) const fn times(self, x: Self) -> Self {
        let hi = self.hi * x.hi;
        Self { hi, lo: lost_by_product(hi, self.hi, x.hi) + (self.hi * x.lo + self.lo * x.hi) }
    }

    /// `self / x`, to 2⁻⁴³, even if the `lo` of `x` is an ulp.
    // proofs/pairs.py: over
    #[inline(always)]
    pub(crate) const fn over(self, x: Self) -> Self {
        let inverse = 1.0 / x.hi;
        let hi = self.hi * inverse;
        let product = hi * x.hi;
        let lacks = (self.hi - product) - lost_by_product(product, hi, x.hi);
        // lo = (self - hi x) / x
        Self { hi, lo: (lacks + (self.lo - hi * x.lo)) * inverse }
    }

    /// The nearest `f32`.
    #[inline(always)]
    pub(crate) const fn rounded(self) -> f32 {
        self.hi + self.lo
    }
}

/// `-x` if `sign` is the sign bit, `x` if it is 0. (A branch doubles the code behind it; without FPU a product is
/// slow.)
#[inline(always)]
pub(crate) const fn flipped(x: f32, sign: u32) -> f32 {
    f32::from_bits(x.to_bits() ^ sign)
}

/// `(m, e)` of a normal `x = m 2ᵉ` above 0, with `m` in [1, 2) cut to 47 fraction bits.
// proofs/words.py: significand
#[inline(always)]
pub(crate) const fn significand(x: f64) -> (Pair, i32) {
    const UNIT: f32 = 1.0 / (1u64 << 47) as f32;
    let bits = x.to_bits();
    let hi = f32::from_bits(127 << 23 | (bits >> 29) as u32 & 0x7F_FFFF);
    let lo = (bits as u32 >> 5 & 0xFF_FFFF) as f32 * UNIT;
    (Pair { hi, lo }, (bits >> 52) as i32 - 1023)
}

/// `a + b - sum`, exactly, where `sum` is `a + b` rounded (Knuth).
#[inline(always)]
const fn lost_by_sum(sum: f32, a: f32, b: f32) -> f32 {
    let added = sum - a;
    (a - (sum - added)) + (b - added)
}

/// `a b - product`, exactly, where `product` is `a b` rounded (Dekker).
#[inline(always)]
pub(crate) const fn lost_by_product(product: f32, a: f32, b: f32) -> f32 {
    let (a_high, b_high) = (upper(a), upper(b));
    let (a_low, b_low) = (a - a_high, b - b_high);
    ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
}

/// The upper 12 of 24 bits. The product of two such numbers is exact.
// proofs/words.py: upper
#[inline(always)]
pub(crate) const fn upper(x: f32) -> f32 {
    f32::from_bits(x.to_bits() & 0xFFFF_F000)
}
