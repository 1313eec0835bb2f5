//! The fractions of the exposure at which triggers and the ends of pulses are due. A *frame* is the triggers, or the
//! pulses, of one exposure.

/// A fraction of the exposure, counted from the curve's end at a side: 0 from its start, 1 from its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fraction {
    pub(crate) side: usize,
    /// From 0 to 1/2.
    pub(crate) a: f32,
}

impl Fraction {
    /// `(odd + more) / 2n`, which has to be from 0 to 1: within an ulp, or the nearest `f32` if `more` is 0. Half is
    /// counted from the start.
    #[inline(always)]
    pub(crate) const fn new(odd: u32, more: f32, n: u32) -> Self {
        let (part, rest) = (odd as f32 + more, (2 * n - odd) as f32 - more);
        let all = (2 * n) as f32;
        if part <= rest { Self { side: 0, a: part / all } } else { Self { side: 1, a: rest / all } }
    }
}
