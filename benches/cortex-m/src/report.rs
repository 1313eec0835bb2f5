//! The whole report, as Markdown, in `docs/internals/cost.md`; and what most readers want, which it begins with.

use measured::baseline::{self, InverseTable, StraightRamps, TextbookNewton};
use measured::{CURVE_BYTES, DEFAULT, Function, OCTAVES, ROWS, TRAPEZOID, TRIGGERS};

use crate::Result;
use crate::firmware::{IMAFC, IMC, M0, M4F, M33, OPT_LEVEL, folder, made_with};
use crate::measure::{Measured, On, series};

use Function::{
    Cdf, Construct, InverseCdf, NearerEnd, Newton, Openness, Schedule, SqrtFpu, SqrtLibm, SqrtMicromath, Static, Table,
    TickStep,
};

const METHOD: &str = "## How it is measured

A call's figures are from its first instruction to its return, over 512 uniform `u` (or times), with all but the call itself inlined.

*Instructions* are counted in QEMU and exact: of a Cortex-M33 and a riscv32imafc with an FPU, of a Cortex-M0+ and a riscv32imc in soft
float. *Cycles* are modelled. Take them to be within 10 % at zero wait states, probably 1 to 4 % low ([how the model was
chosen](tried.md#the-model-of-cycles)); two wait states without a cache cost up to 1.4 times as much.

*Worst* is over the tests' hard curves and cases, each with some 870 hard inputs, those of 20 000 that take most evaluations among them; of
triggers over frames of 64, and first triggers near a hard input. A refused frame costs no more.";

/// The calls as the reader knows them, with their numbers of octaves; the last are the baselines.
const CALLS: [(&str, Function, usize); 15] = [
    ("`inverse_cdf`", InverseCdf, DEFAULT),
    ("`inverse_cdf` of a `static`", Static, DEFAULT),
    ("`inverse_cdf`, `OCTAVES = 0`", InverseCdf, 0),
    ("`inverse_cdf`, `OCTAVES = 4`", InverseCdf, 4),
    ("`inverse_cdf`, `OCTAVES = 16`", InverseCdf, 16),
    ("`cdf`", Cdf, DEFAULT),
    ("`openness`", Openness, DEFAULT),
    ("a tick", TickStep, DEFAULT),
    ("a schedule", Schedule, DEFAULT),
    ("Newton, nearer end", NearerEnd, DEFAULT),
    ("textbook Newton in `f32`", Newton, DEFAULT),
    ("linear table of 256", Table, DEFAULT),
    ("`libm::sqrtf`", SqrtLibm, DEFAULT),
    ("`micromath` `sqrt`", SqrtMicromath, DEFAULT),
    ("the FPU's square root", SqrtFpu, DEFAULT),
];

/// The octaves of which all cores are told.
const TOLD: [usize; 2] = [0, DEFAULT];

/// The baselines, the last for straight ramps.
const BASELINES: [Function; 6] = [NearerEnd, Newton, Table, SqrtLibm, SqrtMicromath, SqrtFpu];

/// Prints what most readers want, of the processor with an FPU and the one without, in a minute.
pub fn short() -> Result {
    let measured = [M4F, M0].into_iter().map(|core| {
        let plan = CALLS.map(|(_, function, octaves)| series(&[function], &[octaves], On::Rows));
        Measured::new(core, OPT_LEVEL, &plan.concat())
    });
    let measured = measured.collect::<Result<Vec<_>>>()?;
    let [calls, everywhere] = overview(&measured.iter().collect::<Vec<_>>());
    println!(
        "Mean instructions:\n\n{everywhere}\n\n\
         Mean cycles of a Cortex-M4F by a model, without wait states, and bytes of code and of a curve's data:\n\n{calls}"
    );
    Ok(())
}

/// The data of a call's curve.
fn data_bytes(function: Function, octaves: usize) -> Option<u32> {
    let bytes = match function {
        NearerEnd => size_of::<baseline::NearerEnd>(),
        Newton => size_of::<TextbookNewton>(),
        Table => size_of::<InverseTable<256>>(),
        SqrtLibm | SqrtMicromath | SqrtFpu => size_of::<StraightRamps>(),
        _ => CURVE_BYTES[OCTAVES.iter().position(|count| *count == octaves)?],
    };
    Some(bytes as u32)
}

/// Writes the whole report.
pub fn write() -> Result {
    let plan = [
        series(&[InverseCdf], &OCTAVES, On::All),
        series(&[Static, Cdf, Openness, TickStep, Schedule], &[DEFAULT], On::All),
        series(&BASELINES, &[DEFAULT], On::All),
        series(&[Construct], &TOLD, On::All),
    ];
    let m4f = Measured::new(M4F, OPT_LEVEL, &plan.concat())?;
    let plan = [
        series(&[InverseCdf], &TOLD, On::Rows),
        series(&[Static, Cdf, Openness, TickStep, Schedule], &[DEFAULT], On::Rows),
        series(&BASELINES, &[DEFAULT], On::Rows),
        series(&[Construct], &TOLD, On::Rows),
    ];
    let others = [M33, M0, IMAFC, IMC].map(|core| Measured::new(core, OPT_LEVEL, &plan.concat()));
    let others = others.into_iter().collect::<Result<Vec<_>>>()?;
    let cores: Vec<&Measured> = [&m4f].into_iter().chain(&others).collect();

    let building = series(&[Construct], &[DEFAULT], On::All);
    let for_size = Measured::new(M4F, "z", &building)?.code_bytes(Construct, DEFAULT);
    let report = [
        introduction(&cores),
        format!("Made by `benches/cortex-m/run.sh --write-docs`, with {}.", made_with()?),
        METHOD.into(),
        bytes(&cores, for_size),
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

/// What a call costs, beside the baselines, and its instructions everywhere.
fn overview(cores: &[&Measured]) -> [String; 2] {
    let m4f = cores[0];
    let rows = CALLS.map(|(name, function, octaves)| {
        let means = (0..=TRAPEZOID).map(|row| Some(m4f.on(function, row, octaves)?.cycles().mean));
        let counts = [
            m4f.worst(function, octaves).map(|(cycles, _)| cycles),
            m4f.worst_direct(function, octaves).map(|(cycles, _)| cycles),
            m4f.code_bytes(function, octaves),
            data_bytes(function, octaves),
        ];
        let means = means.map(|mean| Some(format!("{:.0}", mean?)));
        format!("{name} | {} | {}", figures(means), figures(counts))
    });
    let header = format!("call | {} | worst | direct | code, bytes | data, bytes", ROWS[..=TRAPEZOID].join(" | "));
    let calls = table(&header, 1, rows);

    let told = CALLS.into_iter().filter(|(.., octaves)| TOLD.contains(octaves));
    let rows = told.map(|(name, function, octaves)| {
        let is_straight = function.is_for_straight_ramps();
        let curves = if is_straight { TRAPEZOID..=TRAPEZOID } else { 0..=TRAPEZOID - 1 };
        let counts = cores.iter().map(|core| {
            let on = |row| Some(grouped(core.on(function, row, octaves)?.instructions().mean));
            Some(curves.clone().map(on).collect::<Option<Vec<_>>>()?.join("; "))
        });
        format!("{name} | {}", figures(counts))
    });
    let everywhere = table(&format!("soft; all ramp | {}", names(cores)), 1, rows);

    [calls, everywhere]
}

/// The first screen.
fn introduction(cores: &[&Measured]) -> String {
    let [calls, ..] = overview(cores);
    // Of the first core there are cycles.
    let [_, everywhere] = overview(&cores[1..]);
    format!(
        "Mean cycles of a Cortex-M4F, by a model, over uniform `u` or times, with `OCTAVES = 8` if no other number is named. *Soft* collects a third
of its exposure on ramps, *all ramp* all of it, *trapezoid* a third on straight ramps. *Worst* is the worst call found on the tests' hard
curves; a density that is dark at both ends may take some five times as many evaluations. *Direct* is the worst that needs no search. A
schedule is of {TRIGGERS} triggers, checked. Calls go through an opaque reference; in the second row each curve is a `static`, as in firmware,
and the worst is over typical curves.

{calls}

Mean instructions on other cores, of square roots on *trapezoid*:

{everywhere}

[speed-vs-error.md](speed-vs-error.md) says what the other methods are, and has all errors."
    )
}

/// What every call takes beside time, on each core, and what building a curve does.
fn bytes(cores: &[&Measured], for_size: Option<u32>) -> String {
    let building = TOLD.map(|octaves| (format!("building, `OCTAVES = {octaves}`"), Construct, octaves));
    let calls = [Static, Cdf, Openness, TickStep, Schedule];
    let calls = CALLS.iter().filter(|(_, function, _)| calls.contains(function));
    let calls = calls.map(|(name, function, octaves)| (name.to_string(), *function, *octaves));
    let mut rows = Vec::new();
    for (name, function, octaves) in building.into_iter().chain(calls) {
        if function == Construct {
            let counts = cores.iter().map(|core| Some(grouped(core.on(function, 0, octaves)?.instructions().mean)));
            rows.push(format!("{name}: instructions | {}", figures(counts)));
        }
        let bytes = cores.iter().map(|core| {
            let [code, stack] = [core.code_bytes(function, octaves)?, core.stack_bytes(function, octaves)?];
            Some([code, stack].map(|bytes| grouped(f64::from(bytes))).join("; "))
        });
        rows.push(format!("{name} | {}", figures(bytes)));
    }
    let table = table(&format!("bytes of code; stack | {}", names(cores)), 1, rows);
    let cycles = cores[0].on(Construct, 0, DEFAULT).map(|ran| grouped(ran.cycles().mean));
    format!(
        "## Building a curve at run time, flash and stack

The compiler builds a `static` curve. Built on the microcontroller, *soft* takes these instructions, most of them in doubles, which all
of these cores compute in software; on a Cortex-M4F {} cycles with `OCTAVES = 8`. Optimised for size (`opt-level = \"z\"`), building takes {}
bytes of code there. Code is all that a call reaches, so calls share some; stack is the deepest path by the compiler's figures. `.data`
and `.bss` hold {} bytes.

{table}",
        figures([cycles]),
        figures([for_size]),
        cores[0].code.statics
    )
}
