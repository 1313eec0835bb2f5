//! The rate of a timer, with its unit.

/// The rate of a timer, in ticks per second.
///
/// Convert a `fugit` rate, as a HAL returns it, with `Hz(rate.to_Hz())`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Hz(pub u32);
