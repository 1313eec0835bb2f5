//! A plan as a module of Rust, which needs no crate unless its curve is asked for.

use super::{Constant, Literal, MADE_BY, Module, Ticks, name, rows};
use crate::shape::Shape;

/// Said of each item: a firmware need not use them all.
const ALLOW: &str = "#[allow(dead_code)]";
/// Said of tables: their digits stand as in every other form, in rows of our own.
const TABLE: &str = "#[allow(dead_code, clippy::unreadable_literal)]\n#[rustfmt::skip]";
/// The shutter.
const SHUTTER: &str = "The shutter, its times in seconds.";

/// The file of a module that is called as the scene is.
pub fn module(module: &Module, curve: bool) -> String {
    let Module { plan, head, has_edge, ticks, origin, .. } = module;
    let int = int(module);
    let head: String = head.iter().map(|line| format!("// {line}").trim_end().to_string() + "\n").collect();
    let (what, (name, of), rows) = (
        what(ticks),
        array(ticks, int),
        match ticks {
            Ticks::Pulses(pulses) => rows(pulses.iter().map(|(on, off)| format!("({on}, {off})"))),
            Ticks::Triggers(ticks) => rows(ticks.iter()),
        },
    );
    let table = format!("\n/// {what}, {origin}.\n{TABLE}\npub const {name}: [{of}; COUNT] = [\n{rows}];\n");
    let from_edge = if *has_edge { from_edge(ticks, int) } else { String::new() };
    let shutter = plan.curve.as_ref().filter(|_| curve).map_or(String::new(), |curve| {
        let (shutter, uses) = (constructor(&curve.shape), "use shutter_curve::{ShutterCurve, expect};");
        format!(
            "\n{uses}\n\n/// {SHUTTER}\n{TABLE}\n\
             pub static SHUTTER: ShutterCurve = expect!(ShutterCurve::{shutter});\n"
        )
    });
    let [common, own] = [&module.common, &module.own].map(|all| constants(all, int));
    format!("{head}{common}{own}{table}{from_edge}{shutter}")
}

/// The file of a module with one module for each plan, and an array of them all.
pub fn modules(called: &str, modules: &[Module], curve: bool) -> String {
    let Some(one) = modules.first() else { return String::new() };
    let (int, n, origin) = (int(one), modules.len(), super::origin(modules));
    let (what, (array, of)) = (what(&one.ticks), array(&one.ticks, int));
    let field = array.to_ascii_lowercase();
    // What each field is, its type, and its item in the module of a speed.
    let mut fields = vec![("See `DELAY_TICKS`.", "delay_ticks", int, "", "DELAY_TICKS")];
    fields.push(("See `HOLD_OFF_TICKS`.", "hold_off_ticks", int, "", "HOLD_OFF_TICKS"));
    fields.retain(|_| one.has_edge);
    let (about, slice) = (format!("{what}, {origin}."), format!("&'static [{of}]"));
    fields.push((&about, &field, &slice, "&", array));
    let shutter = (SHUTTER, "shutter", "&'static shutter_curve::ShutterCurve", "&", "SHUTTER");
    fields.extend(curve.then_some(shutter));
    let declared = |(about, name, of, ..): &(_, _, _, _, _)| format!("    /// {about}\n    pub {name}: {of},\n");
    let speed = |module: &Module| {
        let (own, shown) = (name::module(module.scene), name::shown(module.scene));
        let field = |(_, name, _, by, item): &(_, _, _, _, _)| format!("        {name}: {by}{own}::{item},\n");
        let fields: String = fields.iter().map(field).collect();
        format!("    Speed {{\n        name: {shown:?},\n{fields}    }},\n")
    };
    let own = |module: &Module| {
        let body = self::module(module, curve);
        let body: String = body.lines().map(|line| format!("    {line}").trim_end().to_string() + "\n").collect();
        format!("\n/// A speed of the shutter.\npub mod {} {{\n{body}}}\n", name::module(module.scene))
    };
    let (declared, speeds) = (fields.iter().map(declared).collect::<String>(), modules.iter().map(speed));
    let (shown, common, speeds) = (name::shown(called), constants(&one.common, int), speeds.collect::<String>());
    let own: String = modules.iter().map(own).collect();
    format!(
        "// {MADE_BY}: {shown}, a shutter of {n} speeds.
{common}
/// A speed of the shutter.
{ALLOW}
pub struct Speed {{
    /// The scene's name.
    pub name: &'static str,
{declared}}}

/// The speeds.
{ALLOW}
#[rustfmt::skip]
pub static SPEEDS: [Speed; {n}] = [
{speeds}];
{own}"
    )
}

/// Constants, of which ticks have the type of the timer's count.
fn constants(all: &[Constant], int: &str) -> String {
    let constant = |(about, name, value): &Constant| {
        let value = match value {
            Literal::Rate(hz) => format!("u32 = {}", grouped(*hz)),
            Literal::Falls(falls) => format!("bool = {falls}"),
            Literal::Count(n) => format!("usize = {n}"),
            Literal::Ticks(ticks) => format!("{int} = {}", grouped(*ticks)),
        };
        format!("\n/// {about}\n{ALLOW}\npub const {name}: {value};\n")
    };
    all.iter().map(constant).collect()
}

/// What a table has.
fn what(ticks: &Ticks) -> &'static str {
    match ticks {
        Ticks::Pulses(_) => "When to switch the lamp on, and when off",
        Ticks::Triggers(_) => "When to trigger",
    }
}

/// A table's name, and the type of its elements.
fn array(ticks: &Ticks, int: &str) -> (&'static str, String) {
    match ticks {
        Ticks::Pulses(_) => ("PULSES", format!("({int}, {int})")),
        Ticks::Triggers(_) => ("TICKS", int.into()),
    }
}

/// The functions that count from the edge.
fn from_edge(ticks: &Ticks, int: &str) -> String {
    let item = array(ticks, int).1;
    let [doc, due, width, on_off, each] = match ticks {
        Ticks::Pulses(_) => [
            "its pulse is its own, whatever `_width`",
            "switch the lamp on, and off",
            "_width",
            "    let (on, off) = PULSES[i];\n    (DELAY_TICKS + on, DELAY_TICKS + off)",
            "PULSES.iter().map(move |&(on, off)| (at(on), at(off)))",
        ],
        Ticks::Triggers(_) => [
            "it is `width` ticks long",
            "trigger",
            "width",
            "    let on = DELAY_TICKS + TICKS[i];\n    (on, on + width)",
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
fn constructor(Shape { times, inner }: &Shape) -> String {
    let [open_start, open_end, close_start, close_end] = times;
    match inner {
        Some(inner) => format!("shutteropening(\n    {times:?},\n    {inner:?},\n)"),
        None => format!("linear({open_start:?}, {open_end:?}, {close_start:?}, {close_end:?})"),
    }
}
