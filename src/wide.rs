//! A non-negative number with a 64-bit significand.
//!
//! The microcontrollers this crate is for multiply 32 by 32 bits to 64 in one cycle but have no unit
//! for doubles, so what `f32` cannot carry is carried here: exact to 2⁻⁶², and the same bits on
//! every machine.
//!
//! What is not in the direct way is kept out of line: it is rare, and flash is small.

/// `m · 2^e`, where `m` is 0 or has its top bit set.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wide {
    pub(crate) m: u64,
    pub(crate) e: i32,
}

impl Wide {
    pub(crate) const ZERO: Self = Self { m: 0, e: 0 };
    pub(crate) const ONE: Self = Self { m: 1 << 63, e: -63 };

    /// `m · 2^e` for any `m`.
    pub(crate) const fn new(m: u64, e: i32) -> Self {
        if m == 0 {
            return Self::ZERO;
        }
        let up = m.leading_zeros();
        Self { m: m << up, e: e - up as i32 }
    }

    /// The magnitude of a finite, normal or zero `x`.
    pub(crate) const fn from_f64(x: f64) -> Self {
        let bits = x.to_bits() & (u64::MAX >> 1);
        if bits == 0 {
            return Self::ZERO;
        }
        Self { m: bits << 11 | 1 << 63, e: (bits >> 52) as i32 - (1023 + 63) }
    }

    /// The magnitude of a finite `x`.
    pub(crate) const fn from_f32(x: f32) -> Self {
        let bits = x.to_bits() & (u32::MAX >> 1);
        if bits < 1 << 23 {
            return Self::new(bits as u64, -149);
        }
        let m = bits << 8 | 1 << 31;
        Self { m: (m as u64) << 32, e: (bits >> 23) as i32 - (127 + 63) }
    }

    /// `|a - b|` of two finite numbers.
    #[inline(never)]
    pub(crate) const fn between(a: f32, b: f32) -> Self {
        let (x, y) = (Self::from_f32(a), Self::from_f32(b));
        if (a < 0.0) != (b < 0.0) {
            x.plus(y)
        } else if x.exceeds(y) {
            x.minus(y)
        } else {
            y.minus(x)
        }
    }

    pub(crate) const fn to_f64(self) -> f64 {
        self.m as f64 * f64::from_bits(((self.e + 1023) as u64) << 52)
    }

    pub(crate) const fn is_zero(self) -> bool {
        self.m == 0
    }

    /// The number in units of `2^e`, rounded down; the caller sees to it that 63 bits hold it.
    pub(crate) const fn in_units(self, e: i32) -> i64 {
        let down = (e - self.e) as u32;
        if down < 64 { (self.m >> down) as i64 } else { 0 }
    }

    /// `self · other`, to 2⁻⁶².
    #[inline(never)]
    pub(crate) const fn times(self, other: Self) -> Self {
        let (ah, al) = (self.m >> 32, self.m & 0xFFFF_FFFF);
        let (bh, bl) = (other.m >> 32, other.m & 0xFFFF_FFFF);
        let m = ah * bh + ((ah * bl) >> 32) + ((al * bh) >> 32);
        // Of two normalised significands it is at most one bit short.
        let short = (m >> 63 == 0) as u32;
        if m == 0 {
            return Self::ZERO;
        }
        Self { m: m << short, e: self.e + other.e + 64 - short as i32 }
    }

    /// `self + other`, to 2⁻⁶².
    #[inline(never)]
    pub(crate) const fn plus(self, other: Self) -> Self {
        let (big, small) = if self.exceeds(other) { (self, other) } else { (other, self) };
        if small.is_zero() {
            return big;
        }
        // One unit up, so that the carry has room.
        Self::new((big.m >> 1) + small.in_units(big.e + 1) as u64, big.e + 1)
    }

    /// `self - other`, or 0 where `other` is the greater.
    #[inline(never)]
    pub(crate) const fn minus(self, other: Self) -> Self {
        if !self.exceeds(other) {
            return Self::ZERO;
        }
        let down = (self.e - other.e) as u32;
        let m = if down < 64 { other.m >> down } else { 0 };
        Self::new(self.m - m, self.e)
    }

    /// `self > other`.
    pub(crate) const fn exceeds(self, other: Self) -> bool {
        if self.is_zero() || other.is_zero() {
            return !self.is_zero();
        }
        self.e > other.e || (self.e == other.e && self.m > other.m)
    }

    /// `base + self`, or `base - self` where `back`, rounded once.
    #[inline]
    pub(crate) const fn offset(self, base: f32, back: bool) -> f32 {
        // 2⁶⁴
        const UP: f32 = 18446744073709551616.0;
        let e = self.e + 63;
        let small = base.abs() < 1.0 / UP;
        let (e, base, down) = if e < -126 && base.abs() < f32::MIN_POSITIVE {
            // Both subnormal: whole numbers of the least one, whose sum is exact.
            let halves = self.in_units(-150);
            let part = f32::from_bits(((halves + 1) >> 1) as u32);
            return if back { base - part } else { base + part };
        } else if e < -102 && small && e >= -190 {
            // The lower bits would be subnormal, and so rounded by themselves: scaled up, they are not.
            (e + 64, base * UP, 1.0 / UP)
        } else if e < -126 {
            return base;
        } else {
            (e, base, 1.0)
        };
        let scale = f32::from_bits(((e + 127) as u32) << 23);
        let scale = if back { -scale } else { scale };
        // 24 bits and the 32 after them, the first exact.
        let high = (self.m >> 40) as u32 as f32 * (1.0 / (1u32 << 23) as f32) * scale;
        let low = (self.m >> 8) as u32 as f32 * (1.0 / (1u64 << 55) as f32) * scale;
        // Knuth's two-sum keeps what the first addition loses.
        let near = base + high;
        let part = near - base;
        let lost = (base - (near - part)) + (high - part);
        (near + odd_sum(lost, low)) * down
    }
}

/// `a + b` rounded to odd: where it is inexact, the last bit is set, so that rounding it again can't take it
/// for a tie that it only came near to.
const fn odd_sum(a: f32, b: f32) -> f32 {
    let near = a + b;
    let part = near - a;
    let lost = (a - (near - part)) + (b - part);
    if lost == 0.0 {
        return near;
    }
    let beyond = (lost > 0.0) == (near > 0.0);
    f32::from_bits((near.to_bits() - !beyond as u32) | 1)
}
