//! The greatest error of a polynomial on a stretch, bounded from samples.
//!
//! On the stretch, `s` runs from -1 to 1. The error in time, `R(s) = P(x(s)) - t(s)`, by the octave's polynomial `P`
//! and the offset `x`, both in lsb since its middle, is sampled at the N + 1 points `cos(k π / N)`. `R` times the
//! openness has degree 8 · 6 + 3 = 51, and a polynomial of degree `n < N` is nowhere greater than its greatest sample
//! over `cos(n π / 2N)` (Ehlich and Zeller 1964).

use crate::fixed::{WORD, fixed_towards_0};
use crate::octave::Octave;

/// N, where the points are N + 1, and `cos(π / N)`.
const POINTS: usize = 192;
const COSINE: f64 = 0.9998661379095618;
/// `1 / cos(51 π / 2N)` for all points, and for every second one, which is as if N were 96.
// proofs/certificate.py
const FACTOR_OF_ALL: f32 = 1.093_840_8;
const FACTOR_OF_HALF: f32 = 1.489_072_6;

/// `cos(i π / N)` for `i` from 0 to N / 2, each from the two before it. They count 2⁻³⁰ (`proofs/certificate.py`).
const COSINES: &[i32; POINTS / 2 + 1] = &{
    let (mut cosines, mut cosine, mut last, mut i) = ([0; POINTS / 2 + 1], 1.0, COSINE, 0);
    while i < cosines.len() {
        cosines[i] = (cosine * S_ONE as f64 + 0.5) as i32;
        (cosine, last) = (2.0 * COSINE * cosine - last, cosine);
        i += 1;
    }
    cosines
};
/// `s = 1`, where `s` counts 2⁻³⁰.
const S_ONE: f32 = (1 << 30) as f32;

/// A sample's position counts 2⁻²⁰ of a position's unit, its time 2⁻²⁴ of an lsb.
pub(crate) const POSITION_BITS: i32 = 20;
pub(crate) const TIME_BITS: i32 = 24;
/// What a sample's time loses at most, by three products and four numbers that are cut (`proofs/certificate.py`).
pub(crate) const SAMPLE_OFF: f32 = 7.0 / (1 << TIME_BITS) as f32;

/// Writes coefficients in units of `2^-bits`: where doubles are emulated, integers take a tenth of their time. Are all
/// below 2⁶⁰ units, so that no value on the stretch is beyond 2⁶³? A NaN is not.
#[inline(never)]
pub(crate) const fn to_fixed(c: &[f64], bits: i32, fixed: &mut [i64]) -> bool {
    let (mut fit, mut k) = (true, 0);
    while k < c.len() && k < fixed.len() {
        fixed[k] = fixed_towards_0(c[k], -bits);
        fit &= fixed[k].unsigned_abs() >> 60 == 0;
        k += 1;
    }
    fit
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

/// Upper bounds of `|R|`, in lsb, and of `|R|` times a cubic of `s`, the certificate's weight: by all points, or by
/// every second one. A `noise` is what samples of either may be off by; of a weight of NaN it is NaN, and so the bound.
/// `position` and `time` are in fixed point.
#[inline(never)]
pub(crate) const fn errors(
    octave: &Octave,
    position: &[i64; 7],
    time: &[i64; 4],
    openness: &[f32; 4],
    noise: [f32; 2],
    all: bool,
) -> (f32, f32) {
    let (mut in_time, mut in_exposure, mut i) = (0.0, 0.0, 0);
    while i <= POINTS {
        let s = if i <= POINTS / 2 { COSINES[i] } else { -COSINES[POINTS - i] };
        // The nearest position; it wraps.
        let half = 1 << (POSITION_BITS - 1);
        let nearest = ((at(position, s) + half) >> POSITION_BITS) as i32;
        let value = octave.polynomial(octave.offset(nearest));
        let error = (((value as i64) << TIME_BITS) - at(time, s)).unsigned_abs();
        // By words: converting a `u64` is a slow call on a small processor.
        let error = (error >> 32) as u32 as f32 * WORD + error as u32 as f32;
        let error = error / (1 << TIME_BITS) as f32;
        let [f0, f1, f2, f3] = *openness;
        let s = s as f32 / S_ONE;
        let weighted = error * (f0 + s * (f1 + s * (f2 + s * f3))).abs();
        in_time = if error > in_time { error } else { in_time };
        in_exposure = if weighted > in_exposure { weighted } else { in_exposure };
        i += if all { 1 } else { 2 };
    }
    let factor = if all { FACTOR_OF_ALL } else { FACTOR_OF_HALF };
    ((in_time + noise[0]) * factor, (in_exposure + noise[1]) * factor)
}
