//! A ramp by time: the place at which a time is reached, and mass and openness there.

use crate::fraction::Side::{self, End, Start};
use crate::number::pair::{Pair, flipped};
use crate::number::series::Series;
use crate::number::units::{LAST_PLACE, LENGTH, exponent, fraction_per_mass, power_of_two};
use crate::ramp::quick::quick_place;
use crate::ramp::{BACK, Ramp};
use crate::search::guess::guess;
use crate::search::{Anchor, ROUNDING, solve};

/// The error of a search for a time, relative to the way from the ramp's nearer end. The way is at most as long as the time
/// itself, so neighbouring `f32` are at least 2⁻²⁴ of the way apart. Only on a ramp across time 0 may it be longer, up
/// to about the time of the farther end. But there [`on_grid`] leaves multiples of a quarter of that end's ulp, which
/// are about 2⁻²⁶ of the way apart, or more. The error is a quarter of this distance, so neighbours keep their order.
const TIME_ERROR: f32 = 1.0 / (1 << 28) as f32;

/// From an eighth to a quarter of a ramp's mean `t'`, since a ramp is one to two [`LENGTH`]s long. If the least `t'` is
/// below, a time may be searched for from there.
const SLOW: f32 = 0.25 * LENGTH / LAST_PLACE;

/// A point of a ramp, found by its time: its place from the end that faces a side.
pub(crate) struct RampPoint<'a> {
    ramp: &'a Ramp,
    side: Side,
    place: Pair,
}

impl Ramp {
    /// Where the ramp is at `t`, which lies on it and [`on_grid`](Self::on_grid).
    #[inline(always)]
    pub(crate) const fn at_time(&self, t: f32) -> RampPoint<'_> {
        let (side, way) = self.since(t);
        let place = match self.quick_place(side, way) {
            Some(place) => place,
            None => self.searched_place(side, way),
        };
        RampPoint { ramp: self, side, place }
    }

    /// The side of the nearer end, and the exact time between it and `t`, in the ramp's unit.
    #[inline(always)]
    const fn since(&self, t: f32) -> (Side, Pair) {
        let [start, end] = [self.time(Start), self.time(End)];
        let side = Side::end_if(t - start > end - t);
        let way = if side.is_end() { Pair::sum(end, -t) } else { Pair::sum(t, -start) };
        (side, way.shifted(-self.unit()))
    }

    /// The place at which a time has passed since the end that faces a side, if a few steps lead there.
    #[inline(always)]
    const fn quick_place(&self, side: Side, target: Pair) -> Option<Pair> {
        let Series { c, last } = self.time_since(side);
        quick_place([c[0], c[1], last], target, TIME_ERROR * target.hi)
    }

    /// From which side a time is counted, and whether a few steps lead to its place.
    #[cfg(test)]
    pub(crate) fn way(&self, t: f32) -> (Side, bool) {
        let (side, target) = self.since(self.on_grid(t));
        (side, self.quick_place(side, target).is_some())
    }

    /// The same by a search.
    #[cold]
    #[inline(never)]
    const fn searched_place(&self, side: Side, target: Pair) -> Pair {
        let series = self.time_since(side);
        let c @ [c1, c2, c3] = [series.c[0].hi, series.c[1].hi, series.last.hi];
        let mut anchor =
            Anchor { place: Pair::ZERO, back: 0, c, sought: target.hi, rounding: ROUNDING };
        // From where `t' = c1 + 2 c2 x + 3 c3 x²` is least, if time is slow there and the target near.
        let thrice = 3.0 * c3;
        if c2 < 0.0 && -c2 < thrice * LAST_PLACE && (c1 - SLOW) * thrice < c2 * c2 {
            let slowest = -c2 / thrice;
            let sought = target.difference(series.at(slowest));
            if sought.abs() < target.hi {
                let [c1, c2, c3] = around([series.c[0], series.c[1], series.last], slowest);
                let (back, sought) = (sought.to_bits() & BACK, sought.abs());
                let (place, c) = (Pair::new(slowest), [c1, flipped(c2, back), c3]);
                // A cubic loses less than a mass, so this is enough around any place (proofs/solve.py).
                anchor = Anchor { place, back, c, sought, rounding: ROUNDING };
            }
        }
        let guess = guess(&anchor.c, anchor.sought);
        solve(series, target, &anchor, guess, [TIME_ERROR * target.hi; 2]).0
    }

    /// The openness at `t`, at least 0, in units of a power of two, and the exponent of that.
    #[inline(never)]
    pub(crate) fn openness_at(&self, t: f32) -> (Pair, i32) {
        let RampPoint { side, place, .. } = self.at_time(self.on_grid(t));
        let [f0, f1, f2, f3] = self.openness;
        let f = if side.is_end() { [f3, f2, f1, f0] } else { [f0, f1, f2, f3] };
        // Scaled so that the second halves of all coefficients that count, and their products with the least place,
        // keep their bits.
        let unit = f.iter().fold(-127, |most, f| exponent(*f).max(most)) - 60;
        let f = f.map(|f| Pair::new(f).shifted(-unit).hi);
        let d = [Pair::sum(f[1], -f[0]), Pair::sum(f[2], -f[1]), Pair::sum(f[3], -f[2])];
        let bend = d[1].minus_loose(d[0]);
        let c = [d[0].thrice(), bend.thrice()];
        let series = Series { c: &c, last: d[2].minus_loose(d[1]).minus_loose(bend) };
        let value = Pair::new(f[0]).plus(series.at_pair_unrolled(place.scaled(1.0 / LAST_PLACE)));
        (if value.rounded() < 0.0 { Pair::ZERO } else { value }, unit)
    }
}

impl RampPoint<'_> {
    /// The place from the ramp's start. (A time nearer to the end is at least an eighteenth of the ramp from there.)
    #[inline(always)]
    const fn place_from_start(&self) -> Pair {
        let Pair { hi, lo } = self.place;
        if self.side.is(Start) {
            return self.place;
        }
        let rest = Pair::sum(LAST_PLACE, -hi);
        Pair::sum(rest.hi, rest.lo - lo)
    }

    /// The fraction collected from the ramp's start until here, in [`WHOLE`](crate::number::units::WHOLE).
    #[inline(always)]
    pub(crate) const fn mass(&self) -> Pair {
        let mass = self.ramp.mass_since(Start).at_pair_unrolled(self.place_from_start());
        mass.scaled(fraction_per_mass(self.ramp.share.hi))
    }

    /// A bound of the rounding error of [`mass`](Self::mass), and of that of a search from a side for a mass that is
    /// next to it: what [`Series::at_pair`] loses of the terms from either end, twice, for the step of the search.
    // proofs/series.py
    pub(crate) fn noise(&self, side: Side) -> f32 {
        let place_from_start = self.place_from_start().hi;
        let terms = |side: Side| {
            let x = if side.is(Start) { place_from_start } else { LAST_PLACE - place_from_start };
            let c = self.ramp.mass_in_single(side);
            c.iter().rev().fold(0.0, |terms, c| (terms + c.abs()) * x)
        };
        let terms = terms(Start) + terms(side);
        terms * fraction_per_mass(self.ramp.share.hi) / (1u64 << 39) as f32
    }
}

impl Ramp {
    /// A time on a ramp. If that runs across time 0, where `f32` are denser than a search is exact, it is moved by at most
    /// half an ulp of the farther end, onto a multiple of a quarter, a half or all of that.
    #[inline(always)]
    pub(crate) const fn on_grid(&self, t: f32) -> f32 {
        let [start, end] = [self.time(Start), self.time(End)];
        if start < 0.0 && end > 0.0 { on_grid(start, end, t) } else { t }
    }
}

#[inline(never)]
const fn on_grid(start: f32, end: f32, t: f32) -> f32 {
    let near = 0.5 * power_of_two(exponent(if end > -start { end } else { -start }));
    if t.abs() >= near || t == start || t == end {
        return t;
    }
    // The sum is from 0.5 to 2.5 `near`, so the bits below its last place are rounded off.
    let t = (t + 1.5 * near) - 1.5 * near;
    if t < start {
        start
    } else if t > end {
        end
    } else {
        t
    }
}

/// The coefficients of a time around `x` in single precision, computed in pairs, because they may be differences of
/// nearly equal numbers.
#[cold]
#[inline(never)]
const fn around([a, b, c]: [Pair; 3], x: f32) -> [f32; 3] {
    let x = Pair::new(x);
    let bend = c.thrice().times(x);
    let slope = bend.plus(b.scaled(2.0)).times(x).plus(a);
    [slope.rounded(), bend.plus(b).rounded(), c.hi]
}
