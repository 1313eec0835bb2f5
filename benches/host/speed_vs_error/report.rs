//! The report's text.

use crate::Result;
use crate::accuracy::{Figures, of_triggers};
use crate::methods::{CURVES, METHODS};

/// Everything measured; of the methods in their order.
pub struct Measured {
    pub curves: usize,
    pub samples: usize,
    /// How many hard curves there were, and the methods' errors on them.
    pub hard: (usize, Vec<f64>),
    pub figures: Vec<Figures>,
    pub times: Vec<f64>,
    /// Mean cycles of a Cortex-M4F.
    pub cycles: Vec<f64>,
}

/// The methods' mean cycles, as the page of costs has them.
pub fn cycles(cost: &str) -> Result<Vec<f64>> {
    let rows: Vec<Vec<_>> = cost.lines().map(|line| line.split(" | ").collect()).collect();
    let cycles = METHODS.iter().map(|method| {
        let head = rows.iter().find(|row| row[0] == "| call")?;
        let column = head.iter().position(|name| *name == CURVES[method.curve()][0])?;
        let row = rows.iter().find(|row| row[0] == format!("| {}", method.cost))?;
        row.get(column)?.parse().ok()
    });
    cycles.collect::<Option<_>>().ok_or_else(|| "cost.md lacks a method's cycles".into())
}

/// A figure as one reads it.
pub fn number(x: f64) -> String {
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
pub fn table(header: &str, rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let ruled = format!("|---|{}", "---:|".repeat(header.matches('|').count()));
    let rows = rows.into_iter().map(|row| format!("\n| {} |", row.join(" | ")));
    format!("| {header} |\n{ruled}{}", rows.collect::<String>())
}

pub fn methods(measured: &Measured) -> String {
    let rows = METHODS.iter().enumerate().map(|(i, method)| {
        let Figures { forward, of_interval, steps_back, .. } = measured.figures[i];
        let triggers = of_triggers(method).map_or_else(|| "-".into(), number);
        let time = format!("{:.1}", measured.times[i]);
        let errors = [forward, of_interval.0, measured.hard.1[i], steps_back].map(number);
        [method.name.into(), time].into_iter().chain(errors).chain([triggers]).collect()
    });
    table("method | ns | ulp(t) | of the interval | hard curves | steps back | a leaf's triggers", rows)
}

pub fn page(measured: &Measured) -> String {
    format!(
        "# Speed against error

Written by `cargo bench -- --write-docs`. Times are medians on one {arch} core, over 65 536 random `u`, so that no
branch on `u` is predicted. On another machine trust the ratios.

![Error against cost](frontier.svg)

Full dots are the greatest error, rings the mean. [cost.md](cost.md) has the curves, and cycles and bytes.

The first three methods are this crate. *Newton, nearer end* is what one writes without it, with care: sextics from both
ends of each ramp, in `f32` but built in `f64`, and Newton's steps inside a bracket. The table has exact entries at
equally spaced `u`. Square roots, from the nearer end, are for straight ramps alone. `benches/baseline.rs` has them all.

{table}

Times are on *soft*, of square roots on *trapezoid*. Errors are the greatest on {curves} typical curves, by
double-double arithmetic, at {samples} fractions each that a frame can have, from 2⁻²³ on: half of them uniform, a
quarter towards either end by octaves, where tables and absolute tolerances fail. A time outside the interval counts as
the nearer end, NaN as the start. Square roots are judged on the {straight} straight ones.

- *ulp(t)*: the forward error, as in [accuracy.md](../accuracy.md)
- *hard curves*: error as a share of the interval, beyond the rounding of the time to an `f32`, on {hard} curves that
  are hard or meet difficulties exactly (`tests/support/cases.rs`, `aimed.rs`), at some 100 hard `u` each
- *steps back*: how often, of a million neighbouring `f32`, a greater `u` gives an earlier time
- *a leaf's triggers*: error as a share of the interval, in frames of up to 64 on the curve of `cli/traces/leaf.csv`
",
        table = methods(measured),
        arch = std::env::consts::ARCH,
        curves = measured.curves,
        samples = measured.samples,
        hard = measured.hard.0,
        straight = measured.figures.last().map_or(0, |figures| figures.curves),
    )
}

pub fn every_f32(table: &str) -> String {
    format!(
        "# Every f32

Written by `cargo bench -- --every-f32`, in half an hour. It asks for the inverse of all `f32`
in [0, 1], and for `cdf` and `openness` at all times of a curve. The oracle judges one answer in 65 537: errors are
backward for the inverse, else those at the best time within an ulp.

{table}
"
    )
}
