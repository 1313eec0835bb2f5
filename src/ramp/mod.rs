//! A ramp: one Bezier, seen from either end, and where on it a mass has been collected.
//!
//! From an end, the time and the mass since are polynomials without a constant term in the place, which counts from 0
//! there to [`LAST_PLACE`] at the other end. So both tails keep their relative accuracy. A side of the curve sees every
//! ramp from the end that faces it: side 0 from the earlier end, side 1 from the later one, back in time.
//!
//! Newton's method needs a good first guess where the slope of the mass, the density `f t'`, nearly vanishes. Near a
//! ramp's end the series is nearly its leading term, and a root of that term is such a guess. Inside the ramp the
//! density nearly vanishes only near the minimum of `f` or of `t'`. Each has one at most, being a cubic and a parabola,
//! and with the series expanded there, the guess is again a root of its leading term. So a search for a mass starts
//! from one of four *anchors*, the one whose mass is nearest: the two ends and the two minima.

pub(crate) mod bezier;
pub(crate) mod by_time;
pub(crate) mod cubic;
pub(crate) mod lift;
mod quick;
pub(crate) mod shape;

use crate::fraction::Side;
use crate::number::moment::Moment;
use crate::number::pair::{Pair, flipped};
use crate::number::series::Series;
use crate::number::units::{LAST_PLACE, WHOLE, mass_per_fraction, power_of_two_f64, ramp_unit};
use crate::ramp::bezier::CubicBezier;
use crate::ramp::cubic::integral;
use crate::ramp::shape::Shape;
use crate::search::guess::guess;
use crate::search::{Anchor, ROUNDING, solve};

/// The sign bit: the direction of what counts back.
pub(crate) const BACK: u32 = 1 << 31;

/// The rounding of an anchor's slopes: from the other end the distance is itself rounded, from a flat place twice, and
/// one coefficient may be a difference of greater ones.
// proofs/solve.py
const FROM_OTHER: f32 = 1.25 * ROUNDING;
const FROM_FLAT: f32 = 3.0 * ROUNDING;

/// One end of a ramp, and the series from there.
#[derive(Clone, Copy, Debug, PartialEq)]
struct End {
    at: f32,
    /// The time since, either way, except for its last coefficient.
    time: [Pair; 2],
    /// The mass in between, except for its last coefficient.
    mass: [Pair; 5],
}

impl End {
    /// Without its series.
    const fn new(at: f32) -> Self {
        Self { at, time: [Pair::ZERO; 2], mass: [Pair::ZERO; 5] }
    }
}

/// A place inside a ramp where `t'` or `f` has a minimum, and the density may nearly vanish. Place, mass and powers
/// count away from the nearer end of the ramp. Place and mass are negative if that is the later end.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Flat {
    /// How far from the nearer end, with that sign.
    place: f32,
    /// The mass between that end and here, with that sign.
    mass: Pair,
    /// The mass from here, by powers of the distance. The last two coefficients follow from those of the end.
    c: [f32; 4],
}

impl Flat {
    /// No place: no mass is near to it.
    const NONE: Self = Self { place: 0.0, mass: Pair { hi: f32::INFINITY, lo: 0.0 }, c: [0.0; 4] };
}

/// One Bezier as a part of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ramp {
    /// The earlier end and the later one.
    ends: [End; 2],
    /// The last coefficient of both ends' time.
    last_of_time: Pair,
    /// The last coefficient of the earlier end's mass; the later end's is minus that.
    last_of_mass: Pair,
    /// The openness of the control points.
    pub(crate) openness: [f32; 4],
    /// Where `t'` has its minimum, and where `f` has.
    flats: [Flat; 2],
    /// The ramp's fraction of the exposure, in [`WHOLE`].
    pub(crate) share: Pair,
}

impl Ramp {
    /// A ramp of a curve whose whole area is this.
    pub(crate) const fn new(curve: &CubicBezier, area: f64) -> Self {
        let [start, _, _, end] = curve.times();
        let shape = Shape::new(curve);
        // A ramp with less than 2⁻¹⁵⁰ of the exposure is dark: no `f32` u is reached on it.
        let share = shape.area() / area;
        let is_dark = share < 0.5 * f32::from_bits(1) as f64;
        let share = Pair::from_f64(if is_dark { 0.0 } else { share * WHOLE as f64 });
        let per_unit = power_of_two_f64(-ramp_unit(start, end));
        let per_mass = mass_per_fraction(share.hi) as f64 * WHOLE as f64 / area;
        let mut ramp = Self {
            ends: [End::new(start), End::new(end)],
            last_of_time: Pair::ZERO,
            last_of_mass: Pair::ZERO,
            openness: shape.f,
            flats: [Flat::NONE; 2],
            share,
        };
        let mut i = 0;
        while i < 2 {
            let side = Side::BOTH[i];
            let seen = shape.from(side);
            let (openness, time, seen_end) = (seen.openness(), seen.time(), &mut ramp.ends[i]);
            // Both last coefficients are the same from either side, to the bit, but for the sign of the mass.
            ramp.last_of_time = in_places(&time.c, per_unit, &mut seen_end.time);
            let last = in_places(&seen.mass(), per_mass, &mut seen_end.mass);
            ramp.last_of_mass = seen_from(side, last);
            let series = Series { c: &seen_end.mass, last };
            let minima = [time.least_slope(), openness.minimum()];
            let mut kind = 0;
            while kind < 2 {
                let p = minima[kind & 1];
                // A little beyond the middle, so that rounding hides no minimum from both sides.
                if p > 0.0 && p <= 0.5000001 {
                    let (place, p) = (p as f32 * LAST_PLACE, p as f32 as f64);
                    let mut c = [Pair::ZERO; 4];
                    in_places(&integral(openness.around(p), time.around(p)), per_mass, &mut c);
                    ramp.flats[kind & 1] = Flat {
                        place: flipped(place, side.sign()),
                        mass: seen_from(side, series.at(place)),
                        c: [c[0].hi, c[1].hi, c[2].hi, c[3].hi],
                    };
                }
                kind += 1;
            }
            i += 1;
        }
        ramp
    }

    /// An end by the side that it faces, which is 0 or 1.
    #[inline(always)]
    const fn end(&self, side: Side) -> &End {
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
        Series { c: &self.end(side).mass, last: seen_from(side, self.last_of_mass) }
    }

    /// The same in single precision.
    #[inline(always)]
    pub(crate) const fn mass_in_single(&self, side: Side) -> [f32; 6] {
        let Series { c, last } = self.mass_since(side);
        [c[0].hi, c[1].hi, c[2].hi, c[3].hi, c[4].hi, last.hi]
    }

    /// The moment at which the fraction `target` has been collected since the end that faces a side. Target and errors,
    /// which are those of [`solve`], are in [`WHOLE`].
    #[inline(always)]
    pub(crate) const fn at_mass(&self, side: Side, target: Pair, error: [f32; 2]) -> Moment {
        let factor = mass_per_fraction(self.share.hi);
        let target = target.scaled(factor);
        let anchor = self.anchor(side, target);
        let guess = guess(&anchor.c, anchor.sought);
        let error = [error[0] * factor, error[1] * factor];
        self.moment(side, solve(self.mass_since(side), target, &anchor, guess, error))
    }

    #[inline(always)]
    const fn moment(&self, side: Side, (place, evaluations): (Pair, u32)) -> Moment {
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

    /// The anchor whose mass is nearest to a target, seen from a side.
    #[inline(always)]
    const fn anchor(&self, side: Side, target: Pair) -> Anchor<6> {
        // The other end, then the minima.
        let from_other = target.minus_loose(self.share.scaled(mass_per_fraction(self.share.hi)));
        let (mut sought, mut nearest) = (from_other.rounded(), 2);
        let mut i = 0;
        while i < 2 {
            // A negative mass counts from the other end, as `from_other` does.
            let mass = seen_from(side, self.flats[i].mass);
            let from_end = if mass.hi < 0.0 { from_other } else { target };
            let from_flat = from_end.difference(mass);
            if from_flat.abs() < sought.abs() {
                (sought, nearest) = (from_flat, i);
            }
            i += 1;
        }
        if target.hi <= sought.abs() {
            let c = self.mass_in_single(side);
            return Anchor { place: Pair::ZERO, back: 0, c, sought: target.hi, rounding: ROUNDING };
        }
        if nearest == 2 {
            let (place, c) = (Pair::new(LAST_PLACE), self.mass_in_single(side.other()));
            return Anchor { place, back: BACK, c, sought: -sought, rounding: FROM_OTHER };
        }
        // The powers count away from the flat place's nearer end. They are mirrored if the target lies the other way.
        let flat = &self.flats[nearest & 1];
        let is_other = (flat.place < 0.0) != side.is_end();
        let [.., c5, c6] = self.mass_in_single(side.other_if(is_other));
        let [c1, c2, c3, c4] = flat.c;
        let from_end = flat.place.abs();
        let c5 = c5 + 6.0 * c6 * from_end;
        let (base, counts_back) = if is_other { (LAST_PLACE, BACK) } else { (0.0, 0) };
        let place = Pair::sum(base, flipped(from_end, counts_back));
        let back = sought.to_bits() & BACK;
        // Mirrored, both the distance and the mass count the other way, so it is the even powers that change their
        // sign.
        let mirror = counts_back ^ back;
        let c = [c1, flipped(c2, mirror), c3, flipped(c4, mirror), c5, flipped(c6, mirror)];
        Anchor { place, back, c, sought: sought.abs(), rounding: FROM_FLAT }
    }
}

/// A number that is negative for what counts from the later end, as it is seen from a side: negative for the other end.
#[inline(always)]
const fn seen_from(side: Side, x: Pair) -> Pair {
    x.flipped(side.sign())
}

/// Coefficients by powers of `p`, which runs from 0 to 1, as those by powers of the place, times `scale`, into `pairs`;
/// the last one apart.
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
