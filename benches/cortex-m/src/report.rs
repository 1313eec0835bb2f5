//! The whole report, as Markdown: printed, and written to `docs/cost.md`. First what most readers want.

use std::fmt::Write;

use measured::baseline::{InverseTable, TextbookNewton};
use measured::roots::{DIVISOR, ROOTS, dividend};
use measured::{
    CELLS, CURVES, DEFAULT, Function, Inputs, ON_HARD, ON_ROWS, ON_TYPICAL, ROWS, Series, TRIGGERS,
};
use shutter_curve::ShutterCurve;

use crate::Result;
use crate::disassembly::Disassembly;
use crate::firmware::{IMAFC, IMC, M0, M4F, M33, build, folder, made_with};
use crate::measure::{Measured, Spread, on_row};
use crate::trace::selection;

use Function::{Cdf, Construct, InverseCdf, Newton, Opening, Root, Schedule, Table, TickStep};

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

pub fn run() -> Result {
    let selections = [
        selection(&CELLS, &[InverseCdf, TickStep, Schedule], ON_TYPICAL | ON_HARD),
        selection(&[DEFAULT], &[Cdf, Opening, Newton, Table], ON_TYPICAL | ON_HARD),
        selection(&CELLS, &[Construct, Root], ON_ROWS),
        // Their code and their stack differ.
        selection(&CELLS, &[Cdf, Opening], ON_ROWS),
    ];
    let m4f = Measured::new(M4F, &selections)?;
    let all = selection(&CELLS, &Function::ALL.map(|(function, _)| function), ON_ROWS);
    let others = [M33, M0, IMAFC, IMC].map(|core| Measured::new(core, &[all]));
    let others = others.into_iter().collect::<Result<Vec<_>>>()?;
    let cores: Vec<&Measured> = [&m4f].into_iter().chain(&others).collect();

    let mut out = String::from("# What it costs on a microcontroller\n");
    on_each_core(&mut out, &cores);
    overview(&mut out, &m4f);
    let made_with = made_with()?;
    say(
        &mut out,
        &format!("Made by `cargo run --release` in `benches/cortex-m`, with {made_with}."),
    );
    out.push_str(METHOD);
    calls(&mut out, &cores);
    worst_cases(&mut out, &m4f);
    typical(&mut out, &m4f);
    bytes(&mut out, &m4f);
    construction(&mut out, &cores, building_for_size()?);
    roots(&mut out, &m4f);
    print!("{out}");
    Ok(std::fs::write(folder().join("../../docs/cost.md"), out)?)
}

fn say(out: &mut String, text: &str) {
    let _ = writeln!(out, "\n{text}");
}

/// A table, its columns' names between bars: so many columns of text, the others of figures.
fn table(out: &mut String, header: &str, texts: usize, rows: impl IntoIterator<Item = String>) {
    let figures = header.matches(" | ").count() + 1 - texts;
    say(out, &format!("| {header} |\n|{}{}", "---|".repeat(texts), "--:|".repeat(figures)));
    for row in rows {
        let _ = writeln!(out, "| {row} |");
    }
}

/// The figures of a row, a dash where there is none.
fn figures<T: ToString>(figures: impl IntoIterator<Item = Option<T>>) -> String {
    let figures = figures.into_iter().map(|f| f.map_or_else(|| "-".into(), |f| f.to_string()));
    figures.collect::<Vec<_>>().join(" | ")
}

fn rounded(figure: f64) -> String {
    format!("{figure:.0}")
}

fn mean(spread: Option<Spread>) -> Option<String> {
    spread.map(|spread| rounded(spread.mean))
}

/// A number's digits, in threes if there are five or more, with a narrow space that does not break.
fn grouped(number: f64) -> String {
    let digits = rounded(number);
    let grouped = digits.as_bytes().rchunks(3).rev().map(String::from_utf8_lossy);
    if digits.len() < 5 { digits } else { grouped.collect::<Vec<_>>().join("\u{202f}") }
}

fn names(cores: &[&Measured]) -> String {
    let names = cores.iter().map(|core| core.name.replace("Cortex-", ""));
    names.collect::<Vec<_>>().join(" | ")
}

/// A table of the Cortex-M4F's cycles and the instructions of each core.
fn cores_table(out: &mut String, cores: &[&Measured], rows: impl IntoIterator<Item = String>) {
    table(out, &format!("| M4F cycles | {}", names(cores)), 1, rows);
}

/// One of its rows: of calls, in the mean.
fn calls_row(cores: &[&Measured], what: &str, series: Series) -> String {
    let cycles = cores[0].cycles(series).map_or(f64::NAN, |cycles| cycles.mean);
    let counts = cores.iter().map(|core| Some(grouped(core.instructions(series)?.mean)));
    format!("{what} | **{}** | {}", grouped(cycles), figures(counts))
}

/// One of bytes.
fn bytes_row(cores: &[&Measured], what: &str, of: impl Fn(&Measured) -> Option<u32>) -> String {
    let bytes = cores.iter().map(|core| Some(grouped(of(core)?.into())));
    format!("{what} | | {}", figures(bytes))
}

/// The first screen: what an answer, a tick, a schedule and a curve cost, on each core.
fn on_each_core(out: &mut String, cores: &[&Measured]) {
    let curve = cores[0].trace.curve_bytes[&DEFAULT];
    say(
        out,
        &format!(
            "Mean instructions, and on the Cortex-M4F modelled cycles, too; *soft* has a third of its mass in ramps, *all ramp* \
             all of it. With `CELLS = 8`, a curve of {curve} bytes in flash, unless it says otherwise."
        ),
    );
    let schedule = format!("a checked schedule of {TRIGGERS} triggers");
    let calls = [
        ("`inverse_cdf`", InverseCdf, DEFAULT),
        ("a tick of `trigger_ticks`", TickStep, DEFAULT),
        (&schedule, Schedule, DEFAULT),
        ("`inverse_cdf`, `CELLS = 0`", InverseCdf, 0),
        ("textbook Newton in `f32`", Newton, DEFAULT),
    ];
    let mut rows = Vec::new();
    for (what, function, cells) in calls {
        for (row, (name, _)) in ROWS.iter().enumerate().take(2) {
            let series = on_row(function, row, cells);
            rows.push(calls_row(cores, &format!("{what}, {name}"), series));
        }
    }
    rows.push(calls_row(cores, "a curve built at run time, soft", on_row(Construct, 0, DEFAULT)));
    let calls = [
        ("`inverse_cdf`", InverseCdf),
        ("a tick", TickStep),
        ("a schedule", Schedule),
        ("building", Construct),
    ];
    for (what, function) in calls {
        let what = format!("bytes of code: {what}");
        rows.push(bytes_row(cores, &what, |core| core.code_bytes(function, DEFAULT)));
    }
    for (what, function) in calls {
        let what = format!("bytes of stack: {what}");
        rows.push(bytes_row(cores, &what, |core| core.stack_said(function, DEFAULT)));
    }
    cores_table(out, cores, rows);
}

/// The inverse beside its baselines, and the calls.
fn overview(out: &mut String, m4f: &Measured) {
    say(out, "`inverse_cdf` beside its baselines, in cycles over uniform `u`.");
    let methods = [(InverseCdf, 0), (InverseCdf, DEFAULT), (Newton, DEFAULT), (Table, DEFAULT)];
    let row = |what: &str, of: &dyn Fn(Function, usize) -> Option<String>| {
        format!("{what} | {}", figures(methods.map(|(function, cells)| of(function, cells))))
    };
    let on = |row| move |function, cells| mean(m4f.cycles(on_row(function, row, cells)));
    let error = |row| move |function, _| error(row, function).map(|error| format!("{error:.1e}"));
    let typical = m4f.typical(InverseCdf, DEFAULT).len();
    let rows = [
        row("cycles: mean on *soft*", &on(0)),
        row("mean on *all ramp*", &on(1)),
        row(&format!("mean over {typical} typical curves"), &|function, cells| {
            m4f.typical_mean(function, cells).map(rounded)
        }),
        row("worst call found, on any curve", &|function, cells| {
            m4f.worst(function, Inputs::Hard, cells).map(|(cycles, _)| cycles.to_string())
        }),
        row("bytes of a curve", &|function, cells| match function {
            Newton => Some(size_of::<TextbookNewton>().to_string()),
            Table => Some(size_of::<InverseTable<256>>().to_string()),
            _ => m4f.trace.curve_bytes.get(&cells).map(u32::to_string),
        }),
        row("bytes of code", &|function, cells| {
            m4f.code_bytes(function, cells).map(|bytes| bytes.to_string())
        }),
        row("largest error on *soft*, as a share of the interval", &error(0)),
        row("on *all ramp*", &error(1)),
    ];
    let header = "| `CELLS = 0` | `CELLS = 8` | textbook Newton in `f32` | linear table of 256";
    table(out, header, 1, rows);

    say(
        out,
        &format!(
            "The calls with `CELLS = 8`, in cycles. *Direct* is the worst call, on any curve, that is answered by a polynomial or \
             the plateau's line, as all of a frame of `direct_triggers()` are; a schedule is of {TRIGGERS} triggers, checked."
        ),
    );
    let calls = [
        ("`inverse_cdf`", InverseCdf),
        ("`cdf`", Cdf),
        ("`opening`", Opening),
        ("a tick", TickStep),
        ("a schedule", Schedule),
    ];
    let rows = calls.map(|(name, function)| {
        let on_rows = [0, 1, 2].map(|row| mean(m4f.cycles(on_row(function, row, DEFAULT))));
        let [worst, direct] = [
            m4f.worst_of_all(function).map(|(cycles, _)| cycles),
            m4f.worst_direct(function).map(|(cycles, _)| cycles),
        ];
        let typical = m4f.typical_mean(function, DEFAULT).map(rounded);
        let code = m4f.code_bytes(function, DEFAULT);
        let counts = [worst, direct, code, m4f.stack_painted(function, DEFAULT)];
        format!("{name} | {} | {} | {}", figures(on_rows), figures([typical]), figures(counts))
    });
    let header =
        "call | soft | all ramp | box | typical | worst | direct | code, bytes | stack, bytes";
    table(out, header, 1, rows);
}

/// The largest error of a baseline over 65 537 equally spaced `u`, as a share of the interval.
fn error(row: usize, function: Function) -> Option<f64> {
    let curve = &CURVES[ROWS[row].1];
    let (opening, closing) = curve.ramps(None);
    let exact = ShutterCurve::new(opening, closing).ok()?;
    let newton = TextbookNewton::new(curve.opening, curve.closing);
    let table = InverseTable::<256>::new(|u| exact.inverse_cdf(u));
    let length = f64::from(exact.close_end()) - f64::from(exact.open_start());
    let mut errors = (0..=1 << 16).map(|i| i as f32 / (1 << 16) as f32).map(|u| {
        let t = match function {
            Newton => newton.inverse_cdf(u),
            Table => table.inverse_cdf(u),
            _ => return None,
        };
        Some((f64::from(t) - f64::from(exact.inverse_cdf(u))).abs() / length)
    });
    errors.try_fold(0.0, |most: f64, error| Some(most.max(error?)))
}

/// Every call on each core.
fn calls(out: &mut String, cores: &[&Measured]) {
    say(
        out,
        "## Every call\n\n`cdf` and `opening` have no use for the octaves, and cost the same for all CELLS.",
    );
    let calls: [(&str, Function, &[usize]); 7] = [
        ("`inverse_cdf`", InverseCdf, &CELLS),
        ("`cdf`", Cdf, &[DEFAULT]),
        ("`opening`", Opening, &[DEFAULT]),
        ("tick", TickStep, &CELLS),
        ("schedule", Schedule, &CELLS),
        ("textbook Newton", Newton, &[DEFAULT]),
        ("table", Table, &[DEFAULT]),
    ];
    let mut rows = Vec::new();
    for (name, function, all) in calls {
        for (row, (curve, _)) in ROWS.iter().enumerate() {
            for cells in all {
                let series = on_row(function, row, *cells);
                let [m4f, others @ ..] = cores else { continue };
                let Some(s) = m4f.cycles(series) else { continue };
                let cells = if all.len() > 1 { cells.to_string() } else { String::new() };
                let cycles = format!(
                    "{} | {} | **{:.0}** | {} | {}",
                    s.min, s.median, s.mean, s.most, s.max
                );
                let others = figures(others.iter().map(|core| mean(core.instructions(series))));
                let counted = figures([mean(m4f.instructions(series))]);
                rows.push(format!("{name} | {curve} | {cells} | {counted} | {cycles} | {others}"));
            }
        }
    }
    let header = format!(
        "call | curve | CELLS | M4F instructions, mean | cycles: min | median | mean | 99 % | max | {}",
        names(&cores[1..])
    );
    table(out, &header, 3, rows);
}

fn worst_cases(out: &mut String, m4f: &Measured) {
    say(
        out,
        &format!(
            "## The worst cases\n\n\
             Cycles, over the hard curves and inputs. Of triggers, the steps of a frame of {TRIGGERS} and the first of a frame \
             whose first share ends near a hard input, and the frame as a whole; the curves on a scale of time that makes the \
             interval one to two million ticks, and *solved*: 64 times that, where no polynomial serves. A frame that is refused \
             for its gap costs no more than one that is not."
        ),
    );
    let calls = [
        ("`inverse_cdf`", InverseCdf, Inputs::Hard),
        ("`cdf`", Cdf, Inputs::Hard),
        ("`opening`", Opening, Inputs::Hard),
        ("tick", TickStep, Inputs::Hard),
        ("tick, solved", TickStep, Inputs::Solved),
        ("schedule", Schedule, Inputs::Hard),
        ("schedule, solved", Schedule, Inputs::Solved),
        ("textbook Newton", Newton, Inputs::Hard),
        ("table", Table, Inputs::Hard),
    ];
    let rows = calls.map(|(name, function, inputs)| {
        let worst = CELLS.map(|cells| m4f.worst(function, inputs, cells));
        let words = worst.map(|worst| worst.map(|(cycles, curve)| format!("{cycles} ({curve})")));
        format!("{name} | {}", figures(words))
    });
    table(out, "call | CELLS = 0 | 4 | 8 | 16", 1, rows);
    for (what, function) in [("an `inverse_cdf`", InverseCdf), ("a tick", TickStep)] {
        let Some((cycles, place)) = m4f.worst_direct(function) else { continue };
        say(
            out,
            &format!(
                "The most cycles of {what} that is answered by a polynomial or the plateau's line, on all curves, with uniform \
                 and hard inputs: {cycles} ({place})."
            ),
        );
    }
}

fn typical(out: &mut String, m4f: &Measured) {
    say(
        out,
        "## On every typical curve\n\n\
         Mean cycles of `inverse_cdf` over uniform `u`, and with `CELLS = 8` the share of the `u` that are searched \
         for; the same of the ticks of a frame of 512.",
    );
    let inverse = CELLS.map(|cells| m4f.typical(InverseCdf, cells));
    let rows = m4f.typical(TickStep, DEFAULT).into_iter().enumerate().map(|(i, tick)| {
        let [none, four, eight, sixteen] = inverse.each_ref().map(|curves| curves[i].mean);
        format!(
            "{} | {none:.0} | {four:.0} | **{eight:.0}** | {:.1} % | {sixteen:.0} | {:.0} | {:.1} %",
            tick.name,
            100.0 * inverse[2][i].searched,
            tick.mean,
            100.0 * tick.searched,
        )
    });
    table(out, "curve | CELLS = 0 | 4 | 8 | searched | 16 | tick, CELLS = 8 | searched", 1, rows);
}

fn bytes(out: &mut String, m4f: &Measured) {
    say(
        out,
        &format!(
            "## Flash and stack, bytes on a Cortex-M4F\n\n\
             Code is a call's own and all that it reaches, so calls share some. Stack is the high-water mark of a \
             painted stack over all calls that were measured, and in brackets the deepest path by the compiler's figures. The \
             library has no statics: `.data` and `.bss` hold {} bytes.",
            m4f.code.statics
        ),
    );
    let calls = [InverseCdf, Cdf, Opening, TickStep, Schedule, Construct];
    let rows = CELLS.map(|cells| {
        let code = calls.map(|function| m4f.code_bytes(function, cells));
        let stack = calls.map(|function| {
            let painted = m4f.stack_painted(function, cells)?;
            Some(format!("{painted} ({})", m4f.stack_said(function, cells)?))
        });
        let curve = m4f.trace.curve_bytes[&cells];
        format!("{cells} | {curve} | {} | {}", figures(code), figures(stack))
    });
    let header = "CELLS | one curve | code: `inverse_cdf` | `cdf` | `opening` | tick | schedule | building \
                  | stack: `inverse_cdf` | `cdf` | `opening` | tick | schedule | building";
    table(out, header, 1, rows);
}

fn construction(out: &mut String, cores: &[&Measured], for_size: u32) {
    say(
        out,
        &format!(
            "## Building a curve at run time\n\n\
             A `const` curve costs nothing: the compiler builds it. Built on the microcontroller, *soft* takes so many instructions, \
             most of them in doubles, which all of these compute in software. Where that is too much, make the curve a `const`; if it \
             is not known beforehand, build it with `CELLS = 0`, which fits no polynomials, and each answer is a search. Optimised for \
             size (`opt-level = \"z\"`), building takes {} bytes of code on a Cortex-M4F.",
            grouped(for_size.into())
        ),
    );
    let of_cells =
        |cells| calls_row(cores, &format!("`CELLS = {cells}`"), on_row(Construct, 0, cells));
    let code = CELLS.map(|cells| {
        let what = format!("bytes of code, `CELLS = {cells}`");
        bytes_row(cores, &what, |core| core.code_bytes(Construct, cells))
    });
    let stack = CELLS.map(|cells| {
        let what = format!("bytes of stack, `CELLS = {cells}`");
        bytes_row(cores, &what, |core| core.stack_said(Construct, cells))
    });
    cores_table(out, cores, [CELLS.map(of_cells), code, stack].concat());
}

/// The code that builds a curve on a Cortex-M4F, with the most cells, optimised for size.
fn building_for_size() -> Result<u32> {
    let code = Disassembly::of(M4F, &build(M4F, "cost", Some("z"))?)?;
    let instances = code.named(Function::ALL[Construct as usize].1).into_iter();
    Ok(instances.map(|instance| code.code_bytes(instance)).max().ok_or("no code")?)
}

/// What a search may start from.
fn roots(out: &mut String, m4f: &Measured) {
    say(
        out,
        "## A k-th root as a first guess\n\n\
         A search starts from the k-th root of a quotient, the division included. The search that follows takes as many evaluations \
         from either of these, so the crate has its own, the smallest one. Relative errors over a million quotients, even on a \
         logarithmic scale.",
    );
    let rows = ROOTS.iter().enumerate().map(|(i, root)| {
        let series = Series { function: Root, cells: DEFAULT, inputs: Inputs::Uniform, curve: i };
        let errors = (0..1 << 20).map(|i| dividend(i as f32 / (1 << 20) as f32)).map(|x| {
            let exact = (f64::from(x) / f64::from(DIVISOR)).powf(1.0 / f64::from(root.k));
            (f64::from((root.of)(x, DIVISOR)) / exact - 1.0).abs()
        });
        let (most, sum) = errors.fold((0.0f64, 0.0), |(most, sum), e| (most.max(e), sum + e));
        let cycles = m4f.cycles(series).map(|s| format!("{:.0} | {}", s.mean, s.max));
        let code = m4f.trace.instances.get(&series).map(|start| m4f.code.code_bytes(*start));
        let (errors, bytes) =
            (format!("{most:.1e} | {:.1e}", sum / f64::from(1 << 20)), figures([code]));
        format!("{} | {} | {errors} | {} | {bytes}", root.k, root.way, figures([cycles]))
    });
    let header = "k | by | greatest error | mean error | cycles: mean | max | code, bytes";
    table(out, header, 2, rows);
}
