//! The plain frames: as many pulses, gaps and curves as one likes, and what is refused.

use serde_json::Value;
use shutter_curve::{ScheduleError, ShutterCurve};
use strobe::{CURVES, TICK_HZ};

use crate::frame::Frame;
use crate::hostile;
use crate::line::{lines, ok, refused};
use crate::step::{curve, step};

const ASYMMETRIC: &str = "curve 0 0.002 0.004 0.009 0.05 0.1 0.15 1 0.6 1 0.7 0";
const BOX: &str = "curve 0 0 1e-3 1e-3 0 0.5 0 1 1 1 1 0.5";

/// The settings of an answer, of these numbers.
fn set(n: u32, gap: &str, pulse: &str, curve: &str) -> String {
    format!("n {n}, gap {gap}, pulse {pulse}, delay 0ns, edge rising, frames 1, curve {curve}")
}

/// What the crate says of a frame whose pulses are too close.
fn gap_error(frame: Frame) -> String {
    let mut ticks = vec![0; frame.pulses as usize];
    let error = frame.curve.ticks_into(&mut ticks, TICK_HZ, frame.gap).unwrap_err();
    let most = frame.curve.most_triggers(frame.pulses, TICK_HZ, frame.gap).unwrap();
    format!("{error}; up to n {most} it is kept")
}

/// The curves of its own that the board builds.
pub struct Built {
    asymmetric: ShutterCurve,
    abrupt: ShutterCurve,
}

impl Built {
    pub fn new() -> Self {
        Self { asymmetric: curve(ASYMMETRIC).unwrap(), abrupt: curve(BOX).unwrap() }
    }
}

/// A single pulse, which is what is armed at the end.
pub fn single(built: &Built) -> Frame<'_> {
    Frame { pulses: 1, ..touching(built) }
}

/// The state machine's least time from one pulse to the next: 125 us less 48 ns.
fn touching(built: &Built) -> Frame<'_> {
    Frame { curve: &built.abrupt, pulses: 8, ..dense().lit(15_619) }
}

fn short() -> Frame<'static> {
    Frame { gap: 2_500, ..Frame::new(&CURVES[1], 32, 12_500, 250) }
}

fn dense() -> Frame<'static> {
    Frame { curve: &CURVES[2], pulses: 64, ..short().lit(2) }
}

/// Frames of the curves in flash.
pub fn stored() -> Vec<Value> {
    let at_first = Frame::new(&CURVES[0], 12, 12_500, 250);
    let more = Frame { pulses: 32, ..at_first };
    let (short, dense) = (short(), dense());
    let too_close = gap_error(Frame { curve: &CURVES[1], ..more });
    let too_many = ScheduleError::CapacityExceeded { capacity: 64 };
    vec![
        step(at_first, &[ok("n 32", &set(32, "100us", "2us", "1"))]),
        step(more, &[refused("curve 2", too_close)]),
        step(
            more,
            &[
                ok("gap 20us", &set(32, "20us", "2us", "1")),
                ok("curve 2", &set(32, "20us", "2us", "2")),
            ],
        ),
        step(short, &[]),
        lines(&[
            ok("  curve\t3 \r", &set(32, "20us", "2us", "3")),
            ok("pulse 16ns", &set(32, "20us", "16ns", "3")),
            ok("n 64", &set(64, "20us", "16ns", "3")),
            refused("n 65", too_many),
        ]),
        // The frame that was armed before is fired first.
        step(short, &[]),
        // Whatever comes in, it is answered, and nothing changes.
        lines(&hostile::lines(dense)),
    ]
}

/// Frames of curves that are built.
pub fn built(built: &Built) -> Vec<Value> {
    let (dense, touching, single) = (dense(), touching(built), single(built));
    let built = Frame { curve: &built.asymmetric, ..dense };
    let too_long = gap_error(Frame { gap: 15_620 + 6, ..touching });
    vec![
        // The curve takes a quarter of a second to build: meanwhile, frames come as they were, and bytes are lost.
        step(dense, &[(format!("{ASYMMETRIC}\n").into(), None)]),
        step(dense, &[]),
        lines(&[(
            hostile::LONG.into(),
            Some(format!("ok {}", set(64, "20us", "16ns", "of its own"))),
        )]),
        step(dense, &[]),
        lines(&[refused(
            "",
            "bytes of the line were lost; wait for an answer before the next line",
        )]),
        step(built, &[ok("n 8", &set(8, "20us", "16ns", "of its own"))]),
        lines(&[
            ok(BOX, &set(8, "20us", "16ns", "of its own")),
            ok("pulse 124952ns", &set(8, "20us", "124952ns", "of its own")),
            refused("pulse 124960ns", too_long),
        ]),
        step(Frame { pulses: 8, ..built }, &[]),
        step(touching, &[ok("n 1", &set(1, "20us", "124952ns", "of its own"))]),
        step(single, &[]),
    ]
}
