//! The report's text.

use crate::accuracy::{self, Errors, of_triggers};
use crate::methods::METHODS;
use crate::{Result, timing};

/// Everything measured, of the methods in their order.
pub struct Measured {
    samples: usize,
    hard: usize,
    pub errors: Vec<Errors>,
    pub times: Vec<f64>,
    /// Mean cycles of a Cortex-M4F.
    pub cycles: Vec<f64>,
}

impl Measured {
    /// On so many random and so many hard curves; the cycles are those of the page of costs.
    pub fn new(random: u64, samples: usize, hard: usize, repeats: usize, cost: &str) -> Result<Self> {
        let errors = accuracy::errors(&accuracy::curves(random), samples, hard);
        Ok(Self { samples, hard, errors, times: timing::times(repeats), cycles: cycles(cost)? })
    }
}

fn cycles(cost: &str) -> Result<Vec<f64>> {
    let rows: Vec<Vec<_>> = cost.lines().map(|line| line.split(" | ").collect()).collect();
    let cycles = METHODS.iter().map(|method| {
        let head = rows.iter().find(|row| row[0] == "| call")?;
        let column = head.iter().position(|name| *name == method.costs_on())?;
        let row = rows.iter().find(|row| row[0] == format!("| {}", method.name))?;
        row.get(column)?.parse().ok()
    });
    cycles.collect::<Option<_>>().ok_or_else(|| "cost.md lacks a method's cycles".into())
}

/// A figure as one reads it.
pub fn number(x: f64) -> String {
    match x {
        0.0 => "0".into(),
        0.1..10.0 => format!("{x:.2}"),
        10.0..1e6 => format!("{x:.0}"),
        _ => {
            let text = format!("{x:.1e}");
            let (digits, exponent) = text.split_once('e').expect("an exponent");
            format!("{digits}·10<sup>{exponent}</sup>")
        }
    }
}

/// A table in Markdown, its columns' names between bars: the first of text, the others of figures.
pub fn table(header: &str, rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let ruled = format!("|---|{}", "---:|".repeat(header.matches('|').count()));
    let rows = rows.into_iter().map(|row| format!("\n| {} |", row.join(" | ")));
    format!("| {header} |\n{ruled}{}", rows.collect::<String>())
}

pub fn methods(measured: &Measured) -> String {
    let rows = METHODS.iter().zip(&measured.errors).zip(&measured.times).map(|((method, errors), time)| {
        let triggers = of_triggers(method).map_or_else(|| "-".into(), number);
        let errors = [errors.forward, errors.greatest, errors.hard, errors.steps_back].map(number);
        [method.name.into(), format!("{time:.1}")].into_iter().chain(errors).chain([triggers]).collect()
    });
    table("method | ns | ulp(t) | of the interval | hard curves | steps back | a leaf's triggers", rows)
}

pub fn page(measured: &Measured) -> String {
    format!(
        "# Speed against error

Written by `cargo bench -- --write-docs`. Times are medians on one {arch} core, over 65 536 random `u`, so that no
branch on `u` is predicted. On another machine trust the ratios.

![Error against cost](frontier.svg)

Full dots are the greatest error, rings the mean. [cost.md](cost.md) has the curves, cycles and bytes.

The first three methods are this crate. *Newton, nearer end* is what one writes without it, with care: sextics from both
ends of each ramp, in `f32` but built in `f64`, and Newton's steps inside a bracket. The table has exact entries at
equally spaced `u`. Square roots are for straight ramps alone. `benches/baseline.rs` has them all.

{table}

Times are on *soft*, of square roots on *trapezoid*. Errors are the greatest on {curves} typical curves, of square
roots on the {straight} straight ones, at {samples} fractions each from 2⁻²³ on, the least of a frame: half of them
uniform, a quarter towards either end by octaves, where tables and absolute tolerances fail. A time outside the interval
counts as the nearer end, NaN as the start.

- *ulp(t)*: the forward error, as in [accuracy.md](../accuracy.md)
- *hard curves*: error as a share of the interval, beyond the rounding of the time to an `f32`, on {hard} curves that
  are hard or meet difficulties exactly (`tests/data/curves.csv`, `families.rs`), at some 100 hard `u` each
- *steps back*: of a million neighbouring `f32`, how many a greater `u` sends to an earlier time
- *a leaf's triggers*: the same share, in frames of up to 64 on the tests' leaf shutter
",
        table = methods(measured),
        arch = std::env::consts::ARCH,
        curves = measured.errors[0].curves,
        samples = measured.samples,
        hard = measured.hard,
        straight = measured.errors[METHODS.len() - 1].curves,
    )
}
