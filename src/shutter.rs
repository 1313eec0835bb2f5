//! A shutter: opening ramp, plateau, closing ramp. What needs no timer can be asked here; `at` leads to the rest.

use core::fmt;

use crate::cdf;
use crate::error::{CurveError, Part, ScheduleError, tried};
use crate::fraction::Side;
use crate::inverse::Inverse;
use crate::ramp::bezier::CubicBezier;
use crate::rate::Hz;
use crate::trigger::ticks::direct_triggers;
use crate::trigger::timed::TimedCurve;

/// A shutter's openness over time: an opening cubic Bezier, a fully open plateau and a closing cubic Bezier.
///
/// # Rules
///
/// A constructor accepts a curve that keeps these rules. Otherwise it returns a [`CurveError`] that names the broken
/// rule.
///
/// 1. All numbers are finite, and `open_start <= open_end <= close_start <= close_end`. Each part, a ramp or the
///    plateau, may have zero length.
/// 2. On each ramp, the times of the inner control points lie between the ramp's ends. The first inner time may
///    exceed the second by at most 15/16 of the ramp's length. Every control point has an openness in [0, 1].
/// 3. Where two parts of non-zero length meet, the openness is 1.
/// 4. The interval from `open_start` to `close_end` is 2⁻⁶⁴ to 2⁶⁴ long. It is at least 2⁻¹⁶ of the larger of
///    `|open_start|` and `|close_end|`.
/// 5. Each part has zero length, or at least 2⁻²⁴ of the larger of `|open_start|` and `|close_end|`.
/// 6. The exposure of a [`density`](Self::density) is at least 2⁻²⁰ of its interval.
///
/// Lengths are compared in `f64`, so one that is too small by 2⁻⁵³ of itself may pass.
///
/// # Octaves
///
/// An *octave* is a range of fractions up to 1/2 whose end is twice its start; where it starts depends on the ramp.
/// Above 1/2 the same holds for `1 - u`. The curve has room for the polynomials of the widest octaves that lie on
/// ramps: `OCTAVES` below 1/2, and as many above. An octave has none if no candidate has a proven error bound.
/// Polynomials answer most fractions on ramps, and a search answers the rest.
///
/// With the default of 8, about one fraction in 400 of a typical curve needs a search. With 0, every fraction on a ramp
/// does. The promised accuracy is always the same. A curve takes 368 + 96 `OCTAVES` bytes. `OCTAVES` is at most 64.
/// Above 16, a constant may exceed the compiler's limit on constant evaluation.
#[derive(Clone, PartialEq)]
pub struct ShutterCurve<const OCTAVES: usize = 8> {
    pub(crate) inverse: Inverse<OCTAVES>,
}

impl ShutterCurve {
    /// Makes a shutter from its opening and its closing ramp.
    ///
    /// ```
    /// use shutter_curve::{CubicBezier, ShutterCurve};
    /// // Soft ramps of 2 ms. Control points are (time in ms, openness).
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
    /// Returns a [`CurveError`] if the ramps break a [rule](Self#rules).
    pub const fn new(opening: CubicBezier, closing: CubicBezier) -> Result<Self, CurveError> {
        Self::with_octaves(opening, closing)
    }

    /// Makes a shutter with straight ramps. It opens from `open_start` to `open_end` and closes from `close_start` to
    /// `close_end`.
    ///
    /// # Errors
    /// Returns a [`CurveError`] if the times break a [rule](Self#rules).
    pub const fn linear(open_start: f32, open_end: f32, close_start: f32, close_end: f32) -> Result<Self, CurveError> {
        Self::with_octaves(
            CubicBezier::line((open_start, 0.0), (open_end, 1.0)),
            CubicBezier::line((close_start, 1.0), (close_end, 0.0)),
        )
    }

    /// Makes a shutter from the arguments of RenderMan's `shutteropening`.
    ///
    /// The `times` are when the shutter starts to open, is fully open, starts to close, and is closed. The `inner`
    /// control points are `[t1, y1, t2, y2]` of the opening ramp and `[t5, y5, t6, y6]` of the closing one. Each `t` is
    /// a fraction of the *whole* interval, 0 at the first of the `times` and 1 at the last. Each `y` is an openness.
    /// A time that rounding put outside its ramp, by up to 2⁻²¹ of the greatest |time|, counts as the ramp's end.
    ///
    /// ```
    /// use shutter_curve::{CurveError, Part, ShutterCurve};
    /// // In ms. The opening ramp takes the first quarter of the interval: t1 and t2 are at most 0.25.
    /// let times = [0.0, 2.5, 7.5, 10.0];
    /// let curve = ShutterCurve::shutteropening(times, [0.1, 0.0, 0.15, 1.0, 0.85, 1.0, 0.9, 0.0])?;
    /// assert_eq!(curve.close_end(), 10.0);
    /// // Written as fractions of its own ramp, as in an easing curve, a `t` mostly lies outside the ramp.
    /// let error = ShutterCurve::shutteropening(times, [0.4, 0.0, 0.6, 1.0, 0.4, 1.0, 0.6, 0.0]);
    /// assert_eq!(error, Err(CurveError::FractionOutsideRamp { part: Part::Opening, point: 1 }));
    /// # Ok::<(), CurveError>(())
    /// ```
    ///
    /// # Errors
    /// Returns a [`CurveError`] if the arguments break a [rule](Self#rules). For an inner time outside its ramp, it is
    /// a [`FractionOutsideRamp`](CurveError::FractionOutsideRamp).
    pub const fn shutteropening(times: [f32; 4], inner: [f32; 8]) -> Result<Self, CurveError> {
        let (opening, closing) = CubicBezier::shutteropening(times, inner);
        // A last time that is not finite spoils the opening ramp's inner times, too, but the error is the closing
        // ramp's.
        if times[0].is_finite() && times[1].is_finite() && !times[3].is_finite() {
            return Err(CurveError::NotFinite(Part::Closing));
        }
        match Self::new(opening, closing) {
            Err(CurveError::TimeOutsideRamp { part, point }) => Err(CurveError::FractionOutsideRamp { part, point }),
            curve => curve,
        }
    }

    /// Makes a probability density from a single cubic Bezier, `(t(p), f(p))`. The Bezier becomes the opening ramp of a
    /// shutter whose closing ramp has zero length.
    ///
    /// If `f` exceeds 1, [scale](CubicBezier::scaled) it down first, preferably by a power of two, which is exact.
    /// Scaling does not change [`pdf`](Self::pdf), [`cdf`](Self::cdf) or [`inverse_cdf`](Self::inverse_cdf). The
    /// [`exposure`](Self::exposure) and the [`normalization`](Self::normalization) are those of the scaled Bezier.
    ///
    /// ```
    /// use shutter_curve::{CubicBezier, ShutterCurve};
    /// // f = 80 t for t from 0 to 1. The density is 2 t, so cdf = t².
    /// let line = CubicBezier::line((0.0, 0.0), (1.0, 80.0));
    /// let curve = ShutterCurve::density(line.scaled(1.0 / 128.0))?;
    /// assert_eq!(curve.pdf(0.5), 1.0);
    /// assert_eq!(curve.cdf(0.5), 0.25);
    /// assert_eq!(curve.inverse_cdf(0.25), 0.5);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    ///
    /// # Errors
    /// Returns a [`CurveError`] if the Bezier breaks a [rule](Self#rules).
    pub const fn density(density: CubicBezier) -> Result<Self, CurveError> {
        let [.., (end, _)] = density.points();
        match Self::new(density, CubicBezier::line((end, 0.0), (end, 0.0))) {
            Err(CurveError::OpennessOutOfRange { .. }) => Err(CurveError::DensityOutOfRange),
            curve => curve,
        }
    }
}

impl<const OCTAVES: usize> ShutterCurve<OCTAVES> {
    /// Makes a shutter from its ramps, like [`new`](ShutterCurve::new), with a chosen number of
    /// [octaves](Self#octaves). More octaves take more memory and leave fewer fractions to a search.
    ///
    /// ```
    /// use shutter_curve::{CubicBezier, ShutterCurve, expect};
    /// static SMALL: ShutterCurve<4> = expect!(ShutterCurve::with_octaves(
    ///     CubicBezier::line((0.0, 0.0), (1.0, 1.0)),
    ///     CubicBezier::line((1.0, 1.0), (2.0, 0.0)),
    /// ));
    /// assert_eq!(SMALL.inverse_cdf(0.125), 0.5);
    /// ```
    ///
    /// # Errors
    /// Returns a [`CurveError`] if the ramps break a [rule](Self#rules).
    pub const fn with_octaves(opening: CubicBezier, closing: CubicBezier) -> Result<Self, CurveError> {
        Ok(Self { inverse: tried!(Inverse::new(&opening, &closing)) })
    }

    /// The time at which the shutter starts to open.
    #[must_use]
    pub const fn open_start(&self) -> f32 {
        self.inverse.curve.end_time(Side::Start)
    }

    /// The time at which the shutter is fully open.
    #[must_use]
    pub const fn open_end(&self) -> f32 {
        self.inverse.curve.join_time(Side::Start)
    }

    /// The time at which the shutter starts to close.
    #[must_use]
    pub const fn close_start(&self) -> f32 {
        self.inverse.curve.join_time(Side::End)
    }

    /// The time at which the shutter is closed.
    #[must_use]
    pub const fn close_end(&self) -> f32 {
        self.inverse.curve.end_time(Side::End)
    }

    const fn times(&self) -> [f32; 4] {
        [self.open_start(), self.open_end(), self.close_start(), self.close_end()]
    }

    /// The openness at the time `t`, from 0 to 1. It is 0 before `open_start`, after `close_end`, and for NaN.
    ///
    /// ```
    /// use shutter_curve::ShutterCurve;
    /// // In ms. The exposure is 4 ms, so the fully open shutter collects a quarter of it in each ms.
    /// let curve = ShutterCurve::linear(0.0, 2.0, 4.0, 6.0)?;
    /// assert_eq!([1.0, 3.0, 5.0, 7.0].map(|t| curve.openness(t)), [0.5, 1.0, 0.5, 0.0]);
    /// assert_eq!([1.0, 3.0, 5.0, 7.0].map(|t| curve.pdf(t)), [0.125, 0.25, 0.125, 0.0]);
    /// assert_eq!([-1.0, 2.0, 3.0, 7.0].map(|t| curve.cdf(t)), [0.0, 0.25, 0.5, 1.0]);
    /// assert_eq!([-1.0, 0.5, 1.0].map(|u| curve.inverse_cdf(u)), [0.0, 3.0, 6.0]);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    #[must_use]
    pub fn openness(&self, t: f32) -> f32 {
        cdf::openness(&self.inverse.curve, t)
    }

    /// The probability density at the time `t`: the openness divided by the [`exposure`](Self::exposure). It is the
    /// fraction of the exposure that is collected per unit of time.
    #[must_use]
    pub fn pdf(&self, t: f32) -> f32 {
        cdf::pdf(&self.inverse.curve, t)
    }

    /// The fraction of the exposure that is collected by the time `t`. It is 0 before the shutter opens and for NaN,
    /// and 1 after the shutter has closed.
    #[must_use]
    pub fn cdf(&self, t: f32) -> f32 {
        cdf::cdf(&self.inverse.curve, t)
    }

    /// The time by which the fraction `u` of the exposure is collected.
    ///
    /// `u` is clamped to [0, 1], and NaN counts as 0. The time of 0 is `open_start`, and the time of 1 is `close_end`.
    /// A larger `u` never gives an earlier time.
    #[must_use]
    pub fn inverse_cdf(&self, u: f32) -> f32 {
        self.inverse.inverse_cdf(u)
    }

    /// The area under the curve, in its unit of time. A fully open shutter would collect the same light in this time.
    ///
    /// ```
    /// use shutter_curve::ShutterCurve;
    /// // In ms. Each ramp collects half of its length; there is no plateau.
    /// let curve = ShutterCurve::linear(0.0, 4.0, 4.0, 8.0)?;
    /// assert_eq!([curve.exposure(), curve.normalization(), curve.efficiency()], [4.0, 0.25, 0.5]);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    #[must_use]
    pub const fn exposure(&self) -> f32 {
        (1.0 / self.inverse.curve.per_area) as f32
    }

    /// The factor that turns openness into a probability density: 1 divided by the [`exposure`](Self::exposure).
    #[must_use]
    pub const fn normalization(&self) -> f32 {
        self.inverse.curve.per_area as f32
    }

    /// The shutter's efficiency, at most 1: the [`exposure`](Self::exposure) divided by the time from `open_start` to
    /// `close_end`.
    #[must_use]
    pub const fn efficiency(&self) -> f32 {
        (1.0 / (self.inverse.curve.per_area * (self.close_end() as f64 - self.open_start() as f64))) as f32
    }

    /// No frame of up to this many triggers needs a search. Computing each trigger then takes a short, bounded time. A
    /// larger frame may need none either. Pulses may need searches even in smaller frames.
    ///
    /// With 8 [octaves](Self#octaves), the number is 127 or more on most typical curves. Each further octave can almost
    /// double it, up to 2 796 202. It is 0 if the middle of the exposure lies on a ramp without a polynomial there, as
    /// with `OCTAVES = 0`. A frame of any size may then need searches.
    ///
    /// A constant can check the number at compile time:
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, expect};
    /// static SHUTTER: ShutterCurve = expect!(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// const _: () = assert!(SHUTTER.direct_triggers() >= 64);
    /// ```
    #[must_use]
    pub const fn direct_triggers(&self) -> u32 {
        direct_triggers(&self.inverse)
    }

    /// Puts the curve on a timer, as [`TimedCurve`] shows. The curve's times have to be in seconds.
    ///
    /// # Errors
    /// Returns a [`ScheduleError`] if the rate is 0, or if the curve has more than 2³¹ ticks at this rate.
    pub const fn at(&self, rate: Hz) -> Result<TimedCurve<'_, OCTAVES>, ScheduleError> {
        TimedCurve::new(&self.inverse, rate, self.exposure())
    }

    /// The number of search steps that [`inverse_cdf`](Self::inverse_cdf) takes for `u`; none if it needs no search.
    #[cfg(feature = "_measure")]
    #[must_use]
    pub fn steps(&self, u: f32) -> Option<u32> {
        self.inverse.steps(u)
    }
}

impl<const OCTAVES: usize> fmt::Debug for ShutterCurve<OCTAVES> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut out = out.debug_struct("ShutterCurve");
        out.field("times", &self.times()).field("exposure", &self.exposure()).finish_non_exhaustive()
    }
}

#[cfg(feature = "defmt")]
impl<const OCTAVES: usize> defmt::Format for ShutterCurve<OCTAVES> {
    fn format(&self, out: defmt::Formatter<'_>) {
        defmt::write!(out, "ShutterCurve {{ times: {}, exposure: {}, .. }}", self.times(), self.exposure());
    }
}
