//! A ramp by time: the place at a time, and the mass and the openness there.

use crate::fraction::Side::{self, End, Start};
use crate::number::pair::Pair;
use crate::number::series::Series;
use crate::number::units::{LAST_PLACE, exponent, fraction_per_mass};
use crate::ramp::Ramp;
use crate::search::{Anchor, solve};

/// The error of a place, as a share of the time from the ramp's nearer end: at most a quarter of the distance between
/// neighbouring times, which so keep their order. The time from the end is at most `|t|`, so neighbouring `f32` are at
/// least 2⁻²⁴ of it apart. Only on a curve across time 0 may it exceed `|t|`; there times are on a grid, about 2⁻²⁶ of
/// it apart.
const TIME_ERROR: f32 = 1.0 / (1 << 28) as f32;

/// A point of a ramp, by its place from the end that faces a side.
pub(crate) struct RampPoint<'a> {
    ramp: &'a Ramp,
    side: Side,
    place: Pair,
}

impl Ramp {
    /// The point at `t`, which lies on the ramp.
    #[inline(always)]
    pub(crate) const fn at_time(&self, t: f32) -> RampPoint<'_> {
        let (side, way) = self.since(t);
        RampPoint { ramp: self, side, place: self.place_at(side, way) }
    }

    /// The side of the nearer end, and the exact time between it and `t`, in the ramp's unit.
    #[inline(always)]
    pub(crate) const fn since(&self, t: f32) -> (Side, Pair) {
        let [start, end] = [self.time(Start), self.time(End)];
        let side = Side::end_if(t - start > end - t);
        let way = if side.is_end() { Pair::sum(end, -t) } else { Pair::sum(t, -start) };
        (side, way.shifted(-self.unit()))
    }

    /// The place at which `target` has passed since the end that faces a side, within [`TIME_ERROR`].
    #[inline(never)]
    const fn place_at(&self, side: Side, target: Pair) -> Pair {
        let series = self.time_since(side);
        let anchor = Anchor::end([series.c[0].hi, series.c[1].hi, series.last.hi], target.hi);
        solve(series, target, &anchor, TIME_ERROR * target.hi).place
    }

    /// The openness `f 2^unit` at `t`, at least 0, as `(f, unit)`.
    #[inline(never)]
    pub(crate) fn openness_at(&self, t: f32) -> (Pair, i32) {
        let RampPoint { side, place, .. } = self.at_time(t);
        let [f0, f1, f2, f3] = self.openness;
        let f = if side.is_end() { [f3, f2, f1, f0] } else { [f0, f1, f2, f3] };
        let unit = f.iter().fold(-127, |most, f| exponent(*f).max(most)) - 60;
        let f = f.map(|f| Pair::new(f).shifted(-unit).hi);
        // The greatest f is about 2⁶⁰: so second numbers, and products with small places, are normal where they count.
        let d = [Pair::sum(f[1], -f[0]), Pair::sum(f[2], -f[1]), Pair::sum(f[3], -f[2])];
        let second = d[1].minus_loose(d[0]);
        let c = [d[0].thrice(), second.thrice()];
        // f[0] + c[0] p + c[1] p² + last p³
        let series = Series { c: &c, last: d[2].minus_loose(d[1]).minus_loose(second) };
        let value = Pair::new(f[0]).plus(series.at_pair(place.scaled(1.0 / LAST_PLACE)));
        (if value.rounded() < 0.0 { Pair::ZERO } else { value }, unit)
    }
}

impl RampPoint<'_> {
    /// The place from the end that faces a side. Little cancels: a time nearer to the other end lies beyond 1/7 of the
    /// ramp, since `t'` is not negative.
    #[inline(always)]
    const fn place_from(&self, side: Side) -> Pair {
        let Pair { hi, lo } = self.place;
        if self.side.is(side) {
            return self.place;
        }
        let rest = Pair::sum(LAST_PLACE, -hi);
        Pair::sum(rest.hi, rest.lo - lo)
    }

    /// The mass from the end of the ramp that faces a side to here, as a fraction in
    /// [`WHOLE`](crate::number::units::WHOLE).
    #[inline(always)]
    pub(crate) const fn mass(&self, side: Side) -> Pair {
        let mass = self.ramp.mass_since(side).at_pair(self.place_from(side));
        mass.scaled(fraction_per_mass(self.ramp.share.hi))
    }
}
