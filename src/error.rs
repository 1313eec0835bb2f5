//! What can be wrong with a curve or a schedule: a variant for each reason.

use core::fmt;

use crate::rate::Hz;
use crate::text::Text;

/// A part of a curve, in an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Part {
    /// The ramp from `open_start` to `open_end`.
    Opening,
    /// The fully open part from `open_end` to `close_start`.
    Plateau,
    /// The ramp from `close_start` to `close_end`.
    Closing,
}

/// Why a curve is refused: the [rule](crate::ShutterCurve#rules) that it breaks. A `point` is the index of a control
/// point, from 0 to 3.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum CurveError {
    /// A control point of this ramp is NaN or infinite. Numbers above 3.4e38 are infinite in `f32`.
    NotFinite(Part),
    /// `open_start <= open_end <= close_start <= close_end` is false.
    TimesOutOfOrder,
    /// The time of an inner control point is not between the ramp's ends.
    TimeOutsideRamp {
        /// The ramp.
        part: Part,
        /// The control point: 1 or 2.
        point: u8,
    },
    /// An inner time of [`shutteropening`](crate::ShutterCurve::shutteropening) is not on its ramp. Inner times are
    /// fractions of the whole interval, not of the ramp.
    FractionOutsideRamp {
        /// The ramp.
        part: Part,
        /// The control point: 1 or 2.
        point: u8,
    },
    /// The first inner control point is later than the second by more than 15/16 of this ramp's length.
    TimesCross(Part),
    /// The openness of a control point is not in [0, 1].
    OpennessOutOfRange {
        /// The ramp.
        part: Part,
        /// The control point.
        point: u8,
    },
    /// A control point's value in a [`density`](crate::ShutterCurve::density) is outside [0, 1]. If it exceeds 1,
    /// [scale](crate::CubicBezier::scaled) it down.
    DensityOutOfRange,
    /// This ramp meets another part of non-zero length at an openness below 1.
    NotFullyOpen(Part),
    /// The interval is shorter than 2⁻¹⁶ of the larger of `|open_start|` and `|close_end|`: it contains too few `f32`
    /// times.
    IntervalUnresolved,
    /// The interval is shorter than 2⁻⁶⁴ or longer than 2⁶⁴.
    IntervalOutOfRange,
    /// The exposure of a [`density`](crate::ShutterCurve::density) is less than 2⁻²⁰ of its interval.
    DensityTooSmall,
    /// This part is shorter than 2⁻²⁴ of the larger of `|open_start|` and `|close_end|`, but its length is not 0.
    TooShort(Part),
}

/// `?` for a `const fn`.
macro_rules! tried {
    ($result:expr) => {
        match $result {
            Ok(value) => value,
            Err(error) => return Err(error),
        }
    };
}
pub(crate) use tried;

impl Part {
    const fn name(self) -> &'static str {
        match self {
            Self::Opening => "opening ramp",
            Self::Plateau => "plateau",
            Self::Closing => "closing ramp",
        }
    }
}

impl CurveError {
    const fn text(self) -> Text {
        const fn of(part: Part, text: &str) -> Text {
            Text::new(part.name()).then(": ").then(text)
        }
        const fn of_point(part: Part, what: &str, point: u8) -> Text {
            let points = ["first point", "first inner point", "second inner point", "last point"];
            of(part, "the ").then(what).then(" of its ").then(points[point as usize & 3])
        }
        match self {
            Self::NotFinite(part) => of(part, "a control point is NaN, infinite or beyond f32 (3.4e38)"),
            Self::TimesOutOfOrder => {
                Text::new("times out of order: open_start <= open_end <= close_start <= close_end is required")
            }
            Self::TimeOutsideRamp { part, point } => {
                of_point(part, "time", point).then(" has to lie between the ramp's ends")
            }
            Self::FractionOutsideRamp { part, point } => of_point(part, "time", point)
                .then(" has to lie on the ramp, as a fraction of the whole interval: 0 at open_start, 1 at close_end"),
            Self::TimesCross(part) => of(
                part,
                "its first inner point is later than its second by more than 15/16 of the ramp; move them closer",
            ),
            Self::OpennessOutOfRange { part, point } => of_point(part, "openness", point).then(" has to be in [0, 1]"),
            Self::DensityOutOfRange => Text::new(
                "the density has to be in [0, 1] at each control point; scale a greater one down (CubicBezier::scaled)",
            ),
            Self::NotFullyOpen(Part::Closing) => of(Part::Closing, "it has to begin fully open, at openness 1"),
            Self::NotFullyOpen(part) => of(part, "it has to end fully open, at openness 1"),
            Self::IntervalUnresolved => Text::new("the interval is too short for its distance from time 0: below ")
                .then("2^-16 of its greatest time; count times from a nearer origin"),
            Self::IntervalOutOfRange => {
                Text::new("the interval is shorter than 2^-64 (5.4e-20) or longer than 2^64 (1.8e19)")
            }
            Self::DensityTooSmall => {
                Text::new("the density's exposure is below 2^-20 of its interval; scale it up (CubicBezier::scaled)")
            }
            Self::TooShort(part) => {
                of(part, "it is shorter than 2^-24 of the greatest time; make it longer, or give it no length")
            }
        }
    }
}

/// Why a rate or a frame is refused. The texts say what to change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ScheduleError {
    /// The timer's rate is 0.
    RateZero,
    /// The curve has more than 2³¹ ticks at this rate. Perhaps its times are not in seconds.
    RateTooHigh {
        /// The highest rate that is accepted, or 0 if there is none.
        max: Hz,
    },
    /// A frame, or the `Vec` for it, cannot have so many triggers or pulses.
    TooMany {
        /// The maximum: 2²², or the capacity of the `Vec` if that is less.
        max: u32,
    },
    /// The gap between two triggers is below the minimum. [`max_triggers`](crate::TimedCurve::max_triggers) finds how
    /// many triggers keep the minimum.
    GapTooSmall {
        /// The index of the trigger after the first such gap.
        trigger: u32,
        /// The gap in ticks. If it is 0, the two share a tick: the rate may be wrong.
        gap: u32,
        /// The minimum in ticks.
        min_gap: u32,
    },
    /// The gap between two pulses is below the minimum.
    PulsesTooClose {
        /// The index of the pulse after the first such gap.
        pulse: u32,
        /// The gap in ticks.
        gap: u32,
        /// The minimum in ticks.
        min_gap: u32,
    },
    /// A pulse is shorter than the minimum.
    PulseTooShort {
        /// The index of the first such pulse.
        pulse: u32,
        /// Its length in ticks.
        length: u32,
        /// The minimum in ticks.
        min_pulse: u32,
    },
    /// The duty is NaN, 0 or less, or above 1.
    DutyOutOfRange,
}

impl ScheduleError {
    const fn text(self) -> Text {
        match self {
            Self::RateZero => Text::new("the timer's rate is 0"),
            Self::RateTooHigh { max: Hz(0) } => {
                Text::new("the curve has more than 2^31 ticks at any rate; its times have to be in seconds")
            }
            Self::RateTooHigh { max } => Text::new("the curve has more than 2^31 ticks; use a rate of at most ")
                .number(max.0)
                .then(" Hz, and times in seconds"),
            Self::TooMany { max } => Text::new("more triggers or pulses than fit; use at most ").number(max),
            Self::GapTooSmall { trigger, gap, min_gap } => {
                let text = gap_before("trigger ", trigger, gap, min_gap);
                let text = text.then("; use fewer triggers (max_triggers), or a faster timer");
                if gap == 0 { text.then("; is its rate in Hz?") } else { text }
            }
            Self::PulsesTooClose { pulse, gap, min_gap } => gap_before("pulse ", pulse, gap, min_gap)
                .then("; use fewer pulses, or a smaller duty; with min_gap(0) pulses may touch"),
            Self::PulseTooShort { pulse, length, min_pulse } => Text::new("pulse ")
                .number(pulse)
                .then(" lasts ")
                .ticks(length)
                .then("; the minimum is ")
                .number(min_pulse)
                .then("; use fewer pulses, a larger duty, or a faster timer"),
            Self::DutyOutOfRange => Text::new("the duty has to be above 0 and at most 1"),
        }
    }
}

const fn gap_before(name: &str, i: u32, gap: u32, min_gap: u32) -> Text {
    let text = Text::new("the gap before ").then(name).number(i).then(" is ").ticks(gap);
    text.then("; the minimum is ").number(min_gap)
}

/// What errors do with their `text`.
macro_rules! told {
    ($error:ident) => {
        impl $error {
            /// Panics with the error's text. In a constant, that stops the build. [`expect!`](crate::expect) calls it.
            #[track_caller]
            pub const fn panic(self) -> ! {
                panic!("{}", self.text().as_str())
            }
        }

        impl fmt::Display for $error {
            fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
                out.write_str(self.text().as_str())
            }
        }

        impl core::error::Error for $error {}
    };
}

told!(CurveError);
told!(ScheduleError);

/// Unwraps a result whose error is a [`CurveError`] or a [`ScheduleError`]. In a `const` or a `static`, `Err` stops the
/// build with the error's text.
///
/// ```compile_fail,E0080
/// # use shutter_curve::{Hz, ShutterCurve, TimedCurve, expect};
/// # static SHUTTER: ShutterCurve = expect!(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
/// # const FLASH: TimedCurve = expect!(SHUTTER.at(Hz(1_000_000))).min_gap(1_000);
/// // error[E0080]: evaluation panicked: the gap before trigger 1 is 792 ticks; the minimum is 1000; use fewer ...
/// const TICKS: [u32; 16] = expect!(FLASH.ticks());
/// ```
///
/// # Panics
/// If the result is an error.
#[macro_export]
macro_rules! expect {
    ($result:expr) => {
        match $result {
            Ok(value) => value,
            Err(error) => error.panic(),
        }
    };
}
