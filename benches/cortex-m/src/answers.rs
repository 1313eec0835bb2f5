//! The same bits everywhere: one hash from the host and from processors that differ in what could change them: floats
//! in software, the order of bytes, 32 bits and 64, checked overflows, and the compiler's back end.

use std::process::Command;
use std::thread;

use crate::Result;
use crate::firmware::{IMC, M0, M4F, S390X, folder, succeeded};

pub fn run() -> Result {
    let mut hashes = vec![("host, debug", host(&[])?), ("host, release", host(&["--release"])?)];
    thread::scope(|scope| {
        // The slowest first; the next is built while others run.
        let cores = [M0, IMC, S390X, M4F].map(|core| {
            let program = core.build("answers")?;
            Ok(scope.spawn(move || core.output(&program).map(|hash| (core.name, hash))))
        });
        for core in cores.into_iter().collect::<Result<Vec<_>>>()? {
            hashes.push(core.join().map_err(|_| "a thread panicked")??);
        }
        Ok::<(), crate::Error>(())
    })?;
    println!("OCTAVES 0, 4, 8, 16:");
    for (place, hash) in &hashes {
        println!("{place:14} {}", String::from_utf8_lossy(hash).trim());
    }
    if hashes.iter().all(|(_, hash)| *hash == hashes[0].1) { Ok(()) } else { Err("the hashes differ".into()) }
}

fn host(release: &[&str]) -> Result<Vec<u8>> {
    let mut cargo = Command::new("cargo");
    cargo.current_dir(folder()).args(["run", "--quiet", "--package", "measured", "--bin", "answers"]).args(release);
    Ok(succeeded(cargo.output()?)?.stdout)
}
