//! The shape of a ramp: one Bezier in `f64`, as a curve's construction integrates it.

use crate::bezier::CubicBezier;
use crate::cubic::{Cubic, differences, forward, integral, lifted, widened};

/// A Bezier as it is integrated: lifted where it grazes a bound, and seen from one of its ends.
#[derive(Clone, Copy)]
pub(crate) struct Shape {
    /// The openness of the control points.
    pub(crate) f: [f32; 4],
    /// The differences of their times, all counted away from the end.
    d: [f64; 3],
}

impl Shape {
    /// Seen from the earlier end.
    pub(crate) const fn new(curve: &CubicBezier) -> Self {
        let times = widened(curve.times());
        let d = forward(differences(times), times[3] - times[0]);
        Self { f: lifted(curve.opennesses()), d }
    }

    /// Seen from the other end.
    pub(crate) const fn reversed(self) -> Self {
        let Self { f, d } = self;
        Self { f: [f[3], f[2], f[1], f[0]], d: [d[2], d[1], d[0]] }
    }

    pub(crate) const fn openness(&self) -> Cubic {
        Cubic::new(self.f[0] as f64, differences(widened(self.f)))
    }

    /// The differences of the control points' times, in single precision.
    pub(crate) const fn differences(&self) -> [f32; 3] {
        [self.d[0] as f32, self.d[1] as f32, self.d[2] as f32]
    }

    /// The time passed since the end.
    pub(crate) const fn elapsed(&self) -> Cubic {
        Cubic::new(0.0, self.d)
    }

    /// The mass collected since the end: `∫ f t' dp`, of degree 6.
    pub(crate) const fn collected(&self) -> [f64; 6] {
        integral(self.openness(), self.elapsed())
    }

    /// `∫ f dt` over the ramp, the same seen from both ends.
    pub(crate) const fn mass(&self) -> f64 {
        let (m, n) = (self.collected(), self.reversed().collected());
        let first = m[0] + m[1] + m[2] + m[3] + m[4] + m[5];
        let last = n[0] + n[1] + n[2] + n[3] + n[4] + n[5];
        0.5 * (first + last)
    }
}
