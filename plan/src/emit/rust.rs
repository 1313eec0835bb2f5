//! A plan as a module of Rust, which needs no crate unless its curve is asked for.

use super::{HOLD_OFF, MADE_BY, Module, Ticks, name, rows};
use crate::shape::Shape;

/// Said of each item: a firmware need not use them all.
const ALLOW: &str = "#[allow(dead_code)]";
/// Said of tables: their digits stand as in every other form, in rows of our own.
const TABLE: &str = "#[allow(dead_code, clippy::unreadable_literal)]\n#[rustfmt::skip]";
/// What is said of [`Ticks`].
const PULSES: &str = "When to switch the lamp on, and when off";
const TRIGGERS: &str = "When to trigger";

/// The file of a module that is called as the scene is.
pub fn module(module: &Module, curve: bool) -> String {
    let Module { plan, head, edge, ticks, origin, .. } = module;
    let (int, n) = (int(module), plan.triggers.len());
    let head: String = head.iter().map(|line| format!("// {line}").trim_end().to_string() + "\n").collect();
    let delay = edge.as_ref().map_or(String::new(), |edge| {
        let [delay, hold_off] = [edge.delay, edge.hold_off].map(grouped);
        let about = edge.about;
        format!(
            "
/// {about}
{ALLOW}
pub const DELAY_TICKS: {int} = {delay};

/// {HOLD_OFF}
{ALLOW}
pub const HOLD_OFF_TICKS: {int} = {hold_off};
"
        )
    });
    let array = match ticks {
        Ticks::Pulses(pulses) => {
            let rows = rows(pulses.iter().map(|(on, off)| format!("({on}, {off})")));
            format!("/// {PULSES}, {origin}.\n{TABLE}\npub const PULSES: [({int}, {int}); COUNT] = [\n{rows}];\n")
        }
        Ticks::Triggers(ticks) => {
            let rows = rows(ticks.iter());
            format!("/// {TRIGGERS}, {origin}.\n{TABLE}\npub const TICKS: [{int}; COUNT] = [\n{rows}];\n")
        }
    };
    let from_edge = edge.as_ref().map_or(String::new(), |_| from_edge(ticks, int));
    let shutter = plan.curve.as_ref().filter(|_| curve).map_or(String::new(), |curve| {
        format!(
            "
use shutter_curve::{{ShutterCurve, expect}};

/// The shutter, its times in seconds.
{TABLE}
pub static SHUTTER: ShutterCurve = expect!(ShutterCurve::{});
",
            constructor(&curve.shape)
        )
    });
    let common = common(module);
    format!(
        "{head}\n{common}\n/// So many flashes.\n{ALLOW}\npub const COUNT: usize = {n};\n\
         {delay}\n{array}{from_edge}{shutter}"
    )
}

/// The file of a module with one module for each plan, and an array of them all.
pub fn modules(called: &str, modules: &[Module], curve: bool) -> String {
    let Some(one) = modules.first() else { return String::new() };
    let (int, n) = (int(one), modules.len());
    let is_moved = modules.iter().find(|it| it.origin != one.origin || it.origin.ends_with("delay"));
    let origin = is_moved.map_or(one.origin, |_| "counted from the end of the delay");
    let mut fields = vec![("The scene's name.".into(), "name: &'static str".to_string(), None)];
    if one.edge.is_some() {
        fields.push(("See `DELAY_TICKS`.".into(), format!("delay_ticks: {int}"), Some("DELAY_TICKS")));
        fields.push(("See `HOLD_OFF_TICKS`.".into(), format!("hold_off_ticks: {int}"), Some("HOLD_OFF_TICKS")));
    }
    fields.push(match one.ticks {
        Ticks::Pulses(_) => {
            (format!("{PULSES}, {origin}."), format!("pulses: &'static [({int}, {int})]"), Some("&PULSES"))
        }
        Ticks::Triggers(_) => (format!("{TRIGGERS}, {origin}."), format!("ticks: &'static [{int}]"), Some("&TICKS")),
    });
    if curve {
        let field = "shutter: &'static shutter_curve::ShutterCurve".into();
        fields.push(("The shutter, its times in seconds.".into(), field, Some("&SHUTTER")));
    }
    let declared: String =
        fields.iter().map(|(about, field, _)| format!("    /// {about}\n    pub {field},\n")).collect();
    let speed = |module: &Module| {
        let (own, shown) = (name::module(module.scene), name::shown(module.scene));
        let of = |(_, field, item): &(String, String, Option<&str>)| {
            let (field, _) = field.split_once(':').unwrap_or((field, ""));
            match item.map(|item| item.split_at(item.len() - item.trim_start_matches('&').len())) {
                Some((by, item)) => format!("        {field}: {by}{own}::{item},\n"),
                None => format!("        {field}: {shown:?},\n"),
            }
        };
        format!("    Speed {{\n{}    }},\n", fields.iter().map(of).collect::<String>())
    };
    let speeds: String = modules.iter().map(speed).collect();
    let own = |module: &Module| {
        let body = self::module(module, curve);
        let body: String = body.lines().map(|line| format!("    {line}").trim_end().to_string() + "\n").collect();
        format!("\n/// A speed of the shutter.\npub mod {} {{\n{body}}}\n", name::module(module.scene))
    };
    let (shown, common) = (name::shown(called), common(one));
    let own: String = modules.iter().map(own).collect();
    format!(
        "// {MADE_BY}: {shown}, a shutter of {n} speeds.

{common}
/// A speed of the shutter.
{ALLOW}
pub struct Speed {{
{declared}}}

/// The speeds.
{ALLOW}
#[rustfmt::skip]
pub static SPEEDS: [Speed; {n}] = [
{speeds}];
{own}"
    )
}

/// What the speeds of a shutter have in common: the timer, and the edge.
fn common(module: &Module) -> String {
    let hz = grouped(module.plan.timer.hz);
    let rate = format!("/// The timer's rate.\n{ALLOW}\npub const TIMER_HZ: u32 = {hz};\n");
    module.edge.as_ref().map_or(rate.clone(), |edge| {
        format!(
            "{rate}\n/// Which edge of the camera's sync counts: the falling one, or the rising one.\n{ALLOW}\n\
             pub const SYNC_FALLS: bool = {};\n",
            edge.falls
        )
    })
}

/// The functions that count from the edge.
fn from_edge(ticks: &Ticks, int: &str) -> String {
    let item = format!("({int}, {int})");
    let [doc, due, width, on_off, item, each] = match ticks {
        Ticks::Pulses(_) => [
            "its pulse is its own, whatever `_width`",
            "switch the lamp on, and off",
            "_width",
            "    let (on, off) = PULSES[i];\n    (DELAY_TICKS + on, DELAY_TICKS + off)",
            &item,
            "PULSES.iter().map(move |&(on, off)| (at(on), at(off)))",
        ],
        Ticks::Triggers(_) => [
            "it is `width` ticks long",
            "trigger",
            "width",
            "    let on = DELAY_TICKS + TICKS[i];\n    (on, on + width)",
            int,
            "TICKS.iter().map(move |&ticks| at(ticks))",
        ],
    };
    format!(
        "
/// When to switch flash `i` on, and when off, in ticks after the edge: {doc}.
{ALLOW}
#[must_use]
pub const fn on_off(i: usize, {width}: {int}) -> ({int}, {int}) {{
{on_off}
}}

/// The timer's counts at which to {due}, where it counted `edge` at the edge of the camera's sync; they wrap. Take no
/// other edge for `HOLD_OFF_TICKS` after this one.
{ALLOW}
#[must_use]
pub fn due(edge: {int}) -> impl ExactSizeIterator<Item = {item}> {{
    let at = move |ticks: {int}| edge.wrapping_add(DELAY_TICKS).wrapping_add(ticks);
    {each}
}}
"
    )
}

/// The type of the timer's count.
fn int(module: &Module) -> &'static str {
    if module.plan.timer.bits == 16 { "u16" } else { "u32" }
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
