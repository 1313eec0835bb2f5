//! Double-double numbers: the unevaluated sum of two `f64`, 106 bits of significand.
//!
//! The classic algorithms (Dekker 1971; Hida, Li and Bailey 2001): they hold for round-to-nearest as long as nothing
//! overflows and no low part becomes subnormal, and the magnitudes of an oracle for `f32` stay far from both.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// `hi + lo`, where `hi` is the sum rounded to `f64`.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Dd {
    pub hi: f64,
    pub lo: f64,
}

/// `a + b` exactly.
#[inline(always)]
fn two_sum(a: f64, b: f64) -> Dd {
    let hi = a + b;
    let b_part = hi - a;
    Dd { hi, lo: (a - (hi - b_part)) + (b - b_part) }
}

/// `a + b` exactly, for `|a| >= |b|` or `a = 0`.
#[inline(always)]
fn fast_two_sum(a: f64, b: f64) -> Dd {
    let hi = a + b;
    Dd { hi, lo: b - (hi - a) }
}

impl Dd {
    pub const ZERO: Self = Self { hi: 0.0, lo: 0.0 };
    pub const ONE: Self = Self { hi: 1.0, lo: 0.0 };

    /// The nearest `f32`, rounded once.
    pub fn to_f32(self) -> f32 {
        let near = self.hi as f32;
        // `hi` alone decides, except halfway between two neighbours: there `lo` does.
        let rest = self.hi - near as f64;
        let other = if rest > 0.0 { near.next_up() } else { near.next_down() };
        let tie = rest != 0.0 && rest == other as f64 - self.hi;
        if tie && self.lo * rest > 0.0 { other } else { near }
    }

    pub fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    pub fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    /// `self` times a power of two.
    #[inline]
    pub fn scale(self, power: f64) -> Self {
        Self { hi: self.hi * power, lo: self.lo * power }
    }
}

impl<T: Into<f64>> From<T> for Dd {
    #[inline(always)]
    fn from(x: T) -> Self {
        Self { hi: x.into(), lo: 0.0 }
    }
}

impl Neg for Dd {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl<T: Into<Self>> Add<T> for Dd {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: T) -> Self {
        // Both parts in full: relative accuracy even where the high parts cancel.
        let other = other.into();
        let (high, low) = (two_sum(self.hi, other.hi), two_sum(self.lo, other.lo));
        let sum = fast_two_sum(high.hi, high.lo + low.hi);
        fast_two_sum(sum.hi, sum.lo + low.lo)
    }
}

impl<T: Into<Self>> Sub<T> for Dd {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: T) -> Self {
        self + -other.into()
    }
}

impl<T: Into<Self>> Mul<T> for Dd {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: T) -> Self {
        let other = other.into();
        let hi = self.hi * other.hi;
        let lo = self.hi.mul_add(other.hi, -hi);
        fast_two_sum(hi, lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl<T: Into<Self>> Div<T> for Dd {
    type Output = Self;
    fn div(self, other: T) -> Self {
        let other = other.into();
        let first = self.hi / other.hi;
        let rest = self - other * first;
        let second = rest.hi / other.hi;
        let third = (rest - other * second).hi / other.hi;
        two_sum(first, second) + third
    }
}

/// `2^n`
pub fn exp2(n: i32) -> f64 {
    assert!((-1022..1024).contains(&n));
    f64::from_bits(((n + 1023) as u64) << 52)
}
