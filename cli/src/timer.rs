//! A scene's timer.

use shutter_fit::unit::short;
use toml::Spanned;

use crate::scene::{Fault, Number};

/// A timer that counts up and wraps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timer {
    /// Its ticks in a second, as plans count them.
    pub hz: u32,
    /// The same, not rounded to a whole number.
    pub exact_hz: f64,
    /// The bits of its count: 16 or 32.
    pub bits: u32,
}

impl Timer {
    /// The timer that a scene has.
    ///
    /// # Errors
    /// A rate that is 0 or no `u32` when it is rounded, and other bits.
    pub(crate) fn new(hz: &Spanned<Number>, bits: Option<&Spanned<Number>>) -> Result<Self, Fault> {
        let exact_hz = hz.get_ref().get();
        // From 0.5 on it is 1 when it is rounded.
        if !(0.5..=f64::from(u32::MAX)).contains(&exact_hz) {
            return Err(Fault::at(hz, "timer_hz: a rate from 1 to 4294967295 is required"));
        }
        let timer = |bits| Self { hz: exact_hz.round() as u32, exact_hz, bits };
        match bits.map(|bits| (bits, bits.get_ref().get())) {
            None => Ok(timer(32)),
            Some((_, bits)) if bits == 16.0 || bits == 32.0 => Ok(timer(bits as u32)),
            Some((place, _)) => Err(Fault::at(place, "timer_bits: 16 or 32 is required")),
        }
    }

    /// The most ticks of a delay and a frame: beyond them, wrapping ticks no longer tell past from future.
    pub(crate) fn most(&self) -> f64 {
        (1u64 << (self.bits - 1)) as f64
    }

    /// Has the count room for a delay and a frame of so many ticks? Of 32 bits that is checked as they are planned.
    ///
    /// # Errors
    /// A prescaler with which it has.
    pub(crate) fn holds(&self, ticks: f64, bits: Option<&Spanned<Number>>) -> Result<(), Fault> {
        let (most, Some(place)) = (self.most(), bits) else { return Ok(()) };
        if ticks <= most {
            return Ok(());
        }
        let least = (ticks / most).ceil();
        // One that leaves a whole rate, if there is one nearby.
        let whole = |by: &f64| (self.exact_hz / by).fract() == 0.0;
        let by = (0..=least as u64).map(|more| least + more as f64).find(whole).unwrap_or(least);
        Err(Fault::at(
            place,
            format!(
                "timer_bits: the frame ends at tick {ticks}, and a count of {} bits tells past from future for {most}; \
                 a prescaler of {by} fits: timer_hz = {}",
                self.bits,
                short(self.exact_hz / by, 10)
            ),
        ))
    }

    /// What is to be said of it, where a delay and a frame last so many seconds.
    pub(crate) fn told(&self, seconds: f64) -> String {
        let Self { hz, exact_hz, bits } = *self;
        let rate = match exact_hz == f64::from(hz) {
            true => format!("{hz} Hz"),
            false => format!(
                "{} Hz, planned as {hz}: {} ticks off at the end",
                short(exact_hz, 10),
                short((exact_hz - f64::from(hz)).abs() * seconds, 2)
            ),
        };
        if bits == 32 { rate } else { format!("{rate}; {bits} bits") }
    }
}
