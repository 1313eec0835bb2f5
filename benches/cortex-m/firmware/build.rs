//! The curves of `tests/data/curves.csv` and the inputs of `tests/data/inverse_cdf.csv` as Rust; and the
//! folder of the board's `memory.x`, which is the crate's.

use std::{env, fmt::Write, fs, path::PathBuf};

fn main() {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap()).join("../../..");
    println!("cargo:rustc-link-search={}", root.display());
    let read = |name: &str| {
        let path = root.join("tests/data").join(name);
        println!("cargo:rerun-if-changed={}", path.display());
        fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    };

    // Eight lines a curve: its name, its kind, the ramp, the point's number, t and f.
    let points = read("curves.csv");
    let inputs = read("inverse_cdf.csv");
    let points: Vec<Vec<&str>> =
        points.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let mut out = String::from("pub const CURVES: &[Curve] = &[\n");
    for rows in points.chunks(8) {
        let name = rows[0][0];
        let ramp = |ramp: &str| -> String {
            let rows = rows.iter().filter(|row| row[2] == ramp && row[0] == name);
            rows.map(|row| format!("({}f32, {}f32), ", row[4], row[5])).collect()
        };
        let u: String = inputs
            .lines()
            .map(|line| line.split(',').collect::<Vec<_>>())
            .filter(|row| row[0] == name)
            .map(|row| format!("{}f32, ", row[1]))
            .collect();
        let (opening, closing) = (ramp("opening"), ramp("closing"));
        writeln!(
            out,
            "Curve {{ name: {name:?}, opening: [{opening}], closing: [{closing}], hard: &[{u}] }},"
        )
        .unwrap();
    }
    out.push_str("];\n");
    let path = PathBuf::from(env::var("OUT_DIR").unwrap()).join("curves.rs");
    fs::write(path, out).unwrap();
}
