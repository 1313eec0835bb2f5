//! What a plan by a curve and one by trigger times both have.

use shutter_fit::unit::Unit;

use crate::delay::{Delay, Lag};
use crate::fault::Fault;
use crate::lamp::SetUp;
use crate::scene::{Scene, not_negative, positive};
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
    /// That of a scene whose shutter is open for so many seconds, or ticks.
    pub(crate) fn new(scene: &Scene, timer: Timer, length: f64, ticks: f64) -> Result<Self, Fault> {
        let min_gap = not_negative(scene.unit(), "min_gap", &scene.min_gap)?;
        let nominal = positive(scene.unit(), "nominal", scene.nominal.as_ref())?;
        let (delay, lag) = Delay::new(scene, timer.hz, ticks)?;
        timer.holds(delay.map_or(0.0, |delay| delay.ticks.into()) + ticks, scene.timer_bits.as_ref())?;
        let set_up = scene.set_up.as_ref().map(|it| *it.get_ref());
        let unit = scene.unit.unwrap_or_else(|| Unit::fit(length));
        Ok(Self { timer, delay, lag, set_up, min_gap, nominal, fitted: Vec::new(), unit, length })
    }

    /// Can the first trigger, or pulse, after so many ticks come as much earlier as the lamp is late?
    pub(crate) fn starts(&self, first: u32, scene: &Scene) -> Result<(), Fault> {
        self.lag.map_or(Ok(()), |lag| lag.checked(first, scene, self.timer.hz))
    }

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
