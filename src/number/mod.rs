//! Numbers: units, pairs of `f32`, polynomials of pairs, and times before they are rounded.

pub(crate) mod moment;
pub(crate) mod pair;
pub(crate) mod series;
pub(crate) mod units;
