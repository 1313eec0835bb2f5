//! The tuner's loop: one function with one number of cells, or the inverse both ways, in seconds.

use measured::{CELLS, DEFAULT, Function, Inputs, ROWS};

use crate::Result;
use crate::firmware::{M4F, OPT_LEVEL};
use crate::measure::{Measured, On, Ran, series};
use crate::model::KINDS;

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
    let measured = Measured::new(M4F, OPT_LEVEL, &series(functions, &[cells], On::All))?;
    for &called in functions {
        println!("{called:?}");
        for (row, name) in ROWS.iter().enumerate() {
            let Some(ran) = measured.on(called, row, cells) else { continue };
            let cycles = ran.cycles();
            println!(
                "{name}: mean {:.1}, median {}, max {}",
                cycles.mean, cycles.median, cycles.max
            );
            let usual = ran.calls.iter().find(|call| call.cycles == cycles.median);
            let by_kind = usual.into_iter().flat_map(|call| KINDS.iter().zip(call.by_kind));
            let by_kind = by_kind.map(|(kind, cycles)| format!("{kind} {cycles}"));
            println!("    a call of the median: {}", by_kind.collect::<Vec<_>>().join(", "));
        }
        let mean = measured.typical(called, cells, Ran::cycles).unwrap_or(f64::NAN);
        println!(
            "typical: mean {mean:.1}; worst direct: {:?}",
            measured.worst_direct(called, cells)
        );
        for inputs in [Inputs::Hard, Inputs::Solved] {
            let mut worst = measured.worst(called, inputs, cells);
            worst.truncate(3);
            println!("worst, {inputs:?}: {worst:?}");
        }
        let bytes = [measured.code_bytes(called, cells), measured.stack_said(called, cells)];
        println!("bytes of code and of stack: {bytes:?}");
    }
    Ok(())
}
