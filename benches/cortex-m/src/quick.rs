//! The tuner's loop: one function with one number of cells, in seconds.

use measured::{CELLS, CURVES, Function, Inputs, ON_HARD, ON_TYPICAL, ROWS};

use crate::Result;
use crate::firmware::M4F;
use crate::measure::{Measured, on_row};
use crate::trace::{Program, Trace, selection};

pub fn run(cells: &str, function: &str) -> Result {
    let names = Function::ALL.map(|(_, symbol)| symbol.trim_start_matches("measured_"));
    let called = Function::ALL.into_iter().zip(names).find(|(_, name)| *name == function);
    let ((called, _), _) = called.ok_or_else(|| format!("{function}: one of {names:?}"))?;
    let cells = CELLS.into_iter().find(|c| c.to_string() == cells);
    let cells = cells.ok_or_else(|| format!("CELLS is one of {CELLS:?}"))?;
    let (program, mut trace) = (Program::new(M4F)?, Trace::default());
    let selected = selection(&[cells], &[called], ON_TYPICAL | ON_HARD);
    // The first row has the listing.
    let listed = on_row(called, 0, cells);
    program.trace(&mut trace, selected, Some(listed))?;
    let start = *trace.instances.get(&listed).ok_or("not called with these cells")?;
    let count = trace.calls[&listed].len() as u32;
    let path = program.elf.with_file_name(format!("{function}.s"));
    std::fs::write(&path, program.code.annotated(start, &trace.profile, count))?;
    let measured = Measured { name: M4F.name, code: program.code, trace };
    for (row, (name, _)) in ROWS.iter().enumerate() {
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
    let (code, stack) = (measured.code.code_bytes(start), measured.code.stack_bytes(start));
    println!("code {code} B, stack {stack} B; listing: {}", path.display());
    Ok(())
}
