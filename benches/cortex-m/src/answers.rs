//! The same bits everywhere: one hash from the host and from processors that differ in what could change them: floats
//! in software, the order of bytes, 32 bits and 64, checked overflows, and the compiler's back end.

use std::process::Command;
use std::thread;

use crate::Result;
use crate::firmware::{IMC, M0, M4F, S390X, folder, succeeded};

pub fn run() -> Result {
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
        // The slowest first; the next is built while others run.
        let cores = [M0, IMC, S390X, M4F].into_iter().map(|core| {
            let program = core.build("answers")?;
            Ok((core, scope.spawn(move || core.output(&program))))
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
    cargo.current_dir(folder()).args(["run", "--quiet", "--package", "measured", "--bin", "answers"]).args(release);
    Ok(text(succeeded(cargo.output()?)?.stdout))
}

fn text(output: Vec<u8>) -> String {
    String::from_utf8_lossy(&output).trim().to_owned()
}
