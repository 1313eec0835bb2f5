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
//! them. All else may be in `f32`, whose rounding [`SLACK`] makes up for, or in integers.
//!
//! docs/proofs.md leads from this to what an answer is off by.

use crate::number::units::{WORD, fixed_f64};
use crate::octave::Octave;
use crate::octave::path::{Path, absolute};

/// The greatest N: there is one point more. And the cosine of π/N.
const POINTS: usize = 96;
const COSINE: f64 = 0.9994645874763657;

/// A bound is tried with so many efforts, the cheapest first: with every fourth point, every second, and all.
pub(crate) const EFFORTS: usize = 3;

/// The cosines of i π/N, from 1 down to 0. Each follows from the two before it. They count 2⁻³⁰, as samples' places do.
// proofs/certificate.py
const COSINES: &[i32; POINTS / 2 + 1] = &{
    let (mut cosines, mut cosine, mut last, mut i) = ([0; POINTS / 2 + 1], 1.0, COSINE, 0);
    while i < cosines.len() {
        cosines[i] = (cosine * PLACE as f64 + 0.5) as i32;
        (cosine, last) = (2.0 * COSINE * cosine - last, cosine);
        i += 1;
    }
    cosines
};
/// The place 1.
const PLACE: f32 = (1 << 30) as f32;

/// For each ellipse `A`, `1/ρ²` and `2 ρ⁻¹² / (ρ - 1)`, where 12 is the least degree that is tried: `Q(x₀ + x₁ s) f`
/// has degree 11, so it may be taken away first. The ellipses, and the degrees below, were found by trial: any would do.
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

/// More than the 181 roundings of an `f32` that make a bound too small at most, and 27 for samples off their points.
// proofs/certificate.py
const SLACK: f32 = 1.0 + 1.0 / (1 << 16) as f32;

/// The products of the error with cubics: with 1, which is the error itself, with the openness, and with a bound of the
/// time's reciprocal.
pub(crate) const KINDS: usize = 3;

/// The greatest errors: what they are at least, by the samples, and at most.
pub(crate) struct Errors {
    pub(crate) least: [f32; KINDS],
    pub(crate) most: [f32; KINDS],
}

/// A sample's fraction counts 2⁻²⁰ of a position, and its time 2⁻²⁴ of a coefficient's 1.
const FRACTION_BITS: i32 = 20;
const TIME_BITS: i32 = 24;
/// What the time of a sample loses at most, in the unit of the coefficients, by three products and by four numbers cut.
// proofs/certificate.py
pub(crate) const SAMPLE_OFF: f32 = 7.0 / (1 << TIME_BITS) as f32;

/// A stretch as samples are taken from it: in integers, because a processor without doubles takes ten times as long for
/// those.
pub(crate) struct Sampled {
    fraction: [i64; 7],
    time: [i64; 4],
}

impl Sampled {
    /// A stretch whose fraction counts as a position does, and whose time in the unit of the coefficients. None if it
    /// has greater numbers than any that is served, or a NaN.
    pub(crate) const fn new(along: &Path) -> Option<Self> {
        let (mut fraction, mut time) = ([0; 7], [0; 4]);
        let is_sampled = count(&along.fraction, FRACTION_BITS, &mut fraction)
            & count(&along.time, TIME_BITS, &mut time);
        if is_sampled { Some(Self { fraction, time }) } else { None }
    }
}

/// Coefficients in units of `2^-bits`. Are all below 2⁶⁰ units, so that no value on the stretch is beyond 2⁶³?
#[inline(never)]
const fn count(c: &[f64], bits: i32, counted: &mut [i64]) -> bool {
    let (mut are_counted, mut k) = (true, 0);
    while k < c.len() && k < counted.len() {
        counted[k] = fixed_f64(c[k], -bits);
        are_counted &= counted[k].unsigned_abs() >> 60 == 0;
        k += 1;
    }
    are_counted
}

/// The value at a place, in 2⁻³⁰. Each step rounds down, and as no place is beyond ±1, nothing that is lost grows.
#[inline(never)]
pub(crate) const fn at(c: &[i64], place: i32) -> i64 {
    let (mut value, mut c) = (0, c);
    while let [lower @ .., next] = c {
        // By words: the product has 93 bits.
        let (high, low) = (value >> 32, value & 0xFFFF_FFFF);
        value = 4 * (high * place as i64) + ((low * place as i64) >> 30) + *next;
        c = lower;
    }
    value
}

/// The errors of an octave's polynomial along a stretch. Samples are wrong by at most `noise`. For the tails, `x` has
/// the coefficients of the offset by powers of `s`, in single precision.
#[inline(never)]
pub(crate) const fn errors(
    octave: &Octave,
    along: &Sampled,
    x: &[f32; 7],
    weights: &[[f32; 4]; KINDS],
    noise: f32,
    effort: usize,
) -> Errors {
    let (step, mut seen, mut i) = (4 >> effort, [0.0; KINDS], 0);
    while i < COSINES.len() {
        let mut place = COSINES[i];
        // At this cosine and at its negative.
        loop {
            // The nearest position, in 2⁻³² throughout, as if doubled where it has to be. It wraps as positions do.
            let half = 1 << (FRACTION_BITS - 1);
            let position = ((at(&along.fraction, place) + half) >> FRACTION_BITS) as i32;
            let value = octave.polynomial(octave.ahead_of_center(position));
            let error = (((value as i64) << TIME_BITS) - at(&along.time, place)).unsigned_abs();
            let error = (error >> 32) as u32 as f32 * WORD + error as u32 as f32;
            let error = error / (1 << TIME_BITS) as f32;
            let mut kind = 0;
            while kind < KINDS {
                let error = error * single(&weights[kind], place as f32 / PLACE).abs();
                // A NaN stays, and is refused.
                seen[kind] = if error > seen[kind] || error.is_nan() { error } else { seen[kind] };
                kind += 1;
            }
            if place <= 0 {
                break;
            }
            place = -place;
        }
        i += step;
    }
    let (mut tails, mut i) = ([0.0; ELLIPSES.len()], 0);
    while i < ELLIPSES.len() {
        let [axis, _, first] = ELLIPSES[i];
        tails[i] = SLACK * first * bends(octave, x, axis);
        i += 1;
    }
    let (mut found, mut kind) = (Errors { least: seen, most: seen }, 0);
    while kind < KINDS {
        let noise = noise * absolute(&weights[kind], 1.0);
        found.least[kind] -= noise;
        found.most[kind] = bound(SLACK * (seen[kind] + noise), &tails, &weights[kind], step);
        kind += 1;
    }
    found
}

/// The bound that follows from the greatest sample, by the best ellipse and degree.
#[inline(never)]
const fn bound(seen: f32, tails: &[f32; ELLIPSES.len()], weight: &[f32; 4], step: usize) -> f32 {
    let (mut least, mut i) = (f32::INFINITY, 0);
    while i < ELLIPSES.len() {
        let [axis, square, _] = ELLIPSES[i];
        let mut tail = tails[i] * absolute(weight, axis);
        let (mut last, mut k, mut degrees) = (f32::INFINITY, HALF_DEGREE * step, DEGREES);
        while degrees > 0 && k < COSINES.len() {
            // The cosine of π/2N times the degree: 0, and no bound, where the degree is N.
            let bound = (seen + tail) * PLACE / COSINES[k] as f32 + tail;
            // It is convex in the degree: once it is no less than the one before, so are the next ones. (A bound that is
            // too great would only refuse more.)
            degrees = if bound < last { degrees - 1 } else { 0 };
            least = if bound < least { bound } else { least };
            (last, tail) = (bound, tail * square);
            k += step;
        }
        i += 1;
    }
    least
}

/// `Σ |c_k| (Y^k - Y₁^k)`: how far `Q(x)` may be from `Q(x₀ + x₁ s)` on an ellipse, but for the term `c₁ x`.
#[inline(never)]
const fn bends(octave: &Octave, [x0, x1, curved @ ..]: &[f32; 7], axis: f32) -> f32 {
    let linear = x0.abs() + x1.abs() * axis;
    let curve = absolute(curved, axis) * axis * axis;
    // Y^k - Y₁^k = Y (Y^(k-1) - Y₁^(k-1)) + (Y - Y₁) Y₁^(k-1), without a difference; from c[6], that of x², down.
    let (mut power, mut more, mut sum) = (linear, curve, 0.0);
    let [above @ .., _] = &octave.c;
    let mut c: &[i32] = above;
    while let [higher @ .., next] = c {
        more = (linear + curve) * more + curve * power;
        power *= linear;
        sum += next.unsigned_abs() as f32 * more;
        c = higher;
    }
    sum
}

/// The value at `x` of a cubic by its coefficients, from the constant one up.
const fn single(&[c0, c1, c2, c3]: &[f32; 4], x: f32) -> f32 {
    c0 + x * (c1 + x * (c2 + x * c3))
}
