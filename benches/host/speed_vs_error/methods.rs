//! The methods under comparison, each behind the same trait, and the curves that they are timed on.

use std::hint::black_box;

use shutter_curve::ShutterCurve;

use crate::support::baseline::{InverseTable, TextbookNewton};
use crate::support::cases::shutter;
use crate::support::curves::Rng;
use crate::support::oracle::Curve;
use crate::support::peers::{MonotoneCubicTable, Parts, animation, bracketed, doubles};

/// About a third of the mass in ramps; all of it; none.
pub const CURVES: [(&str, Curve); 3] = [
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
    ("box", Curve { opening: [(0.0, 1.0); 4], closing: [(1.0, 1.0); 4] }),
];

/// Fractions in no order: more than a branch predictor learns by heart, so that every branch on u is taken by surprise.
pub fn fractions() -> Vec<f32> {
    let mut rng = Rng::new(1, 0);
    (0..1 << 16).map(|_| rng.unit() as f32).collect()
}

pub trait Inverse {
    /// The time, and how often a polynomial of the mass was evaluated for it.
    fn solve(&self, u: f32) -> (f32, u32);

    fn inverse_cdf(&self, u: f32) -> f32 {
        self.solve(u).0
    }

    /// One call after the other, each result kept from being optimised away.
    fn singles(&self, u: &[f32]) {
        for &u in u {
            black_box(self.inverse_cdf(black_box(u)));
        }
    }
}

impl<const OCTAVES: usize> Inverse for ShutterCurve<OCTAVES> {
    fn solve(&self, u: f32) -> (f32, u32) {
        (self.inverse_cdf(u), self.evaluations(u))
    }
    fn inverse_cdf(&self, u: f32) -> f32 {
        self.inverse_cdf(u)
    }
}

/// A peer is the way in which its data are used.
impl<F: Fn(f32) -> (f32, u32)> Inverse for F {
    fn solve(&self, u: f32) -> (f32, u32) {
        self(u)
    }
}

pub struct Method {
    pub name: &'static str,
    /// Its call and number of octaves in `docs/internals/cost.md`, the table of cycles.
    pub cost: [&'static str; 2],
    pub is_ours: bool,
    pub bytes: usize,
    pub build: fn(&Curve) -> Box<dyn Inverse>,
}

const fn peer<T>(
    name: &'static str,
    cost: &'static str,
    build: fn(&Curve) -> Box<dyn Inverse>,
) -> Method {
    Method { name, cost: [cost, "8"], is_ours: false, bytes: size_of::<T>(), build }
}

const fn ours<const OCTAVES: usize>(name: &'static str, octaves: &'static str) -> Method {
    let bytes = size_of::<ShutterCurve<OCTAVES>>();
    let cost = ["`inverse_cdf`", octaves];
    Method { name, cost, is_ours: true, bytes, build: |c| Box::new(shutter::<OCTAVES>(c)) }
}

/// The place of the textbook Newton, against which times are taken.
pub const TEXTBOOK: usize = 4;

/// Tables are made from exact entries, so that only their own error is seen.
pub const METHODS: [Method; 10] = [
    ours::<0>("`OCTAVES = 0`", "0"),
    ours::<4>("`OCTAVES = 4`", "4"),
    ours::<8>("`OCTAVES = 8`", "8"),
    ours::<16>("`OCTAVES = 16`", "16"),
    peer::<TextbookNewton>("textbook Newton", "textbook Newton in `f32`", |c| {
        let newton = TextbookNewton::new(c.opening, c.closing);
        Box::new(move |u| newton.solve(u))
    }),
    peer::<Parts<f32>>("bracketed Newton", "", |c| {
        let parts = Parts::<f32>::new(c.opening, c.closing);
        Box::new(move |u| parts.inverse_cdf(u, bracketed))
    }),
    peer::<InverseTable<256>>("table of 256", "linear table of 256", table::<256>),
    peer::<InverseTable<1024>>("table of 1024", "", table::<1024>),
    peer::<MonotoneCubicTable<64>>("cubic table of 64", "", |c| {
        let exact = shutter::<16>(c);
        let table = MonotoneCubicTable::<64>::new(|u| exact.inverse_cdf(u));
        Box::new(move |u| (table.inverse_cdf(u), 0))
    }),
    peer::<Parts<f64>>("Newton in f64", "", |c| {
        let parts = Parts::<f64>::new(c.opening, c.closing);
        Box::new(move |u| parts.inverse_cdf(u, doubles))
    }),
];

fn table<const N: usize>(curve: &Curve) -> Box<dyn Inverse> {
    let exact = shutter::<16>(curve);
    let table = InverseTable::<N>::new(|u| exact.inverse_cdf(u));
    Box::new(move |u| (table.inverse_cdf(u), 0))
}

/// Answers for times, and how they are prepared.
pub type Forward = Box<dyn Fn(&[f32], &mut [f32])>;
type Prepared = fn(&Curve) -> Forward;

/// The openness and the cdf in turn, by this crate and by the usual solver of animation curves.
pub const FORWARDS: [(&str, Prepared); 4] = [
    ("`openness`", |c| forward(shutter::<8>(c), |ours, t| ours.openness(t))),
    ("`cdf`", |c| forward(shutter::<8>(c), |ours, t| ours.cdf(t))),
    ("openness, 8 Newton steps", |c| {
        forward(Parts::<f32>::new(c.opening, c.closing), |parts, t| {
            parts.openness(t, |ramp, t| animation(ramp, t, 1e-6).unwrap_or(0.0))
        })
    }),
    ("cdf, 8 Newton steps", |c| {
        forward(Parts::<f32>::new(c.opening, c.closing), |parts, t| {
            parts.cdf(t, |ramp, t| animation(ramp, t, 1e-6).unwrap_or(0.0))
        })
    }),
];

fn forward<T: 'static>(curve: T, call: impl Fn(&T, f32) -> f32 + 'static) -> Forward {
    Box::new(move |times, values| {
        for (t, value) in times.iter().zip(values) {
            *value = call(&curve, black_box(*t));
        }
    })
}
