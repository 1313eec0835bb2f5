//! The report, as Markdown, in `docs/internals/cost.md`.

use measured::baseline::{self, InverseTable, StraightRamps};
use measured::{CURVE_BYTES, DEFAULT, Function, OCTAVES, ROWS, TRAPEZOID, TRIGGERS};

use crate::Result;
use crate::firmware::{IMAFC, IMC, M0, M4F, M33, folder, made_with};
use crate::measure::{Measured, On, series};

use Function::{
    Cdf, Construct, InverseCdf, NearerEnd, Openness, Schedule, SqrtFpu, SqrtLibm, SqrtMicromath, Static, Table,
    TickStep,
};

/// The calls as the reader knows them, with their numbers of octaves; the last are the baselines.
const CALLS: [(&str, Function, usize); 13] = [
    ("`inverse_cdf`", InverseCdf, DEFAULT),
    ("`inverse_cdf` of a `static`", Static, DEFAULT),
    ("`inverse_cdf`, `OCTAVES = 0`", InverseCdf, 0),
    ("`inverse_cdf`, `OCTAVES = 4`", InverseCdf, 4),
    ("`cdf`", Cdf, DEFAULT),
    ("`openness`", Openness, DEFAULT),
    ("a tick", TickStep, DEFAULT),
    ("a schedule", Schedule, DEFAULT),
    ("Newton, nearer end", NearerEnd, DEFAULT),
    ("linear table of 256", Table, DEFAULT),
    ("`libm::sqrtf`", SqrtLibm, DEFAULT),
    ("`micromath` `sqrt`", SqrtMicromath, DEFAULT),
    ("the FPU's square root", SqrtFpu, DEFAULT),
];

/// The octaves of which all cores are told.
const TOLD: [usize; 2] = [0, DEFAULT];

/// All calls with the octaves that a core is told of.
fn plan(octaves: &[usize], on: On) -> Vec<measured::Series> {
    let calls = CALLS.iter().filter(|(.., count)| octaves.contains(count));
    calls.flat_map(|(_, function, count)| series(&[*function], &[*count], on)).collect()
}

pub fn write() -> Result {
    let building = |on| series(&[Construct], &TOLD, on);
    let m4f = Measured::new(M4F, &[plan(&OCTAVES, On::All), building(On::All)].concat())?;
    let told = [plan(&TOLD, On::Rows), building(On::Rows)].concat();
    let others = [M33, M0, IMAFC, IMC].map(|core| Measured::new(core, &told));
    let others = others.into_iter().collect::<Result<Vec<_>>>()?;
    let others: Vec<&Measured> = others.iter().collect();
    let page = format!(
        "# What it costs on a microcontroller

Mean cycles of a Cortex-M4F, by a model, over uniform `u` or times, with `OCTAVES = 8` if no other number is named.
*Soft* collects a third of its exposure on ramps, *all ramp* all of it, *trapezoid* a third on straight ramps. *Worst*
is the worst call found on the tests' hard curves; a density that is dark at both ends may take some five times as many
evaluations. *Direct* is the worst that needs no search. A schedule is of {TRIGGERS} triggers, checked. Calls go through
an opaque reference; in the second row each curve is a `static`, as in firmware, and the worst is over typical curves.

{cycles}

Mean instructions on other cores, of square roots on *trapezoid*:

{instructions}

[speed-vs-error.md](speed-vs-error.md) says what the other methods are, and has all errors.

Made by `benches/cortex-m/run.sh --write-docs`, with
{made_with}.

## How it is measured

A call's figures are from its first instruction to its return, over 512 uniform `u` (or times), with all but the call
itself inlined.

*Instructions* are counted in QEMU and exact: of a Cortex-M33 and a riscv32imafc with an FPU, of a Cortex-M0+ and a
riscv32imc in soft float. *Cycles* are modelled. Take them to be within 10 % at zero wait states, probably 1 to 4 % low
([how the model was chosen](tried.md#the-model-of-cycles)); two wait states without a cache cost up to 1.4 times as
much.

*Worst* is over the tests' hard curves and cases, each with some 870 hard inputs, those of 20 000 that take most
evaluations among them; of triggers over frames of 64, and first triggers near a hard input. A refused frame costs no
more.

## Building a curve at run time, flash and stack

The compiler builds a `static` curve. Built on the microcontroller, *soft* takes these instructions, most of them in
doubles, which all of these cores compute in software; on a Cortex-M4F {building} cycles with `OCTAVES = 8`. Code is
all that a call reaches, so calls share some; stack is the deepest path by the compiler's figures. `.data` and `.bss`
hold {statics} bytes.

{bytes}
",
        cycles = cycles(&m4f),
        instructions = instructions(&others),
        made_with = made_with()?,
        building = figures([m4f.cycles(Construct, 0, DEFAULT).map(grouped)]),
        statics = m4f.code.statics,
        bytes = bytes(&[&[&m4f], &others[..]].concat()),
    );
    Ok(std::fs::write(folder().join("../../docs/internals/cost.md"), page)?)
}

/// The data of a call's curve.
fn data_bytes(function: Function, octaves: usize) -> Option<usize> {
    Some(match function {
        NearerEnd => size_of::<baseline::NearerEnd>(),
        Table => size_of::<InverseTable<256>>(),
        SqrtLibm | SqrtMicromath | SqrtFpu => size_of::<StraightRamps>(),
        _ => CURVE_BYTES[OCTAVES.iter().position(|count| *count == octaves)?],
    })
}

/// A table, its columns' names between bars: the first of text, the others of figures.
fn table(header: &str, rows: impl IntoIterator<Item = String>) -> String {
    let ruled = format!("|---|{}", "--:|".repeat(header.matches('|').count()));
    let rows = rows.into_iter().map(|row| format!("\n| {row} |"));
    format!("| {header} |\n{ruled}{}", rows.collect::<String>())
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

/// What each call costs.
fn cycles(m4f: &Measured) -> String {
    let rows = CALLS.map(|(name, function, octaves)| {
        let means = (0..=TRAPEZOID).map(|row| Some(format!("{:.0}", m4f.cycles(function, row, octaves)?)));
        let worst = [m4f.worst(function, octaves), m4f.worst_direct(function, octaves)];
        let [worst, direct] = worst.map(|worst| worst.map(|(cycles, _)| cycles));
        let counts = figures([worst, direct, m4f.code_bytes(function, octaves)]);
        format!("{name} | {} | {counts} | {}", figures(means), figures([data_bytes(function, octaves)]))
    });
    let header = format!("call | {} | worst | direct | code, bytes | data, bytes", ROWS[..=TRAPEZOID].join(" | "));
    table(&header, rows)
}

/// Each call's instructions.
fn instructions(cores: &[&Measured]) -> String {
    let rows = CALLS.into_iter().filter(|(.., octaves)| TOLD.contains(octaves)).map(|(name, function, octaves)| {
        let curves = if function.is_for_straight_ramps() { TRAPEZOID..=TRAPEZOID } else { 0..=TRAPEZOID - 1 };
        let counts = cores.iter().map(|core| {
            let on = |row| Some(grouped(core.instructions(function, row, octaves)?));
            Some(curves.clone().map(on).collect::<Option<Vec<_>>>()?.join("; "))
        });
        format!("{name} | {}", figures(counts))
    });
    table(&format!("soft; all ramp | {}", names(cores)), rows)
}

/// What building a curve and every call take beside time.
fn bytes(cores: &[&Measured]) -> String {
    let row = |name: &str, function, octaves| {
        let bytes = cores.iter().map(|core| {
            let bytes = [core.code_bytes(function, octaves)?, core.stack_bytes(function, octaves)?];
            Some(bytes.map(|bytes| grouped(bytes.into())).join("; "))
        });
        format!("{name} | {}", figures(bytes))
    };
    let building = TOLD.into_iter().flat_map(|octaves| {
        let name = format!("building, `OCTAVES = {octaves}`");
        let counts = cores.iter().map(|core| core.instructions(Construct, 0, octaves).map(grouped));
        [format!("{name}: instructions | {}", figures(counts)), row(&name, Construct, octaves)]
    });
    let calls = CALLS.iter().filter(|call| matches!(call.1, Static | Cdf | Openness | TickStep | Schedule));
    let calls = calls.map(|(name, function, octaves)| row(name, *function, *octaves));
    table(&format!("bytes of code; stack | {}", names(cores)), building.chain(calls))
}
