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

/// A shutter: it tells when a given fraction of the exposure has been collected, and when to fire a flash per equal
/// share.
///
/// Its openness over time, `0 <= f <= 1`, is an opening cubic Bezier, a fully open plateau and a closing cubic Bezier.
/// It is treated as a probability density.
///
/// **Which curves are accepted.** Any other is a [`CurveError`] that names the broken rule.
///
/// 1. All numbers are finite, and `open_start <= open_end <= close_start <= close_end`. Both ramps may have no
///    length (a box), or one, or the plateau (a triangle).
/// 2. Inner control times lie between their ramp's ends, and every openness is in [0, 1]. The first inner
///    time may be later than the second by at most 15/16 of the ramp.
/// 3. Ramps that have length are fully open, at openness 1, where they meet the plateau or each other.
/// 4. The interval is 2⁻⁶⁴ to 2⁶⁴ long, and at least 2⁻¹⁶ of its greatest |time|.
/// 5. A ramp or a plateau has no length, or at least 2⁻²⁴ of the greatest |time|.
/// 6. The exposure of a [`density`](Self::density) is at least 2⁻²⁰ of its interval.
///
/// Lengths and the exposure are compared as rounded to `f64`.
///
/// Times are in seconds, or all times and rates in one other unit ([Units](crate#units)).
///
/// On ramps stored polynomials, one an octave, answer most fractions `u`, a search the rest. Either half of [0, 1] has
/// at most `OCTAVES`, by default 8 ([`with_octaves`](Self::with_octaves)). The promised accuracy is always the same.
/// With 8, about one `u` in 500 of a typical curve needs a search; with 0, every `u` on a ramp does. A curve takes 376
/// bytes, and 96 more for each octave. More than 64 octaves do not compile, and beyond 16 a constant may exceed the
/// compiler's limit on evaluation.
///
#[derive(Clone, PartialEq)]
pub struct ShutterCurve<const OCTAVES: usize = 8> {
    pub(crate) inverse: Inverse<OCTAVES>,
}

impl ShutterCurve {
    /// The shutter with these ramps.
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
    /// Those of [`with_octaves`](Self::with_octaves).
    pub const fn new(opening: CubicBezier, closing: CubicBezier) -> Result<Self, CurveError> {
        Self::with_octaves(opening, closing)
    }

    /// The shutter that opens linearly from `open_start` to `open_end` and closes linearly from `close_start` to
    /// `close_end`. It is a trapezoid; a box if the ramps have no length; a triangle if the plateau
    /// has none.
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, expect_valid};
    /// // 1/100 s from first light to last, of which the ramps take half: in seconds.
    /// static SHUTTER: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// assert_eq!(SHUTTER.exposure(), 0.0075);
    /// ```
    ///
    /// # Errors
    /// Those of [`with_octaves`](Self::with_octaves).
    pub const fn linear(open_start: f32, open_end: f32, close_start: f32, close_end: f32) -> Result<Self, CurveError> {
        Self::with_octaves(
            CubicBezier::line((open_start, 0.0), (open_end, 1.0)),
            CubicBezier::line((close_start, 1.0), (close_end, 0.0)),
        )
    }

    /// The shutter that RenderMan's `shutteropening` describes. The `times` are when it starts to open,
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
    /// Those of [`with_octaves`](Self::with_octaves), but an inner time that is not on its ramp is a
    /// [`FractionOutsideRamp`](CurveError::FractionOutsideRamp).
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

    /// One Bezier `(t(p), f(p))` alone as a density: the opening ramp of a shutter whose closing ramp has no length.
    ///
    /// [`pdf`](Self::pdf), [`cdf`](Self::cdf) and [`inverse_cdf`](Self::inverse_cdf) do not depend on its scale. But
    /// `f` may not exceed 1, so scale a greater one first ([`scaled`](CubicBezier::scaled)), best by a power of two,
    /// which is exact. Then [`normalization`](Self::normalization) is `K = 1 / ∫ f t' dp` of the scaled density.
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
    /// Those of [`with_octaves`](Self::with_octaves).
    pub const fn density(density: CubicBezier) -> Result<Self, CurveError> {
        let [.., (end, _)] = density.points();
        match Self::new(density, CubicBezier::line((end, 0.0), (end, 0.0))) {
            Err(CurveError::OpennessOutOfRange { .. }) => Err(CurveError::DensityOutOfRange),
            curve => curve,
        }
    }
}

impl<const OCTAVES: usize> ShutterCurve<OCTAVES> {
    /// The shutter with these ramps and a chosen number of `OCTAVES`: more of them take more memory and leave fewer
    /// answers to a search.
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
    /// A [`CurveError`] that names the [rule](Self) that the ramps break.
    pub const fn with_octaves(opening: CubicBezier, closing: CubicBezier) -> Result<Self, CurveError> {
        Ok(Self { inverse: tried!(Inverse::new(&opening, &closing)) })
    }

    /// When the shutter starts to open.
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

    /// When the shutter is fully open.
    #[must_use]
    pub const fn open_end(&self) -> f32 {
        self.inverse.exposure.join_time(Side::Start)
    }

    /// When the shutter starts to close.
    #[must_use]
    pub const fn close_start(&self) -> f32 {
        self.inverse.exposure.join_time(Side::End)
    }

    /// When the shutter is closed.
    #[must_use]
    pub const fn close_end(&self) -> f32 {
        self.inverse.exposure.end_time(Side::End)
    }

    /// The openness `f` at the time `t`, in [0, 1]; 0 outside [`open_start`, `close_end`] and for NaN.
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
        cdf::pdf(&self.inverse.exposure, t)
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
        cdf::cdf(&self.inverse.exposure, t)
    }

    /// The time by which the fraction `u` of the exposure is collected.
    ///
    /// `u` is clamped to [0, 1], and NaN counts as 0. The answer lies in [`open_start`, `close_end`]: exactly
    /// `open_start` for 0, and `close_end` for 1. It never steps back as `u` grows.
    ///
    /// On the plateau the formula is `t = open_end + A u - A₀`, where `A` is the [`exposure`](Self::exposure) and `A₀`
    /// the opening ramp's part of it.
    ///
    /// ```
    /// # use shutter_curve::ShutterCurve;
    /// // A ramp of 0.2 has the area 0.1, and the whole is 0.1 + 0.5 + 0.15 = 0.75. Half of that is collected at 0.475.
    /// let curve = ShutterCurve::linear(0.0, 0.2, 0.7, 1.0)?;
    /// assert_eq!(curve.exposure(), 0.75);
    /// assert_eq!(curve.inverse_cdf(0.5), 0.475);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    #[must_use]
    pub fn inverse_cdf(&self, u: f32) -> f32 {
        self.inverse.inverse_cdf(u)
    }

    /// The effective exposure time `A = ∫ f dt`: how long a fully open shutter would take to collect
    /// the same light.
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
        self.inverse.exposure.area as f32
    }

    /// `K = 1/A`, the factor that makes the openness a probability density; per unit of the curve's time.
    ///
    /// ```
    /// use shutter_curve::ShutterCurve;
    /// let curve = ShutterCurve::linear(0.0, 2.0, 4.0, 6.0)?;
    /// assert_eq!(curve.normalization(), 0.25);
    /// # Ok::<(), shutter_curve::CurveError>(())
    /// ```
    #[must_use]
    pub const fn normalization(&self) -> f32 {
        (1.0 / self.inverse.exposure.area) as f32
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
        (self.inverse.exposure.area / (self.close_end() as f64 - self.open_start() as f64)) as f32
    }

    /// How many triggers a frame may have so that each tick takes a short, bounded time: none needs a search
    /// (pulses may). `docs/internals/cost.md` has the cycles.
    ///
    /// It is at most 2²². With 8 octaves it is 127 or more on most typical curves; one octave more gives up to about
    /// twice that. It is 0 on curves too difficult for polynomials, and with `OCTAVES = 0` unless the middle of the
    /// exposure lies on the plateau.
    ///
    /// In a constant the compiler checks it:
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, expect_valid};
    /// static SHUTTER: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// const _: () = assert!(SHUTTER.direct_triggers() >= 64);
    /// ```
    ///
    /// Here 4096 triggers would need searches, so it does not compile:
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

    /// The `n` triggers that split the exposure evenly, each in the middle of its share, in ticks of a timer; their
    /// gaps are not checked. Ticks never step back. They count from [`open_start`](Self::open_start): add the timer's
    /// count at that moment, with `wrapping_add`.
    ///
    /// Their times, to within an ulp of the fractions, are
    /// `(0..n).map(|i| curve.inverse_cdf((2 * i + 1) as f32 / (2 * n) as f32))`.
    ///
    /// `timer_hz` is the timer's rate, for a curve in seconds. A wrong rate cannot be detected.
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, expect_valid};
    /// // A box of 8 ms on a 1 MHz timer.
    /// let curve: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.0, 0.008, 0.008));
    /// assert!(curve.trigger_ticks(4, 1_000_000)?.eq([1000, 3000, 5000, 7000]));
    /// # Ok::<(), shutter_curve::ScheduleError>(())
    /// ```
    ///
    /// On typical curves each tick is within 0.85 tick of the exact time, in intervals of up to 2²⁴ ticks. In longer
    /// ones it may be many ticks off: 8 were seen at 2²⁹, and 32 at 2³¹. On every curve the tick of trigger `i` is
    /// within 0.52 tick of the exact time of some fraction within one ulp of `u = (2i + 1) / 2n`. That is an ulp of `u`
    /// or of `1 - u`, whichever is less.
    ///
    /// # Errors
    /// A rate of 0, or one at which the interval has more than 2³¹ ticks; more than 2²² triggers.
    pub const fn trigger_ticks(&self, n: u32, timer_hz: u32) -> Result<TriggerTicks<'_, OCTAVES>, ScheduleError> {
        let frame = tried!(Ticks::new(&self.inverse, n, timer_hz));
        Ok(TriggerTicks { frame, left: 0..n })
    }

    /// Fills `ticks` with a checked frame: the ticks of [`trigger_ticks`](Self::trigger_ticks), no two closer than
    /// `min_gap` ticks. Where that is 0, triggers may share a tick.
    ///
    /// ```
    /// use shutter_curve::{ScheduleError, ShutterCurve, expect_valid};
    /// static SHUTTER: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// let mut ticks = [0; 5];
    /// SHUTTER.ticks_into(&mut ticks, 1_000_000, 1_000)?;
    /// assert_eq!(ticks, [1936, 3500, 5000, 6500, 8064]);
    /// // 16 are too many for a gap of 1 ms; 7 fit.
    /// let error = SHUTTER.ticks_into(&mut [0; 16], 1_000_000, 1_000).unwrap_err();
    /// assert_eq!(error, ScheduleError::GapTooSmall { trigger: 1, gap: 792, min_gap: 1_000 });
    /// assert_eq!(SHUTTER.max_triggers(16, 1_000_000, 1_000), Ok(7));
    /// # Ok::<(), ScheduleError>(())
    /// ```
    ///
    /// # Errors
    /// A gap that is too small, after which the slice holds a part of the frame; and those of
    /// [`trigger_ticks`](Self::trigger_ticks), after which it is unchanged.
    pub const fn ticks_into(&self, ticks: &mut [u32], timer_hz: u32, min_gap: u32) -> Result<(), ScheduleError> {
        if ticks.len() > MOST_TRIGGERS as usize {
            return Err(ScheduleError::TooManyTriggers { max: MOST_TRIGGERS });
        }
        let frame = tried!(Ticks::new(&self.inverse, ticks.len() as u32, timer_hz));
        frame.ticks_into(ticks, min_gap)
    }

    /// The ticks of `N` triggers as an array, every gap checked to be at least `min_gap` ticks. In a constant, it is
    /// checked at compile time.
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
    /// Those of [`ticks_into`](Self::ticks_into).
    pub const fn ticks<const N: usize>(&self, timer_hz: u32, min_gap: u32) -> Result<[u32; N], ScheduleError> {
        let mut ticks = [0; N];
        tried!(self.ticks_into(&mut ticks, timer_hz, min_gap));
        Ok(ticks)
    }

    /// The ticks of `n` triggers in a `heapless::Vec`, every gap checked to be at least `min_gap` ticks. Needs the
    /// feature `heapless-v0_9`.
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
    /// More triggers than `N`, and those of [`ticks_into`](Self::ticks_into).
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

    /// How many triggers, at most `wanted`, keep a gap of `min_gap` ticks; if the answer is below `wanted`, one more
    /// would not. The answer is at least 1, unless none are wanted.
    ///
    /// It tries frames, usually a few, each up to its first gap that is too small. For a gap of 0 it tries none.
    ///
    /// ```
    /// use shutter_curve::{ShutterCurve, expect_valid};
    /// let curve: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    /// // A lamp that needs 1 ms between two flashes, on a 1 MHz timer.
    /// assert_eq!(curve.max_triggers(16, 1_000_000, 1_000), Ok(7));
    /// ```
    ///
    /// # Errors
    /// Those of [`trigger_ticks`](Self::trigger_ticks).
    pub const fn max_triggers(&self, wanted: u32, timer_hz: u32, min_gap: u32) -> Result<u32, ScheduleError> {
        let frame = tried!(Ticks::new(&self.inverse, wanted, timer_hz));
        // As many triggers as the exposure has gaps: next to the answer for a shutter that opens fully.
        let guess = timer_hz as f32 / (self.normalization() * min_gap as f32);
        Ok(frame.max_triggers(min_gap, guess as u32))
    }

    /// `n` pulses for a shutter in the light's path, as the ticks at which a steady lamp goes on and off. Each sends
    /// the same dose through the shutter, `duty · A / n`. A pulse covers the part `duty` (above 0, at most 1) of its
    /// share of the exposure, in the middle: from the time of the fraction `(i + 1/2 - duty/2) / n` to that of
    /// `(i + 1/2 + duty/2) / n`.
    ///
    /// Pulses are in order, never overlap, and none has a negative length; at a duty of 1 they touch. A pulse shorter
    /// than a tick may go on and off at the same tick. Ticks are counted and rounded as in
    /// [`trigger_ticks`](Self::trigger_ticks), but the fraction of a pulse's end may be off by two ulp.
    ///
    /// ```
    /// use shutter_curve::{Pulse, ShutterCurve, expect_valid};
    /// // In seconds. Next to the ends, where the shutter is half closed, a pulse takes longer.
    /// static SHUTTER: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.002, 0.006, 0.008));
    /// let pulses: Vec<Pulse> = SHUTTER.pulse_ticks(3, 0.5, 1_000_000)?.collect();
    /// assert_eq!(pulses[0], Pulse { on: 1414, off: 2500 });
    /// assert_eq!(pulses[1], Pulse { on: 3500, off: 4500 });
    /// # Ok::<(), shutter_curve::ScheduleError>(())
    /// ```
    ///
    /// # Errors
    /// A duty of 0 or less, above 1, or NaN; and those of [`trigger_ticks`](Self::trigger_ticks).
    pub const fn pulse_ticks(
        &self,
        n: u32,
        duty: f32,
        timer_hz: u32,
    ) -> Result<PulseTicks<'_, OCTAVES>, ScheduleError> {
        let pulses = tried!(Pulses::new(&self.inverse, n, duty, timer_hz));
        Ok(PulseTicks { frame: pulses, left: 0..n })
    }

    /// Fills `pulses` with a checked frame: the pulses of [`pulse_ticks`](Self::pulse_ticks), none of them and no gap
    /// shorter than `limits` allows.
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
    /// A pulse or a gap that is too short, after which the slice holds a part of the frame; and those of
    /// [`pulse_ticks`](Self::pulse_ticks), after which it is unchanged.
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

    /// `N` pulses as an array, each pulse and gap checked against `limits`. In a constant, it is checked at compile
    /// time.
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
    /// Those of [`pulses_into`](Self::pulses_into).
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

    /// Does [`inverse_cdf`](Self::inverse_cdf) answer `u` without a search?
    #[cfg(feature = "measure")]
    #[must_use]
    pub fn is_direct(&self, u: f32) -> bool {
        self.inverse.evaluations(u).is_none()
    }

    /// How often [`inverse_cdf`](Self::inverse_cdf) evaluates the mass to answer `u`.
    #[cfg(feature = "measure")]
    #[must_use]
    pub fn evaluations(&self, u: f32) -> u32 {
        self.inverse.evaluations(u).unwrap_or(0)
    }
}

/// Unwraps a constructor's result, so that an invalid curve in a `const` or `static` is a compile error.
///
/// ```
/// use shutter_curve::{expect_valid, ShutterCurve};
/// static CURVE: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.25, 0.75, 1.0));
/// assert_eq!(CURVE.exposure(), 0.75);
/// ```
///
/// ```compile_fail,E0080
/// use shutter_curve::{expect_valid, ShutterCurve};
/// // error[E0080]: evaluation panicked: times out of order: ...
/// static CURVE: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.75, 0.25, 1.0));
/// ```
///
/// # Panics
/// If `curve` is an error; meant for constants, where that stops the build.
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
