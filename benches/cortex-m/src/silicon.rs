//! The model against boards: code whose cycles others have published, counted by the model. Boards without wait states, but
//! for the last, whose flash has a cache.

use std::process::Command;

use crate::Result;
use crate::disassembly::Disassembly;
use crate::firmware::{M4F, OPT_LEVEL, cargo, folder, program, succeeded};
use crate::trace::replay;

const COMPENDIUM: &str = "https://compendium.i-0.nl/docs";

/// The programs of `measured/src/bin/silicon.rs` behind the first: what each is, its cycles on a board, and whose figure
/// that is.
const PROGRAMS: [(&str, f64, &str); 7] = [
    ("a loop from a 32-bit instruction across two words", 19.0, "/control-flow/branch_timing, a"),
    ("a loop from a 16-bit instruction", 16.0, "/control-flow/branch_timing, b"),
    ("32-bit instructions across two words", 5.0, "/instruction-alignment/effects, a"),
    ("32-bit instructions in a word each", 4.0, "/instruction-alignment/effects, b"),
    ("1000 turns of SUBS and BNE", 3000.0, "https://github.com/greatscottgadgets/hackrf/pull/1669"),
    (
        "1000 turns of NOP, SUBS and BNE",
        4000.0,
        "https://github.com/rust-embedded/cortex-m/issues/151",
    ),
    (
        "a point of P-256 from its x",
        48_000.0,
        "crates.io: p256-cortex-m4-sys 0.1.0, README: nRF52840",
    ),
];

pub fn run() -> Result {
    let assembly = folder().join("target/p256.s");
    std::fs::create_dir_all(folder().join("target"))?;
    std::fs::write(&assembly, p256()?)?;
    let mut build = cargo(M4F, "silicon", OPT_LEVEL);
    build.env("RUSTFLAGS", "-C link-arg=-Tlink.x --cfg p256").env("P256", &assembly);
    if !build.status()?.success() {
        return Err("cannot build what others have measured".into());
    }
    let elf = program(M4F, "silicon");
    let (calls, _) = replay(M4F, &elf, &Disassembly::of(M4F, &elf)?, None)?;
    let [nothing, calls @ ..] = &calls[..] else { return Err("nothing was called".into()) };
    println!("| program | board | model | ratio | source |\n|---|--:|--:|--:|---|");
    let mut logarithms = 0.0;
    for ((name, board, source), call) in PROGRAMS.iter().zip(calls) {
        let model = f64::from(call.cycles - nothing.cycles);
        let root = if source.starts_with('/') { COMPENDIUM } else { "" };
        println!("| {name} | {board} | {model} | {:.2} | {root}{source} |", model / board);
        logarithms += (model / board).ln();
    }
    println!("\ngeometric mean of the ratios: {:.3}", (logarithms / PROGRAMS.len() as f64).exp());
    println!(
        "The model's rules for branches and the fetch were taken from the first four and chosen by the last."
    );
    Ok(())
}

/// The assembly of P256-Cortex-M4 (MIT licence, Emil Lenngren), out of the crate that cargo has fetched, as the machine's own
/// compiler for C preprocesses it for a processor with floats.
fn p256() -> Result<String> {
    let mut cargo = Command::new("cargo");
    cargo.current_dir(folder()).args(["metadata", "--format-version", "1"]);
    let metadata = succeeded("cargo", cargo.output())?.stdout;
    let metadata = String::from_utf8_lossy(&metadata);
    let mut strings = metadata.split('"');
    let manifest = strings.find(|s| s.contains("p256-cortex-m4-sys-") && s.ends_with("Cargo.toml"));
    let manifest = manifest.ok_or("cargo knows no p256-cortex-m4-sys")?;
    let mut cc = Command::new("cc");
    cc.args(["-E", "-P", "-undef", "-D__ARM_FP"]);
    cc.arg(manifest.replace("Cargo.toml", "P256-Cortex-M4/p256-cortex-m4-asm-gcc.S"));
    let text = String::from_utf8(succeeded("cc", cc.output())?.stdout)?;
    // Other assembly may follow this one's end.
    Ok(text.replace("\n .end\n", "\n"))
}
