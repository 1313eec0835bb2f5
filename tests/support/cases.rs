//! The hard cases: curves on which solvers are known to fail, one a reason.
//!
//! `tests/curve/promises.rs` judges them all, `benches/host` the baselines as well.

use shutter_curve::{CubicBezier, ShutterCurve};

use super::curves::{instant, line};
use super::oracle::{Curve, Points};

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
pub fn shutter<const OCTAVES: usize>(curve: &Curve) -> ShutterCurve<OCTAVES> {
    let [opening, closing] = [curve.opening, curve.closing].map(CubicBezier::new);
    ShutterCurve::with_octaves(opening, closing).expect("a good curve")
}

pub const DIM: &str = "a density of the least exposure";

const SOFT: Points = [(0.0, 0.0), (0.1, 0.0), (0.15, 1.0), (0.25, 1.0)];
/// The shortest interval: 2⁻⁶⁴.
const LEAST: f32 = 1.0 / 18446744073709551616.0;

pub const CASES: &[Case] = &[
    Case::new("box: ramps without length", instant(0.0), instant(1.0)),
    Case::new("triangle: plateau without length", line((0.0, 0.0), (0.5, 1.0)), line((0.5, 1.0), (1.0, 0.0))),
    Case::new("area in the opening ramp only", SOFT, instant(0.25)),
    Case::new("area in the closing ramp only", instant(0.75), [(0.75, 1.0), (0.85, 1.0), (0.9, 0.0), (1.0, 0.0)]),
    Case::mirrored("ends of order p^2", line((0.0, 0.0), (0.25, 1.0))),
    Case::mirrored("ends of order p^3", [(0.0, 0.0), (0.0833, 0.0), (0.1667, 0.6), (0.25, 1.0)]),
    Case::mirrored("ends of order p^4", [(0.0, 0.0), (0.0833, 0.0), (0.1667, 0.0), (0.25, 1.0)]),
    Case::mirrored("ends of order p^5", [(0.0, 0.0), (0.0, 0.0), (0.125, 0.0), (0.25, 1.0)]),
    Case::mirrored("ends of order p^6", [(0.0, 0.0), (0.0, 0.0), (0.0, 0.0), (0.25, 1.0)]),
    Case::mirrored("handles cross by 15/16", [(0.0, 0.0), (0.234375, 0.0), (0.0, 1.0), (0.25, 1.0)]),
    Case::mirrored("a vertical step", [(0.0, 0.0), (0.25, 0.0), (0.25, 1.0), (0.25, 1.0)]),
    Case::mirrored("pedestals: jumps at the outer ends", line((0.0, 0.2), (0.25, 1.0))),
    Case::mirrored("ramps of 1e-6 beside a plateau of 1", [(0.0, 0.0), (4e-7, 0.0), (6e-7, 1.0), (1e-6, 1.0)]),
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
        "times around 1000, interval 0.02",
        [(1000.0, 0.0), (1000.002, 0.0), (1000.004, 1.0), (1000.006, 1.0)],
        [(1000.014, 1.0), (1000.016, 1.0), (1000.018, 0.0), (1000.02, 0.0)],
    ),
    Case::new(
        "times from -1 to 1",
        [(-1.0, 0.0), (-0.8, 0.0), (-0.7, 1.0), (-0.5, 1.0)],
        [(0.5, 1.0), (0.7, 1.0), (0.8, 0.0), (1.0, 0.0)],
    ),
    // Here a cdf stepped back: the closing ramp begins at its join with the other one, and runs across time 0.
    Case::new(
        "a join before time 0",
        [(-3.42, 0.0), (-1.89, 0.0), (-1.89, 1.0), (-0.36, 1.0)],
        [(-0.36, 1.0), (1.395, 1.0), (1.395, 0.0), (3.15, 0.0)],
    ),
    Case::new("an interval of 2^-64", line((0.0, 0.0), (0.25 * LEAST, 1.0)), line((0.75 * LEAST, 1.0), (LEAST, 0.0))),
    Case::new(
        "an interval of 2^64",
        line((0.0, 0.0), (0.25 / LEAST, 1.0)),
        line((0.75 / LEAST, 1.0), (1.0 / LEAST, 0.0)),
    ),
    Case::new(DIM, line((0.0, 0.0), (1.0, 1.95e-6)), instant(1.0)),
    Case::new(
        "a renderer finds no root at u = 1",
        [(0.15286648, 0.0), (0.1592916, 0.8779125), (0.21177958, 0.5751004), (0.23325795, 1.0)],
        [(0.31231624, 1.0), (0.51022613, 0.7041771), (0.90155965, 0.80757725), (0.9148479, 0.0)],
    ),
    Case::new("a renderer leaves the plain S ramp", [(0.0, 0.0), (0.5, 0.0), (0.5, 1.0), (1.0, 1.0)], instant(1.0)),
    Case::new(
        "control times next to each other, times of 1e-16",
        [(0.0, 0.0), (2.6676002e-25, 0.20454158), (0.0, 0.17062843), (4.1691618e-16, 1.0)],
        [
            (2.4386949e-15, 1.0),
            (2.9575284e-15, 0.36776537),
            (2.4386949e-15, 1.9981332e-9),
            (4.2029796e-15, 1.9981332e-9),
        ],
    ),
    Case::new(
        "the animation curve (31/32, 0, 1/32, 1)",
        [(0.0, 0.0), (0.96875, 0.0), (0.03125, 1.0), (1.0, 1.0)],
        instant(1.0),
    ),
];
