//! The rate of a timer, with its unit.

/// The rate of a timer, in ticks per second.
///
/// A rate of `fugit`, as a HAL returns it, is `Hz(rate.to_Hz())`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Hz(pub u32);
