//! A plan in the forms that a firmware or a script takes.
//!
//! All hold the same ticks. Times are in seconds, and every number is written with the digits that give it back.

use serde::Serialize;

use crate::facts::{Facts, lines};
use crate::lamp::Lamp;
use crate::plan::{Plan, Trigger};
use crate::shape::Shape;

/// A form that a plan can be emitted in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "terminal", derive(clap::ValueEnum))]
pub enum Form {
    /// A module with the curve and its ticks
    Rust,
    /// A header with the ticks, in C99
    C,
    /// A row for each trigger
    Csv,
    /// The curve's facts and an object for each trigger
    Json,
}

/// The plan of the scene `name` in this form.
///
/// ```
/// use shutter::{emit, plan::Plan};
/// let plan = Plan::parse(include_str!("../scenes/box.toml")).expect("a good scene");
/// let csv = emit::emit(emit::Form::Csv, "box", &plan);
/// assert!(csv.starts_with("index,u,time_s,ticks,gap_ticks\n0,0.05,0.000005,125,\n"));
/// ```
pub fn emit(form: Form, name: &str, plan: &Plan) -> String {
    match form {
        Form::Rust => rust(name, plan),
        Form::C => c(name, plan),
        Form::Csv => csv(plan),
        Form::Json => json(name, plan),
    }
}

/// From where the ticks count, for both languages.
const BASE: &str =
    "Ticks count from the start of opening; add the timer's count at that moment, wrapping.";

fn rust(name: &str, plan: &Plan) -> String {
    let n = plan.triggers.len();
    let mut text = comment("// ", name, plan);
    text += &format!(
        "
use shutter_curve::{{ShutterCurve, valid}};

/// The shutter, its times in seconds.
pub static SHUTTER: ShutterCurve = valid(ShutterCurve::{});

/// The timer's rate.
pub const TIMER_HZ: u32 = {};

/// When to trigger. {BASE}
pub const TICKS: [u32; {n}] = [
{}];
",
        constructor(&plan.shape),
        plan.timer_hz,
        rows(plan.triggers.iter().map(|trigger| trigger.ticks.to_string())),
    );
    if plan.lamp != Lamp::Triggered {
        text += &format!(
            "
/// When to switch the lamp on, and when off, counted as [`TICKS`] are.
pub const PULSES: [(u32, u32); {n}] = [
{}];
",
            rows(pulses(plan).map(|(on, off)| format!("({on}, {off})"))),
        );
    }
    text
}

/// The call that makes the curve; `{:?}` writes an `f32` as a literal that is it.
fn constructor(shape: &Shape) -> String {
    let Shape { times, inner } = shape;
    match inner {
        Some(inner) => format!("shutteropening(\n    {times:?},\n    {inner:?},\n)"),
        None => {
            let [open_start, open_end, close_start, close_end] = times;
            format!("linear({open_start:?}, {open_end:?}, {close_start:?}, {close_end:?})")
        }
    }
}

fn c(name: &str, plan: &Plan) -> String {
    let n = plan.triggers.len();
    let guard: String = name
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_uppercase() } else { '_' })
        .collect();
    let mut text = format!("/*\n{} */\n", comment(" * ", name, plan));
    text += &format!(
        "#ifndef SHUTTER_{guard}_H
#define SHUTTER_{guard}_H

#include <stdint.h>

/* The timer's rate. */
#define SHUTTER_TIMER_HZ UINT32_C({})

/* When to trigger. {BASE} */
static const uint32_t shutter_ticks[{n}] = {{
{}}};
",
        plan.timer_hz,
        rows(plan.triggers.iter().map(|trigger| trigger.ticks.to_string())),
    );
    if plan.lamp != Lamp::Triggered {
        let edges = [("on", "on"), ("off", "off")];
        for ((name, what), edge) in edges.into_iter().zip([0, 1]) {
            let ticks = pulses(plan).map(|(on, off)| [on, off][edge].to_string());
            text += &format!(
                "
/* When to switch the lamp {what}, counted as shutter_ticks are. */
static const uint32_t shutter_{name}[{n}] = {{
{}}};
",
                rows(ticks),
            );
        }
    }
    text + "\n#endif\n"
}

/// The facts, a line each, as a comment.
fn comment(start: &str, name: &str, plan: &Plan) -> String {
    let mut text = format!("{start}Made by `shutter plan`.\n{}\n", start.trim_end());
    for (what, fact) in lines(name, plan) {
        // A name of any characters must not end the comment, nor turn the line around.
        let shown = |c: char| c.is_alphanumeric() || c == ' ' || c.is_ascii_graphic() && c != '/';
        let fact: String = fact.chars().map(|c| if shown(c) { c } else { '_' }).collect();
        text += &format!("{start}{what:11}  {fact}\n");
    }
    text
}

/// Items in rows that are easy to read.
fn rows(items: impl Iterator<Item = String>) -> String {
    const WIDTH: usize = 96;
    let (mut text, mut row) = (String::new(), String::new());
    for item in items {
        if row.len() + item.len() > WIDTH {
            text += &format!("   {row}\n");
            row.clear();
        }
        row += &format!(" {item},");
    }
    if row.is_empty() { text } else { text + &format!("   {row}\n") }
}

fn pulses(plan: &Plan) -> impl Iterator<Item = (u32, u32)> {
    plan.triggers.iter().filter_map(|trigger| trigger.pulse)
}

#[derive(Serialize)]
struct Row {
    index: usize,
    u: f32,
    time_s: f32,
    ticks: u32,
    /// Since the trigger before.
    gap_ticks: Option<u32>,
}

#[derive(Serialize)]
struct Edges {
    on: u32,
    off: u32,
}

fn csv(plan: &Plan) -> String {
    let mut out = csv::Writer::from_writer(Vec::new());
    let mut last = None;
    let rows = plan.triggers.iter().enumerate().map(|(index, trigger)| {
        let &Trigger { u, time, ticks, pulse } = trigger;
        let gap_ticks = last.replace(ticks).map(|last| ticks - last);
        let row = Row { index, u, time_s: time, ticks, gap_ticks };
        (row, pulse.map(|(on, off)| Edges { on, off }))
    });
    for (row, edges) in rows {
        match edges {
            Some(edges) => out.serialize((row, edges)),
            None => out.serialize(row),
        }
        .expect("memory takes all");
    }
    String::from_utf8(out.into_inner().expect("memory takes all")).expect("numbers are text")
}

#[derive(Serialize)]
struct Document<'a> {
    scene: &'a str,
    timer_hz: u32,
    opening: f32,
    open: f32,
    closing: f32,
    half_open: f32,
    exposure: f32,
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
    time: f32,
    ticks: u32,
    #[serde(flatten)]
    pulse: Option<Edges>,
}

fn json(name: &str, plan: &Plan) -> String {
    let facts = Facts::new(plan);
    let triggers = plan.triggers.iter().enumerate().map(|(index, trigger)| {
        let &Trigger { u, time, ticks, pulse } = trigger;
        Item { index, u, time, ticks, pulse: pulse.map(|(on, off)| Edges { on, off }) }
    });
    let document = Document {
        scene: name,
        timer_hz: plan.timer_hz,
        opening: facts.opening as f32,
        open: facts.open as f32,
        closing: facts.closing as f32,
        half_open: facts.half_open as f32,
        exposure: plan.curve.exposure(),
        efficiency: plan.curve.efficiency(),
        direct_triggers: facts.direct_triggers,
        delta_ev: facts.delta_ev.map(|delta| delta as f32),
        triggers: triggers.collect(),
    };
    serde_json::to_string_pretty(&document).expect("numbers and names are JSON") + "\n"
}
