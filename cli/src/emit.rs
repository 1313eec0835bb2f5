//! Plans in the forms that a firmware or a script takes.
//!
//! All hold the same ticks. Times are in seconds, and every number is written with the digits that give it back.

mod c;
mod csv;
mod json;
mod name;
mod rust;

pub use name::{identifier, module};
use serde::Deserialize;

use crate::facts::{self, Facts};
use crate::lamp::{Lamp, SetUp};
use crate::plan::Plan;
use crate::set_up::doses;

/// A form that a plan can be emitted in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "terminal", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum Form {
    /// A module with the ticks, which needs no crate
    Rust,
    /// A header with the ticks, in C99 and C++11
    C,
    /// A row for each trigger
    Csv,
    /// The curve's facts, if there is a curve, and an object for each trigger
    Json,
}

impl Form {
    /// What the file of the scene `name` is called: a module's name is its file's.
    pub fn file(self, name: &str) -> String {
        match self {
            Self::Rust => module(name) + ".rs",
            Self::C => identifier(name) + ".h",
            Self::Csv => identifier(name) + ".csv",
            Self::Json => identifier(name) + ".json",
        }
    }
}

/// The plan of the scene `name` in this form; a module has the `curve` only where that is asked for.
///
/// # Errors
/// A plan that lacks what hardware needs, and a curve that is not there or for which the form has no place.
pub fn emit(form: Form, name: &str, plan: &Plan, curve: bool) -> Result<String, String> {
    is_ready(form, plan, curve)?;
    Ok(match form {
        Form::Rust => rust::module(name, plan, curve),
        Form::C => c::header(name, plan),
        Form::Csv => csv::rows([(name, plan)]),
        Form::Json => json::object(name, plan),
    })
}

/// Several plans as one text called `name`, in this order: modules or headers with an array of them, rows or objects
/// one after the other.
///
/// # Errors
/// What [`emit`] refuses of any of them, and plans that do not go together.
pub fn several(form: Form, name: &str, plans: &[(String, Plan)], curve: bool) -> Result<String, String> {
    for (name, plan) in plans {
        is_ready(form, plan, curve).map_err(|reason| format!("{name}: {reason}"))?;
    }
    // An object of JSON has its timer; rows have none.
    if form != Form::Json {
        alike(form, plans)?;
    }
    Ok(match form {
        Form::Rust => rust::modules(name, plans, curve),
        Form::C => c::headers(name, plans),
        Form::Csv => csv::rows(plans.iter().map(|(name, plan)| (name.as_str(), plan))),
        Form::Json => json::array(plans),
    })
}

/// Has the plan all that the form needs?
fn is_ready(form: Form, plan: &Plan, curve: bool) -> Result<(), String> {
    if curve && form != Form::Rust {
        return Err("--curve: it is the crate's, and goes with --emit rust".into());
    }
    if curve && plan.curve.is_none() {
        return Err("--curve: the scene has trigger times and no curve".into());
    }
    let mut lacks = Vec::new();
    if plan.set_up.is_none() {
        lacks.extend(set_ups(plan));
    }
    if !plan.timer.is_given {
        lacks.push("timer_hz = ...       # your timer's rate, in Hz".into());
    }
    if plan.min_gap.is_none() {
        lacks.push("min_gap = ...        # what your lamp needs between two flashes; 0 if that is nothing".into());
    }
    if plan.sync.delay.is_some() && falls(plan).is_none() {
        lacks.push("sync_falls = ...     # true, or false if the delay counts from an edge that rises".into());
    }
    if lacks.is_empty() {
        return Ok(());
    }
    let lines: String = lacks.iter().map(|line| format!("\n  {line}")).collect();
    Err(format!(
        "hardware needs what only you know; write it below [flashes], or say --set-up, --timer-hz, --min-gap, --sync-falls:{lines}"
    ))
}

/// The lines by which a scene can tell its set-up, and what comes of each.
fn set_ups(plan: &Plan) -> Vec<String> {
    let emulated = "set_up = \"emulated\"  # the camera's own shutter stays open";
    let in_path = "set_up = \"in_path\"   # this shutter is in the light's path";
    if plan.curve.is_none() {
        return vec![
            emulated.into(),
            "                     # in the light's path it needs a curve: `shutter fit --model free`".into(),
        ];
    }
    match plan.lamp {
        Lamp::Doses { .. } => vec![format!("{in_path}; duty is for that alone")],
        Lamp::FullyOpen => vec![format!("{in_path}; fully_open is for that alone")],
        Lamp::Triggered | Lamp::Equal { .. } => {
            let [equal, dimmed] = [SetUp::Emulated, SetUp::InPath].map(|it| facts::few(&doses(it, plan)));
            vec![
                format!("{emulated}: the first, the middle and the last flash give {equal}"),
                format!("{in_path}, and dims them to {dimmed}; all alike"),
                "                     # with `duty = 0.5` (a lamp that takes pulses) or `fully_open = true` (xenon)"
                    .into(),
            ]
        }
    }
}

/// What rows must have in common: the timer; an array's elements also what they tell, and names of their own.
fn alike(form: Form, plans: &[(String, Plan)]) -> Result<(), String> {
    let Some(((first, one), others)) = plans.split_first() else { return Ok(()) };
    for (i, (name, plan)) in (1..).zip(others) {
        let [a, b] = [one.timer, plan.timer];
        for (key, a, b) in [("timer_hz", a.hz, b.hz), ("timer_bits", a.bits, b.bits)] {
            if a != b {
                return Err(format!("{key}: {a} in {first}, {b} in {name}; one list is for one timer"));
            }
        }
        if form == Form::Csv {
            continue;
        }
        let [a, b] = [one, plan];
        if a.sync.delay.is_some() != b.sync.delay.is_some() {
            let (has, lacks) = if a.sync.delay.is_some() { (first, name) } else { (name, first) };
            return Err(format!("delay: {has} has one and {lacks} has none; an array needs all or none"));
        }
        let differ = format!("{first} and {name} differ; an array is for one");
        if falls(a) != falls(b) {
            return Err(format!("sync_falls: {differ} edge"));
        }
        if a.set_up != b.set_up {
            return Err(format!("set_up: {differ} set-up"));
        }
        if has_pulses(a) != has_pulses(b) {
            return Err(format!("pulses: one of {first} and {name} has them; an array needs all or none"));
        }
        let called = identifier(name);
        if let Some((other, _)) = plans[..i].iter().find(|(other, _)| identifier(other) == called) {
            return Err(format!("{other} and {name} would both be called {called}"));
        }
    }
    Ok(())
}

/// By what a text was made.
const MADE_BY: &str = concat!("Made by `shutter plan` ", env!("CARGO_PKG_VERSION"));

/// The facts, a line each, as a comment.
fn comment(start: &str, name: &str, plan: &Plan) -> String {
    let mut text = format!("{start}{MADE_BY}.\n{}\n", start.trim_end());
    for (what, fact) in Facts::new(plan).lines(name) {
        text += &format!("{start}{what:11}  {}\n", name::shown(&fact));
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

/// What the delay is, as a module or a header says it.
fn delay(plan: &Plan) -> &'static str {
    match (plan.sync.early, plan.sync.lag) {
        (1.., None) => "None: the shutter opens before the edge of the camera's sync, and ticks count from that.",
        (1.., _) => "No delay is left: the lamp's lag is longer, and the rest is taken off the ticks.",
        (0, Some(_)) => "From the edge of the camera's sync to the start of opening, less the lamp's lag.",
        (0, None) => "From the edge of the camera's sync to the start of opening.",
    }
}

/// From where the ticks of all these count.
fn origin<'a>(mut plans: impl Iterator<Item = &'a Plan>) -> &'static str {
    let is_moved = |plan: &Plan| plan.sync.delay.is_some() && (plan.sync.lag.is_some() || plan.sync.early > 0);
    match plans.any(is_moved) {
        true => "counted from the end of the delay",
        false => "counted from the start of opening",
    }
}

/// Which edge of the sync counts, if the scene tells.
fn falls(plan: &Plan) -> Option<bool> {
    plan.sync.delay?.falls
}

fn has_pulses(plan: &Plan) -> bool {
    plan.lamp.has_pulses()
}

fn ticks(plan: &Plan) -> impl ExactSizeIterator<Item = String> {
    plan.rows().into_iter().map(|row| row.ticks.to_string())
}

fn pulses(plan: &Plan) -> impl Iterator<Item = (u32, u32)> {
    plan.rows().into_iter().filter_map(|row| row.on_ticks.zip(row.off_ticks))
}

/// Fowler, Noll and Vo's hash (FNV-1a).
pub(crate) fn fnv(bytes: impl Iterator<Item = u8>) -> u32 {
    bytes.fold(0x811C_9DC5, |hash, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193))
}
