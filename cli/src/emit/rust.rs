//! A plan as a module of Rust.

use super::{MADE_BY, base, comment, has_pulses, name, pulses, rows, ticks};
use crate::planned::Planned;
use crate::shape::Shape;

/// Said of the whole file: a firmware need not use all items, and ticks are for no reader.
const ALLOW: &str = "#![allow(dead_code, clippy::unreadable_literal)]\n";

/// The file of a module that is called as the scene is.
pub fn module(scene: &str, plan: &Planned) -> String {
    comment("// ", scene, plan) + "\n" + ALLOW + "\n" + &items(plan)
}

/// The file of a module with one module for each plan, and an array of them all.
pub fn modules(called: &str, plans: &[(String, Planned)]) -> String {
    let Some((_, one)) = plans.first() else { return String::new() };
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

{ALLOW}
{import}/// The timer's rate.
pub const TIMER_HZ: u32 = {};

/// A speed of the shutter.
pub struct Speed {{
    /// The scene's name.
    pub name: &'static str,
{shutter}",
        name::shown(called),
        plans.len(),
        one.timer_hz()
    );
    if one.delay().is_some() {
        text += "    /// From the edge of the camera's sync to the start of opening.\n    pub delay_ticks: u32,\n";
    }
    text += "    /// When to trigger, counted from the start of opening.\n    pub ticks: &'static [u32],\n";
    if has_pulses(one) {
        text += "    /// When to switch the lamp on, and when off, counted as `ticks` are.\n    pub pulses: &'static [(u32, u32)],\n";
    }
    text += &format!(
        "}}\n\n/// The speeds.\n#[rustfmt::skip]\npub static SPEEDS: [Speed; {}] = [\n",
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
    let ticks = ticks(plan);
    let n = ticks.len();
    let shutter = plan.plan().map(|plan| {
        format!(
            "use shutter_curve::{{ShutterCurve, valid}};

/// The shutter, its times in seconds.
#[rustfmt::skip]
pub static SHUTTER: ShutterCurve = valid(ShutterCurve::{});

",
            constructor(&plan.shape)
        )
    });
    let mut text = format!(
        "{}/// The timer's rate.
pub const TIMER_HZ: u32 = {};
",
        shutter.unwrap_or_default(),
        plan.timer_hz(),
    );
    if let Some(delay) = plan.delay() {
        text += &format!(
            "\n/// From the edge of the camera's sync to the start of opening.\npub const DELAY_TICKS: u32 = {};\n",
            delay.ticks
        );
    }
    text += &format!(
        "\n/// When to trigger. {}\n#[rustfmt::skip]\npub const TICKS: [u32; {n}] = [\n{}];\n",
        base(plan, "[`DELAY_TICKS`]"),
        rows(ticks),
    );
    if has_pulses(plan) {
        text += &format!(
            "
/// When to switch the lamp on, and when off, counted as [`TICKS`] are.
#[rustfmt::skip]
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
