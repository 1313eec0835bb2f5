//! The report's text.

use rayon::prelude::*;

use crate::accuracy::{Figures, breaking_us, judge_on, mended, of_triggers};
use crate::methods::Method::{Nearer, Table256, Textbook};
use crate::methods::{CURVES, FORWARDS, METHODS, Method, TRAPEZOID};
use crate::rendering::{PULSES, Pulses};
use crate::support::aimed::{FAMILIES, aimed, aimed_us};
use crate::support::cases::{CASES, shutter};
use crate::support::curves::Rng;
use crate::support::oracle::{Curve, Exact};
use crate::table::{Row, number, shown, table};
use crate::timing::Times;

/// The curves of each family of `aimed`.
const AIMED: u64 = 1000;

/// Everything measured.
pub struct Measured {
    pub curves: usize,
    pub samples: usize,
    pub figures: Vec<Figures>,
    /// By curve.
    pub times: [Times; CURVES.len()],
    /// The text of `docs/internals/cost.md`.
    pub cost: String,
    /// The error of the pictures in so many pulses.
    pub rendering: Vec<(u32, [f64; 3])>,
    pub search: Vec<Row>,
    pub every_f32: Vec<Row>,
}

pub fn write(measured: &Measured) -> String {
    let sections = [
        introduction(measured),
        methods(measured),
        forwards(measured),
        hard_cases(),
        search(measured),
        every_f32(measured),
        rendering(measured),
    ];
    sections.join("\n\n") + "\n"
}

fn introduction(measured: &Measured) -> String {
    format!(
        "# Speed against error

Written by `cargo bench -p benches -- --write-docs`; nothing here is typed by hand. Times are from one {} core of
an ordinary machine, medians of interleaved repeats, in short runs, over 65 536 random `u`, so that no branch on `u` is ever
predicted; on another machine trust the ratios.

Errors are measured against double-double arithmetic on {} typical curves (those of `tests/data` and random ones), {}
fractions each: half of them uniform, a quarter towards either end by octaves, where tables and absolute tolerances fail.

- *forward* and *backward*: as [accuracy.md](../accuracy.md) has them, in ulp of `t` and of `u`;
- *of the interval*: the distance from the exact time as a share of the interval, its mean over the uniform half;
- *steps back*: how often, of a million neighbouring `f32`, a greater `u` gives an earlier time;
- *failures*: of a million answers, those that are NaN, outside the interval or off by more than 1 % of it; in the
  other columns a time outside the interval counts as its nearer end, and NaN as its start.

The time of `inverse_cdf` as a share of that of *{}*, the fastest of the others whose errors are of the same order:

{}

![Error against cost](frontier.svg)

Full dots are the greatest error, rings the mean.",
        std::env::consts::ARCH,
        measured.curves,
        measured.samples,
        Nearer.name(),
        ratios(measured),
    )
}

/// The times of this crate's methods on *soft* and *all ramp*, as shares of the careful Newton's.
pub fn ratios(measured: &Measured) -> String {
    let rows = METHODS.iter().filter(|method| method.is_ours()).map(|method| {
        let shares = measured.times[..2].iter().map(|(times, _)| {
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
    let costs = METHODS.iter().map(|method| {
        // A box has no ramps, where methods differ.
        let times = measured.times[..=TRAPEZOID].iter().map(|(times, _)| time(times, *method));
        let times = times.map(|t| t.map_or_else(|| "-".into(), |t| format!("{t:.1}")));
        let head = [method.name().to_owned(), method.bytes().to_string()];
        head.into_iter().chain(times).collect()
    });
    let timed = CURVES[..=TRAPEZOID].iter().map(|(name, ..)| format!("{name}, ns"));
    let timed = timed.collect::<Vec<_>>().join(" | ");
    let costs = table(&format!("method | bytes | {timed}"), 1, costs);
    let errors = METHODS.iter().zip(&measured.figures).map(|(method, figures)| {
        let numbers = [
            figures.forward.0,
            figures.forward.1,
            figures.of_interval.0,
            figures.of_interval.1,
            figures.backward,
            figures.steps_back,
            figures.failures,
        ];
        [method.name().into()].into_iter().chain(numbers.map(number)).collect()
    });
    let header = "method | forward: max | mean | of the interval: max | mean | backward, ulp(u) \
                  | steps back | failures";
    let errors = table(header, 1, errors);
    let aimed = METHODS.iter().zip(&measured.figures).map(|(method, figures)| {
        let (most, back) = figures.hard;
        let triggers = of_triggers(*method).map_or_else(|| "-".into(), number);
        vec![method.name().into(), number(most), number(back), triggers]
    });
    let aimed = table("method | aimed and tiny `u` | steps back | a leaf's triggers", 1, aimed);
    format!(
        "## The methods

The first four are this crate. *{nearer}* is what one writes without it, with care: sextics in powers of p from both ends
of each ramp, in `f32` but built in `f64`; `u` counted from the nearer end; and Newton's steps inside a bracket, from where a
straight ramp has its answer, until the residual is 3e-7 of the target, and one more. The others are written from public
descriptions: Newton in `f32` on sextics in powers of p, from 0.5, at most 10 steps or to 1e-6, then 21 bisections (a renderer);
Newton inside a bracket until an absolute 1e-6 (another renderer); Newton in doubles; and tables of the exact inverse at equally
spaced `u`, joined by lines or by monotone cubics. The last three are for straight ramps alone, which take one square root, from
the nearer end: by `libm`, whose code needs no FPU, by `micromath`, and by the FPU's instruction.

### Cost

The curves are those of [cost.md](cost.md), which has cycles.

{costs}

### Error

{errors}

The square roots are judged on the {straight} of these curves whose ramps are straight, from 0 to 1 and back.

The largest errors, as shares of the interval, where it is harder and where it is easier. *Aimed and tiny* `u` are some 1000 on each of
the same curves, next to joins and kinks and as small as an `f32` can be; the rounding of the time to an `f32` is forgiven there.
*A leaf's triggers* are frames of up to 64 on the leaf shutter of `cli/traces/leaf.csv`: what firmware asks.

{aimed}

![Worst cases](worst-cases.svg)

Each random curve's worst `u`, over about 1000 that are likely to be bad. Where several lie at one place, it has one dot.",
        nearer = Nearer.name(),
        straight = measured.figures.last().map_or(0, |figures| figures.curves),
    )
}

fn forwards(measured: &Measured) -> String {
    let rows =
        CURVES[..=TRAPEZOID].iter().zip(&measured.times).map(|((name, ..), (_, forwards))| {
            let cells =
                forwards.iter().flat_map(|(time, error)| [format!("{time:.1}"), number(*error)]);
            [(*name).into()].into_iter().chain(cells).collect()
        });
    let names = FORWARDS.map(|(name, _)| format!("{name}, ns | error")).join(" | ");
    let table = table(&format!("curve | {names}"), 1, rows);
    format!(
        "## Openness and cdf

Against the usual solver of animation curves in `f32`: 8 Newton steps from the time itself to an absolute 1e-6, then
bisection. Nanoseconds a sample at random times, and the greatest error seen, absolute: of the openness, and of the
fraction of the exposure.

{table}

Both need `p` for a `t`, which no table gives: this crate solves by its own search, to the promised ulp."
    )
}

/// A row for each case that is hard for another method, one for the others, and one for curves that meet difficulties exactly.
fn hard_cases() -> String {
    let judged = |curve: &Curve, us: &[f32]| {
        let exact = Exact::new(curve);
        let others = [Nearer, Textbook, Table256].map(|method| {
            let inverse = method.build(curve).expect("it serves every curve");
            judge_on(&exact, |u| mended(curve, inverse.inverse_cdf(u)), us).of_interval
        });
        let ours = shutter::<8>(curve);
        let own = judge_on(&exact, |u| ours.inverse_cdf(u), us);
        [others[0], others[1], others[2], own.of_interval, own.backward]
    };
    let cases = CASES.iter().map(|case| {
        let curve = case.curve();
        (case.name, judged(&curve, &breaking_us(&Exact::new(&curve))))
    });
    let (told, others): (Vec<_>, Vec<_>) =
        cases.partition(|(_, figures)| figures[..3].iter().any(|error| *error > 0.01));
    let row = |name: String, figures: [f64; 5]| {
        [name].into_iter().chain(figures.map(number)).collect::<Vec<_>>()
    };
    let most = |all: Vec<[f64; 5]>| {
        std::array::from_fn(|i| all.iter().map(|figures| figures[i]).fold(0.0, f64::max))
    };
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
    let header = "case | Newton, nearer end | textbook Newton | table of 256 | this crate | its backward error, ulp(u)";
    let table = table(header, 1, told.chain([others, aimed]));
    format!(
        "## Hard cases

The greatest error over about 1000 `u` a curve, beyond the rounding of the time to an `f32` and as a share of the interval, and the
backward error of this crate with 8 octaves, where another method errs by more than 1 %. Each case is judged in
`tests/promises.rs`; `tests/support/aimed.rs` draws curves that meet difficulties exactly, and the `u` next to them.

{table}"
    )
}

fn search(measured: &Measured) -> String {
    let (bred, aimed): (Vec<_>, Vec<_>) =
        measured.search.iter().partition(|row| row["is_bred"] == "true");
    let [tried, each] = [&bred, &aimed].map(|rows| rows.first().map_or("0", |row| &row["curves"]));
    let bred = table("aim | worst found", 1, bred.iter().map(|row| shown(row, "what worst")));
    let steps = ["steps_back", "cdf_steps_back", "tick_steps_back"];
    let steps: f64 = steps.into_iter().map(|column| sum(&aimed, column)).sum();
    let [backward, evaluations, cdf, density, ticks] =
        ["backward", "evaluations", "cdf", "density", "ticks"].map(|column| most(&aimed, column));
    format!(
        "### Found by search

`cargo bench -p benches -- --search N` draws random curves, three of four of them hard, and climbs from the worst of them by
moving control points. {tried} valid curves were tried, each on about 650 `u`; the errors in ulp(t), the evaluations and the round
trip are those of every seventh of these. `search.csv` has the curves.

{bred}

Then it judges all that is promised on {families} families of curves that meet difficulties exactly (`tests/support/aimed.rs`), {each}
of each, with `OCTAVES` = 0 and 8. Promises broken: {broken}. Steps back: {steps}. At worst {backward} ulp(u), {evaluations} evaluations,
{cdf} ulp of the cdf, {density} of openness and pdf, {ticks} tick.",
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
    figures.reduce(f64::max).map_or_else(
        || "-".into(),
        |most| if most.fract() == 0.0 { most.to_string() } else { number(most) },
    )
}

fn every_f32(measured: &Measured) -> String {
    let all: Vec<_> = measured.every_f32.iter().collect();
    let [answers, seconds] = ["count", "seconds"].map(|column| sum(&all, column));
    let minutes = seconds / 60.0;
    let mut kinds: Vec<_> = all.iter().map(|row| [&row["function"], &row["octaves"]]).collect();
    kinds.sort();
    kinds.dedup();
    let rows = kinds.into_iter().map(|[function, octaves]| {
        let of = |row: &&&Row| [&row["function"], &row["octaves"]] == [function, octaves];
        let rows: Vec<_> = all.iter().filter(of).copied().collect();
        let sums =
            ["count", "out_of_range", "steps_back"].map(|column| match rows[0][column].as_str() {
                "" => "-".into(),
                _ => sum(&rows, column).to_string(),
            });
        let worst = ["error", "judged"].map(|column| most(&rows, column));
        let head = [format!("`{function}`"), octaves.clone(), rows.len().to_string()];
        head.into_iter().chain(sums).chain(worst).collect()
    });
    let header =
        "function | octaves | curves | answers | out of range | steps back | error, ulp | judged";
    let table = table(header, 1, rows);
    format!(
        "## Every f32

`cargo bench -p benches -- --every-f32` asks the inverse for all 1 065 353 217 `f32` in [0, 1] with 8 octaves, and with other
counts for all from 2<sup>-20</sup> up, below which the same solver serves them all. It asks `cdf` and `openness` at all times of a
curve (within 2<sup>-64</sup> of a time 0 inside, at every sixteenth stretch). A second formulation in doubles judges all; the
oracle judges samples and the worst of each 4 million (*judged*). These {answers} answers took {minutes:.0} minutes on two busy cores.
`every-f32.csv` has each curve.

{table}

The error of the inverse is its backward error, that of `cdf` and `openness` in ulp at some time within an ulp of the one asked for,
an ulp of the cdf being at least that of 2<sup>-24</sup>."
    )
}

fn rendering(measured: &Measured) -> String {
    let rows = measured.rendering.iter().map(|(n, errors)| {
        [n.to_string()].into_iter().chain(errors.iter().map(|error| number(*error))).collect()
    });
    let table = table(&format!("pulses | {}", PULSES.map(name).join(" | ")), 0, rows);
    format!(
        "## What it is for

A bright bar moves while the shutter is open, and is lit by pulses. Equal pulses at this crate's trigger times come
within 1/n of the exact integral at every pixel. Equally spaced pulses must be dimmed by the
openness, which a lamp of equal pulses cannot do, and random ones are far noisier.

![A moving bar in pulses](rendering.svg)

Root-mean-square error over the picture, soft curve (random: mean of 16 seeds):

{table}"
    )
}

pub fn name(pulses: Pulses) -> &'static str {
    match pulses {
        Pulses::Triggers => "triggers of this crate",
        Pulses::Weighted => "equally spaced, weighted by openness",
        Pulses::Random => "random, as the curve has it",
    }
}
