//! Fractions of the exposure, each counted from the nearer end of the curve: so those next to either end keep their
//! bits.

/// An end of the curve, or of a ramp. `ramp: Side` is the ramp at that end of the curve: the opening one at the start.
///
/// Seen from a side, the ramp there is the *near* one, the other one the *far* one. A ramp meets the plateau, or the
/// other ramp, at its *join*.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Side {
    Start,
    End,
}

use Side::{End, Start};

impl Side {
    pub(crate) const BOTH: [Self; 2] = [Start, End];

    #[inline(always)]
    pub(crate) const fn end_if(is_end: bool) -> Self {
        if is_end { End } else { Start }
    }

    #[inline(always)]
    pub(crate) const fn is_end(self) -> bool {
        matches!(self, End)
    }

    #[inline(always)]
    pub(crate) const fn is(self, other: Self) -> bool {
        self as u8 == other as u8
    }

    #[inline(always)]
    pub(crate) const fn other(self) -> Self {
        match self {
            Start => End,
            End => Start,
        }
    }

    /// This one, or the other one.
    #[inline(always)]
    pub(crate) const fn other_if(self, is_other: bool) -> Self {
        Self::end_if(self.is_end() != is_other)
    }

    /// The sign bit for what counts back, from the end.
    #[inline(always)]
    pub(crate) const fn sign(self) -> u32 {
        (self as u32) << 31
    }
}

/// A fraction of the exposure, counted from a side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fraction {
    pub(crate) side: Side,
    /// From 0 to 1/2.
    pub(crate) a: f32,
}

impl Fraction {
    /// `(odd + more) / 2n`, from 0 to 1, where `odd` is `2i + 1` for item `i` of `n`. For a trigger `more` is 0, and
    /// this is the nearest `f32`. For an end of a pulse it is ±duty, and this is within one and a half ulp
    /// (proofs/ticks.py). Half is counted from the start.
    #[inline(always)]
    pub(crate) const fn new(odd: u32, more: f32, n: u32) -> Self {
        let (part, rest) = (odd as f32 + more, (2 * n - odd) as f32 - more);
        let all = (2 * n) as f32;
        if part <= rest {
            Self { side: Start, a: part / all }
        } else {
            Self { side: End, a: rest / all }
        }
    }
}
