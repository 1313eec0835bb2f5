//! What makes it a controller that one would ship: the delay, the edge, several frames, doses, and settings that are saved.

use serde_json::Value;
use shutter_curve::{Pulse, ScheduleError};
use strobe::{CURVES, MIN_LOW, TICK_HZ};

use crate::frame::{Frame, Light};
use crate::line::{lines, ok, refused, told};
use crate::step::step as frame;

/// The steps after which the frame `single` is the one that is armed: each setting on its own, to the one that [`saves`] begins with.
pub fn steps(single: Frame) -> Vec<Value> {
    let [soft, leaf, _] = &CURVES;
    let plain = Frame::new(soft, 12, 12_500, 250);
    // 4.2470169 ms, to the nearest tick.
    let delayed = Frame { delay: 530_877, ..plain };
    let falling = Frame { falls: true, ..delayed };
    let burst = Frame { frames: (3, 1_500_000), ..falling };
    let doses = Frame { light: Light::Doses(0.3), gap: 2_500, ..burst };
    let touching = Frame { curve: leaf, light: Light::Doses(0.9), gap: 0, frames: (1, 0), ..doses };
    let all = "n 12, gap 100us, pulse 2us, delay 0ns, edge rising, frames 1, curve 1";
    let set = |changes: &[(&str, &str)]| {
        changes.iter().fold(all.to_string(), |all, (from, to)| all.replace(from, to))
    };
    let late = ("delay 0ns", "delay 4247016ns");
    let fall = ("rising", "falling");
    let three = ("frames 1", "frames 3, every 12ms");
    let lit = ("gap 100us, pulse 2us", "gap 20us, duty 0.3");
    let denser = ("gap 100us, pulse 2us", "gap 0ns, duty 0.9");
    let too_full = too_close(touching, 1.0);
    vec![
        lines(&[
            ok(
                "curve 1",
                "n 1, gap 20us, pulse 124952ns, delay 0ns, edge rising, frames 1, curve 1",
            ),
            ok("pulse 2us", "n 1, gap 20us, pulse 2us, delay 0ns, edge rising, frames 1, curve 1"),
            ok("gap 100us", "n 1, gap 100us, pulse 2us, delay 0ns, edge rising, frames 1, curve 1"),
            ok("n 12", all),
            told("?", format!("strobe {}: {all}", env!("CARGO_PKG_VERSION"))),
        ]),
        // So short that lines come too late for the next.
        frame(single, &[]),
        frame(plain, &[ok("delay 4.2470169ms", &set(&[late]))]),
        frame(delayed, &[ok("edge falling", &set(&[late, fall]))]),
        frame(falling, &[ok("frames 3 12ms", &set(&[late, fall, three]))]),
        frame(
            burst,
            &[
                ok("gap 20us", &set(&[late, fall, three, ("gap 100us", "gap 20us")])),
                ok("duty 0.3", &set(&[late, fall, three, lit])),
            ],
        ),
        frame(
            doses,
            &[
                ok("frames 1", &set(&[late, fall, lit])),
                ok("gap 0ns", &set(&[late, fall, lit, ("gap 20us", "gap 0ns")])),
                ok("duty 0.9", &set(&[late, fall, denser])),
                ok("curve 2", &set(&[late, fall, denser, ("curve 1", "curve 2")])),
                refused("duty 1", too_full),
            ],
        ),
        // The edge back, and the first set-up; the frame that is armed waits for the falling edge still.
        frame(
            touching,
            &[
                ok("edge rising", &set(&[late, denser, ("curve 1", "curve 2")])),
                ok("duty 0.3", &set(&[late, denser, ("curve 1", "curve 2"), ("0.9", "0.3")])),
                ok("curve 1", &set(&[late, denser, ("0.9", "0.3")])),
            ],
        ),
    ]
}

/// Saves, and edges during them.
pub fn saves() -> Vec<Value> {
    let doses = Frame {
        light: Light::Doses(0.3),
        delay: 530_877,
        gap: 0,
        ..Frame::new(&CURVES[0], 12, 0, 0)
    };
    let kept = "n 12, gap 0ns, duty 0.3, delay 4247016ns, edge rising, frames 1, curve 1";
    let saved = |number: u32| told("save", format!("saved {kept}; save {number} of this flash"));
    vec![
        // An edge while settings are saved: the first time a sector is erased, which takes longer than the frame. Meanwhile
        // more bytes come than the UART holds. What is left of them is not taken for a line, though `n` before the loss and `2`
        // after it would be one.
        full(at_save(frame(doses, &[saved(1), refused("", LOST)]))),
        at_save(frame(doses, &[saved(2)])),
        frame(doses, &[]),
    ]
}

const LOST: &str = "bytes of the line were lost; wait for an answer before the next line";

/// The edge comes while the flash is written.
fn at_save(mut step: Value) -> Value {
    step["atSave"] = true.into();
    step
}

/// More comes then than the UART holds, and the rest after the answer.
fn full(mut step: Value) -> Value {
    step["send"] = b"save\n".as_slice().into();
    step["meanwhile"] = format!("{:30}n{:33}", "", "").into_bytes().into();
    step["rest"] = b"2\n".as_slice().into();
    step
}

/// What the crate says of pulses with so small a pause.
fn too_close(frame: Frame, duty: f32) -> ScheduleError {
    let mut pulses = vec![Pulse::default(); frame.pulses as usize];
    frame.curve.pulses_into(&mut pulses, duty, TICK_HZ, shutter_curve::PulseLimits { min_pulse: 2, min_gap: MIN_LOW }).unwrap_err()
}
