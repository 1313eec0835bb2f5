//! The scales on which the inside counts, and the steps from one to another. All are powers of two, so that no step
//! rounds. The rows name things that their files introduce. A *fraction* is of the whole exposure; a *mass* is what is
//! collected on one ramp, a fraction too; only `Shape::mass` is not yet divided by the whole. Other
//! scales stand elsewhere: an openness has its own in [`by_time`](crate::ramp::by_time), a tiny sum in
//! [`moment`](crate::number::moment), and, while a curve is built, places in [`path`](crate::octave::path), samples in
//! [`bound`](crate::octave::bound), and a polynomial's coefficients in [`candidate`](crate::octave::candidate).
//!
//! | what is counted | from | to | in |
//! |---|---|---|---|
//! | a place along a ramp | 0 at one of its ends | [`LAST_PLACE`] at the other | `f32`, [`Pair`](crate::number::pair::Pair) |
//! | a fraction of the exposure that is searched for | 0 | [`WHOLE`] | pairs |
//! | a mass on a ramp | 0 | 2⁸⁰ to 2⁸¹, all of the ramp: [`mass_per_fraction`] | pairs |
//! | a time on a ramp | 0 at its end | 2⁶⁴ to 2⁶⁵, all of the ramp: [`ramp_unit`] | pairs |
//! | a time on the curve | time 0 | at most 2⁶² either way: [`time_unit`] | `i64` |
//! | a fraction of the exposure on the plateau's line ([`plan`](crate::answer::plan)) | 0 | 2³² | `u32` |
//! | a fraction `(2i + 1) / 2n` | 0 | 2⁶⁴, its rest to 2⁹⁶ | `u64` and `u32` |
//! | a position in an [`octave`](crate::octave), in 2⁻³² of its power or, above, 2⁻³¹ | that power of two | ±2³¹ | `i32` |
//! | the `x` of its polynomial | the middle of what it serves | at most 2³¹ either way | `i32` |
//! | the top of an octave | [`LEAST_TOP`] | 255 [`TOP_STEP`]s above that | `u8`, or the bits of an `f32` |
//! | `TickScale::factor` in [`ticks`](crate::trigger::ticks), in 2⁻⁶⁴ of a tick | 0 | 2⁵⁸ | `u64` |

/// How far a ramp goes: places along it count from 0 at one end to this at the other.
///
/// The least `f32` u then still leads to a place that is a normal number. And so is the second number of the pair that
/// is a mass's last coefficient, that of the sixth power: 2⁸⁰ / (2³⁰)⁶ and 24 bits less.
pub(crate) const LAST_PLACE: f32 = (1 << 30) as f32;

/// The whole exposure; a fraction *in WHOLE* is counted so that all of it is this. The least `f32`, and what rounding
/// makes of it, are then normal numbers.
pub(crate) const WHOLE: f32 = power_of_two(WHOLE_EXPONENT);
pub(crate) const WHOLE_EXPONENT: i32 = 104;

/// How many units of a word there are in what the word can count: 2³², and of a double word, 2⁶⁴.
pub(crate) const WORD: f32 = power_of_two(32);
pub(crate) const DOUBLE_WORD: f64 = power_of_two_f64(64);

/// An `f32` from here on has no bit below 2⁻³², which is the unit of the plateau's line.
pub(crate) const FINE: f32 = 1.0 / 512.0;

/// The bits of 2⁻²⁸, the least top of an octave. There are no octaves below it, so a fraction of 0 falls into none. (One
/// more would be of no use: what a fraction may be off by, `OFF` in [`certificate`](crate::octave::certificate), would leave its
/// polynomial no error.)
pub(crate) const LEAST_TOP: u32 = (1.0 / (1 << 28) as f32).to_bits();
/// Tops are multiples of so many bits, eight to a power of two. So each fits a byte.
pub(crate) const TOP_STEP: u32 = 1 << 20;

/// The factor from [`WHOLE`] to a ramp's own unit of mass, for a ramp with this share of the exposure: in it the ramp
/// has from 2⁸⁰ to 2⁸¹ (0 if it is dark), so that all coefficients keep their bits.
#[inline(always)]
pub(crate) const fn mass_per_fraction(share: f32) -> f32 {
    power_of_two(up_of_mass(share))
}

/// The factor back.
#[inline(always)]
pub(crate) const fn fraction_per_mass(share: f32) -> f32 {
    power_of_two(-up_of_mass(share))
}

#[inline(always)]
const fn up_of_mass(share: f32) -> i32 {
    // The exponent of 2⁻¹⁵⁰ of the exposure in WHOLE: a ramp with less is dark. There the factor is 2¹²⁶ and the one
    // back 2⁻¹²⁶, the last that are normal numbers: so WHOLE and the 2⁸⁰ depend on each other.
    const DARK: i32 = WHOLE_EXPONENT - 150;
    let exponent = exponent(share);
    80 - if exponent < DARK { DARK } else { exponent }
}

/// The exponent of a ramp's own unit of time: in it the ramp is [`LENGTH`] long, or up to twice that (or less, if its
/// length is subnormal), so that the second number of its last coefficient, for the cube of a place, is normal.
#[inline(always)]
pub(crate) const fn ramp_unit(start: f32, end: f32) -> i32 {
    exponent(end - start) - 64
}
pub(crate) const LENGTH: f32 = power_of_two(64);

/// The exponent of a curve's unit of time, in which its times and their differences count at most 2⁶².
pub(crate) const fn time_unit(start: f32, end: f32) -> i32 {
    let (start, end) = (start as f64, end as f64);
    let most = if start.abs() > end.abs() { start.abs() } else { end.abs() };
    let most = if end - start > most { end - start } else { most };
    (most.to_bits() >> 52) as i32 - 1023 - 61
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

/// The same for an `f64`: `i64::MAX` in size from 2⁶³ on, and for NaN.
#[inline(never)]
pub(crate) const fn fixed_f64(x: f64, e: i32) -> i64 {
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

/// The bits of the greatest `f32` at or below a non-negative `x` that is at most about 1.
// proofs/words.py: floor_bits
pub(crate) const fn floor_bits(x: f64) -> u32 {
    let rounded = x as f32;
    let bits = rounded.to_bits();
    if rounded as f64 > x { bits - 1 } else { bits }
}

/// `2^n`, a normal number.
#[inline(always)]
pub(crate) const fn power_of_two(n: i32) -> f32 {
    f32::from_bits(((n + 127) as u32) << 23)
}

pub(crate) const fn power_of_two_f64(n: i32) -> f64 {
    f64::from_bits(((1023 + n) as u64) << 52)
}

/// The exponent of the power of two at or below a normal `x`; -127 for what is less.
#[inline(always)]
pub(crate) const fn exponent(x: f32) -> i32 {
    (x.to_bits() >> 23 & 0xFF) as i32 - 127
}
