//! A ramp: one Bezier, the time by which a mass has been collected on it, and the mass and the openness at a time.
//!
//! From either end of the ramp, time and mass are polynomials of the *place*, the Bezier's parameter counted from
//! there. So both tails keep their relative accuracy. A side sees every ramp from the end that faces it:
//! [`Side::Start`] from the earlier, [`Side::End`] from the later, back in time.

pub(crate) mod bezier;
pub(crate) mod shape;

use crate::fixed::{Units, clamped, fixed_towards_0, in_2_60};
use crate::fraction::Side;
use crate::ramp::bezier::CubicBezier;
use crate::ramp::shape::Shape;
use crate::search::Series;

/// Coefficients of a mass are in units of `2^MASS_SHIFT`: they are up to 2⁹ times the exposure (proofs/domain.py).
const MASS_SHIFT: u32 = 9;
/// Those of a way are in `2^WAY_SHIFT` fine units, as they are up to six times the interval.
const WAY_SHIFT: u32 = 3;

/// [`Ramp::place_of_time`] finds a way within `|time| / 2^TIME_SHIFT + LEAST_WAY_ERROR` fine units. For that, |time| in
/// units counts as if in fine ones: that is a quarter ulp of the time at most, and less where units are coarser.
const TIME_SHIFT: u32 = 26;
/// Within this error, in fine units, a search for a way always ends: 25 would do (proofs/search.py).
const LEAST_WAY_ERROR: i64 = 32;

/// One Bezier as a part of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ramp {
    /// The times of the ends.
    ends: [f32; 2],
    /// The openness of the control points.
    openness: [f32; 4],
    /// The differences of their times, in `2^WAY_SHIFT` fine units.
    differences: [i64; 3],
    /// The coefficients of the mass since an end, the earlier or the later one, in units of `2^MASS_SHIFT`.
    mass_powers: [[i64; 6]; 2],
    /// The mass of the whole ramp.
    pub(crate) whole: i64,
}

impl Ramp {
    /// `per_area` is one over the curve's area, `whole` the mass of this ramp.
    pub(crate) const fn new(bezier: &CubicBezier, per_area: f64, whole: i64, units: Units) -> Self {
        let powers = [Shape::new(bezier, Side::Start).mass(), Shape::new(bezier, Side::End).mass()];
        let (mut mass_powers, mut k) = ([[0; 6]; 2], 0);
        while k < 12 {
            mass_powers[k / 6][k % 6] = fixed_towards_0(powers[k / 6][k % 6] * per_area, MASS_SHIFT as i32 - 62);
            k += 1;
        }
        let [t0, t1, t2, t3] = bezier.times();
        let [u0, u1, u2, u3] = [units.of(t0), units.of(t1), units.of(t2), units.of(t3)];
        let [d0, d1, d2] = [units.refined(u1 - u0), units.refined(u2 - u1), units.refined(u3 - u2)];
        let differences = [d0 >> WAY_SHIFT, d1 >> WAY_SHIFT, d2 >> WAY_SHIFT];
        Self { ends: [t0, t3], openness: bezier.opennesses(), differences, mass_powers, whole }
    }

    /// The time of the end that faces a side.
    pub(crate) const fn end_time(&self, side: Side) -> f32 {
        self.ends[side as usize]
    }

    /// The mass since the end that faces a side.
    pub(crate) const fn mass_since(&self, side: Side) -> Series<'_, 6> {
        Series { c: &self.mass_powers[side as usize], shift: MASS_SHIFT }
    }

    /// The coefficients of the way since the end that faces a side, in `2^WAY_SHIFT` fine units.
    const fn way_powers(&self, side: Side) -> [i64; 3] {
        let [d0, d1, d2] = self.differences;
        powers(if side.is_end() { [d2, d1, d0] } else { [d0, d1, d2] })
    }

    /// The time, in units, by which a mass has been collected since the end that faces a side, where the mass may be
    /// off by `error`; and the steps of the search. The search starts from the end from which less mass is missing.
    #[inline(always)]
    pub(crate) const fn time_of_mass(&self, side: Side, mass: i64, error: i64, units: Units) -> (i64, u32) {
        let rest = self.whole - mass;
        let (from, target) = if mass <= rest { (side, mass) } else { (side.other(), rest) };
        let (place, steps) = self.mass_since(from).solve(target, error);
        let way = Series { c: &self.way_powers(from), shift: WAY_SHIFT }.at(place);
        let [d0, d1, d2] = self.differences;
        let way = clamped(way, (d0 + d1 + d2) << WAY_SHIFT);
        (from.inwards(units.of(self.end_time(from)), units.coarsened(way)), steps)
    }

    /// The end that is nearer in time, by the side that it faces, and the place of a time from there.
    #[inline(never)]
    pub(crate) const fn place_of_time(&self, t: f32, units: Units) -> (Side, u64) {
        let [start, end] = self.ends;
        // As `t` grows this changes once, though both differences are rounded.
        let from = Side::end_if(t - start > end - t);
        let time = units.of(t);
        let way = (time - units.of(self.end_time(from))).abs();
        let ways = Series { c: &self.way_powers(from), shift: WAY_SHIFT };
        // |time|, or one less. (By `abs` a cdf takes 35 cycles more.)
        let size = time ^ (time >> 63);
        (from, ways.solve(units.refined(way), (size >> TIME_SHIFT) + LEAST_WAY_ERROR).0)
    }

    /// The openness, in 2⁻⁶⁰, at a place from the end that faces a side.
    pub(crate) const fn openness_at(&self, side: Side, place: u64) -> i64 {
        let [f0, f1, f2, f3] = self.openness;
        let [f0, f1, f2, f3] = if side.is_end() { [f3, f2, f1, f0] } else { [f0, f1, f2, f3] };
        let [f0, f1, f2, f3] = [in_2_60(f0), in_2_60(f1), in_2_60(f2), in_2_60(f3)];
        // `at` is low, so only 0 can be passed.
        let value = f0 + Series { c: &powers([f1 - f0, f2 - f1, f3 - f2]), shift: 0 }.at(place);
        if value > 0 { value } else { 0 }
    }
}

/// A cubic without its constant, by the differences of its Bernstein coefficients.
const fn powers([d0, d1, d2]: [i64; 3]) -> [i64; 3] {
    [3 * d0, 3 * (d1 - d0), (d0 + d2) - 2 * d1]
}
