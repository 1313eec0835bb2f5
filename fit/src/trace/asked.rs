//! What whoever reads a file adds to it.

use std::fmt;

use crate::unit::Unit;

/// A column of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Column {
    /// By its place, from 1.
    Number(usize),
    /// By its name in the header, or a part of that.
    Name(String),
}

impl Column {
    /// A column as it is written in an argument.
    pub fn parse(text: &str) -> Self {
        match text.trim().parse() {
            Ok(number) => Self::Number(number),
            Err(_) => Self::Name(text.trim().into()),
        }
    }
}

impl fmt::Display for Column {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(out, "{number}"),
            Self::Name(name) => out.write_str(name),
        }
    }
}

/// What the file does not say itself, or not rightly.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Of the times; the header's, or seconds, without.
    pub unit: Option<Unit>,
    /// The time's column and the signals', or one signal's; with a rate, signals alone.
    pub columns: Vec<Column>,
    /// The samples in a second, where the file holds no times.
    pub rate: Option<f64>,
    /// The first time that counts, in seconds, if not all do.
    pub from: Option<f64>,
    /// The last one.
    pub to: Option<f64>,
    /// The column of the camera's sync, which holds no light.
    pub sync: Option<Column>,
}

impl Options {
    /// Is a time among those that count?
    pub(super) fn counts(&self, time: f64) -> bool {
        self.from.is_none_or(|from| time >= from) && self.to.is_none_or(|to| time <= to)
    }
}
