//! A scene's timer.

use shutter_fit::unit::short;

use crate::fault::{Fault, What};
use crate::scene::Optional;

/// A timer that counts up and wraps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timer {
    /// Its ticks in a second, as plans count them.
    pub hz: u32,
    /// The same, not rounded to a whole number.
    pub exact_hz: f64,
    /// The bits of its count: 16 or 32.
    pub bits: u32,
    /// Does the scene tell the rate? If not, it is a fine one, by which nothing but times is told.
    pub is_given: bool,
}

impl Timer {
    /// The timer that a scene has, whose frame ends so many seconds after the edge.
    ///
    /// # Errors
    /// A rate that is 0 or no `u32` when it is rounded, and other bits.
    pub(crate) fn new(hz: Optional, bits: Optional, seconds: f64) -> Result<Self, Fault> {
        let exact_hz = hz.map_or_else(|| fine(seconds), |hz| hz.get_ref().get());
        // From 0.5 on it is 1 when it is rounded.
        if let Some(hz) = hz.filter(|_| !(0.5..=f64::from(u32::MAX)).contains(&exact_hz)) {
            return Err(Fault::at(hz, What::Rate));
        }
        let width = bits.map_or(32.0, |bits| bits.get_ref().get());
        if let Some(place) = bits.filter(|_| ![16.0, 32.0].contains(&width)) {
            return Err(Fault::at(place, What::Bits));
        }
        let (hz, is_given) = (exact_hz.round() as u32, hz.is_some());
        Ok(Self { hz, exact_hz, bits: width as u32, is_given })
    }

    /// Has the count room for a delay and a frame of so many ticks? Of 32 bits that is checked as they are planned.
    ///
    /// # Errors
    /// A prescaler with which it has.
    pub(crate) fn holds(&self, ticks: f64, bits: Optional) -> Result<(), Fault> {
        // Beyond half of the count, wrapping ticks no longer tell past from future.
        let most = (1u64 << (self.bits - 1)) as f64;
        let is_beyond = self.is_given && ticks > most;
        let Some(place) = bits.filter(|_| is_beyond) else { return Ok(()) };
        let least = (ticks / most).ceil();
        // One that leaves a whole rate, if there is one nearby.
        let whole = |by: &f64| (self.exact_hz / by).fract() == 0.0;
        let by = (0..=least as u64).map(|more| least + more as f64).find(whole).unwrap_or(least);
        let (bits, hz) = (self.bits, self.exact_hz / by);
        Err(Fault::at(place, What::Wraps { ticks, bits, most, by, hz }))
    }

    /// What is to be said of it, where a delay and a frame last so many seconds.
    pub(crate) fn told(&self, seconds: f64) -> String {
        let Self { hz, exact_hz, bits, is_given } = *self;
        if !is_given {
            return "none, so there are times alone; timer_hz gives ticks".into();
        }
        let off = self.off(seconds);
        let rate = match exact_hz == f64::from(hz) {
            true => format!("{hz} Hz"),
            false => format!("{} Hz, planned as {hz}: {} ticks off at the end", short(exact_hz, 10), short(off, 2)),
        };
        if bits == 32 { rate } else { format!("{rate}; {bits} bits") }
    }

    /// By how many ticks the whole rate is off after so many seconds.
    pub(crate) fn off(&self, seconds: f64) -> f64 {
        (self.exact_hz - f64::from(self.hz)).abs() * seconds
    }
}

/// The greatest power of ten that counts so many seconds in 31 bits, up to a tick of 1 ns.
fn fine(seconds: f64) -> f64 {
    let counts = |hz: &f64| seconds * hz < f64::from(1u32 << 31);
    (0..10).rev().map(|power| 10f64.powi(power)).find(counts).unwrap_or(1.0)
}
