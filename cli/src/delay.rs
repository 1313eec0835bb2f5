//! From the edge of a camera's sync to the start of opening, and from a trigger to the lamp's light.

use crate::fault::{Fault, What};
use crate::scene::{Scene, not_negative, seconds};

/// The time that a camera's shutter lets pass between the edge of its sync and the start of opening. Ticks count from
/// the second of the two, and only the edge can be seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delay {
    /// In seconds.
    pub seconds: f64,
    /// In ticks of the scene's timer, less the lamp's lag, rounded to the nearest.
    pub ticks: u32,
    /// Its standard deviation from shot to shot, in seconds, if the scene tells.
    pub spread: Option<f64>,
    /// Is it the falling edge of the sync, or the rising one, if the scene tells?
    pub falls: Option<bool>,
}

/// How late a lamp shines after its trigger, which comes so much earlier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lag {
    /// In seconds.
    pub seconds: f64,
    /// By so many ticks it is longer than the delay, or than 0 where there is none: they are taken off each trigger.
    pub ticks: u32,
}

/// A frame's last tick, counted from the edge: beyond it, wrapping ticks of 32 bits no longer tell past from future.
pub(crate) const LAST: f64 = (1u32 << 31) as f64;

impl Delay {
    /// The delay and the lamp's lag that a scene has, where the frame ends so many ticks after the shutter
    /// opens.
    ///
    /// # Errors
    /// A delay or a lag below 0, and a delay after which the frame ends too late; a spread below 0, or what goes with a
    /// delay without one.
    pub(crate) fn new(scene: &Scene, timer_hz: u32, end: f64) -> Result<(Option<Self>, Option<Lag>), Fault> {
        let (unit, delay, spread) = (scene.unit(), scene.delay.as_ref(), scene.delay_spread.as_ref());
        let (falls, lag) = (scene.sync_falls.as_ref(), scene.lamp_lag.as_ref());
        let deviation = spread.map(|place| seconds(unit, "delay_spread", place)).transpose()?;
        if let Some(place) = spread.filter(|_| delay.is_none() || deviation < Some(0.0)) {
            return Err(Fault::at(place, What::Spread));
        }
        if let (None, Some(place)) = (delay, falls) {
            return Err(Fault::at(place, What::Falls));
        }
        let lag = lag.map(|place| not_negative(unit, "lamp_lag", place)).transpose()?;
        let count = |seconds: f64| (seconds.max(0.0) * f64::from(timer_hz)).round();
        // The cast saturates; what is so long is refused later.
        let beyond = |delay: f64| lag.map(|lag| Lag { seconds: lag, ticks: count(lag - delay) as u32 });
        let Some(place) = delay else { return Ok((None, beyond(0.0))) };
        let seconds = seconds(unit, "delay", place)?;
        if seconds < 0.0 {
            return Err(Fault::at(place, What::Delay));
        }
        let ticks = count(seconds - lag.unwrap_or_default());
        let most = LAST - end;
        if ticks > most {
            return Err(Fault::at(place, What::DelayTooLong { most }));
        }
        // Neither is -0.
        let falls = falls.map(|falls| *falls.get_ref());
        let (seconds, ticks) = (seconds + 0.0, ticks as u32);
        Ok((Some(Self { seconds, ticks, spread: deviation, falls }), beyond(seconds)))
    }
}

impl Lag {
    /// Can the first trigger, or pulse, after so many ticks come that much earlier?
    ///
    /// # Errors
    /// By how much it would come before the edge; without a delay, before the start of opening.
    pub(crate) fn checked(self, first: u32, scene: &Scene, timer_hz: u32) -> Result<(), Fault> {
        let Some(place) = &scene.lamp_lag else { return Ok(()) };
        let Some(by) = self.ticks.checked_sub(first).filter(|by| *by > 0) else { return Ok(()) };
        let by = f64::from(by) / f64::from(timer_hz);
        let (most, by_edge) = (self.seconds - by, scene.delay.is_some());
        Err(Fault::at(place, What::Lag { by, most, by_edge, unit: scene.unit() }))
    }
}
