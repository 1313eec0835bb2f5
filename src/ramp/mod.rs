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
use crate::number::units::{
    LAST_PLACE, WHOLE, exponent, fraction_per_mass, mass_per_fraction, power_of_two_f64, ramp_unit,
};
use crate::ramp::shape::Shape;
use crate::search::{Anchor, Found, solve};

/// The error of a place, as a share of the time from the ramp's nearer end: at most a quarter of the distance between
/// neighbouring times, which so keep their order. The time from the end is at most `|t|`, so neighbouring `f32` are at
/// least 2⁻²⁴ of it apart. Only on a curve across time 0 may it exceed `|t|`; there times are on a grid, about 2⁻²⁶ of
/// it apart ([`on_grid`](crate::cdf)).
const TIME_ERROR: f32 = 1.0 / (1 << 28) as f32;

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
    openness: [f32; 4],
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
            openness: shape.openness,
            share,
        };
        let mut i = 0;
        while i < 2 {
            let side = Side::BOTH[i];
            let (seen, seen_end) = (shape.seen_from(side), &mut ramp.ends[i]);
            // From either side both last coefficients have the same bits, but for the sign of the mass.
            ramp.last_of_time = in_places(&seen.time_powers(), per_unit, &mut seen_end.time);
            let last = in_places(&seen.mass_powers(), per_mass, &mut seen_end.mass);
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
    const fn unit(&self) -> i32 {
        ramp_unit(self.ends[0].at, self.ends[1].at)
    }

    /// The time since the end that faces a side.
    #[inline(always)]
    const fn time_since(&self, side: Side) -> Series<'_> {
        Series { c: &self.end(side).time, last: self.last_of_time }
    }

    /// The mass since the end that faces a side.
    #[inline(always)]
    const fn mass_since(&self, side: Side) -> Series<'_> {
        Series { c: &self.end(side).mass, last: self.last_of_mass.flipped(side.sign()) }
    }

    /// [`mass_since`](Self::mass_since) in single precision.
    #[inline(always)]
    const fn mass_in_single(&self, side: Side) -> [f32; 6] {
        let Series { c, last } = self.mass_since(side);
        [c[0].hi, c[1].hi, c[2].hi, c[3].hi, c[4].hi, last.hi]
    }

    /// The place by which `target` has been collected since the end that faces a side, within `error`: both are
    /// fractions in [`WHOLE`]. The search starts from the end whose mass is nearer to the target.
    #[inline(always)]
    pub(crate) const fn place_of_mass(&self, side: Side, target: Pair, error: f32) -> Found {
        let factor = mass_per_fraction(self.share.hi);
        let (target, error) = (target.scaled(factor), error * factor);
        let rest = -target.minus_loose(self.share.scaled(factor)).rounded();
        let anchor = if target.hi <= rest {
            Anchor::near(self.mass_in_single(side), target.hi)
        } else {
            Anchor::far(self.mass_in_single(side.other()), rest)
        };
        solve(self.mass_since(side), target, &anchor, error)
    }

    /// The moment of a place, which is counted from the end that faces a side.
    #[inline(always)]
    pub(crate) const fn moment(&self, side: Side, place: Pair) -> Moment {
        let way = self.time_since(side).at_pair(place);
        Moment {
            base: self.time(side),
            back: side.is_end(),
            way: if way.rounded() < 0.0 { Pair::ZERO } else { way },
            unit: self.unit(),
            until: self.time(side.other()),
        }
    }

    /// The point at `t`, which lies on the ramp.
    #[inline(always)]
    pub(crate) const fn at_time(&self, t: f32) -> RampPoint<'_> {
        let [start, end] = [self.time(Start), self.time(End)];
        let side = Side::end_if(t - start > end - t);
        // Exact, and in the ramp's unit.
        let way = if side.is_end() { Pair::sum(end, -t) } else { Pair::sum(t, -start) };
        let way = way.shifted(-self.unit());
        RampPoint { ramp: self, side, place: self.place_of_time(side, way) }
    }

    /// The place by which `target` has passed since the end that faces a side, within [`TIME_ERROR`].
    #[inline(never)]
    const fn place_of_time(&self, side: Side, target: Pair) -> Pair {
        let series = self.time_since(side);
        let anchor = Anchor::near([series.c[0].hi, series.c[1].hi, series.last.hi], target.hi);
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
    /// The place from the end that faces a side. Little cancels: a time nearer to the other end lies beyond 1/7 of the
    /// ramp, since `t'` is not negative.
    #[inline(always)]
    const fn place_from(&self, side: Side) -> Pair {
        if self.side.is(side) {
            return self.place;
        }
        let rest = Pair::sum(LAST_PLACE, -self.place.hi);
        Pair::sum(rest.hi, rest.lo - self.place.lo)
    }

    /// The mass from the end of the ramp that faces a side to here, as a fraction in [`WHOLE`].
    #[inline(always)]
    pub(crate) const fn mass(&self, side: Side) -> Pair {
        let mass = self.ramp.mass_since(side).at_pair(self.place_from(side));
        mass.scaled(fraction_per_mass(self.ramp.share.hi))
    }

    /// The openness `f 2^unit`, at least 0, as `(f, unit)`.
    #[inline(never)]
    pub(crate) fn openness(&self) -> (Pair, i32) {
        let [f0, f1, f2, f3] = self.ramp.openness;
        let f = if self.side.is_end() { [f3, f2, f1, f0] } else { [f0, f1, f2, f3] };
        let unit = f.iter().fold(-127, |most, f| exponent(*f).max(most)) - 60;
        let f = f.map(|f| Pair::new(f).shifted(-unit).hi);
        // The greatest f is about 2⁶⁰: so second numbers, and products with small places, are normal where they count.
        let d = [Pair::sum(f[1], -f[0]), Pair::sum(f[2], -f[1]), Pair::sum(f[3], -f[2])];
        let second = d[1].minus_loose(d[0]);
        let c = [d[0].thrice(), second.thrice()];
        // f[0] + c[0] p + c[1] p² + last p³
        let series = Series { c: &c, last: d[2].minus_loose(d[1]).minus_loose(second) };
        let value = Pair::new(f[0]).plus(series.at_pair(self.place.scaled(1.0 / LAST_PLACE)));
        (if value.rounded() < 0.0 { Pair::ZERO } else { value }, unit)
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
