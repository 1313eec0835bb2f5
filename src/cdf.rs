//! From a time: the openness, the pdf, and the cdf.
//!
//! 1. Outside the curve the openness is 0, and the cdf 0 or 1.
//! 2. On the plateau the openness is 1. The cdf is the opening ramp's mass and the way since then over the area.
//! 3. On a ramp, a search finds the time's *place* ([`Ramp::place_of_time`]).
//! 4. There the openness is a cubic, and the cdf is the mass up to the place.
//! 5. One rounding to `f32`.
//!
//! A place is found within an error of its way. So of two neighbouring times the later one may have the smaller cdf, by
//! at most an ulp (proofs/search.py).

use crate::curve::Curve;
use crate::fixed::{ONE, power_of_two, product, rounded};
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
fn on_ramp(curve: &Curve, t: f32) -> Option<OnRamp<'_>> {
    let [open, close] = [curve.join_time(Start), curve.join_time(End)];
    if open < close && t >= open && t <= close {
        return None;
    }
    // The join of both ramps is on the opening one, if that has length.
    let side = Side::end_if(t > open || curve.end_time(Start) == open);
    let ramp = curve.ramp(side);
    let (from, place) = ramp.place_of_time(t, curve.units);
    Some(OnRamp { side, ramp, from, place })
}

/// The openness at `t`, in 2⁻⁶⁰.
fn openness_in_fixed(curve: &Curve, t: f32) -> i64 {
    if !(t >= curve.end_time(Start) && t <= curve.end_time(End)) {
        return 0;
    }
    match on_ramp(curve, t) {
        Some(OnRamp { ramp, from, place, .. }) => ramp.openness_at(from, place),
        None => 1 << 60,
    }
}

/// The openness at `t`.
pub(crate) fn openness(curve: &Curve, t: f32) -> f32 {
    rounded(openness_in_fixed(curve, t), power_of_two(-28))
}

/// The openness at `t` over the area.
pub(crate) fn pdf(curve: &Curve, t: f32) -> f32 {
    let (significand, up) = per_area(curve);
    // The openness in 2⁻⁶², times the significand, is in 2⁻⁶². The last product is exact: it is normal, or 0.
    rounded(product(openness_in_fixed(curve, t) << 2, significand), power_of_two(-30)) * power_of_two(up)
}

/// The fraction of the exposure collected by `t`.
#[allow(clippy::neg_cmp_op_on_partial_ord, reason = "of NaN it is 0")]
pub(crate) fn cdf(curve: &Curve, t: f32) -> f32 {
    if t >= curve.end_time(End) {
        return 1.0;
    } else if !(t > curve.end_time(Start)) {
        return 0.0;
    }
    let mass = match on_ramp(curve, t) {
        Some(OnRamp { side, ramp, from, place }) => {
            let mass = ramp.mass_since(from).at(place);
            let mass = if from.is_end() { ramp.whole - mass } else { mass };
            if side.is_end() { ONE - ramp.whole + mass } else { mass }
        }
        None => {
            // In units. The mass is way · 2^exponent / area · 2⁶², and `product` divides by 2⁶⁴; a doubling is left for
            // after it. The area has less than 2⁶² units, so up + exponent > -62, and the shift is 0 or more. The
            // way is at most the area, so what is shifted is at most 2⁶².
            let way = curve.in_units(t) - curve.in_units(curve.join_time(Start));
            let (significand, up) = per_area(curve);
            let mass = product(way << ((up + curve.units.exponent() + 61) & 63), significand) << 1;
            curve.ramp(Start).whole + mass
        }
    };
    // Next to a dark start rounding may lead below 0.
    rounded(if mass > 0 { mass } else { 0 }, power_of_two(-30))
}

/// `(significand, up)`: one over the area is `significand / 2⁶⁴ · 2^up`, from `2^(up - 1)` to `2^up`.
fn per_area(curve: &Curve) -> (u64, i32) {
    let bits = curve.per_area.to_bits();
    (bits << 11 | 1 << 63, (bits >> 52) as i32 - 1022)
}
