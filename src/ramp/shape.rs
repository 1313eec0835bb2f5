//! A ramp's Bezier as polynomials in `f64`: what a curve is built by.

use crate::fraction::Side;
use crate::ramp::bezier::CubicBezier;

/// A Bezier as it is integrated: seen from one of its ends.
#[derive(Clone, Copy)]
pub(crate) struct Shape {
    /// The openness of the control points.
    pub(crate) openness: [f32; 4],
    /// The differences of their times, counted away from that end. The outer two are at least 0, and so is the sum.
    differences: [f64; 3],
}

impl Shape {
    /// Seen from the earlier end.
    pub(crate) const fn new(curve: &CubicBezier) -> Self {
        let [t0, t1, t2, t3] = widened(curve.times());
        Self { openness: curve.opennesses(), differences: [t1 - t0, t2 - t1, t3 - t2] }
    }

    /// Seen from the end that faces a side; `self` is seen from the earlier one.
    pub(crate) const fn seen_from(self, side: Side) -> Self {
        let Self { openness: [f0, f1, f2, f3], differences: [d0, d1, d2] } = self;
        if side.is_end() { Self { openness: [f3, f2, f1, f0], differences: [d2, d1, d0] } } else { self }
    }

    /// `f(p)` by powers of `p`, the constant first.
    #[inline(never)]
    pub(crate) const fn openness_powers(&self) -> [f64; 4] {
        let [f0, f1, f2, f3] = widened(self.openness);
        let [c1, c2, c3] = powers([f1 - f0, f2 - f1, f3 - f2]);
        [f0, c1, c2, c3]
    }

    /// The time since the end, by powers of `p` from the first.
    #[inline(never)]
    pub(crate) const fn time_powers(&self) -> [f64; 3] {
        powers(self.differences)
    }

    /// `∫ f t' dp` since the end, by powers of `p` from the first: the exposure.
    #[inline(never)]
    pub(crate) const fn exposure_powers(&self) -> [f64; 6] {
        // (p^k)' = k p^(k-1), and the integral divides by the next exponent.
        const COUNT: [f64; 5] = [1.0, 2.0, 3.0, 4.0, 5.0];
        let (f, t) = (self.openness_powers(), self.time_powers());
        let (mut mass, mut j) = ([0.0; 6], 0);
        while j < t.len() {
            let mut k = 0;
            while k < f.len() {
                mass[j + k] += COUNT[j] * f[k] * t[j];
                k += 1;
            }
            j += 1;
        }
        let mut k = 0;
        while k < COUNT.len() {
            mass[k] /= COUNT[k];
            k += 1;
        }
        // 3/6 = 1/2: a rounding less, and the same bits seen from the other end.
        mass[5] = f[3] * t[2] / 2.0;
        mass
    }

    /// `∫ f dt` over the ramp, with the same bits from either end.
    pub(crate) const fn area(&self) -> f64 {
        let (first, last) = (self.exposure_powers(), self.seen_from(Side::End).exposure_powers());
        let (mut from_first, mut from_last, mut k) = (0.0, 0.0, 0);
        while k < first.len() {
            from_first += first[k];
            from_last += last[k];
            k += 1;
        }
        0.5 * (from_first + from_last)
    }
}

/// A cubic without its constant, by the differences of its Bernstein coefficients. Seen from the other end, the last
/// power has the same bits, or the other sign for an openness.
const fn powers([d0, d1, d2]: [f64; 3]) -> [f64; 3] {
    [3.0 * d0, 3.0 * (d1 - d0), (d0 + d2) - 2.0 * d1]
}

/// The differences of these are exact, unless their exponents lie 29 or more apart.
const fn widened([a, b, c, d]: [f32; 4]) -> [f64; 4] {
    [a as f64, b as f64, c as f64, d as f64]
}
