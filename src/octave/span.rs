//! A span: the part of an octave that its polynomial serves, and how its positions become offsets.

use crate::fixed::{LEAST_TOP, WORD, exponent, fixed_down, power_of_two};
use crate::octave::SHIFT_MASK;

/// [`Span::new`] halves `width` while `half <= FILLED * width`. A word of offsets ends at 1/2 width. It has to hold at
/// most 0.489 widths: 0.48 or 0.47, and 0.009. A shift of 18 would make 0.0175 of that, beyond a candidate's reach.
///
/// | widths | |
/// |---|---|
/// | 0.48 | `half` after a halving |
/// | 0.47 | `half` without one: a quarter of the top, which is at most 15/8 of the power |
/// | 0.009 | the center is off by 2⁸ positions, as `middle` is rounded, and 31 for the shift: 287 · 2¹⁷ / 2³² |
// proofs/octaves.py
const FILLED: f32 = 0.24;
const MOST_SHIFT: u32 = 17;

/// The part of an octave that lies on one ramp, in `a`.
pub(crate) struct Span {
    /// Not rounded to `f32`; `to` is, and `half` has room for that.
    pub(crate) from: f64,
    pub(crate) to: f32,
    pub(crate) middle: f32,
    /// `middle ± half` leads more than two ulp of `a` beyond `from` and `to`: a polynomial errs by less than half of
    /// one, so the time that it gives lies within.
    pub(crate) half: f32,
    /// The power of two at or below the octave's top. A position counts 2⁻³² of it.
    pub(crate) power: f32,
    /// `power / 2^shift`. An offset counts 2⁻³² of it.
    pub(crate) width: f32,
    /// The shift from positions to offsets.
    shift: u32,
}

impl Span {
    /// The part of a ramp's `range` that lies in the octave whose top has these bits; none below LEAST_TOP.
    pub(crate) const fn new(range: [f64; 2], top: u32) -> Option<Self> {
        let top_value = f32::from_bits(top);
        let from = if range[0] > 0.5 * top_value as f64 { range[0] } else { 0.5 * top_value as f64 };
        let to = if range[1] < top_value as f64 { range[1] } else { top_value as f64 };
        if top < LEAST_TOP || from >= to {
            return None;
        }
        let to = to as f32;
        let power = power_of_two(exponent(top_value));
        let half = 0.5 * (to - from as f32) + 4.0 * f32::EPSILON * power;
        let middle = 0.5 * (from as f32 + to);
        // A short span fills the word of its offsets too, so that its coefficients keep their bits.
        let (mut width, mut shift) = (power, 0);
        while shift < MOST_SHIFT && half <= FILLED * width {
            width *= 0.5;
            shift += 1;
        }
        Some(Self { from, to, middle, half, power, width, shift })
    }

    /// The middle in 2⁻³² of the power, which is 2³² more than its position; its lowest bits are the shift instead. The
    /// lower word is `Octave::center`.
    pub(crate) const fn center(&self) -> i64 {
        fixed_down(self.middle, exponent(self.power) - 32) & !(SHIFT_MASK as i64) | self.shift as i64
    }

    /// `(center, per_position)`, exact and not wrapped: the offset, in widths, is `(position - center) per_position`.
    pub(crate) const fn offsets(&self) -> (f64, f64) {
        ((self.center() - (1 << 32)) as f64, (self.power / self.width / WORD) as f64)
    }
}
