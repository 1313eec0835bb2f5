//! A ramp: one Bezier, the time by which a mass has been collected on it, and the mass and the openness at a time.
//!
//! From either end of the ramp, time and mass are polynomials of the *place*, the Bezier's parameter counted from
//! there. So both tails keep their relative accuracy. A side sees every ramp from the end that faces it:
//! [`Side::Start`] from the earlier, [`Side::End`] from the later, back in time.

pub(crate) mod bezier;
pub(crate) mod shape;

use crate::fixed::{Units, exponent, fixed_down, fixed_towards_0};
use crate::fraction::Side;
use crate::ramp::shape::Shape;
use crate::search::Series;

/// One Bezier as a part of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ramp {
    /// The times of the control points.
    times: [f32; 4],
    /// The openness of the control points.
    openness: [f32; 4],
    /// The coefficients of the mass between an end, the earlier or the later one, and a place, in `2^mass_shift`.
    mass: [[i64; 6]; 2],
    mass_shift: u32,
    /// The ramp's part of the exposure.
    pub(crate) share: i64,
}

impl Ramp {
    /// The ramp with these control times, on a curve with this area.
    pub(crate) const fn new(times: [f32; 4], shape: &Shape, area: f64, share: i64) -> Self {
        let powers = [shape.seen_from(Side::Start).exposure_powers(), shape.seen_from(Side::End).exposure_powers()];
        let (mut most, mut k) = (0.0, 0);
        while k < 6 {
            most += powers[0][k].abs() + powers[1][k].abs();
            k += 1;
        }
        // So the sizes of both ends sum up to less than 2⁶³; the shift is at most 9 (proofs/domain.py).
        let shift = exponent((most / area) as f32);
        let shift = if shift > 0 { shift } else { 0 };
        let mut mass = [[0; 6]; 2];
        while k > 0 {
            k -= 1;
            mass[0][k] = fixed_towards_0(powers[0][k] / area, shift - 62);
            mass[1][k] = fixed_towards_0(powers[1][k] / area, shift - 62);
        }
        Self { times, openness: shape.openness, mass, mass_shift: shift as u32, share }
    }

    /// The time of the end that faces a side.
    pub(crate) const fn end_time(&self, side: Side) -> f32 {
        if side.is_end() { self.times[3] } else { self.times[0] }
    }

    /// The mass since the end that faces a side.
    #[inline(always)]
    pub(crate) const fn mass_since(&self, side: Side) -> Series<'_, 6> {
        Series { c: &self.mass[side as usize], shift: self.mass_shift }
    }

    /// The time, in units, by which a part of the exposure has been collected since the end that faces a side, within an
    /// error of the part; and the evaluations of the search. It starts from the end whose mass is nearer.
    #[inline(always)]
    pub(crate) const fn time_of_part(&self, side: Side, part: i64, error: i64, units: Units) -> (i64, u32) {
        let rest = self.share - part;
        let (from, sought) = if part <= rest { (side, part) } else { (side.other(), rest) };
        let (place, evaluations) = self.mass_since(from).solve(sought, error);
        let times = fixed(self.times, units.exponent);
        let way = units.coarsened(time(&time_powers(times, from, units)).at(place));
        // Never beyond an end.
        let length = times[3] - times[0];
        let way = if way < length { way } else { length };
        let way = if way > 0 { way } else { 0 };
        (if from.is_end() { times[3] - way } else { times[0] + way }, evaluations)
    }

    /// The place of a time on the ramp, in units, within an error of its way, in fine units; counted from the end that is
    /// nearer in time, which comes first.
    #[inline(never)]
    pub(crate) const fn place_of_time(&self, time_units: i64, error: i64, units: Units) -> (Side, u64) {
        let times = fixed(self.times, units.exponent);
        let [way, rest] = [time_units - times[0], times[3] - time_units];
        let (from, way) = if way <= rest { (Side::Start, way) } else { (Side::End, rest) };
        (from, time(&time_powers(times, from, units)).solve(units.refined(way), error).0)
    }

    /// The part of the exposure between the end that faces a side and a place.
    #[inline(always)]
    pub(crate) const fn mass_at(&self, side: Side, place: u64) -> i64 {
        let mass = self.mass_since(side).at(place);
        let mass = if mass < self.share { mass } else { self.share };
        if mass > 0 { mass } else { 0 }
    }

    /// The openness, in 2⁻⁶⁰, at a place from the end that faces a side.
    #[inline(always)]
    pub(crate) const fn openness_at(&self, side: Side, place: u64) -> i64 {
        let [f0, f1, f2, f3] = fixed(self.openness, -60);
        let [f0, f1, f2, f3] = if side.is_end() { [f3, f2, f1, f0] } else { [f0, f1, f2, f3] };
        let value = f0 + Series { c: &powers([f1 - f0, f2 - f1, f3 - f2]), shift: 0 }.at(place);
        if value > 0 { value } else { 0 }
    }
}

/// Four control values in `2^exponent`.
#[inline(always)]
const fn fixed([a, b, c, d]: [f32; 4], exponent: i32) -> [i64; 4] {
    [fixed_down(a, exponent), fixed_down(b, exponent), fixed_down(c, exponent), fixed_down(d, exponent)]
}

/// The time since the end that faces a side, by the control times: in 2³ fine units, so that the length is 2⁵⁹ at most,
/// and coefficients of six times that fit.
#[inline(always)]
const fn time_powers([t0, t1, t2, t3]: [i64; 4], side: Side, units: Units) -> [i64; 3] {
    let [d0, d1, d2] = [units.refined(t1 - t0) >> 3, units.refined(t2 - t1) >> 3, units.refined(t3 - t2) >> 3];
    powers(if side.is_end() { [d2, d1, d0] } else { [d0, d1, d2] })
}

#[inline(always)]
const fn time(c: &[i64; 3]) -> Series<'_, 3> {
    Series { c, shift: 3 }
}

/// A cubic without its constant, by the differences of its Bernstein coefficients.
const fn powers([d0, d1, d2]: [i64; 3]) -> [i64; 3] {
    [3 * d0, 3 * (d1 - d0), (d0 + d2) - 2 * d1]
}
