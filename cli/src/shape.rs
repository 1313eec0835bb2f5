//! The numbers that a shutter's curve is made of.

use shutter_curve::{CubicBezier, CurveError, ShutterCurve};

/// A curve as a scene has it: its times in seconds, and its inner control points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// `open_start`, `open_end`, `close_start` and `close_end`.
    pub times: [f32; 4],
    /// The ramps' inner control points `[t1, y1, t2, y2, t5, y5, t6, y6]`, their times as fractions of the interval;
    /// straight ramps without.
    pub inner: Option<[f32; 8]>,
}

impl Shape {
    /// The shutter.
    pub fn curve(&self) -> Result<ShutterCurve, CurveError> {
        let [open_start, open_end, close_start, close_end] = self.times;
        match self.inner {
            Some(inner) => ShutterCurve::shutteropening(self.times, inner),
            None => ShutterCurve::linear(open_start, open_end, close_start, close_end),
        }
    }

    /// The opening and the closing ramp, where they are more than straight lines.
    pub fn ramps(&self) -> Option<[CubicBezier; 2]> {
        let (opening, closing) = CubicBezier::shutteropening(self.times, self.inner?);
        Some([opening, closing])
    }
}
