//! The greatest error of a polynomial on a stretch, bounded from samples (docs/internals/proofs.md, "An octave's
//! certificate", 1 to 4).
//!
//! On the stretch, `s` runs from -1 to 1. The error in time, `R(s) = Q(x(s)) - t(s)`, by the octave's polynomial `Q`
//! and the offset `x`, is sampled at the N + 1 points `cos(k π / N)`. For each degree `n < N`,
//!
//! `|R| <= (greatest sample + tail) / cos(n π / 2N) + tail`,
//!
//! where the *tail* is what `R` has above degree `n`, bounded on an ellipse around [-1, 1] ([`off_line`]).

use crate::number::units::{WORD, fixed_f64};
use crate::octave::Octave;
use crate::octave::path::{Path, absolute};

/// The greatest N, and `cos(π / N)`.
const POINTS: usize = 96;
const COSINE: f64 = 0.9994645874763657;

/// At first every fourth point is sampled; then every second, then all, if that is not enough.
pub(crate) const FIRST_STRIDE: usize = 4;

/// `cos(i π / 96)` for `i` from 0 to 48, each from the two before it. They count 2⁻³⁰ (`proofs/certificate.py`).
const COSINES: &[i32; POINTS / 2 + 1] = &{
    let (mut cosines, mut cosine, mut last, mut i) = ([0; POINTS / 2 + 1], 1.0, COSINE, 0);
    while i < cosines.len() {
        cosines[i] = (cosine * PLACE as f64 + 0.5) as i32;
        (cosine, last) = (2.0 * COSINE * cosine - last, cosine);
        i += 1;
    }
    cosines
};
/// `s = 1` as a place. (In this file a place is the `s` of a sample, in 2⁻³⁰, not a parameter of the Bezier.)
const PLACE: f32 = (1 << 30) as f32;

/// An ellipse around [-1, 1], with half axes `(ρ ± 1/ρ) / 2`.
struct Ellipse {
    /// The greater one.
    axis: f32,
    /// The tail for degree 12 and a bound of 1.
    tail: f32,
    /// A tail's factor for two degrees more.
    square: f32,
}

/// Found by trial, as the degrees: any would do.
const ELLIPSES: [Ellipse; 6] =
    [ellipse(2.5), ellipse(3.0), ellipse(3.5), ellipse(4.0), ellipse(5.0), ellipse(7.0)];

const fn ellipse(rho: f32) -> Ellipse {
    let square = 1.0 / (rho * rho);
    let twelfth = square * square * square * square * square * square;
    Ellipse { axis: 0.5 * (rho + 1.0 / rho), tail: 2.0 * twelfth / (rho - 1.0), square }
}

/// Half of the least degree, and the number of degrees, two apart.
const HALF_DEGREE: usize = 6;
const DEGREES: usize = 7;

/// More than what may make a bound too small: 181 roundings of an `f32`, and 27 more for samples off their points.
// proofs/certificate.py
const SLACK: f32 = 1.0 + 1.0 / (1 << 16) as f32;

/// The number of errors along a stretch. Each is `R` times a *weight*, a cubic of `s`: the error in time, whose weight
/// is 1; that in exposure, by the openness; and that relative to the time, by a bound of 1 / size.
pub(crate) const KINDS: usize = 3;

/// A sample's fraction counts 2⁻²⁰ of a position, its time 2⁻²⁴ of the coefficients' unit.
const FRACTION_BITS: i32 = 20;
const TIME_BITS: i32 = 24;
/// What a sample's time loses at most, by three products and four numbers that are cut (`proofs/certificate.py`).
pub(crate) const SAMPLE_OFF: f32 = 7.0 / (1 << TIME_BITS) as f32;

/// A stretch in integers, which take a tenth of the time where doubles are emulated.
pub(crate) struct Sampled {
    fraction: [i64; 7],
    time: [i64; 4],
}

impl Sampled {
    /// Of a stretch as a certificate has it. None for a NaN, and for numbers greater than those of any served stretch.
    pub(crate) const fn new(along: &Path) -> Option<Self> {
        let (mut fraction, mut time) = ([0; 7], [0; 4]);
        let is_sampled = count(&along.fraction, FRACTION_BITS, &mut fraction)
            & count(&along.time, TIME_BITS, &mut time);
        if is_sampled { Some(Self { fraction, time }) } else { None }
    }
}

/// Counts coefficients in units of `2^-bits`. Are all below 2⁶⁰ units, so that no value on the stretch is beyond 2⁶³?
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

/// The value at a place, in 2⁻³⁰. Each product is rounded down; as |place| <= 1, a loss does not grow.
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

/// A lower and an upper bound of the greatest error of each kind along a stretch, by every `stride`-th point; in the
/// unit of the coefficients. `x` is the offset in widths. Samples are off by at most `noise`.
#[inline(never)]
pub(crate) const fn errors(
    octave: &Octave,
    along: &Sampled,
    x: &[f32; 7],
    weights: &[[f32; 4]; KINDS],
    noise: f32,
    stride: usize,
) -> ([f32; KINDS], [f32; KINDS]) {
    let (mut seen, mut i) = ([0.0; KINDS], 0);
    while i < COSINES.len() {
        let mut place = COSINES[i];
        // At the cosine and at its negative.
        loop {
            // The nearest position; it wraps.
            let half = 1 << (FRACTION_BITS - 1);
            let position = ((at(&along.fraction, place) + half) >> FRACTION_BITS) as i32;
            let value = octave.polynomial(octave.offset(position));
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
        i += stride;
    }
    let (mut tails, mut i) = ([0.0; ELLIPSES.len()], 0);
    while i < ELLIPSES.len() {
        let Ellipse { axis, tail, .. } = ELLIPSES[i];
        tails[i] = SLACK * tail * off_line(octave, x, axis);
        i += 1;
    }
    let (mut least, mut most, mut kind) = (seen, seen, 0);
    while kind < KINDS {
        let noise = noise * absolute(&weights[kind], 1.0);
        least[kind] -= noise;
        most[kind] = bound(SLACK * (seen[kind] + noise), &tails, &weights[kind], stride);
        kind += 1;
    }
    (least, most)
}

/// The bound that follows from the greatest sample `seen`, of every `stride`-th point, by the best ellipse and degree.
#[inline(never)]
const fn bound(seen: f32, tails: &[f32; ELLIPSES.len()], weight: &[f32; 4], stride: usize) -> f32 {
    let (mut least, mut i) = (f32::INFINITY, 0);
    while i < ELLIPSES.len() {
        let Ellipse { axis, square, .. } = ELLIPSES[i];
        let mut tail = tails[i] * absolute(weight, axis);
        let (mut last, mut k, mut degrees) = (f32::INFINITY, HALF_DEGREE * stride, DEGREES);
        while degrees > 0 && k < COSINES.len() {
            // COSINES[k] is cos(n π / 2N) for N = 96 / stride, n = 2 k / stride; 0, and no bound, for n = N.
            let bound = (seen + tail) * PLACE / COSINES[k] as f32 + tail;
            // The bound is convex in `n`: once it does not fall, no further one is less.
            degrees = if bound < last { degrees - 1 } else { 0 };
            least = if bound < least { bound } else { least };
            (last, tail) = (bound, tail * square);
            k += stride;
        }
        i += 1;
    }
    least
}

/// `Σ |c_k| (Y^k - Y₁^k)` from `k = 2` on, where `Y₁ = |x₀| + |x₁| B` and `Y = Y₁ + Σ |x_k| B^k`, with the `axis` as
/// `B`. On the ellipse, `R` is within this of a polynomial of a degree below 12.
#[inline(never)]
const fn off_line(octave: &Octave, [x0, x1, curved @ ..]: &[f32; 7], axis: f32) -> f32 {
    let linear = x0.abs() + x1.abs() * axis;
    let curve = absolute(curved, axis) * axis * axis;
    // Y^k - Y₁^k = Y (Y^(k-1) - Y₁^(k-1)) + (Y - Y₁) Y₁^(k-1), from k = 2 up.
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

/// `Σ c[k] x^k`
const fn single(&[c0, c1, c2, c3]: &[f32; 4], x: f32) -> f32 {
    c0 + x * (c1 + x * (c2 + x * c3))
}
