//! A ramp: one Bezier, the time by which a mass has been collected on it, and the mass and the openness at a time.
//!
//! From either end of the ramp, time and mass are polynomials, without a constant term, of the *place*: the Bezier's
//! parameter, from 0 there to [`LAST_PLACE`] at the other end. So both tails keep their relative accuracy. A side sees
//! every ramp from the end that faces it: [`Side::Start`] from the earlier, [`Side::End`] from the later, back in time.

pub(crate) mod bezier;
pub(crate) mod shape;

use crate::fraction::Side::{self, End, Start};
use crate::number::moment::Moment;
use crate::number::pair::Pair;
use crate::number::series::Series;
use crate::number::units::{LAST_PLACE, WHOLE, exponent, mass_exponent, power_of_two, power_of_two_f64, ramp_exponent};
use crate::ramp::shape::Shape;
use crate::search::{Anchor, Found, solve};

/// The error of a place, in time, as a share of the time `d` from the ramp's nearer end: at most a quarter of the
/// distance between neighbouring times, which so keep their order. Where the curve does not cross time 0, `d <= |t|`,
/// so neighbours of `t` are at least 2⁻²⁴ `d` away. Else times are on a grid, at least 2⁻²⁶ `d` apart
/// ([`cdf`](crate::cdf)).
const TIME_ERROR: f32 = 1.0 / (1 << 28) as f32;

/// A place below this, 2⁻¹⁴⁷ of the ramp, counts as the end, and so does a time below it: what a search measures there
/// would be subnormal, and not exact enough. What is lost is far below the error of any answer.
const LEAST_PLACE: f32 = power_of_two(-117);

/// One end of a ramp, and the series from there.
#[derive(Clone, Copy, Debug, PartialEq)]
struct RampEnd {
    /// The time of the end.
    at: f32,
    /// The coefficients of the time between here and a place, but the last.
    time_c: [Pair; 2],
    /// The coefficients of the mass between here and a place, but the last.
    mass_c: [Pair; 5],
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
    openness: [f32; 4],
    /// The ramp's fraction of the exposure, in [`WHOLE`].
    pub(crate) share: Pair,
}

impl Ramp {
    /// The ramp between two times, on a curve with this area.
    pub(crate) const fn new([start, end]: [f32; 2], shape: &Shape, area: f64) -> Self {
        let share = Pair::from_f64(shape.area() / area * WHOLE as f64);
        let ramp_units_per_time = power_of_two_f64(-ramp_exponent(start, end));
        let mass_per_area = power_of_two_f64(mass_exponent(share.hi)) * WHOLE as f64 / area;
        let first = RampEnd { at: start, time_c: [Pair::ZERO; 2], mass_c: [Pair::ZERO; 5] };
        let mut ramp = Self {
            ends: [first, RampEnd { at: end, ..first }],
            last_of_time: Pair::ZERO,
            last_of_mass: Pair::ZERO,
            openness: shape.openness,
            share,
        };
        let mut i = 0;
        while i < 2 {
            let side = Side::BOTH[i];
            let (seen, seen_end) = (shape.seen_from(side), &mut ramp.ends[i]);
            // From either side both last coefficients have the same bits, but for the sign of the mass.
            ramp.last_of_time = in_places(&seen.time_powers(), ramp_units_per_time, &mut seen_end.time_c);
            let last = in_places(&seen.exposure_powers(), mass_per_area, &mut seen_end.mass_c);
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
    pub(crate) const fn end_time(&self, side: Side) -> f32 {
        self.end(side).at
    }

    /// The exponent of the ramp's unit of time.
    #[inline(always)]
    const fn way_exponent(&self) -> i32 {
        ramp_exponent(self.ends[0].at, self.ends[1].at)
    }

    /// The time since the end that faces a side.
    #[inline(always)]
    const fn time_since(&self, side: Side) -> Series<'_> {
        Series { c: &self.end(side).time_c, last: self.last_of_time }
    }

    /// The mass since the end that faces a side.
    #[inline(always)]
    const fn mass_since(&self, side: Side) -> Series<'_> {
        Series { c: &self.end(side).mass_c, last: self.last_of_mass.flipped(side.sign()) }
    }

    /// [`mass_since`](Self::mass_since) in single precision.
    #[inline(always)]
    const fn mass_in_single(&self, side: Side) -> [f32; 6] {
        let Series { c, last } = self.mass_since(side);
        [c[0].hi, c[1].hi, c[2].hi, c[3].hi, c[4].hi, last.hi]
    }

    /// The place by which a part of the exposure has been collected since the end that faces a side. The part and its
    /// error are fractions in [`WHOLE`]. The search starts from the end whose mass is nearer.
    #[inline(always)]
    pub(crate) const fn place_of_part(&self, side: Side, part: Pair, error: f32) -> Found {
        let per_fraction = power_of_two(mass_exponent(self.share.hi));
        let mass = part.scaled(per_fraction);
        let rest = self.share.scaled(per_fraction).minus_loose(mass).rounded();
        let anchor = if mass.hi <= rest {
            Anchor { place: 0.0, c: self.mass_in_single(side), sought: mass.hi }
        } else {
            Anchor { place: LAST_PLACE, c: self.mass_in_single(side.other()), sought: rest }
        };
        solve(self.mass_since(side), mass, &anchor, error * per_fraction)
    }

    /// The moment of a place, which is counted from the end that faces a side.
    #[inline(always)]
    pub(crate) const fn moment(&self, side: Side, place: Pair) -> Moment {
        Moment {
            base: self.end_time(side),
            back: side.is_end(),
            way: self.time_since(side).at_pair(place),
            way_exponent: self.way_exponent(),
            until: self.end_time(side.other()),
        }
    }

    /// The point at `t`, which lies on the ramp.
    #[inline(always)]
    pub(crate) const fn at_time(&self, t: f32) -> RampPoint<'_> {
        let [start, end] = [self.end_time(Start), self.end_time(End)];
        let side = Side::end_if(t - start > end - t);
        // Exact, and in the ramp's unit.
        let way = if side.is_end() { Pair::sum(end, -t) } else { Pair::sum(t, -start) };
        let way = way.shifted(-self.way_exponent());
        RampPoint { ramp: self, side, place: self.place_of_time(side, way) }
    }

    /// The place by which `target` has passed since the end that faces a side, within [`TIME_ERROR`].
    #[inline(never)]
    const fn place_of_time(&self, side: Side, target: Pair) -> Pair {
        let series = self.time_since(side);
        let c = [series.c[0].hi, series.c[1].hi, series.last.hi];
        // Next to the end time is `c[0] place`. Where `c[0]` is small, `+ 1.0` has a time below LEAST_PLACE units count
        // as the end, too.
        if target.hi < LEAST_PLACE * (c[0] + 1.0) {
            return Pair::ZERO;
        }
        let anchor = Anchor { place: 0.0, c, sought: target.hi };
        solve(series, target, &anchor, TIME_ERROR * target.hi).place
    }
}

/// A point of a ramp, by its place from the end that faces a side.
pub(crate) struct RampPoint<'a> {
    ramp: &'a Ramp,
    side: Side,
    place: Pair,
}

impl RampPoint<'_> {
    /// The place from the end that faces a side. If that is not `self.side`, little cancels: on a ramp of length 1 the
    /// time is at least `p³`, as no control time is before the end, so by half of it at least 1/5 of [`LAST_PLACE`] is
    /// left.
    #[inline(always)]
    const fn place_from(&self, side: Side) -> Pair {
        if self.side.is(side) {
            return self.place;
        }
        let rest = Pair::sum(LAST_PLACE, -self.place.hi);
        Pair::sum(rest.hi, rest.lo - self.place.lo)
    }

    /// The part of the exposure from the end of the ramp that faces a side to here, in [`WHOLE`].
    #[inline(always)]
    pub(crate) const fn fraction(&self, side: Side) -> Pair {
        let mass = self.ramp.mass_since(side).at_pair(self.place_from(side));
        mass.scaled(power_of_two(-mass_exponent(self.ramp.share.hi)))
    }

    /// The openness `f 2^exponent`, as `(f, exponent)`.
    #[inline(never)]
    pub(crate) fn openness(&self) -> (Pair, i32) {
        let [f0, f1, f2, f3] = self.ramp.openness;
        let f = if self.side.is_end() { [f3, f2, f1, f0] } else { [f0, f1, f2, f3] };
        // The greatest f becomes 2⁶⁰ to 2⁶¹, so that each `lo` is normal where it counts. By rules 3 and 6 it was 2⁻²¹
        // or more, so `up` is at most 81. (Next to an end the place may become subnormal: what that loses is far below
        // the error of an openness, 2⁻³⁸ of the greatest.)
        let up = 60 - f.iter().fold(-127, |most, f| exponent(*f).max(most));
        let f = f.map(|f| f * power_of_two(up));
        let d = [Pair::sum(f[1], -f[0]), Pair::sum(f[2], -f[1]), Pair::sum(f[3], -f[2])];
        let bend = d[1].minus_loose(d[0]);
        let c = [d[0].thrice(), bend.thrice()];
        // f[0] + c[0] p + c[1] p² + last p³
        let series = Series { c: &c, last: d[2].minus_loose(d[1]).minus_loose(bend) };
        let value = Pair::new(f[0]).plus(series.at_pair(self.place.scaled(1.0 / LAST_PLACE)));
        (value, -up)
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
