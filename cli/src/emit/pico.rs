//! A plan as the lines that the strobe controller in boards/pico takes. It plans the frame itself, by its own clock.

use crate::lamp::Lamp;
use crate::planned::Planned;
use crate::shape::Shape;

/// The board's clock: a tick takes 8 ns.
const TICK_HZ: f64 = 125e6;
/// The most pulses of its frame.
const PULSES: usize = 64;
/// Its durations are shorter than 2³² ticks.
const LONGEST: f64 = (1u64 << 32) as f64;

/// The lines, in an order in which each can be planned, whatever the board was set to.
///
/// # Errors
/// Times without a curve, a plan without a delay, and one that the board cannot fire.
pub fn lines(planned: &Planned) -> Result<String, String> {
    let Some(plan) = planned.plan() else {
        return Err(
            "the board plans its frames by a curve, and the scene has trigger times without one: \
                    boards/pico-embassy fires what `--emit rust` makes of them"
                .into(),
        );
    };
    let n = plan.triggers.len();
    let Some(delay) = plan.delay else {
        return Err("the board counts from the edge of the camera's sync, and the scene has no \
                    delay from there to open_start: `delay = 0` if the edge is the opening"
            .into());
    };
    if n > PULSES {
        return Err(format!(
            "the board fires up to {PULSES} pulses a frame, and the scene has {n}"
        ));
    }
    let ticks = |seconds: f64| (seconds * TICK_HZ).round();
    // The frame's end, and the longest gap and pulse that are written.
    let end = ticks(delay.seconds + plan.length());
    if end > LONGEST / 2.0 || ticks(plan.min_gap) > LONGEST / 2.0 {
        return Err("the frame, or its gap, lasts longer than the board can count: 17 s".into());
    }
    let duration = |seconds: f64| format!("{}ns", 8 * ticks(seconds) as u64);
    // Rounded up, for a gap is kept at least; but a decimal fraction that is a whole number of ticks is that.
    let at_least = |seconds: f64| format!("{}ns", 8 * (seconds * TICK_HZ - 1e-3).ceil() as u64);
    let mut delay = ticks(delay.seconds);
    let (lamp, gap) = match plan.lamp {
        // How long the lamp shines is its own affair.
        Lamp::Triggered => ("pulse 2us".into(), at_least(plan.min_gap)),
        // The board's gap is from start to start where pulses are equal, the scene's is darkness.
        Lamp::Equal { ticks: length } => {
            let length = plan.seconds(length);
            // The board's pulses start at their triggers, the scene's lie around them.
            delay -= (ticks(length) / 2.0).floor();
            (format!("pulse {}", duration(length)), at_least(plan.min_gap + length))
        }
        Lamp::Doses { duty } => (format!("duty {duty}"), at_least(plan.min_gap)),
    };
    if delay < 0.0 {
        return Err(
            "the board's pulses start at their triggers, and half a pulse is longer than the delay"
                .into(),
        );
    }
    let (curve, delay) = (curve(&plan.shape), 8 * delay as u64);
    Ok(format!(
        "n 1\nframes 1\npulse 16ns\ngap 0ns\ndelay 0ns\n{curve}\ndelay {delay}ns\nn {n}\n{lamp}\ngap {gap}\n"
    ))
}

/// The curve's numbers, each with the digits that give it back.
fn curve(shape: &Shape) -> String {
    let numbers = shape.times.iter().chain(shape.inner.iter().flatten());
    numbers.fold("curve".into(), |line, number| format!("{line} {number:?}"))
}
