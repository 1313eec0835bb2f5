//! What a scene becomes: a plan by a curve, or trigger times as they were measured. What both have is asked for here.

use serde::Serialize;
use shutter_fit::unit::Unit;

use crate::delay::Delay;
use crate::plan::{Plan, Trigger};
use crate::scene::{Fault, trigger_times_at};
use crate::timer::Timer;
use crate::times::{Given, Times};

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

/// A trigger of either, under the keys that it has in all forms.
#[derive(Serialize)]
pub(crate) struct Row {
    pub index: usize,
    /// The fraction of the exposure collected by then, where a curve tells.
    pub u: Option<f32>,
    pub time_s: f64,
    pub ticks: u32,
    /// From the one before.
    pub gap_ticks: Option<u32>,
    pub from_edge_ticks: Option<u32>,
    pub on_ticks: Option<u32>,
    pub off_ticks: Option<u32>,
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

    /// The triggers, in order.
    pub(crate) fn rows(&self) -> Vec<Row> {
        let (delay, mut last) = (self.delay(), None);
        let mut row = |index, u, time_s, ticks, pulse: Option<(u32, u32)>| Row {
            index,
            u,
            time_s,
            ticks,
            gap_ticks: last.replace(ticks).map(|last| ticks - last),
            // Checked when the delay was read: the sum is at most 2³¹.
            from_edge_ticks: delay.map(|delay| delay.ticks + ticks),
            on_ticks: pulse.map(|pulse| pulse.0),
            off_ticks: pulse.map(|pulse| pulse.1),
        };
        match self {
            Self::Curve(plan) => {
                let of = |(i, it): (usize, &Trigger)| {
                    row(i, Some(it.u), with_its_digits(it.time), it.ticks, it.pulse)
                };
                plan.triggers.iter().enumerate().map(of).collect()
            }
            Self::Times(times) => {
                let of = |(i, it): (usize, &Given)| row(i, None, it.time, it.ticks, None);
                times.triggers.iter().enumerate().map(of).collect()
            }
        }
    }
}

/// The `f64` that is written with the digits of this `f32`, and read back as it.
fn with_its_digits(x: f32) -> f64 {
    x.to_string().parse().unwrap_or(x.into())
}
