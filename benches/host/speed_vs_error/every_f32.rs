//! Every `f32`: the inverse at all of them in [0, 1], and the cdf and the openness at all in a curve's interval. Each
//! answer is held to its range and its neighbour, and one in 65 537 to the oracle.

use rayon::prelude::*;
use shutter_curve::ShutterCurve;

use crate::support::curves::{named, shutter};
use crate::support::oracle::{Curve, Exact, ulp_f32};
use crate::support::promise::{CDF_FLOOR, DENSITY_FLOOR, LEAST_FRACTION};

const CURVES: [&str; 5] = [
    "ends of order p^6",
    "handles cross by 15/16",
    "a vertical step",
    "times from -1 to 1",
    "a density of the least exposure",
];

/// A prime: of so many answers the oracle judges one.
const JUDGED: i64 = 65_537;

/// A function's name, how it answers, and by how many ulp an answer is off.
type Function = (&'static str, fn(&ShutterCurve, f32) -> f32, fn(&Exact, f32, f32) -> f64);

const FUNCTIONS: [Function; 3] = [
    ("inverse_cdf", ShutterCurve::inverse_cdf, backward),
    ("cdf", ShutterCurve::cdf, |exact, t, cdf| exact.near(t).cdf_ulp(cdf, CDF_FLOOR)),
    ("openness", ShutterCurve::openness, |exact, t, f| exact.near(t).openness_ulp(f, DENSITY_FLOOR)),
];

/// In ulp of the fraction; below the least that a frame has in 2⁻⁴⁵, half of which is promised there.
fn backward(exact: &Exact, u: f32, t: f32) -> f64 {
    let error = exact.judge(u, t).backward;
    if u < LEAST_FRACTION { error * ulp_f32(u.into()) / 2f64.powi(-45) } else { error }
}

/// Prints a line for each sweep. An openness may fall.
pub fn every_f32() {
    for (function, name) in FUNCTIONS.iter().flat_map(|function| CURVES.map(|name| (function, name))) {
        let case = named("case").into_iter().find(|case| case.name == name).expect("a case");
        let [out_of_range, falls, error] = sweep(function, &case.curve);
        println!("{} of {name}: {out_of_range} out of range, {falls} falls, error {error:.3} ulp", function.0);
    }
}

/// The `f32` in order: 0 for 0, and from there up and down.
fn place(t: f32) -> i64 {
    let size = i64::from(t.abs().to_bits());
    if t < 0.0 { -size } else { size }
}

fn at(place: i64) -> f32 {
    let size = f32::from_bits(place.unsigned_abs() as u32);
    if place < 0 { -size } else { size }
}

/// Asks for every `f32` for which a function is: the answers out of range, those below the one ahead, the worst error.
fn sweep((name, answer, error): &Function, curve: &Curve) -> [f64; 3] {
    let (ours, exact) = (shutter::<8>(curve), Exact::new(curve));
    let (fractions, times) = ([0.0, 1.0], [curve.open_start(), curve.close_end()]);
    let (inputs, outputs) = if *name == "inverse_cdf" { (fractions, times) } else { (times, fractions) };
    let [first, last] = inputs.map(place);
    // The answer ahead, of a thread's first from there again, and the counts.
    let parts = (first..=last).into_par_iter().fold(
        || (None, [0.0; 3]),
        |(ahead, [out_of_range, falls, worst]), place| {
            let answered = answer(&ours, at(place));
            let ahead = ahead.unwrap_or_else(|| answer(&ours, at(first.max(place - 1))));
            let is_out = !(outputs[0]..=outputs[1]).contains(&answered);
            let error = if place % JUDGED == 0 { error(&exact, at(place), answered) } else { 0.0 };
            (Some(answered), [out_of_range + f64::from(is_out), falls + f64::from(answered < ahead), worst.max(error)])
        },
    );
    parts.map(|(_, counts)| counts).reduce(|| [0.0; 3], |a, b| [a[0] + b[0], a[1] + b[1], a[2].max(b[2])])
}
