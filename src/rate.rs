//! The rate of a timer, with its unit.

/// The rate of a timer, in ticks per second.
///
/// ```
/// use shutter_curve::{Hz, ShutterCurve, expect};
/// let curve: ShutterCurve = expect!(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
/// // A rate of `fugit`, as a HAL returns it.
/// let rate = fugit::MegahertzU32::MHz(1);
/// assert_eq!(curve.at(Hz(rate.to_Hz()))?.length(), 10_000);
/// # Ok::<(), shutter_curve::ScheduleError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Hz(pub u32);
