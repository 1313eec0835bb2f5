//! A plan as a header of C99 and C++11.

use super::{Constant, Literal, MADE_BY, Module, Ticks, name, rows};

/// The header of a plan, its names those of the scene.
pub fn header(module: &Module) -> String {
    let Module { head, has_edge, ticks, origin, .. } = module;
    let ((lower, upper), int) = (names(module.scene), int(module));
    let head: String = head.iter().map(|line| format!(" * {line}").trim_end().to_string() + "\n").collect();
    let array = |what: &str, name: &str, ticks: &mut dyn Iterator<Item = u32>| {
        let rows = rows(ticks);
        format!("\n/* {what}, {origin}. */\nstatic const {int} {lower}_{name}[{upper}_COUNT] = {{\n{rows}}};\n")
    };
    let (arrays, doc, on, off) = match ticks {
        Ticks::Pulses(pulses) => (
            array("When to switch the lamp on", "on", &mut pulses.iter().map(|pulse| pulse.0))
                + &array("When to switch the lamp off", "off", &mut pulses.iter().map(|pulse| pulse.1)),
            "its pulse is its own, whatever `width`",
            "on",
            format!("({int})({upper}_DELAY_TICKS + {lower}_off[i]);\n    (void)width;"),
        ),
        Ticks::Triggers(ticks) => (
            array("When to trigger", "ticks", &mut ticks.iter().copied()),
            "it is `width` ticks long",
            "ticks",
            format!("({int})(*on + width);"),
        ),
    };
    let from_edge = format!(
        "
/* When to switch flash `i` on, and when off, in ticks after the edge: {doc}. */
static inline void {lower}_on_off(uint32_t i, {int} width, {int} *on, {int} *off)
{{
    *on = ({int})({upper}_DELAY_TICKS + {lower}_{on}[i]);
    *off = {off}
}}

/* The timer's count at such ticks, where it counted `edge` at the edge of the camera's sync. Take no other edge for
 * {upper}_HOLD_OFF_TICKS after this one. */
static inline {int} {lower}_due({int} edge, {int} ticks)
{{
    return ({int})(edge + {upper}_DELAY_TICKS + ticks); /* wrapping */
}}
"
    );
    let from_edge = if *has_edge { from_edge } else { String::new() };
    let [common, own] = [&module.common, &module.own].map(|all| constants(all, &upper, module));
    format!("/*\n{head} */\n{INCLUDE}{common}{own}{arrays}{from_edge}")
}

/// The headers of several plans as one, and an array of them.
pub fn headers(called: &str, modules: &[Module]) -> String {
    let Some(one) = modules.first() else { return String::new() };
    let ((lower, upper), int, n) = (names(called), int(one), modules.len());
    let origin = super::origin(modules);
    let arrays: &[_] = if matches!(one.ticks, Ticks::Pulses(_)) { &["on", "off"] } else { &["ticks"] };
    let delay = format!(
        "    /* See its _DELAY_TICKS. */\n    {int} delay_ticks;\n    /* See its _HOLD_OFF_TICKS. */\n    {int} \
         hold_off_ticks;\n"
    );
    let delay = if one.has_edge { delay } else { String::new() };
    let fields: String = arrays.iter().map(|array| format!("    const {int} *{array};\n")).collect();
    let speed = |module: &Module| {
        let (lower, upper) = names(module.scene);
        let ticks = format!("{upper}_DELAY_TICKS, {upper}_HOLD_OFF_TICKS, ");
        let delay = if one.has_edge { ticks } else { String::new() };
        let arrays = arrays.iter().map(|array| format!("{lower}_{array}")).collect::<Vec<_>>().join(", ");
        format!("    {{\"{lower}\", {upper}_COUNT, {delay}{arrays}}},\n")
    };
    let (speeds, common) = (modules.iter().map(speed).collect::<String>(), constants(&one.common, &upper, one));
    let headers: String = modules.iter().map(|module| header(module) + "\n").collect();
    let shown = name::shown(called);
    format!(
        "/*
 * {MADE_BY}: {shown}, a shutter of {n} speeds.
 */

{headers}{common}#define {upper}_SPEEDS {n}

typedef struct {{
    const char *name;
    uint32_t count;
{delay}    /* So many as `count`, {origin}. */
{fields}}} {lower}_speed;

static const {lower}_speed {lower}_speeds[{upper}_SPEEDS] = {{
{speeds}}};
"
    )
}

/// Another header of the same name does not compile beside it, rather than being left out in silence.
const INCLUDE: &str = "#pragma once\n#include <stdint.h>\n\n";

/// Constants, as macros.
fn constants(all: &[Constant], upper: &str, module: &Module) -> String {
    let constant = |(about, name, value): &Constant| {
        let value = match value {
            Literal::Rate(hz) => format!("UINT32_C({hz})"),
            Literal::Falls(falls) => u8::from(*falls).to_string(),
            Literal::Count(n) => n.to_string(),
            Literal::Ticks(ticks) => format!("UINT{}_C({ticks})", module.plan.timer.bits),
        };
        format!("/* {about} */\n#define {upper}_{name} {value}\n")
    };
    all.iter().map(constant).collect()
}

/// The type of the timer's count.
fn int(module: &Module) -> &'static str {
    if module.plan.timer.bits == 16 { "uint16_t" } else { "uint32_t" }
}

fn names(scene: &str) -> (String, String) {
    let lower = name::identifier(scene);
    let upper = lower.to_ascii_uppercase();
    (lower, upper)
}
