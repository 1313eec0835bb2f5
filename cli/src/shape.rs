//! The numbers that a shutter's curve is made of.

use shutter_curve::{CubicBezier, CurveError, ShutterCurve};
use shutter_fit::unit::{Unit, rounded, short};

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
    ///
    /// # Errors
    /// Whatever the crate refuses.
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

    /// Another convention by which the inner control points fit, if there is one: its name, and the same points as the
    /// crate takes them. `unit` is the scene's.
    ///
    /// Times go first, as they fit only where the control points lie on their own ramps; small fractions of each ramp
    /// fit easily.
    pub fn misread(&self, unit: Unit) -> Option<(String, [String; 8])> {
        let inner = self.inner?;
        let [open_start, open_end, close_start, close_end] = self.times.map(f64::from);
        let length = close_end - open_start;
        let fraction = |time: f64| (time - open_start) / length;
        let of_ramp = |ramp: usize, x: f64| match ramp {
            0 => open_start + x * (open_end - open_start),
            _ => close_start + x * (close_end - close_start),
        };
        let as_times = |_, x| fraction(unit.seconds(x));
        let as_ramps = |ramp, x| fraction(of_ramp(ramp, x));
        let conventions: [(_, &dyn Fn(usize, f64) -> f64); 2] = [
            (format!("times in {}", unit.name()), &as_times),
            ("fractions of each ramp".into(), &as_ramps),
        ];
        conventions.into_iter().find_map(|(name, convert)| {
            let inner: [f64; 8] = std::array::from_fn(|i| {
                let x = f64::from(inner[i]);
                rounded(if i % 2 == 0 { convert(i / 4, x) } else { x }, 7)
            });
            // What is written is what has to fit.
            let curve = ShutterCurve::shutteropening(self.times, inner.map(|x| x as f32));
            curve.is_ok().then(|| (name, inner.map(|x| short(x, 7))))
        })
    }
}
