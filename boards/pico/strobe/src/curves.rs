//! The curves that the controller knows.

use shutter_curve::{ShutterCurve, valid};

use crate::limits::LONGEST_FRAME;

/// The curves in flash, computed by the compiler: a soft shutter, a leaf shutter, a liquid crystal.
pub static CURVES: [ShutterCurve; 3] = [
    valid(ShutterCurve::shutteropening(
        [0.0, 0.0025, 0.0075, 0.010],
        [0.1, 0.0, 0.15, 1.0, 0.85, 1.0, 0.9, 0.0],
    )),
    valid(ShutterCurve::shutteropening(
        [0.0, 0.0011, 0.0017, 0.0032],
        [0.16, 0.0, 0.24, 0.92, 0.64, 0.95, 0.74, 0.0],
    )),
    valid(ShutterCurve::shutteropening(
        [0.0, 0.0003, 0.003, 0.008],
        [0.01, 0.6, 0.015, 1.0, 0.46, 0.1, 0.6, 0.0],
    )),
];

// No pulse of these is searched for, so the plan of a frame always takes less than a millisecond.
const _: () = {
    let mut i = 0;
    while i < CURVES.len() {
        assert!(CURVES[i].direct_triggers() >= LONGEST_FRAME as u32);
        i += 1;
    }
};
