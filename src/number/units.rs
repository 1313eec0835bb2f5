//! The units that several files share. All are powers of two, so changing from one to another rounds nothing that
//! counts, but for the last, which is whole.
//!
//! | counted | from 0 at | to | as |
//! |---|---|---|---|
//! | a place along a ramp | one of its ends | [`LAST_PLACE`], 2³⁰, at the other | `f32`, pair |
//! | a fraction of the exposure, *in [`WHOLE`]* | either end of the curve | 2¹⁰⁴ | pair |
//! | a mass, the fraction collected on one ramp | one of its ends | 2⁸⁰ to 2⁸¹, by [`mass_exponent`] | pair |
//! | a time on a ramp | one of its ends | 2⁶⁴ to 2⁶⁵, by [`ramp_exponent`] | pair |
//! | a time on the curve, *in units* | time 0 | ±2⁶², by [`time_exponent`] | `i64` |

/// Places along a ramp count from 0 at one end to this at the other.
///
/// Even the least `f32` u then leads to a normal place. And a mass's last coefficient, of the sixth power, has a normal
/// `lo` if all of the mass is in it: 2⁸⁰ / (2³⁰)⁶ · 2⁻²⁴ = 2⁻¹²⁴.
pub(crate) const LAST_PLACE: f32 = (1 << 30) as f32;

/// The whole exposure. A fraction *in WHOLE* is the fraction times 2¹⁰⁴: 2⁻⁴⁵ for the least `f32`, so that its
/// roundings are normal numbers, too.
pub(crate) const WHOLE: f32 = power_of_two(WHOLE_EXPONENT);
pub(crate) const WHOLE_EXPONENT: i32 = 104;

/// How many values a `u32` has, and a `u64`.
pub(crate) const WORD: f32 = power_of_two(32);
pub(crate) const DOUBLE_WORD: f64 = power_of_two_f64(64);

/// From here on an `f32` is a multiple of 2⁻³², the unit of the plateau's line ([`inverse`](crate::inverse)).
pub(crate) const FINE: f32 = 1.0 / 512.0;

/// The bits of 2⁻²⁸, the least top of an octave; a fraction of 0 is below all octaves. One that begins below 2⁻²⁹ would
/// never get a polynomial: [`JOIN_OFF`](crate::octave::certificate::JOIN_OFF) alone would use up its error.
pub(crate) const LEAST_TOP: u32 = (1.0 / (1 << 28) as f32).to_bits();
/// The bits of tops are multiples of this, an eighth of a power of two, so that each top fits a `u8`.
pub(crate) const EIGHTH: u32 = 1 << 20;

/// The exponent of the factor from [`WHOLE`] to the unit of mass of a ramp with this share, in WHOLE. The ramp has 2⁸⁰
/// to 2⁸¹ of mass, so that all coefficients keep their bits. A share is at least 2⁻³⁰ of WHOLE (proofs/domain.py); or 0
/// on a ramp without length, which has no mass, so that any factor will do.
pub(crate) const fn mass_exponent(share: f32) -> i32 {
    let exponent = exponent(share);
    if exponent < 0 { 0 } else { 80 - exponent }
}

/// The exponent of a ramp's unit of time. The ramp is 2⁶⁴ to 2⁶⁵ of them long (0 if it has no length), so
/// that its last coefficient, of the third power of a place, has a normal second number.
pub(crate) const fn ramp_exponent(start: f32, end: f32) -> i32 {
    exponent(end - start) - 64
}

/// The exponent of a curve's unit of time. Its greatest |time|, or its length if that is more, has 2⁶¹ to 2⁶² units.
pub(crate) const fn time_exponent(start: f32, end: f32) -> i32 {
    let (start, end) = (start as f64, end as f64);
    let most = if start.abs() > end.abs() { start.abs() } else { end.abs() };
    let most = if end - start > most { end - start } else { most };
    (most.to_bits() >> 52) as i32 - 1023 - 61
}

/// `x / 2^e`, which has to be below 2⁶³, rounded down; `e` is at least -125, so a subnormal `x` is less than one.
// proofs/words.py: fixed_down
pub(crate) const fn fixed_down(x: f32, e: i32) -> i64 {
    let significand = (x.to_bits() & 0x7F_FFFF | 1 << 23) as i64;
    let significand = if x < 0.0 { -significand } else { significand };
    let up = exponent(x) - 23 - e;
    if up >= 0 {
        significand << (up & 63)
    } else {
        // Down by 63 or more: -1 or 0.
        significand >> if up > -63 { -up & 63 } else { 63 }
    }
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
