//! The curves of the tests' reference data and their hard cases, as Rust, each with its hard inputs.

use std::cmp::Reverse;
use std::{env, fmt::Write, fs, path::PathBuf};

use support::cases::{CASES, shutter};
use support::curves::{Kind, Rng, hard_us, named};
use support::oracle::{Curve, Exact};

#[path = "../../../../tests/support/mod.rs"]
mod support;

/// The curves with rows of their own in the report. They come first, then the other typical ones.
const ROWS: [&str; 4] = ["rman_soft", "raised_cosine", "trapezoid", "box"];

fn main() {
    let cases = CASES.iter().map(|case| (case.name, false, case.curve()));
    let data = named().into_iter().map(|c| (c.name, c.kind == Kind::Typical, c.curve));
    let mut curves: Vec<_> = data.chain(cases).collect();
    curves.sort_by_key(|(name, is_typical, _)| {
        (ROWS.iter().position(|row| row == name).unwrap_or(ROWS.len()), !is_typical)
    });
    let typical = curves.iter().filter(|(_, is_typical, _)| *is_typical).count();
    let mut out = format!("pub const TYPICAL: usize = {typical};\npub const CURVES: &[Curve] = &[\n");
    for (name, _, curve) in curves {
        let searches = [hardest::<0>, hardest::<4>, hardest::<8>, hardest::<16>];
        let mut hard = hard_us(&Exact::new(&curve), 0, 128);
        hard.extend(searches.iter().flat_map(|hardest| hardest(&curve)));
        let Curve { opening, closing, .. } = curve;
        writeln!(out, "Curve {{ name: {name:?}, opening: {opening:?}, closing: {closing:?}, hard: &{hard:?} }},")
            .unwrap();
    }
    out.push_str("];\n");
    let path = PathBuf::from(env::var("OUT_DIR").unwrap()).join("curves.rs");
    fs::write(path, out).unwrap();
}

/// The `u` for which the mass is evaluated most often: the first few of 20 000, and of those around them, ever
/// nearer.
fn hardest<const OCTAVES: usize>(curve: &Curve) -> Vec<f32> {
    let (exact, ours, mut rng) = (Exact::new(curve), shutter::<OCTAVES>(curve), Rng::new(0, 0));
    let mut us = hard_us(&exact, OCTAVES as u64, 20_000);
    for reach in [65536.0, 8192.0, 1024.0, 128.0, 16.0, 0.0] {
        us.sort_by_cached_key(|u| (Reverse(ours.evaluations(*u)), u.to_bits()));
        us.dedup();
        us.truncate(32);
        let around = us.iter().flat_map(|u| [*u; 400]).map(|u| {
            let steps = rng.between(-reach, reach) as i32;
            f32::from_bits(u.to_bits().saturating_add_signed(steps))
        });
        let around: Vec<f32> = around.filter(|u| *u <= 1.0).collect();
        us.extend(around);
    }
    us.dedup();
    us.truncate(32);
    us
}
