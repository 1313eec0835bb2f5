//! The hard cases: curves on which solvers are known to fail, one a reason.
//!
//! `tests/hard_cases.rs` judges them all; `benches/speed_vs_error` prints them beside the baselines.
#![allow(dead_code)] // Each user needs a part.

use shutter_curve::{CubicBezier, ShutterCurve};

use crate::oracle::curves::hard_us;
use crate::oracle::{Curve, Exact, Points};

#[derive(Clone, Copy)]
pub struct Case {
    pub name: &'static str,
    pub opening: Points,
    pub closing: Points,
}

impl Case {
    const fn new(name: &'static str, opening: Points, closing: Points) -> Self {
        Self { name, opening, closing }
    }

    /// A ramp that starts at time 0, and its mirror image about 1/2.
    const fn mirrored(name: &'static str, r: Points) -> Self {
        let [a, b, c, d] = r;
        let closing = [(1.0 - d.0, d.1), (1.0 - c.0, c.1), (1.0 - b.0, b.1), (1.0 - a.0, a.1)];
        Self::new(name, r, closing)
    }

    pub fn curve(&self) -> Curve {
        Curve::shutter(self.opening, self.closing)
    }
}

/// This crate's curve.
pub fn shutter<const CELLS: usize>(curve: &Curve) -> ShutterCurve<CELLS> {
    let [opening, closing] = [curve.opening, curve.closing].map(CubicBezier::new);
    ShutterCurve::with_cells(opening, closing).expect("a good curve")
}

/// What an inverse does on a curve.
#[derive(Clone, Copy, Debug, Default)]
pub struct Verdict {
    /// The greatest error as a fraction of the interval, in ulp(t), and in ulp(u) beyond half an ulp(t).
    pub of_interval: f64,
    pub forward: f64,
    pub backward: f64,
    /// The `u` with the greatest backward error.
    pub at: f32,
    pub steps_back: u32,
    /// Answers that are NaN, outside the interval or off by more than 1 % of it.
    pub failures: u32,
    pub count: u32,
}

/// Judges an inverse on the `u` that are likely to break it.
pub fn judge(exact: &Exact, inverse: impl Fn(f32) -> f32) -> Verdict {
    let mut us = hard_us(exact, 4, 400);
    us.sort_by(f32::total_cmp);
    judge_on(exact, inverse, &us)
}

/// Judges an inverse on these `u`, in order.
pub fn judge_on(exact: &Exact, inverse: impl Fn(f32) -> f32, us: &[f32]) -> Verdict {
    let (start, end) = (exact.curve().open_start(), exact.curve().close_end());
    let mut verdict = Verdict { count: us.len() as u32, ..Verdict::default() };
    let mut last = start;
    for &u in us {
        let t = inverse(u);
        verdict.steps_back += u32::from(t < last);
        last = t;
        if !t.is_finite() {
            verdict.failures += 1;
            continue;
        }
        let errors = exact.judge(u, t);
        let length = f64::from(end) - f64::from(start);
        let of_interval = (f64::from(t) - errors.exact.hi).abs() / length;
        let failed = of_interval > 0.01 || !(t >= start && t <= end);
        verdict.failures += u32::from(failed);
        verdict.of_interval = verdict.of_interval.max(of_interval);
        // Relative to a time of 0 every error is infinite.
        if errors.exact.hi != 0.0 {
            verdict.forward = verdict.forward.max(errors.forward);
        }
        if errors.backward > verdict.backward {
            (verdict.backward, verdict.at) = (errors.backward, u);
        }
    }
    verdict
}

/// The case with this name.
pub fn case(name: &str) -> &'static Case {
    CASES.iter().find(|case| case.name == name).expect("a case of that name")
}

/// The exact inverse, to the `f32`.
pub fn exact(case: &Case) -> impl Fn(f32) -> f32 + use<> {
    let exact = Exact::new(&case.curve());
    move |u| exact.inverse_cdf(u).to_f32()
}

/// Equally spaced numbers from 0 to 1.
pub fn evenly(n: u32) -> impl Iterator<Item = f32> {
    (0..=n).map(move |i| i as f32 / n as f32)
}

/// How far `f` is from `truth` at most, and how often it steps back.
pub fn worst(n: u32, f: impl Fn(f32) -> f32, truth: impl Fn(f32) -> f32) -> (f32, usize) {
    let values: Vec<f32> = evenly(n).map(&f).collect();
    let errors = evenly(n).zip(&values).map(|(x, value)| (value - truth(x)).abs());
    // A NaN is as bad as can be.
    let most = errors.fold(0.0, |most, error| if error <= most { most } else { error });
    (most, values.windows(2).filter(|pair| pair[1] < pair[0]).count())
}

pub const S_RAMP: &str = "a renderer leaves the plain S ramp";
pub const ANIMATION: &str = "the animation curve (1, 0, 0, 1)";

pub const NO_ROOT: &str = "a renderer finds no root at u = 1";

/// No ramp: no length, no area.
const fn instant(t: f32, f: f32) -> Points {
    [(t, f); 4]
}

const fn line(from: (f32, f32), to: (f32, f32)) -> Points {
    CubicBezier::line(from, to).points()
}

const SOFT: Points = [(0.0, 0.0), (0.1, 0.0), (0.15, 1.0), (0.25, 1.0)];
const THIRD: f32 = 1.0 / 3.0;
/// The shortest interval: 2⁻⁶⁴.
const LEAST: f32 = 1.0 / 18446744073709551616.0;

pub const CASES: &[Case] = &[
    Case::new("box: ramps without length", instant(0.0, 1.0), instant(1.0, 1.0)),
    Case::new(
        "triangle: plateau without length",
        line((0.0, 0.0), (0.5, 1.0)),
        line((0.5, 1.0), (1.0, 0.0)),
    ),
    Case::new("area in the opening ramp only", SOFT, instant(0.25, 1.0)),
    Case::new(
        "area in the closing ramp only",
        instant(0.75, 1.0),
        [(0.75, 1.0), (0.85, 1.0), (0.9, 0.0), (1.0, 0.0)],
    ),
    Case::mirrored("ends of order p^2", line((0.0, 0.0), (0.25, 1.0))),
    Case::mirrored("ends of order p^3", [(0.0, 0.0), (0.0833, 0.0), (0.1667, 0.6), (0.25, 1.0)]),
    Case::mirrored("ends of order p^4", [(0.0, 0.0), (0.0833, 0.0), (0.1667, 0.0), (0.25, 1.0)]),
    Case::mirrored("ends of order p^5", [(0.0, 0.0), (0.0, 0.0), (0.125, 0.0), (0.25, 1.0)]),
    Case::mirrored("ends of order p^6", [(0.0, 0.0), (0.0, 0.0), (0.0, 0.0), (0.25, 1.0)]),
    Case::mirrored(
        "both ends of a ramp of high order",
        [(0.0, 0.0), (0.0, 1.0), (0.5, 1.0), (0.5, 0.0)],
    ),
    Case::mirrored("time stands still inside", [(0.0, 0.0), (0.25, 0.0), (0.0, 1.0), (0.25, 1.0)]),
    Case::mirrored("a vertical step", [(0.0, 0.0), (0.25, 0.0), (0.25, 1.0), (0.25, 1.0)]),
    Case::mirrored(
        "control times outside the interval",
        [(0.0, 0.0), (0.3225, 0.0), (0.1694, 1.0), (0.25, 1.0)],
    ),
    Case::mirrored(
        "openness touches 0 inside",
        [(0.0, 1.0), (0.125, -THIRD), (0.25, -THIRD), (0.375, 1.0)],
    ),
    Case::mirrored(
        "openness touches 0 while time stands still",
        [(0.0, 1.0), (0.375, -THIRD), (0.0, -THIRD), (0.375, 1.0)],
    ),
    Case::mirrored(
        "negative control values, openness positive",
        [(0.0, 0.2), (0.1, -0.05), (0.2, 0.3), (0.25, 1.0)],
    ),
    Case::mirrored("pedestals: jumps at the ends", line((0.0, 0.2), (0.25, 0.7))),
    Case::mirrored(
        "ramps of 1e-6 beside a plateau of 1",
        [(0.0, 0.0), (4e-7, 0.0), (6e-7, 1.0), (1e-6, 1.0)],
    ),
    Case::new(
        "plateau of 1e-6 beside ramps of 1/2",
        [(0.0, 0.0), (0.2, 0.0), (0.3, 1.0), (0.5, 1.0)],
        [(0.500001, 1.0), (0.7, 1.0), (0.8, 0.0), (1.0, 0.0)],
    ),
    Case::new(
        "opening of 1e-6 beside a closing ramp of 1",
        line((0.0, 0.0), (1e-6, 1.0)),
        [(1e-6, 1.0), (0.4, 1.0), (0.6, 0.0), (1.0, 0.0)],
    ),
    Case::new(
        "times around 1000, interval 0.01",
        [(1000.0, 0.0), (1000.001, 0.0), (1000.002, 1.0), (1000.003, 1.0)],
        [(1000.007, 1.0), (1000.008, 1.0), (1000.009, 0.0), (1000.01, 0.0)],
    ),
    Case::new(
        "times from -1 to 1",
        [(-1.0, 0.0), (-0.8, 0.0), (-0.7, 1.0), (-0.5, 1.0)],
        [(0.5, 1.0), (0.7, 1.0), (0.8, 0.0), (1.0, 0.0)],
    ),
    Case::new(
        "an interval of 2^-64",
        line((0.0, 0.0), (0.25 * LEAST, 1.0)),
        line((0.75 * LEAST, 1.0), (LEAST, 0.0)),
    ),
    Case::new(
        "an interval of 2^64",
        line((0.0, 0.0), (0.25 / LEAST, 1.0)),
        line((0.75 / LEAST, 1.0), (1.0 / LEAST, 0.0)),
    ),
    Case::new("openness of at most 1e-7", line((0.0, 0.0), (1.0, 1e-7)), instant(1.0, 1e-7)),
    Case::new(
        NO_ROOT,
        [(0.15286648, 0.0), (0.1592916, 0.8779125), (0.21177958, 0.5751004), (0.23325795, 1.0)],
        [(0.31231624, 1.0), (0.51022613, 0.7041771), (0.90155965, 0.80757725), (0.9148479, 0.0)],
    ),
    Case::new(S_RAMP, [(0.0, 0.0), (0.5, 0.0), (0.5, 1.0), (1.0, 1.0)], instant(1.0, 1.0)),
    Case::new(ANIMATION, [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)], instant(1.0, 1.0)),
    // Found by search.
    Case::new(
        "search: 40 evaluations once, time nearly stands still",
        [
            (-0.012876048, 2.6745063e-16),
            (733.19196, 2.6745063e-16),
            (-1718.9233, 2.6745063e-16),
            (6482.0254, 5.2511057e-10),
        ],
        [
            (10059.42, 0.1509275),
            (10115.434, 0.15106562),
            (10149.635, 0.1281859),
            (10159.33, 0.1509275),
        ],
    ),
    Case::new(
        "search: 39 evaluations once, openness touches 0",
        [
            (0.0, 0.016028777),
            (1.746749e-7, -0.06879063),
            (3.8479658e-7, 0.18629807),
            (0.27253214, 0.7034588),
        ],
        [
            (1.1930444, 0.007261409),
            (1.1930444, -0.05084231),
            (1.1930444, 0.25476855),
            (1.766238, 0.38930005),
        ],
    ),
    Case::new(
        "search: 38 evaluations once, a ramp of 1e-7",
        [(0.0, 0.0), (2.1078367e-7, 0.6402282), (-3.608879e-8, 0.52387035), (2.530513e-7, 1.0)],
        [(0.9325748, 0.99998784), (1.2185777, 0.8665585), (1.6825113, 0.5729857), (1.8842529, 0.0)],
    ),
    Case::new(
        "search: 1.7 ulp(u) once, subnormal times",
        [
            (0.0, 0.7326977),
            (0.0, 0.21514332),
            (1.8673053e-11, 0.68320036),
            (1.6512071e-10, 0.21159023),
        ],
        [
            (1.6512071e-10, 1.0),
            (1.6512071e-10, 0.42651063),
            (1.6512071e-10, 0.0),
            (4.401427e-10, 0.00012843996),
        ],
    ),
    Case::new(
        "search: 1300 ulp(t) where hardly any light falls",
        [
            (0.0, 0.18725081),
            (1.2202597e-5, -0.15247062),
            (2.9427052e-5, 0.07795776),
            (3.6296206e-5, 0.05763392),
        ],
        [(3.6296206e-5, 0.0), (0.45170712, 0.0), (0.45170763, 0.0), (0.5013354, 4.129608e-6)],
    ),
    Case::new(
        "search: most evaluations, time nearly stands still",
        [
            (-1.4170574e-7, 7.4466654e-5),
            (0.0017141355, 0.00020371155),
            (-0.01594154, 7.5364485e-5),
            (0.1659236, 0.97904646),
        ],
        [
            (0.52896744, 0.028967945),
            (0.6181761, 0.028844967),
            (0.6602784, 0.028966362),
            (0.66028225, 0.028967945),
        ],
    ),
    Case::new(
        "search: greatest error in ulp(u), times of 1e-16",
        [(0.0, 0.0), (2.6676002e-25, 0.20454158), (0.0, 0.17062843), (4.1691618e-16, 1.0)],
        [
            (2.4386949e-15, 1.0),
            (2.9575284e-15, 0.36776537),
            (2.4386949e-15, 1.9981332e-9),
            (4.2029796e-15, 1.9981332e-9),
        ],
    ),
];
