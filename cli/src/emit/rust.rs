//! A plan as a module of Rust, which needs no crate unless its curve is asked for.

use std::iter::once;

use super::{MADE_BY, comment, falls, has_pulses, name, origin, pulses, rows, ticks};
use crate::plan::{Curve, Plan};
use crate::shape::Shape;

/// Said of each item: a firmware need not use them all.
const ALLOW: &str = "#[allow(dead_code)]";
/// Said of tables: their digits stand as in every other form, in rows of our own.
const TABLE: &str = "#[allow(dead_code, clippy::unreadable_literal)]\n#[rustfmt::skip]";

/// The file of a module that is called as the scene is.
pub fn module(scene: &str, plan: &Plan, curve: bool) -> String {
    comment("// ", scene, plan) + "\n" + &items(plan, curve)
}

/// The file of a module with one module for each plan, and an array of them all.
pub fn modules(called: &str, plans: &[(String, Plan)], curve: bool) -> String {
    let Some((_, one)) = plans.first() else { return String::new() };
    let int = int(one);
    let mut text = format!("// {MADE_BY}: {}, a shutter of {} speeds.\n\n", name::shown(called), plans.len());
    text += &common(one);
    text += &format!(
        "\n/// A speed of the shutter.\n{ALLOW}\npub struct Speed {{\n    /// The scene's name.\n    \
         pub name: &'static str,\n"
    );
    let delay = one.sync.delay.map(|_| {
        text += &format!("    /// See `DELAY_TICKS`.\n    pub delay_ticks: {int},\n");
        "        delay_ticks: {}::DELAY_TICKS,\n"
    });
    let (array, field) = match has_pulses(one) {
        true => (format!("pulses: &'static [({int}, {int})]"), "        pulses: &{}::PULSES,\n"),
        false => (format!("ticks: &'static [{int}]"), "        ticks: &{}::TICKS,\n"),
    };
    text += &format!("    /// {}\n    pub {array},\n", about(plans.iter().map(|(_, plan)| plan)));
    let shutter = curve.then(|| {
        text += "    /// The shutter, its times in seconds.\n    pub shutter: &'static shutter_curve::ShutterCurve,\n";
        "        shutter: &{}::SHUTTER,\n"
    });
    text +=
        &format!("}}\n\n/// The speeds.\n{ALLOW}\n#[rustfmt::skip]\npub static SPEEDS: [Speed; {}] = [\n", plans.len());
    let fields = delay.into_iter().chain([field]).chain(shutter).collect::<String>();
    for (scene, _) in plans {
        let fields = fields.replace("{}", &name::module(scene));
        text += &format!("    Speed {{\n        name: {:?},\n{fields}    }},\n", name::shown(scene));
    }
    text += "];\n";
    for (scene, plan) in plans {
        let body = module(scene, plan, curve);
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

/// What the speeds of a shutter have in common: the timer, and the edge.
fn common(plan: &Plan) -> String {
    let hz = grouped(plan.timer.hz);
    let mut text = format!("/// The timer's rate.\n{ALLOW}\npub const TIMER_HZ: u32 = {hz};\n");
    if let Some(falls) = falls(plan) {
        text += &format!(
            "\n/// Which edge of the camera's sync counts: the falling one, or the rising one.\n{ALLOW}\n\
             pub const SYNC_FALLS: bool = {falls};\n"
        );
    }
    text
}

/// What the arrays of these hold.
fn about<'a>(plans: impl Iterator<Item = &'a Plan> + Clone) -> String {
    let what = match plans.clone().any(has_pulses) {
        true => "When to switch the lamp on, and when off",
        false => "When to trigger",
    };
    format!("{what}, {}.", origin(plans))
}

/// The items of a plan's module.
fn items(plan: &Plan, curve: bool) -> String {
    let int = int(plan);
    let mut text = common(plan);
    text += &format!("\n/// So many flashes.\n{ALLOW}\npub const COUNT: usize = {};\n", ticks(plan).len());
    if plan.sync.delay.is_some() {
        text += &format!(
            "\n/// {}\n{ALLOW}\npub const DELAY_TICKS: {int} = {};\n",
            super::delay(plan),
            grouped(plan.sync.ticks)
        );
    }
    let (array, rows) = match has_pulses(plan) {
        true => {
            (format!("PULSES: [({int}, {int}); COUNT]"), rows(pulses(plan).map(|(on, off)| format!("({on}, {off})"))))
        }
        false => (format!("TICKS: [{int}; COUNT]"), rows(ticks(plan))),
    };
    text += &format!("\n/// {}\n{TABLE}\npub const {array} = [\n{rows}];\n", about(once(plan)));
    if plan.sync.delay.is_some() {
        text += &from_edge(plan, int);
    }
    match &plan.curve {
        Some(own) if curve => text + &shutter(own),
        _ => text,
    }
}

/// The functions that count from the edge.
fn from_edge(plan: &Plan, int: &str) -> String {
    let [width, on_off, item, each] = match has_pulses(plan) {
        true => [
            "_width",
            "    let (on, off) = PULSES[i];\n    (DELAY_TICKS + on, DELAY_TICKS + off)",
            &format!("({int}, {int})"),
            "PULSES.iter().map(move |&(on, off)| (at(on), at(off)))",
        ],
        false => [
            "width",
            "    let on = DELAY_TICKS + TICKS[i];\n    (on, on + width)",
            int,
            "TICKS.iter().map(move |&ticks| at(ticks))",
        ],
    };
    let (doc, due) = match has_pulses(plan) {
        true => ("its pulse is its own, whatever `_width`", "switch the lamp on, and off"),
        false => ("it is `width` ticks long", "trigger"),
    };
    format!(
        "
/// When to switch flash `i` on, and when off, in ticks after the edge: {doc}.
{ALLOW}
#[must_use]
pub const fn on_off(i: usize, {width}: {int}) -> ({int}, {int}) {{
{on_off}
}}

/// The timer's counts at which to {due}, where it counted `edge` at the edge of the camera's sync; they wrap.
{ALLOW}
#[must_use]
pub fn due(edge: {int}) -> impl ExactSizeIterator<Item = {item}> {{
    let at = move |ticks: {int}| edge.wrapping_add(DELAY_TICKS).wrapping_add(ticks);
    {each}
}}
"
    )
}

/// The curve, for the crate.
fn shutter(curve: &Curve) -> String {
    format!(
        "
use shutter_curve::{{ShutterCurve, expect}};

/// The shutter, its times in seconds.
{TABLE}
pub static SHUTTER: ShutterCurve = expect!(ShutterCurve::{});
",
        constructor(&curve.shape)
    )
}

/// The type of the timer's count.
fn int(plan: &Plan) -> &'static str {
    match plan.timer.bits {
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
