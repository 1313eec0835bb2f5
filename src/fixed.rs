//! Fixed point: what is counted as 64-bit integers, in which units, and the product of two of them.
//!
//! | word | meaning | counted from | type, unit |
//! |---|---|---|---|
//! | *mass* | light, as a share of the exposure | an end of the curve or of a ramp | `i64`, 2⁻⁶²: [`ONE`] is all |
//! | *time* | as the user gave it | time 0 | `i64`, *units*: all are below 2⁶² ([`Units`]) |
//! | *way* | the time since an end | an end of the curve or of a ramp | `i64`, *fine units*, or units where said |
//! | *place* | the parameter `p` of a ramp's Bezier | an end of the ramp | `u64`, 2⁻⁶⁴ |
//! | openness | | | `i64`, 2⁻⁶⁰ |
//!
//! The interval has 2⁶¹ to 2⁶² fine units. A *fraction* is an `f32` ([`fraction`](crate::fraction)): `u` from the
//! curve's start, or `a` from its nearer end.

/// The whole exposure.
pub(crate) const ONE: i64 = 1 << 62;

/// How many values a `u32` has, and a `u64`.
pub(crate) const WORD: f32 = power_of_two(32);
pub(crate) const DOUBLE_WORD: f64 = power_of_two_f64(64);

/// From here on an `f32` is a multiple of 2⁻³², the unit of the plateau's line ([`inverse`](crate::inverse)).
pub(crate) const LINE_FROM: f32 = 1.0 / 512.0;

/// The bits of 2⁻²², the least top of an octave ([`octave`](crate::octave)), which holds what is above 2⁻²³. A frame's
/// triggers are at least 2⁻²³ from either end of the curve; 2⁻²³ itself, which only the largest frame has, is
/// searched for.
pub(crate) const LEAST_TOP: u32 = (1.0 / (1 << 22) as f32).to_bits();
/// The bits of tops are multiples of this, an eighth of a power of two.
pub(crate) const EIGHTH: u32 = 1 << 20;

/// `a x / 2⁶⁴`, low by less than 3: of four products two are rounded down, and the lowest is left out. For an `a` of
/// at least 0 it never falls as `a` or `x` grows.
#[inline(always)]
pub(crate) const fn product(a: i64, x: u64) -> i64 {
    let (high, low) = (a >> 32, a as u64 & 0xFFFF_FFFF);
    let (x_high, x_low) = (x >> 32, x & 0xFFFF_FFFF);
    high * x_high as i64 + ((high * x_low as i64) >> 32) + ((low * x_high) >> 32) as i64
}

/// `x`, or the nearer of 0 and `most`, where rounding has led beyond them.
pub(crate) const fn clamped(x: i64, most: i64) -> i64 {
    if x > most {
        most
    } else if x > 0 {
        x
    } else {
        0
    }
}

/// `floor(a x / 2^(64 - shift))`, for a `shift` of up to 31 with which that fits.
#[inline(always)]
pub(crate) const fn product_up(a: i64, x: u64, shift: u32) -> i64 {
    let (high, low) = (a >> 32, a as u64 & 0xFFFF_FFFF);
    let (x_high, x_low) = (x >> 32, x & 0xFFFF_FFFF);
    let lower = high * x_low as i64 + ((low * x_low) >> 32) as i64;
    let middle = (low * x_high) + (lower as u64 & 0xFFFF_FFFF);
    let whole = high * x_high as i64 + (lower >> 32) + (middle >> 32) as i64;
    whole << (shift & 31) | (middle as u32 as u64 >> ((32 - shift) & 63)) as i64
}

/// The units of a curve's times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Units {
    /// The time of 2³² *units*. The curve's greatest |time|, or its interval if that is longer, has 2⁶¹ to 2⁶² units.
    pub(crate) word: f32,
    /// A unit is `2^fine` *fine units*, of which the interval has 2⁶¹ to 2⁶². By `domain::LEAST_INTERVAL`, `fine` is
    /// at most 16.
    pub(crate) fine: u32,
}

impl Units {
    pub(crate) const fn new(start: f32, end: f32) -> Self {
        const fn unit_exponent(x: f64) -> i32 {
            (x.to_bits() >> 52) as i32 - 1023 - 61
        }
        let (start, end) = (start as f64, end as f64);
        let most = if start.abs() > end.abs() { start.abs() } else { end.abs() };
        let most = if end - start > most { end - start } else { most };
        let unit = unit_exponent(most);
        Self { word: power_of_two(unit + 32), fine: (unit - unit_exponent(end - start)) as u32 }
    }

    /// A unit is the time `2^exponent`: -125 or more, as an interval is 2⁻⁶⁴ or more (`domain`). So `word` is 2⁻⁹³ or
    /// more.
    pub(crate) const fn exponent(self) -> i32 {
        exponent(self.word) - 32
    }

    /// A time in units, rounded down. So the difference of two is off by less than a unit, and a way by two fine units
    /// at most. For if a unit has four or more, the interval is below half of the greatest |time|: every |time| is
    /// above half of that one, 2⁶⁰ units. An `f32` of this size is a whole number of units, and a way is exact.
    #[inline(always)]
    pub(crate) const fn of(self, time: f32) -> i64 {
        fixed_down(time, self.exponent())
    }

    /// From units to fine units.
    pub(crate) const fn refined(self, units: i64) -> i64 {
        units << (self.fine & 31)
    }

    /// From fine units to units, rounded down.
    pub(crate) const fn coarsened(self, way: i64) -> i64 {
        way >> (self.fine & 31)
    }
}

/// `x / 2^e`, which has to be below 2⁶³, rounded down, for an `e` of -125 or more: a subnormal `x` is less than one.
// proofs/words.py: fixed_down
pub(crate) const fn fixed_down(x: f32, e: i32) -> i64 {
    let significand = ((x.to_bits() & 0x7F_FFFF | 1 << 23) as i64) << 39;
    let down = 62 + e - exponent(x);
    // Down by 63 or more it is less than one.
    (if x < 0.0 { -significand } else { significand }) >> if down < 63 { down as u32 & 63 } else { 63 }
}

/// An `x` from 0 to 1 in 2⁻⁶⁰, rounded down: by halves, each exact, since an FPU converts only 32 bits at a time.
#[inline(always)]
pub(crate) const fn in_2_60(x: f32) -> i64 {
    let two_30 = power_of_two(30);
    let upper = (x * two_30) as i32;
    ((upper as i64) << 30) + ((x * two_30 - upper as f32) * two_30) as i32 as i64
}

/// `x / 2^e` rounded towards 0; `±i64::MAX` from 2⁶³ on, and for NaN.
// proofs/words.py: fixed_towards_0
#[inline(never)]
pub(crate) const fn fixed_towards_0(x: f64, e: i32) -> i64 {
    let bits = x.to_bits();
    let significand = (bits & ((1 << 52) - 1) | 1 << 52) as i64;
    let up = (bits >> 52 & 0x7FF) as i32 - 1075 - e;
    let units = if up > 10 {
        i64::MAX
    } else if up >= 0 {
        significand << (up & 63)
    } else if up > -64 {
        significand >> (-up & 63)
    } else {
        0
    };
    if (bits as i64) < 0 { -units } else { units }
}

/// The bits of the greatest `f32` at or below `x`, which is from 0 to about 1.
// proofs/words.py: floor_bits
#[inline(never)]
pub(crate) const fn floor_bits(x: f64) -> u32 {
    let rounded = x as f32;
    let bits = rounded.to_bits();
    if rounded as f64 > x { bits - 1 } else { bits }
}

/// `x` in single precision, for a step. It is off by at most an ulp and a half or 2⁸, whichever is more. (Just below 0
/// the words cancel: -1 gives 0.) By words, since an FPU converts only 32 bits at a time.
pub(crate) const fn single(x: i64) -> f32 {
    (x >> 32) as i32 as f32 * WORD + x as u32 as f32
}

/// The upper word of `x`, which rounds to the same `f32` as both words: a small processor converts 32 bits, not 64.
/// None if it has fewer than 26 bits. With 26, two more than an `f32`, all that counts of the lower word is whether it
/// is 0: the *sticky bit*.
// proofs/words.py
#[inline(always)]
pub(crate) fn upper_word(x: i64) -> Option<i32> {
    let high = (x >> 32) as i32;
    let has_enough = high.wrapping_add(1 << 25) as u32 >= 1 << 26;
    has_enough.then_some(high | (x as u32 != 0) as i32)
}

/// `x` as an `f32`, rounded once, where 2³² of the units of `x` are `word`, a power of two from 2⁻⁹³ on.
#[inline(always)]
pub(crate) fn rounded(x: i64, word: f32) -> f32 {
    match upper_word(x) {
        Some(high) => high as f32 * word,
        None => rounded_near_0_cold(x, word),
    }
}

/// [`rounded_near_0`], for callers that seldom need it.
#[cold]
#[inline(never)]
fn rounded_near_0_cold(x: i64, word: f32) -> f32 {
    rounded_near_0(x, word)
}

/// [`rounded`] of an `x` of fewer than 26 bits in its upper word. (`x as f32` would be a call.)
// proofs/words.py
#[inline(always)]
pub(crate) fn rounded_near_0(x: i64, word: f32) -> f32 {
    // An `x` of one word moves up by 31, and keeps its sign.
    let sign = (x >> 63) as i32;
    let is_word = (x >> 32) as i32 == sign;
    let (x, moved) = if is_word { (x << 31, 31) } else { (x, 0) };
    let (high, low) = ((x >> 32) as i32, x as u32);
    // Then up until the upper word is full. The lower word moves by 32 - up, which may be 32.
    let up = (high ^ sign).leading_zeros().wrapping_sub(1) & 31;
    let filled = high << up | (low >> 1 >> (31 - up)) as i32 | (low << up != 0) as i32;
    // One factor after the other, as their product could be subnormal. The answer is normal, or 0.
    filled as f32 * f32::from_bits((127 - moved - up) << 23) * word
}

/// `2^n`, a normal number.
pub(crate) const fn power_of_two(n: i32) -> f32 {
    f32::from_bits(((n + 127) as u32) << 23)
}

pub(crate) const fn power_of_two_f64(n: i32) -> f64 {
    f64::from_bits(((1023 + n) as u64) << 52)
}

/// `floor(log2 |x|)` of a normal `x`; -127 of a subnormal one or 0.
pub(crate) const fn exponent(x: f32) -> i32 {
    (x.to_bits() >> 23 & 0xFF) as i32 - 127
}
