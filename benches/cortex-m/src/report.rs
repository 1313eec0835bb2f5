//! The whole report, as Markdown, in `docs/internals/cost.md`; and what most readers want, which it begins with.

use measured::baseline::{InverseTable, StraightRamps, TextbookNewton};
use measured::roots::{DIVISOR, ROOTS, dividend};
use measured::{
    CURVE_BYTES, CURVES, DEFAULT, Function, Inputs, OCTAVES, ROWS, TRAPEZOID, TRIGGERS, TYPICAL,
    uniform,
};
use micromath::F32Ext;
use shutter_curve::ShutterCurve;

use crate::Result;
use crate::firmware::{IMAFC, IMC, M0, M4F, M33, OPT_LEVEL, folder, made_with};
use crate::measure::{Measured, On, Ran, series};

use Function::{
    Cdf, Construct, InverseCdf, Newton, Openness, Root, Schedule, SqrtFpu, SqrtLibm, SqrtMicromath,
    Static, Table, TickStep,
};

const METHOD: &str = "## How it is measured

A call's figures are from its first instruction to its return, over 512 uniform `u` (or times), with all but the call itself inlined.

*Instructions* are counted in QEMU and exact: of a Cortex-M33 and a riscv32imafc with an FPU, of a Cortex-M0+ and a riscv32imc in soft
float. *Cycles* are modelled (`benches/cortex-m/src/model.rs`) after the Cortex-M4's Technical Reference Manual and what boards show of
branches and the fetch. Take them to be within 10 % at zero wait states, probably 1 to 4 % low; two wait states without a cache cost
up to 1.4 times as much. [tried.md](tried.md) says how the model was chosen and held against boards.

*Worst* is over the hard curves of the tests and those found by search, each with some 870 hard inputs: ends of sections, powers of
two, and those of 20 000 that take most evaluations.";

/// The calls as the reader knows them; the last are the baselines.
const CALLS: [(&str, Function); 11] = [
    ("`inverse_cdf`", InverseCdf),
    ("`inverse_cdf` of a `static`", Static),
    ("`cdf`", Cdf),
    ("`openness`", Openness),
    ("a tick", TickStep),
    ("a schedule", Schedule),
    ("textbook Newton in `f32`", Newton),
    ("linear table of 256", Table),
    ("`libm::sqrtf`", SqrtLibm),
    ("`micromath` `sqrt`", SqrtMicromath),
    ("the FPU's square root", SqrtFpu),
];

/// Those for straight ramps.
const SQUARE_ROOTS: [Function; 3] = [SqrtLibm, SqrtMicromath, SqrtFpu];

/// Prints what most readers want, of the processor with an FPU and the one without, in a minute.
pub fn short() -> Result {
    let measured = [M4F, M0].into_iter().map(|core| {
        let functions = CALLS.map(|(_, function)| function);
        let plan =
            [series(&functions, &[DEFAULT], On::Rows), series(&[InverseCdf], &[0], On::Rows)];
        Measured::new(core, OPT_LEVEL, &plan.concat())
    });
    let measured = measured.collect::<Result<Vec<_>>>()?;
    let [calls, everywhere, curves] =
        overview(&measured.iter().collect::<Vec<_>>()).map(|table| aligned(&table));
    println!(
        "Mean instructions:\n\n{everywhere}\n\n\
         Bytes of a curve, and errors as shares of the interval:\n\n{curves}\n\n\
         Mean cycles of a Cortex-M4F by a model, without wait states, and bytes of code:\n\n{calls}"
    );
    Ok(())
}

/// A table as a terminal shows it, without the columns that hold nothing.
fn aligned(table: &str) -> String {
    let cells = |line: &str| -> Vec<String> {
        let line = line.trim_matches('|').replace('`', "");
        line.split('|').map(|cell| cell.trim().to_owned()).collect()
    };
    let rows: Vec<_> = table.lines().filter(|line| !line.contains("--:")).map(cells).collect();
    let widths = (0..rows[0].len()).map(|column| {
        let is_empty = rows[1..].iter().all(|row| matches!(row[column].as_str(), "-" | ""));
        let widest = rows.iter().map(|row| row[column].chars().count()).max();
        if is_empty { 0 } else { widest.unwrap_or(0) }
    });
    let widths: Vec<usize> = widths.collect();
    let lines = rows.iter().map(|row| {
        let mut line = format!("{:1$}", row[0], widths[0]);
        for (cell, width) in row.iter().zip(&widths).skip(1).filter(|(_, width)| **width > 0) {
            line += &format!("  {cell:>width$}");
        }
        line
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// Writes the whole report.
pub fn write() -> Result {
    let plan = [
        series(&[InverseCdf], &OCTAVES, On::All),
        series(&[Static, Cdf, Openness, TickStep, Schedule, Newton, Table], &[DEFAULT], On::All),
        series(&SQUARE_ROOTS, &[DEFAULT], On::All),
        series(&[Construct], &OCTAVES, On::All),
        series(&[Root], &[DEFAULT], On::All),
    ];
    let m4f = Measured::new(M4F, OPT_LEVEL, &plan.concat())?;
    let plan = [
        series(&[InverseCdf, Static], &[DEFAULT], On::Typical),
        series(&[InverseCdf], &[0, 4, 16], On::Rows),
        series(&[Construct], &OCTAVES, On::Rows),
        series(&[Cdf, Openness, TickStep, Schedule, Newton, Table], &[DEFAULT], On::Rows),
        series(&SQUARE_ROOTS, &[DEFAULT], On::Rows),
    ];
    let others = [M33, M0, IMAFC, IMC].map(|core| Measured::new(core, OPT_LEVEL, &plan.concat()));
    let others = others.into_iter().collect::<Result<Vec<_>>>()?;
    let cores: Vec<&Measured> = [&m4f].into_iter().chain(&others).collect();

    let building = series(&[Construct], &[16], On::All);
    let for_size = Measured::new(M4F, "z", &building)?.code_bytes(Construct, 16);
    let report = [
        introduction(&cores),
        format!("Made by `benches/cortex-m/run.sh --write-docs`, with {}.", made_with()?),
        METHOD.into(),
        calls(&cores),
        bytes(&cores, for_size),
        typical(&m4f),
        roots(&m4f),
    ];
    let report = format!("# What it costs on a microcontroller\n\n{}\n", report.join("\n\n"));
    Ok(std::fs::write(folder().join("../../docs/internals/cost.md"), report)?)
}

/// A table, its columns' names between bars: so many columns of text, the others of figures.
fn table(header: &str, texts: usize, rows: impl IntoIterator<Item = String>) -> String {
    let header = format!("| {header} |");
    let figures = header.matches('|').count() - 1 - texts;
    let ruled = format!("|{}{}", "---|".repeat(texts), "--:|".repeat(figures));
    let rows = rows.into_iter().map(|row| format!("\n| {row} |"));
    format!("{header}\n{ruled}{}", rows.collect::<String>())
}

/// The figures of a row, a dash where there is none.
fn figures<T: ToString>(figures: impl IntoIterator<Item = Option<T>>) -> String {
    let figures = figures.into_iter().map(|f| f.map_or_else(|| "-".into(), |f| f.to_string()));
    figures.collect::<Vec<_>>().join(" | ")
}

/// A number's digits, in threes if there are five or more, with a narrow space that does not break.
fn grouped(number: f64) -> String {
    let digits = format!("{number:.0}");
    let grouped = digits.as_bytes().rchunks(3).rev().map(String::from_utf8_lossy);
    if digits.len() < 5 { digits } else { grouped.collect::<Vec<_>>().join("\u{202f}") }
}

/// The names of columns, one a core.
fn names(cores: &[&Measured]) -> String {
    figures(cores.iter().map(|core| Some(core.name.replace("Cortex-", ""))))
}

/// The tables of the first screen: what a call costs, beside the baselines; its instructions everywhere; what a curve takes.
fn overview(cores: &[&Measured]) -> [String; 3] {
    let m4f = cores[0];
    let calls = CALLS.map(|(name, function)| (name, function, DEFAULT));
    let without = ("`inverse_cdf`, `OCTAVES = 0`", InverseCdf, 0);
    let rows = calls.into_iter().chain([without]).map(|(name, function, octaves)| {
        let on_rows =
            (0..ROWS.len()).map(|row| Some(m4f.on(function, row, octaves)?.cycles().mean));
        let means = on_rows.chain([m4f.typical(function, octaves, Ran::cycles)]);
        let counts = [
            m4f.worst(function, octaves).map(|(cycles, _)| cycles),
            m4f.worst_direct(function, octaves).map(|(cycles, _)| cycles),
            m4f.code_bytes(function, octaves),
            m4f.stack_painted(function, octaves),
        ];
        let means = means.map(|mean| Some(format!("{:.0}", mean?)));
        format!("{name} | {} | {}", figures(means), figures(counts))
    });
    let header = format!(
        "call | {} | typical | worst | direct | code, bytes | stack, bytes",
        ROWS.join(" | ")
    );
    let calls = table(&header, 1, rows);

    let mut rows = Vec::new();
    for (row, curve) in ["soft", "all ramp", "trapezoid", "typical"].into_iter().enumerate() {
        // The inverse in all ways.
        for (name, function) in CALLS[..2].iter().chain(&CALLS[6..]) {
            let counts = cores.iter().map(|core| match curve {
                "typical" => core.typical(*function, DEFAULT, Ran::instructions),
                _ => core.on(*function, row, DEFAULT).map(|ran| ran.instructions().mean),
            });
            let counts: Vec<_> = counts.map(|count| count.map(grouped)).collect();
            if counts.iter().flatten().count() > 1 {
                rows.push(format!("{curve}: {name} | {}", figures(counts)));
            }
        }
    }
    let everywhere = table(&format!("mean instructions | {}", names(cores)), 1, rows);

    let [with_0, with_4, with_8, with_16] = CURVE_BYTES;
    let ramps = size_of::<StraightRamps>();
    let baselines = [size_of::<TextbookNewton>(), size_of::<InverseTable<256>>(), ramps, ramps];
    let bytes = [with_0, with_8, with_4, with_16].into_iter().chain(baselines).map(Some);
    let errors = [0, 1, TRAPEZOID].into_iter().flat_map(|row| {
        let errors = [Newton, Table, SqrtLibm, SqrtMicromath].map(|function| errors(row, function));
        [("largest", 0), ("mean", 1)].map(|(which, i)| {
            let errors = errors.map(|errors| Some(format!("{:.1e}", errors?[i])));
            format!("{which} error on {} | | | | | {}", ROWS[row], figures(errors))
        })
    });
    let bytes = format!("bytes of a curve | {}", figures(bytes));
    let header = "| `OCTAVES = 0` | 8 | 4 | 16 | textbook Newton in `f32` | linear table of 256 \
                  | square root: `libm`, FPU | `micromath`";
    let curves = table(header, 1, [bytes].into_iter().chain(errors));
    [calls, everywhere, curves]
}

/// The first screen.
fn introduction(cores: &[&Measured]) -> String {
    let [calls, everywhere, curves] = overview(cores);
    format!(
        "The calls with `OCTAVES = 8`, then other methods, in modelled cycles of a Cortex-M4F: means over uniform `u` or times. *soft* collects a
third of its exposure on ramps, *all ramp* all of it, *trapezoid* a third on straight ramps; *typical* is the mean over {TYPICAL} curves. Square
roots serve straight ramps alone. *Worst* is the worst call found on any curve, *direct* the worst that needs no search. Calls go
through an opaque reference; in the second row each curve is a `static`, as in firmware, and the worst is over typical curves.
A schedule is of {TRIGGERS} triggers, checked.

{calls}

The same on other cores, in instructions:

{everywhere}

What a curve takes, and the errors over a million uniform `u`, as a share of the interval:

{curves}"
    )
}

/// The largest and the mean error of a baseline on a curve that it serves, as shares of the interval.
fn errors(row: usize, function: Function) -> Option<[f64; 2]> {
    const COUNT: u32 = 1 << 20;
    let curve = &CURVES[row];
    let (opening, closing) = curve.ramps(false);
    let ours = ShutterCurve::<8>::with_octaves(opening, closing).expect("a good curve");
    let newton = TextbookNewton::new(curve.opening, curve.closing);
    let table = InverseTable::<256>::new(|u| ours.inverse_cdf(u));
    let ramps = curve.straight();
    let [start, end] = [ours.open_start(), ours.close_end()].map(f64::from);
    let errors = (0..COUNT).map(uniform).map(|u| {
        let t = match function {
            Newton => newton.inverse_cdf(u),
            Table => table.inverse_cdf(u),
            SqrtMicromath => ramps.inverse_cdf(u, F32Ext::sqrt),
            _ => ramps.inverse_cdf(u, libm::sqrtf),
        };
        // The error of a square root is too near to this crate's to be held against that.
        let exact = if row == TRAPEZOID { of_trapezoid(u) } else { ours.inverse_cdf(u).into() };
        (f64::from(t) - exact).abs() / (end - start)
    });
    let (most, sum) = errors.fold((0.0f64, 0.0), |(most, sum), e| (most.max(e), sum + e));
    let is_served = !function.is_for_straight_ramps() || row == TRAPEZOID;
    is_served.then_some([most, sum / f64::from(COUNT)])
}

/// The exact inverse of *trapezoid*, which opens from 0 to 1/4 and closes from 3/4 to 1.
fn of_trapezoid(u: f32) -> f64 {
    let u = f64::from(u);
    let ramp = |u: f64| (0.375 * u).sqrt();
    let share = 0.125 / 0.75;
    if u < share {
        ramp(u)
    } else if u > 1.0 - share {
        1.0 - ramp(1.0 - u)
    } else {
        0.125 + 0.75 * u
    }
}

/// Every call on each core, and the worst on one.
fn calls(cores: &[&Measured]) -> String {
    let mut rows = Vec::new();
    for ((name, function), octaves) in
        CALLS.iter().flat_map(|call| OCTAVES.map(|octaves| (call, octaves)))
    {
        for (row, curve) in ROWS.iter().enumerate() {
            let on = |core: &Measured| core.on(*function, row, octaves).map(Ran::instructions);
            // What has no octaves is measured with the default ones.
            let Some(s) = cores[0].on(*function, row, octaves).map(Ran::cycles) else { continue };
            let cycles =
                format!("{} | {} | **{:.0}** | {} | {}", s.min, s.median, s.mean, s.most, s.max);
            let counts = cores.iter().map(|core| Some(grouped(on(core)?.mean)));
            rows.push(format!("{name} | {curve} | {octaves} | {cycles} | {}", figures(counts)));
        }
        if let Some((worst, curve)) = cores[0].worst(*function, octaves) {
            let blank = " | ".repeat(cores.len());
            rows.push(format!("{name} | Hard: {curve} | {octaves} | | | | | {worst} {blank}"));
        }
    }
    let header = format!(
        "call | curve | OCTAVES | cycles: min | median | mean | 99 % | max | {}",
        names(cores)
    );
    let table = table(&header, 3, rows);
    format!(
        "## Every call

*Hard* is the worst over the hard curves and inputs, with its curve. Of triggers it is over a frame of {TRIGGERS}, step by step and as a
whole, and over first triggers near a hard input, on intervals of one to two million ticks. A refused frame costs no more.

{table}"
    )
}

/// What every call takes beside time, on each core, and what building a curve does.
fn bytes(cores: &[&Measured], for_size: Option<u32>) -> String {
    let calls = CALLS[..6].iter().map(|(name, function)| (name.to_string(), *function, DEFAULT));
    let building =
        OCTAVES.map(|octaves| (format!("building, `OCTAVES = {octaves}`"), Construct, octaves));
    let mut rows = Vec::new();
    for (name, function, octaves) in building.iter().cloned().chain(calls) {
        let mut row = |what: &str, of: &dyn Fn(&Measured) -> Option<f64>| {
            let counts = figures(cores.iter().map(|core| of(core).map(grouped)));
            rows.push(format!("{name} | {what} | {counts}"));
        };
        if function == Construct {
            row("instructions", &|core| Some(core.on(function, 0, octaves)?.instructions().mean));
        }
        row("code", &|core| core.code_bytes(function, octaves).map(f64::from));
        row("stack", &|core| core.stack_said(function, octaves).map(f64::from));
    }
    let table = table(&format!("| | {}", names(cores)), 2, rows);
    let cycles = cores[0].on(Construct, 0, DEFAULT).map(|ran| grouped(ran.cycles().mean));
    format!(
        "## Building a curve at run time, flash and stack

The compiler builds a `static` curve, at no cost at run time. Built on the microcontroller, *soft* takes so many instructions, most
of them in doubles, which all of these compute in software; on a Cortex-M4F {} cycles with `OCTAVES = 8`. With `OCTAVES = 0` no
polynomials are fitted, and each answer is a search. Optimised for size (`opt-level = \"z\"`), building takes {} bytes of code on a Cortex-M4F.

Code, in bytes, is a call's own and all that it reaches, so calls share some. Stack is the deepest path by the compiler's
figures. The library has no statics: `.data` and `.bss` hold {} bytes.

{table}",
        figures([cycles]),
        figures([for_size]),
        cores[0].code.statics
    )
}

fn typical(m4f: &Measured) -> String {
    let over = |function| m4f.over(function, Inputs::Uniform, DEFAULT);
    let rows = over(InverseCdf).zip(over(Static)).zip(over(TickStep));
    let rows = rows.map(|((inverse, of_static), tick)| {
        let [one, other] = [inverse, tick]
            .map(|ran| format!("{:.0} | {:.1} %", ran.cycles().mean, 100.0 * ran.searched()));
        format!("{} | {:.0} | {one} | {other}", inverse.name(), of_static.cycles().mean)
    });
    let header = "curve | of a `static` | `inverse_cdf` | searched | tick | searched";
    let table = table(header, 1, rows);
    format!(
        "## On every typical curve

With `OCTAVES = 8`: mean cycles of `inverse_cdf` over uniform `u`, of a `static` and by a reference, and the share of the `u` that are
searched for; the same of the ticks of a frame of 512.

{table}"
    )
}

/// What a search may start from.
fn roots(m4f: &Measured) -> String {
    const COUNT: u32 = 1 << 20;
    let rows = ROOTS.iter().enumerate().map(|(i, root)| {
        let errors = (0..COUNT).map(|i| dividend(i as f32 / COUNT as f32)).map(|x| {
            let exact = (f64::from(x) / f64::from(DIVISOR)).powf(1.0 / f64::from(root.k));
            (f64::from((root.of)(x, DIVISOR)) / exact - 1.0).abs()
        });
        let (most, sum) = errors.fold((0.0f64, 0.0), |(most, sum), e| (most.max(e), sum + e));
        let ran = m4f.on(Root, i, DEFAULT);
        let cycles = ran.map(Ran::cycles).map(|s| format!("{:.0} | {}", s.mean, s.max));
        let code = ran.map(|ran| m4f.code.code_bytes(ran.calls[0].called));
        let (mean, cost) = (sum / f64::from(COUNT), [cycles, code.map(|code| code.to_string())]);
        format!("{} | {} | {most:.1e} | {mean:.1e} | {}", root.k, root.way, figures(cost))
    });
    let header = "k | by | greatest error | mean error | cycles: mean | max | code, bytes";
    let table = table(header, 2, rows);
    format!(
        "## A k-th root as a first guess

A search starts from the k-th root of a quotient, here with the division. It takes as many evaluations from any of these, so the
crate has its own, which costs about as much for every k. Relative errors over a million quotients, even on a logarithmic scale.

{table}"
    )
}
