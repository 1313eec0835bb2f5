//! Plans in the forms that a firmware or a script takes.
//!
//! All hold the same ticks. Times are in seconds, and every number is written with the digits that give it back.

mod c;
mod csv;
mod json;
mod name;
mod pico;
mod rust;

pub use name::{identifier, module};

use crate::facts;
use crate::lamp::Lamp;
use crate::planned::Planned;

/// A form that a plan can be emitted in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "terminal", derive(clap::ValueEnum))]
pub enum Form {
    /// A module with the curve, if there is one, and the ticks
    Rust,
    /// A header with the ticks, in C99 and C++11
    C,
    /// A row for each trigger
    Csv,
    /// The curve's facts, if there is a curve, and an object for each trigger
    Json,
    /// The lines that boards/pico takes
    Pico,
}

/// The plan of the scene `name` in this form.
///
/// ```
/// use shutter::{emit, planned::Planned};
/// let plan = Planned::parse(include_str!("../scenes/box.toml")).expect("a good scene");
/// let csv = emit::emit(emit::Form::Csv, "box", &plan).expect("a form for any plan");
/// assert!(csv.starts_with("scene,index,u,time_s,ticks,gap_ticks,"));
/// ```
///
/// # Errors
/// A plan that the Pico cannot fire.
pub fn emit(form: Form, name: &str, plan: &Planned) -> Result<String, String> {
    match form {
        Form::Rust => Ok(rust::module(name, plan)),
        Form::C => Ok(c::header(name, plan)),
        Form::Csv => Ok(csv::rows([(name, plan)])),
        Form::Json => Ok(json::object(name, plan)),
        Form::Pico => pico::lines(plan),
    }
}

/// Several plans as one text called `name`, in this order: modules or headers with an array of them, rows or objects one
/// after the other.
///
/// ```
/// use shutter::{emit, planned::Planned};
/// let plan = || Planned::parse(include_str!("../scenes/box.toml")).expect("a good scene");
/// let speeds = [("fast".to_string(), plan()), ("slow".to_string(), plan())];
/// let header = emit::several(emit::Form::C, "camera", &speeds).expect("they share a timer");
/// assert!(header.contains("static const camera_speed camera_speeds[CAMERA_SPEEDS] = {"));
/// ```
///
/// # Errors
/// Plans that do not go together, and a form that takes only one.
pub fn several(form: Form, name: &str, plans: &[(String, Planned)]) -> Result<String, String> {
    match form {
        Form::Rust => alike(plans).map(|()| rust::modules(name, plans)),
        Form::C => alike(plans).map(|()| c::headers(name, plans)),
        Form::Csv => Ok(csv::rows(plans.iter().map(|(name, plan)| (name.as_str(), plan)))),
        Form::Json => Ok(json::array(plans)),
        Form::Pico => Err("--emit pico takes one scene: the board holds one at a time".into()),
    }
}

/// What an array's elements must have in common: the timer, what they tell, and names of their own.
fn alike(plans: &[(String, Planned)]) -> Result<(), String> {
    let Some(((first, one), others)) = plans.split_first() else { return Ok(()) };
    for (i, (name, plan)) in (1..).zip(others) {
        let [a, b] = [one.timer(), plan.timer()];
        for (key, a, b) in [("timer_hz", a.hz, b.hz), ("timer_bits", a.bits, b.bits)] {
            if a != b {
                return Err(format!(
                    "{key}: {a} in {first}, {b} in {name}; an array is for one timer"
                ));
            }
        }
        let (has, lacks) = match (one.delay().is_some(), plan.delay().is_some()) {
            (true, false) => (first, name),
            (false, true) => (name, first),
            _ => (name, name),
        };
        if has != lacks {
            return Err(format!(
                "delay: {has} has one and {lacks} has none; an array needs all or none"
            ));
        }
        if has_pulses(one) != has_pulses(plan) {
            return Err(format!(
                "pulses: one of {first} and {name} has them; an array needs all or none"
            ));
        }
        let identifier = |name: &str| name::identifier(name);
        if let Some((other, _)) =
            plans[..i].iter().find(|(other, _)| identifier(other) == identifier(name))
        {
            return Err(format!("{other} and {name} would both be called {}", identifier(name)));
        }
    }
    Ok(())
}

/// By what a text was made.
const MADE_BY: &str = concat!("Made by `shutter plan` ", env!("CARGO_PKG_VERSION"));

/// The facts, a line each, as a comment.
fn comment(start: &str, name: &str, plan: &Planned) -> String {
    let mut text = format!("{start}{MADE_BY}.\n{}\n", start.trim_end());
    for (what, fact) in facts::lines(name, plan) {
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

fn has_pulses(plan: &Planned) -> bool {
    plan.plan().is_some_and(|plan| plan.lamp != Lamp::Triggered)
}

fn ticks(plan: &Planned) -> impl ExactSizeIterator<Item = String> {
    plan.rows().into_iter().map(|row| row.ticks.to_string())
}

fn pulses(plan: &Planned) -> impl Iterator<Item = (u32, u32)> {
    plan.rows().into_iter().filter_map(|row| row.on_ticks.zip(row.off_ticks))
}
