//! A plan as a module of Rust.

use super::{MADE_BY, comment, has_pulses, name, pulses, rows, ticks};
use crate::planned::Planned;
use crate::shape::Shape;

/// Said of each item: a firmware need not use them all.
const ALLOW: &str = "#[allow(dead_code)]";
/// Said of tables: their digits stand as in every other form, in rows of our own.
const TABLE: &str = "#[allow(dead_code, clippy::unreadable_literal)]\n#[rustfmt::skip]";

/// The file of a module that is called as the scene is.
pub fn module(scene: &str, plan: &Planned) -> String {
    comment("// ", scene, plan) + "\n" + &items(plan)
}

/// The file of a module with one module for each plan, and an array of them all.
pub fn modules(called: &str, plans: &[(String, Planned)]) -> String {
    let Some((_, one)) = plans.first() else { return String::new() };
    let int = int(one);
    // A speed that was measured, and is no curve, leaves the others without theirs.
    let has_curves = plans.iter().all(|(_, plan)| plan.plan().is_some());
    let (import, shutter) = match has_curves {
        true => (
            "use shutter_curve::ShutterCurve;\n\n",
            "    /// The shutter, its times in seconds.\n    pub shutter: &'static ShutterCurve,\n",
        ),
        false => ("", ""),
    };
    let mut text = format!(
        "// {MADE_BY}: {}, a shutter of {} speeds.

{import}/// The timer's rate.
{ALLOW}
pub const TIMER_HZ: u32 = {};

/// A speed of the shutter.
{ALLOW}
pub struct Speed {{
    /// The scene's name.
    pub name: &'static str,
{shutter}",
        name::shown(called),
        plans.len(),
        grouped(one.timer().hz)
    );
    if one.delay().is_some() {
        text += &format!(
            "    /// From the edge of the camera's sync to the start of opening.\n    pub delay_ticks: {int},\n"
        );
    }
    text += &format!(
        "    /// When to trigger, counted from the start of opening.\n    pub ticks: &'static [{int}],\n"
    );
    if has_pulses(one) {
        text += &format!(
            "    /// When to switch the lamp on, and when off, counted as `ticks` are.\n    pub pulses: &'static [({int}, {int})],\n"
        );
    }
    text += &format!(
        "}}\n\n/// The speeds.\n{ALLOW}\n#[rustfmt::skip]\npub static SPEEDS: [Speed; {}] = [\n",
        plans.len()
    );
    for (scene, plan) in plans {
        let module = name::module(scene);
        let delay = plan.delay().map_or("", |_| "        delay_ticks: {}::DELAY_TICKS,\n");
        let shutter = if has_curves { "        shutter: &{}::SHUTTER,\n" } else { "" };
        let pulses = if has_pulses(plan) { "        pulses: &{}::PULSES,\n" } else { "" };
        let fields = format!(
            "    Speed {{\n        name: {:?},\n{shutter}{delay}        ticks: &{{}}::TICKS,\n{pulses}    }},\n",
            name::shown(scene)
        );
        text += &fields.replace("{}", &module);
    }
    text += "];\n";
    for (scene, plan) in plans {
        let body = comment("// ", scene, plan) + "\n" + &items(plan);
        let indented = body.lines().map(|line| match line {
            "" => "\n".into(),
            line => format!("    {line}\n"),
        });
        let indented: String = indented.collect();
        let module = name::module(scene);
        text += &format!("\n/// A speed of the shutter.\npub mod {module} {{\n{indented}}}\n");
    }
    text
}

/// The items of a plan's module.
fn items(plan: &Planned) -> String {
    let (ticks, int) = (ticks(plan), int(plan));
    let n = ticks.len();
    let mut text = String::new();
    if let Some(plan) = plan.plan() {
        text += &format!(
            "use shutter_curve::{{ShutterCurve, valid}};

/// The shutter, its times in seconds.
{TABLE}
pub static SHUTTER: ShutterCurve = valid(ShutterCurve::{});

",
            constructor(&plan.shape)
        );
    }
    text += &format!(
        "/// The timer's rate.\n{ALLOW}\npub const TIMER_HZ: u32 = {};\n",
        grouped(plan.timer().hz)
    );
    if let Some(delay) = plan.delay() {
        text += &format!(
            "\n/// From the edge of the camera's sync to the start of opening.\n{ALLOW}\npub const DELAY_TICKS: {int} = {};\n",
            grouped(delay.ticks)
        );
    }
    text += &format!(
        "\n/// When to trigger, counted from the start of opening.\n{TABLE}\npub const TICKS: [{int}; {n}] = [\n{}];\n",
        rows(ticks),
    );
    if has_pulses(plan) {
        text += &format!(
            "
/// When to switch the lamp on, and when off, counted as [`TICKS`] are.
{TABLE}
pub const PULSES: [({int}, {int}); {n}] = [
{}];
",
            rows(pulses(plan).map(|(on, off)| format!("({on}, {off})"))),
        );
    }
    if plan.delay().is_some() {
        text += &due(plan, int);
    }
    text
}

/// What its user adds: the edge, the delay and the ticks.
fn due(plan: &Planned, int: &str) -> String {
    let (what, array, item, each) = match has_pulses(plan) {
        true => (
            "switch the lamp on, and off",
            "PULSES",
            format!("({int}, {int})"),
            "|&(on, off)| (at(on), at(off))",
        ),
        false => ("trigger", "TICKS", int.into(), "|&ticks| at(ticks)"),
    };
    format!(
        "
/// The timer's counts at which to {what}, where it counted `edge` at the edge of the camera's sync:
/// `edge + DELAY_TICKS + {array}[i]`, wrapping.
{ALLOW}
#[must_use]
pub fn due(edge: {int}) -> impl ExactSizeIterator<Item = {item}> {{
    let at = move |ticks: {int}| edge.wrapping_add(DELAY_TICKS).wrapping_add(ticks);
    {array}.iter().map(move {each})
}}
"
    )
}

/// The type of the timer's count.
fn int(plan: &Planned) -> &'static str {
    match plan.timer().bits {
        16 => "u16",
        _ => "u32",
    }
}

/// A number's digits in groups of three.
fn grouped(n: u32) -> String {
    let digits = n.to_string();
    let groups = digits.as_bytes().rchunks(3).rev();
    groups.map(String::from_utf8_lossy).collect::<Vec<_>>().join("_")
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
