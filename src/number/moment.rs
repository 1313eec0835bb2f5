//! A moment: a time before it is rounded, finer than an `f32`, and its one rounding.

use crate::number::pair::Pair;
use crate::number::units::{fixed, power_of_two};

/// `base + way 2^unit`, or `base - way 2^unit` where `back`, rounded once. (Where base and way nearly cancel, across time
/// 0, what is left over when their first numbers are added is rounded by 2⁻²⁴ of itself before.) `way` is at most 2¹⁰⁵.
/// `unit` is at least -252, so that half of it is the exponent of a normal number, and at most 22 unless `way` is 0.
// proofs/rounding.py
#[inline(always)]
pub(crate) const fn rounded_sum(base: f32, way: Pair, unit: i32, back: bool) -> f32 {
    // first · second = ±2^unit, which may not be a normal number itself.
    let half = unit >> 1;
    let (first, second) = (power_of_two(unit - half), power_of_two(half));
    let second = if back { -second } else { second };
    let hi = way.hi * first * second;
    let sum = Pair::sum(base, hi);
    let rest = sum.lo + way.lo * first * second;
    // The last line rounds `sum.hi + rest`, though `rest` has been rounded itself. That matters only if `rest` has been
    // rounded to midway between two `f32`, ±1/2 or ±1/4 ulp of `sum.hi`, a power of two. So all powers of two, whose
    // stored significand is 0, go to `careful_sum`, and 0 does with them. Below 2⁻⁷⁸ parts may be subnormal.
    if base.abs() + hi.abs() < power_of_two(-78) || rest.to_bits() << 9 == 0 {
        return careful_sum(base, way, first, second);
    }
    sum.hi + rest
}

/// `x 2^unit`, rounded once.
#[inline(always)]
pub(crate) const fn rounded((x, unit): (Pair, i32)) -> f32 {
    let value = x.shifted(unit);
    let is_small = value.hi.abs() < power_of_two(-78);
    if is_small { rounded_sum(0.0, x, unit, false) } else { value.rounded() }
}

/// `base + way · first · second`, rounded once where [`rounded_sum`] might round twice.
// proofs/rounding.py: careful_sum
#[cold]
#[inline(never)]
const fn careful_sum(base: f32, way: Pair, first: f32, second: f32) -> f32 {
    // All numbers below are normal: small ones count in units of 2⁻⁴⁸.
    let is_small = base.abs() + (way.hi * first * second).abs() < power_of_two(-78);
    let up = if is_small { 48 } else { 0 };
    let (base, second) = (base * power_of_two(up), second * power_of_two(up));
    let (hi, lo) = (way.hi * first * second, way.lo * first * second);
    // Adding `places` rounds a sum that will be subnormal to the last place of a subnormal `f32`. `places` has the
    // sum's sign, which `lo` decides where `hi` cancels the base.
    let near = Pair::sum(base, hi);
    let (rough, least_normal) = (near.hi + (near.lo + lo), power_of_two(up - 126));
    let places = if rough.abs() >= least_normal { 0.0 } else { least_normal.copysign(rough) };
    let sum = Pair::sum(places, near.hi);
    ((sum.hi + odd_sum(sum.lo, odd_sum(near.lo, lo))) - places) * power_of_two(-up)
}

/// `a + b` rounded to odd: if inexact, the neighbour whose last bit is set. Rounding that once more rounds once in all.
#[inline(always)]
const fn odd_sum(a: f32, b: f32) -> f32 {
    let sum = Pair::sum(a, b);
    let bits = sum.hi.to_bits();
    if sum.lo == 0.0 || bits & 1 == 1 {
        return sum.hi;
    }
    // Away from 0 if `hi` and `lo` have one sign.
    let up = (sum.lo.to_bits() ^ bits) as i32 >= 0;
    f32::from_bits(if up { bits + 1 } else { bits - 1 })
}

/// A time: `base + way`, or `base - way` where `back`. The base is exact.
#[derive(Clone, Copy)]
pub(crate) struct Moment {
    pub(crate) base: f32,
    pub(crate) back: bool,
    /// At least 0, in units of `2^unit`.
    pub(crate) way: Pair,
    pub(crate) unit: i32,
    /// The other end of the ramp or the plateau, which no answer passes.
    pub(crate) until: f32,
}

impl Moment {
    pub(crate) const fn at(time: f32) -> Self {
        Self { base: time, back: false, way: Pair::ZERO, unit: 0, until: time }
    }

    /// The time, rounded once.
    #[inline(always)]
    pub(crate) const fn time(self) -> f32 {
        let time = rounded_sum(self.base, self.way, self.unit, self.back);
        let is_beyond = if self.back { time < self.until } else { time > self.until };
        if is_beyond { self.until } else { time }
    }

    /// The time in units of `2^unit`, at most 2⁶² of them: base and way are rounded down, each by itself.
    pub(crate) const fn in_units(self, unit: i32) -> i64 {
        let Pair { hi, lo } = self.way.shifted(self.unit - unit);
        // Only the last sum rounds: `whole` and the rest of `hi` are exact.
        let whole = fixed(hi, 0);
        let way = whole + fixed((hi - whole as f32) + lo, 0);
        let [base, until] = [fixed(self.base, unit), fixed(self.until, unit)];
        // Where little light falls, the little mass by which a search may err takes long: never beyond `until`.
        let time = if self.back { base - way } else { base + way };
        let is_beyond = if self.back { time < until } else { time > until };
        if is_beyond { until } else { time }
    }
}
