//! Takes the figures that the page shows out of docs/internals/cost.md, so that they are written in one place.

use std::path::Path;
use std::{env, fs};

const COST: &str = "../docs/internals/cost.md";

fn main() {
    println!("cargo::rerun-if-changed={COST}");
    let cost = fs::read_to_string(COST).expect("docs/internals/cost.md is there");
    let (_, calls) = cost
        .split_once("The calls with `OCTAVES = 8`")
        .expect("docs/internals/cost.md: the table of calls");
    let call = |name: &str| row(calls, name, 6);
    // Of a call: typical, worst, code.
    let rows = [
        ("a trigger's tick", call("a tick")),
        ("a checked schedule of 64", call("a schedule")),
        ("an `inverse_cdf`", call("`inverse_cdf`")),
    ];
    let rows = rows.map(|(name, cells)| {
        format!(
            "Cost {{ call: {name:?}, typical: {}, worst: {}, code: {} }}",
            cells[4], cells[5], cells[7]
        )
    });
    // Of the bytes: OCTAVES = 0, then 8.
    let bytes = row(&cost, "bytes of a curve", 2)[1];
    let code = format!(
        "pub const COSTS: [Cost; 3] = [{}];\npub const BYTES: u32 = {bytes};\n",
        rows.join(", ")
    );
    let out = env::var_os("OUT_DIR").expect("cargo sets it");
    fs::write(Path::new(&out).join("cost.rs"), code).expect("the folder can be written");
}

/// The numbers of a table's row.
fn row(table: &str, name: &str, at_least: usize) -> Vec<u32> {
    let start = format!("| {name} |");
    let line = table
        .lines()
        .find_map(|line| line.strip_prefix(&start))
        .expect("docs/internals/cost.md: a row");
    let cells: Vec<u32> =
        line.split('|').map(|cell| cell.trim().parse().unwrap_or_default()).collect();
    let good = cells.len() > at_least && cells[..at_least].iter().all(|cell| *cell > 0);
    assert!(good, "docs/internals/cost.md: the row of {name} is not as it was");
    cells
}
