//! The exposure: a ramp, a plateau and a ramp, with one area over all three; its exact inverse, its cdf and its
//! openness.
//!
//! Fractions of the exposure are counted from the nearer end of the curve: from side 0, the earlier end, `a = u`; from
//! side 1, the later end, back in time, `a = 1 - u`, which is exact for `u >= 1/2`. The ramp at that end is the *near*
//! ramp, the other one the *far* ramp. A fraction `a` of at most 1/2 lies on the near ramp, on the plateau, or on the
//! far ramp, and what is sought there is never more than `a`. So an error relative to what is sought is as small
//! relative to `a`. A mirrored curve gives mirrored times.

use crate::bezier::CubicBezier;
use crate::error::{CurveError, Part};
use crate::moment::Moment;
use crate::pair::{Pair, power_of_two, rounded_sum};
use crate::ramp::{Ramp, RampPoint, WHOLE, WHOLE_EXPONENT};
use crate::shape::Shape;

/// The error of a search for an `f32` fraction, relative to it: a quarter of the least distance between neighbours, so
/// that these keep their order.
pub(crate) const FOR_FRACTION: f32 = 1.0 / (1 << 26) as f32;
/// For a fraction with more bits, as ticks have them, and where a `cdf` is settled.
pub(crate) const FOR_TICK: f32 = 1.0 / (1u64 << 40) as f32;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Exposure {
    ramps: [Ramp; 2],
    /// The plateau's fraction of the exposure, in [`WHOLE`].
    plateau: Pair,
    /// `A = ∫ f dt`
    pub(crate) area: f64,
}

/// Where a fraction is collected.
enum Section {
    Plateau(Moment),
    /// On a ramp, with what is to be collected there, in [`WHOLE`].
    Ramp(usize, Pair),
}

/// Where a time lies on the curve.
enum At {
    Outside,
    Plateau,
    /// On a ramp, by its index.
    Ramp(usize),
}

impl Exposure {
    /// The exposure of two ramps with an openness of at most `most`. Errors call the first one `part`. Out of line, so
    /// that all constructors that are called at run time share it.
    #[inline(never)]
    pub(crate) const fn new(
        opening: &CubicBezier,
        closing: &CubicBezier,
        part: Part,
        most: f64,
    ) -> Result<Self, CurveError> {
        if let Err(error) = opening.check_finite(part) {
            return Err(error);
        }
        if let Err(error) = closing.check_finite(Part::Closing) {
            return Err(error);
        }
        let [start, _, _, open] = opening.times();
        let [close, _, _, end] = closing.times();
        if !(start <= open && open <= close && close <= end) {
            return Err(CurveError::TimesOutOfOrder);
        }
        if start == end {
            return Err(CurveError::IntervalUnresolved);
        }
        const LONGEST: f64 = 18446744073709551616.0; // 2⁶⁴
        let length = end as f64 - start as f64;
        if !(length >= 1.0 / LONGEST && length <= LONGEST) {
            return Err(CurveError::IntervalOutOfRange);
        }
        if let Err(error) = opening.check_ramp(part, most) {
            return Err(error);
        }
        if let Err(error) = closing.check_ramp(Part::Closing, most) {
            return Err(error);
        }
        let plateau = close as f64 - open as f64;
        let area = (Shape::new(opening).mass() + Shape::new(closing).mass()) + plateau;
        if area <= 0.0 {
            return Err(CurveError::ZeroArea);
        }
        if !((area as f32).is_normal() && ((1.0 / area) as f32).is_normal()) {
            return Err(CurveError::AreaOutOfRange);
        }
        let ramps = [Ramp::new(opening, area), Ramp::new(closing, area)];
        let plateau = Pair::from_f64(plateau / area * WHOLE as f64);
        Ok(Self { ramps, plateau, area })
    }

    /// A ramp by its index, which is 0 or 1: that the compiler sees it spares a check that could panic.
    #[inline(always)]
    const fn ramp(&self, index: usize) -> &Ramp {
        &self.ramps[index & 1]
    }

    /// The time from which a side counts.
    pub(crate) const fn start(&self, side: usize) -> f32 {
        self.ramp(side).time(side)
    }

    /// The time at which the plateau begins, seen from a side.
    pub(crate) const fn plateau_start(&self, side: usize) -> f32 {
        self.ramp(side).time(side ^ 1)
    }

    /// The fractions at which the near ramp ends and the far ramp begins. Each is told by the lesser part of the exposure,
    /// which has more bits below 1; so without a plateau both are one number.
    pub(crate) const fn exact_joins(&self, side: usize) -> [f64; 2] {
        let near = self.ramp(side).share.to_f64() / WHOLE as f64;
        let plateau = self.plateau.to_f64() / WHOLE as f64;
        let far = self.ramp(side ^ 1).share.to_f64() / WHOLE as f64;
        [
            if near < 0.5 { near } else { 1.0 - (plateau + far) },
            if near + plateau < 0.5 { near + plateau } else { 1.0 - far },
        ]
    }

    /// The same, but 1/2 within a [`trace`](Self::trace) of that.
    pub(crate) const fn joins(&self, side: usize) -> [f64; 2] {
        const fn traced(x: f64, trace: u64) -> f64 {
            let is_half = (x - 0.5).abs() < trace as f64 / 18446744073709551616.0;
            if is_half { 0.5 } else { x }
        }
        let [near, far] = self.exact_joins(side);
        [traced(near, self.trace()), traced(far, self.trace())]
    }

    /// The same from side 0 in units of 2⁻⁶⁴, to 2⁻⁵⁵ and 2⁻⁴⁵ of the lesser part; the greatest is all ones.
    pub(crate) const fn joins_u64(&self) -> [u64; 2] {
        const fn words(x: Pair, trace: u64) -> u64 {
            if x.hi >= WHOLE {
                return u64::MAX;
            }
            // The upper word, and the rest in its unit, which the pair's second half may bring to about 2⁷.
            let x = x.scaled(power_of_two(32 - WHOLE_EXPONENT));
            let upper = x.hi as u32;
            let rest = (x.hi - upper as f32) + x.lo;
            let rest = ((rest * power_of_two(23)) as i32 as i64) << 9;
            let words = ((upper as u64) << 32).wrapping_add(rest as u64);
            if words.abs_diff(1 << 63) < trace { 1 << 63 } else { words }
        }
        let [near, far] = [self.ramps[0].share, self.ramps[1].share];
        let (until, rest) = (near.plus(self.plateau), far.plus(self.plateau));
        let is_less = [near.hi < 0.5 * WHOLE, until.hi < 0.5 * WHOLE];
        let joins = [
            words(if is_less[0] { near } else { rest }, self.trace()),
            words(if is_less[1] { until } else { far }, self.trace()),
        ];
        [
            if is_less[0] { joins[0] } else { (!joins[0]).saturating_add(1) },
            if is_less[1] { joins[1] } else { (!joins[1]).saturating_add(1) },
        ]
    }

    pub(crate) const fn has_plateau(&self) -> bool {
        self.plateau.hi > 0.0
    }

    /// How near to 1/2 a join counts as 1/2, in units of 2⁻⁶⁴. The joins of a symmetric curve are there except for the
    /// rounding of pairs, 2⁻⁴⁴. Without a plateau, what is beyond the join is within 2⁻²³, four ulp: the polynomial of
    /// the near ramp serves it, too, and has a second certificate along the far ramp ([`fit`](crate::fit)).
    const fn trace(&self) -> u64 {
        if self.has_plateau() { 1 << 20 } else { 1 << 41 }
    }

    /// The section in which a fraction is collected, counted from a side in [`WHOLE`].
    #[inline(always)]
    const fn section(&self, side: usize, a: Pair) -> Section {
        let near = self.ramp(side).share;
        if a.difference(near) < 0.0 {
            return Section::Ramp(side, a);
        }
        let past_near = a.minus_loose(near);
        let past_plateau = past_near.minus(self.plateau);
        if past_plateau.rounded() > 0.0 {
            return Section::Ramp(side ^ 1, past_plateau);
        }
        let (time, until) = (self.plateau_start(side), self.plateau_start(side ^ 1));
        let (area, exponent) = significand(self.area);
        let unit = exponent - WHOLE_EXPONENT;
        Section::Plateau(Moment::on_way(time, until, side == 1, past_near.times(area), unit))
    }

    /// The moment at which a fraction has been collected from a side, in [`WHOLE`], within an `error` relative to it.
    #[inline(always)]
    pub(crate) fn at_fraction(&self, side: usize, a: Pair, error: f32) -> Moment {
        match self.section(side, a) {
            Section::Plateau(moment) => moment,
            Section::Ramp(ramp, target) => {
                // One address instead of the curve's and an index, which the search would keep on the stack.
                let ramp = core::hint::black_box(self.ramp(ramp));
                ramp.at_mass(side, target, [error * a.hi, FOR_FRACTION * a.hi])
            }
        }
    }

    /// What an error in time is relative to: the time itself, or, if the curve runs across time 0, its farther end; but
    /// at most the interval, since ticks are counted from its start.
    #[inline(never)]
    pub(crate) const fn size_of_time(&self, side: usize, elapsed: f64) -> f32 {
        let [start, end] = [self.start(0), self.start(1)];
        let time = if side == 0 { start as f64 + elapsed } else { end as f64 - elapsed };
        let size = if !(start < 0.0 && end > 0.0) {
            (time as f32).abs()
        } else if end > -start {
            end
        } else {
            -start
        };
        if size < end - start { size } else { end - start }
    }

    /// Where `t` lies.
    #[inline]
    fn at(&self, t: f32) -> At {
        let [start, end] = [self.start(0), self.start(1)];
        let [open, close] = [self.plateau_start(0), self.plateau_start(1)];
        // An instant that is a plateau without length belongs to a ramp that has length.
        let plateau = open < close;
        if !(t >= start && t <= end) {
            At::Outside
        } else if t < open || (t == open && !plateau && start < open) {
            At::Ramp(0)
        } else if plateau && t <= close {
            At::Plateau
        } else {
            At::Ramp(1)
        }
    }

    /// The openness at `t`, at least 0, in units of a power of two, and the exponent of that.
    #[inline]
    pub(crate) fn openness(&self, t: f32) -> (Pair, i32) {
        match self.at(t) {
            At::Outside => (Pair::ZERO, 0),
            At::Plateau => (Pair::new(1.0), 0),
            At::Ramp(ramp) => self.ramp(ramp).openness(t),
        }
    }

    /// `K f` for an openness `f` in units of `2^unit`.
    #[inline]
    pub(crate) fn density(&self, (f, unit): (Pair, i32)) -> f32 {
        let (area, exponent) = significand(self.area);
        rounded_sum(0.0, f.over(area), unit - exponent, false)
    }

    /// The fraction collected by `t`.
    #[inline]
    pub(crate) fn cdf(&self, t: f32) -> f32 {
        match self.at(t) {
            At::Outside => {
                if t > self.start(1) {
                    1.0
                } else {
                    0.0
                }
            }
            At::Plateau => self.cdf_on_plateau(t),
            At::Ramp(ramp) => self.cdf_on_ramp(ramp, t),
        }
    }

    /// The same on the plateau. Out of line, so that a ramp's way saves no registers for it.
    #[inline(never)]
    fn cdf_on_plateau(&self, t: f32) -> f32 {
        let (area, exponent) = significand(self.area);
        // Scaled first: the way may be subnormal, and a quotient of that has too few bits.
        let way = Pair::sum(t, -self.plateau_start(0)).shifted(WHOLE_EXPONENT - exponent);
        self.nearest(t, self.ramps[0].share.plus(way.over(area)), 0.0, None)
    }

    /// The same on a ramp.
    #[inline(never)]
    fn cdf_on_ramp(&self, ramp: usize, t: f32) -> f32 {
        let on = self.ramp(ramp).at_time(t);
        let part = on.mass();
        // From the start of the ramp, or back from its end. What the part leaves of a share may be little.
        let little = LITTLE * part.hi;
        let (mass, little) = match (ramp, on.side) {
            (0, 0) => (part, 0.0),
            (0, _) => (self.ramps[0].share.minus(part), little),
            (_, 0) => (self.ramps[0].share.plus(self.plateau).plus(part), 0.0),
            _ => (Pair::new(WHOLE).minus(part), little),
        };
        self.nearest(t, mass, little, Some(on))
    }

    /// The `f32` nearest to the mass that `t` has, as a fraction.
    #[inline(always)]
    fn nearest(&self, t: f32, mass: Pair, little: f32, on: Option<RampPoint>) -> f32 {
        if mass.rounded() <= little {
            return self.nearest_to_little(t, mass, on);
        }
        self.neighbour(t, mass, on, false)
    }

    /// The same for a little mass, or none.
    #[cold]
    #[inline(never)]
    fn nearest_to_little(&self, t: f32, mass: Pair, on: Option<RampPoint>) -> f32 {
        if mass.rounded() <= 0.0 { 0.0 } else { self.neighbour(t, mass, on, true) }
    }

    /// The nearest of the two `f32` around a mass.
    #[inline(always)]
    fn neighbour(&self, t: f32, mass: Pair, on: Option<RampPoint>, is_little: bool) -> f32 {
        let nearest = mass.rounded();
        // How far the mass is from the middle between the nearest `f32` and the next one on the mass's side.
        let rest = (mass.hi - nearest) + mass.lo;
        let bits = nearest.to_bits();
        let next = f32::from_bits(if rest < 0.0 { bits - 1 } else { bits + 1 });
        let distance = (0.5 * (next - nearest) - rest).abs();
        let nearest = if is_little || distance < nearest * NEAR_MIDDLE {
            self.settled(t, nearest, next, distance, on)
        } else {
            nearest
        };
        if nearest < WHOLE { nearest / WHOLE } else { 1.0 }
    }

    /// Which of two neighbouring `f32` is the cdf, if the mass is so near to their middle that pairs cannot tell.
    ///
    /// The middle has exactly one time, which the inverse finds. Times before that get the lesser neighbour, all others
    /// the greater one. So the cdf does not step back, not even where next to no light falls and neighbouring times
    /// have the same mass except for its rounding. If the mass is farther from the middle than `noise`, both ways
    /// agree.
    #[cold]
    #[inline(never)]
    fn settled(
        &self,
        t: f32,
        nearest: f32,
        next: f32,
        distance: f32,
        on: Option<RampPoint>,
    ) -> f32 {
        // The search for the middle is itself not exact.
        let noise = on.map_or(0.0, |on| 2.0 * on.noise()) + 2.0 * FOR_TICK * nearest;
        if distance > noise {
            return nearest;
        }
        let middle = Pair::sum(nearest, 0.5 * (next - nearest));
        // The side by the lesser neighbour, so that both ask for the same time.
        let least = if next < nearest { next } else { nearest };
        let (side, a) =
            if least < 0.5 * WHOLE { (0, middle) } else { (1, Pair::new(WHOLE).minus(middle)) };
        let is_later = t >= self.at_fraction(side, a, FOR_TICK).time();
        if is_later == (next > nearest) { next } else { nearest }
    }
}

/// A mass may be what a measured part leaves of a ramp's share. If the mass is more than this fraction of the part, the
/// part's noise, relative to the mass, is at most four times what it is relative to the part.
const LITTLE: f32 = 0.25;

/// Nearer than this to the middle of two `f32`, relative to them, pairs may not tell on which side of it a mass is: the
/// noise of a measured part is below 2⁻³⁰ of it (see the text of the module `solve`), and so below this of the mass.
const NEAR_MIDDLE: f32 = 1.0 / (1 << 28) as f32;

/// A normal `x` above 0 as a number in [1, 2), to 47 bits, and the exponent of its unit.
#[inline(always)]
pub(crate) const fn significand(x: f64) -> (Pair, i32) {
    const UNIT: f32 = 1.0 / (1u64 << 47) as f32;
    let bits = x.to_bits();
    let hi = f32::from_bits(127 << 23 | (bits >> 29) as u32 & 0x7F_FFFF);
    let lo = (bits as u32 >> 5 & 0xFF_FFFF) as f32 * UNIT;
    (Pair { hi, lo }, (bits >> 52) as i32 - 1023)
}
