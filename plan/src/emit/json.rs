//! Plans as objects of JSON. Units stand in the names; what is not known is null.

use serde_json::{Map, Value, json};

use crate::facts::Facts;
use crate::plan::Plan;

/// The numbers that every plan has, or has as null.
const KEYS: [&str; 17] = [
    "set_up",
    "sync_falls",
    "timer_hz",
    "nominal_s",
    "delta_ev",
    "delay_s",
    "delay_ticks",
    "delay_spread_s",
    "lamp_lag_s",
    "min_gap_s",
    "opening_s",
    "open_s",
    "closing_s",
    "half_open_s",
    "exposure_s",
    "efficiency",
    "direct_triggers",
];

/// A plan's object.
pub fn object(scene: &str, plan: &Plan) -> Value {
    let Facts { facts, doubts } = Facts::new(plan);
    let mut numbers = shutter_fit::fact::numbers(&facts);
    let mut all = Map::new();
    all.insert("scene".into(), json!(scene));
    for key in KEYS {
        all.insert(key.into(), numbers.remove(key).unwrap_or_default());
    }
    all.append(&mut numbers);
    all.insert("doubts".into(), json!(doubts));
    all.insert("triggers".into(), json!(plan.rows()));
    all.into()
}
