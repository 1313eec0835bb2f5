//! The tuner's loop: one function with one seed and one number of cells, in seconds.

use std::cmp::Reverse;

use ::firmware::{
    CELLS, CURVES, Curve, Function, Inputs, ON_HARD, ON_ROWS, ON_TYPICAL, ROWS, series,
};

use crate::disassembly::Disassembly;
use crate::firmware::{Flavour, M4F, SEEDS, build};
use crate::trace::{Call, Key, Selection, trace};

pub fn run(seed: &str, cells: &str, function: &str) -> Result<(), String> {
    let name = |f: Function| f.symbol().trim_start_matches("measured_");
    // The baselines have rows and hard inputs of their own, and building has but one row.
    let has = |f: Function, row| series().any(|(s, i)| (s, i) == (f, Inputs::Row(row)));
    let functions: Vec<Function> =
        Function::ALL.into_iter().filter(|f| has(*f, 1) || *f == Function::Construct).collect();
    let names: Vec<&str> = functions.iter().map(|f| name(*f)).collect();
    let called = functions.iter().copied().find(|f| name(*f) == function);
    let called = called.ok_or_else(|| format!("{function}: one of {}", names.join(", ")))?;
    let seed = if seed == "none" { "" } else { seed };
    let seed = SEEDS.into_iter().find(|known| *known == seed);
    let seed = seed.ok_or_else(|| format!("the seed is one of none, {}", SEEDS[1..].join(", ")))?;
    let cells = CELLS.into_iter().find(|c| c.to_string() == cells);
    let cells = cells.ok_or_else(|| format!("CELLS is one of {CELLS:?}"))?;
    let elf = build(M4F, "cost", Flavour::fast(seed))?;
    let code = Disassembly::of(M4F, &elf)?;
    let mut selection = Selection { cells: vec![cells], functions: vec![called], inputs: ON_ROWS };
    for (row, (name, data)) in ROWS.iter().enumerate().filter(|(row, _)| has(called, *row)) {
        let inputs = Inputs::Row(row);
        let key = Key { function: called, cells, inputs, curve: Curve::index(data) };
        // The row has the listing; all that is not of a row is run but once.
        selection.inputs = if row == 0 { ON_ROWS | ON_TYPICAL | ON_HARD } else { ON_ROWS };
        let trace = trace(M4F, &elf, &code, &selection, Some(key))?;
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
            for inputs in [Inputs::Hard, Inputs::Solved] {
                let hard = trace.calls.iter().filter(|(key, _)| key.inputs == inputs);
                let most = |calls: &[Call]| calls.iter().map(|c| c.cycles).max().unwrap_or(0);
                let mut worst: Vec<(u32, &str)> =
                    hard.map(|(key, calls)| (most(calls), CURVES[key.curve].name)).collect();
                worst.sort_unstable_by_key(|curve| Reverse(*curve));
                println!("worst, {inputs:?}: {worst:?}");
            }
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
