//! Why a line changed nothing.

use core::fmt;

use shutter_curve::{CurveError, ScheduleError};

use crate::curves::CURVES;
use crate::duration::Duration;
use crate::limits::{MIN_PULSE, MOST_PULSES};
use crate::lines::Broken;

/// Why a line changed nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refused {
    /// It cannot be read.
    Broken(Broken),
    /// It does not start with a known word.
    Unknown,
    /// Something follows `?` or `save`.
    Alone,
    /// What follows `n` is not a number of pulses.
    Pulses,
    /// What follows `gap`, `pulse` or `delay` is not a duration.
    Duration,
    /// The pulse is shorter than the state machine can make it.
    TooShort,
    /// What follows `duty` is not a number above 0 and at most 1.
    Duty,
    /// What follows `edge` is not one.
    Edge,
    /// What follows `frames` is not a number of them, and, above 1, the time from one to the next.
    Frames,
    /// What follows `curve` is neither a stored curve nor four or twelve numbers.
    Numbers,
    /// The numbers are not a curve.
    Curve(CurveError),
    /// The pulses would come too close to each other.
    Gap {
        /// Which, and how close.
        error: ScheduleError,
        /// So many would not.
        most: u32,
    },
    /// The frame cannot be planned with this.
    Schedule(ScheduleError),
    /// One edge would start more pulses than there is room for.
    TooMany,
    /// A pulse would come more than 17 s after the edge.
    TooLate,
    /// From one frame to the next there is too little time.
    Overlap {
        /// That lasts so many ticks.
        least: u64,
    },
    /// The flash holds something else than what was written.
    NotSaved,
}

impl fmt::Display for Refused {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refused::Broken(broken) => broken.fmt(out),
            Refused::Unknown => out.write_str(
                "unknown; there are n, gap, pulse, duty, delay, edge, frames, curve, save, ?",
            ),
            Refused::Alone => out.write_str("nothing may follow this word"),
            Refused::Pulses => out.write_str("n takes a number of pulses, at least 1: n 32"),
            Refused::Duration => {
                out.write_str("a duration is a number and ns, us, ms or s, below 34 s: 100us, 4.247ms")
            }
            Refused::TooShort => write!(out, "a pulse takes at least {}", Duration(MIN_PULSE)),
            Refused::Duty => out.write_str("duty takes a number above 0 and at most 1: duty 0.3"),
            Refused::Edge => out.write_str("edge takes rising or falling"),
            Refused::Frames => out.write_str(
                "frames takes 1, or a number and the time from one frame to the next: frames 3 20ms",
            ),
            Refused::Numbers => write!(
                out,
                "curve takes a number from 1 to {}, or open_start open_end close_start close_end, and t1 y1 t2 y2 t5 y5 t6 y6 unless the ramps are straight",
                CURVES.len()
            ),
            Refused::Curve(error) => error.fmt(out),
            Refused::Gap { error, most } => write!(out, "{error}; up to n {most} it is kept"),
            Refused::Schedule(error) => error.fmt(out),
            Refused::TooMany => write!(out, "one edge starts at most {MOST_PULSES} pulses"),
            Refused::TooLate => out.write_str("a pulse comes at most 17 s after the edge"),
            Refused::Overlap { least } => {
                write!(out, "from one frame to the next at least {}ns are required", 8 * least)
            }
            Refused::NotSaved => out.write_str("the flash did not take the settings; those that were saved before stay"),
        }
    }
}
