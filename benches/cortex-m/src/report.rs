//! The whole report, as Markdown: printed, and written to `docs/cost.md`.

use std::fmt::Write;

use ::firmware::baseline::{InverseTable, TextbookNewton};
use ::firmware::{CELLS, CURVES, Curve, Function, Inputs, ROWS, TRIGGERS};
use shutter_curve::ShutterCurve;

use crate::firmware::{M0, M4F, SEEDS, folder, made_with};
use crate::measure::{Measured, Spread};
use crate::trace::{Key, Selection};

const INTRODUCTION: &str = "\
# What it costs on a microcontroller

Made by `cargo run --release` in `benches/cortex-m`. A call's figures are from its first instruction to its
return, over 512 uniform `u` (or times), everything inlined but the call itself.

*Instructions* are counted in QEMU and exact. *Cycles* are modelled: the executed instructions are charged by a
table of the Cortex-M4's Technical Reference Manual (`benches/cortex-m/src/model.rs`), without flash wait
states; the float costs have not been checked against a board. *Worst* is the most cycles found over the hard
curves of the tests and those found by search, and over hard inputs, some 700 a curve: the tests', the ends of
sections, powers of two, and those of 20 000 and their neighbours that take most evaluations. The Cortex-M0+
columns are instructions in soft float.
";

pub fn run() -> Result<(), String> {
    let mut out = format!("{INTRODUCTION}\nMade with {}.\n", made_with()?);
    let mut builds = Vec::new();
    for seed in SEEDS {
        eprintln!("measuring seed {} ...", named(seed));
        builds.push((named(seed), m4f(seed)?, m0(seed)?));
    }
    inverse(&mut out, &builds);
    others(&mut out, &builds);
    bytes(&mut out, &builds);
    construction(&mut out, &builds);
    print!("{out}");
    let path = folder().join("../../docs/cost.md");
    std::fs::write(&path, out).map_err(|error| format!("{}: {error}", path.display()))
}

/// A seed's name, and what was measured with it on both cores.
type Build = (&'static str, Measured, Measured);

fn named(seed: &'static str) -> &'static str {
    if seed.is_empty() { "none" } else { seed }
}

fn m4f(seed: &str) -> Result<Measured, String> {
    use Function::*;
    let some = |cells: &[usize], functions: &[Function], hard| Selection {
        cells: cells.to_vec(),
        functions: functions.to_vec(),
        inputs: if hard {
            ::firmware::ON_ROWS | ::firmware::ON_TYPICAL | ::firmware::ON_HARD
        } else {
            ::firmware::ON_ROWS
        },
    };
    let mut selections = vec![
        some(&CELLS, &[InverseCdf, Cdf, Opening, TickStep, Schedule, Newton, Table], false),
        some(&CELLS, &[InverseCdf], true),
    ];
    if seed == SEEDS[0] {
        selections.push(some(&[8], &[Cdf, Opening, Newton, Table], true));
        selections.push(some(&CELLS, &[TickStep, Schedule], true));
        // Building knows but one seed.
        selections.push(some(&CELLS, &[Construct], false));
    }
    Measured::new(M4F, seed, &selections)
}

fn m0(seed: &str) -> Result<Measured, String> {
    use Function::*;
    let mut functions = vec![InverseCdf, Cdf, Opening, TickStep, Schedule];
    if seed == SEEDS[0] {
        functions.extend([Newton, Table, Construct]);
    }
    Measured::new(
        M0,
        seed,
        &[Selection { cells: CELLS.to_vec(), functions, inputs: ::firmware::ON_ROWS }],
    )
}

fn key(function: Function, row: usize, cells: usize) -> Key {
    Key { function, cells, inputs: Inputs::Row(row), curve: Curve::index(ROWS[row].1) }
}

fn cycles(spread: Option<Spread>) -> String {
    spread.map_or_else(
        || "- | - | - | - | -".into(),
        |s| format!("{} | {} | **{:.0}** | {} | {}", s.min, s.median, s.mean, s.most, s.max),
    )
}

fn mean(spread: Option<Spread>) -> String {
    spread.map_or_else(|| "-".into(), |s| format!("{:.0}", s.mean))
}

fn worst(build: &Measured, function: Function, inputs: Inputs, cells: usize) -> String {
    build
        .worst(function, inputs, cells)
        .map_or_else(|| "-".into(), |(cycles, curve)| format!("{cycles} ({curve})"))
}

const COLUMNS: &str = "\
M4F instructions, mean | cycles: min | median | mean | 99 % | max | M0+ instructions, mean |\n\
|---|---|---|---|--:|--:|--:|--:|--:|--:|--:|\n";

/// One row of figures.
fn row(out: &mut String, head: &str, (_, m4f, m0): &Build, key: &Key) {
    let (instructions, soft) = (mean(m4f.instructions(key)), mean(m0.instructions(key)));
    let _ = writeln!(out, "| {head} | {instructions} | {} | {soft} |", cycles(m4f.cycles(key)));
}

fn inverse(out: &mut String, builds: &[Build]) {
    let _ = write!(out, "\n## `inverse_cdf`\n\n| curve | CELLS | seed | {COLUMNS}");
    for (index, (curve, _)) in ROWS.iter().enumerate() {
        for cells in CELLS {
            for build in builds {
                let key = key(Function::InverseCdf, index, cells);
                row(out, &format!("{curve} | {cells} | {}", build.0), build, &key);
            }
        }
    }
    out.push_str("\n| worst case, cycles | CELLS = 0 | 4 | 8 | 16 |\n|---|---|---|---|---|\n");
    for (seed, m4f, _) in builds {
        let of = |cells| worst(m4f, Function::InverseCdf, Inputs::Hard, cells);
        let _ = writeln!(out, "| seed {seed} | {} |", CELLS.map(of).join(" | "));
    }

    let _ = write!(
        out,
        "\nBaselines: the textbook Newton in `f32`, {} bytes, and a linear table of 256 entries, {} bytes. Their \
         error is the largest over 65 537 equally spaced `u`, as a share of the interval.\n\n\
         | curve | method | largest error | {COLUMNS}",
        size_of::<TextbookNewton>(),
        size_of::<InverseTable<256>>(),
    );
    let Some(build) = builds.iter().find(|build| build.0 == named(SEEDS[0])) else { return };
    for (index, (curve, data)) in ROWS.iter().enumerate() {
        for (method, function) in
            [("textbook Newton", Function::Newton), ("table", Function::Table)]
        {
            let error = error(&CURVES[Curve::index(data)], function);
            row(out, &format!("{curve} | {method} | {error:.1e}"), build, &key(function, index, 0));
        }
    }
    let of = |function| worst(&build.1, function, Inputs::Hard, 0);
    let _ = writeln!(
        out,
        "\nTheir worst: Newton {}, table {}.",
        of(Function::Newton),
        of(Function::Table)
    );
}

/// The largest error of a baseline, as a share of the interval.
fn error(curve: &Curve, function: Function) -> f64 {
    let (opening, closing) = curve.ramps();
    let Ok(exact) = ShutterCurve::<8>::with_cells(opening, closing) else { return f64::NAN };
    let newton = TextbookNewton::new(curve.opening, curve.closing);
    let table = InverseTable::<256>::new(|u| exact.inverse_cdf(u));
    let length = f64::from(exact.close_end()) - f64::from(exact.open_start());
    let errors = (0..=1 << 16).map(|i| {
        let u = i as f32 / (1 << 16) as f32;
        let t =
            if function == Function::Newton { newton.inverse_cdf(u) } else { table.inverse_cdf(u) };
        (f64::from(t) - f64::from(exact.inverse_cdf(u))).abs() / length
    });
    errors.fold(0.0, f64::max)
}

fn others(out: &mut String, builds: &[Build]) {
    use Function::{Cdf, Opening, Schedule, TickStep};
    let _ = write!(
        out,
        "\n## `cdf`, `opening`, a step of `trigger_ticks`, and a checked schedule of {TRIGGERS} triggers\n\n\
         `cdf` and `opening` have no use for the octaves, and cost the same for all CELLS.\n\n\
         | call | curve | CELLS, seed | {COLUMNS}"
    );
    let calls = [
        ("`cdf`", Cdf, &[8][..]),
        ("`opening`", Opening, &[8]),
        ("tick", TickStep, &CELLS),
        ("schedule", Schedule, &CELLS),
    ];
    for (name, function, cells) in calls {
        for (index, (curve, _)) in ROWS.iter().enumerate() {
            for cells in cells {
                for build in builds {
                    let head = format!("{name} | {curve} | {cells}, {}", build.0);
                    row(out, &head, build, &key(function, index, *cells));
                }
            }
        }
    }
    let Some((_, m4f, _)) = builds.iter().find(|build| build.0 == named(SEEDS[0])) else { return };
    let _ = writeln!(
        out,
        "\nWorst over the hard curves and inputs, cycles: `cdf` {}, `opening` {}. Of triggers, the steps of a frame \
         of {TRIGGERS} and the first of a frame whose first share ends near a hard input, and the frame as a whole; \
         the curves on a scale of time that makes the interval one to two million ticks, and *solved*: 64 times \
         that, where no polynomial serves. A frame that is refused for its gap costs as \
         many frames as are then tried.\n\n\
         | worst case, cycles | CELLS = 0 | 4 | 8 | 16 |\n|---|---|---|---|---|",
        worst(m4f, Cdf, Inputs::Hard, 8),
        worst(m4f, Opening, Inputs::Hard, 8)
    );
    for (name, function, inputs) in [
        ("tick", TickStep, Inputs::Hard),
        ("tick, solved", TickStep, Inputs::Solved),
        ("schedule", Schedule, Inputs::Hard),
        ("schedule, solved", Schedule, Inputs::Solved),
    ] {
        let of = |cells| worst(m4f, function, inputs, cells);
        let _ = writeln!(out, "| {name} | {} |", CELLS.map(of).join(" | "));
    }
}

fn bytes(out: &mut String, builds: &[Build]) {
    use Function::{Cdf, InverseCdf, Opening, Schedule, TickStep};
    let calls = [InverseCdf, Cdf, Opening, TickStep, Schedule];
    out.push_str(
        "\n## Flash and stack, bytes on a Cortex-M4F\n\n\
         Code is a call's own and all that it reaches, so calls share some. Stack is the high-water mark of a \
         painted stack over all curves, the hard inputs and the uniform ones, with triggers as above and frames \
         that are refused, and in brackets the deepest path by the compiler's figures. The library has no statics: `.data` and `.bss` hold ",
    );
    let _ = writeln!(
        out,
        "{} bytes.\n",
        builds.iter().map(|build| build.1.code.statics).max().unwrap_or(0)
    );
    out.push_str(
        "| CELLS | seed | one curve | code: `inverse_cdf` | `cdf` | `opening` | tick | schedule ",
    );
    out.push_str("| stack: `inverse_cdf` | `cdf` | `opening` | tick | schedule |\n|--:|---|");
    out.push_str(&"--:|".repeat(11));
    out.push('\n');
    for cells in CELLS {
        for (seed, m4f, _) in builds {
            let _ = write!(out, "| {cells} | {seed} | {} |", m4f.curve_bytes[&cells]);
            for function in calls {
                let code = m4f.code_bytes(function, cells);
                let _ = write!(out, " {} |", code.map_or_else(|| "-".into(), |n| n.to_string()));
            }
            for function in calls {
                let stack = m4f.stack(function, cells);
                let stack = stack
                    .map_or_else(|| "-".into(), |(painted, said)| format!("{painted} ({said})"));
                let _ = write!(out, " {stack} |");
            }
            out.push('\n');
        }
    }
}

fn construction(out: &mut String, builds: &[Build]) {
    let Some((_, m4f, m0)) = builds.iter().find(|build| build.0 == named(SEEDS[0])) else { return };
    out.push_str(
        "\n## Building a curve at run time\n\n\
         A `const` curve costs nothing. Built on the microcontroller, *soft* takes, with doubles in software:\n\n\
         | CELLS | M4F instructions | modelled cycles | M0+ instructions | code, bytes | stack, bytes |\n\
         |--:|--:|--:|--:|--:|--:|\n",
    );
    for cells in CELLS {
        let key = key(Function::Construct, 0, cells);
        let stack = m4f.stack(Function::Construct, cells);
        let _ = writeln!(
            out,
            "| {cells} | {} | {} | {} | {} | {} |",
            mean(m4f.instructions(&key)),
            mean(m4f.cycles(&key)),
            mean(m0.instructions(&key)),
            m4f.code_bytes(Function::Construct, cells).unwrap_or(0),
            stack.map_or_else(|| "-".into(), |(painted, said)| format!("{painted} ({said})")),
        );
    }
}
