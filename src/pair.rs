//! Pairs: unevaluated sums of two `f32`, some 48 bits, for processors whose only fast float is `f32`.
//!
//! The second number is at most half an ulp of the first after `sum`, `plus` and `minus`, and a few ulp after the other
//! functions. What each loses is said for operands with half an ulp, and proven, also for more (`proofs/pairs.py`). The
//! classic algorithms (Knuth 1969, Dekker 1971) in plain sums and products, without fused operations, so that the bits
//! are the same on every machine. They are exact, or as good as each says, as long as nothing overflows or becomes
//! subnormal; who calls them scales by powers of two to see to that.

/// `hi + lo`
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pair {
    pub(crate) hi: f32,
    pub(crate) lo: f32,
}

impl Pair {
    pub(crate) const ZERO: Self = Self { hi: 0.0, lo: 0.0 };

    /// `x`, exactly.
    pub(crate) const fn new(x: f32) -> Self {
        Self { hi: x, lo: 0.0 }
    }

    /// The nearest pair, to 2⁻⁴⁹.
    // proofs/pairs.py: from_f64
    pub(crate) const fn from_f64(x: f64) -> Self {
        let hi = x as f32;
        Self { hi, lo: (x - hi as f64) as f32 }
    }

    /// `x`, exactly.
    pub(crate) const fn from_u32(x: u32) -> Self {
        Self::sum((x & !0xFF) as f32, (x & 0xFF) as f32)
    }

    pub(crate) const fn to_f64(self) -> f64 {
        self.hi as f64 + self.lo as f64
    }

    /// `a + b`, exactly (Knuth's two-sum).
    #[inline(always)]
    pub(crate) const fn sum(a: f32, b: f32) -> Self {
        let hi = a + b;
        let added = hi - a;
        Self { hi, lo: (a - (hi - added)) + (b - added) }
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
        self.plus(other.negated())
    }

    /// `self - other`, whose second number may be the greater one if the two are nearly equal.
    #[inline(always)]
    pub(crate) const fn minus_loose(self, other: Self) -> Self {
        let Self { hi, lo } = Self::sum(self.hi, -other.hi);
        Self { hi, lo: lo + (self.lo - other.lo) }
    }

    /// `self - other` in single precision, which keeps its relative accuracy where the two are near.
    #[inline(always)]
    pub(crate) const fn difference(self, other: Self) -> f32 {
        (self.hi - other.hi) + (self.lo - other.lo)
    }

    #[inline(always)]
    pub(crate) const fn thrice(self) -> Self {
        let Self { hi, lo } = Self::sum(self.hi, 2.0 * self.hi);
        Self { hi, lo: lo + 3.0 * self.lo }
    }

    #[inline(always)]
    pub(crate) const fn negated(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }

    /// The same with its sign changed, if `sign` is the sign bit and not 0.
    #[inline(always)]
    pub(crate) const fn flipped(self, sign: u32) -> Self {
        Self { hi: flipped(self.hi, sign), lo: flipped(self.lo, sign) }
    }

    /// `x self` for a power of two `x`, exactly.
    #[inline(always)]
    pub(crate) const fn scaled(self, x: f32) -> Self {
        Self { hi: self.hi * x, lo: self.lo * x }
    }

    /// `self · 2ⁿ`: by halves, because the power of two may not be a normal number itself.
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
        Self { hi, lo: lost(hi, self.hi, x.hi) + (self.hi * x.lo + self.lo * x.hi) }
    }

    /// `self / x`, to 2⁻⁴³, also if the second number of `x` is an ulp: what the quotient's product with `x` lacks of
    /// `self` tells the rest.
    // proofs/pairs.py: over
    #[inline(always)]
    pub(crate) const fn over(self, x: Self) -> Self {
        let inverse = 1.0 / x.hi;
        let hi = self.hi * inverse;
        let product = hi * x.hi;
        let lacks = (self.hi - product) - lost(product, hi, x.hi);
        Self { hi, lo: (lacks + (self.lo - hi * x.lo)) * inverse }
    }

    /// The nearest `f32`.
    #[inline(always)]
    pub(crate) const fn rounded(self) -> f32 {
        self.hi + self.lo
    }
}

/// `-x` if `sign` is the sign bit, `x` if it is 0: without a branch, which would double the code that follows, and
/// without a product, which is slow without an FPU.
#[inline(always)]
pub(crate) const fn flipped(x: f32, sign: u32) -> f32 {
    f32::from_bits(x.to_bits() ^ sign)
}

/// `a b - product`, exactly, for the rounded `product` of `a` and `b` (Dekker).
#[inline(always)]
const fn lost(product: f32, a: f32, b: f32) -> f32 {
    let (a_high, b_high) = (upper(a), upper(b));
    let (a_low, b_low) = (a - a_high, b - b_high);
    ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
}

/// The upper 12 of 24 bits. The product of two such halves is exact.
// proofs/words.py: upper
#[inline(always)]
pub(crate) const fn upper(x: f32) -> f32 {
    f32::from_bits(x.to_bits() & 0xFFFF_F000)
}

/// `2^n`, a normal number.
#[inline(always)]
pub(crate) const fn power_of_two(n: i32) -> f32 {
    f32::from_bits(((n + 127) as u32) << 23)
}

/// The exponent of the power of two at or below a normal `x`; -127 for what is less.
#[inline(always)]
pub(crate) const fn exponent(x: f32) -> i32 {
    (x.to_bits() >> 23 & 0xFF) as i32 - 127
}

/// `x` in units of `2^e`, rounded towards 0; below 2⁶³ of them.
// proofs/words.py: fixed
pub(crate) const fn fixed(x: f32, e: i32) -> i64 {
    let (bits, exponent) = (x.to_bits(), exponent(x));
    let significand = (bits & 0x7F_FFFF) as i64;
    let (significand, exponent) =
        if exponent > -127 { (significand | 1 << 23, exponent) } else { (significand, -126) };
    let up = exponent - 23 - e;
    let units = if up >= 0 {
        significand << (up & 63)
    } else if up > -24 {
        significand >> (-up & 63)
    } else {
        0
    };
    if x < 0.0 { -units } else { units }
}

/// `base + way 2^unit`, or `base - way 2^unit` where `back`, rounded once; for a `way` of at most 2¹⁰⁵ and a `unit` in
/// [-252, 22].
///
/// Where the two cancel, so that the way's second number is more than 3/8 ulp of the sum, that holds except next to a
/// middle between two `f32`: the error may be half an ulp and 2⁻²⁴ of what is added (`proofs/rounding.py`).
#[inline(always)]
pub(crate) const fn rounded_sum(base: f32, way: Pair, unit: i32, back: bool) -> f32 {
    // The power of two by halves, for it may not be a normal number itself.
    let half = unit >> 1;
    let (first, second) = (power_of_two(unit - half), power_of_two(half));
    let second = if back { -second } else { second };
    let hi = way.hi * first * second;
    let sum = Pair::sum(base, hi);
    let rest = sum.lo + way.lo * first * second;
    // Less may be subnormal, or have a subnormal second half. And a sum midway between two `f32` has a power of two as
    // its rest; so may others by rounding.
    if base.abs() + hi.abs() < power_of_two(-78) || rest.to_bits() << 9 == 0 {
        return careful_sum(base, way, first, second);
    }
    sum.hi + rest
}

/// `base + way first second`, where rounding takes more care.
// proofs/rounding.py: careful_sum
#[cold]
#[inline(never)]
const fn careful_sum(base: f32, way: Pair, first: f32, second: f32) -> f32 {
    // If it is small, a greater unit makes all of them normal numbers.
    let is_small = base.abs() + (way.hi * first * second).abs() < power_of_two(-78);
    let up = if is_small { 48 } else { 0 };
    let (base, second) = (base * power_of_two(up), second * power_of_two(up));
    let (hi, lo) = (way.hi * first * second, way.lo * first * second);
    // A sum that will be subnormal is rounded to the last place of the least `f32` by adding a number with that last
    // place. It has the sum's sign, which the second number decides where the first cancels the base.
    let near = Pair::sum(base, hi);
    let (rough, least) = (near.hi + (near.lo + lo), power_of_two(up - 126));
    let places = if rough.abs() >= least { 0.0 } else { least.copysign(rough) };
    let sum = Pair::sum(places, near.hi);
    ((sum.hi + odd_sum(sum.lo, odd_sum(near.lo, lo))) - places) * power_of_two(-up)
}

/// `a + b` rounded to odd: if it is not exact, the neighbour whose last bit is set. To round that once more rounds once
/// in all.
#[inline(always)]
const fn odd_sum(a: f32, b: f32) -> f32 {
    let sum = Pair::sum(a, b);
    let bits = sum.hi.to_bits();
    if sum.lo == 0.0 || bits & 1 == 1 {
        return sum.hi;
    }
    // Away from 0 where both have the same sign.
    let up = (sum.lo.to_bits() ^ bits) as i32 >= 0;
    f32::from_bits(if up { bits + 1 } else { bits - 1 })
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// The rows of a file of `proofs/vectors`: hexadecimal words.
    pub(crate) fn rows<const N: usize>(csv: &str) -> impl Iterator<Item = [u64; N]> {
        csv.lines().map(|line| {
            let mut words = line.split(',').map(|word| u64::from_str_radix(word, 16).unwrap());
            let row = core::array::from_fn(|_| words.next().unwrap());
            assert!(words.next().is_none());
            row
        })
    }

    /// The same, of which all are `f32` by their bits.
    pub(crate) fn numbers<const N: usize>(csv: &str) -> impl Iterator<Item = [f32; N]> {
        rows::<N>(csv).map(|row| row.map(|word| f32::from_bits(word as u32)))
    }

    /// What `proofs/pairs.py` takes for these functions is what they are.
    #[test]
    fn pairs_are_as_transcribed() {
        let pair = |hi, lo| Pair { hi, lo };
        for row in numbers(include_str!("../proofs/vectors/pairs.csv")) {
            let [a, al, b, bl, s, sl, m, ml, t, tl, q, ql, difference] = row;
            let (a, b) = (pair(a, al), pair(b, bl));
            assert_eq!(a.plus(b), pair(s, sl));
            assert_eq!(a.minus_loose(b), pair(m, ml));
            assert_eq!(a.times(b), pair(t, tl));
            assert_eq!(a.over(b), pair(q, ql));
            assert_eq!(a.difference(b), difference);
        }
    }

    /// Sums are the exact ones, rounded once: those expected are computed with fractions. The last one is the
    /// exception.
    #[test]
    fn sums_are_rounded_once() {
        for [base, hi, lo, unit, back, sum] in rows(include_str!("../proofs/vectors/rounded.csv")) {
            let [base, hi, lo, sum] = [base, hi, lo, sum].map(|word| f32::from_bits(word as u32));
            let found = rounded_sum(base, Pair { hi, lo }, unit as i32, back == 1);
            assert_eq!(found, sum, "{base:e} {hi:e} {lo:e} {unit} {back}");
        }
    }
}
