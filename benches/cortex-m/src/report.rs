//! The whole report, as Markdown: printed, and written to `docs/cost.md`. First what most readers want, last what repeats
//! for each seed feature.

use std::fmt::Write;

use ::firmware::baseline::{InverseTable, TextbookNewton};
use ::firmware::{
    CELLS, CURVES, Curve, Function, Inputs, ON_HARD, ON_ROWS, ON_TYPICAL, ROWS, TRIGGERS,
};
use shutter_curve::ShutterCurve;

use crate::firmware::{M0, M4F, SEEDS, folder, made_with};
use crate::measure::{Measured, Spread};
use crate::trace::{Key, Selection};

const METHOD: &str = "
## How it is measured

A call's figures are from its first instruction to its return, over 512 uniform `u` (or times), everything inlined but the
call itself.

*Instructions* are counted in QEMU and exact. *Cycles* are modelled: the executed instructions are charged by a
table of the Cortex-M4's Technical Reference Manual (`benches/cortex-m/src/model.rs`), without flash wait
states; the float costs have not been checked against a board. *Worst* is the most cycles found over the hard
curves of the tests and those found by search, and over hard inputs, some 700 a curve: the tests', the ends of
sections, powers of two, and those of 20 000 and their neighbours that take most evaluations. The Cortex-M0+
columns are instructions in soft float.
";

/// What was measured with a seed on both cores.
struct Build {
    seed: &'static str,
    m4f: Measured,
    m0: Measured,
}

pub fn run() -> Result<(), String> {
    let mut builds = Vec::new();
    for seed in SEEDS {
        let name = if seed.is_empty() { "none" } else { seed };
        eprintln!("measuring seed {name} ...");
        builds.push(Build { seed: name, m4f: m4f(seed)?, m0: m0(seed)? });
    }
    let [default, seeds @ ..] = &builds[..] else { return Err("no seed".into()) };

    let mut out = String::from("# What it costs on a microcontroller\n");
    overview(&mut out, default);
    let _ = writeln!(
        out,
        "\nMade by `cargo run --release` in `benches/cortex-m`, with {}.",
        made_with()?
    );
    out.push_str(METHOD);
    inverse(&mut out, default);
    typical(&mut out, default);
    baselines(&mut out, default);
    others(&mut out, default);
    bytes(&mut out, default);
    construction(&mut out, default);
    with_seeds(&mut out, seeds);
    print!("{out}");
    let path = folder().join("../../docs/cost.md");
    std::fs::write(&path, out).map_err(|error| format!("{}: {error}", path.display()))
}

fn m4f(seed: &'static str) -> Result<Measured, String> {
    use Function::*;
    let some = |cells: &[usize], functions: &[Function], inputs| Selection {
        cells: cells.to_vec(),
        functions: functions.to_vec(),
        inputs,
    };
    let rows = [InverseCdf, Cdf, Opening, TickStep, Schedule, Newton, Table];
    let mut selections =
        vec![some(&CELLS, &rows, ON_ROWS), some(&CELLS, &[InverseCdf], ON_TYPICAL | ON_HARD)];
    if seed == SEEDS[0] {
        selections.push(some(&[8], &[Cdf, Opening, Newton, Table], ON_TYPICAL | ON_HARD));
        selections.push(some(&CELLS, &[TickStep, Schedule], ON_TYPICAL | ON_HARD));
        // Building knows but one seed.
        selections.push(some(&CELLS, &[Construct], ON_ROWS));
    }
    Measured::new(M4F, seed, &selections)
}

fn m0(seed: &'static str) -> Result<Measured, String> {
    use Function::*;
    let mut functions = vec![InverseCdf, Cdf, Opening, TickStep, Schedule];
    if seed == SEEDS[0] {
        functions.extend([Newton, Table, Construct]);
    }
    let selection = Selection { cells: CELLS.to_vec(), functions, inputs: ON_ROWS };
    Measured::new(M0, seed, &[selection])
}

fn key(function: Function, row: usize, cells: usize) -> Key {
    Key { function, cells, inputs: Inputs::Row(row), curve: Curve::index(ROWS[row].1) }
}

/// A figure, or a dash where there is none.
fn text<T: ToString>(figure: Option<T>) -> String {
    figure.map_or_else(|| "-".into(), |figure| figure.to_string())
}

fn rounded(figure: Option<f64>) -> String {
    text(figure.map(|figure| format!("{figure:.0}")))
}

fn mean(spread: Option<Spread>) -> String {
    rounded(spread.map(|spread| spread.mean))
}

fn worst(build: &Measured, function: Function, inputs: Inputs, cells: usize) -> String {
    let worst = build.worst(function, inputs, cells);
    text(worst.map(|(cycles, curve)| format!("{cycles} ({curve})")))
}

/// What most readers want.
fn overview(out: &mut String, Build { m4f, m0, .. }: &Build) {
    use Function::{Cdf, InverseCdf, Newton, Opening, Schedule, Table, TickStep};
    let typical = Inputs::Typical.curves().count();
    out.push_str(
        "\n`inverse_cdf` beside its baselines. Cycles are of a Cortex-M4F, by a model, over uniform `u`; *soft* has a \
         third of its mass in ramps, *all ramp* all of it.\n\n\
         | | `CELLS = 0` | `CELLS = 8` | textbook Newton in `f32` | linear table of 256 |\n\
         |---|--:|--:|--:|--:|\n",
    );
    let methods = [(InverseCdf, 0), (InverseCdf, 8), (Newton, 0), (Table, 0)];
    let mut line = |what: &str, of: &dyn Fn(Function, usize) -> String| {
        let figures = methods.map(|(function, cells)| of(function, cells));
        let _ = writeln!(out, "| {what} | {} |", figures.join(" | "));
    };
    let on_row = |row| move |function, cells| mean(m4f.cycles(&key(function, row, cells)));
    line("cycles: mean on *soft*", &on_row(0));
    line("mean on *all ramp*", &on_row(1));
    line(&format!("mean over {typical} typical curves"), &|function, cells| {
        rounded(m4f.typical_mean(function, cells))
    });
    line("worst call found, on any curve", &|function, cells| {
        text(m4f.worst(function, Inputs::Hard, cells).map(|(cycles, _)| cycles))
    });
    line("bytes of a curve", &|function, cells| match function {
        Newton => size_of::<TextbookNewton>().to_string(),
        Table => size_of::<InverseTable<256>>().to_string(),
        _ => m4f.curve_bytes[&cells].to_string(),
    });
    line("bytes of code", &|function, cells| text(m4f.code_bytes(function, cells)));
    let soft_float = |row| move |function, cells| mean(m0.instructions(&key(function, row, cells)));
    line("Cortex-M0+ instructions: mean on *soft*", &soft_float(0));
    line("mean on *all ramp*", &soft_float(1));

    let _ = write!(
        out,
        "\nThe calls with `CELLS = 8`, in cycles. *Direct* is the worst call, on any curve, that is answered by a polynomial or the plateau's line, as all of a frame of \
         `direct_triggers()` are; a schedule is of {TRIGGERS} triggers, checked.\n\n\
         | call | soft | all ramp | box | typical | worst | direct | code, bytes | stack, bytes |\n\
         |---|--:|--:|--:|--:|--:|--:|--:|--:|\n"
    );
    let calls = [
        ("`inverse_cdf`", InverseCdf),
        ("`cdf`", Cdf),
        ("`opening`", Opening),
        ("a tick", TickStep),
        ("a schedule", Schedule),
    ];
    for (name, function) in calls {
        let on_rows = [0, 1, 2].map(|row| mean(m4f.cycles(&key(function, row, 8))));
        let worst = [Inputs::Hard, Inputs::Solved].map(|inputs| m4f.worst(function, inputs, 8));
        let _ = writeln!(
            out,
            "| {name} | {} | {} | {} | {} | {} | {} |",
            on_rows.join(" | "),
            rounded(m4f.typical_mean(function, 8)),
            text(worst.into_iter().flatten().max().map(|(cycles, _)| cycles)),
            text(m4f.worst_direct(function, 8).map(|(cycles, _)| cycles)),
            text(m4f.code_bytes(function, 8)),
            text(m4f.stack(function, 8).map(|(painted, _)| painted)),
        );
    }
}

const COLUMNS: &str = "\
M4F instructions, mean | cycles: min | median | mean | 99 % | max | M0+ instructions, mean |\n";

/// A table's header: of so many columns of text, with these names, and the columns of figures.
fn header(out: &mut String, texts: &str) {
    let count = texts.split(" | ").count();
    let (texts_ruled, figures) =
        ("---|".repeat(count), "--:|".repeat(COLUMNS.split(" | ").count()));
    let _ = writeln!(out, "\n| {texts} | {COLUMNS}|{texts_ruled}{figures}");
}

/// One row of figures.
fn row(out: &mut String, head: &str, Build { m4f, m0, .. }: &Build, key: &Key) {
    let (instructions, soft) = (mean(m4f.instructions(key)), mean(m0.instructions(key)));
    let cycles = m4f.cycles(key).map_or_else(
        || "- | - | - | - | -".into(),
        |s| format!("{} | {} | **{:.0}** | {} | {}", s.min, s.median, s.mean, s.most, s.max),
    );
    let _ = writeln!(out, "| {head} | {instructions} | {cycles} | {soft} |");
}

fn worst_header(out: &mut String) {
    out.push_str("\n| worst case, cycles | CELLS = 0 | 4 | 8 | 16 |\n|---|---|---|---|---|\n");
}

fn worst_row(out: &mut String, name: &str, build: &Measured, function: Function, inputs: Inputs) {
    let of = |cells| worst(build, function, inputs, cells);
    let _ = writeln!(out, "| {name} | {} |", CELLS.map(of).join(" | "));
}

fn inverse(out: &mut String, build: &Build) {
    out.push_str("\n## `inverse_cdf`\n");
    header(out, "curve | CELLS");
    for (index, (curve, _)) in ROWS.iter().enumerate() {
        for cells in CELLS {
            let key = key(Function::InverseCdf, index, cells);
            row(out, &format!("{curve} | {cells}"), build, &key);
        }
    }
    worst_header(out);
    worst_row(out, "`inverse_cdf`", &build.m4f, Function::InverseCdf, Inputs::Hard);
}

fn typical(out: &mut String, Build { m4f, .. }: &Build) {
    out.push_str(
        "\n## On every typical curve\n\n\
         Mean cycles of `inverse_cdf` over uniform `u`, and with `CELLS = 8` the share of the `u` that are searched \
         for; the same of the ticks of a frame of 512.\n\n\
         | curve | CELLS = 0 | 4 | 8 | searched | 16 | tick, CELLS = 8 | searched |\n\
         |---|--:|--:|--:|--:|--:|--:|--:|\n",
    );
    let inverse = CELLS.map(|cells| m4f.typical(Function::InverseCdf, cells));
    let ticks = m4f.typical(Function::TickStep, 8);
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    for (i, tick) in ticks.iter().enumerate() {
        let [none, four, eight, sixteen] = inverse.each_ref().map(|curves| curves[i].cycles.mean);
        let _ = writeln!(
            out,
            "| {} | {none:.0} | {four:.0} | **{eight:.0}** | {} | {sixteen:.0} | {:.0} | {} |",
            tick.name,
            percent(inverse[2][i].searched),
            tick.cycles.mean,
            percent(tick.searched),
        );
    }
    let [none, four, eight, sixteen] =
        CELLS.map(|cells| rounded(m4f.typical_mean(Function::InverseCdf, cells)));
    let tick = rounded(m4f.typical_mean(Function::TickStep, 8));
    let _ = writeln!(out, "| mean | {none} | {four} | **{eight}** | | {sixteen} | {tick} | |");
    for (what, function) in
        [("an `inverse_cdf`", Function::InverseCdf), ("a tick", Function::TickStep)]
    {
        if let Some((cycles, place)) = m4f.worst_direct(function, 8) {
            let _ = writeln!(
                out,
                "\nThe most cycles of {what} that is answered by a polynomial or the plateau's line, on all curves, with uniform \
                 and hard inputs: {cycles} ({place})."
            );
        }
    }
}

fn baselines(out: &mut String, build: &Build) {
    let _ = writeln!(
        out,
        "\n## Baselines\n\n\
         The textbook Newton in `f32`, {} bytes, and a linear table of 256 entries, {} bytes. Their error is the largest \
         over 65 537 equally spaced `u`, as a share of the interval.",
        size_of::<TextbookNewton>(),
        size_of::<InverseTable<256>>(),
    );
    header(out, "curve | method | largest error");
    for (index, (curve, data)) in ROWS.iter().enumerate() {
        for (method, function) in
            [("textbook Newton", Function::Newton), ("table", Function::Table)]
        {
            let error = error(&CURVES[Curve::index(data)], function);
            row(out, &format!("{curve} | {method} | {error:.1e}"), build, &key(function, index, 0));
        }
    }
    let of = |function| worst(&build.m4f, function, Inputs::Hard, 0);
    let (newton, table) = (of(Function::Newton), of(Function::Table));
    let _ = writeln!(out, "\nTheir worst: Newton {newton}, table {table}.");
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

/// The calls beside the inverse, and the numbers of cells for which they are shown.
const OTHERS: [(&str, Function, &[usize]); 4] = [
    ("`cdf`", Function::Cdf, &[8]),
    ("`opening`", Function::Opening, &[8]),
    ("tick", Function::TickStep, &CELLS),
    ("schedule", Function::Schedule, &CELLS),
];

fn others(out: &mut String, build: &Build) {
    use Function::{Cdf, Opening, Schedule, TickStep};
    let _ = writeln!(
        out,
        "\n## `cdf`, `opening`, a step of `trigger_ticks`, and a checked schedule of {TRIGGERS} triggers\n\n\
         `cdf` and `opening` have no use for the octaves, and cost the same for all CELLS.",
    );
    header(out, "call | curve | CELLS");
    for (name, function, cells) in OTHERS {
        for (index, (curve, _)) in ROWS.iter().enumerate() {
            for cells in cells {
                let head = format!("{name} | {curve} | {cells}");
                row(out, &head, build, &key(function, index, *cells));
            }
        }
    }
    let m4f = &build.m4f;
    let _ = writeln!(
        out,
        "\nWorst over the hard curves and inputs, cycles: `cdf` {}, `opening` {}. Of triggers, the steps of a frame \
         of {TRIGGERS} and the first of a frame whose first share ends near a hard input, and the frame as a whole; \
         the curves on a scale of time that makes the interval one to two million ticks, and *solved*: 64 times \
         that, where no polynomial serves. A frame that is refused for its gap costs no more \
         than one that is not.",
        worst(m4f, Cdf, Inputs::Hard, 8),
        worst(m4f, Opening, Inputs::Hard, 8)
    );
    worst_header(out);
    for (name, function, inputs) in [
        ("tick", TickStep, Inputs::Hard),
        ("tick, solved", TickStep, Inputs::Solved),
        ("schedule", Schedule, Inputs::Hard),
        ("schedule, solved", Schedule, Inputs::Solved),
    ] {
        worst_row(out, name, m4f, function, inputs);
    }
}

fn bytes(out: &mut String, build: &Build) {
    let _ = write!(
        out,
        "\n## Flash and stack, bytes on a Cortex-M4F\n\n\
         Code is a call's own and all that it reaches, so calls share some. Stack is the high-water mark of a \
         painted stack over all curves, the hard inputs and the uniform ones, with triggers as above and frames \
         that are refused, and in brackets the deepest path by the compiler's figures. The library has no statics: \
         `.data` and `.bss` hold {} bytes.\n\n",
        build.m4f.code.statics
    );
    bytes_header(out, "CELLS");
    for cells in CELLS {
        bytes_row(out, &cells.to_string(), &build.m4f, cells);
    }
}

fn bytes_header(out: &mut String, head: &str) {
    let _ = write!(
        out,
        "| {head} | one curve | code: `inverse_cdf` | `cdf` | `opening` | tick | schedule "
    );
    out.push_str("| stack: `inverse_cdf` | `cdf` | `opening` | tick | schedule |\n");
    let texts = head.split(" | ").count();
    let _ = writeln!(out, "|{}{}", "---|".repeat(texts), "--:|".repeat(11));
}

fn bytes_row(out: &mut String, head: &str, m4f: &Measured, cells: usize) {
    use Function::{Cdf, InverseCdf, Opening, Schedule, TickStep};
    let calls = [InverseCdf, Cdf, Opening, TickStep, Schedule];
    let code = calls.map(|function| text(m4f.code_bytes(function, cells)));
    let stack = calls.map(|function| {
        text(m4f.stack(function, cells).map(|(painted, said)| format!("{painted} ({said})")))
    });
    let (code, stack) = (code.join(" | "), stack.join(" | "));
    let _ = writeln!(out, "| {head} | {} | {code} | {stack} |", m4f.curve_bytes[&cells]);
}

fn construction(out: &mut String, Build { m4f, m0, .. }: &Build) {
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
            text(stack.map(|(painted, said)| format!("{painted} ({said})"))),
        );
    }
}

/// The same tables again, with each seed feature.
fn with_seeds(out: &mut String, builds: &[Build]) {
    out.push_str(
        "\n## With the seed features\n\n\
         All of the above is without one. These choose the root with which a search starts.\n",
    );
    header(out, "curve | CELLS | seed");
    for (index, (curve, _)) in ROWS.iter().enumerate() {
        for cells in CELLS {
            for build in builds {
                let key = key(Function::InverseCdf, index, cells);
                row(out, &format!("{curve} | {cells} | {}", build.seed), build, &key);
            }
        }
    }
    worst_header(out);
    for build in builds {
        worst_row(out, build.seed, &build.m4f, Function::InverseCdf, Inputs::Hard);
    }
    header(out, "call | curve | CELLS | seed");
    for (name, function, cells) in OTHERS {
        for (index, (curve, _)) in ROWS.iter().enumerate() {
            for cells in cells {
                for build in builds {
                    let head = format!("{name} | {curve} | {cells} | {}", build.seed);
                    row(out, &head, build, &key(function, index, *cells));
                }
            }
        }
    }
    out.push('\n');
    bytes_header(out, "CELLS | seed");
    for cells in CELLS {
        for build in builds {
            bytes_row(out, &format!("{cells} | {}", build.seed), &build.m4f, cells);
        }
    }
}
