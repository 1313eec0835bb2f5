//! The iterators over a frame, which is the triggers or the pulses of one exposure: from either end, or any item
//! directly.

use core::ops::Range;

use crate::trigger::pulse::{Pulse, Pulses};
use crate::trigger::ticks::Frame;

/// The ticks of a frame's triggers, from [`TimedCurve::trigger_ticks`](crate::TimedCurve::trigger_ticks). The
/// iterator runs from either end, and computes only the ticks that it returns.
///
/// A `static` curve has a `'static` iterator, which an interrupt handler can keep:
///
/// ```
/// use shutter_curve::{Hz, ShutterCurve, TimedCurve, TriggerTicks, expect};
/// static SHUTTER: ShutterCurve = expect!(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
/// const FLASH: TimedCurve = expect!(SHUTTER.at(Hz(1_000_000)));
/// let mut frame: TriggerTicks<'static> = FLASH.trigger_ticks(16)?;
/// // The handler adds the timer's count at `open_start` to each.
/// assert_eq!(frame.next(), Some(1083));
/// # Ok::<(), shutter_curve::ScheduleError>(())
/// ```
#[derive(Clone)]
pub struct TriggerTicks<'a, const OCTAVES: usize = 8> {
    pub(crate) frame: Frame<'a, OCTAVES>,
    pub(crate) left: Range<u32>,
}

/// A frame's pulses, from [`TimedCurve::pulse_ticks`](crate::TimedCurve::pulse_ticks). The iterator runs from
/// either end, and computes only the pulses that it returns.
#[derive(Clone)]
pub struct PulseTicks<'a, const OCTAVES: usize = 8> {
    pub(crate) frame: Pulses<'a, OCTAVES>,
    pub(crate) left: Range<u32>,
}

#[cfg(feature = "_measure")]
impl<const OCTAVES: usize> TriggerTicks<'_, OCTAVES> {
    /// Whether trigger `i` needs no search.
    #[must_use]
    pub fn is_direct(&self, i: u32) -> bool {
        self.frame.is_direct(i)
    }
}

/// The iterator `$name`, whose fields are a `frame`, of which item `i` is `frame.at(i)`, and the range of those that
/// are `left`.
macro_rules! iterate {
    ($name:ident, $item:ty) => {
        impl<const OCTAVES: usize> Iterator for $name<'_, OCTAVES> {
            type Item = $item;

            // Inlined into the caller's loop: most programs have only one, so the code is there once.
            #[inline(always)]
            fn next(&mut self) -> Option<$item> {
                self.left.next().map(|i| self.frame.at(i))
            }

            fn nth(&mut self, n: usize) -> Option<$item> {
                self.left.nth(n).map(|i| self.frame.at(i))
            }

            fn size_hint(&self) -> (usize, Option<usize>) {
                self.left.size_hint()
            }
        }

        impl<const OCTAVES: usize> DoubleEndedIterator for $name<'_, OCTAVES> {
            fn next_back(&mut self) -> Option<$item> {
                self.left.next_back().map(|i| self.frame.at(i))
            }

            fn nth_back(&mut self, n: usize) -> Option<$item> {
                self.left.nth_back(n).map(|i| self.frame.at(i))
            }
        }

        impl<const OCTAVES: usize> ExactSizeIterator for $name<'_, OCTAVES> {
            // `usize::MAX` where there are more: a `usize` may have 16 bits.
            fn len(&self) -> usize {
                self.left.size_hint().0
            }
        }

        impl<const OCTAVES: usize> core::iter::FusedIterator for $name<'_, OCTAVES> {}

        impl<const OCTAVES: usize> core::fmt::Debug for $name<'_, OCTAVES> {
            fn fmt(&self, out: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                let mut out = out.debug_struct(stringify!($name));
                out.field("left", &self.left).finish_non_exhaustive()
            }
        }

        #[cfg(feature = "defmt")]
        impl<const OCTAVES: usize> defmt::Format for $name<'_, OCTAVES> {
            fn format(&self, out: defmt::Formatter<'_>) {
                let (name, left) = (stringify!($name), &self.left);
                defmt::write!(out, "{=str} {{ left: {}..{}, .. }}", name, left.start, left.end);
            }
        }
    };
}

iterate!(TriggerTicks, u32);
iterate!(PulseTicks, Pulse);
