//! From the edge of a camera's sync to the start of opening.

use shutter_fit::unit::Unit;
use toml::Spanned;

use crate::scene::{Fault, Number, seconds};

/// The time that a camera's shutter lets pass between the edge of its sync and the start of opening. Ticks count from the
/// second of the two, and only the edge can be seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delay {
    /// In seconds.
    pub seconds: f64,
    /// In ticks of the scene's timer, rounded to the nearest.
    pub ticks: u32,
    /// Its standard deviation from shot to shot, in seconds, if the scene tells.
    pub spread: Option<f64>,
    /// Is it the falling edge of the sync, or the rising one, if the scene tells?
    pub falls: Option<bool>,
}

/// What a scene has of a sync.
pub(crate) struct Sync<'a> {
    pub delay: Option<&'a Spanned<Number>>,
    pub spread: Option<&'a Spanned<Number>>,
    pub falls: Option<&'a Spanned<bool>>,
}

/// A frame's last tick, counted from the edge: beyond it, wrapping ticks of 32 bits no longer tell past from future.
pub(crate) const LAST: f64 = (1u32 << 31) as f64;

impl Delay {
    /// The delay that a scene has in this unit, if it has one, where the frame ends so many ticks after the shutter opens.
    ///
    /// # Errors
    /// A delay below 0, and one after which the frame ends too late; a spread below 0, or what goes with a delay without one.
    pub(crate) fn new(
        &Sync { delay, spread, falls }: &Sync,
        unit: Unit,
        timer_hz: u32,
        end: f64,
    ) -> Result<Option<Self>, Fault> {
        let of_spread = |place| Ok((place, seconds(unit, "delay_spread", place)?));
        let spread = spread.map(of_spread).transpose()?;
        if let Some((place, _)) = spread.filter(|(_, spread)| delay.is_none() || *spread < 0.0) {
            return Err(Fault::at(place, "delay_spread: 0 or more is required, and a delay"));
        }
        if let (None, Some(place)) = (delay, falls) {
            return Err(Fault::at(place, "sync_falls: it goes with a delay"));
        }
        let Some(place) = delay else { return Ok(None) };
        let seconds = seconds(unit, "delay", place)?;
        if seconds < 0.0 {
            let reason =
                "delay: 0 or more is required; an edge cannot trigger what comes before it";
            return Err(Fault::at(place, reason));
        }
        let ticks = (seconds * f64::from(timer_hz)).round();
        let most = LAST - end;
        if ticks > most {
            let reason = format!(
                "delay: the frame ends more than 2^31 ticks after the edge; with up to {most} ticks of delay it does not"
            );
            return Err(Fault::at(place, reason));
        }
        // Neither is -0.
        let spread = spread.map(|(_, spread)| spread);
        let falls = falls.map(|falls| *falls.get_ref());
        Ok(Some(Self { seconds: seconds + 0.0, ticks: ticks as u32, spread, falls }))
    }
}
