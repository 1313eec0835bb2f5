//! What can be wrong with a curve or a schedule, one variant a reason.

use core::fmt;

/// The part of a curve that an error speaks of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Ramp {
    /// The ramp from `open_start` to `open_end`.
    Opening,
    /// The ramp from `close_start` to `close_end`.
    Closing,
    /// The one curve of a [`BezierPdf`](crate::BezierPdf).
    Single,
}

/// Why a curve was not built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum CurveError {
    /// A control point of the ramp is NaN or infinite.
    NotFinite(Ramp),
    /// The four times do not satisfy `open_start <= open_end <= close_start <= close_end`
    /// (for a single curve: it ends before it starts).
    TimesOutOfOrder,
    /// `close_end - open_start` is outside [2⁻⁶⁴, 2⁶⁴].
    IntervalOutOfRange,
    /// Time turns back along the ramp: `t'(p) < 0` somewhere in [0, 1].
    TimeTurnsBack(Ramp),
    /// The openness falls below 0 somewhere on the ramp.
    NegativeOpenness(Ramp),
    /// The openness rises above 1 somewhere on the ramp.
    OpennessAboveOne(Ramp),
    /// The area under the curve is 0: nothing is ever exposed.
    ZeroArea,
    /// The area under the curve, or its reciprocal, is beyond the normal range of `f32`.
    AreaOutOfRange,
}

macro_rules! at {
    ($ramp:expr, $reason:literal) => {
        match $ramp {
            Ramp::Opening => concat!("opening ramp: ", $reason),
            Ramp::Closing => concat!("closing ramp: ", $reason),
            Ramp::Single => concat!("curve: ", $reason),
        }
    };
}

impl CurveError {
    /// The fixed text that [`Display`](fmt::Display) prints.
    pub const fn message(&self) -> &'static str {
        use CurveError as E;
        match self {
            E::NotFinite(r) => at!(r, "a control point is NaN or infinite"),
            E::TimesOutOfOrder => {
                "times out of order: open_start <= open_end <= close_start <= close_end is required"
            }
            E::IntervalOutOfRange => "the interval's length is outside [2^-64, 2^64]",
            E::TimeTurnsBack(r) => at!(r, "time turns back between the control points"),
            E::NegativeOpenness(r) => at!(r, "the openness falls below 0"),
            E::OpennessAboveOne(r) => at!(r, "the openness rises above 1"),
            E::ZeroArea => "the area under the curve is 0",
            E::AreaOutOfRange => "the area under the curve is beyond the range of f32",
        }
    }
}

impl fmt::Display for CurveError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.message())
    }
}

impl core::error::Error for CurveError {}

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
pub const fn valid<T: Copy>(curve: Result<T, CurveError>) -> T {
    match curve {
        Ok(curve) => curve,
        Err(error) => panic!("{}", error.message()),
    }
}

/// Why triggers cannot be scheduled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ScheduleError {
    /// The timer's rate is 0 Hz.
    TickRateZero,
    /// The interval is longer than 2³¹ ticks at this rate.
    TickRateTooHigh,
    /// More triggers than the schedule can hold.
    CapacityExceeded,
    /// Two triggers would come closer than the minimum gap.
    GapTooSmall {
        /// So many triggers, at least 1, keep the gap on this curve at this rate, and one more does not.
        most: u32,
    },
}

impl fmt::Display for ScheduleError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ScheduleError::TickRateZero => out.write_str("the tick rate is 0 Hz"),
            ScheduleError::TickRateTooHigh => {
                out.write_str("the interval is longer than 2^31 ticks")
            }
            ScheduleError::CapacityExceeded => {
                out.write_str("more triggers than the schedule can hold")
            }
            ScheduleError::GapTooSmall { most: 1 } => {
                out.write_str("triggers closer than the minimum gap; 1 trigger keeps it")
            }
            ScheduleError::GapTooSmall { most } => {
                write!(out, "triggers closer than the minimum gap; up to {most} triggers keep it")
            }
        }
    }
}

impl core::error::Error for ScheduleError {}
