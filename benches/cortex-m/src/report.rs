//! The whole report, as Markdown: printed, and written to `docs/cost.md`. First what most readers want, last what repeats
//! for each seed feature.

use std::fmt::Write;

use ::firmware::baseline::{InverseTable, TextbookNewton};
use ::firmware::{
    CELLS, CURVES, Curve, Function, Inputs, ON_HARD, ON_ROWS, ON_TYPICAL, ROWS, TRIGGERS,
};
use shutter_curve::ShutterCurve;

use crate::disassembly::Disassembly;
use crate::firmware::{Core, Flavour, IMAFC, IMC, M0, M4F, M33, SEEDS, build, folder, made_with};
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
sections, powers of two, and those of 20 000 and their neighbours that take most evaluations.

The other columns are mean instructions: on a Cortex-M33 and a riscv32imafc, which compute in `f32` as well, and in soft float
on a Cortex-M0+ and a riscv32imc. Where all cores have a column, the stack is the deepest path by the compiler's figures.
";

/// The cores whose instructions are counted beside the Cortex-M4F's, in the order of their columns.
const OTHER_CORES: [Core; 4] = [M33, M0, IMAFC, IMC];

/// What was measured with a seed: on a Cortex-M4F, and without a seed on each of the others.
struct Build {
    seed: &'static str,
    m4f: Measured,
    others: Vec<Measured>,
}

pub fn run() -> Result<(), String> {
    let mut builds = Vec::new();
    for seed in SEEDS {
        let name = if seed.is_empty() { "none" } else { seed };
        eprintln!("measuring seed {name} ...");
        let others = if seed.is_empty() { &OTHER_CORES[..] } else { &[] };
        let others = others.iter().map(|core| other(*core)).collect::<Result<_, _>>()?;
        builds.push(Build { seed: name, m4f: m4f(seed)?, others });
    }
    let [default, seeds @ ..] = &builds[..] else { return Err("no seed".into()) };

    let mut out = String::from("# What it costs on a microcontroller\n");
    on_each_core(&mut out, default);
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
    construction(&mut out, default, building_for_size()?);
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
    if seed != SEEDS[0] {
        let inverse = some(&CELLS, &[InverseCdf], ON_ROWS | ON_HARD);
        return Measured::new(M4F, seed, &[inverse]);
    }
    let selections = [
        some(&CELLS, &rows, ON_ROWS),
        some(&CELLS, &[InverseCdf, TickStep, Schedule], ON_TYPICAL | ON_HARD),
        some(&[8], &[Cdf, Opening, Newton, Table], ON_TYPICAL | ON_HARD),
        some(&CELLS, &[Construct], ON_ROWS),
    ];
    Measured::new(M4F, seed, &selections)
}

fn other(core: Core) -> Result<Measured, String> {
    eprintln!("on {} ...", core.name);
    let selection =
        Selection { cells: CELLS.to_vec(), functions: Function::ALL.to_vec(), inputs: ON_ROWS };
    Measured::new(core, SEEDS[0], &[selection])
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

/// A table's header: the Cortex-M4F's cycles and a figure of each core.
fn cores_header(out: &mut String) {
    let names = OTHER_CORES.map(|core| core.name.replace("Cortex-", ""));
    let ruled = "--:|".repeat(2 + names.len());
    let _ = writeln!(out, "\n| | M4F cycles | M4F | {} |\n|---|{ruled}", names.join(" | "));
}

/// One of its rows.
fn cores_row(
    out: &mut String,
    Build { m4f, others, .. }: &Build,
    what: &str,
    cycles: Option<Spread>,
    of: impl Fn(&Measured) -> Option<f64>,
) {
    let cycles = cycles.map_or_else(String::new, |s| format!("**{}**", grouped(s.mean)));
    let cores = [m4f].into_iter().chain(others);
    let figures: Vec<String> = cores.map(|core| text(of(core).map(grouped))).collect();
    let _ = writeln!(out, "| {what} | {cycles} | {} |", figures.join(" | "));
}

/// A number's digits, in threes if there are five or more, with a narrow space that does not break.
fn grouped(number: f64) -> String {
    let digits = format!("{number:.0}");
    let grouped = digits.as_bytes().rchunks(3).rev().map(String::from_utf8_lossy);
    if digits.len() < 5 { digits } else { grouped.collect::<Vec<_>>().join("\u{202f}") }
}

/// The first screen: what an answer, a tick, a schedule and a curve cost, on each core.
fn on_each_core(out: &mut String, build: &Build) {
    use Function::{Construct, InverseCdf, Newton, Schedule, TickStep};
    let m4f = &build.m4f;
    let _ = writeln!(
        out,
        "\nMean instructions, and on the Cortex-M4F modelled cycles, too; *soft* has a third of its mass in ramps, *all ramp* \
         all of it. With `CELLS = 8`, a curve of {} bytes in flash, unless it says otherwise.",
        m4f.curve_bytes[&8],
    );
    cores_header(out);
    let schedule = format!("a checked schedule of {TRIGGERS} triggers");
    for (what, function, cells) in [
        ("`inverse_cdf`", InverseCdf, 8),
        ("a tick of `trigger_ticks`", TickStep, 8),
        (&schedule, Schedule, 8),
        ("`inverse_cdf`, `CELLS = 0`", InverseCdf, 0),
        ("textbook Newton in `f32`", Newton, 0),
    ] {
        for (row, (name, _)) in ROWS.iter().enumerate().take(2) {
            calls_row(out, build, &format!("{what}, {name}"), &key(function, row, cells));
        }
    }
    calls_row(out, build, "a curve built at run time, soft", &key(Construct, 0, 8));
    for (what, function) in [
        ("`inverse_cdf`", InverseCdf),
        ("a tick", TickStep),
        ("a schedule", Schedule),
        ("building", Construct),
    ] {
        code_row(out, build, &format!("bytes of code: {what}"), function, 8);
    }
    for (what, function) in
        [("`inverse_cdf`", InverseCdf), ("a schedule", Schedule), ("building", Construct)]
    {
        stack_row(out, build, &format!("bytes of stack: {what}"), function, 8);
    }
}

fn calls_row(out: &mut String, build: &Build, what: &str, key: &Key) {
    cores_row(out, build, what, build.m4f.cycles(key), |core| {
        core.instructions(key).map(|spread| spread.mean)
    });
}

fn code_row(out: &mut String, build: &Build, what: &str, function: Function, cells: usize) {
    cores_row(out, build, what, None, |core| core.code_bytes(function, cells).map(f64::from));
}

fn stack_row(out: &mut String, build: &Build, what: &str, function: Function, cells: usize) {
    cores_row(out, build, what, None, |core| core.stack_said(function, cells).map(f64::from));
}

/// The inverse beside its baselines, and the calls.
fn overview(out: &mut String, Build { m4f, .. }: &Build) {
    use Function::{Cdf, InverseCdf, Newton, Opening, Schedule, Table, TickStep};
    let typical = Inputs::Typical.curves().count();
    out.push_str(
        "\n`inverse_cdf` beside its baselines, in cycles over uniform `u`.\n\n\
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

const COLUMNS: &str = "M4F instructions, mean | cycles: min | median | mean | 99 % | max |";

/// A table's header: of so many columns of text, with these names, and the columns of figures.
fn header(out: &mut String, texts: &str, build: &Build) {
    let others = OTHER_CORES.iter().take(build.others.len());
    let others: String =
        others.map(|core| format!(" {} |", core.name.replace("Cortex-", ""))).collect();
    let columns = format!("{COLUMNS}{others}");
    let (texts_ruled, figures) =
        ("---|".repeat(texts.split(" | ").count()), "--:|".repeat(columns.matches('|').count()));
    let _ = writeln!(out, "\n| {texts} | {columns}\n|{texts_ruled}{figures}");
}

/// One row of figures.
fn row(out: &mut String, head: &str, Build { m4f, others, .. }: &Build, key: &Key) {
    let instructions = mean(m4f.instructions(key));
    let cycles = m4f.cycles(key).map_or_else(
        || "- | - | - | - | -".into(),
        |s| format!("{} | {} | **{:.0}** | {} | {}", s.min, s.median, s.mean, s.most, s.max),
    );
    let others: String =
        others.iter().map(|core| format!(" {} |", mean(core.instructions(key)))).collect();
    let _ = writeln!(out, "| {head} | {instructions} | {cycles} |{others}");
}

fn cells_header(out: &mut String, head: &str) {
    let _ = writeln!(out, "\n| {head} | CELLS = 0 | 4 | 8 | 16 |\n|---|---|---|---|---|");
}

fn worst_row(out: &mut String, name: &str, build: &Measured, function: Function, inputs: Inputs) {
    let of = |cells| worst(build, function, inputs, cells);
    let _ = writeln!(out, "| {name} | {} |", CELLS.map(of).join(" | "));
}

fn inverse(out: &mut String, build: &Build) {
    out.push_str("\n## `inverse_cdf`\n");
    header(out, "curve | CELLS", build);
    for (index, (curve, _)) in ROWS.iter().enumerate() {
        for cells in CELLS {
            let key = key(Function::InverseCdf, index, cells);
            row(out, &format!("{curve} | {cells}"), build, &key);
        }
    }
    cells_header(out, "worst case, cycles");
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
    header(out, "curve | method | largest error", build);
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
    header(out, "call | curve | CELLS", build);
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
    cells_header(out, "worst case, cycles");
    for (name, function, inputs) in [
        ("tick", TickStep, Inputs::Hard),
        ("tick, solved", TickStep, Inputs::Solved),
        ("schedule", Schedule, Inputs::Hard),
        ("schedule, solved", Schedule, Inputs::Solved),
    ] {
        worst_row(out, name, m4f, function, inputs);
    }
}

fn bytes(out: &mut String, Build { m4f, .. }: &Build) {
    use Function::{Cdf, Construct, InverseCdf, Opening, Schedule, TickStep};
    let _ = write!(
        out,
        "\n## Flash and stack, bytes on a Cortex-M4F\n\n\
         Code is a call's own and all that it reaches, so calls share some. Stack is the high-water mark of a \
         painted stack over all curves, the hard inputs and the uniform ones, with triggers as above and frames \
         that are refused, and in brackets the deepest path by the compiler's figures. The library has no statics: \
         `.data` and `.bss` hold {} bytes.\n\n\
         | CELLS | one curve | code: `inverse_cdf` | `cdf` | `opening` | tick | schedule | building \
         | stack: `inverse_cdf` | `cdf` | `opening` | tick | schedule | building |\n|---|{}\n",
        m4f.code.statics,
        "--:|".repeat(13),
    );
    let calls = [InverseCdf, Cdf, Opening, TickStep, Schedule, Construct];
    for cells in CELLS {
        let code = calls.map(|function| text(m4f.code_bytes(function, cells)));
        let stack = calls.map(|function| {
            text(m4f.stack(function, cells).map(|(painted, said)| format!("{painted} ({said})")))
        });
        let (curve, code, stack) = (m4f.curve_bytes[&cells], code.join(" | "), stack.join(" | "));
        let _ = writeln!(out, "| {cells} | {curve} | {code} | {stack} |");
    }
}

fn construction(out: &mut String, build: &Build, for_size: u32) {
    let _ = writeln!(
        out,
        "\n## Building a curve at run time\n\n\
         A `const` curve costs nothing: the compiler builds it. Built on the microcontroller, *soft* takes so many instructions, \
         most of them in doubles, which all of these compute in software. Where that is too much, make the curve a `const`; if it \
         is not known beforehand, build it with `CELLS = 0`, which fits no polynomials, and each answer is a search. Optimised for \
         size (`opt-level = \"z\"`), building takes {} bytes of code on a Cortex-M4F.",
        grouped(for_size.into()),
    );
    cores_header(out);
    for cells in CELLS {
        calls_row(out, build, &format!("`CELLS = {cells}`"), &key(Function::Construct, 0, cells));
    }
    for cells in CELLS {
        code_row(
            out,
            build,
            &format!("bytes of code, `CELLS = {cells}`"),
            Function::Construct,
            cells,
        );
    }
    for cells in CELLS {
        stack_row(
            out,
            build,
            &format!("bytes of stack, `CELLS = {cells}`"),
            Function::Construct,
            cells,
        );
    }
}

/// The code that builds a curve on a Cortex-M4F, with the most cells, optimised for size.
fn building_for_size() -> Result<u32, String> {
    let flavour = Flavour { level: "z", ..Flavour::fast(SEEDS[0]) };
    let code = Disassembly::of(M4F, &build(M4F, "cost", flavour)?)?;
    let instances = code.named(Function::Construct.symbol()).into_iter();
    instances.map(|instance| code.code_bytes(instance)).max().ok_or_else(|| "no code".into())
}

/// The inverse once more, with each seed feature.
fn with_seeds(out: &mut String, builds: &[Build]) {
    out.push_str(
        "\n## With the seed features\n\n\
         All of the above is without one. These choose the root with which a search starts, and change nothing else.\n",
    );
    let Some(first) = builds.first() else { return };
    header(out, "curve | CELLS | seed", first);
    for (index, (curve, _)) in ROWS.iter().enumerate() {
        for cells in CELLS {
            for build in builds {
                let key = key(Function::InverseCdf, index, cells);
                row(out, &format!("{curve} | {cells} | {}", build.seed), build, &key);
            }
        }
    }
    cells_header(out, "");
    for Build { seed, m4f, .. } in builds {
        let name = format!("{seed}: worst case, cycles");
        worst_row(out, &name, m4f, Function::InverseCdf, Inputs::Hard);
    }
    for build in builds {
        let code = CELLS.map(|cells| text(build.m4f.code_bytes(Function::InverseCdf, cells)));
        let _ = writeln!(out, "| {}: bytes of code | {} |", build.seed, code.join(" | "));
    }
}
