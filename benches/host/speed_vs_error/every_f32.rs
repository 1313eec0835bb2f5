//! Every `f32`: the inverse at all of them in [0, 1], and the cdf and the openness at all in a curve's interval, held
//! against a second formulation in doubles. A billion of them take a minute or two a curve.

use std::collections::HashMap;
use std::time::Instant;

use rayon::prelude::*;
use shutter_curve::ShutterCurve;

use crate::Result;
use crate::follower::Follower;
use crate::support::cases::{CASES, DIM, shutter};
use crate::support::curves::named;
use crate::support::oracle::{Curve, Dd, Exact, rounding_cell, ulp_f32, value_ulp};
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
/// For the cdf and the openness; the last is of the class on which it stepped back.
const IN_TIME: [&str; 4] = ["rman_soft", "handles cross by 15/16", DIM, "a join before time 0"];

/// The `f32` that one thread takes at a time.
const CHUNK: i64 = 1 << 22;
/// Every so many answers are judged by the double-double oracle too.
const SAMPLED: i64 = 1 << 18;
/// Nearer to time 0 than this part of a curve that runs across it, nothing moves by 2⁻⁴⁰ of an ulp: there one `f32` of
/// so many is taken, in stretches of neighbours.
const NEXT_TO_0: f64 = 1.0 / (1u128 << 64) as f64;
const TAKEN_NEXT_TO_0: i64 = 16;

/// What a sweep of one function found, as a line of `docs/internals/every-f32.csv`; the parts of one add up.
#[derive(Clone, serde::Serialize, serde::Deserialize)]
pub struct Sweep {
    pub function: String,
    curve: String,
    pub count: u64,
    pub out_of_range: u64,
    /// Not of the openness, which may fall.
    pub steps_back: Option<u64>,
    /// The greatest error of the kind that is promised: of the inverse in ulp(u) once half an ulp(t) is forgiven, of a
    /// value in its own ulp at some time within an ulp(t).
    pub error: f64,
    /// The same by the oracle, where the greatest of each part were found and on samples.
    pub judged: f64,
    pub seconds: f64,
}

impl Sweep {
    pub fn and(self, other: Self) -> Self {
        Self {
            count: self.count + other.count,
            out_of_range: self.out_of_range + other.out_of_range,
            steps_back: self.steps_back.zip(other.steps_back).map(|(a, b)| a + b),
            error: self.error.max(other.error),
            judged: self.judged.max(other.judged),
            seconds: self.seconds + other.seconds,
            ..self
        }
    }
}

/// What is swept: how it answers, and by how much an answer is off, as followers at three times say, and the oracle.
struct Function {
    name: &'static str,
    curves: &'static [&'static str],
    answer: fn(&ShutterCurve, f32) -> f32,
    error: fn(&mut [Follower; 3], f32, f32) -> f64,
    judged: fn(&Exact, f32, f32) -> f64,
}

const FUNCTIONS: [Function; 3] = [
    Function {
        name: "inverse_cdf",
        curves: &IN_U,
        answer: ShutterCurve::inverse_cdf,
        error: |[low, high, _], u, t| {
            let [from, to] = rounding_cell(t);
            let values = [low.values(from)[0], high.values(to)[0]].map(Dd::from);
            value_ulp(u, values.into_iter(), |_| ulp_f32(u.into()))
        },
        judged: |exact, u, t| exact.judge(u, t).backward,
    },
    Function {
        name: "cdf",
        curves: &IN_TIME,
        answer: ShutterCurve::cdf,
        error: |followers, t, cdf| value_ulp(cdf, around(followers, t, 0), |value| ulp_f32(value.max(CDF_FLOOR))),
        judged: |exact, t, cdf| exact.near(t).cdf_ulp(cdf, CDF_FLOOR),
    },
    Function {
        name: "openness",
        curves: &IN_TIME,
        answer: ShutterCurve::openness,
        error: |followers, t, f| value_ulp(f, around(followers, t, 1), |value| ulp_f32(value.max(DENSITY_FLOOR))),
        judged: |exact, t, openness| exact.near(t).openness_ulp(openness, DENSITY_FLOOR),
    },
];

/// The cdf, or the openness, at a time, an ulp before and an ulp after. A shutter's is cut to [0, 1].
fn around([before, at, after]: &mut [Follower; 3], t: f32, value: usize) -> impl Iterator<Item = Dd> + use<> {
    let (t, ulp) = (f64::from(t), at.ulp(t.into()));
    let values = [at.values(t), before.values(t - ulp), after.values(t + ulp)];
    values.into_iter().map(move |values| Dd::from(values[value].clamp(0.0, 1.0)))
}

/// The inverse on ten curves, then the cdf and the openness on four. `found` hears of all sweeps so far.
pub fn every_f32(found: impl Fn(&[Sweep]) -> Result) -> Result {
    let named = named().into_iter().map(|one| (one.name, one.curve));
    let curves: HashMap<_, _> = named.chain(CASES.iter().map(|case| (case.name, case.curve()))).collect();
    let mut all = Vec::new();
    for function in &FUNCTIONS {
        for name in function.curves {
            let since = Instant::now();
            let swept = sweep(function, &curves[name]);
            all.push(Sweep { curve: name.to_string(), seconds: since.elapsed().as_secs_f64(), ..swept });
            found(&all)?;
        }
    }
    Ok(())
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

/// Sweeps a function over every `f32` for which it is.
fn sweep(function: &Function, curve: &Curve) -> Sweep {
    let (ours, exact) = (shutter::<8>(curve), Exact::new(curve));
    let (fractions, times) = ([0.0, 1.0], [curve.open_start(), curve.close_end()]);
    let is_inverse = function.name == "inverse_cdf";
    let (inputs, outputs) = if is_inverse { (fractions, times) } else { (times, fractions) };
    let [first, last] = inputs.map(place);
    let still = NEXT_TO_0 * (f64::from(times[1]) - f64::from(times[0]));
    let still = if first < 0 && last > 0 { place(still as f32) } else { -1 };
    let part = |from: i64| {
        let is_still = from >= -still && from + CHUNK - 1 <= still;
        let to = last.min(from + if is_still { CHUNK / TAKEN_NEXT_TO_0 } else { CHUNK } - 1);
        let (mut out_of_range, mut steps_back, mut worst, mut judged) = (0, 0, (0.0, from), 0.0f64);
        let mut followers = [0; 3].map(|_| Follower::new(curve));
        // From the neighbour below, so that no pair is left out between two parts.
        let mut before = if from > first { (function.answer)(&ours, at(from - 1)) } else { outputs[0] };
        for place in from..=to {
            let x = at(place);
            let answer = (function.answer)(&ours, x);
            out_of_range += u64::from(!(outputs[0]..=outputs[1]).contains(&answer));
            steps_back += u64::from(answer < before);
            before = answer;
            let error = (function.error)(&mut followers, x, answer);
            if error > worst.0 {
                worst = (error, place);
            }
            if place % SAMPLED == 0 {
                judged = judged.max((function.judged)(&exact, x, answer));
            }
        }
        let x = at(worst.1);
        judged = judged.max((function.judged)(&exact, x, (function.answer)(&ours, x)));
        let steps_back = (function.name != "openness").then_some(steps_back);
        let (function, count) = (function.name.into(), (to - from) as u64 + 1);
        let (curve, error, seconds) = (String::new(), worst.0, 0.0);
        Sweep { function, curve, count, out_of_range, steps_back, error, judged, seconds }
    };
    let parts = (0..=(last - first) / CHUNK).into_par_iter().map(|i| part(first + i * CHUNK));
    parts.reduce_with(Sweep::and).expect("a part")
}
