//! What a line asks for.

use core::fmt;

use shutter_curve::{CurveError, ScheduleError};

use crate::curves::CURVES;
use crate::duration;
use crate::limits::MIN_PULSE;
use crate::lines::Broken;

/// What a line changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// `n 32`: the pulses of a frame.
    Pulses(u32),
    /// `gap 100us`: from the start of a pulse to the start of the next, at least; in ticks.
    Gap(u32),
    /// `pulse 2us`: the length of a pulse; in ticks.
    Length(u32),
    /// `curve 1`: one of the curves in flash, counted from 0 here.
    Stored(usize),
    /// `curve` and twelve numbers: the four times in seconds and the eight inner control points of `shutteropening`.
    Built([f32; 12]),
}

/// Why a line changed nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refused {
    /// It cannot be read.
    Broken(Broken),
    /// It does not start with a known word.
    Unknown,
    /// What follows `n` is not a number of pulses.
    Pulses,
    /// What follows `gap` or `pulse` is not a duration.
    Duration,
    /// The pulse is shorter than the state machine can make it.
    TooShort,
    /// What follows `curve` is neither a stored curve nor twelve numbers.
    Numbers,
    /// The twelve numbers are not a curve.
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
}

impl fmt::Display for Refused {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refused::Broken(broken) => broken.fmt(out),
            Refused::Unknown => out.write_str("unknown; there are n, gap, pulse, curve"),
            Refused::Pulses => out.write_str("n takes a number of pulses, at least 1: n 32"),
            Refused::Duration => {
                out.write_str("a duration is a whole number and ns, us, ms or s, below 34 s: 100us")
            }
            Refused::TooShort => {
                write!(out, "a pulse takes at least {}", duration::Duration(MIN_PULSE))
            }
            Refused::Numbers => write!(
                out,
                "curve takes a number from 1 to {}, or twelve: open_start open_end close_start close_end t1 y1 t2 y2 t5 y5 t6 y6",
                CURVES.len()
            ),
            Refused::Curve(error) => error.fmt(out),
            Refused::Gap { error, most } => write!(out, "{error}; up to n {most} it is kept"),
            Refused::Schedule(error) => error.fmt(out),
        }
    }
}

impl Change {
    /// Reads a line.
    ///
    /// # Errors
    /// What is wrong with it, as far as that can be said without the settings.
    pub fn read(line: &str) -> Result<Self, Refused> {
        let mut words = line.split_ascii_whitespace();
        let name = words.next();
        match name {
            Some("n") => match only(words).and_then(|n| n.parse().ok()) {
                Some(0) | None => Err(Refused::Pulses),
                Some(n) => Ok(Change::Pulses(n)),
            },
            Some("gap") => ticks(words).map(Change::Gap),
            Some("pulse") => match ticks(words)? {
                ..MIN_PULSE => Err(Refused::TooShort),
                length => Ok(Change::Length(length)),
            },
            Some("curve") => {
                let stored = only(words.clone()).and_then(|curve| curve.parse().ok());
                match stored {
                    Some(curve) if (1..=CURVES.len()).contains(&curve) => {
                        Ok(Change::Stored(curve - 1))
                    }
                    _ => twelve(words).map(Change::Built).ok_or(Refused::Numbers),
                }
            }
            _ => Err(Refused::Unknown),
        }
    }
}

/// The only word that is left.
fn only<'a>(mut words: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let word = words.next();
    if words.next().is_none() { word } else { None }
}

fn ticks<'a>(words: impl Iterator<Item = &'a str>) -> Result<u32, Refused> {
    only(words).and_then(duration::parse).ok_or(Refused::Duration)
}

/// Twelve numbers, finite or not: the crate has a word for those that are not.
fn twelve<'a>(mut words: impl Iterator<Item = &'a str>) -> Option<[f32; 12]> {
    let mut numbers = [0.0; 12];
    for number in &mut numbers {
        *number = words.next()?.parse().ok()?;
    }
    if words.next().is_none() { Some(numbers) } else { None }
}
