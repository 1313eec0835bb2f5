//! The same bits everywhere: one hash from the host and from every core.

use std::path::Path;
use std::process::Command;
use std::thread;

use crate::firmware::{
    Core, Flavour, I686, IMAFC, IMC, M0, M4F, M33, POWERPC, RISCV64, S390X, SEEDS, WASM, build,
    folder, output,
};

/// What CI runs: the processors that differ most. Floats in software, both orders of bytes, 32 bits and 64, checked overflows,
/// and two compilers' back ends without a common ancestor of Arm's. The slowest comes first.
const SOME: [(Core, bool); 6] =
    [(M0, false), (IMC, false), (I686, true), (S390X, false), (WASM, false), (M4F, false)];
/// The rest.
const OTHERS: [(Core, bool); 4] =
    [(M33, false), (IMAFC, false), (RISCV64, false), (POWERPC, false)];

pub fn run(all: bool) -> Result<(), String> {
    let expected = host(false, "")?;
    let mut differing = 0;
    let mut compare = |place: &str, hash: &str, expected: &str| {
        let verdict = if hash == expected { "" } else { "  DIFFERS" };
        println!("{place:34} {hash}{verdict}");
        differing += u32::from(hash != expected);
    };
    println!("CELLS 0, 4, 8, 16:");
    compare("host, debug", &expected, &expected);
    compare("host, release", &host(true, "")?, &expected);
    thread::scope(|scope| {
        // The next is built while others run.
        let start = |(core, debug): &(Core, bool)| {
            let (core, flavour) = (*core, Flavour { debug: *debug, ..Flavour::fast("") });
            let program = build(core, "answers", flavour)?;
            let place = format!("{}{}", core.name, if *debug { ", debug" } else { "" });
            Ok((place, scope.spawn(move || hash(core, &program))))
        };
        let cores = SOME.iter().chain(if all { &OTHERS[..] } else { &[] });
        for (place, run) in cores.map(start).collect::<Result<Vec<_>, String>>()? {
            compare(&place, &run.join().map_err(|_| "a thread panicked")??, &expected);
        }
        Ok::<(), String>(())
    })?;
    // A seed may change a bit of an answer, but then everywhere.
    for seed in &SEEDS[1..] {
        let here = host(true, seed)?;
        compare(&format!("host, seed {seed}"), &here, &here);
        let there = hash(M4F, &build(M4F, "answers", Flavour::fast(seed))?)?;
        compare(&format!("{}, seed {seed}", M4F.name), &there, &here);
    }
    if differing > 0 { Err(format!("{differing} hashes differ")) } else { Ok(()) }
}

fn hash(core: Core, program: &Path) -> Result<String, String> {
    Ok(String::from_utf8_lossy(&output(core, program)?).trim().to_owned())
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
