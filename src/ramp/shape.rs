//! A ramp's Bezier as polynomials in `f64`: what a curve is built by.

use crate::fraction::Side;
use crate::ramp::bezier::CubicBezier;

/// A Bezier as it is integrated, by powers of `p`: from its earlier end for `Side::Start`, else from the later one.
pub(crate) struct Shape {
    /// `f(p)`, the constant first.
    pub(crate) openness: [f64; 4],
    /// The time since the end, from the first power.
    pub(crate) time: [f64; 3],
}

impl Shape {
    #[inline(never)]
    pub(crate) const fn new(bezier: &CubicBezier, side: Side) -> Self {
        // The differences are exact, unless exponents lie 29 or more apart.
        let ([t0, t1, t2, t3], [f0, f1, f2, f3]) = (widened(bezier.times()), widened(bezier.opennesses()));
        let (constant, opennesses, times) = match side {
            Side::Start => (f0, [f1 - f0, f2 - f1, f3 - f2], [t1 - t0, t2 - t1, t3 - t2]),
            Side::End => (f3, [f2 - f3, f1 - f2, f0 - f1], [t3 - t2, t2 - t1, t1 - t0]),
        };
        let [c1, c2, c3] = powers(opennesses);
        Self { openness: [constant, c1, c2, c3], time: powers(times) }
    }

    /// `∫ f t' dp` since the end, from the first power: the mass, not divided by the area.
    #[inline(never)]
    pub(crate) const fn mass(&self) -> [f64; 6] {
        // time[j] is of p^(j + 1), so its derivative has the factor COUNT[j]. Times f[k] that is of p^(j + k), and its
        // integral is divided by COUNT[j + k].
        const COUNT: [f64; 5] = [1.0, 2.0, 3.0, 4.0, 5.0];
        let Self { openness: f, time: t } = self;
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
        // 3/6 = 1/2: a rounding less, and the same size, to the bit, seen from the other end.
        mass[5] = f[3] * t[2] / 2.0;
        mass
    }
}

/// `∫ f dt` over the ramp. It is the mean of both ends' sums, so that a mirrored ramp has the same bits.
pub(crate) const fn area(bezier: &CubicBezier) -> f64 {
    let [first, last] = [Shape::new(bezier, Side::Start).mass(), Shape::new(bezier, Side::End).mass()];
    let (mut from_first, mut from_last, mut k) = (0.0, 0.0, 0);
    while k < first.len() {
        from_first += first[k];
        from_last += last[k];
        k += 1;
    }
    0.5 * (from_first + from_last)
}

/// A cubic without its constant, by the differences of its Bernstein coefficients. Seen from the other end, the last
/// power has the same bits, or the other sign for an openness.
const fn powers([d0, d1, d2]: [f64; 3]) -> [f64; 3] {
    [3.0 * d0, 3.0 * (d1 - d0), (d0 + d2) - 2.0 * d1]
}

const fn widened([a, b, c, d]: [f32; 4]) -> [f64; 4] {
    [a as f64, b as f64, c as f64, d as f64]
}
