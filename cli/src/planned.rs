//! What a scene becomes: a plan by a curve, or trigger times as they were measured.

use std::ops::Deref;

use serde::Serialize;

use crate::common::Common;
use crate::fault::Fault;
use crate::plan::{Plan, Trigger};
use crate::scene::trigger_times_at;
use crate::set_up::doses;
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

impl Deref for Planned {
    type Target = Common;

    fn deref(&self) -> &Common {
        match self {
            Self::Curve(plan) => plan,
            Self::Times(times) => times,
        }
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
    /// The light of this flash, the greatest being 1, where set-up and curve tell.
    pub dose: Option<f64>,
}

impl Planned {
    /// What the scene that `text` describes becomes.
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

    /// The triggers, in order.
    pub(crate) fn rows(&self) -> Vec<Row> {
        let (delay, mut last) = (self.delay, None);
        // Checked when the lag was read: the first trigger comes no earlier.
        let early = self.lag.map_or(0, |lag| lag.ticks);
        let doses = self.plan().and_then(|plan| Some(doses(plan.set_up?, plan)));
        let mut row = |index, u, time_s, ticks: u32, pulse: Option<(u32, u32)>| Row {
            index,
            u,
            time_s,
            ticks: ticks.saturating_sub(early),
            gap_ticks: last.replace(ticks).map(|last| ticks - last),
            // Checked when the delay was read: the sum is at most 2³¹.
            from_edge_ticks: delay.map(|delay| delay.ticks + ticks.saturating_sub(early)),
            on_ticks: pulse.map(|pulse| pulse.0 - early),
            off_ticks: pulse.map(|pulse| pulse.1 - early),
            dose: doses.as_ref().map(|doses| doses[index]),
        };
        match self {
            Self::Curve(plan) => {
                let of = |(i, it): (usize, &Trigger)| row(i, Some(it.u), with_its_digits(it.time), it.ticks, it.pulse);
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
