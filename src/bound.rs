//! A bound of a polynomial's error over all of an octave, not at samples alone.
//!
//! Along a stretch of a ramp the error in time, `R(s) = Q(x(s)) - t(s)`, is a polynomial of the place `s`, from -1 to
//! 1: the offset `x` has degree 6, `Q` has degree 8 in that, and the time `t` has degree 3. With the openness `f`
//! beside it, `R f` is the error in exposure, of degree 51. Nothing is inverted for it, and where time has a kink over
//! exposure, these polynomials have none.
//!
//! **The bound** (Ehlich and Zeller 1964). A polynomial of degree `n` is nowhere on [-1, 1] greater than `1 / cos(n π /
//! 2N)` times its greatest value at the N + 1 Chebyshev-Lobatto points. What `R` has beyond degree `n` is at most `2 M
//! ρ⁻ⁿ / (ρ - 1)`, where `M` bounds it on the ellipse with the foci -1 and 1 and the half axes `(ρ ± 1/ρ) / 2`. What
//! has a degree of at most `n` may be taken away first: `t`, `c₁ x`, and `Q(x₀ + x₁ s)`. So with `Y₁ =
//! |x₀| + |x₁| A` and `Y = Y₁ + Σ |x_k| A^k`, where `A` is the greater half axis, `M = Σ |c_k| (Y^k - Y₁^k)` from `k = 2`
//! on is enough, and for `R f` that times `Σ |f_k| A^k`.
//!
//! Each sample goes the answer's own way, from the position of a fraction to the polynomial's value in 32 bits, so that
//! nothing is certified but what is served. Its rounding is known and is counted twice, in the samples and between
//! them. All else may be in `f32`, whose rounding [`SLACK`] makes up for.
//!
//! docs/proofs.md leads from this to what an answer is off by.

use crate::octave::{DEGREE, Octave};
use crate::path::{Path, absolute, unknown, value};

/// N, which is even, for N + 1 points, and the cosine of π/N: from the cheapest bound to the closest.
const POINTS: [(usize, f64); 3] =
    [(22, 0.9898214418809327), (48, 0.9978589232386035), (96, 0.9994645874763657)];

/// A bound is tried with so many efforts, the cheapest first.
pub(crate) const EFFORTS: usize = POINTS.len();

/// For each ellipse `A`, `1/ρ²` and `2 ρ⁻¹² / (ρ - 1)`, where 12 is the least degree that is tried: `Q(x₀ + x₁ s) f`
/// has degree 11, so it may be taken away first.
const ELLIPSES: [[f32; 3]; 6] =
    [ellipse(2.5), ellipse(3.0), ellipse(3.5), ellipse(4.0), ellipse(5.0), ellipse(7.0)];

const fn ellipse(rho: f32) -> [f32; 3] {
    let square = 1.0 / (rho * rho);
    let twelfth = square * square * square * square * square * square;
    [0.5 * (rho + 1.0 / rho), square, 2.0 * twelfth / (rho - 1.0)]
}

/// Half of the least degree, and how many degrees are tried, each greater by 2.
const HALF_DEGREE: usize = 6;
const DEGREES: usize = 7;

/// More than the 181 roundings of an `f32` that make a bound too small at most.
// proofs/certificate.py
const SLACK: f32 = 1.0 + 1.0 / (1 << 16) as f32;

/// The products of the error with cubics: 1 first, which is the error itself.
pub(crate) const KINDS: usize = 3;

/// The greatest errors: what they are at least, by the samples, and at most.
pub(crate) struct Errors {
    pub(crate) least: [f32; KINDS],
    pub(crate) most: [f32; KINDS],
}

/// The errors of an octave's polynomial along a stretch, whose fraction counts as a position does, and whose time in
/// the unit of the coefficients. Samples are wrong by at most `noise`. For the tails, `x` has the coefficients of the
/// offset by powers of `s`, in single precision.
#[inline(never)]
pub(crate) const fn errors(
    octave: &Octave,
    along: &Path,
    x: &[f32; 7],
    weights: &[[f32; 4]; KINDS],
    noise: f32,
    effort: usize,
) -> Errors {
    let (points, cosine) = POINTS[effort % EFFORTS];
    // Each cosine follows from the two before it. Those of π/N times half a degree are what bounds divide by.
    let (mut seen, mut shares) = ([0.0; KINDS], [0.0; DEGREES]);
    let (mut s, mut last, mut i) = (1.0, cosine, 0);
    while i <= points {
        let position = nearest(value(&along.fraction, s));
        let rest = octave.polynomial(octave.ahead_of_center(position));
        let error = (rest as f64 - value(&along.time, s)).abs() as f32;
        let mut kind = KINDS;
        loop {
            kind = unknown(kind).wrapping_sub(1);
            if kind >= KINDS {
                break;
            }
            let error = error * single(&weights[kind], s as f32).abs();
            // A NaN stays, and is refused.
            seen[kind] = if error > seen[kind] || error.is_nan() { error } else { seen[kind] };
        }
        let half = i.wrapping_sub(HALF_DEGREE);
        if half < DEGREES {
            shares[half] = s as f32;
        }
        (s, last) = (2.0 * cosine * s - last, s);
        i += 1;
    }
    let (mut errors, mut kind) = (Errors { least: seen, most: seen }, KINDS);
    loop {
        kind = unknown(kind).wrapping_sub(1);
        if kind >= KINDS {
            return errors;
        }
        let noise = noise * absolute(&weights[kind], 1.0);
        errors.least[kind] -= noise;
        errors.most[kind] = bound(octave, x, &weights[kind], SLACK * (seen[kind] + noise), &shares);
    }
}

/// The bound that follows from the greatest sample, by the best ellipse and degree.
#[inline(never)]
const fn bound(
    octave: &Octave,
    x: &[f32; 7],
    weight: &[f32; 4],
    seen: f32,
    shares: &[f32; DEGREES],
) -> f32 {
    let (mut least, mut i) = (f32::INFINITY, 0);
    while i < ELLIPSES.len() {
        let [axis, square, first] = ELLIPSES[i];
        let mut tail = SLACK * first * bends(octave, x, axis) * absolute(weight, axis);
        let mut half = 0;
        // A share of 0 or less is that of no degree below the number of points.
        while half < DEGREES && shares[half] > 0.0 {
            let bound = (seen + tail) / shares[half] + tail;
            least = if bound < least { bound } else { least };
            tail *= square;
            half = unknown(half + 1);
        }
        i = unknown(i + 1);
    }
    least
}

/// `Σ |c_k| (Y^k - Y₁^k)`: how far `Q(x)` may be from `Q(x₀ + x₁ s)` on an ellipse, but for the term `c₁ x`.
#[inline(never)]
const fn bends(octave: &Octave, [x0, x1, curved @ ..]: &[f32; 7], axis: f32) -> f32 {
    let linear = x0.abs() + x1.abs() * axis;
    let curve = absolute(curved, axis) * axis * axis;
    // Y^k - Y₁^k = Y (Y^(k-1) - Y₁^(k-1)) + (Y - Y₁) Y₁^(k-1), without a difference; from c[6], that of x², down.
    let (mut power, mut more, mut sum, mut k) = (linear, curve, 0.0, DEGREE - 1);
    loop {
        k = unknown(k).wrapping_sub(1);
        if k >= DEGREE {
            return sum;
        }
        more = (linear + curve) * more + curve * power;
        power *= linear;
        sum += octave.c[k].unsigned_abs() as f32 * more;
    }
}

/// The nearest integer, nearly, in 32 bits, which wraps as positions do.
const fn nearest(x: f64) -> i32 {
    (if x < 0.0 { x - 0.5 } else { x + 0.5 }) as i64 as i32
}

/// The value at `x` of a cubic by its coefficients, from the constant one up.
const fn single(&[c0, c1, c2, c3]: &[f32; 4], x: f32) -> f32 {
    c0 + x * (c1 + x * (c2 + x * c3))
}
