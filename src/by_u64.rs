//! The direct way of a `u` in units of 2⁻⁶⁴, as triggers have it: what answers that `u`, and how far beyond it.

use crate::octave::{self, FINER, Octave};
use crate::plan::Plan;
use crate::units::FINE_DOUBLE_WORD;

/// The plateau by `u` in units of 2⁻⁶⁴: the last one, and how many there are.
#[derive(Clone)]
pub(crate) struct PlateauU64 {
    last: u64,
    count: u64,
}

/// What answers a `u` without a search.
pub(crate) enum Direct<'a> {
    /// The plateau's line, by the upper word of `u`.
    Line,
    /// A polynomial, by another word of it.
    Octave(OctaveU64<'a>),
}

/// An octave that has a polynomial, and how its `x` comes from `u`.
///
/// A position, doubled where it has to be, is a word of `a`: it counts 2⁻³² of the octave's power of two, and drops
/// what is above that. From the earlier side `a` is `u`. From the later one it is `-u`, which is `!(u - 1)`: so its
/// word is `-(word + 1)`, where `word` is the one of `u - 1`.
pub(crate) struct OctaveU64<'a> {
    octave: &'a Octave,
    /// Subtracted from `u`, in 2⁻⁶⁴: 1 from the later side, else 0.
    pub(crate) less: u32,
    /// The leading zeros of the octave's power of two, in 64 bits.
    pub(crate) zeros: u32,
    /// The significand of the octave's top, with its leading one.
    end: u32,
    /// What is added to a word to count it from the octave's center: `x = factor (word + ahead)`, in 2⁻³².
    pub(crate) ahead: u32,
    factor: u32,
}

impl<const CELLS: usize> Plan<CELLS> {
    /// The plateau by `u` in units of 2⁻⁶⁴.
    pub(crate) fn plateau_u64(&self) -> PlateauU64 {
        let [near, far] = self.exposure.joins_u64();
        // With a plateau both joins count as on the line, also one at 1/2. Without one, a `u` at the join counts as on
        // the closing ramp. At 1/2 it has to: `direct_u64` counts 1/2 from side 1.
        let last = far.saturating_sub(!self.exposure.has_plateau() as u64);
        let before = near.saturating_sub(1).max(FINE_DOUBLE_WORD);
        // By the slope, not by `count`: a plateau too short for an `f32` may hold fractions of 64 bits.
        let serves = Self::is_fine(self.slope);
        PlateauU64 { last, count: if serves { last.saturating_sub(before) } else { 0 } }
    }

    /// What answers a `u` in units of 2⁻⁶⁴, if the plateau's line or a polynomial does.
    // proofs/octaves.py: both look-ups find the octave that was built, and the same `x`
    #[inline(always)]
    pub(crate) fn direct_u64(&self, u: u64, plateau: &PlateauU64) -> Option<Direct<'_>> {
        let (before_last, is_beyond) = plateau.last.overflowing_sub(u);
        if before_last < plateau.count {
            return Some(Direct::Line);
        }
        let side = (u >> 63) as usize;
        let a = if side == 0 { u } else { u.wrapping_neg() };
        let (high, low) = ((a >> 32) as u32, a as u32);
        // If the upper word is 0, `a` is below all octaves, and the index is that of none, or of one without a
        // polynomial.
        let zeros = high.leading_zeros();
        let significand = high << (zeros & 31) | low >> 1 >> (31u32.wrapping_sub(zeros) & 31);
        // An octave's power of two is at or below its top: if `a` is above the top's significand, it is in the lower
        // binade.
        let top = octave::top(self.tops[side & 1][is_beyond as usize]);
        let end = top << 8 | 1 << 31;
        let zeros = zeros.wrapping_sub((significand > end) as u32);
        // As in `look_up`, but that the exponents stand apart: that of the power of two is the one of 1/2, less the
        // zeros.
        const OF_HALF: u32 = 0.5f32.to_bits() >> 23;
        let index = (top >> 23).wrapping_add(zeros).wrapping_sub(OF_HALF);
        let octave = self.octaves[side & 1].get(index as usize)?;
        if !octave.exists() {
            return None;
        }
        // As `ahead_of_center` has it; but from the later side the position is `-(word + 1)`, so the center is added, and
        // the factor is negative. `back` is -1 there, else 0.
        let (less, zeros) = (side as u32, zeros & 31);
        let back = 0u32.wrapping_sub(less);
        let ahead = (octave.center ^ !back).wrapping_add(1);
        let factor = ((1 << (octave.center & FINER)) ^ back).wrapping_sub(back);
        Some(Direct::Octave(OctaveU64 { octave, less, zeros, end, ahead, factor }))
    }
}

impl OctaveU64<'_> {
    /// The word of `u` that begins after the octave's power of two.
    #[inline(always)]
    fn word(&self, u: u64) -> u32 {
        let u = u.wrapping_sub(self.less as u64);
        let (high, low) = ((u >> 32) as u32, u as u32);
        high << 1 << self.zeros | low >> (31 - self.zeros)
    }

    /// The time, in units, at a `u` that the octave answers.
    #[inline(always)]
    pub(crate) fn time(&self, u: u64) -> i64 {
        self.time_ahead(self.word(u).wrapping_add(self.ahead))
    }

    /// The same at a word to which `ahead` has been added.
    #[inline(always)]
    pub(crate) fn time_ahead(&self, word: u32) -> i64 {
        self.octave.time(word.wrapping_mul(self.factor) as i32)
    }
}
