//! The tuner's loop: one function with one seed and one number of cells, in seconds.

use ::firmware::{CURVES, Curve, Function, Inputs, ROWS};

use crate::disassembly::Disassembly;
use crate::firmware::{M4F, build};
use crate::trace::{Key, Selection, trace};

pub fn run(seed: &str, cells: &str, function: &str) -> Result<(), String> {
    let called = Function::ALL
        .into_iter()
        .find(|f| f.symbol().strip_prefix("measured_") == Some(function))
        .ok_or_else(|| format!("{function}: no such function"))?;
    let seed = if seed == "none" { "" } else { seed };
    let cells: usize = cells.parse().map_err(|_| format!("{cells}: not a number of cells"))?;
    let elf = build(M4F, "cost", seed)?;
    let code = Disassembly::of(&elf)?;
    let mut selection = Selection { cells: vec![cells], functions: vec![called], hard: false };
    for (row, (name, data)) in ROWS.iter().enumerate() {
        let inputs = Inputs::Row(row);
        let key = Key { function: called, cells, inputs, curve: Curve::index(data) };
        if row == 0 {
            selection.hard = called == Function::InverseCdf;
        }
        let trace = trace(M4F, &elf, &code, &selection, Some(key))?;
        selection.hard = false;
        let calls = &trace.calls[&key];
        let mut cycles: Vec<u32> = calls.iter().map(|call| call.cycles).collect();
        cycles.sort_unstable();
        let mean = f64::from(cycles.iter().sum::<u32>()) / cycles.len() as f64;
        println!(
            "{name}: mean {mean:.1}, median {}, max {}",
            cycles[cycles.len() / 2],
            cycles[cycles.len() - 1]
        );
        let instance = trace.instance[&(called, cells)];
        let listing = elf.with_file_name(format!("{function}-{}.s", name.replace(' ', "-")));
        std::fs::write(&listing, code.annotated(instance, &trace.profile, calls.len() as u32))
            .unwrap();
        println!("  listing: {}", listing.display());
        if row == 0 {
            let hard = trace.calls.iter().filter(|(key, _)| key.inputs == Inputs::Hard);
            let mut worst: Vec<(u32, &str)> = hard
                .map(|(key, calls)| {
                    (calls.iter().map(|c| c.cycles).max().unwrap_or(0), CURVES[key.curve].name)
                })
                .collect();
            worst.sort_unstable();
            println!(
                "worst over hard curves and inputs: {:?}",
                worst.iter().rev().take(80).collect::<Vec<_>>()
            );
            println!(
                "code {} B, stack {} B:",
                code.code_bytes(instance),
                code.stack_bytes(instance)
            );
            for start in code.reach(instance) {
                let f = &code.functions[&start];
                println!("  {:5} B  {:#}", f.size, rustc_demangle::demangle(&f.symbol));
            }
        }
    }
    Ok(())
}
