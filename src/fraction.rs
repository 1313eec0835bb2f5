//! A fraction of the exposure, counted from the nearer end of the curve: so those next to either end keep their bits.

/// An end of the curve, or of a ramp. `ramp: Side` is the ramp at that end of the curve: the opening one at the start.
///
/// Seen from a side, the ramp there is the *near* one, the other one the *far* one. A ramp meets the plateau, or the
/// other ramp, at its *join*.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Start,
    End,
}

use Side::{End, Start};

impl Side {
    #[cfg(all(test, feature = "_measure"))]
    pub(crate) const BOTH: [Self; 2] = [Start, End];

    pub(crate) const fn end_if(is_end: bool) -> Self {
        if is_end { End } else { Start }
    }

    pub(crate) const fn is_end(self) -> bool {
        matches!(self, End)
    }

    pub(crate) const fn is(self, other: Self) -> bool {
        self as u8 == other as u8
    }

    pub(crate) const fn other(self) -> Self {
        Self::end_if(!self.is_end())
    }

    /// A time, moved by a way from this side towards the other, both in units.
    pub(crate) const fn inwards(self, time: i64, way: i64) -> i64 {
        if self.is_end() { time - way } else { time + way }
    }
}

/// A fraction of the exposure, counted from a side. As bits, which order fractions as their numbers do, and are looked
/// up without waiting for an FPU.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fraction {
    pub(crate) side: Side,
    /// The bits of an `f32`: from 0 to 1/2 for a `u` in [0, 1].
    pub(crate) bits: u32,
}

impl Fraction {
    /// `u`, from 0 to 1. Outside, the `f32` is negative, and for a NaN it is NaN: no octave has such bits.
    ///
    /// Without a branch, since the side is unpredictable.
    #[inline(always)]
    pub(crate) fn new(u: f32) -> Self {
        let (bits, rest) = (u.to_bits(), (1.0 - u).to_bits());
        // Signed: a negative `u` is counted from the start.
        let is_from_end = bits as i32 > 0.5f32.to_bits() as i32;
        let bits = core::hint::select_unpredictable(is_from_end, rest, bits);
        Self { side: Side::end_if(is_from_end), bits }
    }

    /// `part / whole`, where `part + rest = whole`, by the lesser of the two. Half is counted from the start.
    #[inline(always)]
    pub(crate) const fn of_parts(part: f32, rest: f32, whole: f32) -> Self {
        if part <= rest {
            Self { side: Start, bits: (part / whole).to_bits() }
        } else {
            Self { side: End, bits: (rest / whole).to_bits() }
        }
    }

    pub(crate) const fn get(self) -> f32 {
        f32::from_bits(self.bits)
    }
}
