//! A ramp by time: the place at a time, and the mass and the openness there.

use crate::fraction::Side::{self, End, Start};
use crate::number::pair::{Pair, flipped, lost_by_short_product, upper};
use crate::number::series::Series;
use crate::number::units::{LAST_PLACE, LENGTH, exponent, fraction_per_mass, power_of_two};
use crate::ramp::{BACK, Ramp};
use crate::search::{Anchor, ROUNDING, Taylor, Tolerance, left, solve};

/// The error of a place, as a share of the time from the ramp's nearer end: at most a quarter of the distance between
/// neighbouring times, which so keep their order. The time from the end is at most `|t|`, so neighbouring `f32` are at
/// least 2⁻²⁴ of it apart. Only on a ramp across time 0 may it exceed `|t|`; there [`Ramp::on_grid`] leaves times
/// about 2⁻²⁶ of it apart.
const TIME_ERROR: f32 = 1.0 / (1 << 28) as f32;

/// 1/8 to 1/4 of a ramp's mean `t'`, since a ramp is one to two [`LENGTH`]s long. If the least `t'` is below this, a
/// search may start from there.
const SLOW: f32 = 0.25 * LENGTH / LAST_PLACE;

/// A point of a ramp, by its place from the end that faces a side.
pub(crate) struct RampPoint<'a> {
    ramp: &'a Ramp,
    side: Side,
    place: Pair,
}

impl Ramp {
    /// The time `t`. On a ramp across time 0, where `f32` are denser than a search is exact, it is rounded to a
    /// multiple of 1/4, 1/2 or 1 ulp of the end that is farther from 0.
    #[inline(always)]
    pub(crate) const fn on_grid(&self, t: f32) -> f32 {
        let [start, end] = [self.time(Start), self.time(End)];
        if start < 0.0 && end > 0.0 { gridded(start, end, t) } else { t }
    }

    /// The point at `t`, which lies on the ramp and [`on_grid`](Self::on_grid).
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
    pub(crate) const fn since(&self, t: f32) -> (Side, Pair) {
        let [start, end] = [self.time(Start), self.time(End)];
        let side = Side::end_if(t - start > end - t);
        let way = if side.is_end() { Pair::sum(end, -t) } else { Pair::sum(t, -start) };
        (side, way.shifted(-self.unit()))
    }

    /// The place at which `target` has passed since the end that faces a side, within [`TIME_ERROR`]; `None` where time
    /// nearly stands still, and only a search finds it. After two of Halley's steps in single precision about a
    /// thousandth is missing. That is measured in pairs, and a third step leaves about its cube. The place is accepted
    /// if a bound of that ([`left`]) is at most 3/4 of the error; the last quarter is for measuring.
    #[inline(always)]
    pub(crate) const fn quick_place(&self, side: Side, target: Pair) -> Option<Pair> {
        let Series { c, last } = self.time_since(side);
        let (c, single) = ([c[0], c[1], last], [c[0].hi, c[1].hi, last.hi]);
        let [c1, c2, _] = single;
        let sought = target.hi;
        // Halley's step n / (1 + b) from the end, with n = sought / c1 and b = n c2 / c1.
        let x = sought * c1 / (c1 * c1 + c2 * sought);
        let local = Taylor::new(&single, x);
        let inverse = 1.0 / local.d1;
        let newton = (sought - local.value) * inverse;
        let bend = local.d2 * newton * inverse;
        // Halley's second step leads to an `x` of 12 bits: so `value` takes fewer operations.
        let x = upper(x + newton * (1.0 - bend * (1.0 - bend)));
        let local = Taylor::new(&single, x);
        let missing = target.difference(value(c, x));
        // inverse = 1 / local.d1, by a step of Newton's from the one before.
        let inverse = inverse * (2.0 - local.d1 * inverse);
        let newton = missing * inverse;
        let step = newton * (1.0 - local.d2 * newton * inverse);
        let place = Pair::sum(x, step);
        // Not another root of the cubic, beyond the ramp. A negative one has greater bits, too.
        let is_inside = place.hi.to_bits() <= LAST_PLACE.to_bits();
        let rest = left(&single, &local, 0.0, missing, step, ROUNDING);
        if is_inside & (rest <= 0.75 * (TIME_ERROR * target.hi)) { Some(place) } else { None }
    }

    /// The place at which `target` has passed, by a search.
    #[cold]
    #[inline(never)]
    const fn searched_place(&self, side: Side, target: Pair) -> Pair {
        let series = self.time_since(side);
        let c @ [c1, c2, c3] = [series.c[0].hi, series.c[1].hi, series.last.hi];
        let mut anchor = Anchor::end(c, target.hi);
        // From where `t' = c1 + 2 c2 x + 3 c3 x²` is least, if it is below SLOW there, and the target nearer than from
        // the end. The least `t'` is `c1 - c2² / (3 c3)`, at `x = -c2 / (3 c3)`.
        let thrice = 3.0 * c3;
        if c2 < 0.0 && -c2 < thrice * LAST_PLACE && (c1 - SLOW) * thrice < c2 * c2 {
            let slowest = -c2 / thrice;
            let sought = target.difference(series.at(slowest));
            if sought.abs() < target.hi {
                let [c1, c2, c3] = around([series.c[0], series.c[1], series.last], slowest);
                let (sign, sought) = (sought.to_bits() & BACK, sought.abs());
                let (place, c) = (Pair::new(slowest), [c1, flipped(c2, sign), c3]);
                // A time's cubic loses less than a mass: no more rounding than from an end (proofs/solve.py).
                anchor = Anchor { place, sign, c, sought, rounding: ROUNDING };
            }
        }
        let error = TIME_ERROR * target.hi;
        solve(series, target, &anchor, &Tolerance { wanted: error, accepted: error }).place
    }

    /// The openness `f 2^unit` at `t`, at least 0, as `(f, unit)`.
    #[inline(never)]
    pub(crate) fn openness_at(&self, t: f32) -> (Pair, i32) {
        let RampPoint { side, place, .. } = self.at_time(self.on_grid(t));
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
        let value = Pair::new(f[0]).plus(series.at_pair_unrolled(place.scaled(1.0 / LAST_PLACE)));
        (if value.rounded() < 0.0 { Pair::ZERO } else { value }, unit)
    }
}

impl RampPoint<'_> {
    /// The place from the ramp's start. Little cancels: a time nearer to the end lies beyond 1/7 of the ramp, since
    /// `t'` is not negative.
    #[inline(always)]
    const fn place_from_start(&self) -> Pair {
        let Pair { hi, lo } = self.place;
        if self.side.is(Start) {
            return self.place;
        }
        let rest = Pair::sum(LAST_PLACE, -hi);
        Pair::sum(rest.hi, rest.lo - lo)
    }

    /// The mass from the ramp's start to here, as a fraction in [`WHOLE`](crate::number::units::WHOLE).
    #[inline(always)]
    pub(crate) const fn mass(&self) -> Pair {
        let mass = self.ramp.mass_since(Start).at_pair_unrolled(self.place_from_start());
        mass.scaled(fraction_per_mass(self.ramp.share.hi))
    }

    /// How far [`mass`](Self::mass) and an inverse near here may disagree. Measuring loses at most 2⁻³⁹ of the terms
    /// `Σ |c_k| x^k` from the start. A search from `side` for nearly this mass ends within 2⁻³⁹ of those from there.
    // proofs/cdf.py
    pub(crate) fn noise(&self, side: Side) -> f32 {
        let place_from_start = self.place_from_start().hi;
        let terms_from = |side: Side| {
            let x = if side.is(Start) { place_from_start } else { LAST_PLACE - place_from_start };
            let c = self.ramp.mass_in_single(side);
            c.iter().rev().fold(0.0, |terms, c| (terms + c.abs()) * x)
        };
        let terms = terms_from(Start) + terms_from(side);
        terms * fraction_per_mass(self.ramp.share.hi) / (1u64 << 39) as f32
    }
}

/// [`Ramp::on_grid`] between two ends, one on either side of time 0.
#[inline(never)]
const fn gridded(start: f32, end: f32, t: f32) -> f32 {
    let half = 0.5 * power_of_two(exponent(if end > -start { end } else { -start }));
    if t.abs() >= half || t == start || t == end {
        return t;
    }
    // The farther end is 2 to 4 times `half`, and `t + 1.5 half` is 0.5 to 2.5 times it. So an ulp of that sum, to
    // which `t` is rounded, is 1/4, 1/2 or 1 ulp of the farther end.
    let t = (t + 1.5 * half) - 1.5 * half;
    if t < start {
        start
    } else if t > end {
        end
    } else {
        t
    }
}

/// The cubic `a, b, c` around `x`, in single precision but computed in pairs, because coefficients may nearly cancel.
#[cold]
#[inline(never)]
const fn around([a, b, c]: [Pair; 3], x: f32) -> [f32; 3] {
    let x = Pair::new(x);
    let thrice = c.thrice().times(x);
    let slope = thrice.plus(b.scaled(2.0)).times(x).plus(a);
    [slope.rounded(), thrice.plus(b).rounded(), c.hi]
}

/// The cubic's value at an `x` of 12 bits, as [`Series::at`] computes it.
#[inline(always)]
const fn value([c1, c2, c3]: [Pair; 3], x: f32) -> Pair {
    let product = c3.hi * x;
    let lo = c3.lo * x + lost_by_short_product(product, c3.hi, x);
    let sum = Pair::sum(c2.hi, product);
    let lo = lo + (c2.lo + sum.lo);
    let product = sum.hi * x;
    let lo = lo * x + lost_by_short_product(product, sum.hi, x);
    let sum = Pair::sum(c1.hi, product);
    let lo = lo + (c1.lo + sum.lo);
    let product = sum.hi * x;
    Pair { hi: product, lo: lo * x + lost_by_short_product(product, sum.hi, x) }
}
