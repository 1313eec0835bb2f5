//! A curve as it is integrated: two ramps and the plateau between them, one area over all three, and the time of a
//! fraction.
//!
//! A fraction `a`, at most 1/2, is counted from the nearer end of the curve. It lies on the near ramp, on the plateau
//! or on the far ramp. A mirrored curve gives mirrored times, but for that of 1/2, and for what rounding down does.

use crate::domain::{self, LEAST_EXPOSURE};
use crate::error::{CurveError, tried};
use crate::fixed::{ONE, Units, clamped, fixed_down, fixed_towards_0, product};
use crate::fraction::{Fraction, Side};
use crate::ramp::Ramp;
use crate::ramp::bezier::CubicBezier;
use crate::ramp::shape::area;
use crate::search::LEAST_ERROR;

/// A search rounds its fraction to the nearest multiple of `2^-GRID`: every `f32` from 2⁻²³ on is one.
const GRID: u32 = 46;
/// A search ends where mass and fraction differ by at most `fraction / 2^ERROR_SHIFT + LEAST_ERROR`: so neighbouring
/// fractions keep their order (proofs/search.py).
const ERROR_SHIFT: u32 = 27;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Curve {
    ramps: [Ramp; 2],
    /// One over the area, `A = ∫ f dt`.
    pub(crate) per_area: f64,
    /// The plateau's line, in units: its time continued to `u = 0`, and its slope, the area.
    pub(crate) line_base: i64,
    pub(crate) line_slope: i64,
    pub(crate) units: Units,
}

impl Curve {
    /// Checks both ramps, and integrates them. Out of line: all constructors share it.
    #[inline(never)]
    pub(crate) const fn new(opening: &CubicBezier, closing: &CubicBezier) -> Result<Self, CurveError> {
        tried!(domain::check(opening, closing));
        let ([start, _, _, open], [close, _, _, end]) = (opening.times(), closing.times());
        let plateau_time = close as f64 - open as f64;
        let areas = [area(opening), area(closing)];
        let whole_area = (areas[0] + areas[1]) + plateau_time;
        // Only a density can be so dim: other curves have 1/20 of their interval (`domain`).
        if whole_area < LEAST_EXPOSURE * (end as f64 - start as f64) {
            return Err(CurveError::DensityTooSmall);
        }
        let opening_mass = fixed_towards_0(areas[0] / whole_area, -62);
        // Without a plateau the ramps meet, so no mass may be left between them.
        let closing_mass =
            if plateau_time > 0.0 { fixed_towards_0(areas[1] / whole_area, -62) } else { ONE - opening_mass };
        let (units, per_area) = (Units::new(start, end), 1.0 / whole_area);
        let ramps =
            [Ramp::new(opening, per_area, opening_mass, units), Ramp::new(closing, per_area, closing_mass, units)];
        // The line at u = 0 and at u = 1, as if the shutter opened and closed in no time, with the same exposure. From
        // u = 1/512 on an ulp of `u` is 2⁻³² or more. A curve with a plateau has 1/20 of its interval (`domain`), so
        // the slope is 2⁴⁵ / 20 units or more, and an ulp takes 2⁸ units or more. The line is off by a few, and by what
        // an `f64` rounds of the areas (proofs/domain.py).
        let line_base = units.of(open) - fixed_towards_0(areas[0], units.exponent());
        let line_slope = units.of(close) + fixed_towards_0(areas[1], units.exponent()) - line_base;
        Ok(Self { ramps, per_area, line_base, line_slope, units })
    }

    pub(crate) const fn ramp(&self, side: Side) -> &Ramp {
        &self.ramps[side as usize]
    }

    /// The mass of the plateau.
    pub(crate) const fn plateau_mass(&self) -> i64 {
        ONE - self.ramps[0].whole - self.ramps[1].whole
    }

    /// The time of the curve's end at a side.
    pub(crate) const fn end_time(&self, side: Side) -> f32 {
        self.ramp(side).end_time(side)
    }

    /// The time of the join of the ramp at a side.
    pub(crate) const fn join_time(&self, side: Side) -> f32 {
        self.ramp(side).end_time(side.other())
    }

    /// A time in units, rounded down.
    #[inline(never)]
    pub(crate) const fn in_units(&self, time: f32) -> i64 {
        self.units.of(time)
    }

    /// The time by which a fraction `a` has been collected, in units; and the steps of a search. Of 0, a negative
    /// number or NaN it is the end itself, even if the curve is dark there.
    ///
    /// The mass at that time differs from `a` by less than half an ulp, or 2⁻⁴⁶ below 2⁻²³ (proofs/search.py adds up
    /// the grid, the error, what a measurement is low by, what is cut of coefficients, and what an `f64` rounds of
    /// them).
    #[inline(always)]
    pub(crate) const fn time_units(&self, fraction: Fraction) -> (i64, u32) {
        let (side, a) = (fraction.side, fraction.get());
        // In half steps of the grid, then to the nearest step; in 2⁻⁶².
        let mass = if a > 0.0 { ((fixed_down(a, -1 - GRID as i32) + 1) >> 1) << (62 - GRID) } else { 0 };
        let error = (mass >> ERROR_SHIFT) + LEAST_ERROR;
        let after_near = mass - self.ramp(side).whole;
        let after_plateau = after_near - self.plateau_mass();
        let (ramp, mass) = if after_near < 0 {
            (side, mass)
        } else if after_plateau < 0 {
            // Only up to `LINE_FROM`, where the line would be too coarse: from the join, in units.
            let [join, until] = [self.in_units(self.join_time(side)), self.in_units(self.join_time(side.other()))];
            // mass / 2⁶² · area, as twice both over 2⁶⁴.
            let way = product(after_near << 1, (self.line_slope as u64) << 1);
            return (side.inwards(join, clamped(way, (until - join).abs())), 0);
        } else {
            (side.other(), after_plateau)
        };
        // Through `black_box` the ramp is one address. Else the search keeps the curve's and an index on the stack.
        core::hint::black_box(self.ramp(ramp)).time_of_mass(side, mass, error, self.units)
    }

    /// The fractions at which the near ramp ends and the far ramp begins.
    #[inline(never)]
    pub(crate) const fn join_fractions(&self, side: Side) -> [f64; 2] {
        let near = self.ramp(side).whole;
        [near as f64 / ONE as f64, (near + self.plateau_mass()) as f64 / ONE as f64]
    }
}
