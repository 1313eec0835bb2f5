//! A moment: a time before it is rounded, finer than an `f32`, and its one rounding.

use crate::number::pair::Pair;
use crate::number::units::{fixed_down, power_of_two};

/// `base + way 2^exponent`, or `base - way 2^exponent` where `back`, rounded once. `way` is at most 2¹⁰⁵. The exponent
/// is at least -252, so that half of it is that of a normal number; and unless `way` is 0 at most 22, so that `way
/// 2^exponent` is at most 2¹²⁷.
// proofs/rounding.py
pub(crate) const fn rounded_sum(base: f32, way: Pair, exponent: i32, back: bool) -> f32 {
    // By two factors, as ±2^exponent may not be a normal number itself.
    let half = exponent >> 1;
    let (up, scale) = (power_of_two(exponent - half), power_of_two(half));
    let scale = if back { -scale } else { scale };
    let way = way.scaled(up);
    let (hi, lo) = (way.hi * scale, way.lo * scale);
    // Below 2⁻⁷⁸, `lo` and what the sum loses may be subnormal.
    if base.abs() + hi.abs() < power_of_two(-78) {
        return rounded_small_sum(base, way, scale);
    }
    let sum = Pair::sum(base, hi);
    sum.hi + odd_sum(sum.lo, lo)
}

/// `x 2^exponent`, rounded once.
pub(crate) const fn rounded((x, exponent): (Pair, i32)) -> f32 {
    let value = x.shifted(exponent);
    let is_small = value.hi.abs() < power_of_two(-78);
    if is_small { rounded_sum(0.0, x, exponent, false) } else { value.rounded() }
}

/// `base + way scale`, below 2⁻⁷⁸, rounded once.
// proofs/rounding.py
#[cold]
#[inline(never)]
const fn rounded_small_sum(base: f32, way: Pair, scale: f32) -> f32 {
    // In units of 2⁻⁴⁸ all that counts below is normal.
    const UP: i32 = 48;
    let (base, scale) = (base * power_of_two(UP), scale * power_of_two(UP));
    let (hi, lo) = (way.hi * scale, way.lo * scale);
    // Adding `rounder` rounds a sum that will be subnormal to the last bit of a subnormal `f32`. It has the sign of the
    // whole sum, which is that of `lo` if `hi` and the base cancel.
    let near = Pair::sum(base, hi);
    let (rough, least_normal) = (near.hi + (near.lo + lo), power_of_two(UP - 126));
    let rounder = if rough.abs() >= least_normal { 0.0 } else { least_normal.copysign(rough) };
    let sum = Pair::sum(rounder, near.hi);
    ((sum.hi + odd_sum(sum.lo, odd_sum(near.lo, lo))) - rounder) * power_of_two(-UP)
}

/// `a + b` rounded to odd: if inexact, the neighbour whose last bit is set. So it is midway between two neighbours of a
/// greater number only if `a + b` is, and adding it to that number rounds once in all.
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
    /// In `2^way_exponent`; at least 0 but for a trace on the plateau.
    pub(crate) way: Pair,
    pub(crate) way_exponent: i32,
    /// The other end of the ramp or the plateau, which no answer passes.
    pub(crate) until: f32,
}

impl Moment {
    pub(crate) const fn at(time: f32) -> Self {
        Self { base: time, back: false, way: Pair::ZERO, way_exponent: 0, until: time }
    }

    /// The time, rounded once.
    pub(crate) const fn time(self) -> f32 {
        let time = rounded_sum(self.base, self.way, self.way_exponent, self.back);
        let is_beyond = if self.back { time < self.until } else { time > self.until };
        if is_beyond { self.until } else { time }
    }

    /// The time in units of `2^exponent`, at most 2⁶² of them. Base and way are rounded down, each by itself; a
    /// way that lies within 2⁻²⁵ of the next whole number may become that.
    pub(crate) const fn in_units(self, exponent: i32) -> i64 {
        let Pair { hi, lo } = self.way.shifted(self.way_exponent - exponent);
        // By its whole part and the rest, as `hi + lo` would have 24 bits.
        let whole = fixed_down(hi, 0);
        let way = whole + fixed_down((hi - whole as f32) + lo, 0);
        let [base, until] = [fixed_down(self.base, exponent), fixed_down(self.until, exponent)];
        // Where little light falls, a small error in mass is a long time: never beyond `until`.
        let time = if self.back { base - way } else { base + way };
        let is_beyond = if self.back { time < until } else { time > until };
        if is_beyond { until } else { time }
    }
}
