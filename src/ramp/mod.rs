//! A ramp: one Bezier, and the time by which a mass has been collected on it.
//!
//! From either end of the ramp, time and mass are polynomials, without a constant term, of the *place*: the Bezier's
//! parameter, from 0 there to [`LAST_PLACE`] at the other end. So both tails keep their relative accuracy. A side sees
//! every ramp from the end that faces it: [`Side::Start`] from the earlier, [`Side::End`] from the later, back in time.
//!
//! A search starts from one of four *anchors*, the one whose mass is nearest: the two ends and the two *flat places*,
//! the minima of `f` (a cubic) and of `t'` (a parabola) if they lie inside. There the density `f t'` may nearly vanish,
//! so Newton's method needs a good first guess: one term of the series around the anchor gives it. Places and powers
//! count away from the nearer end, as here with two flat places at 0.3 and 0.8 of a ramp:
//!
//! ```text
//! place           0              0.3                 0.8       1
//! anchor          end            flat place          flat place end
//! stored place                   +0.3                -0.2               (times LAST_PLACE)
//! powers count    -->            -->                 <--       <--
//! ```

pub(crate) mod bezier;
pub(crate) mod by_time;
pub(crate) mod cubic;
pub(crate) mod lift;
pub(crate) mod shape;

use crate::fraction::Side;
use crate::number::moment::Moment;
use crate::number::pair::{Pair, flipped};
use crate::number::series::Series;
use crate::number::units::{
    DARK, LAST_PLACE, WHOLE, mass_per_fraction, power_of_two_f64, ramp_unit,
};
use crate::ramp::cubic::integral;
use crate::ramp::shape::Shape;
use crate::search::{Anchor, Found, ROUNDING, solve};

/// The sign bit, for what counts back.
pub(crate) const BACK: u32 = 1 << 31;

/// [`Anchor::rounding`] from the other end, where the distance is rounded; and from a flat place, where it is rounded
/// twice, and one coefficient may nearly cancel.
// proofs/solve.py
const FROM_OTHER: f32 = 1.25 * ROUNDING;
const FROM_FLAT: f32 = 3.0 * ROUNDING;

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

/// A flat place: the minimum of `t'` or `f` inside a ramp. Place, mass and powers count from the ramp's nearer end.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Flat {
    /// From that end to here; negative, -0.0 included, if that is the later end.
    place: f32,
    /// From that end to here.
    mass: Pair,
    /// The mass from here by powers of the distance, without the last two coefficients, which follow from the end's.
    c: [f32; 4],
}

impl Flat {
    /// No flat place: no mass is near to it.
    const NONE: Self = Self { place: 0.0, mass: Pair { hi: f32::INFINITY, lo: 0.0 }, c: [0.0; 4] };

    /// The side of the end from which all counts.
    #[inline(always)]
    const fn side(&self) -> Side {
        Side::end_if(self.place.is_sign_negative())
    }
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
    /// The minimum of `t'`, and that of `f`.
    flats: [Flat; 2],
    /// The ramp's fraction of the exposure, in [`WHOLE`].
    pub(crate) share: Pair,
}

impl Ramp {
    /// The ramp between two times, on a curve with this area.
    pub(crate) const fn new([start, end]: [f32; 2], shape: &Shape, area: f64) -> Self {
        let share = shape.area() / area * WHOLE as f64;
        let share = Pair::from_f64(if share < DARK as f64 { 0.0 } else { share });
        let per_unit = power_of_two_f64(-ramp_unit(start, end));
        let per_mass = mass_per_fraction(share.hi) as f64 * WHOLE as f64 / area;
        let first = RampEnd { at: start, time: [Pair::ZERO; 2], mass: [Pair::ZERO; 5] };
        let mut ramp = Self {
            ends: [first, RampEnd { at: end, ..first }],
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
            // From either side both last coefficients have the same bits, but for the sign of the mass.
            ramp.last_of_time = in_places(&time.c, per_unit, &mut seen_end.time);
            let last = in_places(&seen.mass(), per_mass, &mut seen_end.mass);
            ramp.last_of_mass = last.flipped(side.sign());
            let series = Series { c: &seen_end.mass, last };
            let minima = [time.least_slope(), openness.minimum()];
            let mut kind = 0;
            while kind < 2 {
                let p = minima[kind & 1];
                // In the half next to this side, and a little beyond: rounding cannot hide one at the middle from both.
                if p > 0.0 && p <= 0.5000001 {
                    let (place, p) = (p as f32 * LAST_PLACE, p as f32 as f64);
                    let mut c = [Pair::ZERO; 4];
                    in_places(&integral(openness.around(p), time.around(p)), per_mass, &mut c);
                    ramp.flats[kind & 1] = Flat {
                        place: flipped(place, side.sign()),
                        mass: series.at(place),
                        c: [c[0].hi, c[1].hi, c[2].hi, c[3].hi],
                    };
                }
                kind += 1;
            }
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
    ///
    /// On a ramp with a mass of 10, from each anchor to a target of 7, and negative if that lies back:
    ///
    /// ```text
    /// from this end                                         7
    /// from a flat place of mass 6, counted from this end    7 - 6 = 1
    /// from one of mass 1, counted from the other end        (7 - 10) + 1 = -2
    /// from the other end                                    7 - 10 = -3
    /// ```
    #[inline(always)]
    const fn anchor(&self, side: Side, target: Pair) -> Anchor<6> {
        let from_other = target.minus_loose(self.share.scaled(mass_per_fraction(self.share.hi)));
        let (mut sought, mut nearest) = (from_other.rounded(), 2);
        let mut i = 0;
        while i < 2 {
            let flat = &self.flats[i];
            let from_flat = if flat.side().is(side) {
                target.difference(flat.mass)
            } else {
                from_other.difference(flat.mass.negated())
            };
            if from_flat.abs() < sought.abs() {
                (sought, nearest) = (from_flat, i);
            }
            i += 1;
        }
        // |sought| is the least of the table's last three.
        if target.hi <= sought.abs() {
            return Anchor::end(self.mass_in_single(side), target.hi);
        }
        if nearest == 2 {
            let (place, c) = (Pair::new(LAST_PLACE), self.mass_in_single(side.other()));
            return Anchor { place, sign: BACK, c, sought: -sought, rounding: FROM_OTHER };
        }
        let flat = &self.flats[nearest & 1];
        let [.., c5, c6] = self.mass_in_single(flat.side());
        let [c1, c2, c3, c4] = flat.c;
        let from_end = flat.place.abs();
        // Around `from_end` the fifth coefficient is c5 + 6 c6 from_end, and the sixth c6.
        let c5 = c5 + 6.0 * c6 * from_end;
        // `powers_sign`: do the powers count back, from the other end? `sign`: does the target lie back from the
        // anchor?
        let (base, powers_sign) = if flat.side().is(side) { (0.0, 0) } else { (LAST_PLACE, BACK) };
        let place = Pair::sum(base, flipped(from_end, powers_sign));
        let sign = sought.to_bits() & BACK;
        // Mirrored if the powers count away from the target: with -x for x, and the mass negated, 3x + 2x² + x³ becomes
        // 3x - 2x² + x³.
        let mirror = powers_sign ^ sign;
        let c = [c1, flipped(c2, mirror), c3, flipped(c4, mirror), c5, flipped(c6, mirror)];
        Anchor { place, sign, c, sought: sought.abs(), rounding: FROM_FLAT }
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
