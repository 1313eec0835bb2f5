//! The shape of a ramp: the checks that make a Bezier a ramp, and that Bezier as it is integrated, in `f64`.

use crate::error::{CurveError, Part};
use crate::fraction::Side;
use crate::ramp::bezier::CubicBezier;
use crate::ramp::cubic::{Cubic, cubic_range, differences, integral, quadratic_min, widened};
use crate::ramp::lift::{forward, lifted};

/// By this share of its size a quantity may pass its bound, as its control points are rounded.
const GRAZE: f64 = 1.0 / (1 << 22) as f64;

/// Is every coordinate finite?
#[inline(never)]
pub(crate) const fn check_finite(curve: &CubicBezier, part: Part) -> Result<(), CurveError> {
    let (t, f) = (curve.times(), curve.opennesses());
    let mut i = 0;
    while i < 4 {
        if !t[i].is_finite() || !f[i].is_finite() {
            return Err(CurveError::NotFinite(part));
        }
        i += 1;
    }
    Ok(())
}

/// Does time run forward, and does the openness stay in [0, 1]?
///
/// The control values of a curve that touches its bound, such as -1/3, are rarely `f32`. So time's slope may pass its
/// bound by [`GRAZE`] of the ramp's length, and the openness by as much of the greatest |f|.
pub(crate) const fn check_ramp(curve: &CubicBezier, part: Part) -> Result<(), CurveError> {
    let t = widened(curve.times());
    // Time may leave the ramp by GRAZE²/4 of its length. Rounding may turn t = p² (inner control times 0 and 1/3) into
    // p² - GRAZE p, which dips by that. Steeper starts dip more, and are refused. t' is three times the differences.
    let (first, last) = cubic_range([0.0, t[1] - t[0], t[2] - t[0], t[3] - t[0]]);
    let slack = (t[3] - t[0]) * (0.25 * GRAZE * GRAZE);
    let leaves = first < -slack || last > t[3] - t[0] + slack;
    if leaves || quadratic_min(differences(t)).0 < -GRAZE / 3.0 * (t[3] - t[0]) {
        return Err(CurveError::TimeTurnsBack(part));
    }
    let (low, high) = cubic_range(widened(curve.opennesses()));
    let size = if -low > high { -low } else { high };
    if low < -GRAZE * size {
        return Err(CurveError::NegativeOpenness(part));
    }
    if high > 1.0 + GRAZE {
        return Err(CurveError::OpennessAboveOne(part));
    }
    Ok(())
}

/// A Bezier as it is integrated: lifted where it passes a bound, and seen from one of its ends.
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
        let times = widened(curve.times());
        let d = forward(differences(times), times[3] - times[0]);
        Self { f: lifted(curve.opennesses()), d }
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
