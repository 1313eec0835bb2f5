//! A cubic Bezier curve in (time, openness).

/// A cubic Bezier curve of openness over time, with four control points.
///
/// With the control points `P0` to `P3` and `p` from 0 to 1, its points `(t(p), f(p))` are `P0 (1-p)³ + 3 P1 (1-p)² p +
/// 3 P2 (1-p) p² + P3 p³`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CubicBezier {
    points: [(f32, f32); 4],
}

impl CubicBezier {
    /// Makes a curve from four control points, each a (time, openness). [`ShutterCurve::new`](crate::ShutterCurve::new)
    /// checks them.
    #[must_use]
    pub const fn new(points: [(f32, f32); 4]) -> Self {
        Self { points }
    }

    /// Makes a straight line between two points, each a (time, openness).
    #[must_use]
    pub const fn line(from: (f32, f32), to: (f32, f32)) -> Self {
        const fn third(a: f32, b: f32, n: f64) -> f32 {
            (a as f64 + (b as f64 - a as f64) * (n / 3.0)) as f32
        }
        Self::new([
            from,
            (third(from.0, to.0, 1.0), third(from.1, to.1, 1.0)),
            (third(from.0, to.0, 2.0), third(from.1, to.1, 2.0)),
            to,
        ])
    }

    /// Multiplies every openness by `factor`. The product is exact if `factor` is a power of two and no result is
    /// subnormal or infinite.
    #[must_use]
    pub const fn scaled(&self, factor: f32) -> Self {
        let [(t0, f0), (t1, f1), (t2, f2), (t3, f3)] = self.points;
        Self::new([(t0, f0 * factor), (t1, f1 * factor), (t2, f2 * factor), (t3, f3 * factor)])
    }

    /// Makes the opening and the closing ramp from the arguments of
    /// [`ShutterCurve::shutteropening`](crate::ShutterCurve::shutteropening). Pass them to
    /// [`ShutterCurve::with_octaves`](crate::ShutterCurve::with_octaves).
    #[must_use]
    pub const fn shutteropening(times: [f32; 4], inner: [f32; 8]) -> (Self, Self) {
        let [open_start, open_end, close_start, close_end] = times;
        let [t1, y1, t2, y2, t5, y5, t6, y6] = inner;
        let (start, end) = (open_start as f64, close_end as f64);
        let at = [
            snapped(start, end, t1, open_start, open_end),
            snapped(start, end, t2, open_start, open_end),
            snapped(start, end, t5, close_start, close_end),
            snapped(start, end, t6, close_start, close_end),
        ];
        (
            Self::new([(open_start, 0.0), (at[0], y1), (at[1], y2), (open_end, 1.0)]),
            Self::new([(close_start, 1.0), (at[2], y5), (at[3], y6), (close_end, 0.0)]),
        )
    }

    /// The four control points, each a (time, openness).
    #[must_use]
    pub const fn points(&self) -> [(f32, f32); 4] {
        self.points
    }

    /// The times of the control points; -0.0 counts as 0.0.
    pub(crate) const fn times(&self) -> [f32; 4] {
        let p = &self.points;
        [p[0].0 + 0.0, p[1].0 + 0.0, p[2].0 + 0.0, p[3].0 + 0.0]
    }

    /// The openness of the control points; -0.0 counts as 0.0.
    pub(crate) const fn opennesses(&self) -> [f32; 4] {
        let p = &self.points;
        [p[0].1 + 0.0, p[1].1 + 0.0, p[2].1 + 0.0, p[3].1 + 0.0]
    }
}

/// The time at a `fraction` of the interval from `start` to `end`; or an end of its ramp, `from` or `to`, if the time
/// is beyond it by no more than rounding explains. For the caller rounded times to `f32`, and may have computed the
/// fraction in it, `(t - start) / (end - start)`. Half an ulp of the greatest time is allowed for the ramp's end, as
/// much for `start` and `end` together, and 3 · 2⁻²⁴ of the interval for three operations.
const fn snapped(start: f64, end: f64, fraction: f32, from: f32, to: f32) -> f32 {
    let (fraction, from, to) = (fraction as f64, from as f64, to as f64);
    // From the nearer end, so that 0 and 1 are exact.
    let time = if fraction < 0.5 { start + (end - start) * fraction } else { end - (end - start) * (1.0 - fraction) };
    let nearer = if time < from { from } else { to };
    let on_ramp = if time >= from && time <= to { time } else { nearer };
    let greatest = if -start > end { -start } else { end };
    let rounding = (2.0 * greatest + 3.0 * (end - start)) / (1 << 24) as f64;
    (if (time - on_ramp).abs() <= rounding { on_ramp } else { time }) as f32
}
