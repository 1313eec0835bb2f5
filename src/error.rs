//! What can be wrong with a curve or a schedule, one variant a reason.

use core::fmt;

/// The part of a curve that an error speaks of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Part {
    /// The ramp from `open_start` to `open_end`.
    Opening,
    /// The ramp from `close_start` to `close_end`.
    Closing,
}

impl fmt::Display for Part {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Opening => "opening ramp",
            Self::Closing => "closing ramp",
        })
    }
}

/// Why a curve was not built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum CurveError {
    /// A control point of the ramp is NaN or infinite. A number above 3.4e38 becomes infinite in `f32`.
    NotFinite(Part),
    /// The four times do not satisfy `open_start <= open_end <= close_start <= close_end`.
    TimesOutOfOrder,
    /// `open_start` and `close_end` are the same `f32`: there is no interval, or it is so short for its distance from
    /// time 0 that `f32` cannot tell its ends apart. Count times from a nearer origin.
    IntervalUnresolved,
    /// `close_end - open_start` is outside [2⁻⁶⁴, 2⁶⁴].
    IntervalOutOfRange,
    /// Time turns back along the ramp: `t'(p) < 0` somewhere in [0, 1].
    TimeTurnsBack(Part),
    /// Time turns back because of the inner control points of [`shutteropening`](crate::ShutterCurve::shutteropening).
    /// Their times are fractions of the whole interval; they may have been given as fractions of the ramp, or as times.
    InnerTimesTurnBack(Part),
    /// The openness falls below 0 somewhere on the ramp.
    NegativeOpenness(Part),
    /// The openness rises above 1 somewhere on the ramp.
    OpennessAboveOne(Part),
    /// The area under the curve is 0: nothing is ever exposed.
    ZeroArea,
    /// The area under the curve is below the normal range of `f32`: less than 2⁻¹²⁶.
    AreaOutOfRange,
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

macro_rules! at {
    ($ramp:expr, $reason:literal) => {
        match $ramp {
            Part::Opening => concat!("opening ramp: ", $reason),
            Part::Closing => concat!("closing ramp: ", $reason),
        }
    };
}

impl CurveError {
    /// The fixed text that [`Display`](fmt::Display) prints.
    pub const fn message(&self) -> &'static str {
        use CurveError as E;
        match self {
            E::NotFinite(r) => at!(r, "a control point is NaN, infinite or beyond f32 (3.4e38)"),
            E::TimesOutOfOrder => {
                "times out of order: open_start <= open_end <= close_start <= close_end is required"
            }
            E::IntervalUnresolved => {
                "the interval has no length, or is too short for f32 so far from time 0: \
                 it starts and ends at the same f32"
            }
            E::IntervalOutOfRange => {
                "the interval is shorter than 2^-64 (5.4e-20) or longer than 2^64 (1.8e19)"
            }
            E::TimeTurnsBack(r) => {
                at!(r, "time turns back along it; with control times in order it does not")
            }
            E::InnerTimesTurnBack(Part::Closing) => {
                "closing ramp: time turns back along it; \
                 t5 and t6 are fractions of the whole interval, 0 at open_start and 1 at close_end"
            }
            E::InnerTimesTurnBack(Part::Opening) => {
                "opening ramp: time turns back along it; \
                 t1 and t2 are fractions of the whole interval, 0 at open_start and 1 at close_end"
            }
            E::NegativeOpenness(r) => at!(r, "the openness falls below 0"),
            E::OpennessAboveOne(r) => at!(r, "the openness rises above 1"),
            E::ZeroArea => "the area under the curve is 0",
            E::AreaOutOfRange => "the area under the curve is below 2^-126 (1.2e-38)",
        }
    }
}

impl fmt::Display for CurveError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.message())
    }
}

impl core::error::Error for CurveError {}

/// Why triggers cannot be scheduled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ScheduleError {
    /// The timer's rate is 0.
    TickRateZero,
    /// The interval is longer than 2³¹ ticks at this rate.
    TickRateTooHigh {
        /// The greatest rate that fits; 0 if none does.
        most: u32,
    },
    /// More triggers or pulses than a frame can have.
    TooManyTriggers {
        /// The most that it can have: 2²².
        most: u32,
    },
    /// More triggers than the schedule can hold.
    CapacityExceeded {
        /// How many it can hold.
        capacity: u32,
    },
    /// Two triggers would come closer than the minimum gap.
    /// [`most_triggers`](crate::ShutterCurve::most_triggers) finds how many would keep it.
    GapTooSmall {
        /// The first trigger that comes too early, by its index.
        trigger: u32,
        /// The ticks since the trigger before it.
        gap: u32,
        /// The ticks that are required.
        min_gap: u32,
    },
    /// Two pulses would come closer than the minimum gap.
    PulsesTooClose {
        /// The first pulse that comes too early, by its index.
        pulse: u32,
        /// The ticks from the end of the pulse before it to its start.
        gap: u32,
        /// The ticks that are required.
        min_gap: u32,
    },
    /// The duty is 0 or less, above 1, or NaN.
    DutyOutOfRange,
    /// A pulse would be shorter than asked for.
    PulseTooShort {
        /// The first such pulse, by its index.
        pulse: u32,
        /// The ticks that it lasts.
        length: u32,
        /// The ticks that are required.
        min_pulse: u32,
    },
}

const fn plural(n: u32) -> &'static str {
    if n == 1 { "" } else { "s" }
}

impl fmt::Display for ScheduleError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TickRateZero => out.write_str("the tick rate is 0"),
            Self::TickRateTooHigh { most: 0 } => out.write_str(
                "the interval is longer than 2^31 ticks, whatever the rate: its unit of time is too small",
            ),
            Self::TickRateTooHigh { most } => {
                write!(
                    out,
                    "the interval is longer than 2^31 ticks; a rate of up to {most} ticks in the curve's unit of time keeps to that"
                )
            }
            Self::TooManyTriggers { most } => {
                write!(out, "more triggers or pulses than the {most} that a frame can have")
            }
            Self::CapacityExceeded { capacity } => {
                write!(out, "more triggers than the {capacity} that the schedule can hold")
            }
            Self::GapTooSmall { trigger, gap, min_gap } => {
                let s = plural(*gap);
                write!(out, "trigger {trigger} comes {gap} tick{s} after the one before, and {min_gap} are required")
            }
            Self::PulsesTooClose { pulse, gap, min_gap } => {
                let s = plural(*gap);
                write!(
                    out,
                    "pulse {pulse} goes on {gap} tick{s} after the one before has gone off, and {min_gap} are required"
                )
            }
            Self::DutyOutOfRange => out.write_str("the duty has to be above 0 and at most 1"),
            Self::PulseTooShort { pulse, length, min_pulse } => {
                let s = plural(*length);
                write!(out, "pulse {pulse} lasts {length} tick{s}, and {min_pulse} are required")
            }
        }
    }
}

impl core::error::Error for ScheduleError {}
