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
use serde_json::Value;

use crate::facts::{self, Facts};
use crate::lamp::{Lamp, SetUp};
use crate::plan::Plan;

/// A form that a plan can be emitted in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum Form {
    /// A module with the ticks, which needs no crate
    Rust,
    /// A header with the ticks, in C99 and C++11
    C,
    /// A row for each trigger; from_edge_ticks count from the edge, and all other ticks as the module's table does
    Csv,
    /// The plan's facts, and an object for each trigger, with ticks as in a row
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
        Form::Rust => rust::module(&Module::new(name, plan), curve),
        Form::C => c::header(&Module::new(name, plan)),
        Form::Csv => csv::rows([(name, plan)]),
        Form::Json => format!("{:#}\n", json::object(name, plan)),
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
    alike(form, plans)?;
    let modules = || plans.iter().map(|(name, plan)| Module::new(name, plan)).collect::<Vec<_>>();
    Ok(match form {
        Form::Rust => rust::modules(name, &modules(), curve),
        Form::C => c::headers(name, &modules()),
        Form::Csv => csv::rows(plans.iter().map(|(name, plan)| (name.as_str(), plan))),
        Form::Json => {
            let all: Value = plans.iter().map(|(name, plan)| json::object(name, plan)).collect();
            format!("{all:#}\n")
        }
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
    let told = [
        set_ups(plan),
        "timer_hz = ...       # your timer's rate, in Hz".into(),
        "min_gap = ...        # what your lamp needs between two flashes; 0 if that is nothing".into(),
        "sync_falls = ...     # true, or false if the delay counts from an edge that rises".into(),
    ];
    let lines = told.iter().zip(plan.scene.lacks()).filter(|(_, (_, lacks))| *lacks);
    let lines: String = lines.map(|(line, _)| format!("\n  {line}")).collect();
    if lines.is_empty() {
        return Ok(());
    }
    Err(format!(
        "hardware needs what only you know; write it below [flashes], or say --set-up, --timer-hz, --min-gap, \
         --sync-falls:{lines}"
    ))
}

/// The lines by which a scene can tell its set-up, and what comes of each.
fn set_ups(plan: &Plan) -> String {
    let emulated = "set_up = \"emulated\"  # the camera's own shutter stays open";
    let in_path = "set_up = \"in_path\"   # this shutter is in the light's path";
    let nothing = "                     #";
    match plan.lamp {
        _ if plan.curve.is_none() => {
            format!("{emulated}\n  {nothing} in the light's path it needs a curve: `shutter fit --model free`")
        }
        Lamp::Doses { .. } => format!("{in_path}; duty is for that alone"),
        Lamp::FullyOpen => format!("{in_path}; fully_open is for that alone"),
        Lamp::Triggered | Lamp::Equal { .. } => {
            let [equal, dimmed] = [SetUp::Emulated, SetUp::InPath].map(|it| facts::few(&plan.doses(it)));
            format!(
                "{emulated}: the first, the middle and the last flash give {equal}\n  {in_path}, and dims them to \
                 {dimmed}; all alike\n  {nothing} with `duty = 0.5` (a lamp that takes pulses) or `fully_open = true` \
                 (xenon)"
            )
        }
    }
}

/// Each has a name of its own. An object of JSON tells its timer, edge, set-up and lamp's lag; all others have these in
/// common. An array's elements also tell the same.
fn alike(form: Form, plans: &[(String, Plan)]) -> Result<(), String> {
    let Some(((first, one), others)) = plans.split_first() else { return Ok(()) };
    for (i, (name, plan)) in (1..).zip(others) {
        let is_table = matches!(form, Form::Csv | Form::Json);
        let called = |name: &String| if is_table { name.clone() } else { identifier(name) };
        if let Some((other, _)) = plans[..i].iter().find(|(other, _)| called(other) == called(name)) {
            return Err(format!("{other} and {name} would both be called {}", called(name)));
        }
        if form == Form::Json {
            continue;
        }
        let [a, b] = [one, plan];
        for (key, a, b) in [("timer_hz", a.timer.hz, b.timer.hz), ("timer_bits", a.timer.bits, b.timer.bits)] {
            if a != b {
                return Err(format!("{key}: {a} in {first}, {b} in {name}; one list is for one timer"));
            }
        }
        let [of_a, of_b] = [a, b].map(|plan| plan.sync.delay);
        // The first one may have no edge, and those behind it two.
        let other = |of: &Plan| of.sync.delay.zip(of_b).is_some_and(|(a, b)| a.falls != b.falls);
        if let Some((first, _)) = plans[..i].iter().find(|(_, of)| other(of)) {
            return Err(format!("sync_falls: {first} and {name} differ; one list is for one edge"));
        }
        if a.scene.flashes.set_up != b.scene.flashes.set_up {
            return Err(format!("set_up: {first} and {name} differ; one list is for one set-up"));
        }
        if a.sync.lag.unwrap_or_default() != b.sync.lag.unwrap_or_default() {
            return Err(format!("lamp_lag: {first} and {name} differ; one list is for one lamp"));
        }
        if form == Form::Csv {
            continue;
        }
        if of_a.is_some() != of_b.is_some() {
            let (has, lacks) = if of_a.is_some() { (first, name) } else { (name, first) };
            return Err(format!("delay: {has} has one and {lacks} has none; an array needs all or none"));
        }
        if a.lamp.has_pulses() != b.lamp.has_pulses() {
            return Err(format!("pulses: one of {first} and {name} has them; an array needs all or none"));
        }
    }
    Ok(())
}

/// By what a text was made.
const MADE_BY: &str = concat!("Made by `shutter plan` ", env!("CARGO_PKG_VERSION"));

/// What a module of Rust and a header of C say of a plan, each in its own words.
struct Module<'a> {
    scene: &'a str,
    plan: &'a Plan,
    /// The lines of its head.
    head: Vec<String>,
    /// Is there a delay from an edge?
    has_edge: bool,
    /// What the modules of one array have in common, and what is each one's own.
    common: Vec<Constant>,
    own: Vec<Constant>,
    /// When to switch on and off, or when to trigger.
    ticks: Ticks,
    /// From where these count.
    origin: &'static str,
}

/// What a constant is, its name, and its value.
type Constant = (&'static str, &'static str, Literal);

enum Literal {
    Rate(u32),
    Falls(bool),
    Count(usize),
    Ticks(u32),
}

enum Ticks {
    Triggers(Vec<u32>),
    Pulses(Vec<(u32, u32)>),
}

/// From where the ticks of several modules count.
fn origin(modules: &[Module]) -> &'static str {
    let is_moved = modules.iter().any(|it| it.origin == DELAYED);
    if is_moved { DELAYED } else { OPENED }
}

const OPENED: &str = "counted from the start of opening";
const DELAYED: &str = "counted from the end of the delay";

impl<'a> Module<'a> {
    fn new(scene: &'a str, plan: &'a Plan) -> Self {
        let (rows, sync) = (plan.rows(), plan.sync);
        let lines = Facts::new(plan).lines(scene).into_iter();
        let line = |(what, fact): (_, String)| format!("{what:11}  {}", name::shown(&fact));
        let head = [format!("{MADE_BY}."), String::new()].into_iter().chain(lines.map(line)).collect();
        let about = match (sync.early, sync.lag) {
            (1.., None) => "None: the shutter opens before the edge of the camera's sync, and ticks count from that.",
            (1.., _) => "No delay is left: the lamp's lag is longer, and the rest is taken off the ticks.",
            (0, Some(_)) => "From the edge of the camera's sync to the start of opening, less the lamp's lag.",
            (0, None) => "From the edge of the camera's sync to the start of opening.",
        };
        let mut common = vec![("The timer's rate.", "TIMER_HZ", Literal::Rate(plan.timer.hz))];
        let mut own = vec![("So many flashes.", "COUNT", Literal::Count(rows.len()))];
        if let Some(delay) = sync.delay {
            let edge = "Which edge of the camera's sync counts: the falling one, or the rising one.";
            common.push((edge, "SYNC_FALLS", Literal::Falls(delay.falls.unwrap_or_default())));
            own.push((about, "DELAY_TICKS", Literal::Ticks(sync.ticks)));
            let over =
                "So long after an edge no other one counts: the frame is over then, and lamp and sync are ready.";
            own.push((over, "HOLD_OFF_TICKS", Literal::Ticks(plan.hold_off)));
        }
        let ticks = match plan.lamp.has_pulses() {
            true => Ticks::Pulses(rows.iter().filter_map(|row| row.on_ticks.zip(row.off_ticks)).collect()),
            false => Ticks::Triggers(rows.iter().map(|row| row.ticks).collect()),
        };
        let has_edge = sync.delay.is_some();
        let is_moved = has_edge && (sync.lag.is_some() || sync.early > 0);
        let origin = if is_moved { DELAYED } else { OPENED };
        Self { scene, plan, head, has_edge, common, own, ticks, origin }
    }
}

/// Items in rows that are easy to read.
fn rows<T: ToString>(items: impl Iterator<Item = T>) -> String {
    const WIDTH: usize = 96;
    let (mut text, mut row) = (String::new(), String::new());
    for item in items.map(|item| item.to_string()) {
        if row.len() + item.len() > WIDTH {
            text += &format!("   {row}\n");
            row.clear();
        }
        row += &format!(" {item},");
    }
    if row.is_empty() { text } else { text + &format!("   {row}\n") }
}
