//! Plans as objects of JSON. Units stand in the names; what a plan does not have is null.

use serde::Serialize;

use crate::facts::Facts;
use crate::lamp::SetUp;
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

/// What is further off may be at another tick.
const HALF_TICK: f64 = 0.5;

#[derive(Serialize)]
struct Document<'a> {
    scene: &'a str,
    set_up: Option<SetUp>,
    timer_hz: u32,
    nominal_s: Option<f64>,
    delay_s: Option<f64>,
    delay_ticks: Option<u32>,
    delay_spread_s: Option<f64>,
    sync_falls: Option<bool>,
    lamp_lag_s: Option<f64>,
    opening_s: Option<f32>,
    open_s: Option<f32>,
    closing_s: Option<f32>,
    half_open_s: Option<f32>,
    exposure_s: Option<f32>,
    efficiency: Option<f32>,
    direct_triggers: Option<u32>,
    delta_ev: Option<f32>,
    /// What is doubtful about the fit, or about the ticks.
    doubts: Vec<String>,
    triggers: Vec<Row>,
}

impl<'a> Document<'a> {
    fn new(scene: &'a str, plan: &'a Planned) -> Self {
        let (curve, facts) = (plan.plan().map(|plan| &plan.curve), plan.plan().map(Facts::new));
        let (timer, length) = (plan.timer, plan.edge_to_end());
        let rate = (timer.off(length) >= HALF_TICK).then(|| timer.told(length));
        let fact = |of: fn(Facts) -> f64| facts.map(|facts| of(facts) as f32);
        Self {
            scene,
            set_up: plan.set_up,
            timer_hz: timer.hz,
            nominal_s: plan.nominal,
            delay_s: plan.delay.map(|delay| delay.seconds),
            delay_ticks: plan.delay.map(|delay| delay.ticks),
            delay_spread_s: plan.delay.and_then(|delay| delay.spread),
            sync_falls: super::falls(plan),
            lamp_lag_s: plan.lag.map(|lag| lag.seconds),
            opening_s: fact(|it| it.opening),
            open_s: fact(|it| it.open),
            closing_s: fact(|it| it.closing),
            half_open_s: fact(|it| it.half_open),
            exposure_s: curve.map(|curve| curve.exposure()),
            efficiency: curve.map(|curve| curve.efficiency()),
            direct_triggers: curve.map(|curve| curve.direct_triggers()),
            delta_ev: facts.and_then(|it| it.delta_ev).map(|delta| delta as f32),
            doubts: plan.doubts().map(String::from).chain(rate).collect(),
            triggers: plan.rows(),
        }
    }
}
