//! The certificate of an octave: a bound of its polynomial's error over all of it, not at samples alone.
//!
//! Along a [`Stretch`] of a ramp the error in time, `R(s) = Q(x(s)) - t(s)`, is a polynomial: `x`, the offset, has degree
//! 6 in the Bezier's parameter, `Q` has degree 8 in that, `t` has degree 3. With the openness `f` beside it, `R f` is the
//! error in exposure, of degree 51. No root is sought, and a kink of time over exposure is none of these polynomials.
//!
//! **The bound** (Ehlich and Zeller 1964). A polynomial of degree `n` is nowhere on [-1, 1] greater than `1 / cos(n π /
//! 2N)` times its greatest value at the N + 1 Chebyshev-Lobatto points. What `R` has beyond degree `n` is at most `2 M
//! ρ⁻ⁿ / (ρ - 1)`, where `M` bounds it on the ellipse with the foci -1 and 1 and the half axes `(ρ ± 1/ρ) / 2`. To `M`
//! only that counts which has a degree beyond `n`. That is not `t`, not `c₁ x`, and not `Q(x₀ + x₁ s)`. So with `Y₁ =
//! |x₀| + |x₁| A` and `Y = Y₁ + Σ |x_k| A^k`, where `A` is the greater half axis, `M = Σ |c_k| (Y^k - Y₁^k)` from `k = 2`
//! on is enough, and for `R f` that times `Σ |f_k| A^k`.
//!
//! docs/proofs.md leads from this to what an answer is off by.

use crate::octave::DEGREE;
use crate::path::Stretch;

/// Numbers of points, less one, and the cosine of π over that: from the cheapest bound to the closest.
const POINTS: [(usize, f64); 3] =
    [(16, 0.9807852804032304), (48, 0.9978589232386035), (96, 0.9994645874763657)];

/// The number of ways to a bound.
pub(crate) const WAYS: usize = POINTS.len();

/// By how much ellipses are greater than the interval: `ρ`.
const ELLIPSES: [f64; 6] = [2.5, 3.0, 3.5, 4.0, 5.0, 7.0];

/// Half of the least degree that is tried, which `Q(x₀ + x₁ s) f` does not exceed, and how many greater ones are.
const HALF_DEGREE: usize = 6;
const DEGREES: usize = 7;

/// The error, and its products with each of three cubics: all of them at the points, and bounds between these.
pub(crate) struct Errors {
    pub(crate) seen: [f64; 4],
    pub(crate) bound: [f64; 4],
}

/// The errors of the polynomial `q[0] x + q[1] x² + ...` along a stretch whose fraction is counted in offsets, and
/// whose time in the unit of `q`.
#[inline(never)]
pub(crate) const fn errors(
    q: &[f64; DEGREE],
    along: &Stretch,
    weights: &[[f64; 4]; 3],
    way: usize,
) -> Errors {
    let Stretch { elapsed, fraction, .. } = along;
    let (points, cosine) = POINTS[way];
    // Each cosine follows from the two before it. Those of π/N times half a degree are what bounds divide by.
    let (mut seen, mut shares) = ([0.0; 4], [0.0; DEGREES]);
    let (mut s, mut last, mut i) = (1.0, cosine, 0);
    while i <= points {
        let x = value(fraction, s);
        let error = (value(q, x) * x - value(elapsed, s)).abs();
        greater(&mut seen[0], error);
        let mut kind = 1;
        while kind < 4 {
            greater(&mut seen[kind], error * value(&weights[kind - 1], s).abs());
            kind += 1;
        }
        if i >= HALF_DEGREE && i - HALF_DEGREE < DEGREES {
            shares[i - HALF_DEGREE] = s;
        }
        (s, last) = (2.0 * cosine * s - last, s);
        i += 1;
    }
    let mut bound = [f64::INFINITY; 4];
    let mut i = 0;
    while i < ELLIPSES.len() {
        let rho = ELLIPSES[i];
        let axis = 0.5 * (rho + 1.0 / rho);
        let linear = fraction[0].abs() + fraction[1].abs() * axis;
        let all = absolute(fraction, axis);
        let (mut powers, mut greatest, mut k) = ([linear, all], 0.0, 1);
        while k < DEGREE {
            powers = [powers[0] * linear, powers[1] * all];
            greatest += q[k].abs() * (powers[1] - powers[0]);
            k += 1;
        }
        let mut kind = 0;
        while kind < 4 {
            let mut tail = 2.0 * greatest / (rho - 1.0);
            if kind > 0 {
                tail *= absolute(&weights[kind - 1], axis);
            }
            let mut half = 0;
            while half < HALF_DEGREE + DEGREES {
                if half >= HALF_DEGREE {
                    let share = shares[half - HALF_DEGREE];
                    let most = (seen[kind] + tail) / share + tail;
                    // A share of 0 or less is of no degree below that of the points.
                    if share > 0.0 && most < bound[kind] {
                        bound[kind] = most;
                    }
                }
                tail /= rho * rho;
                half += 1;
            }
            kind += 1;
        }
        i += 1;
    }
    Errors { seen, bound }
}

/// The greater of two numbers, or NaN.
const fn greater(most: &mut f64, x: f64) {
    if !(x <= *most) {
        *most = x;
    }
}

/// The value at `x` of a polynomial by its coefficients, from the constant one up.
#[inline(never)]
pub(crate) const fn value(c: &[f64], x: f64) -> f64 {
    let (mut value, mut k) = (0.0, c.len());
    while k > 0 {
        k -= 1;
        value = value * x + c[k];
    }
    value
}

/// The same of its coefficients without their signs: a bound of all values within `x` of 0.
#[inline(never)]
pub(crate) const fn absolute(c: &[f64], x: f64) -> f64 {
    let (mut value, mut k) = (0.0, c.len());
    while k > 0 {
        k -= 1;
        value = value * x + c[k].abs();
    }
    value
}
