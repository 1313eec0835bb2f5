//! Every `f32`: the inverse at all of them in [0, 1], and the cdf and the openness at all in a curve's interval. Each
//! answer is held to its range and its neighbour, and one in 65 537 to the oracle.

use std::collections::HashMap;

use rayon::prelude::*;
use shutter_curve::ShutterCurve;

use crate::report::{number, table};
use crate::support::cases::{CASES, DIM, shutter};
use crate::support::curves::named;
use crate::support::oracle::{Curve, Exact};
use crate::support::promise::{CDF_FLOOR, DENSITY_FLOOR};

/// For the inverse.
const IN_U: [&str; 10] = [
    "rman_soft",
    "triangle",
    "fast_open_slow_close",
    "pedestal_.2",
    "ends of order p^6",
    "handles cross by 15/16",
    DIM,
    "a vertical step",
    "ramps of 1e-6 beside a plateau of 1",
    "times from -1 to 1",
];
/// For the cdf and the openness.
const IN_TIME: [&str; 4] = ["rman_soft", "handles cross by 15/16", DIM, "a join before time 0"];

/// The `f32` that a thread takes at a time, and a prime: of so many the oracle judges one.
const CHUNK: i64 = 1 << 22;
const JUDGED: i64 = 65_537;

/// What is swept: how it answers, and by how many ulp an answer is off.
struct Function {
    name: &'static str,
    curves: &'static [&'static str],
    answer: fn(&ShutterCurve, f32) -> f32,
    error: fn(&Exact, f32, f32) -> f64,
}

const FUNCTIONS: [Function; 3] = [
    Function {
        name: "inverse_cdf",
        curves: &IN_U,
        answer: ShutterCurve::inverse_cdf,
        error: |exact, u, t| exact.judge(u, t).backward,
    },
    Function {
        name: "cdf",
        curves: &IN_TIME,
        answer: ShutterCurve::cdf,
        error: |exact, t, cdf| exact.near(t).cdf_ulp(cdf, CDF_FLOOR),
    },
    Function {
        name: "openness",
        curves: &IN_TIME,
        answer: ShutterCurve::openness,
        error: |exact, t, openness| exact.near(t).openness_ulp(openness, DENSITY_FLOOR),
    },
];

/// The sweeps as a table: on each curve the answers, those out of range, the steps back and the greatest error.
pub fn every_f32() -> String {
    let named = named().into_iter().map(|one| (one.name, one.curve));
    let curves: HashMap<_, _> = named.chain(CASES.iter().map(|case| (case.name, case.curve()))).collect();
    let sweeps = FUNCTIONS.iter().flat_map(|function| function.curves.iter().map(move |name| (function, name)));
    let rows = sweeps.map(|(function, name)| {
        eprintln!("{} of {name} ...", function.name);
        let [answers, out_of_range, steps_back, error] = sweep(function, &curves[name]);
        // The openness may fall.
        let steps_back = if function.name == "openness" { "-".into() } else { steps_back.to_string() };
        vec![
            format!("`{}`", function.name),
            name.to_string(),
            answers.to_string(),
            out_of_range.to_string(),
            steps_back,
            number(error),
        ]
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

/// Asks for every `f32` for which a function is.
fn sweep(function: &Function, curve: &Curve) -> [f64; 4] {
    let (ours, exact) = (shutter::<8>(curve), Exact::new(curve));
    let (fractions, times) = ([0.0, 1.0], [curve.open_start(), curve.close_end()]);
    let (inputs, outputs) = if function.name == "inverse_cdf" { (fractions, times) } else { (times, fractions) };
    let [first, last] = inputs.map(place);
    let part = |from: i64| {
        let to = last.min(from + CHUNK - 1);
        // From the neighbour below, so that no pair is left out between two parts.
        let mut before = (function.answer)(&ours, at(first.max(from - 1)));
        let [mut out_of_range, mut steps_back, mut worst] = [0.0; 3];
        for place in from..=to {
            let answer = (function.answer)(&ours, at(place));
            out_of_range += f64::from(!(outputs[0]..=outputs[1]).contains(&answer));
            steps_back += f64::from(answer < before);
            before = answer;
            if place % JUDGED == 0 {
                worst = f64::max(worst, (function.error)(&exact, at(place), answer));
            }
        }
        [(to - from + 1) as f64, out_of_range, steps_back, worst]
    };
    let parts = (0..=(last - first) / CHUNK).into_par_iter().map(|i| part(first + i * CHUNK));
    parts.reduce(|| [0.0; 4], |a, b| [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3].max(b[3])])
}
