//! The greatest error of a polynomial on a stretch, bounded from samples.
//!
//! On the stretch, `s` runs from -1 to 1. The error in time, `R(s) = Q(x(s)) - t(s)`, by the octave's polynomial `Q`
//! and the offset `x`, is sampled at the N + 1 points `cos(k π / N)`. `R` times a weight has degree 8 · 6 + 3 = 51, and
//! a polynomial of degree `n < N` is nowhere greater than its greatest sample over `cos(n π / 2N)` (Ehlich and Zeller
//! 1964).

use crate::fixed::{WORD, fixed_towards_0};
use crate::octave::Octave;
use crate::octave::path::absolute;

/// N, and `cos(π / N)`.
const POINTS: usize = 192;
const COSINE: f64 = 0.9998661379095618;

/// At first every second point is sampled, as if N were 96; then all, if that is not enough.
pub(crate) const FIRST_STRIDE: usize = 2;

/// `cos(i π / N)` for `i` from 0 to N / 2, each from the two before it. They count 2⁻³⁰ (`proofs/certificate.py`).
const COSINES: &[i32; POINTS / 2 + 1] = &{
    let (mut cosines, mut cosine, mut last, mut i) = ([0; POINTS / 2 + 1], 1.0, COSINE, 0);
    while i < cosines.len() {
        cosines[i] = (cosine * ONE as f64 + 0.5) as i32;
        (cosine, last) = (2.0 * COSINE * cosine - last, cosine);
        i += 1;
    }
    cosines
};
/// `s = 1`, where `s` counts 2⁻³⁰.
const ONE: f32 = (1 << 30) as f32;

/// `1 / cos(51 π stride / 2N)`, by the stride, 1 or 2.
// proofs/certificate.py
const FACTOR: [f32; 4] = [0.0, 1.093_840_8, 1.489_072_6, 0.0];

/// More than what may make a bound too small: roundings of an `f32`, and samples off their points.
// proofs/certificate.py
const SLACK: f32 = 1.0 + 1.0 / (1 << 16) as f32;

/// The number of kinds of errors along a stretch. Each is `R` times a *weight*, a cubic of `s`: the error in time,
/// whose weight is 1; and that in exposure, by the openness.
pub(crate) const KINDS: usize = 2;

/// A sample's position counts 2⁻²⁰ of a position, its time 2⁻²⁴ of a step.
pub(crate) const POSITION_BITS: i32 = 20;
pub(crate) const TIME_BITS: i32 = 24;
/// What a sample's time loses at most, by three products and four numbers that are cut (`proofs/certificate.py`).
pub(crate) const SAMPLE_OFF: f32 = 7.0 / (1 << TIME_BITS) as f32;

/// Counts coefficients in units of `2^-bits`: where doubles are emulated, integers take a tenth of their time. Are all
/// below 2⁶⁰ units, so that no value on the stretch is beyond 2⁶³? A NaN is not.
#[inline(never)]
pub(crate) const fn count(c: &[f64], bits: i32, counted: &mut [i64]) -> bool {
    let (mut are_counted, mut k) = (true, 0);
    while k < c.len() && k < counted.len() {
        counted[k] = fixed_towards_0(c[k], -bits);
        are_counted &= counted[k].unsigned_abs() >> 60 == 0;
        k += 1;
    }
    are_counted
}

/// The value, in the coefficients' unit, at `s`, which counts 2⁻³⁰. Each product is rounded down; as |s| <= 1, a loss
/// does not grow.
#[inline(never)]
pub(crate) const fn at(c: &[i64], s: i32) -> i64 {
    let (mut value, mut c) = (0, c);
    while let [lower @ .., next] = c {
        // By words: the product has 93 bits.
        let (high, low) = (value >> 32, value & 0xFFFF_FFFF);
        value = 4 * (high * s as i64) + ((low * s as i64) >> 30) + *next;
        c = lower;
    }
    value
}

/// A lower and an upper bound of the greatest error of each kind along a stretch, by every `stride`-th point: of the
/// error in time in steps, of that in exposure over its limit. `position` and `time` are counted. Samples are off by at
/// most `noise` steps.
#[inline(never)]
pub(crate) const fn errors(
    octave: &Octave,
    position: &[i64; 7],
    time: &[i64; 4],
    weights: &[[f32; 4]; KINDS],
    noise: f32,
    stride: usize,
) -> ([f32; KINDS], [f32; KINDS]) {
    let (mut seen, mut i) = ([0.0; KINDS], 0);
    while i < COSINES.len() {
        let mut s = COSINES[i];
        // At the cosine and at its negative.
        loop {
            // The nearest position; it wraps.
            let half = 1 << (POSITION_BITS - 1);
            let nearest = ((at(position, s) + half) >> POSITION_BITS) as i32;
            let value = octave.polynomial(octave.offset(nearest));
            let error = (((value as i64) << TIME_BITS) - at(time, s)).unsigned_abs();
            // By words: converting a `u64` is a slow call on a small processor.
            let error = (error >> 32) as u32 as f32 * WORD + error as u32 as f32;
            let error = error / (1 << TIME_BITS) as f32;
            let mut kind = 0;
            while kind < KINDS {
                let error = error * single(&weights[kind], s as f32 / ONE).abs();
                // A NaN stays, and is refused.
                seen[kind] = if error > seen[kind] || error.is_nan() { error } else { seen[kind] };
                kind += 1;
            }
            if s <= 0 {
                break;
            }
            s = -s;
        }
        i += stride;
    }
    let (mut least, mut most, mut kind) = (seen, seen, 0);
    while kind < KINDS {
        let noise = noise * absolute(&weights[kind], 1.0);
        least[kind] -= noise;
        most[kind] = SLACK * (seen[kind] + noise) * FACTOR[stride & 3];
        kind += 1;
    }
    (least, most)
}

/// `Σ c[k] x^k`
const fn single(&[c0, c1, c2, c3]: &[f32; 4], x: f32) -> f32 {
    c0 + x * (c1 + x * (c2 + x * c3))
}
