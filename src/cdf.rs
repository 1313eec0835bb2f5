//! From a time: the openness, the pdf, and the cdf.
//!
//! A cdf is the part of the exposure up to the time's *place* on its ramp ([`ramp`](crate::ramp)). A place is found to
//! within an error of its way. So of two neighbouring times the later one may have the smaller cdf, by at most an ulp
//! (proofs/search.py).

use crate::exposure::Exposure;
use crate::fixed::{ONE, power_of_two, rounded, times};
use crate::fraction::Side::{self, End, Start};
use crate::ramp::Ramp;

/// A place on the ramp at a side, counted from the end that faces the side `from`.
struct OnRamp<'a> {
    side: Side,
    ramp: &'a Ramp,
    from: Side,
    place: u64,
}

/// Where a time between the curve's ends lies; none on the plateau.
#[inline]
fn on_ramp(exposure: &Exposure, t: f32) -> Option<OnRamp<'_>> {
    let [open, close] = [exposure.join_time(Start), exposure.join_time(End)];
    if open < close && t >= open && t <= close {
        return None;
    }
    // The join of both ramps is on the opening one, if that has length.
    let side = Side::end_if(t > open || exposure.end_time(Start) == open);
    let ramp = exposure.ramp(side);
    let (from, place) = ramp.place_of_time(t, exposure.units);
    Some(OnRamp { side, ramp, from, place })
}

/// The openness at `t`, in 2⁻⁶⁰.
#[inline]
fn openness_in_fixed(exposure: &Exposure, t: f32) -> i64 {
    if !(t >= exposure.end_time(Start) && t <= exposure.end_time(End)) {
        return 0;
    }
    match on_ramp(exposure, t) {
        Some(OnRamp { ramp, from, place, .. }) => ramp.openness_at(from, place),
        None => 1 << 60,
    }
}

/// The openness at `t`.
#[inline]
pub(crate) fn openness(exposure: &Exposure, t: f32) -> f32 {
    rounded(openness_in_fixed(exposure, t), power_of_two(-28))
}

/// The openness at `t` over the exposure.
#[inline]
pub(crate) fn pdf(exposure: &Exposure, t: f32) -> f32 {
    let (significand, up) = per_area(exposure);
    rounded(times(openness_in_fixed(exposure, t) << 2, significand), power_of_two(-30)) * power_of_two(up)
}

/// The fraction of the exposure collected by `t`.
#[allow(clippy::neg_cmp_op_on_partial_ord, reason = "of NaN it is 0")]
#[inline]
pub(crate) fn cdf(exposure: &Exposure, t: f32) -> f32 {
    if t >= exposure.end_time(End) {
        return 1.0;
    } else if !(t > exposure.end_time(Start)) {
        return 0.0;
    }
    let fraction = match on_ramp(exposure, t) {
        Some(OnRamp { side, ramp, from, place }) => {
            let mass = ramp.mass_at(from, place);
            let part = if from.is_end() { ramp.share - mass } else { mass };
            if side.is_end() { ONE - ramp.share + part } else { part }
        }
        None => {
            let way = exposure.in_units(t) - exposure.in_units(exposure.join_time(Start));
            let (significand, up) = per_area(exposure);
            // way 2^exponent / A · 2⁶², where 1 / A is significand 2^(up - 64), and `times` has the 2⁻⁶⁴. One doubling
            // is left for after the product: the way, at most A, then fits, and A has less than 2⁶² units.
            let part = times(way << ((up + exposure.units.exponent() + 61) & 63), significand) << 1;
            exposure.ramp(Start).share + if part < exposure.plateau() { part } else { exposure.plateau() }
        }
    };
    rounded(fraction, power_of_two(-30))
}

/// `(significand, up)`: one over the area is `significand / 2⁶⁴ · 2^up`.
#[inline]
fn per_area(exposure: &Exposure) -> (u64, i32) {
    let bits = exposure.per_area.to_bits();
    (bits << 11 | 1 << 63, (bits >> 52) as i32 - 1022)
}
