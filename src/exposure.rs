//! The exposure: two ramps and the plateau between them, one area over all three, and the moment of a fraction.
//!
//! A fraction `a`, at most 1/2, is counted from the nearer end of the curve. It lies on the near ramp, on the plateau
//! or on the far ramp, and the part of it that is sought there is never more than `a`. So an error relative to that
//! part is no greater relative to `a`, even next to an end. A mirrored curve gives mirrored times, but for that of
//! 1/2, and where rounding meets a tie.

use crate::domain::{self, LEAST_EXPOSURE};
use crate::error::{CurveError, tried};
use crate::fraction::{Fraction, Side};
use crate::number::moment::Moment;
use crate::number::pair::{Pair, significand};
use crate::number::units::{WHOLE, WHOLE_EXPONENT};
use crate::ramp::Ramp;
use crate::ramp::bezier::CubicBezier;
use crate::ramp::shape::Shape;

/// The error of an inverse, relative to its fraction: a quarter of the least distance between neighbouring `f32`, which
/// so keep their order.
const INVERSE_ERROR: f32 = 1.0 / (1 << 26) as f32;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Exposure {
    ramps: [Ramp; 2],
    /// The plateau's fraction of the exposure, in [`WHOLE`].
    pub(crate) plateau: Pair,
    /// `A = ∫ f dt`
    pub(crate) area: f64,
}

/// What is sought of a fraction, in the section where it lies.
enum Sought<'a> {
    /// The fraction past the near ramp, in [`WHOLE`].
    Plateau(Pair),
    /// The fraction on a ramp, in [`WHOLE`].
    Ramp(&'a Ramp, Pair),
}

impl Exposure {
    /// Checks both ramps, and integrates them. Returns their shapes, too, since octaves are built from those. Out of
    /// line: all constructors share it.
    #[inline(never)]
    pub(crate) const fn new(opening: &CubicBezier, closing: &CubicBezier) -> Result<(Self, [Shape; 2]), CurveError> {
        tried!(domain::check(opening, closing));
        let ([start, _, _, open], [close, _, _, end]) = (opening.times(), closing.times());
        let plateau = close as f64 - open as f64;
        let shapes = [Shape::new(opening), Shape::new(closing)];
        let area = (shapes[0].area() + shapes[1].area()) + plateau;
        if area < LEAST_EXPOSURE * (end as f64 - start as f64) {
            return Err(CurveError::DensityTooSmall);
        }
        let ramps = [Ramp::new([start, open], &shapes[0], area), Ramp::new([close, end], &shapes[1], area)];
        let plateau = Pair::from_f64(plateau / area * WHOLE as f64);
        Ok((Self { ramps, plateau, area }, shapes))
    }

    pub(crate) const fn ramp(&self, side: Side) -> &Ramp {
        &self.ramps[side as usize]
    }

    /// The time of the curve's end at a side.
    pub(crate) const fn end_time(&self, side: Side) -> f32 {
        self.ramp(side).end_time(side)
    }

    /// The time of the join of the ramp at a side.
    pub(crate) const fn join_time(&self, side: Side) -> f32 {
        self.ramp(side).end_time(side.other())
    }

    /// The moment by which a fraction `a` has been collected. What is collected then differs from `a` by at most
    /// `INVERSE_ERROR · a`; where a search reaches its limit of evaluations there is no bound. Of 0, a
    /// negative number or NaN it is the end itself, though no light may fall there.
    pub(crate) const fn moment(&self, fraction: Fraction) -> Moment {
        let (side, a) = (fraction.side, fraction.get());
        if a <= 0.0 || a.is_nan() {
            return Moment::at(self.end_time(side));
        }
        match self.sought(fraction) {
            Sought::Plateau(past_near) => {
                // Where near ramp and `a` nearly cancel, `lo` may exceed `hi`. Then `lo · area` is rounded by 2⁻²⁴ of
                // itself, at most 2⁻⁴⁸ of `a`.
                let (area, exponent) = significand(self.area);
                Moment {
                    base: self.join_time(side),
                    back: side.is_end(),
                    way: past_near.times(area),
                    way_exponent: exponent - WHOLE_EXPONENT,
                    until: self.join_time(side.other()),
                }
            }
            Sought::Ramp(ramp, part) => {
                let error = INVERSE_ERROR * (a * WHOLE);
                ramp.moment(side, ramp.place_of_part(side, part, error).place)
            }
        }
    }

    /// The evaluations of the mass that a search for the moment of a fraction takes.
    #[cfg(feature = "_measure")]
    pub(crate) const fn evaluations(&self, fraction: Fraction) -> u32 {
        match self.sought(fraction) {
            Sought::Ramp(ramp, part) if fraction.get() > 0.0 => {
                let error = INVERSE_ERROR * (fraction.get() * WHOLE);
                ramp.place_of_part(fraction.side, part, error).evaluations
            }
            _ => 0,
        }
    }

    const fn sought(&self, fraction: Fraction) -> Sought<'_> {
        let (side, a_in_whole) = (fraction.side, Pair::new(fraction.get() * WHOLE));
        let near = self.ramp(side).share;
        let (ramp, part) = if a_in_whole.difference(near) < 0.0 {
            (side, a_in_whole)
        } else {
            let past_near = a_in_whole.minus_loose(near);
            let past_plateau = past_near.minus(self.plateau);
            if past_plateau.rounded() <= 0.0 {
                // On the plateau; or exactly at the join of the ramps, if there is none.
                return Sought::Plateau(past_near);
            }
            (side.other(), past_plateau)
        };
        // One address, or the search keeps the curve's and an index on the stack.
        Sought::Ramp(core::hint::black_box(self.ramp(ramp)), part)
    }

    /// The fractions at which the near ramp ends and the far ramp begins. Each is computed from the lesser of the two
    /// parts into which it divides the exposure. So without a plateau both are one number.
    #[inline(never)]
    pub(crate) const fn join_fractions(&self, side: Side) -> [f64; 2] {
        let near = self.ramp(side).share.to_f64() / WHOLE as f64;
        let plateau = self.plateau.to_f64() / WHOLE as f64;
        let far = self.ramp(side.other()).share.to_f64() / WHOLE as f64;
        [
            if near < 0.5 { near } else { 1.0 - (plateau + far) },
            if near + plateau < 0.5 { near + plateau } else { 1.0 - far },
        ]
    }
}
