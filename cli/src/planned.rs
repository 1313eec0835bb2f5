//! What a scene becomes: a plan by a curve, or trigger times as they were measured. What both have is asked for here.

use shutter_fit::unit::Unit;

use crate::delay::Delay;
use crate::facts;
use crate::plan::Plan;
use crate::scene::{Fault, trigger_times_at};
use crate::timer::Timer;
use crate::times::Times;

/// A scene that can be played.
#[derive(Clone)]
pub enum Planned {
    /// By its curve.
    Curve(Box<Plan>),
    /// By its trigger times, without a curve.
    Times(Times),
}

impl From<Plan> for Planned {
    fn from(plan: Plan) -> Self {
        Self::Curve(Box::new(plan))
    }
}

impl From<Times> for Planned {
    fn from(times: Times) -> Self {
        Self::Times(times)
    }
}

/// A trigger of either.
pub(crate) struct Row {
    /// The fraction of the exposure collected by then, where a curve tells.
    pub u: Option<f32>,
    /// In seconds.
    pub time: f64,
    pub ticks: u32,
    pub pulse: Option<(u32, u32)>,
}

impl Planned {
    /// What the scene that `text` describes becomes.
    ///
    /// # Errors
    /// Whatever is wrong with the scene, and where in the text.
    pub fn parse(text: &str) -> Result<Self, Fault> {
        match trigger_times_at(text) {
            Some(_) => Times::parse(text).map(Self::from),
            None => Plan::parse(text).map(Self::from),
        }
    }

    /// The plan by a curve, if it is one.
    pub fn plan(&self) -> Option<&Plan> {
        match self {
            Self::Curve(plan) => Some(plan),
            Self::Times(_) => None,
        }
    }

    /// What counts the ticks.
    pub fn timer(&self) -> Timer {
        match self {
            Self::Curve(plan) => plan.timer,
            Self::Times(times) => times.timer,
        }
    }

    /// From the edge of the camera's sync to the start of opening, if the scene tells.
    pub fn delay(&self) -> Option<Delay> {
        match self {
            Self::Curve(plan) => plan.delay,
            Self::Times(times) => times.delay,
        }
    }

    /// The exposure that the shutter's maker names, in seconds.
    pub fn nominal(&self) -> Option<f64> {
        match self {
            Self::Curve(plan) => plan.nominal,
            Self::Times(times) => times.nominal,
        }
    }

    /// The scene's unit, or the one that suits its times.
    pub fn unit(&self) -> Unit {
        match self {
            Self::Curve(plan) => plan.unit(),
            Self::Times(times) => times.unit(),
        }
    }

    /// In seconds, up to what is to be seen of it.
    #[cfg(feature = "terminal")]
    pub(crate) fn length(&self) -> f64 {
        match self {
            Self::Curve(plan) => plan.length(),
            Self::Times(times) => times.length(),
        }
    }

    /// So many ticks after the start of opening, counted from the edge of the camera's sync, if the scene has a delay.
    pub fn from_edge(&self, ticks: u32) -> Option<u32> {
        // Checked when the delay was read: the sum is at most 2³¹.
        self.delay().map(|delay| delay.ticks + ticks)
    }

    /// The triggers, in order.
    pub(crate) fn rows(&self) -> Vec<Row> {
        match self {
            Self::Curve(plan) => plan
                .triggers
                .iter()
                .map(|trigger| Row {
                    u: Some(trigger.u),
                    time: with_its_digits(trigger.time),
                    ticks: trigger.ticks,
                    pulse: trigger.pulse,
                })
                .collect(),
            Self::Times(times) => times
                .triggers
                .iter()
                .map(|given| Row { u: None, time: given.time, ticks: given.ticks, pulse: None })
                .collect(),
        }
    }

    /// The facts as lines, each a name and what is to be said.
    pub fn facts(&self, name: &str) -> Vec<(&'static str, String)> {
        match self {
            Self::Curve(plan) => facts::lines(name, plan),
            Self::Times(times) => facts::lines_of_times(name, times),
        }
    }
}

/// The `f64` that is written with the digits of this `f32`, and read back as it.
fn with_its_digits(x: f32) -> f64 {
    x.to_string().parse().unwrap_or(x.into())
}
