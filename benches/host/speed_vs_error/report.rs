//! The report's text.

use rayon::prelude::*;

use crate::accuracy::{Figures, breaking_us, judge_on, mended, of_triggers};
use crate::methods::Method::{Nearer, Textbook};
use crate::methods::{CURVES, METHODS, Method, SOFT, TRAPEZOID};
use crate::support::aimed::{FAMILIES, aimed, aimed_us};
use crate::support::cases::{CASES, shutter};
use crate::support::curves::Rng;
use crate::support::oracle::{Curve, Exact};
use crate::table::{Row, number, shown, table};

/// The curves of each family of `aimed`.
const AIMED: u64 = 1000;

/// Everything measured.
pub struct Measured {
    pub curves: usize,
    pub samples: usize,
    pub figures: Vec<Figures>,
    /// By curve.
    pub times: [Vec<Option<f64>>; CURVES.len()],
    /// The text of `docs/internals/cost.md`.
    pub cost: String,
    pub search: Vec<Row>,
    pub every_f32: Vec<Row>,
}

pub fn write(measured: &Measured) -> String {
    let sections = [methods(measured), hard_cases(), search(measured), every_f32(measured)];
    sections.join("\n\n") + "\n"
}

/// The times of this crate's methods on *soft* and *all ramp*, as shares of the careful Newton's.
pub fn ratios(measured: &Measured) -> String {
    let rows = METHODS.iter().filter(|method| method.is_ours()).map(|method| {
        let shares = measured.times[..2].iter().map(|times| {
            let share = time(times, *method).zip(time(times, Nearer)).map(|(own, one)| own / one);
            share.map_or_else(|| "-".into(), |share| format!("{share:.2}"))
        });
        [method.name().into()].into_iter().chain(shares).collect()
    });
    table(&format!("| {} | {}", CURVES[0].0, CURVES[1].0), 1, rows)
}

/// A method's time among those of all.
pub fn time(times: &[Option<f64>], method: Method) -> Option<f64> {
    times[METHODS.iter().position(|one| *one == method)?]
}

/// A method's mean cycles on a curve, where `docs/internals/cost.md` has them.
pub fn cycles(measured: &Measured, method: Method, curve: usize) -> Option<f64> {
    let mut rows = measured.cost.lines().map(|line| line.split(" | ").collect::<Vec<_>>());
    let head = rows.by_ref().find(|row| row[0] == "| call")?;
    let column = head.iter().position(|name| *name == CURVES[curve].0)?;
    let call = format!("| {}", method.cost());
    rows.find(|row| row[0] == call)?.get(column)?.parse().ok()
}

fn methods(measured: &Measured) -> String {
    let rows = METHODS.iter().zip(&measured.figures).map(|(method, figures)| {
        let curve = if method.is_root() { TRAPEZOID } else { SOFT };
        let time = time(&measured.times[curve], *method);
        let time = time.map_or_else(|| "-".into(), |time| format!("{time:.1}"));
        let errors = [figures.forward, figures.of_interval.0, figures.steps_back, figures.failures];
        let triggers = of_triggers(*method).map_or_else(|| "-".into(), number);
        let head = [method.name().to_owned(), time];
        head.into_iter().chain(errors.map(number)).chain([triggers]).collect()
    });
    let header = "method | ns | ulp(t) | of the interval | steps back | failures | a leaf's triggers";
    let table = table(header, 1, rows);
    format!(
        "# Speed against error

Written by `cargo bench -p benches -- --write-docs`. Times are medians from one {arch} core, over 65 536 random `u`, so that no
branch on `u` is predicted; on another machine trust the ratios.

![Error against cost](frontier.svg)

Full dots are the greatest error, rings the mean. [cost.md](cost.md) has the curves, and cycles and bytes.

## The methods

The first four are this crate. *{nearer}* is what one writes without it, with care: sextics from both ends of each ramp, in
`f32` but built in `f64`, and Newton's steps inside a bracket. *Textbook Newton* is a renderer's, from 1/2 and
to an absolute 1e-6. The table has exact entries at equally spaced `u`. Square roots, from the nearer end, are for straight ramps
alone. `benches/baseline.rs` has them all.

{table}

Times are on *soft*, of square roots on *trapezoid*. Errors are the greatest on {curves} typical curves, by double-double arithmetic, at
{samples} fractions each: half of them uniform, a quarter towards either end by octaves, where tables and absolute tolerances fail.
Square roots are judged on the {straight} straight ones.

- *ulp(t)*: the forward error, as in [accuracy.md](../accuracy.md)
- *steps back*: how often, of a million neighbouring `f32`, a greater `u` gives an earlier time
- *failures*: of a million answers, those that are NaN, outside the interval or off by more than 1 % of it; in other columns a
  time outside counts as the nearer end, and NaN as the start
- *a leaf's triggers*: error as a share of the interval, in frames of up to 64 on the curve of `cli/traces/leaf.csv`

![Worst cases](worst-cases.svg)

Each random curve's worst `u` of about 1000 that are likely to be bad. Of those that lie close together, the greatest is drawn.",
        arch = std::env::consts::ARCH,
        nearer = Nearer.name(),
        curves = measured.curves,
        samples = measured.samples,
        straight = measured.figures.last().map_or(0, |figures| figures.curves),
    )
}

/// A row for each case that is hard for another method, one for the others, and one for curves that meet difficulties
/// exactly.
fn hard_cases() -> String {
    let judged = |curve: &Curve, us: &[f32]| {
        let exact = Exact::new(curve);
        let others = [Nearer, Textbook].map(|method| {
            let inverse = method.build(curve).expect("it serves every curve");
            judge_on(&exact, |u| mended(curve, inverse.inverse_cdf(u)), us).of_interval
        });
        let ours = shutter::<8>(curve);
        let own = judge_on(&exact, |u| ours.inverse_cdf(u), us);
        [others[0], others[1], own.of_interval]
    };
    let cases = CASES.iter().map(|case| {
        let curve = case.curve();
        (case.name, judged(&curve, &breaking_us(&Exact::new(&curve))))
    });
    let (told, others): (Vec<_>, Vec<_>) =
        cases.partition(|(_, figures)| figures[..2].iter().any(|error| *error > 0.01));
    let row = |name: String, figures: [f64; 3]| [name].into_iter().chain(figures.map(number)).collect::<Vec<_>>();
    let most = |all: Vec<[f64; 3]>| std::array::from_fn(|i| all.iter().map(|figures| figures[i]).fold(0.0, f64::max));
    let name = format!("{} others, the worst of each column", others.len());
    let others = row(name, most(others.into_iter().map(|(_, figures)| figures).collect()));
    let aimed = (0..FAMILIES.len() as u64 * AIMED).into_par_iter().map(|i| {
        let curve = aimed((i / AIMED) as usize, 1, i);
        judged(&curve, &aimed_us(&Exact::new(&curve), &mut Rng::new(1, i)))
    });
    let aimed: Vec<_> = aimed.collect();
    let name = format!("{} aimed curves, the worst of each column", aimed.len());
    let aimed = row(name, most(aimed));
    let told = told.into_iter().map(|(name, figures)| row(name.into(), figures));
    let header = "case | Newton, nearer end | textbook Newton | this crate, 8 octaves";
    let table = table(header, 1, told.chain([others, aimed]));
    format!(
        "## Hard cases

The greatest error over about 1000 `u` a curve, beyond the rounding of the time to an `f32` and as a share of the interval, where a
Newton errs by more than 1 %. *Aimed* curves meet difficulties exactly (`tests/support/aimed.rs`).

{table}"
    )
}

fn search(measured: &Measured) -> String {
    let (bred, aimed): (Vec<_>, Vec<_>) = measured.search.iter().partition(|row| row["is_bred"] == "true");
    let [tried, each] = [&bred, &aimed].map(|rows| rows.first().map_or("0", |row| &row["curves"]));
    let bred = bred.iter().map(|row| shown(row, "what worst").join(": "));
    let bred = bred.collect::<Vec<_>>().join("\n- ");
    let steps = ["steps_back", "cdf_steps_back", "tick_steps_back"];
    let steps: f64 = steps.into_iter().map(|column| sum(&aimed, column)).sum();
    format!(
        "### Found by search

`cargo bench -p benches -- --search N` climbs from the worst of random curves by moving control points. The worst of {tried}
(`search.csv`), each on about 650 `u` (every seventh for all but ulp(u) and steps back):

- {bred}

On {families} families of aimed curves, {each} of each, {broken} promises were broken, with {steps} steps back.",
        families = aimed.len(),
        broken = sum(&aimed, "breaches"),
    )
}

fn sum(rows: &[&Row], column: &str) -> f64 {
    rows.iter().flat_map(|row| row[column].parse::<f64>()).sum()
}

/// The greatest figure of a column, and a dash where there is none.
fn most(rows: &[&Row], column: &str) -> String {
    let figures = rows.iter().flat_map(|row| row[column].parse::<f64>());
    figures
        .reduce(f64::max)
        .map_or_else(|| "-".into(), |most| if most.fract() == 0.0 { most.to_string() } else { number(most) })
}

fn every_f32(measured: &Measured) -> String {
    let all: Vec<_> = measured.every_f32.iter().collect();
    let minutes = sum(&all, "seconds") / 60.0;
    let mut functions: Vec<_> = all.iter().map(|row| &row["function"]).collect();
    functions.sort();
    functions.dedup();
    let rows = functions.into_iter().map(|function| {
        let of = |row: &&&Row| &row["function"] == function;
        let rows: Vec<_> = all.iter().filter(of).copied().collect();
        let sums = ["count", "out_of_range", "steps_back"].map(|column| match rows[0][column].as_str() {
            "" => "-".into(),
            _ => sum(&rows, column).to_string(),
        });
        let worst = ["error", "judged"].map(|column| most(&rows, column));
        let head = [format!("`{function}`"), rows.len().to_string()];
        head.into_iter().chain(sums).chain(worst).collect()
    });
    let header = "function | curves | answers | out of range | steps back | error, ulp | judged";
    let table = table(header, 1, rows);
    format!(
        "## Every f32

`cargo bench -p benches -- --every-f32` asks the inverse for all `f32` in [0, 1], and `cdf` and `openness` at all times of a
curve (next to a time 0 inside, at every sixteenth stretch). A second formulation in doubles judges all; the oracle samples, and the worst of each 4 million
(*judged*). It took {minutes:.0} minutes on two busy cores. `every-f32.csv` has each curve.

{table}

Errors are backward for the inverse; of `cdf` and `openness` those at the best time within an ulp of the one asked for."
    )
}
