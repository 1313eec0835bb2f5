//! The shape of a ramp: a Bezier as it is integrated, in `f64`.

use crate::fraction::Side;
use crate::ramp::bezier::CubicBezier;
use crate::ramp::cubic::{Cubic, differences, integral, widened};

/// A Bezier as it is integrated: seen from one of its ends.
#[derive(Clone, Copy)]
pub(crate) struct Shape {
    /// The openness of the control points.
    pub(crate) f: [f32; 4],
    /// The differences of their times, counted away from that end.
    d: [f64; 3],
}

impl Shape {
    /// Seen from the earlier end.
    pub(crate) const fn new(curve: &CubicBezier) -> Self {
        Self { f: curve.opennesses(), d: differences(widened(curve.times())) }
    }

    /// Seen from the end that faces a side; `self` is seen from the earlier one.
    pub(crate) const fn from(self, side: Side) -> Self {
        let Self { f, d } = self;
        if side.is_end() {
            Self { f: [f[3], f[2], f[1], f[0]], d: [d[2], d[1], d[0]] }
        } else {
            self
        }
    }

    #[inline(never)]
    pub(crate) const fn openness(&self) -> Cubic {
        Cubic::new(self.f[0] as f64, differences(widened(self.f)))
    }

    /// The differences of the control points' times, in single precision.
    pub(crate) const fn differences(&self) -> [f32; 3] {
        [self.d[0] as f32, self.d[1] as f32, self.d[2] as f32]
    }

    /// The time since the end.
    #[inline(never)]
    pub(crate) const fn time(&self) -> Cubic {
        Cubic::new(0.0, self.d)
    }

    /// `∫ f t' dp` since the end, of degree 6: the mass times the curve's area.
    pub(crate) const fn mass(&self) -> [f64; 6] {
        integral(self.openness(), self.time())
    }

    /// `∫ f dt` over the ramp, with the same bits from either end.
    pub(crate) const fn area(&self) -> f64 {
        let (m, n) = (self.mass(), self.from(Side::End).mass());
        let (mut first, mut last, mut k) = (0.0, 0.0, 0);
        while k < m.len() {
            first += m[k];
            last += n[k];
            k += 1;
        }
        0.5 * (first + last)
    }
}
