//! The report's text.

use std::fmt::Write as _;

use crate::accuracy::Figures;
use crate::cost::Cost;
use crate::curves::CURVES;
use crate::every_f32::{INVERSE, Row};
use crate::methods::{METHODS, Method, TEXTBOOK};
use crate::number::number;
use crate::pictures::name;
use crate::search::Find;
use crate::support::baseline::InverseTable;
use crate::support::cases::{CASES, Case, Verdict, judge, shutter};
use crate::support::curves::hard_us;
use crate::support::oracle::Exact;
use crate::support::rendering::Pulses;
use crate::timing::{FORWARDS, Time};

/// Everything measured.
pub struct Measured {
    pub curves: usize,
    pub samples: usize,
    pub figures: Vec<Figures>,
    /// By curve, then by method.
    pub times: Vec<Vec<Time>>,
    /// By curve: nanoseconds and error of [`FORWARDS`].
    pub forwards: Vec<[(f64, f64); 4]>,
    pub costs: Vec<Cost>,
    pub rendering: Vec<(Pulses, Vec<(u32, f64)>)>,
    pub finds: Vec<Find>,
    pub every_f32: Vec<Row>,
}

pub fn write(measured: &Measured) -> String {
    let mut out = String::new();
    introduction(&mut out, measured).expect("a string takes text");
    methods(&mut out, measured).expect("a string takes text");
    forwards(&mut out, measured).expect("a string takes text");
    errors(&mut out).expect("a string takes text");
    hard_cases(&mut out).expect("a string takes text");
    search(&mut out, measured).expect("a string takes text");
    every_f32(&mut out, measured).expect("a string takes text");
    rendering(&mut out, measured).expect("a string takes text");
    out
}

fn introduction(out: &mut String, measured: &Measured) -> std::fmt::Result {
    write!(
        out,
        "# Speed against error

Written by `cargo bench -p benches --bench speed_vs_error`; nothing here is typed by hand. Times are from one {} core of
an ordinary machine, medians of interleaved repeats over 65 536 random `u`, so that no branch on `u` is ever
predicted; on another machine trust the ratios. Seed feature: {SEED}, unless said otherwise.

Errors are measured against double-double arithmetic on {} typical curves (those of `tests/data` and random ones
as scenes hold them), {} fractions each: half of them uniform, a quarter towards either end on a scale of
octaves, since that is where tables and absolute tolerances fail.

- *forward*: |t - exact| in ulp(t);
- *of the interval*: the same as a share of `close_end - open_start`;
- *backward*: by how many ulp(u) must `u` move for the answer to be right, once the rounding of the exact time to
  `t` is forgiven. It holds everywhere, however flat the curve;
- *steps back*: how often, of a million neighbouring `f32`, a greater `u` gives an earlier time;
- *failures*: of a million answers, those that are NaN, outside the interval or off by more than 1 % of it; in the
  other columns a time outside the interval counts as its nearer end, and NaN as its start.

The time of `inverse_cdf` as a share of the textbook Newton's, both times its single calls:

{}

![Error against cost](frontier.svg)

Full dots are the greatest error, rings the mean.

",
        std::env::consts::ARCH,
        measured.curves,
        measured.samples,
        ratios(&measured.times),
    )
}

/// The times of this crate's methods on *soft* and *all ramp*, as shares of the textbook Newton's single calls.
pub fn ratios(times: &[Vec<Time>]) -> String {
    let [soft, all_ramp] = [CURVES[0].0, CURVES[1].0];
    let mut out = format!(
        "| | {soft}: single | slice | {all_ramp}: single | slice |\n|---|---:|---:|---:|---:|"
    );
    for (index, method) in METHODS.iter().enumerate().filter(|(_, method)| method.is_ours) {
        let shares = times[..2].iter().map(|times| {
            let (time, textbook) = (times[index], times[TEXTBOOK].single);
            format!("{:.2} | {:.2}", time.single / textbook, time.slice / textbook)
        });
        let shares: Vec<_> = shares.collect();
        out += &format!("\n| {} | {} |", method.name, shares.join(" | "));
    }
    out
}

fn methods(out: &mut String, measured: &Measured) -> std::fmt::Result {
    writeln!(
        out,
        "## The methods

The first four are this crate. The others are written from public descriptions: Newton in `f32` on sextics in powers
of p, from 0.5, at most 10 steps or to 1e-6, then 21 bisections (a renderer); Newton inside a bracket until an
absolute 1e-6 (another renderer); tables of the exact inverse at equally spaced `u`, joined by lines or by monotone
cubics; and Newton in doubles.

### Cost

`soft` has a third of its mass in ramps, `all ramp` all of it, `box` none. Cycles are a model of a Cortex-M4F without
wait states, over uniform `u`, where `cost.md` has them.

| method | bytes | {} |",
        CURVES
            .map(|(name, ..)| format!("{name}: single, ns | slice, ns | ratios to textbook"))
            .join(" | "),
    )?;
    let has_costs = !measured.costs.is_empty();
    let header = if has_costs { " M4F cycles, soft: mean | max |" } else { "" };
    // The header's line ends in a bar; the cycles follow it.
    if has_costs {
        out.truncate(out.trim_end().len());
        writeln!(out, "{header}")?;
    }
    let columns = 2 + 3 * CURVES.len() + if has_costs { 2 } else { 0 };
    writeln!(out, "|---|{}", "---:|".repeat(columns - 1))?;
    for (index, method) in METHODS.iter().enumerate() {
        write!(out, "| {} | {} |", method.name, method.bytes)?;
        for times in &measured.times {
            let (time, textbook) = (times[index], times[TEXTBOOK]);
            write!(
                out,
                " {:.1} | {:.1} | {:.2}, {:.2} |",
                time.single,
                time.slice,
                time.single / textbook.single,
                time.slice / textbook.single
            )?;
        }
        if has_costs {
            match cost(measured, method) {
                Some(cost) => write!(out, " {:.0} | {:.0} |", cost.mean, cost.max)?,
                None => write!(out, " | |")?,
            }
        }
        writeln!(out)?;
    }
    writeln!(
        out,
        "
The slice's ratio too is to single calls of the textbook Newton.

### Error

| method | forward: max | 99.9 % | mean | of the interval: max | mean | backward, ulp(u) | steps back | failures | evaluations: mean | worst |
|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|"
    )?;
    for (method, figures) in METHODS.iter().zip(&measured.figures) {
        writeln!(
            out,
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            method.name,
            number(figures.quantile(1.0)),
            number(figures.quantile(0.999)),
            number(figures.mean()),
            number(figures.of_interval.0),
            number(figures.of_interval.1),
            number(figures.backward),
            number(figures.steps_back),
            number(figures.failures),
            number(figures.evaluations.0),
            figures.evaluations.1
        )?;
    }
    writeln!(
        out,
        "
Evaluations are of the mass, a polynomial of degree 6; this crate's direct polynomials and its plateau take none.
"
    )
}

/// The seed of this build.
const SEED: &str = if cfg!(feature = "libm") {
    "libm"
} else if cfg!(feature = "micromath") {
    "micromath"
} else {
    "none"
};

/// A method's cycles, this crate's with the seed of this build.
pub fn cost<'a>(measured: &'a Measured, method: &Method) -> Option<&'a Cost> {
    let seed = if method.is_ours { SEED } else { "" };
    measured.costs.iter().find(|cost| cost.method == method.cost && cost.seed == seed)
}

fn forwards(out: &mut String, measured: &Measured) -> std::fmt::Result {
    writeln!(
        out,
        "## Openness and cdf

Against the usual solver of animation curves in `f32`: 8 Newton steps from the time itself to an absolute 1e-6, then
bisection. Nanoseconds a sample at random times, and the greatest error seen, absolute: of the openness, and of the
fraction of the exposure.

| curve | {} |
|---|---:|---:|---:|---:|---:|---:|---:|---:|",
        FORWARDS.map(|name| format!("{name}, ns | error")).join(" | ")
    )?;
    for ((name, ..), forwards) in CURVES.iter().zip(&measured.forwards) {
        let cells = forwards.map(|(time, error)| format!("{time:.1} | {}", number(error)));
        writeln!(out, "| {name} | {} |", cells.join(" | "))?;
    }
    writeln!(
        out,
        "
Both need `p` for a `t`, which no table gives: this crate solves by its own search, to the promised ulp.
"
    )
}

fn errors(out: &mut String) -> std::fmt::Result {
    writeln!(
        out,
        "## Where the errors are

![Error over u](error-over-u.svg)

The greatest error of 16 neighbouring samples. On the plateau all are exact to their rounding.

![Histogram of errors](histogram.svg)

The signed error of all samples: no better than rounding is possible, and little worse is seen. Some times are exact,
hence the peak in the middle.

![Worst cases](worst-cases.svg)

Each random curve's worst `u`, over about 1000 that are likely to be bad: octave ends, section bounds with their
neighbours, the smallest numbers, random ones.
"
    )
}

fn hard_cases(out: &mut String) -> std::fmt::Result {
    let us = |case: &Case| hard_us(&Exact::new(&case.curve()), 4, 400);
    let counts = || CASES.iter().map(|case| us(case).len());
    writeln!(
        out,
        "## Hard cases

Each is a test in `tests/hard_cases.rs`, which also rebuilds where other systems fail. The textbook Newton and the
table of 256 beside this crate with 8 octaves: the greatest error as a share of the interval, failures and steps back
of {} to {} `u` a curve, and this crate's errors in ulp(t) and, once half an ulp(t) is forgiven, in ulp(u). The error
in ulp(t) is large where the density is next to nothing: there a small ulp(u) is all that can be had.

| case | textbook: error | failures | steps back | table: error | failures | this crate: error | ulp(t) | ulp(u) | failures, steps back | evaluations: worst |
|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|",
        counts().min().unwrap_or(0),
        counts().max().unwrap_or(0)
    )?;
    for case in CASES {
        let curve = case.curve();
        let (exact, ours) = (Exact::new(&curve), shutter::<8>(&curve));
        let textbook = (METHODS[TEXTBOOK].build)(&curve);
        let table = InverseTable::<256>::new(|u| ours.inverse_cdf(u));
        let judge = |inverse: &dyn Fn(f32) -> f32| judge(&exact, inverse);
        let [textbook, table, crate_]: [Verdict; 3] = [
            judge(&|u| textbook.inverse_cdf(u)),
            judge(&|u| table.inverse_cdf(u)),
            judge(&|u| ours.inverse_cdf(u)),
        ];
        let evaluations = us(case).iter().map(|u| ours.evaluations(*u)).max();
        writeln!(
            out,
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {}, {} | {} |",
            case.name,
            number(textbook.of_interval),
            textbook.failures,
            textbook.steps_back,
            number(table.of_interval),
            table.failures,
            number(crate_.of_interval),
            number(crate_.forward),
            number(crate_.backward),
            crate_.failures,
            crate_.steps_back,
            evaluations.unwrap_or(0)
        )?;
    }
    writeln!(
        out,
        "
### Where others fail

The failures that are known of other systems, rebuilt from their public descriptions: the greatest error over {} equally
spaced inputs.

{}",
        crate::others::COUNT,
        crate::others::table()
    )
}

fn search(out: &mut String, measured: &Measured) -> std::fmt::Result {
    let (bred, aimed): (Vec<&Find>, Vec<&Find>) =
        measured.finds.iter().partition(|find| find.is_bred);
    let Some(first) = bred.first() else { return Ok(()) };
    writeln!(
        out,
        "### Found by search

`cargo bench -p benches --bench speed_vs_error -- --search N` draws random curves, three of four of them hard, and climbs from the
worst of them by moving control points. {} valid curves were tried, each on about 650 `u`; the errors
in ulp(t), the evaluations and the round trip are those of every seventh of these.

| aim | worst found | control points of the opening; of the closing |
|---|---:|---|",
        first.curves
    )?;
    for find in bred {
        let whole = [find.evaluations.map(u64::from), find.steps_back].into_iter().flatten();
        let figures = [find.forward, find.backward, find.round_trip].into_iter().flatten();
        let worst = figures.chain(whole.map(|worst| worst as f64)).next().unwrap_or(0.0);
        writeln!(out, "| {} | {} | {} |", find.what, number(worst), find.at)?;
    }
    let Some(family) = aimed.first() else { return writeln!(out) };
    writeln!(
        out,
        "
Then it judges all that is promised on curves and inputs that meet difficulties exactly, {} of each family
(`tests/support/aimed.rs`), with `CELLS` = 0 and 8.

| family | error in ulp(u) | evaluations | steps back: inverse | cdf | ticks | error of the cdf, ulp | of openness and pdf | of ticks, up to 2<sup>24</sup> | more | promises broken |
|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|",
        family.curves
    )?;
    for find in aimed {
        let figure = |figure: Option<f64>| number(figure.unwrap_or(0.0));
        let count = |count: Option<u64>| count.unwrap_or(0);
        writeln!(
            out,
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            find.what,
            figure(find.backward),
            find.evaluations.unwrap_or(0),
            count(find.steps_back),
            count(find.cdf_steps_back),
            count(find.tick_steps_back),
            figure(find.cdf),
            figure(find.density),
            figure(find.few_ticks),
            figure(find.many_ticks),
            count(find.breaches),
        )?;
    }
    writeln!(out)
}

fn every_f32(out: &mut String, measured: &Measured) -> std::fmt::Result {
    if measured.every_f32.is_empty() {
        return Ok(());
    }
    let seconds: f64 = measured.every_f32.iter().map(|row| row.seconds).sum();
    let answers: u64 = measured.every_f32.iter().map(|row| row.count).sum();
    writeln!(
        out,
        "## Every f32

`cargo bench -p benches --bench speed_vs_error -- --every-f32` asks the inverse for all 1 065 353 217 `f32` in [0, 1] with 8 octaves,
and then with other counts for all from 2<sup>-20</sup> up, below which the same solver serves them all; and `cdf` and
`opening` at all times from a curve's start to its end (of those within 2<sup>-64</sup> of time 0, where a curve
runs across it, at every sixteenth stretch). The answers are held against a second formulation, a solver in doubles that
follows u or t, and samples and the worst of each 4 million against the double-double oracle (*judged*). These {} answers
took {:.0} minutes on two busy cores, in a run of its own.

| curve | kind | octaves | answers | out of range | steps back | forward, ulp(t) | backward, ulp(u) | judged | evaluations: worst of every 16th f32 |
|---|---|---:|---:|---:|---:|---:|---:|---:|---:|",
        answers,
        seconds / 60.0
    )?;
    let dash = |figure: Option<String>| figure.unwrap_or_else(|| "-".into());
    let (of_inverse, of_values): (Vec<&Row>, Vec<&Row>) =
        measured.every_f32.iter().partition(|row| row.function == INVERSE);
    for row in of_inverse {
        writeln!(
            out,
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            row.curve,
            row.kind,
            row.cells,
            row.count,
            row.out_of_range,
            dash(row.steps_back.map(|steps| steps.to_string())),
            dash(row.forward.map(number)),
            number(row.error),
            number(row.judged),
            dash(row.evaluations.map(|evaluations| evaluations.to_string())),
        )?;
    }
    writeln!(
        out,
        "
The forward error leaves out answers where the density is so low that doubles cannot tell the time to an ulp.

`cdf` and `opening`: the error in ulp at some time within an ulp of the one asked for, an ulp of the cdf being at least that of
2<sup>-24</sup>, and the same without that floor.

| function | curve | kind | answers | out of range | steps back | error, ulp | judged | without the floor |
|---|---|---|---:|---:|---:|---:|---:|---:|"
    )?;
    for row in of_values {
        writeln!(
            out,
            "| `{}` | {} | {} | {} | {} | {} | {} | {} | {} |",
            row.function,
            row.curve,
            row.kind,
            row.count,
            row.out_of_range,
            dash(row.steps_back.map(|steps| steps.to_string())),
            number(row.error),
            number(row.judged),
            dash(row.without_floor.map(number)),
        )?;
    }
    writeln!(out)
}

fn rendering(out: &mut String, measured: &Measured) -> std::fmt::Result {
    writeln!(
        out,
        "## What it is for

A bright bar moves while the shutter is open, and is lit by pulses. Equal pulses at this crate's trigger times come
within 1/n of the exact integral at every pixel, since they split the exposure evenly: half a share at either edge.
Equally spaced pulses must be dimmed by the openness, which a lamp that fires equal pulses cannot do, and random ones
are far noisier. `tests/statistics.rs` holds this for every scene of the main example, together with chi-square and
Kolmogorov-Smirnov tests of the samples.

![A moving bar in pulses](rendering.svg)

Root-mean-square error over the picture, soft curve (random: mean of 16 seeds):

| pulses | {} |
|---:|---:|---:|---:|",
        measured.rendering.iter().map(|(pulses, _)| name(*pulses)).collect::<Vec<_>>().join(" | ")
    )?;
    for (i, (n, _)) in measured.rendering[0].1.iter().enumerate() {
        let row: Vec<_> =
            measured.rendering.iter().map(|(_, errors)| number(errors[i].1)).collect();
        writeln!(out, "| {n} | {} |", row.join(" | "))?;
    }
    Ok(())
}
