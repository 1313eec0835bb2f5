//! A moment: a time as it is found, more exact than an `f32`.

use crate::pair::{Pair, rounded_sum};

/// A time, `time + elapsed` or, if `back`, `time - elapsed`: an exact `f32` and the way from it.
#[derive(Clone, Copy)]
pub(crate) struct Moment {
    pub(crate) time: f32,
    pub(crate) back: bool,
    /// In units of `2^unit`, at least 0.
    pub(crate) elapsed: Pair,
    pub(crate) unit: i32,
    /// No time on the way is beyond this.
    pub(crate) until: f32,
    /// Evaluations of the mass that it took to find.
    pub(crate) evaluations: u32,
}

impl Moment {
    /// A moment on the plateau, on the way from one end of it to the other.
    pub(crate) const fn on_way(
        time: f32,
        until: f32,
        back: bool,
        elapsed: Pair,
        unit: i32,
    ) -> Self {
        Self { time, until, back, elapsed, unit, evaluations: 0 }
    }

    /// The time, rounded once.
    #[inline(always)]
    pub(crate) const fn time(self) -> f32 {
        let time = rounded_sum(self.time, self.elapsed, self.unit, self.back);
        let is_beyond = if self.back { time < self.until } else { time > self.until };
        if is_beyond { self.until } else { time }
    }

    /// The time since `start`, in units of `2^unit`.
    pub(crate) const fn since(self, start: f32, unit: i32) -> Pair {
        let base = Pair::sum(self.time, -start).shifted(-unit);
        let way = self.elapsed.shifted(self.unit - unit);
        if self.back { base.minus(way) } else { base.plus(way) }
    }
}
