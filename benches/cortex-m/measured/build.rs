//! The curves of the tests' reference data and their hard cases, as Rust, each with its hard inputs.

use std::{env, fmt::Write, fs, path::PathBuf};

use support::curves::named;
use support::oracle::{Curve, Exact};
use support::questions::hard_us;

#[path = "../../../tests/support/mod.rs"]
mod support;

/// The curves with columns of their own in the report. They come first, then the other typical ones.
const FIRST: [&str; 3] = ["rman_soft", "raised_cosine", "trapezoid"];

fn main() {
    if env::var("TARGET").unwrap() != env::var("HOST").unwrap() {
        println!("cargo:rustc-cfg=bare");
    }

    let kinds = ["typical", "hard", "case"].into_iter();
    let mut curves: Vec<_> =
        kinds.flat_map(|kind| named(kind).into_iter().map(move |c| (c.name, kind == "typical", c.curve))).collect();
    curves.sort_by_key(|(name, is_typical, _)| {
        (FIRST.iter().position(|first| first == name).unwrap_or(FIRST.len()), !is_typical)
    });
    let typical = curves.iter().filter(|(_, is_typical, _)| *is_typical).count();
    let mut out = format!("pub const TYPICAL: usize = {typical};\npub const CURVES: &[Curve] = &[\n");
    for (.., curve) in curves {
        let hard = hard_us(&Exact::new(&curve), 0, 128);
        let Curve { opening, closing, .. } = curve;
        writeln!(out, "Curve {{ opening: {opening:?}, closing: {closing:?}, hard: &{hard:?} }},").unwrap();
    }
    fs::write(PathBuf::from(env::var("OUT_DIR").unwrap()).join("curves.rs"), out + "];\n").unwrap();
}
