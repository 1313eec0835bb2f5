//! The curves of `tests/data/curves.csv` with the inputs of `tests/data/inverse_cdf.csv`, and those of
//! `tests/support/cases/found.rs`, as Rust, each with its hard inputs; and the folder of the board's `memory.x`: the crate's,
//! or this one for the board with a Cortex-M33.

use std::collections::HashSet;
use std::{array, cmp::Reverse, env, fmt::Write, fs, path::PathBuf};

use shutter_curve::{CubicBezier, ShutterCurve};

#[path = "../../../tests/support/cases/found.rs"]
mod found;

type Ramp = [(f32, f32); 4];

fn main() {
    let here = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap());
    let root = here.join("../../..");
    let target = env::var("TARGET").unwrap();
    if target != env::var("HOST").unwrap() {
        println!("cargo:rustc-cfg=bare");
    }
    let map = if target.starts_with("thumbv8m") { here } else { root.clone() };
    println!("cargo:rustc-link-search={}", map.display());
    println!("cargo:rerun-if-changed={}", map.join("memory.x").display());
    println!("cargo:rerun-if-changed={}", root.join("tests/support/cases/found.rs").display());
    let read = |name: &str| -> Vec<Vec<String>> {
        let path = root.join("tests/data").join(name);
        println!("cargo:rerun-if-changed={}", path.display());
        let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
    };

    // Eight lines a curve, four a ramp: its name, its kind, the ramp, the point's number, t and f.
    let (points, inputs) = (read("curves.csv"), read("inverse_cdf.csv"));
    let mut out = String::from("pub const CURVES: &[Curve] = &[\n");
    let mut write_curve = |name: &str, is_typical: bool, ramps: [Ramp; 2], given: Vec<f32>| {
        let ([opening, closing], hard) = (ramps, hard(ramps, given));
        writeln!(
            out,
            "Curve {{ name: {name:?}, is_typical: {is_typical}, opening: {opening:?}, closing: {closing:?}, hard: &{hard:?} }},"
        )
        .unwrap();
    };
    for rows in points.chunks(8) {
        let name = &rows[0][0];
        let point = |i: usize| (rows[i][4].parse().unwrap(), rows[i][5].parse().unwrap());
        let ramps = [array::from_fn(point), array::from_fn(|i| point(4 + i))];
        let given = inputs.iter().filter(|row| row[0] == *name);
        let given = given.map(|row| row[1].parse().unwrap()).collect();
        write_curve(name, rows[0][1] == "typical", ramps, given);
    }
    for (name, opening, closing) in found::FOUND {
        write_curve(name, false, [*opening, *closing], Vec::new());
    }
    out.push_str("];\n");
    let path = PathBuf::from(env::var("OUT_DIR").unwrap()).join("curves.rs");
    fs::write(path, out).unwrap();
}

/// The inputs that are given and those that a search finds hardest, the ends of the sections with six neighbours on either
/// side, every power of two from either end, and fractions that are uniform on a logarithmic scale.
fn hard(ramps: [Ramp; 2], given: Vec<f32>) -> Vec<f32> {
    let searches = [hardest::<0>, hardest::<4>, hardest::<8>, hardest::<16>];
    let mut hard = [given, searches.iter().flat_map(|hardest| hardest(ramps)).collect()].concat();
    hard.sort_by(f32::total_cmp);
    hard.dedup();
    let curve = built::<8>(ramps);
    for end in [curve.cdf(curve.open_end()), curve.cdf(curve.close_start())] {
        let near = |i: u32| f32::from_bits((end.to_bits() + i).saturating_sub(6)).min(1.0);
        hard.extend((0..=12).map(near));
    }
    let powers = (0..150).map(|k| if k < 23 { 1 << (22 - k) } else { (150 - k) << 23 });
    hard.extend(powers.map(f32::from_bits));
    hard.extend((1..25).map(|k| 1.0 - 1.0 / (1 << k) as f32));
    hard.extend((0..128).map(|i| logarithmic(12, golden(i))).flat_map(|u| [u, 1.0 - u]));
    hard
}

fn built<const CELLS: usize>(ramps: [Ramp; 2]) -> ShutterCurve<CELLS> {
    let [opening, closing] = ramps.map(CubicBezier::new);
    ShutterCurve::with_cells(opening, closing).expect("a good curve")
}

/// The `u` for which the mass is evaluated most often: the first few of 20 000, and of those around them, ever
/// nearer.
fn hardest<const CELLS: usize>(ramps: [Ramp; 2]) -> Vec<f32> {
    const KEPT: usize = 16;
    let curve = built::<CELLS>(ramps);
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
/// from either end.
fn spread(i: u32) -> f32 {
    let x = golden(i);
    match i % 4 {
        0 => x as f32,
        1 => logarithmic(127, x),
        2 => logarithmic(24, x),
        _ => 1.0 - logarithmic(24, x),
    }
}

/// The `i`-th multiple of the golden ratio, in [0, 1).
fn golden(i: u32) -> f64 {
    f64::from(i.wrapping_mul(0x9E37_79B9)) / 4294967296.0
}

/// Uniform in the bits between 2⁻ᵒ, `o` being the octaves, and 1; with 127 octaves down to 0.
fn logarithmic(octaves: u32, x: f64) -> f32 {
    let from = f64::from((127 - octaves) << 23);
    f32::from_bits((from + (f64::from(1f32.to_bits()) - from) * x) as u32)
}
