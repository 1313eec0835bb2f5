//! The same bits everywhere: one hash from the host and from every core.

use std::process::Command;
use std::time::Instant;

use crate::firmware::{
    Core, Flavour, I686, IMAFC, IMC, M0, M4F, M33, POWERPC, RISCV64, S390X, SEEDS, WASM, build,
    folder, output,
};

/// What CI runs: the processors that differ most. Floats in software, both orders of bytes, 32 bits and 64, checked overflows,
/// and two compilers' back ends without a common ancestor of Arm's.
const SOME: [(Core, bool); 6] =
    [(I686, true), (S390X, false), (WASM, false), (IMC, false), (M0, false), (M4F, false)];
/// The rest.
const OTHERS: [(Core, bool); 4] =
    [(M33, false), (IMAFC, false), (RISCV64, false), (POWERPC, false)];

pub fn run(all: bool) -> Result<(), String> {
    let mut found: Option<String> = None;
    let mut differing = 0;
    let mut compare = |place: String, hash: &dyn Fn() -> Result<String, String>| {
        let start = Instant::now();
        let hash = hash()?;
        let same = *found.get_or_insert_with(|| hash.clone()) == hash;
        let verdict = if same { "" } else { "  DIFFERS" };
        println!("{place:34} {hash}{verdict}  ({:.0} s)", start.elapsed().as_secs_f32());
        differing += u32::from(!same);
        Ok::<(), String>(())
    };
    println!("CELLS 0, 4, 8, 16:");
    compare("host, debug".into(), &|| host(false, ""))?;
    compare("host, release".into(), &|| host(true, ""))?;
    for (core, debug) in SOME.iter().chain(if all { &OTHERS[..] } else { &[] }) {
        let (core, flavour) = (*core, Flavour { debug: *debug, ..Flavour::fast("") });
        let how = if *debug { ", debug" } else { "" };
        compare(format!("{}{how}", core.name), &|| {
            let hash = output(core, &build(core, "answers", flavour)?)?;
            Ok(String::from_utf8_lossy(&hash).trim().to_owned())
        })?;
    }
    // A seed may change a bit of an answer, but then everywhere.
    for seed in &SEEDS[1..] {
        let here = host(true, seed)?;
        let there = output(M4F, &build(M4F, "answers", Flavour::fast(seed))?)?;
        let same = here == String::from_utf8_lossy(&there).trim();
        let verdict = if same { "the same" } else { "DIFFERS" };
        println!("{:34} {here}  {verdict} on the host and on {}", format!("seed {seed}"), M4F.name);
        differing += u32::from(!same);
    }
    if differing > 0 { Err(format!("{differing} hashes differ")) } else { Ok(()) }
}

fn host(release: bool, seed: &str) -> Result<String, String> {
    let mut cargo = Command::new("cargo");
    cargo.current_dir(folder()).args(["run", "--quiet", "--package", "firmware"]);
    cargo.args(["--bin", "answers", "--features", seed]).args(release.then_some("--release"));
    let output = cargo.output().map_err(|error| format!("cargo: {error}"))?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}
