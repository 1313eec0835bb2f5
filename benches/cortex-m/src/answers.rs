//! The same bits everywhere: one hash from the host and from every processor whose target is set up.

use std::process::Command;
use std::thread;

use crate::Result;
use crate::firmware::{CORES, build, folder, host_rustc, output, succeeded};

pub fn run() -> Result {
    // Those of `.ci/matrix.sh`, and without it all.
    let targets = std::env::var("TARGETS").ok();
    let is_set_up = |target| targets.iter().all(|all| all.split(' ').any(|one| one == target));
    let expected = host(&[])?;
    let mut differing = 0;
    let mut compare = |place: &str, hash: &str| {
        let verdict = if hash == expected { "" } else { "  DIFFERS" };
        println!("{place:14} {hash}{verdict}");
        differing += u32::from(hash != expected);
    };
    println!("OCTAVES 0, 4, 8, 16:");
    compare("host, debug", &expected);
    compare("host, release", &host(&["--release"])?);
    thread::scope(|scope| {
        // The next is built while others run.
        let cores = CORES.into_iter().filter(|core| is_set_up(core.target)).map(|core| {
            let program = build(core, "answers")?;
            Ok((core, scope.spawn(move || output(core, &program))))
        });
        for (core, run) in cores.collect::<Result<Vec<_>>>()? {
            let hash = run.join().map_err(|_| "a thread panicked")??;
            compare(core.name, &text(hash));
        }
        Ok::<(), crate::Error>(())
    })?;
    if differing > 0 { Err(format!("{differing} hashes differ").into()) } else { Ok(()) }
}

fn host(release: &[&str]) -> Result<String> {
    let mut cargo = Command::new("cargo");
    if let Some(rustc) = host_rustc() {
        cargo.env("RUSTC", rustc);
    }
    cargo.current_dir(folder()).args(["run", "--quiet", "--package", "measured"]);
    let output = cargo.args(["--bin", "answers"]).args(release).output();
    Ok(text(succeeded("cargo", output)?.stdout))
}

fn text(output: Vec<u8>) -> String {
    String::from_utf8_lossy(&output).trim().to_owned()
}
