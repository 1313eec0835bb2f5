//! The same bits everywhere: one hash from the host, debug and release, and from both cores.

use std::process::Command;

use crate::firmware::{M0, M4F, SEEDS, build, folder, output};

fn host(release: bool, seed: &str) -> Result<String, String> {
    let mut cargo = Command::new("cargo");
    cargo.current_dir(folder()).args([
        "run",
        "--quiet",
        "--package",
        "firmware",
        "--bin",
        "answers",
    ]);
    cargo.args(["--features", seed]).args(release.then_some("--release"));
    let output = cargo.output().map_err(|error| format!("cargo: {error}"))?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

pub fn run() -> Result<(), String> {
    let mut differing = 0;
    for seed in SEEDS {
        println!("seed {}, CELLS 0, 4, 8, 16:", if seed.is_empty() { "none" } else { seed });
        let mut hashes =
            vec![("host, debug", host(false, seed)?), ("host, release", host(true, seed)?)];
        for core in [M4F, M0] {
            let hash = output(core, &build(core, "answers", seed)?)?;
            hashes.push((core.name, String::from_utf8_lossy(&hash).trim().to_owned()));
        }
        for (place, hash) in &hashes {
            let same = *hash == hashes[0].1;
            println!("  {place:14} {hash}{}", if same { "" } else { "  DIFFERS" });
            differing += u32::from(!same);
        }
    }
    if differing > 0 { Err(format!("{differing} hashes differ")) } else { Ok(()) }
}
