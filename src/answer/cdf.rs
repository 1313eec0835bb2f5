//! From a time: the openness, the density, and the cdf.
//!
//! A cdf is the mass collected until the place at which the time is reached. It is measured from the curve's start, so
//! masses are added and nothing cancels. Where the noise of that measurement reaches the middle of two `f32`, the
//! inverse's time of the middle decides. So the cdf never steps back: docs/internals/proofs.md has the argument.

use crate::exposure::{CDF_ERROR, Exposure};
use crate::fraction::Side::{self, End, Start};
use crate::number::moment::rounded;
use crate::number::pair::{Pair, significand};
use crate::number::units::{DARK, WHOLE, WHOLE_EXPONENT};

/// Where a time lies on the curve.
enum At {
    Outside,
    Plateau,
    /// On the ramp at a side.
    Ramp(Side),
}

impl Exposure {
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
        match self.at(t) {
            At::Outside => (Pair::ZERO, 0),
            At::Plateau => (Pair::new(1.0), 0),
            At::Ramp(ramp) => self.ramp(ramp).openness_at(t),
        }
    }

    /// `K f` for an openness `f` in units of `2^unit`.
    #[inline]
    pub(crate) fn density(&self, (f, unit): (Pair, i32)) -> f32 {
        let (area, exponent) = significand(self.area);
        rounded((f.over(area), unit - exponent))
    }

    /// The fraction of the exposure collected by `t`.
    #[inline]
    pub(crate) fn cdf(&self, t: f32) -> f32 {
        // Asked again: `on_grid` may move a time onto a join, and `at` may count that to the plateau or other ramp.
        let t = match self.at(t) {
            At::Ramp(ramp) => self.ramp(ramp).on_grid(t),
            _ => t,
        };
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
        // Scaled first: a quotient of a subnormal way has too few bits.
        let way = Pair::sum(t, -self.join(Start)).shifted(WHOLE_EXPONENT - exponent);
        // No noise: the mass is off by a few 2⁻⁴³ of itself, and `nearest` adds 2 CDF_ERROR = 2⁻³⁹ anyway.
        self.nearest(t, self.ramps[0].share.plus(way.over(area)), |_| 0.0)
    }

    #[inline(never)]
    fn cdf_on_ramp(&self, ramp: Side, t: f32) -> f32 {
        let point = self.ramp(ramp).at_time(t);
        let part = point.mass();
        let mass =
            if ramp.is(Start) { part } else { self.ramps[0].share.plus(self.plateau).plus(part) };
        self.nearest(t, mass, |side| point.noise(side))
    }

    /// The `f32` nearest to a measured `mass`, in [`WHOLE`]. If the middle of two `f32` is within the noise, the
    /// inverse's time of it decides: the lesser `f32` for a `t` before that, else the greater. (A subnormal answer is
    /// rounded once more.)
    ///
    /// `noise` bounds the errors of a measurement on a ramp and of an inverse there, given the side from which the
    /// inverse counts. Added here are 2⁻⁴⁰ of the mass for the search, and as much for sums of pairs.
    #[inline(always)]
    fn nearest(&self, t: f32, mass: Pair, noise: impl Fn(Side) -> f32) -> f32 {
        let nearest = mass.rounded();
        // 0 as an `f32`, and no inverse is asked: its search would bisect for so little.
        if nearest < DARK {
            return 0.0;
        }
        // mass = nearest + rest, and the middle is nearest + half; half has the sign of rest.
        let rest = (mass.hi - nearest) + mass.lo;
        let next =
            f32::from_bits(nearest.to_bits().wrapping_add_signed(if rest < 0.0 { -1 } else { 1 }));
        let (lesser, greater) = if next < nearest { (next, nearest) } else { (nearest, next) };
        let side = Side::end_if(lesser >= 0.5 * WHOLE);
        let half = 0.5 * (next - nearest);
        // Told by the measurement alone: the middle is beyond the noise. Else the inverse's time settles it.
        let is_told = (half - rest).abs() > noise(side) + 2.0 * CDF_ERROR * nearest;
        let cdf = if is_told {
            nearest
        } else if t >= self.time_of(side, Pair::sum(nearest, half)) {
            greater
        } else {
            lesser
        };
        if cdf < WHOLE { cdf / WHOLE } else { 1.0 }
    }

    /// The time by which a mass from the start, in [`WHOLE`], has been collected. The inverse counts from `side`.
    #[cold]
    #[inline(never)]
    fn time_of(&self, side: Side, mass: Pair) -> f32 {
        let a = if side.is(Start) { mass } else { Pair::new(WHOLE).minus(mass) };
        self.at_fraction(side, a, CDF_ERROR).time()
    }
}
