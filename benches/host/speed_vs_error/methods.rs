//! The methods under comparison, and the curves that they are timed on.

use std::hint::black_box;

use chart::plotters::style::RGBColor;
use chart::{BLUE, GREY, VERMILION};

use crate::support::curves::{line, named, shutter};
use crate::support::oracle::{Curve, Points};
use baseline::{InverseTable, NearerEnd, StraightRamps};

#[path = "../../baseline.rs"]
mod baseline;

/// The times by which fractions of the exposure are collected, one call after the other.
pub type Inverse = Box<dyn Fn(&[f32]) -> Vec<f32>>;

pub struct Method {
    /// As the table of cycles has it.
    pub name: &'static str,
    /// That of this crate, of methods for every curve, and of those for straight ramps.
    pub color: RGBColor,
    /// For a curve, if it serves that.
    pub build: fn(&Curve) -> Option<Inverse>,
}

#[rustfmt::skip]
pub const METHODS: [Method; 8] = [
    method("`inverse_cdf`, `OCTAVES = 0`", BLUE, ours::<0>),
    method("`inverse_cdf`, `OCTAVES = 4`", BLUE, ours::<4>),
    method("`inverse_cdf`", BLUE, ours::<8>),
    method("Newton, nearer end", VERMILION, nearer_end),
    method("linear table of 256", VERMILION, table),
    method("`libm::sqrtf`", GREY, |curve| root(curve, libm::sqrtf)),
    method("`micromath` `sqrt`", GREY, |curve| root(curve, micromath::F32Ext::sqrt)),
    method("the FPU's square root", GREY, |curve| root(curve, f32::sqrt)),
];

const fn method(name: &'static str, color: RGBColor, build: fn(&Curve) -> Option<Inverse>) -> Method {
    Method { name, color, build }
}

impl Method {
    /// The curve that its cost is compared on, as the table of cycles calls it.
    pub fn costs_on(&self) -> &'static str {
        if self.color == GREY { "trapezoid" } else { "soft" }
    }

    /// It, on that curve.
    pub fn of_cost(&self) -> Inverse {
        (self.build)(&curve(if self.color == GREY { "trapezoid" } else { "rman_soft" })).expect("it serves that curve")
    }
}

/// One of the tests' curves.
pub fn curve(name: &str) -> Curve {
    named("typical").into_iter().find(|named| named.name == name).expect("the reference data have it").curve
}

/// No call is left out, or made before the one ahead of it.
fn each(inverse: impl Fn(f32) -> f32 + 'static) -> Option<Inverse> {
    Some(Box::new(move |us| us.iter().map(|u| black_box(inverse(black_box(*u)))).collect()))
}

fn ours<const OCTAVES: usize>(curve: &Curve) -> Option<Inverse> {
    let ours = shutter::<OCTAVES>(curve);
    each(move |u| ours.inverse_cdf(u))
}

fn nearer_end(curve: &Curve) -> Option<Inverse> {
    let newton = NearerEnd::new(curve.opening, curve.closing);
    each(move |u| newton.inverse_cdf(u, f32::sqrt))
}

/// Of exact entries, so that only its own error is seen.
fn table(curve: &Curve) -> Option<Inverse> {
    let exact = shutter::<16>(curve);
    let table = InverseTable::<256>::new(|u| exact.inverse_cdf(u));
    each(move |u| table.inverse_cdf(u))
}

/// If the ramps are straight, from 0 to 1 and back, or have no length.
fn root(curve: &Curve, sqrt: impl Fn(f32) -> f32 + 'static) -> Option<Inverse> {
    let is_line = |ramp: Points, [from, to]: [f32; 2]| {
        let [start, .., end] = ramp.map(|point| point.0);
        start == end || ramp == line((start, from), (end, to))
    };
    if !is_line(curve.opening, [0.0, 1.0]) || !is_line(curve.closing, [1.0, 0.0]) {
        return None;
    }
    let times = [curve.open_start(), curve.open_end(), curve.close_start(), curve.close_end()];
    let ramps = StraightRamps::new(times);
    each(move |u| ramps.inverse_cdf(u, &sqrt))
}
