//! What can be wrong with a curve or a schedule: a variant for each reason.

use core::fmt;

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

impl fmt::Display for Part {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Opening => "opening ramp",
            Self::Plateau => "plateau",
            Self::Closing => "closing ramp",
        })
    }
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
    /// A control point of a [`density`](crate::ShutterCurve::density) is outside [0, 1]. If it exceeds 1,
    /// [scale](crate::CubicBezier::scaled) it down.
    DensityOutOfRange,
    /// The opening ramp does not end, or the closing ramp does not start, at openness 1.
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

/// A text about a part.
macro_rules! of_part {
    ($part:expr, $($text:literal),+) => {
        match $part {
            Part::Opening => concat!("opening ramp: ", $($text),+),
            Part::Plateau => concat!("plateau: ", $($text),+),
            Part::Closing => concat!("closing ramp: ", $($text),+),
        }
    };
}

/// A text about a control point of a ramp.
macro_rules! of_point {
    ($part:expr, $point:expr, $before:literal, $after:literal) => {
        match $point {
            0 => of_part!($part, $before, "first point", $after),
            1 => of_part!($part, $before, "first inner point", $after),
            2 => of_part!($part, $before, "second inner point", $after),
            _ => of_part!($part, $before, "last point", $after),
        }
    };
}

impl CurveError {
    /// The text that [`Display`](fmt::Display) prints.
    pub const fn message(&self) -> &'static str {
        use CurveError as E;
        match *self {
            E::NotFinite(part) => {
                of_part!(part, "a control point is NaN, infinite or beyond f32 (3.4e38)")
            }
            E::TimesOutOfOrder => "times out of order: open_start <= open_end <= close_start <= close_end is required",
            E::TimeOutsideRamp { part, point } => {
                of_point!(part, point, "the time of its ", " has to lie between the ramp's ends")
            }
            E::FractionOutsideRamp { part, point } => of_point!(
                part,
                point,
                "the time of its ",
                " has to lie on the ramp, as a fraction of the whole interval: \
                 0 at open_start, 1 at close_end"
            ),
            E::TimesCross(part) => of_part!(
                part,
                "its first inner point is later than its second by more than 15/16 of the ramp; \
                 move them closer"
            ),
            E::OpennessOutOfRange { part, point } => {
                of_point!(part, point, "the openness of its ", " has to be in [0, 1]")
            }
            E::DensityOutOfRange => {
                "the density has to be in [0, 1] at each control point; scale a greater one down \
                 (CubicBezier::scaled)"
            }
            E::NotFullyOpen(Part::Closing) => "closing ramp: it has to begin fully open, at openness 1",
            E::NotFullyOpen(part) => of_part!(part, "it has to end fully open, at openness 1"),
            E::IntervalUnresolved => {
                "the interval is too short for its distance from time 0: below 2^-16 of its greatest \
                 time; count times from a nearer origin"
            }
            E::IntervalOutOfRange => "the interval is shorter than 2^-64 (5.4e-20) or longer than 2^64 (1.8e19)",
            E::DensityTooSmall => {
                "the density's exposure is below 2^-20 of its interval; scale it up \
                 (CubicBezier::scaled)"
            }
            E::TooShort(part) => {
                of_part!(part, "it is shorter than 2^-24 of the greatest time; make it longer, or give it no length")
            }
        }
    }
}

impl fmt::Display for CurveError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.message())
    }
}

impl core::error::Error for CurveError {}

/// Why a frame is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ScheduleError {
    /// `timer_hz` is 0.
    TickRateZero,
    /// The curve has more than 2³¹ ticks at this rate.
    TickRateTooHigh {
        /// The highest rate that is accepted, or 0 if there is none.
        max: u32,
    },
    /// A frame cannot have so many triggers or pulses.
    TooManyTriggers {
        /// The maximum, 2²².
        max: u32,
    },
    /// The `Vec` cannot hold so many triggers.
    CapacityExceeded {
        /// The number that it can hold.
        capacity: u32,
    },
    /// The gap between two triggers is below the minimum. [`max_triggers`](crate::ShutterCurve::max_triggers) finds how
    /// many triggers keep the minimum.
    GapTooSmall {
        /// The index of the trigger after the first such gap.
        trigger: u32,
        /// The gap in ticks.
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
    /// The duty is NaN, 0 or less, or above 1.
    DutyOutOfRange,
    /// A pulse is shorter than the minimum.
    PulseTooShort {
        /// The index of the first such pulse.
        pulse: u32,
        /// Its length in ticks.
        length: u32,
        /// The minimum in ticks.
        min_pulse: u32,
    },
}

impl ScheduleError {
    /// The reason without its numbers, for a panic in a constant.
    pub const fn message(&self) -> &'static str {
        match self {
            Self::TickRateZero => "the tick rate is 0",
            Self::TickRateTooHigh { max: 0 } => "the interval is longer than 2^31 ticks, whatever the rate",
            Self::TickRateTooHigh { .. } => "the interval is longer than 2^31 ticks",
            Self::TooManyTriggers { .. } => "more triggers or pulses than a frame can have",
            Self::CapacityExceeded { .. } => "more triggers than the `Vec` can hold",
            Self::GapTooSmall { .. } => "a gap between triggers is below the minimum",
            Self::PulsesTooClose { .. } => "a gap between pulses is below the minimum",
            Self::DutyOutOfRange => "the duty must be above 0 and at most 1",
            Self::PulseTooShort { .. } => "a pulse is shorter than the minimum",
        }
    }
}

const fn plural(n: u32) -> &'static str {
    if n == 1 { "" } else { "s" }
}

impl fmt::Display for ScheduleError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::TickRateTooHigh { max } if max > 0 => write!(out, "{}; up to {max} Hz it is not", self.message()),
            Self::TooManyTriggers { max } => {
                write!(out, "more triggers or pulses than the {max} that a frame can have")
            }
            Self::CapacityExceeded { capacity } => {
                write!(out, "more triggers than the {capacity} that the `Vec` can hold")
            }
            Self::GapTooSmall { trigger, gap, min_gap } => {
                let s = plural(gap);
                write!(out, "the gap before trigger {trigger} is {gap} tick{s}; the minimum is {min_gap}")
            }
            Self::PulsesTooClose { pulse, gap, min_gap } => {
                let s = plural(gap);
                write!(out, "the gap before pulse {pulse} is {gap} tick{s}; the minimum is {min_gap}")
            }
            Self::PulseTooShort { pulse, length, min_pulse } => {
                let s = plural(length);
                write!(out, "pulse {pulse} lasts {length} tick{s}; the minimum is {min_pulse}")
            }
            _ => out.write_str(self.message()),
        }
    }
}

impl core::error::Error for ScheduleError {}
