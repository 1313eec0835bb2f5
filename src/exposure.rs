//! The exposure: a ramp, a plateau and a ramp, with one area over all three, and the inverse, to 2⁻²⁶ or 2⁻⁴⁰.
//!
//! Fractions of the exposure are counted from the nearer end of the curve: from side 0, the earlier end, `a = u`; from
//! side 1, the later end, back in time, `a = 1 - u`, which is exact for `u >= 1/2`. The ramp at that end is the *near*
//! ramp, the other one the *far* ramp; of a ramp, the end of the curve is the *outer* end, the one at the plateau the
//! *inner* end. A fraction `a` of at most 1/2 lies on the near ramp, on the plateau, or on the far ramp, and what is
//! sought there is never more than `a`. So what measuring loses, relative to what is sought, is as little relative to `a`,
//! and so is the error that is asked for. A mirrored curve gives mirrored times.

use crate::error::{CurveError, Part};
use crate::fraction::Side;
use crate::number::moment::Moment;
use crate::number::pair::{Pair, significand};
use crate::number::units::{DOUBLE_WORD, WHOLE, WHOLE_EXPONENT};
use crate::ramp::Ramp;
use crate::ramp::bezier::CubicBezier;
use crate::ramp::shape::{Shape, check_finite, check_ramp};

/// The error of a search for an `f32` fraction, relative to it: a quarter of the least distance between neighbours, so
/// that these keep their order.
pub(crate) const INVERSE_ERROR: f32 = 1.0 / (1 << 26) as f32;
/// For a fraction with more bits, as ticks have them, and where a `cdf` is settled.
pub(crate) const CDF_ERROR: f32 = 1.0 / (1u64 << 40) as f32;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Exposure {
    pub(crate) ramps: [Ramp; 2],
    /// The plateau's fraction of the exposure, in [`WHOLE`].
    pub(crate) plateau: Pair,
    /// `A = ∫ f dt`
    pub(crate) area: f64,
}

/// Where a fraction is collected.
enum Section {
    Plateau(Moment),
    /// On a ramp, with what is to be collected there, in [`WHOLE`].
    Ramp(Side, Pair),
}

impl Exposure {
    /// The exposure of two ramps and what is between them. Out of line, so that all constructors that are called at run
    /// time share it.
    #[inline(never)]
    pub(crate) const fn new(
        opening: &CubicBezier,
        closing: &CubicBezier,
    ) -> Result<Self, CurveError> {
        if let Err(error) = check_finite(opening, Part::Opening) {
            return Err(error);
        }
        if let Err(error) = check_finite(closing, Part::Closing) {
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
        let length = end as f64 - start as f64;
        if !(length >= 1.0 / DOUBLE_WORD && length <= DOUBLE_WORD) {
            return Err(CurveError::IntervalOutOfRange);
        }
        if let Err(error) = check_ramp(opening, Part::Opening) {
            return Err(error);
        }
        if let Err(error) = check_ramp(closing, Part::Closing) {
            return Err(error);
        }
        let plateau = close as f64 - open as f64;
        let area = (Shape::new(opening).area() + Shape::new(closing).area()) + plateau;
        if area <= 0.0 {
            return Err(CurveError::ZeroArea);
        }
        // It is at most as great as an interval, so only too small; the reciprocal of a normal one is normal, too.
        if !(area as f32).is_normal() {
            return Err(CurveError::AreaOutOfRange);
        }
        let ramps = [Ramp::new(opening, area), Ramp::new(closing, area)];
        let plateau = Pair::from_f64(plateau / area * WHOLE as f64);
        Ok(Self { ramps, plateau, area })
    }

    /// A ramp by its index, which is 0 or 1: that the compiler sees it spares a check that could panic.
    #[inline(always)]
    pub(crate) const fn ramp(&self, side: Side) -> &Ramp {
        &self.ramps[side as usize]
    }

    /// The time of the curve's end at a side, from which that side counts.
    pub(crate) const fn end(&self, side: Side) -> f32 {
        self.ramp(side).time(side)
    }

    /// The time at which the ramp at a side meets the plateau.
    pub(crate) const fn join(&self, side: Side) -> f32 {
        self.ramp(side).time(side.other())
    }

    pub(crate) const fn has_plateau(&self) -> bool {
        self.plateau.hi > 0.0
    }

    /// The moment at which the fraction `a`, in [`WHOLE`], has been collected, counted from a side; with an `error`
    /// relative to it.
    #[inline(always)]
    pub(crate) const fn at_fraction(&self, side: Side, a: Pair, error: f32) -> Moment {
        match self.section(side, a) {
            Section::Plateau(moment) => moment,
            Section::Ramp(ramp, target) => {
                // One address instead of the curve's and an index, which the search would keep on the stack.
                let ramp = core::hint::black_box(self.ramp(ramp));
                // Wanted; and accepted where the step is less than an ulp.
                ramp.at_mass(side, target, [error * a.hi, INVERSE_ERROR * a.hi])
            }
        }
    }

    /// The section in which a fraction is collected, counted from a side in [`WHOLE`].
    #[inline(always)]
    const fn section(&self, side: Side, a: Pair) -> Section {
        let near = self.ramp(side).share;
        if a.difference(near) < 0.0 {
            return Section::Ramp(side, a);
        }
        // If the two nearly cancel, the second number may be the greater one. Multiplied below, it is rounded to 2⁻²⁴
        // of itself, which is some 2⁻⁴⁸ of `a`. No script proves that.
        let past_near = a.minus_loose(near);
        let past_plateau = past_near.minus(self.plateau);
        if past_plateau.rounded() > 0.0 {
            return Section::Ramp(side.other(), past_plateau);
        }
        let (base, until) = (self.join(side), self.join(side.other()));
        let (area, exponent) = significand(self.area);
        let (way, unit) = (past_near.times(area), exponent - WHOLE_EXPONENT);
        Section::Plateau(Moment { base, until, back: side.is_end(), way, unit, evaluations: 0 })
    }

    /// The fractions at which the near ramp ends and the far ramp begins. Each join divides the exposure, and is
    /// computed from the lesser of the two parts, which has more bits. So without a plateau both are one number.
    #[inline(never)]
    pub(crate) const fn joins(&self, side: Side) -> [f64; 2] {
        let near = self.ramp(side).share.to_f64() / WHOLE as f64;
        let plateau = self.plateau.to_f64() / WHOLE as f64;
        let far = self.ramp(side.other()).share.to_f64() / WHOLE as f64;
        [
            if near < 0.5 { near } else { 1.0 - (plateau + far) },
            if near + plateau < 0.5 { near + plateau } else { 1.0 - far },
        ]
    }
}
