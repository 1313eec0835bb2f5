//! The tables of `docs/internals/cost.md`.

use measured::Function::{InverseCdf4, Schedule, Static, Tick};
use measured::{ALL_RAMP, FUNCTIONS, Function, NAMES, SOFT, TRAPEZOID, TRIGGERS};

use crate::Result;
use crate::firmware::{IMAFC, IMC, M0, M4F, M33, folder, made_with};
use crate::measure::Measured;

pub fn write() -> Result {
    let functions: Vec<Function> = FUNCTIONS.iter().map(|(of, _)| *of).collect();
    let m4f = Measured::new(M4F, &functions, TRAPEZOID + 1, &functions)?;
    // On hard curves some triggers of a schedule are searched for: else that code would not run.
    let others = [M33, M0, IMAFC, IMC].map(|core| {
        let told: Vec<Function> = functions.iter().filter(|function| **function != InverseCdf4).copied().collect();
        Measured::new(core, &told, TRAPEZOID + 1, &[Schedule])
    });
    let others = others.into_iter().collect::<Result<Vec<_>>>()?;
    let page = format!(
        "# What it costs on a microcontroller

Mean cycles of a Cortex-M4F, by a model, over uniform `u` or times; `OCTAVES = 8` if no other number is named. *Soft*
collects a third of its exposure on ramps, *all ramp* all of it, *trapezoid* a third on straight ramps. *Worst* is the
worst call found on the tests' hard curves, *direct* the worst without a search. A schedule has {TRIGGERS} triggers.

{cycles}

The first row calls by an opaque reference. In the second each curve is a `static`, as in firmware; its worst is over
typical curves.

Mean instructions of other cores, *soft* and *all ramp*, of square roots *trapezoid*:

{instructions}

## Building a curve at run time, flash and stack

The compiler builds a `static` curve. On a microcontroller *soft* takes these instructions, most of them for doubles,
which all of these cores compute in software. Code is every function that a call ran, stack the most that it took.
`.data` and `.bss` hold {statics} bytes.

{bytes}

## How it is measured

Made by `benches/cortex-m/run.sh --write-docs`, with
{made_with}.

A call counts from its first instruction to its return. QEMU counts *instructions* exactly; a Cortex-M0+ and a
riscv32imc compute floats in software. *Cycles* are modelled, within 10 % at zero wait states, probably 1 to 4 % low
([how the model was chosen](tried.md#the-model-of-cycles)). Two wait states without a cache cost up to 1.4 times as
much. A density that is dim at both ends may need more steps than the worst call here.
",
        cycles = cycles(&m4f),
        instructions = instructions(&others.iter().collect::<Vec<_>>()),
        statics = m4f.run.statics,
        bytes = bytes(&[&[&m4f], &others.iter().collect::<Vec<_>>()[..]].concat()),
        made_with = made_with()?,
    );
    Ok(std::fs::write(folder().join("../../docs/internals/cost.md"), page)?)
}

/// A table of figures by rows, its columns' names between bars.
fn table(header: &str, rows: impl IntoIterator<Item = (String, Vec<Option<String>>)>) -> String {
    let ruled = format!("|---|{}", "--:|".repeat(header.matches('|').count()));
    let rows = rows.into_iter().map(|(name, figures)| {
        let figures = figures.into_iter().map(|figure| figure.unwrap_or_else(|| "-".into()));
        format!("\n| {name} | {} |", figures.collect::<Vec<_>>().join(" | "))
    });
    format!("| {header} |\n{ruled}{}", rows.collect::<String>())
}

/// A number's digits, in threes if there are five or more, with a narrow space that does not break.
fn grouped(number: f64) -> String {
    let digits = format!("{number:.0}");
    let grouped = digits.as_bytes().rchunks(3).rev().map(String::from_utf8_lossy);
    if digits.len() < 5 { digits } else { grouped.collect::<Vec<_>>().join("\u{202f}") }
}

fn cycles(m4f: &Measured) -> String {
    let rows = FUNCTIONS.iter().filter(|(of, _)| !of.builds()).map(|&(of, name)| {
        let means = (0..=TRAPEZOID).map(|curve| m4f.mean(of, curve).map(|[_, cycles]| format!("{cycles:.0}")));
        let worst = [false, true].map(|is_direct| m4f.worst(of, is_direct).map(|cycles| cycles.to_string()));
        let bytes = [m4f.code(of).map(|bytes| bytes.to_string()), Some(of.data_bytes().to_string())];
        (name.to_owned(), means.chain(worst).chain(bytes).collect())
    });
    table(&format!("call | {} | worst | direct | code, bytes | data, bytes", NAMES.join(" | ")), rows)
}

/// A row for each function that has figures, a column for each core.
fn by_core(head: &str, cores: &[&Measured], cell: impl Fn(&Measured, Function) -> Option<String>) -> String {
    let names: Vec<_> = cores.iter().map(|core| core.name.replace("Cortex-", "")).collect();
    let rows = FUNCTIONS.iter().map(|(of, name)| {
        let cells: Vec<_> = cores.iter().map(|core| cell(core, *of)).collect();
        cells.iter().any(Option::is_some).then(|| (name.to_string(), cells))
    });
    table(&format!("{head} | {}", names.join(" | ")), rows.flatten())
}

fn instructions(cores: &[&Measured]) -> String {
    by_core("soft; all ramp", cores, |core, of| {
        let curves = if of.is_for_straight_ramps() { &[TRAPEZOID][..] } else { &[SOFT, ALL_RAMP] };
        let means = curves.iter().map(|curve| Some(grouped(core.mean(of, *curve)?[0])));
        Some(means.collect::<Option<Vec<_>>>()?.join("; "))
    })
}

fn bytes(cores: &[&Measured]) -> String {
    let building = by_core("instructions", cores, |core, of| {
        of.builds().then(|| Some(grouped(core.mean(of, SOFT)?[0]))).flatten()
    });
    let bytes = by_core("bytes of code; stack", cores, |core, of| {
        (of.builds() || matches!(of, Static | Tick | Schedule)).then_some(())?;
        Some(format!("{}; {}", grouped(core.code(of)?.into()), grouped(core.stack(of)?.into())))
    });
    format!("{building}\n\n{bytes}")
}
