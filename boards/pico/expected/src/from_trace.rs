//! The whole way: a measured trace whose time 0 is the camera's sync, fitted, planned, and sent as lines.

use serde_json::Value;
use shutter::emit::{Form, emit};
use shutter::fitted::{self, Zero};
use shutter::plan::Plan;
use shutter_fit::trace;
use shutter_fit::{Options, Sync, fit};
use strobe::TICK_HZ;

use crate::frame::Frame;
use crate::step::step;

/// Sends the lines of the scene, and starts a frame by the edge.
pub fn steps() -> Vec<Value> {
    let text = include_str!("../../../../cli/traces/leaf.csv");
    let trace = trace::open(text.as_bytes(), &trace::Options::default()).unwrap().trace;
    let options = Options { sync: Some(Sync::Edge(0.0)), ..Options::default() };
    let fit = fit(&trace, &options, &mut |_| ()).unwrap();
    let scene = fitted::scene(&fit, "leaf.csv", Zero::Trace, None).unwrap().text;
    let plan = Plan::parse(&scene).unwrap();
    let lines = emit(Form::Pico, "leaf", &plan.clone().into()).unwrap();
    // Whatever the answers are: all of them are `ok`, and the last one counts.
    let mut send = serde_json::json!({ "send": lines.as_bytes(), "answers": vec!["ok"; lines.lines().count()] });
    send["oneByOne"] = true.into();
    let delay = (fit.delay.unwrap().mean() * f64::from(TICK_HZ)).round() as u32;
    let armed = Frame { delay, ..Frame::new(&plan.curve, 16, 0, 250) };
    // The one that was armed before comes first.
    vec![send, serde_json::json!({ "spend": true, "send": [], "answers": [] }), step(armed, &[])]
}
