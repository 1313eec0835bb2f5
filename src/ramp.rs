//! A ramp: one Bezier, seen from either end, and the anchors from which a search on it starts.
//!
//! From an end, the time passed and the mass collected are polynomials without a constant term in the place, which
//! counts from 0 there to [`ONE`] at the other end. So both tails keep their relative accuracy. A side of the curve
//! sees every ramp from the end that faces it: side 0 from the earlier end, side 1 from the later one, back in time.
//!
//! Newton's method needs a good first guess where the slope of the mass, the density `f t'`, nearly vanishes. Near a
//! ramp's end the series is nearly its leading term, and a root of that term is such a guess. Inside the ramp the
//! density nearly vanishes only near the minimum of `f` or of `t'`. Each has one at most, being a cubic and a parabola,
//! and with the series expanded there, the guess is again a root of its leading term. So a search for a mass starts
//! from one of four *anchors*, the one whose mass is nearest: the two ends and the two minima.

use crate::bezier::CubicBezier;
use crate::cubic::integral;
use crate::guess::guess;
use crate::moment::Moment;
use crate::pair::{Pair, exponent, flipped, power_of_two};
use crate::series::Series;
use crate::shape::Shape;
use crate::solve::{Anchor, ONE, Offset, ROUNDING, solve};

/// The whole exposure, in the unit of fractions: the least `f32`, and what rounding makes of it, are then normal
/// numbers.
pub(crate) const WHOLE: f32 = power_of_two(WHOLE_EXPONENT);
pub(crate) const WHOLE_EXPONENT: i32 = 104;

/// An error in time, relative to the way from the ramp's end: less than a quarter of the least distance between
/// neighbours, also of those of [`on_grid`], so that these keep their order.
const FOR_TIME: f32 = 1.0 / (1 << 28) as f32;

/// A slope from a quarter to half of a ramp's mean `t'`. If the least `t'` is below, a time may be searched for from
/// there.
const SLOW: f32 = 0.25 * LENGTH / ONE;

/// A ramp's length in its own unit, except for a factor in [1, 2).
const LENGTH: f32 = (1u128 << 64) as f32;

/// One end of a ramp, and the series from there.
#[derive(Clone, Copy, Debug, PartialEq)]
struct End {
    time: f32,
    /// `|t(p) - time|` except for its last coefficient.
    elapsed: [Pair; 2],
    /// The mass in between, except for its last coefficient.
    mass: [Pair; 5],
}

/// A place inside a ramp where `t'` or `f` has a minimum, and the density may nearly vanish. Place, mass and powers
/// count away from the nearer end of the ramp. Place and mass are negative if that is the later end.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Flat {
    /// How far from the nearer end.
    place: f32,
    /// The mass between that end and here.
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
    cubic: Pair,
    /// The last coefficient of the earlier end's mass; the later end's is minus that.
    sextic: Pair,
    /// The openness of the control points.
    openness: [f32; 4],
    /// Where `t'` has its minimum, and where `f` has.
    flats: [Flat; 2],
    /// The ramp's fraction of the exposure, in [`WHOLE`].
    pub(crate) share: Pair,
}

impl Ramp {
    /// A ramp of a curve with this area.
    pub(crate) const fn new(curve: &CubicBezier, area: f64) -> Self {
        let times = curve.times();
        let seen = Shape::new(curve);
        let seen = [seen, seen.reversed()];
        // A ramp with less than 2⁻¹⁵⁰ of the exposure is dark: no `f32` u is reached on it.
        let share = seen[0].mass() / area;
        let is_dark = share < 0.5 * f32::from_bits(1) as f64;
        let share = Pair::from_f64(if is_dark { 0.0 } else { share * WHOLE as f64 });
        let unit = unit_of_elapsed(times[0], times[3]);
        let per_unit = f64::from_bits(((1023 - unit) as u64) << 52);
        let per_mass = unit_of_mass(share) as f64 * WHOLE as f64 / area;
        let masses =
            [in_places(seen[0].collected(), per_mass), in_places(seen[1].collected(), per_mass)];
        let elapsed =
            [in_places(seen[0].elapsed().c, per_unit), in_places(seen[1].elapsed().c, per_unit)];
        let ends = [
            End::new(times[0], &elapsed[0], &masses[0]),
            End::new(times[3], &elapsed[1], &masses[1]),
        ];
        let mut flats = [Flat::NONE; 2];
        let mut side = 0;
        while side < 2 {
            let (openness, elapsed) = (seen[side].openness(), seen[side].elapsed());
            let minima = [elapsed.least_slope(), openness.minimum()];
            let mut kind = 0;
            while kind < 2 {
                let p = minima[kind];
                // A little beyond the middle, so that rounding hides no minimum from both sides.
                if p > 0.0 && p <= 0.5000001 {
                    let (place, p) = (p as f32 * ONE, p as f32 as f64);
                    let series = Series { c: &masses[side].0, last: masses[side].1 };
                    let c = integral(openness.around(p), elapsed.around(p));
                    let (c, _): ([Pair; 5], Pair) = in_places(c, per_mass);
                    flats[kind] = Flat {
                        place: seen_from(side, Pair::new(place)).hi,
                        mass: seen_from(side, series.at(place)),
                        c: [c[0].hi, c[1].hi, c[2].hi, c[3].hi],
                    };
                }
                kind += 1;
            }
            side += 1;
        }
        Self { ends, cubic: elapsed[0].1, sextic: masses[0].1, openness: seen[0].f, flats, share }
    }

    /// The time of its end that faces a side.
    pub(crate) const fn time(&self, side: usize) -> f32 {
        self.end(side).time
    }

    /// An end by its side, which is 0 or 1.
    #[inline(always)]
    const fn end(&self, side: usize) -> &End {
        &self.ends[side & 1]
    }

    /// The time passed since the end that faces a side.
    #[inline(always)]
    const fn elapsed(&self, side: usize) -> Series<'_> {
        Series { c: &self.end(side).elapsed, last: self.cubic }
    }

    /// The mass collected since the end that faces a side.
    #[inline(always)]
    const fn collected(&self, side: usize) -> Series<'_> {
        let last = seen_from(side, self.sextic);
        Series { c: &self.end(side).mass, last }
    }

    /// The same in single precision.
    #[inline(always)]
    const fn single(&self, side: usize) -> [f32; 6] {
        let Series { c, last } = self.collected(side);
        [c[0].hi, c[1].hi, c[2].hi, c[3].hi, c[4].hi, last.hi]
    }

    /// The anchor whose mass is nearest to a target, seen from a side.
    #[inline(always)]
    const fn anchor(&self, side: usize, target: Pair) -> Anchor<6> {
        // The other end, then the minima.
        let from_other = target.minus_loose(self.share.scaled(unit_of_mass(self.share)));
        let (mut sought, mut nearest) = (from_other.rounded(), 2);
        let mut i = 0;
        while i < 2 {
            let mass = seen_from(side, self.flats[i].mass);
            let from_end = if mass.hi < 0.0 { from_other } else { target };
            let from_flat = from_end.difference(mass);
            if from_flat.abs() < sought.abs() {
                (sought, nearest) = (from_flat, i);
            }
            i += 1;
        }
        if target.hi <= sought.abs() {
            let c = self.single(side);
            return Anchor { place: Pair::ZERO, back: 0, c, sought: target.hi, rounding: ROUNDING };
        }
        const BACK: u32 = 1 << 31;
        if nearest == 2 {
            let c = self.single(side ^ 1);
            return Anchor {
                place: Pair::new(ONE),
                back: BACK,
                c,
                sought: -sought,
                rounding: 1.25 * ROUNDING,
            };
        }
        // The powers count away from the flat place's nearer end. They are mirrored if the target lies the other way.
        let flat = &self.flats[nearest & 1];
        let is_other = (flat.place < 0.0) != (side == 1);
        let [.., c5, c6] = self.single(side ^ is_other as usize);
        let [c1, c2, c3, c4] = flat.c;
        let from_end = flat.place.abs();
        let c5 = c5 + 6.0 * c6 * from_end;
        let (base, sign) = if is_other { (ONE, BACK) } else { (0.0, 0) };
        let place = Pair::sum(base, flipped(from_end, sign));
        let back = sought.to_bits() & BACK;
        let sign = sign ^ back;
        let c = [c1, flipped(c2, sign), c3, flipped(c4, sign), c5, flipped(c6, sign)];
        Anchor { place, back, c, sought: sought.abs(), rounding: 3.0 * ROUNDING }
    }

    /// The moment at which a fraction has been collected since the end that faces a side. The errors are those of
    /// [`solve`], in [`WHOLE`] as the fraction.
    #[inline(always)]
    pub(crate) fn at_mass(&self, side: usize, target: Pair, error: [f32; 2]) -> Moment {
        let unit = unit_of_mass(self.share);
        let target = target.scaled(unit);
        let anchor = self.anchor(side, target);
        let guess = guess(&anchor.c, anchor.sought);
        self.moment(
            side,
            solve(self.collected(side), target, &anchor, guess, [error[0] * unit, error[1] * unit]),
        )
    }

    #[inline(always)]
    const fn moment(&self, side: usize, offset: Offset) -> Moment {
        let elapsed = offset.value(self.elapsed(side));
        Moment {
            time: self.time(side),
            back: side == 1,
            elapsed: if elapsed.rounded() < 0.0 { Pair::ZERO } else { elapsed },
            unit: unit_of_elapsed(self.ends[0].time, self.ends[1].time),
            until: self.time(side ^ 1),
            evaluations: offset.evaluations,
        }
    }

    /// The openness at `t`, at least 0, in units of a power of two, and the exponent of that.
    #[inline(never)]
    pub(crate) fn openness(&self, t: f32) -> (Pair, i32) {
        self.at_time(t).openness()
    }

    /// Where the ramp is at `t`, which lies on it: from the nearer end, by the exact time since.
    #[inline(always)]
    pub(crate) fn at_time(&self, t: f32) -> RampPoint<'_> {
        let [start, end] = [self.ends[0].time, self.ends[1].time];
        let t = if start < 0.0 && end > 0.0 { on_grid(start, end, t) } else { t };
        let (before, after) = (Pair::sum(t, -start), Pair::sum(end, -t));
        let (side, way) = if before.difference(after) > 0.0 { (1, after) } else { (0, before) };
        let target = way.shifted(-unit_of_elapsed(start, end));
        let offset = self.offset_at(side, target);
        RampPoint { ramp: self, side, offset }
    }

    /// The place at which a time has passed since the end that faces a side, in the ramp's unit.
    #[inline(always)]
    fn offset_at(&self, side: usize, target: Pair) -> Offset {
        let series = self.elapsed(side);
        let c @ [c1, c2, c3] = [series.c[0].hi, series.c[1].hi, series.last.hi];
        let mut anchor =
            Anchor { place: Pair::ZERO, back: 0, c, sought: target.hi, rounding: ROUNDING };
        // From where `t' = c1 + 2 c2 x + 3 c3 x²` is least, if time is slow there and the target near.
        let thrice = 3.0 * c3;
        if c2 < 0.0 && -c2 < thrice * ONE && (c1 - SLOW) * thrice < c2 * c2 {
            let slowest = -c2 / thrice;
            let sought = target.difference(series.at(slowest));
            if sought.abs() < target.hi {
                let [c1, c2, c3] = around(self.end(side).elapsed, self.cubic, slowest);
                let back = sought.to_bits() & 1 << 31;
                let c = [c1, flipped(c2, back), c3];
                anchor = Anchor {
                    place: Pair::new(slowest),
                    back,
                    c,
                    sought: sought.abs(),
                    rounding: ROUNDING,
                };
            }
        }
        let guess = guess(&anchor.c, anchor.sought);
        solve(series, target, &anchor, guess, [FOR_TIME * target.hi; 2])
    }
}

/// A number that is negative for what counts from the later end, as it is seen from a side: negative for the other end.
#[inline(always)]
const fn seen_from(side: usize, x: Pair) -> Pair {
    x.flipped((side as u32) << 31)
}

impl End {
    const fn new(time: f32, elapsed: &([Pair; 2], Pair), mass: &([Pair; 5], Pair)) -> Self {
        Self { time, elapsed: elapsed.0, mass: mass.0 }
    }
}

/// `t` rounded to half an ulp of the farther end of a ramp that runs across time 0: next to 0, `f32` are denser than a
/// search is exact.
#[inline(never)]
fn on_grid(start: f32, end: f32, t: f32) -> f32 {
    let half = 0.5 * power_of_two(exponent(if end > -start { end } else { -start }));
    if t.abs() >= half || t == start || t == end {
        return t;
    }
    // The sum is at most 2.5 half.
    let t = (t + 1.5 * half) - 1.5 * half;
    if t < start {
        start
    } else if t > end {
        end
    } else {
        t
    }
}

/// The factor from [`WHOLE`] to a ramp's own unit of mass, a power of two: in it the ramp has from 2⁸⁰ to 2⁸¹ (0 if it
/// is dark), so that all coefficients keep their bits.
#[inline(always)]
const fn unit_of_mass(share: Pair) -> f32 {
    power_of_two(up_of_mass(share))
}

/// The factor back.
#[inline(always)]
const fn per_unit_of_mass(share: Pair) -> f32 {
    power_of_two(-up_of_mass(share))
}

#[inline(always)]
const fn up_of_mass(share: Pair) -> i32 {
    let exponent = exponent(share.hi);
    80 - if exponent < -46 { -46 } else { exponent }
}

/// The exponent of a ramp's own unit of time: in it the ramp is [`LENGTH`] long, or up to twice that (or less, if its
/// length is subnormal).
#[inline(always)]
const fn unit_of_elapsed(start: f32, end: f32) -> i32 {
    exponent(end - start) - 64
}

/// Coefficients by powers of `p`, which runs from 0 to 1, as those by powers of the place, times `scale`; the last one
/// apart.
const fn in_places<const N: usize, const M: usize>(c: [f64; N], scale: f64) -> ([Pair; M], Pair) {
    const { assert!(M + 1 == N) };
    let mut scale = scale;
    let (mut pairs, mut last) = ([Pair::ZERO; M], Pair::ZERO);
    let mut k = 0;
    while k < N {
        scale /= ONE as f64;
        last = Pair::from_f64(c[k] * scale);
        if k < M {
            pairs[k] = last;
        }
        k += 1;
    }
    (pairs, last)
}

/// The coefficients around `x` in single precision, computed in pairs, because they may be differences of nearly equal
/// numbers.
#[cold]
#[inline(never)]
fn around([a, b]: [Pair; 2], c: Pair, x: f32) -> [f32; 3] {
    let x = Pair::new(x);
    let bend = c.thrice().times(x);
    let slope = bend.plus(b.scaled(2.0)).times(x).plus(a);
    [slope.rounded(), bend.plus(b).rounded(), c.hi]
}

/// A point of a ramp, found by its time.
pub(crate) struct RampPoint<'a> {
    ramp: &'a Ramp,
    pub(crate) side: usize,
    offset: Offset,
}

impl RampPoint<'_> {
    /// The fraction collected between the end that faces the side and here, in [`WHOLE`].
    #[inline(always)]
    pub(crate) fn mass(&self) -> Pair {
        self.offset.value(self.ramp.collected(self.side)).scaled(per_unit_of_mass(self.ramp.share))
    }

    /// A bound of the rounding error of [`mass`](Self::mass): see [`Series::at`].
    pub(crate) fn noise(&self) -> f32 {
        let c = self.ramp.single(self.side);
        let size = c.iter().rev().fold(0.0, |size, c| (size + c.abs()) * self.offset.x);
        size * per_unit_of_mass(self.ramp.share) / (1u64 << 40) as f32
    }

    /// The openness, at least 0, in units of a power of two, and the exponent of that.
    #[inline(always)]
    fn openness(&self) -> (Pair, i32) {
        let [f0, f1, f2, f3] = self.ramp.openness;
        let f = if self.side == 0 { [f0, f1, f2, f3] } else { [f3, f2, f1, f0] };
        // Scaled so that the second halves of all coefficients, and their products with the least place, keep their
        // bits.
        let unit = f.iter().fold(-127, |most, f| exponent(*f).max(most)) - 60;
        let f = f.map(|f| Pair::new(f).shifted(-unit).hi);
        let d = [Pair::sum(f[1], -f[0]), Pair::sum(f[2], -f[1]), Pair::sum(f[3], -f[2])];
        let bend = d[1].minus_loose(d[0]);
        let (one, two, three) = (1.0 / ONE, 1.0 / ONE / ONE, 1.0 / ONE / ONE / ONE);
        let c = [d[0].thrice().scaled(one), bend.thrice().scaled(two)];
        let series = Series { c: &c, last: d[2].minus_loose(d[1]).minus_loose(bend).scaled(three) };
        let value = Pair::new(f[0]).plus(self.offset.value(series));
        (if value.rounded() < 0.0 { Pair::ZERO } else { value }, unit)
    }
}
