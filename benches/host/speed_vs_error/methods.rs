//! The methods under comparison, and the curves that they are timed on; `cargo bench` has them from here, too.

use std::hint::black_box;

use micromath::F32Ext;
use shutter_curve::{CubicBezier, ShutterCurve};

use crate::support::cases::shutter;
use crate::support::curves::Rng;
use crate::support::oracle::{Curve, Points};
use baseline::{InverseTable, NearerEnd, StraightRamps, TextbookNewton};

#[path = "../../baseline.rs"]
mod baseline;

/// About a third of the mass in ramps; all of it; a third in straight ramps; none.
pub const CURVES: [(&str, Curve); 4] = [
    (
        "soft",
        Curve {
            opening: [(0.0, 0.0), (0.1, 0.0), (0.15, 1.0), (0.25, 1.0)],
            closing: [(0.75, 1.0), (0.85, 1.0), (0.9, 0.0), (1.0, 0.0)],
        },
    ),
    (
        "all ramp",
        Curve {
            opening: [(0.0, 0.0), (0.18, 0.0), (0.32, 1.0), (0.5, 1.0)],
            closing: [(0.5, 1.0), (0.68, 1.0), (0.82, 0.0), (1.0, 0.0)],
        },
    ),
    (
        "trapezoid",
        Curve {
            opening: CubicBezier::line((0.0, 0.0), (0.25, 1.0)).points(),
            closing: CubicBezier::line((0.75, 1.0), (1.0, 0.0)).points(),
        },
    ),
    ("box", Curve { opening: [(0.0, 1.0); 4], closing: [(1.0, 1.0); 4] }),
];

/// The places of two of them.
pub const SOFT: usize = 0;
pub const TRAPEZOID: usize = 2;

/// The leaf shutter of `cli/traces/leaf.csv`, as it is fitted.
pub fn leaf() -> Curve {
    let (opening, closing) = CubicBezier::shutteropening(
        [0.004247017, 0.0068739066, 0.010958795, 0.0129576195],
        [0.1227013, 0.0005207, 0.1941086, 0.9329665, 0.852301, 0.9329665, 0.9066355, 0.0005207],
    );
    Curve::shutter(opening.points(), closing.points())
}

/// Fractions in no order: more than a branch predictor learns by heart, so that every branch on u is taken by surprise.
pub fn fractions() -> Vec<f32> {
    let mut rng = Rng::new(1, 0);
    (0..1 << 16).map(|_| rng.unit() as f32).collect()
}

pub trait Inverse {
    fn inverse_cdf(&self, u: f32) -> f32;

    /// One call after the other, each result kept from being optimised away.
    fn singles(&self, u: &[f32]) {
        for &u in u {
            black_box(self.inverse_cdf(black_box(u)));
        }
    }
}

impl<const OCTAVES: usize> Inverse for ShutterCurve<OCTAVES> {
    fn inverse_cdf(&self, u: f32) -> f32 {
        self.inverse_cdf(u)
    }
}

/// A peer is the way in which its data are used.
impl<F: Fn(f32) -> f32> Inverse for F {
    fn inverse_cdf(&self, u: f32) -> f32 {
        self(u)
    }
}

/// What is done with an inverse, whose type the compiler knows there.
pub trait Task {
    type Answer;
    fn on(self, inverse: impl Inverse + 'static) -> Self::Answer;
}

struct Boxed;

impl Task for Boxed {
    type Answer = Box<dyn Inverse>;
    fn on(self, inverse: impl Inverse + 'static) -> Self::Answer {
        Box::new(inverse)
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    Octaves0,
    Octaves4,
    Octaves8,
    Octaves16,
    Nearer,
    Textbook,
    Table256,
    RootLibm,
    RootMicromath,
    RootFpu,
}

use Method::*;

/// This crate's, those for every curve, and those for straight ramps alone.
pub const METHODS: [Method; 10] =
    [Octaves0, Octaves4, Octaves8, Octaves16, Nearer, Textbook, Table256, RootLibm, RootMicromath, RootFpu];

impl Method {
    pub const fn is_ours(self) -> bool {
        matches!(self, Octaves0 | Octaves4 | Octaves8 | Octaves16)
    }

    /// Only straight ramps have a square root for an inverse.
    pub const fn is_root(self) -> bool {
        matches!(self, RootLibm | RootMicromath | RootFpu)
    }

    pub const fn name(self) -> &'static str {
        match self {
            Octaves0 => "`OCTAVES = 0`",
            Octaves4 => "`OCTAVES = 4`",
            Octaves8 => "`OCTAVES = 8`",
            Octaves16 => "`OCTAVES = 16`",
            Nearer => "Newton, nearer end",
            Textbook => "textbook Newton",
            Table256 => "table of 256",
            RootLibm => "`libm::sqrtf`",
            RootMicromath => "`micromath` `sqrt`",
            RootFpu => "the FPU's square root",
        }
    }

    /// Its call in the table of cycles.
    pub const fn cost(self) -> &'static str {
        match self {
            Octaves0 => "`inverse_cdf`, `OCTAVES = 0`",
            Octaves4 => "`inverse_cdf`, `OCTAVES = 4`",
            Octaves8 => "`inverse_cdf`",
            Octaves16 => "`inverse_cdf`, `OCTAVES = 16`",
            Textbook => "textbook Newton in `f32`",
            Table256 => "linear table of 256",
            _ => self.name(),
        }
    }

    /// Does something with the inverse of a curve, if it has one. Tables are made from exact entries, so that only
    /// their own error is seen.
    pub fn on<T: Task>(self, c: &Curve, task: T) -> Option<T::Answer> {
        let exact = || {
            let exact = shutter::<16>(c);
            move |u| exact.inverse_cdf(u)
        };
        Some(match self {
            Octaves0 => task.on(shutter::<0>(c)),
            Octaves4 => task.on(shutter::<4>(c)),
            Octaves8 => task.on(shutter::<8>(c)),
            Octaves16 => task.on(shutter::<16>(c)),
            Nearer => {
                let newton = NearerEnd::new(c.opening, c.closing);
                task.on(move |u| newton.inverse_cdf(u, f32::sqrt))
            }
            Textbook => {
                let newton = TextbookNewton::new(c.opening, c.closing);
                task.on(move |u| newton.inverse_cdf(u))
            }
            Table256 => {
                let table = InverseTable::<256>::new(exact());
                task.on(move |u| table.inverse_cdf(u))
            }
            RootLibm => {
                let ramps = straight(c)?;
                task.on(move |u| ramps.inverse_cdf(u, libm::sqrtf))
            }
            RootMicromath => {
                let ramps = straight(c)?;
                task.on(move |u| ramps.inverse_cdf(u, F32Ext::sqrt))
            }
            RootFpu => {
                let ramps = straight(c)?;
                task.on(move |u| ramps.inverse_cdf(u, f32::sqrt))
            }
        })
    }

    pub fn build(self, curve: &Curve) -> Option<Box<dyn Inverse>> {
        self.on(curve, Boxed)
    }
}

/// The curve, if its ramps are straight, from 0 to 1 and back, or have no length.
fn straight(curve: &Curve) -> Option<StraightRamps> {
    let is_line = |ramp: Points, [from, to]: [f32; 2]| {
        let [start, .., end] = ramp.map(|point| point.0);
        start == end || ramp == CubicBezier::line((start, from), (end, to)).points()
    };
    let is_straight = is_line(curve.opening, [0.0, 1.0]) && is_line(curve.closing, [1.0, 0.0]);
    let times = [curve.open_start(), curve.open_end(), curve.close_start(), curve.close_end()];
    is_straight.then(|| StraightRamps::new(times))
}
