//! The certificate of an octave: bounds of its polynomial's errors, on every `a` that it serves.
//!
//! An answer errs in time; and in exposure, by the light between the exact time and its own. Both errors are bounded
//! from samples ([`bound`](crate::octave::bound)), with what rounding adds, and held against their limits.
//!
//! Along the stretch, `s` runs from -1 to 1. Times are in *lsb*, the unit of the octave's coefficients ([`Candidate`]).

use crate::fixed::{exponent, floor_bits, power_of_two};
use crate::octave::bound::{POSITION_BITS, SAMPLE_OFF, TIME_BITS, errors, to_fixed};
use crate::octave::candidate::Candidate;
use crate::octave::path::{Path, Stretch, scale, singles, value};

/// As a share of [`Path::size_of_time`]: below 0.19 ulp of a time; in an interval of 2²⁴ ticks below 0.19 tick.
pub(crate) const FORWARD_ERROR: f32 = 1.5 / (1u32 << 27) as f32;
/// An error below 1/2 keeps the times of neighbouring `u` in order, also from one octave to the next: neighbours are at
/// least an ulp of the lesser one apart.
pub(crate) const ULP_ERROR: f32 = 0.49;

/// How far off the fraction of a join may be, from which a far path counts and up to which a ramp is looked up: three
/// roundings of an `f64`, two of the area and one of the quotient; most if the far ramp has nearly all.
// proofs/certificate.py
pub(crate) const JOIN_OFF: f32 = 3.0 / (1u64 << 53) as f32;
/// How far off a fraction may be on a path, as a share of it: it is a sum of terms up to 512 times as great, with 60
/// roundings of an `f64`, counted on paper.
// proofs/certificate.py
pub(crate) const FRACTION_OFF: f32 = 1.0 / (1u64 << 36) as f32;
/// The greatest offset, in widths. A word ends at 1/2; the rest is for what single precision rounds.
// proofs/octaves.py
const MOST_OFFSET: f32 = 0.4999;
/// How far off a time may be on a path, as a share of it: it is a sum of terms up to 14 times as great
/// (`proofs/domain.py`), with 9 roundings of an `f64`, counted on paper.
const TIME_OFF: f32 = 1.0 / (1u64 << 46) as f32;

/// The least `run` that is tried. A quarter of it is more than what rounds the openness at a sample.
// proofs/certificate.py
const LEAST_RUN: f32 = 1.0 / (1 << 19) as f32;

/// Bounds of an octave's errors, each divided by its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ErrorOverLimit {
    /// In time. The limit is [`FORWARD_ERROR`] of [`Path::size_of_time`].
    pub(crate) forward: f32,
    /// In exposure. The limit is [`ULP_ERROR`] ulp of where the span begins.
    pub(crate) backward: f32,
}

impl ErrorOverLimit {
    pub(crate) const REFUSED: Self = Self { forward: f32::INFINITY, backward: f32::INFINITY };

    /// Are both at most 1? Single precision may make them too small by 2⁻¹⁶, for which the limits have room
    /// (proofs/certificate.py). Written so that a NaN fails.
    pub(crate) const fn are_certain(&self) -> bool {
        self.forward <= 1.0 && self.backward <= 1.0
    }
}

/// The errors of a candidate on its stretch.
#[inline(never)]
pub(crate) const fn certificate(path: &Path, candidate: &Candidate, stretch: &Stretch) -> ErrorOverLimit {
    let Candidate { ref octave, middle_time, lsb, slope_bound_lsb, truncation_lsb } = *candidate;
    let (curve, span) = (path.curve, &stretch.span);

    // An offset beyond its word would wrap. It is greatest at an end.
    let (center, per_position) = span.offsets();
    let [x0, x1, x2, x3, x4, x5, x6] = singles(&stretch.position, center, per_position);
    let most_offset = (x0 + x2 + x4 + x6).abs() + (x1 + x3 + x5).abs();
    // What is sampled.
    let mut time_lsb = stretch.time;
    time_lsb[0] -= middle_time;
    scale(&mut time_lsb, 1.0 / lsb, 1.0);
    let (mut position, mut time) = ([0; 7], [0; 4]);
    let fit = to_fixed(&stretch.position, POSITION_BITS, &mut position) & to_fixed(&time_lsb, TIME_BITS, &mut time);
    if !fit || most_offset >= MOST_OFFSET {
        return ErrorOverLimit::REFUSED;
    }

    // `rounding` is what rounding adds to an answer's error in time: Horner's rule, the side's end, and what the path
    // is off by. `noise` is what a sample may be off by: Horner's rule, as it is a rounded answer, too; SAMPLE_OFF; and
    // half a position and 13 · 2⁻²⁰, with a margin (proofs/certificate.py). Both in lsb.
    let ends = [value(&stretch.time, -1.0), value(&stretch.time, 1.0)];
    let fraction_off = JOIN_OFF + FRACTION_OFF * span.to;
    let path_off = slope_bound_lsb * fraction_off / span.width + (ends[1] / lsb) as f32 * TIME_OFF;
    let rounding = truncation_lsb + path_off;
    let noise = truncation_lsb + SAMPLE_OFF + 0.5002 * slope_bound_lsb * per_position as f32;

    // What an error of one lsb comes to, over the limits. In time: the least size is that of an end.
    let [first, last] = [path.size_of_time(ends[0]), path.size_of_time(ends[1])];
    let size = if first < last { first } else { last };
    let forward_per_lsb = lsb as f32 / size / FORWARD_ERROR;
    // In exposure: fully open it is `open_per_lsb`, and at an `s` the openness times that, the *weight*.
    let limit = ULP_ERROR * power_of_two(exponent(f32::from_bits(floor_bits(span.from))) - 23);
    let open_per_lsb = lsb * curve.per_area / limit as f64;
    let [f0, f1, f2, f3, ..] = singles(&stretch.openness, 0.0, open_per_lsb);
    let most_weight = f3.abs() + f2.abs() + f1.abs() + f0.abs();
    // |f'| <= steepest
    let steepest = f1.abs() + 2.0 * f2.abs() + 3.0 * f3.abs();
    // Beyond the join the shutter may be fully open.
    let goes_on = curve.join_time(path.ramp) != curve.end_time(path.ramp.other());

    // In lsb for a unit of `s`, t' >= slowest: the least of `t' = t1 + 2 t2 s + 3 t3 s²` is at its vertex, if that is
    // inside, or at an end.
    let [_, t1, t2, t3] = time_lsb;
    let thrice = 3.0 * t3;
    let slowest = if thrice > t2.abs() { t1 - t2 * t2 / thrice } else { t1 + thrice - 2.0 * t2.abs() };
    let (slowest, t3) = (slowest as f32, t3 as f32);

    // Half of the points are mostly enough.
    let mut all = false;
    loop {
        let (time_error, exposure_error) =
            errors(octave, &position, &time, &[f0, f1, f2, f3], [noise, noise * most_weight], all);
        let error = time_error + rounding;
        // From the exact time to the answer's, `s` moves by at most `run`: so far that time grows by `error`, or by the
        // whole stretch, 2. Time grows by at least `run slowest`. It also grows by at least `run³ t3 / 4`: about the
        // middle m of the run it is `run t'(m) + run³ t3 / 4`, and t' >= 0 (proofs/certificate.py). One of both is
        // enough. As it doubles, `run` may be twice too long.
        let mut run = LEAST_RUN;
        while run < 2.0 && run * slowest < error && run * run * run * t3 < 4.0 * error {
            run *= 2.0;
        }
        // On the run the weight grows by `run steepest` at most. All this holds up to the stretch's end. So if the
        // bound is accepted, less than half an ulp of exposure is collected, and to that end there are more than two
        // ([`Span::half`]): `s` does not reach it, unless it is the join.
        let light = if stretch.is_joined && goes_on {
            error * open_per_lsb as f32
        } else {
            exposure_error + rounding * most_weight + error * run * steepest
        };
        let bounds = ErrorOverLimit { forward: error * forward_per_lsb, backward: light + fraction_off / limit };
        if all || bounds.are_certain() {
            return bounds;
        }
        all = true;
    }
}
