//! What whoever reads a file adds to it.

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

/// What the file does not say itself, or not rightly.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Of the times; the header's, or seconds, without.
    pub unit: Option<Unit>,
    /// The time's and the signal's column, or the signal's alone.
    pub columns: Vec<Column>,
    /// The samples in a second, where the file holds no times.
    pub rate: Option<f64>,
}
