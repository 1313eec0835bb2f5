//! What whoever reads a file adds to it.

use crate::unit::Unit;

/// What the file does not say itself, or not rightly.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Of the times; the header's, or seconds, without.
    pub unit: Option<Unit>,
    /// The time's column and the signals', or one signal's; with a rate, signals alone. Each is a number, from 1, or a
    /// name in the header, or a part of that.
    pub columns: Vec<String>,
    /// The samples in a second, where the file holds no times.
    pub rate: Option<f64>,
    /// The first time that counts, in seconds, if not all do.
    pub from: Option<f64>,
    /// The last one.
    pub to: Option<f64>,
    /// The column of the camera's sync, which holds no light.
    pub sync: Option<String>,
}

impl Options {
    /// Is a time among those that count?
    pub(super) fn counts(&self, time: f64) -> bool {
        self.from.is_none_or(|from| time >= from) && self.to.is_none_or(|to| time <= to)
    }
}
