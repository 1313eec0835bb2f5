//! From a time: the openness, the pdf, and the cdf.
//!
//! A cdf is the part of the exposure up to the time's *place* on its ramp ([`ramp`](crate::ramp)). As a place is off by
//! up to a quarter of the way to the next time's, and 32 fine units, it may fall by an ulp (proofs/search.py).

use crate::exposure::Exposure;
use crate::fixed::{ONE, power_of_two, rounded, times};
use crate::fraction::Side::{self, End, Start};
use crate::ramp::Ramp;

/// A place is searched to an error of its way, in fine units: this share of the time, a quarter ulp or less (a unit is
/// one fine unit or more), and [`LEAST_WAY_ERROR`].
// proofs/search.py
const TIME_SHIFT: u32 = 26;
const LEAST_WAY_ERROR: i64 = 32;

/// A place on the ramp at a side, counted from the end that faces another side.
struct Place<'a> {
    side: Side,
    ramp: &'a Ramp,
    from: Side,
    place: u64,
}

/// The place of a time between the curve's ends; none on the plateau.
#[inline]
fn place(exposure: &Exposure, t: f32) -> Option<Place<'_>> {
    let [open, close] = [exposure.join_time(Start), exposure.join_time(End)];
    if open < close && t >= open && t <= close {
        return None;
    }
    // The join of both ramps is on the opening one, if that has length.
    let side = Side::end_if(t > open || exposure.end_time(Start) == open);
    let ramp = exposure.ramp(side);
    let time = exposure.units.of(t);
    let error = (time.abs() >> TIME_SHIFT) + LEAST_WAY_ERROR;
    let (from, place) = ramp.place_of_time(time, error, exposure.units);
    Some(Place { side, ramp, from, place })
}

/// The openness at `t`, in 2⁻⁶⁰.
#[inline]
fn openness_in_fixed(exposure: &Exposure, t: f32) -> i64 {
    if !(t >= exposure.end_time(Start) && t <= exposure.end_time(End)) {
        return 0;
    }
    match place(exposure, t) {
        Some(Place { ramp, from, place, .. }) => ramp.openness_at(from, place),
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
#[inline]
pub(crate) fn cdf(exposure: &Exposure, t: f32) -> f32 {
    if t >= exposure.end_time(End) {
        return 1.0;
    } else if !(t > exposure.end_time(Start)) {
        return 0.0;
    }
    let fraction = match place(exposure, t) {
        Some(Place { side, ramp, from, place }) => {
            let mass = ramp.mass_at(from, place);
            let part = if from.is_end() { ramp.share - mass } else { mass };
            if side.is_end() { ONE - ramp.share + part } else { part }
        }
        None => {
            let way = exposure.in_units(t) - exposure.in_units(exposure.join_time(Start));
            let (significand, up) = per_area(exposure);
            // way / A · 2⁶². The last doubling is after the product, or the way would not fit.
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
