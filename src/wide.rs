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
    pub(crate) const ZERO: Self = Self { m: 0, e: -10_000 };
    pub(crate) const ONE: Self = Self { m: 1 << 63, e: -63 };

    /// `m · 2^e` for any `m`.
    pub(crate) const fn new(m: u64, e: i32) -> Self {
        if m == 0 {
            return Self::ZERO;
        }
        let up = m.leading_zeros();
        Self { m: m << up, e: e - up as i32 }
    }

    /// A finite `x` that is not below 0, where 0 counts as 2⁻¹⁰²³.
    #[inline(always)]
    pub(crate) const fn from_f64(x: f64) -> Self {
        let bits = x.to_bits();
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

    /// The number counted in units of `2^unit`.
    pub(crate) const fn in_unit(self, unit: i32) -> Self {
        Self { m: self.m, e: self.e - unit }
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
    #[inline(always)]
    pub(crate) const fn minus(self, other: Self) -> Self {
        if !self.exceeds(other) {
            return Self::ZERO;
        }
        let down = (self.e - other.e) as u32;
        let m = if down < 64 { other.m >> down } else { 0 };
        Self::new(self.m - m, self.e)
    }

    /// The greatest power of two in it, but at most 2¹²⁰.
    #[inline(always)]
    pub(crate) const fn power_below(self) -> f32 {
        let e = self.e + 63;
        f32::from_bits(((if e < 120 { e } else { 120 } + 127) as u32) << 23)
    }

    /// `self > other`.
    pub(crate) const fn exceeds(self, other: Self) -> bool {
        self.e > other.e || (self.e == other.e && self.m > other.m)
    }

    /// `self · x` for a finite `x` above 0, to 2⁻⁶².
    #[inline(always)]
    pub(crate) const fn share(self, x: f32) -> Self {
        let x = Self::from_f32(x);
        let a = x.m >> 32;
        let m = a * (self.m >> 32) + ((a * (self.m & 0xFFFF_FFFF)) >> 32);
        let short = (m >> 63 == 0) as u32;
        Self { m: m << short, e: self.e + x.e + 64 - short as i32 }
    }

    /// The nearest `f32`.
    #[inline(always)]
    pub(crate) const fn to_f32(self) -> f32 {
        // The exponent as `f32` counts it, less one, for the significand's top bit adds to it.
        let exponent = self.e + 63 + 126;
        if exponent < 0 {
            return self.to_subnormal();
        }
        f32::from_bits(
            ((exponent as u32) << 23) + nearest((self.m >> 33) as u32 | (self.m << 31 != 0) as u32),
        )
    }

    #[cold]
    #[inline(never)]
    const fn to_subnormal(self) -> f32 {
        let down = (-(self.e + 63 + 126)) as u32;
        if down > 30 {
            return 0.0;
        }
        let m = (self.m >> 33) as u32 | (self.m << 31 != 0) as u32;
        f32::from_bits(nearest(m >> down | (m >> down << down != m) as u32))
    }
}

/// `m / 2⁷` to nearest, and to even from the middle.
#[inline(always)]
const fn nearest(m: u32) -> u32 {
    (m + 0x3F + (m >> 7 & 1)) >> 7
}

/// `a x`, in 32 bits, where `x` counts 2⁻³².
#[inline(always)]
pub(crate) const fn times_high(a: i32, x: i32) -> i32 {
    ((a as i64 * x as i64) >> 32) as i32
}
