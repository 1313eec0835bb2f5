//! The report's text.

use crate::accuracy::{Figures, of_hard_curves, of_triggers};
use crate::every_f32::Sweep;
use crate::methods::{CURVES, METHODS, Method};
use crate::search::Find;

/// How many hard curves the methods are tried on.
const HARD: usize = 9000;

/// Everything measured; of the methods in their order.
pub struct Measured {
    pub curves: usize,
    pub samples: usize,
    pub figures: Vec<Figures>,
    pub times: Vec<f64>,
    /// The text of `docs/internals/cost.md`.
    pub cost: String,
    pub search: Vec<Find>,
    pub every_f32: Vec<Sweep>,
}

pub fn write(measured: &Measured) -> String {
    let sections = [methods(measured), search(&measured.search), every_f32(&measured.every_f32)];
    sections.join("\n\n") + "\n"
}

/// A method's mean cycles, where `docs/internals/cost.md` has them.
pub fn cycles(measured: &Measured, method: &Method) -> Option<f64> {
    let mut rows = measured.cost.lines().map(|line| line.split(" | ").collect::<Vec<_>>());
    let head = rows.by_ref().find(|row| row[0] == "| call")?;
    let column = head.iter().position(|name| *name == CURVES[method.curve()][0])?;
    let call = format!("| {}", method.cost);
    rows.find(|row| row[0] == call)?.get(column)?.parse().ok()
}

/// A figure as one reads it.
fn number(x: f64) -> String {
    match x.abs() {
        _ if !x.is_finite() => "∞".into(),
        0.0 => "0".into(),
        ..0.01 | 1e6.. => {
            let text = format!("{x:.1e}");
            let (digits, exponent) = text.split_once('e').expect("an exponent");
            format!("{digits}·10<sup>{exponent}</sup>")
        }
        ..0.1 => format!("{x:.3}"),
        ..10.0 => format!("{x:.2}"),
        ..100.0 => format!("{x:.1}"),
        _ => format!("{x:.0}"),
    }
}

/// A table in Markdown, its columns' names between bars: the first of text, the others of figures.
fn table(header: &str, rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let ruled = format!("|---|{}", "---:|".repeat(header.matches('|').count()));
    let rows = rows.into_iter().map(|row| format!("\n| {} |", row.join(" | ")));
    format!("| {header} |\n{ruled}{}", rows.collect::<String>())
}

fn methods(measured: &Measured) -> String {
    let hard = of_hard_curves(HARD);
    let rows = METHODS.iter().enumerate().map(|(i, method)| {
        let Figures { forward, of_interval, steps_back, .. } = measured.figures[i];
        let triggers = of_triggers(method).map_or_else(|| "-".into(), number);
        let time = format!("{:.1}", measured.times[i]);
        let errors = [forward, of_interval.0, hard[i], steps_back].map(number);
        [method.name.into(), time].into_iter().chain(errors).chain([triggers]).collect()
    });
    let table = table("method | ns | ulp(t) | of the interval | hard curves | steps back | a leaf's triggers", rows);
    format!(
        "# Speed against error

Written by `cargo bench -p benches -- --write-docs`. Times are medians from one {arch} core, over 65 536 random `u`, so
that no branch on `u` is predicted; on another machine trust the ratios.

![Error against cost](frontier.svg)

Full dots are the greatest error, rings the mean. [cost.md](cost.md) has the curves, and cycles and bytes.

## The methods

The first three are this crate. *Newton, nearer end* is what one writes without it, with care: sextics from both ends of
each ramp, in `f32` but built in `f64`, and Newton's steps inside a bracket. The table has exact entries at equally
spaced `u`. Square roots, from the nearer end, are for straight ramps alone. `benches/baseline.rs` has them all.

{table}

Times are on *soft*, of square roots on *trapezoid*. Errors are the greatest on {curves} typical curves, by
double-double arithmetic, at {samples} fractions each: half of them uniform, a quarter towards either end by octaves,
where tables and absolute tolerances fail; a time outside the interval counts as the nearer end, and NaN as the start.
Square roots are judged on the {straight} straight ones.

- *ulp(t)*: the forward error, as in [accuracy.md](../accuracy.md)
- *hard curves*: error as a share of the interval, beyond the rounding of the time to an `f32`, on {HARD} curves that
  are hard or meet difficulties exactly (`tests/support/cases.rs`, `aimed.rs`), at some 100 `u` each that are hard on
  them
- *steps back*: how often, of a million neighbouring `f32`, a greater `u` gives an earlier time
- *a leaf's triggers*: error as a share of the interval, in frames of up to 64 on the curve of `cli/traces/leaf.csv`",
        arch = std::env::consts::ARCH,
        curves = measured.curves,
        samples = measured.samples,
        straight = measured.figures.last().map_or(0, |figures| figures.curves),
    )
}

fn search(finds: &[Find]) -> String {
    let tried = finds.first().map_or(0, |find| find.curves);
    let finds = finds.iter().map(|find| format!("\n- {}: {}", find.what, number(find.worst)));
    format!(
        "## Found by search

`cargo bench -p benches -- --search N` climbs from the worst of random and aimed curves by moving control points. Each
is asked what `tests/curve/promises.rs` asks. Of {tried}, none broke a promise; the worst (`search.csv`):
{}",
        finds.collect::<String>()
    )
}

fn every_f32(sweeps: &[Sweep]) -> String {
    let minutes = sweeps.iter().map(|sweep| sweep.seconds).sum::<f64>() / 60.0;
    let rows = sweeps.chunk_by(|a, b| a.function == b.function).map(|sweeps| {
        let all = sweeps.iter().cloned().reduce(Sweep::and).expect("a sweep");
        let steps_back = all.steps_back.map_or_else(|| "-".into(), |steps| steps.to_string());
        let counts = [sweeps.len().to_string(), all.count.to_string(), all.out_of_range.to_string(), steps_back];
        let function = format!("`{}`", all.function);
        [function].into_iter().chain(counts).chain([all.error, all.judged].map(number)).collect()
    });
    let table = table("function | curves | answers | out of range | steps back | error, ulp | judged", rows);
    format!(
        "## Every f32

`cargo bench -p benches -- --every-f32` asks the inverse for all `f32` in [0, 1], and `cdf` and `openness` at all times
of a curve (next to a time 0 inside, at every sixteenth stretch). A second formulation in doubles judges all; the oracle
samples, and the worst of each 4 million (*judged*). It took {minutes:.0} minutes on two busy cores. `every-f32.csv` has
each curve.

{table}

Errors are backward for the inverse; of `cdf` and `openness` those at the best time within an ulp of the one asked for."
    )
}
