//! A moment: a time as it is found, more exact than an `f32`; and how it is rounded to one, once.

use crate::number::pair::Pair;
use crate::number::units::{fixed, power_of_two};

/// `base + way 2^unit`, or `base - way 2^unit` where `back`, rounded once. The `way` is at most 2¹⁰⁵, as on the plateau,
/// and a `unit` from -252 to 22, as for a density; it may be greater where the way is 0.
///
/// If the two cancel, so that the way's second number is more than 3/8 ulp of the sum, it is still rounded once unless
/// the sum lies next to a middle between two `f32`. There the error may be half an ulp and 2⁻²⁴ of `rest`: no
/// promise is as fine as that. (Up to 3/8 ulp the rest of the only middle in reach is half an ulp or, below a power of
/// two, a quarter: a power of two itself.)
// proofs/rounding.py
#[inline(always)]
pub(crate) const fn rounded_sum(base: f32, way: Pair, unit: i32, back: bool) -> f32 {
    // The power of two by halves, for it may not be a normal number itself.
    let half = unit >> 1;
    let (first, second) = (power_of_two(unit - half), power_of_two(half));
    let second = if back { -second } else { second };
    let hi = way.hi * first * second;
    let sum = Pair::sum(base, hi);
    let rest = sum.lo + way.lo * first * second;
    // Below 2⁻⁷⁸ a number or its second half may be subnormal. And a sum midway between two `f32` has a power of two as
    // its rest, a number without any bits but sign and exponent; so may others by rounding.
    if base.abs() + hi.abs() < power_of_two(-78) || rest.to_bits() << 9 == 0 {
        return careful_sum(base, way, first, second);
    }
    sum.hi + rest
}

/// `x 2^unit`, rounded once: a sum of two numbers is, unless it may be subnormal.
#[inline(always)]
pub(crate) const fn rounded((x, unit): (Pair, i32)) -> f32 {
    let value = x.shifted(unit);
    let is_small = value.hi.abs() < power_of_two(-78);
    if is_small { rounded_sum(0.0, x, unit, false) } else { value.rounded() }
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
    // A sum that will be subnormal is rounded to the last place of a subnormal `f32` by adding a number with that last
    // place. It has the sum's sign, which the second number decides where the first cancels the base.
    let near = Pair::sum(base, hi);
    let (rough, least_normal) = (near.hi + (near.lo + lo), power_of_two(up - 126));
    let places = if rough.abs() >= least_normal { 0.0 } else { least_normal.copysign(rough) };
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

/// A time, `base + way` or, if `back`, `base - way`: an exact `f32` and the way from it.
#[derive(Clone, Copy)]
pub(crate) struct Moment {
    pub(crate) base: f32,
    pub(crate) back: bool,
    /// In units of `2^unit`, at least 0.
    pub(crate) way: Pair,
    pub(crate) unit: i32,
    /// No time on the way is beyond this.
    pub(crate) until: f32,
    /// Evaluations of the mass that it took to find.
    pub(crate) evaluations: u32,
}

impl Moment {
    /// A time as it stands.
    pub(crate) const fn at(time: f32) -> Self {
        Self { base: time, back: false, way: Pair::ZERO, unit: 0, until: time, evaluations: 0 }
    }

    /// The time, rounded once.
    #[inline(always)]
    pub(crate) const fn time(self) -> f32 {
        let time = rounded_sum(self.base, self.way, self.unit, self.back);
        let is_beyond = if self.back { time < self.until } else { time > self.until };
        if is_beyond { self.until } else { time }
    }

    /// The time in units of `2^unit`, in which it counts at most 2⁶².
    pub(crate) const fn in_units(self, unit: i32) -> i64 {
        let Pair { hi, lo } = self.way.shifted(self.unit - unit);
        // Rounded down as one number, so that a longer way is never less: from 2²⁴ on the first is a whole number.
        let whole = fixed(hi, 0);
        let rest = (hi - whole as f32) + lo;
        let down = fixed(rest, 0);
        let way = whole + down - ((down as f32) > rest) as i64;
        let [base, until] = [fixed(self.base, unit), fixed(self.until, unit)];
        // A search may err by a trace of mass, and next to a dark end a trace of mass is a long time: so not beyond the
        // end.
        let time = if self.back { base - way } else { base + way };
        let is_beyond = if self.back { time < until } else { time > until };
        if is_beyond { until } else { time }
    }
}
