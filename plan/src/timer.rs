//! A scene's timer.

use shutter_fit::unit::short;

use crate::fault::{Fault, What};
use crate::scene::Flashes;

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
    pub(crate) fn new(flashes: &Flashes, seconds: f64) -> Result<Self, Fault> {
        let given = flashes.timer_hz;
        let exact_hz = given.unwrap_or_else(|| fine(seconds));
        // From 0.5 on it is 1 when it is rounded.
        if given.is_some() && !(0.5..=f64::from(u32::MAX)).contains(&exact_hz) {
            return Err(Fault::new("flashes.timer_hz", What::Rate));
        }
        let bits = flashes.timer_bits.unwrap_or(32.0);
        if ![16.0, 32.0].contains(&bits) {
            return Err(Fault::new("flashes.timer_bits", What::Bits));
        }
        Ok(Self { hz: exact_hz.round() as u32, exact_hz, bits: bits as u32, is_given: given.is_some() })
    }

    /// Has the count room for a delay and a frame of so many ticks? Of 32 bits that is checked as they are planned.
    ///
    /// # Errors
    /// A prescaler with which it has.
    pub(crate) fn holds(&self, ticks: f64) -> Result<(), Fault> {
        // Beyond half of the count, wrapping ticks no longer tell past from future.
        let most = (1u64 << (self.bits - 1)) as f64;
        if !self.is_given || ticks <= most || self.bits == 32 {
            return Ok(());
        }
        let least = (ticks / most).ceil();
        // One that leaves a whole rate, if there is one nearby.
        let whole = |by: &f64| (self.exact_hz / by).fract() == 0.0;
        let by = (0..=least as u64).map(|more| least + more as f64).find(whole).unwrap_or(least);
        let (bits, hz) = (self.bits, self.exact_hz / by);
        Err(Fault::new("flashes.timer_bits", What::Wraps { ticks, bits, most, by, hz }))
    }

    /// What is to be said of it, where a delay and a frame last so many seconds.
    pub(crate) fn told(&self, seconds: f64) -> String {
        let Self { hz, exact_hz, bits, is_given } = *self;
        if !is_given {
            return "none, so there are times alone; `timer_hz` gives ticks".into();
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

    /// So many ticks as seconds.
    pub fn seconds(&self, ticks: impl Into<f64>) -> f64 {
        ticks.into() / f64::from(self.hz)
    }
}

/// The greatest power of ten that counts so many seconds in 31 bits, up to a tick of 1 ns.
fn fine(seconds: f64) -> f64 {
    let counts = |hz: &f64| seconds * hz < f64::from(1u32 << 31);
    (0..10).rev().map(|power| 10f64.powi(power)).find(counts).unwrap_or(1.0)
}
