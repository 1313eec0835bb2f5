//! The curves, as Rust; and the folder of the board's `memory.x`: the crate's, or this one for the board with a
//! Cortex-M33.

use std::{env, fs, path::PathBuf};

fn main() {
    let here = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap());
    let target = env::var("TARGET").unwrap();
    if target != env::var("HOST").unwrap() {
        println!("cargo:rustc-cfg=bare");
    }
    let map = if target.starts_with("thumbv8m") { here } else { here.join("../../..") };
    println!("cargo:rustc-link-search={}", map.display());
    println!("cargo:rerun-if-changed={}", map.join("memory.x").display());

    let path = PathBuf::from(env::var("OUT_DIR").unwrap()).join("curves.rs");
    fs::write(path, hardest::CURVES).unwrap();
}
