//! The methods under comparison, and the curves that they are timed on.

use std::hint::black_box;

use shutter_curve::CubicBezier;

use crate::support::cases::shutter;
use crate::support::curves::{Rng, line, named};
use crate::support::oracle::{Curve, Points};
use baseline::{InverseTable, NearerEnd, StraightRamps};

#[path = "../../baseline.rs"]
mod baseline;

/// The curves' names, here and in the reference data: about a third of the mass in ramps; all of it; a third in
/// straight ramps; none.
pub const CURVES: [[&str; 2]; 4] =
    [["soft", "rman_soft"], ["all ramp", "raised_cosine"], ["trapezoid", "trapezoid"], ["box", "box"]];

/// The places of two of them.
const SOFT: usize = 0;
const TRAPEZOID: usize = 2;

/// The curve with this place in [`CURVES`].
pub fn curve(place: usize) -> Curve {
    let named = named().into_iter().find(|named| named.name == CURVES[place][1]);
    named.expect("the reference data have it").curve
}

/// The leaf shutter of `cli/traces/leaf.csv`, as it is fitted.
pub fn leaf() -> Curve {
    let (opening, closing) = CubicBezier::shutteropening(
        [0.004247017, 0.0068739066, 0.010958795, 0.0129576195],
        [0.1227013, 0.0005207, 0.1941086, 0.9329665, 0.852301, 0.9329665, 0.9066355, 0.0005207],
    );
    Curve::shutter(opening.points(), closing.points())
}

/// Fractions in no order: more than a branch predictor learns by heart, so that every branch on u is taken by surprise.
pub fn fractions(count: usize) -> Vec<f32> {
    let mut rng = Rng::new(1, 0);
    (0..count).map(|_| rng.unit() as f32).collect()
}

/// A method as it is used on a curve.
pub trait Inverse {
    fn inverse_cdf(&self, u: f32) -> f32;

    /// One call after the other, each result kept from being optimised away.
    fn each(&self, us: &[f32]) {
        for &u in us {
            black_box(self.inverse_cdf(black_box(u)));
        }
    }
}

impl<F: Fn(f32) -> f32> Inverse for F {
    fn inverse_cdf(&self, u: f32) -> f32 {
        self(u)
    }
}

type Built = Option<Box<dyn Inverse>>;

#[derive(Clone, Copy, PartialEq)]
pub enum Kind {
    Ours,
    /// For every curve.
    General,
    /// For straight ramps, which have a square root for an inverse.
    Root,
}

pub struct Method {
    pub name: &'static str,
    /// Its call in the table of cycles.
    pub cost: &'static str,
    pub kind: Kind,
    /// For a curve, if it serves that.
    pub build: fn(&Curve) -> Built,
}

use Kind::{General, Ours, Root};

#[rustfmt::skip]
pub const METHODS: [Method; 8] = [
    method("`OCTAVES = 0`", "`inverse_cdf`, `OCTAVES = 0`", Ours, ours::<0>),
    method("`OCTAVES = 4`", "`inverse_cdf`, `OCTAVES = 4`", Ours, ours::<4>),
    method("`OCTAVES = 8`", "`inverse_cdf`", Ours, ours::<8>),
    method("Newton, nearer end", "Newton, nearer end", General, nearer_end),
    method("table of 256", "linear table of 256", General, table),
    method("`libm::sqrtf`", "`libm::sqrtf`", Root, |curve| root(curve, libm::sqrtf)),
    method("`micromath` `sqrt`", "`micromath` `sqrt`", Root, |curve| root(curve, micromath::F32Ext::sqrt)),
    method("the FPU's square root", "the FPU's square root", Root, |curve| root(curve, f32::sqrt)),
];

const fn method(name: &'static str, cost: &'static str, kind: Kind, build: fn(&Curve) -> Built) -> Method {
    Method { name, cost, kind, build }
}

impl Method {
    /// The place in [`CURVES`] of the one that it is compared on.
    pub fn curve(&self) -> usize {
        if self.kind == Root { TRAPEZOID } else { SOFT }
    }
}

fn boxed(inverse: impl Inverse + 'static) -> Built {
    Some(Box::new(inverse))
}

fn ours<const OCTAVES: usize>(curve: &Curve) -> Built {
    let ours = shutter::<OCTAVES>(curve);
    boxed(move |u| ours.inverse_cdf(u))
}

fn nearer_end(curve: &Curve) -> Built {
    let newton = NearerEnd::new(curve.opening, curve.closing);
    boxed(move |u| newton.inverse_cdf(u, f32::sqrt))
}

/// Of exact entries, so that only its own error is seen.
fn table(curve: &Curve) -> Built {
    let exact = shutter::<16>(curve);
    let table = InverseTable::<256>::new(|u| exact.inverse_cdf(u));
    boxed(move |u| table.inverse_cdf(u))
}

/// If the ramps are straight, from 0 to 1 and back, or have no length.
fn root(curve: &Curve, sqrt: impl Fn(f32) -> f32 + 'static) -> Built {
    let is_line = |ramp: Points, [from, to]: [f32; 2]| {
        let [start, .., end] = ramp.map(|point| point.0);
        start == end || ramp == line((start, from), (end, to))
    };
    if !is_line(curve.opening, [0.0, 1.0]) || !is_line(curve.closing, [1.0, 0.0]) {
        return None;
    }
    let times = [curve.open_start(), curve.open_end(), curve.close_start(), curve.close_end()];
    let ramps = StraightRamps::new(times);
    boxed(move |u| ramps.inverse_cdf(u, &sqrt))
}
