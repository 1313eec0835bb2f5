//! From the edge of a camera's sync to the start of opening, and from a trigger to the lamp's light.

use crate::fault::{Fault, What};
use crate::scene::{Key, Scene};

/// From where a firmware counts. Without a delay, ticks count from the start of opening, which cannot be seen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sync {
    /// From the edge to the start of opening.
    pub delay: Option<Delay>,
    /// How late a lamp shines after its trigger, in seconds.
    pub lag: Option<f64>,
    /// From the edge to where ticks count from.
    pub ticks: u32,
    /// So many ticks are taken off each trigger: where the shutter opens before the edge, and by the lamp's lag.
    pub early: u32,
}

/// The time that a camera's shutter lets pass between the edge of its sync and the start of opening.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delay {
    /// In seconds; below 0 where the shutter opens before the edge.
    pub seconds: f64,
    /// Its standard error, where a fit has measured it.
    pub error: Option<f64>,
    /// Its standard deviation from shot to shot, in seconds, if the scene tells.
    pub spread: Option<f64>,
    /// Is it the falling edge of the sync, or the rising one, if the scene tells?
    pub falls: Option<bool>,
    /// Its key.
    pub key: Key,
}

/// A frame's last tick, counted from the edge: beyond it, wrapping ticks of 32 bits no longer tell past from future.
pub(crate) const LAST: f64 = (1u32 << 31) as f64;

impl Delay {
    /// The one that a scene has: a hand's own, with its spread and edge, or the trace's.
    pub(crate) fn new(scene: &Scene) -> Result<Option<Self>, Fault> {
        let (shutter, flashes) = (&scene.shutter, &scene.flashes);
        let is_own = flashes.delay.is_some();
        // What a trace tells of its own delay tells nothing of another.
        let of = |own: Option<f64>, traced: Option<f64>, keys: [Key; 2]| match own {
            Some(x) => Some((x, scene.unit(), keys[0])),
            None => traced.filter(|_| !is_own).map(|x| (x, shutter.unit(), keys[1])),
        };
        let seconds = |(x, unit, key): (f64, shutter_fit::unit::Unit, Key)| match x.is_finite() {
            true => Ok(unit.seconds(x) + 0.0),
            false => Err(Fault::new(key, What::Finite)),
        };
        let delay = of(flashes.delay, shutter.delay, ["flashes.delay", "shutter.delay"]);
        let spread = of(flashes.delay_spread, shutter.delay_spread, ["flashes.delay_spread", "shutter.delay_spread"]);
        let deviation = spread.map(seconds).transpose()?;
        if let Some((.., key)) = spread.filter(|_| delay.is_none() || deviation < Some(0.0)) {
            return Err(Fault::new(key, What::Spread));
        }
        let falls = flashes.sync_falls.or(shutter.sync_falls.filter(|_| !is_own));
        let Some(delay @ (.., key)) = delay else {
            let key = if flashes.sync_falls.is_some() { "flashes.sync_falls" } else { "shutter.sync_falls" };
            return if falls.is_some() { Err(Fault::new(key, What::Falls)) } else { Ok(None) };
        };
        let error = shutter.measured.as_ref().filter(|_| !is_own).and_then(|it| Some(it.unit.seconds(it.delay_error?)));
        let seconds = seconds(delay)?;
        Ok(Some(Self { seconds, error, spread: deviation, falls, key }))
    }
}

impl Sync {
    /// That of a scene with this delay, whose frame ends so many ticks after the shutter opens.
    ///
    /// # Errors
    /// A delay after which the frame ends too late.
    pub(crate) fn new(delay: Option<Delay>, lag: Option<f64>, timer_hz: u32, end: f64) -> Result<Self, Fault> {
        let seconds = delay.map_or(0.0, |delay| delay.seconds) - lag.unwrap_or_default();
        let ticks = (seconds * f64::from(timer_hz)).round();
        let most = LAST - end;
        if let Some(delay) = delay.filter(|_| ticks > most) {
            return Err(Fault::new(delay.key, What::DelayTooLong { most }));
        }
        // The casts saturate; what is so early is refused later.
        Ok(Self { delay, lag, ticks: ticks as u32, early: -ticks as u32 })
    }
}
