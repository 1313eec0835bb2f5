//! What was read of a file, as a reader is told: which column, and how its times are known.

use std::fmt;

use serde::Serialize;

use super::samples::Trace;
use super::times::Timing;
use super::told::Warning;
use crate::unit::{Unit, short};

/// A column: its number, from 1, and its name, if it has one.
pub type Named = (usize, Option<String>);

/// What was read of a file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reading {
    /// So many columns, or channels, the file has.
    pub columns: usize,
    /// The times' column, if there is one.
    pub time: Option<Named>,
    /// The signal's.
    pub signal: Named,
    /// The sync's, if one was asked for.
    pub sync: Option<Named>,
    /// How a row's time is known.
    pub clock: Clock,
    /// The first time in seconds, where rows are counted and something tells it.
    pub first: Option<f64>,
    /// Who tells the unit or the rate.
    pub told: Told,
    /// The first and the last time that count, where that was asked.
    pub window: [Option<f64>; 2],
    /// So many segments begin anew, each a shot.
    pub segments: usize,
}

/// How the time of a row is known.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Clock {
    /// The row holds it, in this unit.
    Unit(Unit),
    /// The rows follow each other at this rate, in hertz.
    Rate(f64),
}

/// Who tells the unit or the rate.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Told {
    /// The column's name.
    Name,
    /// A line above the numbers.
    Header(String),
    /// The format of the file.
    Format,
    /// The options.
    Asked,
    /// The options, against what the file says.
    Against(String),
    /// Nobody.
    Assumed,
}

/// A trace, and how it was read.
#[derive(Clone, Debug)]
pub struct Recording {
    /// The samples.
    pub trace: Trace,
    /// What is known of their times.
    pub timing: Timing,
    /// Those of the camera's sync, if its column was asked for.
    pub sync: Option<Trace>,
    /// What was read.
    pub reading: Reading,
    /// What is doubtful.
    pub warnings: Vec<Warning>,
}

/// A column as it is told: `column 2, "CH1"`, or `column 2 of 3, "CH1"`.
pub fn shown((number, name): &Named, of: Option<usize>) -> String {
    let of = of.map_or(String::new(), |all| format!(" of {all}"));
    let name = name.as_ref().map_or(String::new(), |name| format!(", \"{name}\""));
    format!("column {number}{of}{name}")
}

impl Reading {
    /// A column, and its place among all.
    pub fn among(&self, named: &Named) -> String {
        shown(named, Some(self.columns))
    }

    /// Are rows counted, and nothing tells from when?
    pub fn is_counted(&self) -> bool {
        matches!(self.clock, Clock::Rate(_)) && self.first.is_none()
    }

    /// How the times are known.
    pub fn times(&self) -> String {
        let by = match &self.told {
            Told::Name => "by its name".into(),
            Told::Header(line) => format!("by '{line}'"),
            Told::Format => "by the file".into(),
            Told::Asked => "as asked".into(),
            Told::Against(other) => format!("as asked, where {other}"),
            Told::Assumed => "assumed".into(),
        };
        let limit = |word: &str, time: Option<f64>| {
            time.map_or(String::new(), |t| format!(", {word} {}", Unit::fit(t.abs()).show(t)))
        };
        let mut times = match self.clock {
            Clock::Unit(unit) => {
                let column = self.time.as_ref().map_or(String::new(), |time| shown(time, None) + " ");
                format!("{column}in {}, {by}", unit.name())
            }
            Clock::Rate(rate) => {
                let first = self.first.filter(|first| *first != 0.0);
                format!("{} samples a second, {by}{}", short(rate, 7), limit("the first at", first))
            }
        };
        if self.segments > 0 {
            times += &format!(", in {} segments, each a shot", self.segments);
        }
        times + &limit("from", self.window[0]) + &limit("to", self.window[1])
    }
}

impl fmt::Display for Reading {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}; times: {}", self.among(&self.signal), self.times())
    }
}
