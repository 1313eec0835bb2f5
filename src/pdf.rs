//! One Bezier as a probability density.

use core::fmt;

use crate::bezier::CubicBezier;
use crate::doubles;
use crate::error::{CurveError, Part};
use crate::plan::Plan;

/// One cubic Bezier taken as a probability density over time: any non-negative scale of `f`, and any unit of time, the
/// same for what goes in and what comes out.
///
/// `cdf(p) = K ∫ f t' dp` and `K = 1 / ∫₀¹ f t' dp`, in closed form.
///
/// ```
/// use shutter_curve::{BezierPdf, CubicBezier};
/// let ramp = CubicBezier::line((0.0, 0.0), (1.0, 3.0));
/// let pdf = BezierPdf::new(ramp)?;
/// assert_eq!(pdf.area(), 1.5);
/// assert_eq!(pdf.pdf(0.5), 1.0);
/// assert_eq!(pdf.cdf(0.5), 0.25);
/// assert_eq!(pdf.inverse_cdf(0.25), 0.5);
/// # Ok::<(), shutter_curve::CurveError>(())
/// ```
///
/// `CELLS` is as in [`ShutterCurve`](crate::ShutterCurve), and so are the accuracy and the treatment of
/// bad input.
#[derive(Clone, Copy, PartialEq)]
pub struct BezierPdf<const CELLS: usize = 8> {
    /// The curve as the opening ramp; plateau and closing ramp have no length.
    plan: Plan<CELLS>,
}

impl BezierPdf {
    /// The density of `curve`, with 8 octaves a side.
    ///
    /// ```
    /// use shutter_curve::{BezierPdf, CubicBezier};
    /// // A flash of 3 ms that dies away, in any unit of light.
    /// let flash = BezierPdf::new(CubicBezier::line((0.0, 80.0), (3.0, 0.0)))?;
    /// assert_eq!(flash.area(), 120.0);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    ///
    /// # Errors
    /// As [`with_cells`](Self::with_cells).
    pub const fn new(curve: CubicBezier) -> Result<Self, CurveError> {
        Self::with_cells(curve)
    }
}

impl<const CELLS: usize> BezierPdf<CELLS> {
    /// The density of `curve`, with `CELLS` octaves a side.
    ///
    /// ```
    /// use shutter_curve::{BezierPdf, CubicBezier, valid};
    /// static SMALL: BezierPdf<4> =
    ///     valid(BezierPdf::with_cells(CubicBezier::line((0.0, 0.0), (1.0, 1.0))));
    /// assert_eq!(SMALL.inverse_cdf(0.25), 0.5);
    /// ```
    ///
    /// # Errors
    /// A coordinate that is not finite; time that runs back; a negative density; an interval without length, or outside
    /// [2⁻⁶⁴, 2⁶⁴]; an area that is 0, or whose reciprocal `f32` cannot hold.
    pub const fn with_cells(curve: CubicBezier) -> Result<Self, CurveError> {
        let end = curve.points()[3].0;
        let end = if end.is_finite() { end } else { 0.0 };
        let nothing = CubicBezier::new([(end, 0.0); 4]);
        match Plan::new(&curve, &nothing, Part::Single, f64::INFINITY) {
            Ok(plan) => Ok(Self { plan }),
            Err(error) => Err(error),
        }
    }

    /// The normalised density at the time `t`, in fractions per unit of time; 0 outside the curve and for NaN.
    ///
    /// ```
    /// use shutter_curve::{BezierPdf, CubicBezier};
    /// let ramp = BezierPdf::new(CubicBezier::line((0.0, 0.0), (2.0, 3.0)))?;
    /// assert_eq!([1.0, 2.0, 2.5].map(|t| ramp.pdf(t)), [0.5, 1.0, 0.0]);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    pub fn pdf(&self, t: f32) -> f32 {
        self.plan.exposure.density(self.plan.exposure.openness(t))
    }

    /// The fraction of the area before `t`: 0 before the curve and for NaN, 1 after.
    ///
    /// ```
    /// use shutter_curve::{BezierPdf, CubicBezier};
    /// let ramp = BezierPdf::new(CubicBezier::line((0.0, 0.0), (2.0, 3.0)))?;
    /// assert_eq!([1.0, 2.0, 2.5].map(|t| ramp.cdf(t)), [0.25, 1.0, 1.0]);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    pub fn cdf(&self, t: f32) -> f32 {
        self.plan.cdf(t)
    }

    /// The time `t` with `cdf(t) = u`, in the curve's unit; `u` is clamped to [0, 1], and NaN counts as 0.
    ///
    /// ```
    /// use shutter_curve::{BezierPdf, CubicBezier};
    /// let ramp = BezierPdf::new(CubicBezier::line((0.0, 0.0), (2.0, 3.0)))?;
    /// assert_eq!([0.0, 0.25, 1.0].map(|u| ramp.inverse_cdf(u)), [0.0, 1.0, 2.0]);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    pub fn inverse_cdf(&self, u: f32) -> f32 {
        doubles::inverse_cdf(&self.plan, u)
    }

    /// `∫ f dt`, before normalisation: `f` times the curve's unit of time.
    ///
    /// ```
    /// use shutter_curve::{BezierPdf, CubicBezier};
    /// let ramp = BezierPdf::new(CubicBezier::line((0.0, 0.0), (2.0, 4.0)))?;
    /// assert_eq!((ramp.area(), ramp.normalization()), (4.0, 0.25));
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    pub const fn area(&self) -> f32 {
        self.plan.exposure.area as f32
    }

    /// `K`, the reciprocal of the [`area`](Self::area), in its unit.
    pub const fn normalization(&self) -> f32 {
        (1.0 / self.plan.exposure.area) as f32
    }
}

impl<const CELLS: usize> fmt::Debug for BezierPdf<CELLS> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("BezierPdf")
            .field("start", &self.plan.exposure.outer(0))
            .field("end", &self.plan.exposure.outer(1))
            .field("area", &self.area())
            .finish_non_exhaustive()
    }
}

#[cfg(feature = "defmt")]
impl<const CELLS: usize> defmt::Format for BezierPdf<CELLS> {
    fn format(&self, out: defmt::Formatter<'_>) {
        let (start, end) = (self.plan.exposure.outer(0), self.plan.exposure.outer(1));
        defmt::write!(
            out,
            "BezierPdf {{ start: {}, end: {}, area: {}, .. }}",
            start,
            end,
            self.area()
        );
    }
}
