//! What a plan by a curve and one by trigger times both have.

use shutter_fit::unit::Unit;

use crate::delay::{Delay, Lag};
use crate::lamp::SetUp;
use crate::timer::Timer;

/// What a plan by a curve and one by trigger times both have.
#[derive(Clone, Debug)]
pub struct Common {
    /// What counts the ticks.
    pub timer: Timer,
    /// From the edge of the camera's sync to the start of opening, if the scene tells.
    pub delay: Option<Delay>,
    /// Of the lamp, if the scene tells.
    pub lag: Option<Lag>,
    /// How the flashes meet the shutter, if the scene tells.
    pub set_up: Option<SetUp>,
    /// Between two triggers, or from the end of a pulse to the start of the next: at least so many seconds, as the
    /// scene asks.
    pub min_gap: f64,
    /// The exposure that the shutter's maker names, in seconds.
    pub nominal: Option<f64>,
    /// What the scene's text keeps of the fit that it comes from, and what is doubtful about the curve's times.
    pub fitted: Vec<(&'static str, String)>,
    /// The scene's unit, or the one that suits its times.
    pub unit: Unit,
    /// From opening to closed in seconds; without a curve, to the last trigger, and a tick at least.
    pub length: f64,
}

impl Common {
    /// What is doubtful about the fit that the scene comes from.
    pub fn doubts(&self) -> impl Iterator<Item = &str> {
        self.fitted.iter().filter(|(what, _)| *what == "doubt").map(|(_, told)| told.as_str())
    }

    /// From the edge of the sync, or the start of opening where there is no delay, to the end of a frame, in seconds.
    pub(crate) fn edge_to_end(&self) -> f64 {
        self.delay.map_or(0.0, |delay| delay.seconds) + self.length
    }

    /// How long so many ticks last.
    pub fn seconds(&self, ticks: u32) -> f64 {
        f64::from(ticks) / f64::from(self.timer.hz)
    }
}
