//! The tuner's loop: one function with one number of cells, in seconds.

use measured::{CELLS, CURVES, Function, Inputs, ON_HARD, ON_TYPICAL, ROWS};

use crate::Result;
use crate::firmware::{M4F, OPT_LEVEL};
use crate::measure::{Measured, on_row};
use crate::trace::selection;

pub fn run(cells: &str, function: &str) -> Result {
    let called = Function::ALL.into_iter().find(|known| format!("{known:?}") == function);
    let called = called.ok_or_else(|| format!("{function}: one of {:?}", Function::ALL))?;
    let cells = CELLS.into_iter().find(|c| c.to_string() == cells);
    let cells = cells.ok_or_else(|| format!("CELLS is one of {CELLS:?}"))?;
    let selection = selection(&[cells], &[called], ON_TYPICAL | ON_HARD);
    let measured = Measured::new(M4F, OPT_LEVEL, &[selection])?;
    for (row, name) in ROWS.iter().enumerate() {
        if let Some(cycles) = measured.cycles(on_row(called, row, cells)) {
            println!(
                "{name}: mean {:.1}, median {}, max {}",
                cycles.mean, cycles.median, cycles.max
            );
        }
    }
    for inputs in [Inputs::Hard, Inputs::Solved] {
        let hard = measured.trace.calls.iter().filter(|(series, _)| series.inputs == inputs);
        let most = hard.map(|(series, calls)| {
            (calls.iter().map(|call| call.cycles).max().unwrap_or(0), CURVES[series.curve].name)
        });
        let mut worst: Vec<_> = most.collect();
        worst.sort_unstable_by(|a, b| b.cmp(a));
        println!("worst, {inputs:?}: {worst:?}");
    }
    let bytes = [measured.code_bytes(called, cells), measured.stack_said(called, cells)];
    println!("bytes of code and of stack: {bytes:?}");
    Ok(())
}
