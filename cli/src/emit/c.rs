//! A plan as a header of C99 and C++11.

use std::iter::once;

use super::{MADE_BY, comment, falls, fnv, has_pulses, name, origin, pulses, rows, ticks};
use crate::plan::Plan;

/// The header of a plan, its names those of the scene.
pub fn header(scene: &str, plan: &Plan) -> String {
    let (lower, upper) = names(scene);
    let (ticks, bits) = (ticks(plan), plan.timer.bits);
    let n = ticks.len();
    let mut body = format!(
        "#include <stdint.h>

/* The timer's rate. */
#define {upper}_TIMER_HZ UINT32_C({})
#define {upper}_COUNT {n}
",
        plan.timer.hz
    );
    if plan.sync.delay.is_some() {
        body += &edge(&upper, plan);
        body +=
            &format!("/* {} */\n#define {upper}_DELAY_TICKS UINT{bits}_C({})\n", super::delay(plan), plan.sync.ticks);
    }
    let array = |about: &str, what: &str, ticks: String| {
        format!("\n/* {about} */\nstatic const uint{bits}_t {lower}_{what}[{upper}_COUNT] = {{\n{ticks}}};\n")
    };
    let origin = origin(once(plan));
    if has_pulses(plan) {
        for (edge, which) in ["on", "off"].into_iter().zip(0..) {
            let ticks = rows(pulses(plan).map(|(on, off)| [on, off][which].to_string()));
            let about = format!("When to switch the lamp {edge}, {origin}.");
            body += &array(&about, edge, ticks);
        }
    } else {
        body += &array(&format!("When to trigger, {origin}."), "ticks", rows(ticks));
    }
    if plan.sync.delay.is_some() {
        let int = format!("uint{bits}_t");
        let (doc, on, off) = match has_pulses(plan) {
            true => (
                "its pulse is its own, whatever `width`",
                format!("{lower}_on[i]"),
                format!("({int})({upper}_DELAY_TICKS + {lower}_off[i]);\n    (void)width;"),
            ),
            false => ("it is `width` ticks long", format!("{lower}_ticks[i]"), format!("({int})(*on + width);")),
        };
        body += &format!(
            "
/* When to switch flash `i` on, and when off, in ticks after the edge: {doc}. */
static inline void {lower}_on_off(uint32_t i, {int} width, {int} *on, {int} *off)
{{
    *on = ({int})({upper}_DELAY_TICKS + {on});
    *off = {off}
}}

/* The timer's count at such ticks, where it counted `edge` at the edge of the camera's sync. */
static inline uint{bits}_t {lower}_due(uint{bits}_t edge, uint{bits}_t ticks)
{{
    return (uint{bits}_t)(edge + {upper}_DELAY_TICKS + ticks); /* wrapping */
}}
"
        );
    }
    format!("/*\n{} */\n{}", comment(" * ", scene, plan), guarded(&upper, &lower, &body))
}

/// The headers of several plans as one, and an array of them.
pub fn headers(called: &str, plans: &[(String, Plan)]) -> String {
    let Some((_, one)) = plans.first() else { return String::new() };
    let (lower, upper) = names(called);
    let bits = one.timer.bits;
    let mut body = format!(
        "#include <stdint.h>\n\n/* The timer's rate. */\n#define {upper}_TIMER_HZ UINT32_C({})\n\
         #define {upper}_SPEEDS {}\n{}\n",
        one.timer.hz,
        plans.len(),
        edge(&upper, one)
    );
    body += "typedef struct {\n    const char *name;\n    uint32_t count;\n";
    if one.sync.delay.is_some() {
        body += &format!("    /* See its _DELAY_TICKS. */\n    uint{bits}_t delay_ticks;\n");
    }
    let origin = origin(plans.iter().map(|(_, plan)| plan));
    body += &format!("    /* So many as `count`, {origin}. */\n");
    let arrays: &[_] = if has_pulses(one) { &["on", "off"] } else { &["ticks"] };
    for array in arrays {
        body += &format!("    const uint{bits}_t *{array};\n");
    }
    body += &format!("}} {lower}_speed;\n\nstatic const {lower}_speed {lower}_speeds[{upper}_SPEEDS] = {{\n");
    for (scene, plan) in plans {
        let (lower, upper) = names(scene);
        let delay = plan.sync.delay.map_or(String::new(), |_| format!("{upper}_DELAY_TICKS, "));
        let arrays = arrays.iter().map(|array| format!("{lower}_{array}")).collect::<Vec<_>>();
        body += &format!("    {{\"{lower}\", {upper}_COUNT, {delay}{}}},\n", arrays.join(", "));
    }
    body += "};\n";
    let made = format!("/*\n * {MADE_BY}: {}, a shutter of {} speeds.\n */\n", name::shown(called), plans.len());
    let speeds: String = plans.iter().map(|(scene, plan)| header(scene, plan) + "\n").collect();
    // A name of its own, so that a scene may be called as the whole is.
    made + "\n" + &speeds + &guarded(&format!("{upper}_SPEEDS"), &lower, &body)
}

/// Which edge of the sync counts, if there is a delay from it.
fn edge(upper: &str, plan: &Plan) -> String {
    falls(plan).map_or(String::new(), |falls| {
        let falls = u8::from(falls);
        format!(
            "/* Which edge of the camera's sync counts: the falling one (1), or the rising one (0). */\n\
             #define {upper}_SYNC_FALLS {falls}\n"
        )
    })
}

fn names(scene: &str) -> (String, String) {
    let lower = name::identifier(scene);
    let upper = lower.to_ascii_uppercase();
    (lower, upper)
}

/// The body, once; another one of the same name does not compile, rather than being left out in silence.
fn guarded(upper: &str, lower: &str, body: &str) -> String {
    let hash = format!("0x{:08X}U", fnv(body.bytes()));
    format!(
        "#ifndef {upper}_SCHEDULE_H
#define {upper}_SCHEDULE_H {hash}

{body}
#elif {upper}_SCHEDULE_H != {hash}
#error \"two different schedules are called {lower}: give one of them another name\"
#endif
"
    )
}
