//! The steps of the script, and the curves of its lines.

use serde_json::Value;
use shutter_curve::{CurveError, ShutterCurve};

use crate::frame::Frame;
use crate::line::{Line, lines};

/// The curve of a line that has its numbers.
pub fn curve(line: &str) -> Result<ShutterCurve, CurveError> {
    let numbers: Vec<f32> = line.split(' ').skip(1).map(|number| number.parse().unwrap()).collect();
    match *numbers.as_slice() {
        [a, b, c, d] => ShutterCurve::linear(a, b, c, d),
        [a, b, c, d, ref inner @ ..] => {
            ShutterCurve::shutteropening([a, b, c, d], inner.try_into().unwrap())
        }
        _ => unreachable!("four numbers at least"),
    }
}

/// A frame is started; the lines come while it is fired.
pub fn step(frame: Frame, meanwhile: &[Line]) -> Value {
    let mut step = lines(meanwhile);
    step["frame"] = frame.value();
    step
}
