//! A shutter: opening ramp, plateau, closing ramp. All that can be asked of it stands here.

use core::fmt;

use crate::cdf;
use crate::error::{CurveError, Part, ScheduleError, tried};
use crate::fraction::Side;
use crate::inverse::Inverse;
use crate::ramp::bezier::CubicBezier;
use crate::trigger::iterator::{PulseTicks, TriggerTicks};
use crate::trigger::pulse::{Pulse, PulseLimits, Pulses};
use crate::trigger::ticks::{MOST_TRIGGERS, Ticks, direct_triggers};

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
/// 5. Each part has zero length, or at least 2⁻²⁴ of that larger number.
/// 6. The exposure of a [`density`](Self::density) is at least 2⁻²⁰ of its interval.
///
/// # Octaves
///
/// Up to `u` = 1/2, an *octave* is a range of fractions over which `u` doubles: 1/4 to 1/2, 1/8 to 1/4, and so on.
/// Above 1/2 the same holds for `1 - u`. The curve stores a polynomial for each of the widest octaves that lie on a
/// ramp: up to `OCTAVES` of them below 1/2, and as many above. They answer most fractions, and a search answers the
/// rest.
///
/// With the default of 8, about one fraction in 400 of a typical curve needs a search. With 0, every fraction on a ramp
/// does. The promised accuracy is always the same. A curve takes 376 + 96 `OCTAVES` bytes. `OCTAVES` is at most 64.
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
    /// ```
    /// use shutter_curve::ShutterCurve;
    /// // In ms. Each ramp collects half of what the open shutter would: 1.25 + 5 + 1.25.
    /// let curve = ShutterCurve::linear(0.0, 2.5, 7.5, 10.0)?;
    /// assert_eq!(curve.exposure(), 7.5);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
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
    ///
    /// ```
    /// use shutter_curve::{CurveError, Part, ShutterCurve};
    /// // In ms. The opening ramp takes the first quarter of the interval: t1 and t2 are at most 0.25.
    /// let times = [0.0, 2.5, 7.5, 10.0];
    /// let curve = ShutterCurve::shutteropening(times, [0.1, 0.0, 0.15, 1.0, 0.85, 1.0, 0.9, 0.0])?;
    /// assert_eq!(curve.close_end(), 10.0);
    /// // Fractions of each ramp, as in an easing curve, are refused.
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
    /// // f = 80 t for t from 0 to 1. The density is 2 t, so that cdf = t².
    /// let line = CubicBezier::line((0.0, 0.0), (1.0, 80.0));
    /// let curve = ShutterCurve::density(line.scaled(1.0 / 128.0))?;
    /// assert_eq!(curve.pdf(0.5), 1.0);
    /// assert_eq!(curve.cdf(0.5), 0.25);
    /// assert_eq!(curve.inverse_cdf(0.25), 0.5);
    /// // The area under f is 40.
    /// assert_eq!(curve.exposure() * 128.0, 40.0);
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
    /// use shutter_curve::{CubicBezier, ShutterCurve, expect_valid};
    /// static SMALL: ShutterCurve<4> = expect_valid(ShutterCurve::with_octaves(
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
        self.inverse.exposure.end_time(Side::Start)
    }

    /// The time at which the shutter is fully open.
    #[must_use]
    pub const fn open_end(&self) -> f32 {
        self.inverse.exposure.join_time(Side::Start)
    }

    /// The time at which the shutter starts to close.
    #[must_use]
    pub const fn close_start(&self) -> f32 {
        self.inverse.exposure.join_time(Side::End)
    }

    /// The time at which the shutter is closed.
    #[must_use]
    pub const fn close_end(&self) -> f32 {
        self.inverse.exposure.end_time(Side::End)
    }

    /// The openness at the time `t`, from 0 to 1. It is 0 before `open_start`, after `close_end`, and for NaN.
    ///
    /// ```
    /// use shutter_curve::ShutterCurve;
    /// let curve = ShutterCurve::linear(0.0, 3.0, 6.0, 9.0)?;
    /// assert_eq!([1.5, 4.5, 8.25, 9.5].map(|t| curve.openness(t)), [0.5, 1.0, 0.25, 0.0]);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    #[must_use]
    pub fn openness(&self, t: f32) -> f32 {
        cdf::openness(&self.inverse.exposure, t)
    }

    /// The probability density at the time `t`: the openness divided by the [`exposure`](Self::exposure). It is the
    /// fraction of the exposure that is collected per unit of time.
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
        cdf::pdf(&self.inverse.exposure, t)
    }

    /// The fraction of the exposure that is collected by the time `t`. It is 0 before the shutter opens and for NaN,
    /// and 1 after the shutter has closed.
    ///
    /// ```
    /// use shutter_curve::ShutterCurve;
    /// let curve = ShutterCurve::linear(0.0, 2.0, 4.0, 6.0)?;
    /// assert_eq!([-1.0, 2.0, 3.0, 7.0].map(|t| curve.cdf(t)), [0.0, 0.25, 0.5, 1.0]);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    #[must_use]
    pub fn cdf(&self, t: f32) -> f32 {
        cdf::cdf(&self.inverse.exposure, t)
    }

    /// The time by which the fraction `u` of the exposure is collected.
    ///
    /// `u` is clamped to [0, 1], and NaN counts as 0. The time of 0 is `open_start`, and the time of 1 is `close_end`.
    /// A larger `u` never gives an earlier time.
    ///
    /// ```
    /// use shutter_curve::ShutterCurve;
    /// // The ramps and the plateau collect 0.1 + 0.5 + 0.15 = 0.75. Half of that is collected by 0.475.
    /// let curve = ShutterCurve::linear(0.0, 0.2, 0.7, 1.0)?;
    /// assert_eq!(curve.exposure(), 0.75);
    /// assert_eq!(curve.inverse_cdf(0.5), 0.475);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    #[must_use]
    pub fn inverse_cdf(&self, u: f32) -> f32 {
        self.inverse.inverse_cdf(u)
    }

    /// The area under the curve, in its unit of time. A fully open shutter would collect the same light in this time.
    ///
    /// ```
    /// use shutter_curve::ShutterCurve;
    /// // In ms: half of each ramp, and no plateau.
    /// let curve = ShutterCurve::linear(0.0, 4.0, 4.0, 8.0)?;
    /// assert_eq!([curve.exposure(), curve.normalization(), curve.efficiency()], [4.0, 0.25, 0.5]);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    #[must_use]
    pub const fn exposure(&self) -> f32 {
        self.inverse.exposure.area as f32
    }

    /// The factor that turns openness into a probability density: 1 divided by the [`exposure`](Self::exposure).
    #[must_use]
    pub const fn normalization(&self) -> f32 {
        (1.0 / self.inverse.exposure.area) as f32
    }

    /// The shutter's efficiency, at most 1: the [`exposure`](Self::exposure) divided by the time from `open_start` to
    /// `close_end`.
    #[must_use]
    pub const fn efficiency(&self) -> f32 {
        (self.inverse.exposure.area / (self.close_end() as f64 - self.open_start() as f64)) as f32
    }

    /// The largest number of triggers that a frame can have without a search. Computing each trigger then takes a
    /// short, bounded time. Pulses may need searches even in smaller frames.
    ///
    /// With 8 [octaves](Self#octaves), the number is 127 or more on most typical curves. Each further octave can almost
    /// double it, up to 2²². The number is 0 on curves that are too difficult for polynomials. With `OCTAVES = 0` it is
    /// also 0 if the middle of the exposure lies on a ramp.
    ///
    /// A constant can check the number at compile time:
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, expect_valid};
    /// static SHUTTER: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// const _: () = assert!(SHUTTER.direct_triggers() >= 64);
    /// ```
    ///
    /// On the same curve, 4096 triggers would need searches. This does not compile:
    ///
    /// ```compile_fail,E0080
    /// # use shutter_curve::{ShutterCurve, expect_valid};
    /// # static SHUTTER: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// const _: () = assert!(SHUTTER.direct_triggers() >= 4096);
    /// ```
    #[must_use]
    pub const fn direct_triggers(&self) -> u32 {
        direct_triggers(&self.inverse)
    }

    /// The ticks of a frame of `n` triggers, as an iterator. It does not check gaps; [`ticks_into`](Self::ticks_into)
    /// does.
    ///
    /// The triggers divide the exposure into equal shares, and each is in the middle of its share: trigger `i` is at
    /// the fraction `u = (2i + 1) / 2n`. Ticks count from [`open_start`](Self::open_start) and never decrease. Add your
    /// timer's count at that moment, with `wrapping_add`.
    ///
    /// `timer_hz` is your timer's rate, in Hz for a curve in seconds. The crate cannot detect a wrong rate.
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, expect_valid};
    /// // A shutter that opens in no time, closes 8 ms later in no time, and a 1 MHz timer.
    /// let curve: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.0, 0.008, 0.008));
    /// assert!(curve.trigger_ticks(4, 1_000_000)?.eq([1000, 3000, 5000, 7000]));
    /// # Ok::<(), shutter_curve::ScheduleError>(())
    /// ```
    ///
    /// If a typical curve has at most 2²⁴ ticks, each tick is within 0.85 tick of the exact time. On longer curves the
    /// error can be many ticks: 8 were seen at 2²⁹ ticks, and 32 at 2³¹. [`accuracy`](crate::accuracy) has a promise
    /// for every curve.
    ///
    /// # Errors
    /// Returns a [`ScheduleError`] if the rate is 0, if the curve has more than 2³¹ ticks at this rate, or if `n` is
    /// above 2²².
    pub const fn trigger_ticks(&self, n: u32, timer_hz: u32) -> Result<TriggerTicks<'_, OCTAVES>, ScheduleError> {
        let frame = tried!(Ticks::new(&self.inverse, n, timer_hz));
        Ok(TriggerTicks { frame, left: 0..n })
    }

    /// Fills `ticks` with the ticks of a frame, as [`trigger_ticks`](Self::trigger_ticks) returns them. Checks that the
    /// triggers are at least `min_gap` ticks apart. If `min_gap` is 0, triggers may share a tick.
    ///
    /// ```
    /// use shutter_curve::{ScheduleError, ShutterCurve, expect_valid};
    /// static SHUTTER: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// let mut ticks = [0; 5];
    /// SHUTTER.ticks_into(&mut ticks, 1_000_000, 1_000)?;
    /// assert_eq!(ticks, [1936, 3500, 5000, 6500, 8064]);
    /// // Sixteen triggers are too close for a gap of 1 ms.
    /// let error = SHUTTER.ticks_into(&mut [0; 16], 1_000_000, 1_000).unwrap_err();
    /// assert_eq!(error, ScheduleError::GapTooSmall { trigger: 1, gap: 792, min_gap: 1_000 });
    /// # Ok::<(), ScheduleError>(())
    /// ```
    ///
    /// # Errors
    /// Returns a [`ScheduleError`] if a gap is too small. The slice then holds part of the frame. Also returns the
    /// errors of [`trigger_ticks`](Self::trigger_ticks), and then leaves the slice unchanged.
    pub const fn ticks_into(&self, ticks: &mut [u32], timer_hz: u32, min_gap: u32) -> Result<(), ScheduleError> {
        if ticks.len() > MOST_TRIGGERS as usize {
            return Err(ScheduleError::TooManyTriggers { max: MOST_TRIGGERS });
        }
        let frame = tried!(Ticks::new(&self.inverse, ticks.len() as u32, timer_hz));
        frame.ticks_into(ticks, min_gap)
    }

    /// The ticks of a frame of `N` triggers as an array, checked like [`ticks_into`](Self::ticks_into). In a constant,
    /// the check happens at compile time.
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, expect_valid};
    /// static SHUTTER: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// const TICKS: [u32; 5] = match SHUTTER.ticks(1_000_000, 1_000) {
    ///     Ok(ticks) => ticks,
    ///     Err(error) => panic!("{}", error.message()),
    /// };
    /// assert_eq!(TICKS, [1936, 3500, 5000, 6500, 8064]);
    /// ```
    ///
    /// # Errors
    /// Returns the errors of [`ticks_into`](Self::ticks_into).
    pub const fn ticks<const N: usize>(&self, timer_hz: u32, min_gap: u32) -> Result<[u32; N], ScheduleError> {
        let mut ticks = [0; N];
        tried!(self.ticks_into(&mut ticks, timer_hz, min_gap));
        Ok(ticks)
    }

    /// The ticks of a frame of `n` triggers in a `heapless::Vec`, checked like [`ticks_into`](Self::ticks_into). This
    /// needs the feature `heapless-v0_9`.
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, expect_valid};
    /// let curve: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// let ticks: heapless::Vec<u32, 16> = curve.ticks_vec(5, 1_000_000, 1_000)?;
    /// assert_eq!(ticks, [1936, 3500, 5000, 6500, 8064]);
    /// # Ok::<(), shutter_curve::ScheduleError>(())
    /// ```
    ///
    /// # Errors
    /// Returns a [`ScheduleError`] if `n` is above `N`, and the errors of [`ticks_into`](Self::ticks_into).
    #[cfg(feature = "heapless-v0_9")]
    pub fn ticks_vec<const N: usize>(
        &self,
        n: u32,
        timer_hz: u32,
        min_gap: u32,
    ) -> Result<heapless::Vec<u32, N>, ScheduleError> {
        let mut ticks = heapless::Vec::new();
        let fits = usize::try_from(n).is_ok_and(|n| ticks.resize(n, 0).is_ok());
        if !fits {
            return Err(ScheduleError::CapacityExceeded { capacity: N as u32 });
        }
        self.ticks_into(&mut ticks, timer_hz, min_gap)?;
        Ok(ticks)
    }

    /// The number of triggers, up to `wanted`, that keep a gap of `min_gap` ticks. If it is below `wanted`, one more
    /// trigger would not keep the gap.
    ///
    /// The result is 0 only if `wanted` is 0. The call takes as long as planning a few frames.
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, expect_valid};
    /// let curve: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// // A lamp that needs 1 ms between two flashes, on a 1 MHz timer.
    /// assert_eq!(curve.max_triggers(16, 1_000_000, 1_000), Ok(7));
    /// ```
    ///
    /// # Errors
    /// Returns the errors of [`trigger_ticks`](Self::trigger_ticks).
    pub const fn max_triggers(&self, wanted: u32, timer_hz: u32, min_gap: u32) -> Result<u32, ScheduleError> {
        let frame = tried!(Ticks::new(&self.inverse, wanted, timer_hz));
        // As many triggers as the exposure has gaps: next to the answer for a shutter that opens fully.
        let guess = timer_hz as f32 / (self.normalization() * min_gap as f32);
        Ok(frame.max_triggers(min_gap, guess as u32))
    }

    /// A frame of `n` pulses of a steady lamp, as an iterator. Use it if the lamp shines through this shutter. It does
    /// not check lengths and gaps; [`pulses_into`](Self::pulses_into) does.
    ///
    /// Every pulse sends the same amount of light through the shutter. It covers the fraction `duty` of its share of
    /// the exposure, in the middle of the share. `duty` is above 0 and at most 1. The pulse starts at the time of the
    /// fraction `(i + 1/2 - duty/2) / n` and ends at the time of `(i + 1/2 + duty/2) / n`.
    ///
    /// Pulses never overlap; with a duty of 1 they touch. A pulse that is shorter than a tick may start and end at the
    /// same tick. Ticks count from [`open_start`](Self::open_start).
    ///
    /// ```
    /// use shutter_curve::{Pulse, ShutterCurve, expect_valid};
    /// // In seconds. Where the shutter is half closed, a pulse lasts longer.
    /// static SHUTTER: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.002, 0.006, 0.008));
    /// let pulses: Vec<Pulse> = SHUTTER.pulse_ticks(3, 0.5, 1_000_000)?.collect();
    /// assert_eq!(pulses[0], Pulse { on: 1414, off: 2500 });
    /// assert_eq!(pulses[1], Pulse { on: 3500, off: 4500 });
    /// # Ok::<(), shutter_curve::ScheduleError>(())
    /// ```
    ///
    /// # Errors
    /// Returns a [`ScheduleError`] if the duty is out of range or NaN, and the errors of
    /// [`trigger_ticks`](Self::trigger_ticks).
    pub const fn pulse_ticks(
        &self,
        n: u32,
        duty: f32,
        timer_hz: u32,
    ) -> Result<PulseTicks<'_, OCTAVES>, ScheduleError> {
        let pulses = tried!(Pulses::new(&self.inverse, n, duty, timer_hz));
        Ok(PulseTicks { frame: pulses, left: 0..n })
    }

    /// Fills `pulses` with the pulses of a frame, as [`pulse_ticks`](Self::pulse_ticks) returns them. Checks every
    /// pulse and gap against the `limits`.
    ///
    /// ```
    /// use shutter_curve::{Pulse, PulseLimits, ScheduleError, ShutterCurve, expect_valid};
    /// static SHUTTER: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.002, 0.006, 0.008));
    /// let mut pulses = [Pulse::default(); 3];
    /// let limits = PulseLimits { min_pulse: 1_000, min_gap: 1_000 };
    /// SHUTTER.pulses_into(&mut pulses, 0.5, 1_000_000, limits)?;
    /// let limits = PulseLimits { min_pulse: 1_001, min_gap: 1_000 };
    /// let error = SHUTTER.pulses_into(&mut pulses, 0.5, 1_000_000, limits).unwrap_err();
    /// assert_eq!(error, ScheduleError::PulseTooShort { pulse: 1, length: 1_000, min_pulse: 1_001 });
    /// # Ok::<(), ScheduleError>(())
    /// ```
    ///
    /// # Errors
    /// Returns a [`ScheduleError`] if a pulse or a gap is too short. The slice then holds part of the frame. After an
    /// error of [`pulse_ticks`](Self::pulse_ticks), the slice is unchanged.
    pub const fn pulses_into(
        &self,
        pulses: &mut [Pulse],
        duty: f32,
        timer_hz: u32,
        limits: PulseLimits,
    ) -> Result<(), ScheduleError> {
        if pulses.len() > MOST_TRIGGERS as usize {
            return Err(ScheduleError::TooManyTriggers { max: MOST_TRIGGERS });
        }
        let frame = tried!(Pulses::new(&self.inverse, pulses.len() as u32, duty, timer_hz));
        frame.pulses_into(pulses, limits)
    }

    /// A frame of `N` pulses as an array, checked like [`pulses_into`](Self::pulses_into). In a constant, the check
    /// happens at compile time.
    ///
    /// ```
    /// use shutter_curve::{Pulse, PulseLimits, ShutterCurve, expect_valid};
    /// static SHUTTER: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.002, 0.006, 0.008));
    /// const LIMITS: PulseLimits = PulseLimits { min_pulse: 1_000, min_gap: 1_000 };
    /// const PULSES: [Pulse; 3] = match SHUTTER.pulses(0.5, 1_000_000, LIMITS) {
    ///     Ok(pulses) => pulses,
    ///     Err(error) => panic!("{}", error.message()),
    /// };
    /// assert_eq!(PULSES[1], Pulse { on: 3500, off: 4500 });
    /// ```
    ///
    /// # Errors
    /// Returns the errors of [`pulses_into`](Self::pulses_into).
    pub const fn pulses<const N: usize>(
        &self,
        duty: f32,
        timer_hz: u32,
        limits: PulseLimits,
    ) -> Result<[Pulse; N], ScheduleError> {
        let mut pulses = [Pulse { on: 0, off: 0 }; N];
        tried!(self.pulses_into(&mut pulses, duty, timer_hz, limits));
        Ok(pulses)
    }

    /// Whether [`inverse_cdf`](Self::inverse_cdf) answers `u` without a search.
    #[cfg(feature = "_measure")]
    #[must_use]
    pub fn is_direct(&self, u: f32) -> bool {
        self.inverse.evaluations(u).is_none()
    }

    /// The number of search steps that [`inverse_cdf`](Self::inverse_cdf) takes for `u`; 0 if it needs no search.
    #[cfg(feature = "_measure")]
    #[must_use]
    pub fn evaluations(&self, u: f32) -> u32 {
        self.inverse.evaluations(u).unwrap_or(0)
    }
}

/// Unwraps a constructor's result. In a `const` or `static`, an invalid curve is then a compile error.
///
/// ```
/// use shutter_curve::{ShutterCurve, expect_valid};
/// static CURVE: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.25, 0.75, 1.0));
/// assert_eq!(CURVE.exposure(), 0.75);
/// ```
///
/// ```compile_fail,E0080
/// use shutter_curve::{ShutterCurve, expect_valid};
/// // error[E0080]: evaluation panicked: times out of order: ...
/// static CURVE: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.75, 0.25, 1.0));
/// ```
///
/// # Panics
/// If the result is an error.
#[must_use]
#[track_caller]
pub const fn expect_valid<const OCTAVES: usize>(
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
