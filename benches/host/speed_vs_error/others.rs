//! Where other systems fail, in figures; `tests/hard_cases.rs` asserts each.

use std::fmt::Write as _;

use shutter_curve::{CubicBezier, ShutterCurve};

use crate::number::number;
use crate::support::cases::{ANIMATION, NO_ROOT, S_RAMP, case, evenly, exact, shutter, worst};
use crate::support::oracle::Exact;
use crate::support::peers::{
    CellTable, Parts, PowerRamp, animation, bracketed, eleven_entries, fixed_point, renderer,
    tolerant,
};

pub const COUNT: u32 = 10_000;

/// A greatest error and how often a function steps back, in words.
fn words((error, back): (f32, usize)) -> String {
    format!("{}, {back} steps back", number(f64::from(error)))
}

pub fn table() -> String {
    let mut out = String::from("| of whom | where | theirs | this crate |\n|---|---|---|---|\n");
    let mut row = |whose: &str, on: &str, theirs: String, ours: String| {
        writeln!(out, "| {whose} | {on} | {theirs} | {ours} |").expect("a string takes text");
    };

    let curve = case(NO_ROOT);
    let ours = shutter::<8>(&curve.curve());
    let (t, _) = Parts::<f32>::new(curve.opening, curve.closing).inverse_cdf(1.0, renderer);
    let says = |t: f32| format!("t = {t}");
    row(
        "a renderer's Newton",
        "u = 1; the ramp ends at 0.9148479",
        says(t),
        says(ours.inverse_cdf(1.0)),
    );

    let curve = case(S_RAMP);
    let ours = shutter::<8>(&curve.curve());
    let parts = Parts::<f32>::new(curve.opening, curve.closing);
    row(
        "the same",
        "the plain S ramp; error of t in [0, 1]",
        words(worst(COUNT, |u| parts.inverse_cdf(u, renderer).0, exact(curve))),
        words(worst(COUNT, |u| ours.inverse_cdf(u), exact(curve))),
    );

    let curve = case("openness of at most 1e-7");
    let ours = shutter::<8>(&curve.curve());
    let parts = Parts::<f32>::new(curve.opening, curve.closing);
    row(
        "a bracketed Newton, 1e-6",
        "openness of at most 1e-7",
        words(worst(COUNT, |u| parts.inverse_cdf(u, bracketed).0, exact(curve))),
        words(worst(COUNT, |u| ours.inverse_cdf(u), exact(curve))),
    );

    let curve = case("ends of order p^3");
    let ours = shutter::<8>(&curve.curve());
    let cells = CellTable::<256>::new(|t| ours.opening(t));
    row(
        "a table made at the middles of cells, read at their edges",
        "ends of order p^3",
        words(worst(COUNT, |u| cells.inverse_cdf(u), exact(curve))),
        words(worst(COUNT, |u| ours.inverse_cdf(u), exact(curve))),
    );
    let dark = CubicBezier::new([(0.0, 0.0), (0.3, 0.0), (0.6, 0.0), (1.0, 0.0)]);
    let refused = ShutterCurve::new(dark, CubicBezier::new([(1.0, 0.0); 4]));
    row(
        "the same",
        "nothing is ever exposed; u = 0",
        says(CellTable::<256>::new(|_| 0.0).inverse_cdf(0.0)),
        refused.map_or_else(|error| error.to_string(), |_| "a curve".into()),
    );

    let curve = case(ANIMATION);
    let truth = Exact::new(&curve.curve());
    let truth = |t: f32| truth.openness(t).to_f32();
    let ours = shutter::<8>(&curve.curve());
    let opening = words(worst(COUNT, |t| ours.opening(t), truth));
    let ramp = PowerRamp::<f32>::new(curve.opening);
    let endless = evenly(COUNT).filter(|t| animation(&ramp, *t, 1e-7).is_none()).count();
    let most = evenly(COUNT).map(|u| ours.evaluations(u)).max().unwrap_or(0);
    row(
        "animation curves in f32, to 1e-7",
        "the curve (1, 0, 0, 1)",
        format!("{endless} of {COUNT} times without end"),
        format!("at most {most} evaluations"),
    );
    let parts = Parts::<f32>::new(curve.opening, curve.closing);
    let theirs = words(worst(COUNT, |t| parts.openness(t, tolerant), truth));
    row("the same, a tolerance of 0.01", "its openness", theirs, opening.clone());
    let doubles = Parts::<f64>::new(curve.opening, curve.closing);
    let eleven = |t: f32| doubles.openness(t.into(), eleven_entries) as f32;
    row(
        "the same, eleven entries",
        "its openness",
        words(worst(COUNT, eleven, truth)),
        opening.clone(),
    );
    let fixed = |t: f32| fixed_point((t * 1024.0) as i64, [1024, 0, 0, 1024]) as f32 / 1024.0;
    row("the same, in 1024ths", "its openness", words(worst(1024, fixed, truth)), opening);
    out
}
