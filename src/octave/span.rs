//! A span: the part of an octave that its polynomial serves, and how positions on it are counted.

use crate::number::units::{LEAST_TOP, WORD, exponent, fixed, power_of_two};
use crate::octave::FINER;
use crate::octave::path::{Path, scale};

/// An offset counts 2⁻³² of `width`, which is the octave's power of two, but halved while `half <= FILLED * width`. So
/// `half` is at most 0.48 of `width`. (If nothing is halved it is less than 0.47, since a top is at most 15/8 of the
/// power.) That leaves 0.02 · 2³² of the word on either side. A center is off by 2⁸, as its middle is rounded, and by
/// its lowest five bits, 31: shifted by the most, 17, that is 0.009 · 2³², of the 0.01 that a candidate's reach leaves.
// proofs/octaves.py
const FILLED: f32 = 0.24;
const MOST_FINER: u32 = 17;

/// The part of an octave that its polynomial serves, in `a`.
pub(crate) struct Span {
    /// Where it begins, and where it ends.
    pub(crate) from: f64,
    pub(crate) to: f32,
    /// The middle, and how far the polynomial reaches from there: some ulp beyond what it serves.
    pub(crate) middle: f32,
    pub(crate) half: f32,
    /// The power of two that is in the octave, or at its end. The unit of positions is 2⁻³² of this.
    pub(crate) power: f32,
    /// `power / 2^finer`. The unit of offsets is 2⁻³² of this.
    pub(crate) width: f32,
    finer: u32,
}

impl Span {
    /// Of the octave below the bits of its `top`; none where it holds nothing of the range.
    pub(crate) const fn new(range: [f64; 2], top: u32) -> Option<Self> {
        let high = f32::from_bits(top);
        let from = if range[0] > 0.5 * high as f64 { range[0] } else { 0.5 * high as f64 };
        let to = if range[1] < high as f64 { range[1] } else { high as f64 };
        if top < LEAST_TOP || from >= to {
            return None;
        }
        let to = to as f32;
        let power = power_of_two(exponent(high));
        let half = 0.5 * (to - from as f32) + 4.0 * f32::EPSILON * power;
        let middle = 0.5 * (from as f32 + to);
        // A small part of an octave fills the word, too, or the coefficients would have few bits. But not all of it:
        // the center's lowest bits are a shift, so that an offset is beyond the half by as much, times 2 to the shift.
        let (mut width, mut finer) = (power, 0);
        while finer < MOST_FINER && half <= FILLED * width {
            width *= 0.5;
            finer += 1;
        }
        Some(Self { from, to, middle, half, power, width, finer })
    }

    /// The middle, nearly, in 2⁻³² of the power of two, with the shift in its lowest bits: in 33 bits, of which a
    /// position has the lower 32.
    pub(crate) const fn center(&self) -> i64 {
        fixed(self.middle, exponent(self.power) - 32) & !(FINER as i64) | self.finer as i64
    }

    /// A stretch, its fractions counted as positions are, from the power of two on.
    pub(crate) const fn counted(&self, mut stretch: Path) -> Path {
        stretch.fraction[0] -= self.power as f64;
        scale(&mut stretch.fraction, (WORD / self.power) as f64, 1.0);
        stretch
    }

    /// The center as a position, and how much a position adds to the offset, in widths.
    pub(crate) const fn offsets(&self) -> (f64, f64) {
        ((self.center() - (1 << 32)) as f64, (self.power / self.width / WORD) as f64)
    }
}
