//! A ramp: one Bezier, and the time by which a mass has been collected on it.
//!
//! From either end of the ramp, time and mass are polynomials, without a constant term, of the *place*: the Bezier's
//! parameter, from 0 there to [`LAST_PLACE`] at the other end. So both tails keep their relative accuracy. A side sees
//! every ramp from the end that faces it: [`Side::Start`] from the earlier, [`Side::End`] from the later, back in time.
//!
//! A search starts from the end whose mass is nearer to the target. Control values are at least 0, so the density
//! `f t'` nearly vanishes only next to an end.

pub(crate) mod bezier;
pub(crate) mod by_time;
pub(crate) mod cubic;
pub(crate) mod shape;

use crate::fraction::Side;
use crate::number::moment::Moment;
use crate::number::pair::Pair;
use crate::number::series::Series;
use crate::number::units::{LAST_PLACE, WHOLE, mass_per_fraction, power_of_two_f64, ramp_unit};
use crate::ramp::shape::Shape;
use crate::search::{Anchor, Found, ROUNDING, solve};

/// The sign bit, for what counts back.
pub(crate) const BACK: u32 = 1 << 31;

/// [`Anchor::rounding`] from the other end, where the distance is rounded.
// proofs/solve.py
const FROM_OTHER: f32 = 1.25 * ROUNDING;

/// One end of a ramp, and the series from there.
#[derive(Clone, Copy, Debug, PartialEq)]
struct RampEnd {
    /// The time of the end.
    at: f32,
    /// The time between here and a place, without its last coefficient.
    time: [Pair; 2],
    /// The mass between here and a place, without its last coefficient.
    mass: [Pair; 5],
}

/// One Bezier as a part of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ramp {
    /// The earlier end and the later one.
    ends: [RampEnd; 2],
    /// The last coefficient of both ends' time.
    last_of_time: Pair,
    /// The last coefficient of the earlier end's mass; the later one's is minus that.
    last_of_mass: Pair,
    /// The openness of the control points.
    pub(crate) openness: [f32; 4],
    /// The ramp's fraction of the exposure, in [`WHOLE`].
    pub(crate) share: Pair,
}

impl Ramp {
    /// The ramp between two times, on a curve with this area.
    pub(crate) const fn new([start, end]: [f32; 2], shape: &Shape, area: f64) -> Self {
        let share = Pair::from_f64(shape.area() / area * WHOLE as f64);
        let per_unit = power_of_two_f64(-ramp_unit(start, end));
        let per_mass = mass_per_fraction(share.hi) as f64 * WHOLE as f64 / area;
        let first = RampEnd { at: start, time: [Pair::ZERO; 2], mass: [Pair::ZERO; 5] };
        let mut ramp = Self {
            ends: [first, RampEnd { at: end, ..first }],
            last_of_time: Pair::ZERO,
            last_of_mass: Pair::ZERO,
            openness: shape.f,
            share,
        };
        let mut i = 0;
        while i < 2 {
            let side = Side::BOTH[i];
            let seen = shape.from(side);
            let (time, seen_end) = (seen.time(), &mut ramp.ends[i]);
            // From either side both last coefficients have the same bits, but for the sign of the mass.
            ramp.last_of_time = in_places(&time.c, per_unit, &mut seen_end.time);
            let last = in_places(&seen.mass(), per_mass, &mut seen_end.mass);
            ramp.last_of_mass = last.flipped(side.sign());
            i += 1;
        }
        ramp
    }

    /// The end that faces a side.
    #[inline(always)]
    const fn end(&self, side: Side) -> &RampEnd {
        &self.ends[side as usize]
    }

    /// The time of the end that faces a side.
    pub(crate) const fn time(&self, side: Side) -> f32 {
        self.end(side).at
    }

    /// The exponent of the ramp's unit of time.
    #[inline(always)]
    pub(crate) const fn unit(&self) -> i32 {
        ramp_unit(self.ends[0].at, self.ends[1].at)
    }

    /// The time since the end that faces a side.
    #[inline(always)]
    pub(crate) const fn time_since(&self, side: Side) -> Series<'_> {
        Series { c: &self.end(side).time, last: self.last_of_time }
    }

    /// The mass since the end that faces a side.
    #[inline(always)]
    pub(crate) const fn mass_since(&self, side: Side) -> Series<'_> {
        Series { c: &self.end(side).mass, last: self.last_of_mass.flipped(side.sign()) }
    }

    /// [`mass_since`](Self::mass_since) in single precision.
    #[inline(always)]
    pub(crate) const fn mass_in_single(&self, side: Side) -> [f32; 6] {
        let Series { c, last } = self.mass_since(side);
        [c[0].hi, c[1].hi, c[2].hi, c[3].hi, c[4].hi, last.hi]
    }

    /// The moment by which `target` has been collected since the end that faces a side. Target and error are fractions
    /// in [`WHOLE`].
    #[inline(always)]
    pub(crate) const fn at_mass(&self, side: Side, target: Pair, error: f32) -> Moment {
        let factor = mass_per_fraction(self.share.hi);
        let target = target.scaled(factor);
        let error = error * factor;
        let anchor = self.anchor(side, target);
        let Found { place, evaluations } = solve(self.mass_since(side), target, &anchor, error);
        let way = self.time_since(side).at_pair(place);
        Moment {
            base: self.time(side),
            back: side.is_end(),
            way: if way.rounded() < 0.0 { Pair::ZERO } else { way },
            unit: self.unit(),
            until: self.time(side.other()),
            evaluations,
        }
    }

    /// The anchor whose mass is nearest to `target`, seen from a side.
    #[inline(always)]
    const fn anchor(&self, side: Side, target: Pair) -> Anchor<6> {
        let from_other = target.minus_loose(self.share.scaled(mass_per_fraction(self.share.hi)));
        let sought = -from_other.rounded();
        if target.hi <= sought {
            return Anchor::end(self.mass_in_single(side), target.hi);
        }
        let (place, c) = (Pair::new(LAST_PLACE), self.mass_in_single(side.other()));
        Anchor { place, sign: BACK, c, sought, rounding: FROM_OTHER }
    }
}

/// Coefficients of powers of `p`, which is 0 to 1, become those of powers of the place, times `scale`. Fills `pairs`
/// with the first ones, and returns the last one.
#[inline(never)]
const fn in_places(c: &[f64], mut scale: f64, pairs: &mut [Pair]) -> Pair {
    let (mut last, mut k) = (Pair::ZERO, 0);
    while k < c.len() {
        scale /= LAST_PLACE as f64;
        last = Pair::from_f64(c[k] * scale);
        if k < pairs.len() {
            pairs[k] = last;
        }
        k += 1;
    }
    last
}
