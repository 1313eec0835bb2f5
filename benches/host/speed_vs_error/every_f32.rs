//! Every `f32`: the inverse at all of them in [0, 1], and the cdf and the openness at all in a curve's interval. Each
//! answer is held to its range and its neighbour, and one in 65 537 to the oracle.

use rayon::prelude::*;
use shutter_curve::ShutterCurve;

use crate::report::{number, table};
use crate::support::cases::{CASES, DIM, shutter};
use crate::support::oracle::{Curve, Exact};
use crate::support::promise::{CDF_FLOOR, DENSITY_FLOOR};

const CURVES: [&str; 5] = ["ends of order p^6", "handles cross by 15/16", "a vertical step", "times from -1 to 1", DIM];

/// The `f32` that a thread takes at a time, and a prime: of so many the oracle judges one.
const CHUNK: i64 = 1 << 22;
const JUDGED: i64 = 65_537;

/// A function's name, how it answers, and by how many ulp an answer is off.
type Function = (&'static str, fn(&ShutterCurve, f32) -> f32, fn(&Exact, f32, f32) -> f64);

const FUNCTIONS: [Function; 3] = [
    ("`inverse_cdf`", ShutterCurve::inverse_cdf, |exact, u, t| exact.judge(u, t).backward),
    ("`cdf`", ShutterCurve::cdf, |exact, t, cdf| exact.near(t).cdf_ulp(cdf, CDF_FLOOR)),
    ("`openness`", ShutterCurve::openness, |exact, t, f| exact.near(t).openness_ulp(f, DENSITY_FLOOR)),
];

/// The sweeps as a table.
pub fn every_f32() -> String {
    let cases = CURVES.map(|name| CASES.iter().find(|case| case.name == name).expect("a case"));
    let sweeps = FUNCTIONS.iter().flat_map(|function| cases.iter().map(move |case| (function, case)));
    let rows = sweeps.map(|(function, case)| {
        eprintln!("{} of {} ...", function.0, case.name);
        let [answers, out_of_range, steps_back, error] = sweep(function, &case.curve());
        // The openness may fall.
        let steps_back = if function.0 == "`openness`" { "-".into() } else { steps_back.to_string() };
        let counts = [answers.to_string(), out_of_range.to_string(), steps_back, number(error)];
        [function.0, case.name].map(String::from).into_iter().chain(counts).collect()
    });
    table("function | curve | answers | out of range | steps back | error, ulp", rows)
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

/// Asks for every `f32` for which a function is: the answers, those out of range, the steps back, the greatest error.
fn sweep((name, answer, error): &Function, curve: &Curve) -> [f64; 4] {
    let (ours, exact) = (shutter::<8>(curve), Exact::new(curve));
    let (fractions, times) = ([0.0, 1.0], [curve.open_start(), curve.close_end()]);
    let (inputs, outputs) = if *name == "`inverse_cdf`" { (fractions, times) } else { (times, fractions) };
    let [first, last] = inputs.map(place);
    let part = |from: i64| {
        let to = last.min(from + CHUNK - 1);
        // From the neighbour below, so that no pair is left out between two parts.
        let mut before = answer(&ours, at(first.max(from - 1)));
        let [mut out_of_range, mut steps_back, mut worst] = [0.0; 3];
        for place in from..=to {
            let answered = answer(&ours, at(place));
            out_of_range += f64::from(!(outputs[0]..=outputs[1]).contains(&answered));
            steps_back += f64::from(answered < before);
            before = answered;
            if place % JUDGED == 0 {
                worst = f64::max(worst, error(&exact, at(place), answered));
            }
        }
        [(to - from + 1) as f64, out_of_range, steps_back, worst]
    };
    let parts = (0..=(last - first) / CHUNK).into_par_iter().map(|i| part(first + i * CHUNK));
    parts.reduce(|| [0.0; 4], |a, b| [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3].max(b[3])])
}
