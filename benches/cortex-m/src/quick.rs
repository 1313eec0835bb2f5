//! The tuner's loop: one function with one number of cells, or the inverse both ways, in seconds.

use measured::{CELLS, CURVES, DEFAULT, Function, Inputs, ON_HARD, ON_TYPICAL, ROWS};

use crate::Result;
use crate::firmware::{M4F, OPT_LEVEL};
use crate::measure::{Measured, on_row};
use crate::model::KINDS;
use crate::trace::selection;

/// What is asked for most: the inverse of a curve in a `static`, and by a reference.
pub fn both() -> Result {
    measure(DEFAULT, &[Function::Static, Function::InverseCdf])
}

pub fn run(cells: &str, function: &str) -> Result {
    let called = Function::ALL.into_iter().find(|known| format!("{known:?}") == function);
    let called = called.ok_or_else(|| format!("{function}: one of {:?}", Function::ALL))?;
    let cells = CELLS.into_iter().find(|c| c.to_string() == cells);
    measure(cells.ok_or_else(|| format!("CELLS is one of {CELLS:?}"))?, &[called])
}

fn measure(cells: usize, functions: &[Function]) -> Result {
    let selection = selection(&[cells], functions, ON_TYPICAL | ON_HARD);
    let measured = Measured::new(M4F, OPT_LEVEL, &[selection])?;
    for called in functions {
        println!("{called:?}");
        print(&measured, *called, cells);
    }
    Ok(())
}

fn print(measured: &Measured, called: Function, cells: usize) {
    for (row, name) in ROWS.iter().enumerate() {
        let series = on_row(called, row, cells);
        let Some(cycles) = measured.cycles(series) else { continue };
        println!("{name}: mean {:.1}, median {}, max {}", cycles.mean, cycles.median, cycles.max);
        let usual = measured.trace.calls[&series].iter().find(|call| call.cycles == cycles.median);
        let by_kind = usual.into_iter().flat_map(|call| KINDS.iter().zip(call.by_kind));
        let by_kind = by_kind.map(|(kind, cycles)| format!("{kind} {cycles}"));
        println!("    a call of the median: {}", by_kind.collect::<Vec<_>>().join(", "));
    }
    let mean = measured.typical_mean(called, cells).unwrap_or(f64::NAN);
    println!("typical: mean {mean:.1}; worst direct: {:?}", measured.worst_direct(called, cells));
    for inputs in [Inputs::Hard, Inputs::Solved] {
        let hard = measured.trace.calls.iter();
        let hard = hard.filter(|(series, _)| (series.function, series.inputs) == (called, inputs));
        let most = hard.map(|(series, calls)| {
            (calls.iter().map(|call| call.cycles).max().unwrap_or(0), CURVES[series.curve].name)
        });
        let mut worst: Vec<_> = most.collect();
        worst.sort_unstable_by(|a, b| b.cmp(a));
        worst.truncate(3);
        println!("worst, {inputs:?}: {worst:?}");
    }
    let bytes = [measured.code_bytes(called, cells), measured.stack_said(called, cells)];
    println!("bytes of code and of stack: {bytes:?}");
}
