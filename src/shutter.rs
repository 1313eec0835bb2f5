//! A shutter: opening ramp, plateau, closing ramp.

use core::fmt;

use crate::answer::plan::Plan;
use crate::error::{CurveError, Part, tried};
use crate::fraction::Side;
use crate::number::moment::rounded;
use crate::ramp::bezier::CubicBezier;

/// A shutter's openness over time, `0 <= f <= 1`: an opening cubic Bezier, a fully open plateau and a closing cubic
/// Bezier, taken as a probability density.
///
/// **What is accepted.** Everything else is a [`CurveError`] that names the part and the rule.
///
/// 1. All numbers are finite, and `open_start <= open_end <= close_start <= close_end`. Either ramp may have no length
///    (a box), and the plateau may have none (a triangle).
/// 2. Inner control times lie between their ramp's ends, and every openness in [0, 1]. Inner times may be out of order,
///    but the first may pass the second by at most 15/16 of the ramp.
/// 3. Ramps are fully open, at openness 1, where they meet the plateau or each other.
/// 4. The interval is 2⁻⁶⁴ to 2⁶⁴ long, and at least 2⁻¹⁶ of its greatest |time|.
/// 5. A ramp or a plateau has no length, or at least 2⁻²⁴ of the greatest |time|.
/// 6. The exposure of a [`density`](Self::density) is at least 2⁻²⁰ of its interval.
///
/// Times may be in any unit, the same throughout: those that go in, those that come out, and the exposure. The density
/// is per that unit, and a timer's rate is in ticks per that unit. **Seconds are recommended**: then that rate is in
/// Hz.
///
/// `OCTAVES` is the number of polynomials per half of the fractions [0, 1]; [`with_octaves`](Self::with_octaves) takes
/// another number than 8. The promised accuracy is the same for every number. With 8 at most one `u` in 256 of a
/// typical curve needs a search, with 0 every `u` on the ramps does. A curve takes 488 bytes, and 96 more for each of
/// `OCTAVES`. More than 64 do not compile, and beyond 16 a constant may exceed the compiler's limit on evaluation.
///
/// Fractions count from the nearer end. Down to half of a ramp's largest fraction the first polynomial answers, down to
/// a quarter the next one, and so on. Below the last one, and where the curve is too difficult for a polynomial, a
/// search answers.
#[derive(Clone, PartialEq)]
pub struct ShutterCurve<const OCTAVES: usize = 8> {
    pub(crate) plan: Plan<OCTAVES>,
}

impl ShutterCurve {
    /// The shutter with these ramps, with 8 octaves a side.
    ///
    /// ```
    /// use shutter_curve::{CubicBezier, ShutterCurve};
    /// // A soft edge of 2 ms at either end, control points as (time in ms, openness).
    /// let curve = ShutterCurve::new(
    ///     CubicBezier::new([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (2.0, 1.0)]),
    ///     CubicBezier::new([(8.0, 1.0), (9.0, 1.0), (9.0, 0.0), (10.0, 0.0)]),
    /// )?;
    /// assert_eq!(curve.openness(1.0), 0.5);
    /// assert_eq!(curve.exposure(), 8.0);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    ///
    /// # Errors
    /// As [`with_octaves`](Self::with_octaves).
    pub const fn new(opening: CubicBezier, closing: CubicBezier) -> Result<Self, CurveError> {
        Self::with_octaves(opening, closing)
    }

    /// The shutter that opens linearly from `open_start` to `open_end` and closes linearly from `close_start` to
    /// `close_end`, times in any unit. It is a trapezoid; a box if the ramps have no length; a triangle if the plateau
    /// has none.
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, valid};
    /// // 1/100 s from first light to last, of which the ramps take half: in seconds.
    /// static SHUTTER: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// assert_eq!(SHUTTER.exposure(), 0.0075);
    /// ```
    ///
    /// # Errors
    /// As [`with_octaves`](Self::with_octaves).
    pub const fn linear(
        open_start: f32,
        open_end: f32,
        close_start: f32,
        close_end: f32,
    ) -> Result<Self, CurveError> {
        Self::with_octaves(
            CubicBezier::line((open_start, 0.0), (open_end, 1.0)),
            CubicBezier::line((close_start, 1.0), (close_end, 0.0)),
        )
    }

    /// The shutter in the form of RenderMan's `shutteropening`. The `times`, in any unit, are when it starts to open,
    /// is fully open, starts to close and is closed. Its inner control points are `[t1, y1, t2, y2, t5, y5, t6, y6]`:
    /// their times are fractions of the *whole* interval, 0 at the first of the `times` and 1 at the last, on the
    /// closing ramp as well.
    ///
    /// ```
    /// use shutter_curve::{CurveError, Part, ShutterCurve};
    /// // In ms. The opening ramp takes the first quarter of the interval, so t1 and t2 are below 0.25.
    /// let times = [0.0, 2.5, 7.5, 10.0];
    /// let curve = ShutterCurve::shutteropening(times, [0.1, 0.0, 0.15, 1.0, 0.85, 1.0, 0.9, 0.0])?;
    /// assert_eq!(curve.close_end(), 10.0);
    /// // Fractions of each ramp, as an easing curve has them, are refused.
    /// let error = ShutterCurve::shutteropening(times, [0.4, 0.0, 0.6, 1.0, 0.4, 1.0, 0.6, 0.0]);
    /// assert_eq!(error, Err(CurveError::FractionOutsideRamp { part: Part::Opening, point: 1 }));
    /// # Ok::<(), CurveError>(())
    /// ```
    ///
    /// # Errors
    /// As [`with_octaves`](Self::with_octaves), but an inner time that is not on its ramp is a
    /// [`FractionOutsideRamp`](CurveError::FractionOutsideRamp).
    pub const fn shutteropening(times: [f32; 4], inner: [f32; 8]) -> Result<Self, CurveError> {
        let (opening, closing) = CubicBezier::shutteropening(times, inner);
        // A last time that is not finite spoils the opening ramp's inner times, too, but the error is the closing
        // ramp's.
        if times[0].is_finite() && times[1].is_finite() && !times[3].is_finite() {
            return Err(CurveError::NotFinite(Part::Closing));
        }
        match Self::new(opening, closing) {
            Err(CurveError::TimeOutsideRamp { part, point }) => {
                Err(CurveError::FractionOutsideRamp { part, point })
            }
            curve => curve,
        }
    }

    /// One Bezier `(t(p), f(p))` alone as a density: the opening ramp of a shutter whose closing ramp has no length.
    ///
    /// The density may have any scale: [`pdf`](Self::pdf), [`cdf`](Self::cdf) and [`inverse_cdf`](Self::inverse_cdf) do
    /// not depend on it. But `f` may not exceed 1, so scale a greater one first ([`scaled`](CubicBezier::scaled)), best
    /// by a power of two, which rounds nothing. Then [`normalization`](Self::normalization) is `K = 1 / ∫ f t' dp` of
    /// the scaled density.
    ///
    /// ```
    /// use shutter_curve::{CubicBezier, ShutterCurve};
    /// // f = 80 p and t = p: the density is 2 t, so cdf = t² and its inverse is √u.
    /// let density = CubicBezier::line((0.0, 0.0), (1.0, 80.0));
    /// let curve = ShutterCurve::density(density.scaled(1.0 / 128.0))?;
    /// assert_eq!(curve.pdf(0.5), 1.0);
    /// assert_eq!(curve.cdf(0.5), 0.25);
    /// assert_eq!(curve.inverse_cdf(0.25), 0.5);
    /// // K ∫ f t' dp = 1, where ∫ 80 p dp = 40.
    /// let k = curve.normalization() / 128.0;
    /// assert_eq!(k, 1.0 / 40.0);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    ///
    /// # Errors
    /// As [`with_octaves`](Self::with_octaves).
    pub const fn density(density: CubicBezier) -> Result<Self, CurveError> {
        let [.., (end, _)] = density.points();
        match Self::new(density, CubicBezier::line((end, 0.0), (end, 0.0))) {
            Err(CurveError::OpennessOutOfRange { point, .. }) => {
                Err(CurveError::DensityOutOfRange { point })
            }
            curve => curve,
        }
    }
}

impl<const OCTAVES: usize> ShutterCurve<OCTAVES> {
    /// The shutter with these ramps, with `OCTAVES` octaves a side.
    ///
    /// ```
    /// use shutter_curve::{CubicBezier, ShutterCurve, valid};
    /// static SMALL: ShutterCurve<4> = valid(ShutterCurve::with_octaves(
    ///     CubicBezier::line((0.0, 0.0), (1.0, 1.0)),
    ///     CubicBezier::line((1.0, 1.0), (2.0, 0.0)),
    /// ));
    /// assert_eq!(SMALL.inverse_cdf(0.125), 0.5);
    /// ```
    ///
    /// # Errors
    /// The first rule of [`ShutterCurve`]'s list that the ramps break.
    pub const fn with_octaves(
        opening: CubicBezier,
        closing: CubicBezier,
    ) -> Result<Self, CurveError> {
        Ok(Self { plan: tried!(Plan::new(&opening, &closing)) })
    }

    /// When the shutter starts to open, in the unit of the curve's times.
    ///
    /// ```
    /// use shutter_curve::ShutterCurve;
    /// // In ms.
    /// let curve = ShutterCurve::linear(1.0, 3.0, 7.0, 10.0)?;
    /// assert_eq!((curve.open_start(), curve.open_end()), (1.0, 3.0));
    /// assert_eq!((curve.close_start(), curve.close_end()), (7.0, 10.0));
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    #[must_use]
    pub const fn open_start(&self) -> f32 {
        self.plan.exposure.end(Side::Start)
    }

    /// When it is fully open, in the same unit; see [`open_start`](Self::open_start).
    #[must_use]
    pub const fn open_end(&self) -> f32 {
        self.plan.exposure.join(Side::Start)
    }

    /// When it starts to close, in the same unit; see [`open_start`](Self::open_start).
    #[must_use]
    pub const fn close_start(&self) -> f32 {
        self.plan.exposure.join(Side::End)
    }

    /// When it is closed, in the same unit; see [`open_start`](Self::open_start).
    #[must_use]
    pub const fn close_end(&self) -> f32 {
        self.plan.exposure.end(Side::End)
    }

    /// The openness `f` at the time `t`, in [0, 1]; 0 outside [`open_start`, `close_end`] and for NaN.
    ///
    /// ```
    /// use shutter_curve::ShutterCurve;
    /// let curve = ShutterCurve::linear(0.0, 3.0, 6.0, 9.0)?;
    /// assert_eq!([1.5, 4.5, 8.25, 9.5].map(|t| curve.openness(t)), [0.5, 1.0, 0.25, 0.0]);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    ///
    /// [`open_start`]: Self::open_start
    /// [`close_end`]: Self::close_end
    #[must_use]
    pub fn openness(&self, t: f32) -> f32 {
        rounded(self.plan.exposure.openness(t))
    }

    /// The normalised density at `t`, `openness(t)` over the [`exposure`](Self::exposure), in fractions of the exposure
    /// per unit of time.
    ///
    /// ```
    /// use shutter_curve::ShutterCurve;
    /// // In ms. The exposure is 4 ms, so the fully open shutter collects a quarter of it in each ms.
    /// let curve = ShutterCurve::linear(0.0, 2.0, 4.0, 6.0)?;
    /// assert_eq!([1.0, 3.0].map(|t| curve.pdf(t)), [0.125, 0.25]);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    #[must_use]
    pub fn pdf(&self, t: f32) -> f32 {
        self.plan.exposure.density(t)
    }

    /// The fraction of the exposure collected by the time `t`, from 0 to 1: 0 before the shutter opens and for NaN, 1
    /// after it has closed.
    ///
    /// ```
    /// use shutter_curve::ShutterCurve;
    /// let curve = ShutterCurve::linear(0.0, 2.0, 4.0, 6.0)?;
    /// assert_eq!([-1.0, 2.0, 3.0, 7.0].map(|t| curve.cdf(t)), [0.0, 0.25, 0.5, 1.0]);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    #[must_use]
    pub fn cdf(&self, t: f32) -> f32 {
        self.plan.exposure.cdf(t)
    }

    /// The time by which the fraction `u` of the exposure is collected, in the curve's unit.
    ///
    /// `u` is clamped to [0, 1], and NaN counts as 0. The answer lies in [`open_start`, `close_end`], and is exactly
    /// these for 0 and 1. It never steps back as `u` grows.
    ///
    /// On the plateau the formula is `t = open_end + A u - A₀`, where `A` is the [`exposure`](Self::exposure) and `A₀`
    /// the opening ramp's part of it. (The formula is sometimes written as `t = A u`, which holds only where `A₀`
    /// equals `open_end`.)
    ///
    /// ```
    /// # use shutter_curve::ShutterCurve;
    /// // A ramp of 0.2 has the area 0.1, and the whole is 0.1 + 0.5 + 0.15 = 0.75. Half of that is collected at 0.475,
    /// // not at 0.375.
    /// let curve = ShutterCurve::linear(0.0, 0.2, 0.7, 1.0)?;
    /// assert_eq!(curve.exposure(), 0.75);
    /// assert_eq!(curve.inverse_cdf(0.5), 0.475);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    ///
    /// [`open_start`]: Self::open_start
    /// [`close_end`]: Self::close_end
    #[must_use]
    pub fn inverse_cdf(&self, u: f32) -> f32 {
        self.plan.inverse_cdf(u)
    }

    /// The effective exposure time `A = ∫ f dt`, in the curve's unit. In that time a fully open shutter lets the same
    /// light through.
    ///
    /// ```
    /// use shutter_curve::ShutterCurve;
    /// // In ms: half of each ramp, and the plateau.
    /// let curve = ShutterCurve::linear(0.0, 2.0, 4.0, 6.0)?;
    /// assert_eq!(curve.exposure(), 4.0);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    #[must_use]
    pub const fn exposure(&self) -> f32 {
        self.plan.exposure.area as f32
    }

    /// `K = 1/A`, which makes the openness a probability density; per unit of the curve's time.
    ///
    /// ```
    /// use shutter_curve::ShutterCurve;
    /// let curve = ShutterCurve::linear(0.0, 2.0, 4.0, 6.0)?;
    /// assert_eq!(curve.normalization(), 0.25);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    #[must_use]
    pub const fn normalization(&self) -> f32 {
        (1.0 / self.plan.exposure.area) as f32
    }

    /// The shutter efficiency `A / (close_end - open_start)`, at most 1.
    ///
    /// ```
    /// use shutter_curve::ShutterCurve;
    /// let curve = ShutterCurve::linear(0.0, 2.0, 6.0, 8.0)?;
    /// assert_eq!(curve.efficiency(), 0.75);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    #[must_use]
    pub const fn efficiency(&self) -> f32 {
        (self.plan.exposure.area / (self.close_end() as f64 - self.open_start() as f64)) as f32
    }
}

/// The curve of a constructor, or a panic with the reason: in a `const` or `static`, a compile error.
///
/// ```
/// use shutter_curve::{valid, ShutterCurve};
/// static CURVE: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.25, 0.75, 1.0));
/// assert_eq!(CURVE.exposure(), 0.75);
/// ```
///
/// ```compile_fail
/// use shutter_curve::{valid, ShutterCurve};
/// // error[E0080]: evaluation panicked: times out of order: ...
/// static CURVE: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.75, 0.25, 1.0));
/// ```
///
/// # Panics
/// If `curve` is an error; meant for constants, where that stops the build.
#[track_caller]
pub const fn valid<const OCTAVES: usize>(
    curve: Result<ShutterCurve<OCTAVES>, CurveError>,
) -> ShutterCurve<OCTAVES> {
    match curve {
        Ok(curve) => curve,
        Err(error) => panic!("{}", error.message()),
    }
}

impl<const OCTAVES: usize> fmt::Debug for ShutterCurve<OCTAVES> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("ShutterCurve")
            .field("open_start", &self.open_start())
            .field("open_end", &self.open_end())
            .field("close_start", &self.close_start())
            .field("close_end", &self.close_end())
            .field("exposure", &self.exposure())
            .finish_non_exhaustive()
    }
}

#[cfg(feature = "defmt")]
impl<const OCTAVES: usize> defmt::Format for ShutterCurve<OCTAVES> {
    fn format(&self, out: defmt::Formatter<'_>) {
        defmt::write!(
            out,
            "ShutterCurve {{ open_start: {}, open_end: {}, close_start: {}, close_end: {}, exposure: {}, .. }}",
            self.open_start(),
            self.open_end(),
            self.close_start(),
            self.close_end(),
            self.exposure()
        );
    }
}
