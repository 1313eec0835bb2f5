//! Plans as objects of JSON. Units stand in the names.

use serde::Serialize;

use crate::facts::Facts;
use crate::plan::{Plan, Trigger};

/// A plan's object.
pub fn object(scene: &str, plan: &Plan) -> String {
    text(&Document::new(scene, plan))
}

/// An array of the objects of several plans.
pub fn array(plans: &[(String, Plan)]) -> String {
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
    opening_s: f32,
    open_s: f32,
    closing_s: f32,
    half_open_s: f32,
    exposure_s: f32,
    efficiency: f32,
    direct_triggers: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    delta_ev: Option<f32>,
    triggers: Vec<Item>,
}

#[derive(Serialize)]
struct Item {
    index: usize,
    u: f32,
    time_s: f32,
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
    fn new(scene: &'a str, plan: &Plan) -> Self {
        let facts = Facts::new(plan);
        let item = |(index, trigger): (usize, &Trigger)| {
            let &Trigger { u, time, ticks, pulse } = trigger;
            let pulse = pulse.map(|(on_ticks, off_ticks)| Edges { on_ticks, off_ticks });
            Item { index, u, time_s: time, ticks, from_edge_ticks: plan.from_edge(ticks), pulse }
        };
        Self {
            scene,
            timer_hz: plan.timer_hz,
            delay_s: plan.delay.map(|delay| delay.seconds),
            delay_ticks: plan.delay.map(|delay| delay.ticks),
            opening_s: facts.opening as f32,
            open_s: facts.open as f32,
            closing_s: facts.closing as f32,
            half_open_s: facts.half_open as f32,
            exposure_s: plan.curve.exposure(),
            efficiency: plan.curve.efficiency(),
            direct_triggers: facts.direct_triggers,
            delta_ev: facts.delta_ev.map(|delta| delta as f32),
            triggers: plan.triggers.iter().enumerate().map(item).collect(),
        }
    }
}
