//! From the edge of a camera's sync to the start of opening, and from a trigger to the lamp's light.

use crate::fault::{Fault, Key, What};
use crate::lamp::LAST;
use crate::scene::Scene;

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

impl Delay {
    /// The one that a scene in seconds has: a hand's own, with its spread and edge, or the trace's.
    pub(crate) fn new(Scene { shutter, flashes, .. }: &Scene) -> Result<Option<Self>, Fault> {
        // What a trace tells of its own delay tells nothing of another.
        let traced = Some(shutter).filter(|_| flashes.delay.is_none());
        let spread = flashes.delay_spread.or(traced.and_then(|it| it.delay_spread));
        let falls = flashes.sync_falls.or(traced.and_then(|it| it.sync_falls));
        let key = |is_own: bool, keys: [Key; 2]| keys[usize::from(!is_own)];
        let Some(seconds) = flashes.delay.or(shutter.delay) else {
            let spreads = key(flashes.delay_spread.is_some(), ["flashes.delay_spread", "shutter.delay_spread"]);
            let edges = key(flashes.sync_falls.is_some(), ["flashes.sync_falls", "shutter.sync_falls"]);
            return match (spread, falls) {
                (Some(_), _) => Err(Fault::new(spreads, What::Spread)),
                (None, Some(_)) => Err(Fault::new(edges, What::Falls)),
                (None, None) => Ok(None),
            };
        };
        let error = traced.and_then(|it| it.measured.as_ref()).and_then(|it| Some(it.unit.seconds(it.delay_error?)));
        let key = key(traced.is_none(), ["flashes.delay", "shutter.delay"]);
        Ok(Some(Self { seconds, error, spread, falls, key }))
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
