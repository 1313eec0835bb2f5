//! The certificate of an octave: bounds of its polynomial's errors, on every `a` that it serves.
//!
//! The error in time is bounded from samples ([`bound`](crate::octave::bound)), and so is that error times the openness
//! over the area, the error in exposure. With what rounding adds, both are held against their limits.

use crate::fixed::{exponent, floor_bits, power_of_two};
use crate::octave::bound::{POSITION_BITS, SAMPLE_OFF, TIME_BITS, errors, to_fixed};
use crate::octave::candidate::Candidate;
use crate::octave::path::{Path, Stretch, absolute, scale, singles, value};

/// Below 0.19 ulp of a time; in an interval of 2²⁴ ticks below 0.19 tick (see [`Path::size_of_time`]).
pub(crate) const FORWARD_ERROR: f32 = 1.5 / (1u32 << 27) as f32;
/// An error below 1/2 keeps the times of neighbouring `u` in order, also from one octave to the next: neighbours are at
/// least an ulp of the lesser one apart.
pub(crate) const ULP_ERROR: f32 = 0.49;

/// How far off a fraction may be in a look-up, since joins are rounded. A share has three roundings of an `f64`, two
/// of the area and one of the quotient; they count most for a ramp with nearly all of the exposure.
// proofs/certificate.py
pub(crate) const JOIN_OFF: f32 = 3.0 / (1u64 << 53) as f32;
/// How far off a fraction may be on a path, as a share of it: it is a sum of terms up to 512 times as great, with 60
/// roundings of an `f64`.
// proofs/certificate.py
pub(crate) const FRACTION_OFF: f32 = 1.0 / (1u64 << 36) as f32;
/// The greatest offset, in widths. A word ends at 1/2; the rest is for what single precision rounds.
// proofs/octaves.py
const MOST_OFFSET: f32 = 0.4999;
/// How far off a time may be on a path, as a share of it: it is a sum of terms up to 14 times as great
/// (`proofs/domain.py`), with 9 roundings of an `f64`, counted on paper.
const TIME_OFF: f32 = 1.0 / (1u64 << 46) as f32;

/// By how much rounding changes the openness at a sample, as a share of its coefficients without signs.
// proofs/certificate.py
const WEIGHT_OFF: f32 = 1.0 / (1 << 18) as f32;

/// 1, less what single precision rounds.
const CERTAIN: f32 = 1.0 - 1.0 / (1 << 16) as f32;

/// Bounds of an octave's errors, each over its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ErrorOverLimit {
    /// In time. The limit is [`FORWARD_ERROR`] of [`Path::size_of_time`].
    pub(crate) forward: f32,
    /// In exposure. The limit is [`ULP_ERROR`] ulp of where the span begins, less what fractions are off.
    pub(crate) backward: f32,
}

impl ErrorOverLimit {
    pub(crate) const REFUSED: Self = Self { forward: f32::INFINITY, backward: f32::INFINITY };

    /// Are both below 1? Written so that a NaN fails.
    pub(crate) const fn are_certain(&self) -> bool {
        self.forward <= CERTAIN && self.backward <= CERTAIN
    }
}

/// The errors of a candidate on its stretch.
#[inline(never)]
pub(crate) const fn certificate(path: &Path, candidate: &Candidate, stretch: &Stretch) -> ErrorOverLimit {
    let Candidate { ref octave, middle_time, lsb, slope_bound_lsb, .. } = *candidate;
    let mut time_lsb = stretch.time;
    time_lsb[0] -= middle_time;
    scale(&mut time_lsb, 1.0 / lsb, 1.0);
    let per_lsb = PerLsb::new(path, candidate, stretch, &time_lsb);
    let (center, per_position) = stretch.span.offsets();
    // An offset beyond its word would wrap. It is greatest at an end.
    let [x0, x1, x2, x3, x4, x5, x6] = singles(&stretch.position, center, per_position);
    if (x0 + x2 + x4 + x6).abs() + (x1 + x3 + x5).abs() >= MOST_OFFSET {
        return ErrorOverLimit::REFUSED;
    }
    let (mut position, mut time) = ([0; 7], [0; 4]);
    if !(to_fixed(&stretch.position, POSITION_BITS, &mut position) & to_fixed(&time_lsb, TIME_BITS, &mut time)) {
        return ErrorOverLimit::REFUSED;
    }
    // Rounding counts twice: a sample has its own, and so has the answer, in `bounds`. A sample's position is rounded
    // by 1/2 and a trace.
    let noise = per_lsb.rounding_lsb + 0.5002 * slope_bound_lsb * per_position as f32;
    // Half of the points are mostly enough.
    let half = per_lsb.bounds(errors(octave, &position, &time, &per_lsb.backward, noise, false));
    if half.are_certain() {
        return half;
    }
    per_lsb.bounds(errors(octave, &position, &time, &per_lsb.backward, noise, true))
}

/// What an error in time of one lsb comes to, over the limits of [`ErrorOverLimit`], and what [`bounds`](Self::bounds)
/// needs besides. Arrays are polynomials of `s` along a stretch.
struct PerLsb {
    forward: f32,
    /// On the ramp.
    backward: [f32; 4],
    /// Where the gap from the exact time to the polynomial's lies beyond the ramp's join or crosses it: as if all of it
    /// were at openness 1. 0 if the stretch does not reach the join, or the curve ends there.
    backward_beyond: f32,
    /// What rounding adds to an error in time, in lsb.
    rounding_lsb: f32,
    /// The time along the stretch, in lsb.
    time_lsb: [f32; 4],
}

impl PerLsb {
    #[inline(never)]
    const fn new(path: &Path, candidate: &Candidate, stretch: &Stretch, time_lsb: &[f64; 4]) -> Self {
        let Candidate { lsb, slope_bound_lsb, truncation_lsb, .. } = *candidate;
        let (exposure, span) = (path.exposure, &stretch.span);
        let ends = [value(&stretch.time, -1.0), value(&stretch.time, 1.0)];
        let fraction_off = JOIN_OFF + FRACTION_OFF * span.to;
        // No span begins below LEAST_TOP / 2, so the limit is above 0 (proofs/certificate.py).
        let ulp = power_of_two(exponent(f32::from_bits(floor_bits(span.from))) - 23);
        let backward = lsb * exposure.per_area / (ULP_ERROR * ulp - fraction_off) as f64;
        let [f0, f1, f2, f3, ..] = singles(&stretch.openness, 0.0, backward);
        let [t0, t1, t2, t3, ..] = singles(time_lsb, 0.0, 1.0);
        // The least size is that of an end.
        let [first, last] = [path.size_of_time(ends[0]), path.size_of_time(ends[1])];
        let size = if first < last { first } else { last };
        let goes_on = exposure.join_time(path.ramp) != exposure.end_time(path.ramp.other());
        Self {
            forward: lsb as f32 / size / FORWARD_ERROR,
            backward: [f0, f1, f2, f3],
            backward_beyond: if stretch.is_joined && goes_on { backward as f32 } else { 0.0 },
            rounding_lsb: truncation_lsb
                + SAMPLE_OFF
                + slope_bound_lsb * fraction_off / span.width
                + (ends[1] / lsb) as f32 * TIME_OFF,
            time_lsb: [t0, t1, t2, t3],
        }
    }

    /// The bounds that follow from the greatest errors, in time, and in exposure at each place.
    ///
    /// The error in exposure is the integral of the openness from the exact time to the polynomial's, and on that way
    /// it may be greater than at the place itself.
    #[inline(never)]
    const fn bounds(&self, (time_error, exposure_error): (f32, f32)) -> ErrorOverLimit {
        let error = time_error + self.rounding_lsb;
        let rounding = self.rounding_lsb + error * WEIGHT_OFF;
        // most >= t' >= slowest: the least of `t' = t1 + 2 t2 s + 3 t3 s²` is at its vertex, if that is inside, or at
        // an end.
        let [_, t1, t2, t3] = self.time_lsb;
        let (thrice, most) = (3.0 * t3, t1.abs() + 2.0 * t2.abs() + 3.0 * t3.abs());
        let slowest = if thrice > t2.abs() { t1 - t2 * t2 / thrice } else { t1 + thrice - 2.0 * t2.abs() };
        let slowest = slowest - most / (1 << 20) as f32;
        // Along a way `d` of `s` time grows by `d slowest` at least. It also grows by `t3 d³ / 4`, as `t'` is a
        // parabola that is nowhere negative, and 3 t3 its highest coefficient. So along `way` it grows by `error`, or
        // `way` is the whole stretch, 2. From the exact time to the polynomial's, `s` does not leave the stretch: up
        // to its end there are two ulp of exposure ([`Span::half`]), and an accepted bound is below half of one.
        let mut way = error / most;
        while way < 2.0 && way * slowest < error && way * way * way * t3 < 4.0 * error {
            way *= 2.0;
        }
        // |f'| <= steepest, so on the way the openness grows by `way steepest` at most.
        let [_, f1, f2, f3] = self.backward;
        let steepest = f1.abs() + 2.0 * f2.abs() + 3.0 * f3.abs();
        let on_ramp = exposure_error + rounding * absolute(&self.backward, 1.0) + error * way * steepest;
        let beyond = error * self.backward_beyond;
        ErrorOverLimit { forward: error * self.forward, backward: if beyond > on_ramp { beyond } else { on_ramp } }
    }
}
