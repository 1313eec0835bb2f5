//! From a time: the openness, the density, and the cdf.
//!
//! A cdf is the mass collected until the place at which the time is reached, counted from the nearer end of the curve, as
//! the inverse counts. So it loses some 2⁻³⁹ of the lesser of the fraction and its rest, and times next to each other are
//! farther apart than that: it never steps back.

use crate::exposure::Exposure;
use crate::fraction::Side::{self, End, Start};
use crate::number::moment::rounded;
use crate::number::pair::{Pair, significand};
use crate::number::units::{WHOLE, WHOLE_EXPONENT, exponent, power_of_two};

/// Where a time lies on the curve.
enum At {
    Outside,
    Plateau,
    /// On the ramp at a side.
    Ramp(Side),
}

impl Exposure {
    /// The time `t`. On a curve across time 0, where `f32` are denser than a measurement is exact, it is rounded to a
    /// multiple of 1/4, 1/2 or 1 ulp of the end that is farther from 0.
    #[inline]
    fn on_grid(&self, t: f32) -> f32 {
        let [start, end] = [self.end(Start), self.end(End)];
        if start < 0.0 && end > 0.0 && t > start && t < end { gridded(start, end, t) } else { t }
    }

    #[inline]
    fn at(&self, t: f32) -> At {
        let [start, end] = [self.end(Start), self.end(End)];
        let [open, close] = [self.join(Start), self.join(End)];
        if t < open {
            if t >= start { At::Ramp(Start) } else { At::Outside }
        } else if t > close {
            if t <= end { At::Ramp(End) } else { At::Outside }
        } else if t.is_nan() {
            At::Outside
        } else if open < close {
            At::Plateau
        } else {
            // The join of both ramps is on the opening one, if that has length.
            At::Ramp(Side::end_if(start == open))
        }
    }

    /// The openness at `t`, at least 0, in units of a power of two, and the exponent of that.
    #[inline]
    pub(crate) fn openness(&self, t: f32) -> (Pair, i32) {
        let t = self.on_grid(t);
        match self.at(t) {
            At::Outside => (Pair::ZERO, 0),
            At::Plateau => (Pair::new(1.0), 0),
            At::Ramp(ramp) => self.ramp(ramp).openness_at(t),
        }
    }

    /// `K f` at `t`.
    #[inline]
    pub(crate) fn density(&self, t: f32) -> f32 {
        let (f, unit) = self.openness(t);
        let (area, exponent) = significand(self.area);
        rounded((f.over(area), unit - exponent))
    }

    /// The fraction of the exposure collected by `t`.
    #[inline]
    pub(crate) fn cdf(&self, t: f32) -> f32 {
        let t = self.on_grid(t);
        match self.at(t) {
            At::Outside if t > self.end(End) => 1.0,
            At::Outside => 0.0,
            At::Plateau => self.cdf_on_plateau(t),
            At::Ramp(ramp) => self.cdf_on_ramp(ramp, t),
        }
    }

    // Out of line: the code for ramps then saves no registers for this.
    #[inline(never)]
    fn cdf_on_plateau(&self, t: f32) -> f32 {
        let (area, exponent) = significand(self.area);
        nearer(|side| {
            let join = self.join(side);
            let way = if side.is(Start) { Pair::sum(t, -join) } else { Pair::sum(join, -t) };
            // Scaled first: a quotient of a subnormal way has too few bits.
            let way = way.shifted(WHOLE_EXPONENT - exponent);
            self.ramp(side).share.plus(way.over(area))
        })
    }

    #[inline(never)]
    fn cdf_on_ramp(&self, ramp: Side, t: f32) -> f32 {
        let point = self.ramp(ramp).at_time(t);
        nearer(|side| {
            let part = point.mass(side);
            if ramp.is(side) { part } else { self.ramp(side).share.plus(self.plateau).plus(part) }
        })
    }
}

/// The fraction collected, by the mass from the nearer end, in [`WHOLE`].
#[inline(always)]
fn nearer(mass: impl Fn(Side) -> Pair) -> f32 {
    let from_start = mass(Start).rounded();
    let fraction = if from_start < 0.5 * WHOLE {
        from_start.max(0.0)
    } else {
        Pair::new(WHOLE).minus(mass(End)).rounded().clamp(0.5 * WHOLE, WHOLE)
    };
    fraction / WHOLE
}

/// [`Exposure::on_grid`] between two ends, one on either side of time 0.
#[inline(never)]
const fn gridded(start: f32, end: f32, t: f32) -> f32 {
    let half = 0.5 * power_of_two(exponent(if end > -start { end } else { -start }));
    if t.abs() >= half {
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
