//! What only measurements ask: hidden from the documentation, and no part of what a version promises.

use crate::shutter::ShutterCurve;
use crate::trigger::TriggerTicks;

#[doc(hidden)]
pub use crate::search::MAX_EVALUATIONS;

impl<const OCTAVES: usize> ShutterCurve<OCTAVES> {
    /// Does [`inverse_cdf`](Self::inverse_cdf) answer `u` without a search?
    #[doc(hidden)]
    #[must_use]
    pub fn is_direct(&self, u: f32) -> bool {
        self.plan.evaluations(u).is_none()
    }

    /// How often [`inverse_cdf`](Self::inverse_cdf) evaluates the mass to answer `u`.
    #[doc(hidden)]
    #[must_use]
    pub fn evaluations(&self, u: f32) -> u32 {
        self.plan.evaluations(u).unwrap_or(0)
    }
}

impl<const OCTAVES: usize> TriggerTicks<'_, OCTAVES> {
    /// Is trigger `i` of the frame placed without a search?
    #[doc(hidden)]
    #[must_use]
    pub fn is_direct(&self, i: u32) -> bool {
        self.frame.is_direct(i)
    }
}
