//! The curves of `tests/data/curves.csv` with the inputs of `tests/data/inverse_cdf.csv`, and those of
//! `tests/support/cases/found.rs`, as Rust, each with the inputs that a search finds hardest; and the folder of the
//! board's `memory.x`: the crate's, or this one for the board with a Cortex-M33.

use std::collections::HashSet;
use std::{array, cmp::Reverse, env, fmt::Write, fs, path::PathBuf};

use shutter_curve::{CubicBezier, ShutterCurve};

#[path = "../../../tests/support/cases/found.rs"]
mod found;

type Ramp = [(f32, f32); 4];

fn main() {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap()).join("../../..");
    let target = env::var("TARGET").unwrap();
    if target != env::var("HOST").unwrap() {
        println!("cargo:rustc-cfg=bare");
    }
    let is_m33 = target.starts_with("thumbv8m");
    if is_m33 {
        println!("cargo:rustc-cfg=m33");
    }
    let map = if is_m33 { root.join("benches/cortex-m/firmware") } else { root.clone() };
    println!("cargo:rustc-link-search={}", map.display());
    let watched = |name: &str| {
        let path = root.join(name);
        println!("cargo:rerun-if-changed={}", path.display());
        path
    };
    let read = |name: &str| {
        let path = watched(name);
        fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    };
    watched("memory.x");
    watched("benches/cortex-m/firmware/memory.x");
    watched("tests/support/cases/found.rs");

    // Eight lines a curve, four a ramp: its name, its kind, the ramp, the point's number, t and f.
    let points = read("tests/data/curves.csv");
    let inputs = read("tests/data/inverse_cdf.csv");
    let points: Vec<Vec<&str>> =
        points.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let inputs: Vec<Vec<&str>> = inputs.lines().map(|line| line.split(',').collect()).collect();
    let mut out = String::from("pub const CURVES: &[Curve] = &[\n");
    for rows in points.chunks(8) {
        let name = rows[0][0];
        let point = |i: usize| (rows[i][4].parse().unwrap(), rows[i][5].parse().unwrap());
        let (opening, closing) = (array::from_fn(point), array::from_fn(|i| point(4 + i)));
        let inputs = inputs.iter().filter(|row| row[0] == name);
        let inputs = inputs.map(|row| row[1].parse().unwrap()).collect();
        let is_typical = rows[0][1] == "typical";
        write_curve(&mut out, name, is_typical, [opening, closing], inputs);
    }
    for (name, opening, closing) in found::FOUND {
        write_curve(&mut out, name, false, [*opening, *closing], Vec::new());
    }
    out.push_str("];\n");
    let path = PathBuf::from(env::var("OUT_DIR").unwrap()).join("curves.rs");
    fs::write(path, out).unwrap();
}

fn write_curve(
    out: &mut String,
    name: &str,
    is_typical: bool,
    [opening, closing]: [Ramp; 2],
    mut hard: Vec<f32>,
) {
    let searches = [hardest::<0>, hardest::<4>, hardest::<8>, hardest::<16>];
    hard.extend(searches.iter().flat_map(|hardest| hardest(opening, closing)));
    hard.sort_by(f32::total_cmp);
    hard.dedup();
    let ramps = format!("opening: {opening:?}, closing: {closing:?}");
    let ends = ends(opening, closing);
    writeln!(
        out,
        "Curve {{ name: {name:?}, is_typical: {is_typical}, {ramps}, ends: {ends:?}, hard: &{hard:?} }},"
    )
    .unwrap();
}

/// The fractions at which the curve's sections meet.
fn ends(opening: Ramp, closing: Ramp) -> [f32; 2] {
    let [opening, closing] = [opening, closing].map(CubicBezier::new);
    let curve = ShutterCurve::new(opening, closing).expect("a good curve");
    [curve.cdf(curve.open_end()), curve.cdf(curve.close_start())]
}

/// The `u` for which the mass is evaluated most often: the first few of 20 000, and of those around them, ever
/// nearer.
fn hardest<const CELLS: usize>(opening: Ramp, closing: Ramp) -> Vec<f32> {
    const KEPT: usize = 16;
    let [opening, closing] = [opening, closing].map(CubicBezier::new);
    let curve = ShutterCurve::<CELLS>::with_cells(opening, closing).expect("a good curve");
    let first = |mut us: Vec<f32>| {
        let mut seen = HashSet::new();
        us.retain(|u| seen.insert(u.to_bits()));
        us.sort_by_cached_key(|u| Reverse(curve.evaluations(*u)));
        us.truncate(KEPT);
        us
    };
    let spread = first((0..20_000).map(spread).collect());
    let mut near = spread.clone();
    for bits in [16, 13, 10, 7, 4] {
        let around = |u: f32| {
            (0..400u32).map(move |i| {
                // Within 2^bits neighbours to either side.
                let steps = i.wrapping_mul(0x9E37_79B9).cast_signed() >> (31 - bits);
                f32::from_bits(u.to_bits().saturating_add_signed(steps))
            })
        };
        let more: Vec<f32> = near.iter().copied().flat_map(around).filter(|u| *u <= 1.0).collect();
        near = first([near, more].concat());
    }
    [spread, near].concat()
}

/// The `i`-th of inputs that are in turn uniform, uniform in their bits down to 0, and logarithmic down to 2⁻²⁴
/// from either end; by multiples of the golden ratio.
fn spread(i: u32) -> f32 {
    let x = f64::from(i.wrapping_mul(0x9E37_79B9)) / 4294967296.0;
    let bits =
        |from: u32| f32::from_bits((f64::from(from) + f64::from(1f32.to_bits() - from) * x) as u32);
    let least = (1.0 / (1 << 24) as f32).to_bits();
    match i % 4 {
        0 => x as f32,
        1 => bits(0),
        2 => bits(least),
        _ => 1.0 - bits(least),
    }
}
