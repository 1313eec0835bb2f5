//! From a time: the openness, the pdf, and the cdf.
//!
//! A cdf is the part of the exposure up to the time's *place* on its ramp ([`ramp`](crate::ramp)). As a place is off by
//! up to a quarter of the way to the next time's, and 32 fine units, it may fall by an ulp (proofs/search.py).

use crate::exposure::Exposure;
use crate::fixed::{ONE, nearest, power_of_two, times};
use crate::fraction::Side::{self, End, Start};
use crate::ramp::Ramp;

/// Where a time lies on the curve.
enum Section<'a> {
    Before,
    After,
    Plateau,
    /// On the ramp at a side: at a place, which is counted from the end that faces another side.
    Ramp(Side, &'a Ramp, Side, u64),
}

/// The section of a time.
#[inline]
fn section(exposure: &Exposure, t: f32) -> Section<'_> {
    let [start, end] = [exposure.end_time(Start), exposure.end_time(End)];
    let [open, close] = [exposure.join_time(Start), exposure.join_time(End)];
    if t < start || t.is_nan() {
        return Section::Before;
    } else if t > end {
        return Section::After;
    } else if open < close && t >= open && t <= close {
        return Section::Plateau;
    }
    // The join of both ramps is on the opening one, if that has length.
    let side = Side::end_if(t > open || start == open);
    let (ramp, units) = (exposure.ramp(side), exposure.units());
    let time = units.of(t);
    // In fine units: a quarter ulp of `t` or less, and 32. (A unit is one or more of them.)
    let error = (time.abs() >> 26) + 32;
    let (from, place) = ramp.place_of_time(time, error, units);
    Section::Ramp(side, ramp, from, place)
}

/// The openness at `t`, in 2⁻⁶⁰.
#[inline]
fn openness_in_fixed(exposure: &Exposure, t: f32) -> i64 {
    match section(exposure, t) {
        Section::Before | Section::After => 0,
        Section::Plateau => 1 << 60,
        Section::Ramp(_, ramp, from, place) => ramp.openness_at(from, place),
    }
}

/// The openness at `t`.
#[inline]
pub(crate) fn openness(exposure: &Exposure, t: f32) -> f32 {
    nearest(openness_in_fixed(exposure, t)) * power_of_two(-60)
}

/// The openness at `t` over the exposure.
#[inline]
pub(crate) fn pdf(exposure: &Exposure, t: f32) -> f32 {
    let (significand, up) = per_area(exposure);
    nearest(times(openness_in_fixed(exposure, t) << 2, significand)) * power_of_two(-62) * power_of_two(up)
}

/// The fraction of the exposure collected by `t`.
#[inline]
pub(crate) fn cdf(exposure: &Exposure, t: f32) -> f32 {
    let fraction = match section(exposure, t) {
        Section::Before => 0,
        Section::After => ONE,
        Section::Plateau => {
            let way = exposure.in_units(t) - exposure.in_units(exposure.join_time(Start));
            let (significand, up) = per_area(exposure);
            // way / A · 2⁶². The last doubling is after the product, or the way would not fit.
            let part = times(way << ((up + exposure.units().exponent + 61) & 63), significand) << 1;
            exposure.ramp(Start).share + if part < exposure.plateau() { part } else { exposure.plateau() }
        }
        Section::Ramp(side, ramp, from, place) => {
            let mass = ramp.mass_at(from, place);
            let part = if from.is_end() { ramp.share - mass } else { mass };
            if side.is_end() { ONE - ramp.share + part } else { part }
        }
    };
    nearest(fraction) * power_of_two(-62)
}

/// `(significand, up)`: one over the area is `significand / 2⁶⁴ · 2^up`.
#[inline]
fn per_area(exposure: &Exposure) -> (u64, i32) {
    let bits = exposure.per_area.to_bits();
    (bits << 11 | 1 << 63, (bits >> 52) as i32 - 1022)
}
