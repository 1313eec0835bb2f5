//! The curve that is judged, where rounding takes the one that was asked for below a bound.
//!
//! A control value of -1/3 rounds, and with it an openness that touches 0 may dip below, or time may run back by a
//! trace. The library accepts that up to 2⁻²² and lifts the curve onto its bound. How is part of its promise.

use super::dd::{Dd, exp2};

/// A cubic Bezier's control points as (time, openness).
pub type Points = [(f32, f32); 4];

/// A ramp with `f >= 0` and `t' >= 0`.
#[derive(Clone, Copy, Debug)]
pub struct Lifted {
    /// The first and the last time.
    pub ends: [f32; 2],
    /// The differences of neighbouring control times.
    pub steps: [Dd; 3],
    pub openness: [f32; 4],
    pub is_lifted: bool,
}

impl Lifted {
    pub fn new(points: Points) -> Self {
        let given = Self::as_given(points);
        let steps = lifted_steps(points.map(|p| p.0));
        let openness = lifted_openness(given.openness);
        Self {
            ends: given.ends,
            steps: steps.unwrap_or(given.steps),
            openness: openness.unwrap_or(given.openness),
            is_lifted: steps.is_some() || openness.is_some(),
        }
    }

    /// The ramp as it is, for comparison with what others computed for it.
    pub fn as_given(points: Points) -> Self {
        let (t, openness) = (points.map(|p| p.0), points.map(|p| p.1));
        Self { ends: [t[0], t[3]], steps: differences(t), openness, is_lifted: false }
    }

    /// The same, told from its last point.
    pub fn reversed(&self) -> Self {
        let mut other = *self;
        other.ends.reverse();
        other.steps.reverse();
        other.openness.reverse();
        other
    }
}

/// Each is exact.
fn differences(t: [f32; 4]) -> [Dd; 3] {
    [0, 1, 2].map(|i| Dd::from(t[i + 1]) - Dd::from(t[i]))
}

/// `t'` is three times a quadratic with these differences as its Bernstein coefficients. Each rises by what that dips
/// below 0 and a trace more, and is stretched so that the last time is kept.
///
/// The differences that rise are rounded to `f64`, and so is the rise, to the bit as the library has it: where time
/// nearly stands still at an end, what is left of a difference may be 2⁻⁴⁸ of the ramp. From there on nothing cancels.
fn lifted_steps(t: [f32; 4]) -> Option<[Dd; 3]> {
    let steps = differences(t).map(Dd::to_f64);
    let by = rise_of_slope(steps)?;
    let raised = steps.map(|d| Dd::from(d) + Dd::from(by));
    let length = Dd::from(t[3]) - Dd::from(t[0]);
    let stretch = length / raised.into_iter().fold(Dd::ZERO, |sum, d| sum + d);
    Some(raised.map(|d| d * stretch))
}

/// By how much a quadratic has to rise for it not to be below 0 on [0, 1].
fn rise_of_slope(steps: [f64; 3]) -> Option<f64> {
    let [first, middle, last] = steps;
    let is_vertex_inside = middle < first && middle < last;
    let (least, trace) = if is_vertex_inside {
        let bend = (first - middle) + (last - middle);
        let [ends, square] = [first * last, middle * middle];
        ((ends - square) / bend, (ends.abs() + square) / bend * exp2(-49))
    } else {
        (first.min(last), 0.0)
    };
    (least < 0.0).then_some(trace - least)
}

/// The curve is pressed towards the openness of its brighter end, which is kept, until what dips below 0 and a trace
/// more does so no longer: as a Bezier curve is affine in its control values, these are pressed alike. Then each is
/// rounded up to `f32`. Of ends with less than half of the greatest openness none is kept, but that is.
fn lifted_openness(f: [f32; 4]) -> Option<[f32; 4]> {
    let [low, high] = range(f.map(f64::from));
    let brighter = f64::from(f[0].max(f[3]));
    let kept = if brighter < 0.5 * high { high } else { brighter };
    let dip = high * exp2(-48) - low;
    let part = dip / (kept + dip);
    let pressed = |value: f64| value + part * (kept - value);
    (low < 0.0).then(|| f.map(|value| rounded_up(pressed(value as f64))))
}

/// The least `f32` that is not below `x`.
fn rounded_up(x: f64) -> f32 {
    let near = x as f32;
    if (near as f64) < x { near.next_up() } else { near }
}

/// The least and the greatest value of a cubic on [0, 1], from its Bernstein coefficients.
///
/// An extremum inside that is 0 but for rounding is 0. In plain `f64`, and to the bit as the library has it: by how much
/// a curve is lifted decides where the least u are. From both ends, so that the mirrored curve is lifted by the same.
pub fn range(f: [f64; 4]) -> [f64; 2] {
    let [a, b, c, d] = f;
    let (there, back) = (range_from_start(f), range_from_start([d, c, b, a]));
    [there[0].min(back[0]), there[1].max(back[1])]
}

fn range_from_start(f: [f64; 4]) -> [f64; 2] {
    let (a, b, c) = (f[1] - f[0], f[2] - f[1], f[3] - f[2]);
    let (half, square) = (b - a, a - 2.0 * b + c);
    let root = square_root(half * half - a * square);
    let q = if half < 0.0 { -half + root } else { -half - root };
    let inside = [q / square, a / q].into_iter().filter(|p| *p > 0.0 && *p < 1.0);
    let value = |p: f64| {
        let r = 1.0 - p;
        let terms =
            [r * r * r * f[0], 3.0 * r * r * p * f[1], 3.0 * r * p * p * f[2], p * p * p * f[3]];
        let [a, b, c, d] = terms;
        let value = (a + b) + (c + d);
        let [a, b, c, d] = terms.map(f64::abs);
        if value.abs() <= (a + b + c + d) * exp2(-48) { 0.0 } else { value }
    };
    let mut range = [f[0].min(f[3]), f[0].max(f[3])];
    for value in inside.map(value) {
        range = [range[0].min(value), range[1].max(value)];
    }
    range
}

/// Five steps of Newton's method, again to the bit; NaN below 0.
fn square_root(x: f64) -> f64 {
    if x <= 0.0 {
        return if x == 0.0 { 0.0 } else { f64::NAN };
    }
    let start = f64::from_bits((x.to_bits() >> 1) + (1023 << 51));
    (0..5).fold(start, |y, _| 0.5 * (y + x / y))
}
