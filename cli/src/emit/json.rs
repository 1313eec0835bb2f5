//! Plans as objects of JSON. Units stand in the names.

use serde::Serialize;

use crate::facts::Facts;
use crate::plan::Plan;
use crate::planned::{Planned, Row};

/// A plan's object.
pub fn object(scene: &str, plan: &Planned) -> String {
    text(&Document::new(scene, plan))
}

/// An array of the objects of several plans.
pub fn array(plans: &[(String, Planned)]) -> String {
    text(&plans.iter().map(|(scene, plan)| Document::new(scene, plan)).collect::<Vec<_>>())
}

fn text(json: &impl Serialize) -> String {
    serde_json::to_string_pretty(json).expect("numbers and names are JSON") + "\n"
}

#[derive(Serialize)]
struct Document<'a> {
    scene: &'a str,
    timer_hz: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    delay_s: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    delay_ticks: Option<u32>,
    #[serde(flatten)]
    curve: Option<Curve>,
    triggers: Vec<Item>,
}

/// What a curve tells.
#[derive(Serialize)]
struct Curve {
    opening_s: f32,
    open_s: f32,
    closing_s: f32,
    half_open_s: f32,
    exposure_s: f32,
    efficiency: f32,
    direct_triggers: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    delta_ev: Option<f32>,
}

#[derive(Serialize)]
struct Item {
    index: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    u: Option<f32>,
    time_s: f64,
    ticks: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    from_edge_ticks: Option<u32>,
    #[serde(flatten)]
    pulse: Option<Edges>,
}

#[derive(Serialize)]
struct Edges {
    on_ticks: u32,
    off_ticks: u32,
}

impl<'a> Document<'a> {
    fn new(scene: &'a str, plan: &Planned) -> Self {
        let item = |(index, row): (usize, Row)| {
            let Row { u, time, ticks, pulse } = row;
            let pulse = pulse.map(|(on_ticks, off_ticks)| Edges { on_ticks, off_ticks });
            Item { index, u, time_s: time, ticks, from_edge_ticks: plan.from_edge(ticks), pulse }
        };
        Self {
            scene,
            timer_hz: plan.timer().hz,
            delay_s: plan.delay().map(|delay| delay.seconds),
            delay_ticks: plan.delay().map(|delay| delay.ticks),
            curve: plan.plan().map(Curve::new),
            triggers: plan.rows().into_iter().enumerate().map(item).collect(),
        }
    }
}

impl Curve {
    fn new(plan: &Plan) -> Self {
        let facts = Facts::new(plan);
        Self {
            opening_s: facts.opening as f32,
            open_s: facts.open as f32,
            closing_s: facts.closing as f32,
            half_open_s: facts.half_open as f32,
            exposure_s: plan.curve.exposure(),
            efficiency: plan.curve.efficiency(),
            direct_triggers: facts.direct_triggers,
            delta_ev: facts.delta_ev.map(|delta| delta as f32),
        }
    }
}
