//! No panic: a program that links only if none can be reached, and a control that must not link, both built at once.

use crate::Result;
use crate::firmware::{M0, M4F, S390X};

/// The function that the programs' panic handler calls, and that does not exist.
const MISSING: &str = "undefined symbol: a_panic_can_be_reached";

pub fn run() -> Result {
    // A check that one level proves needless may stay at another. Most of what a level changes is the same for every
    // processor, so one without an FPU and one with 64 bits have two.
    let all: &[_] = &["3", "2", "1", "s", "z"];
    for (core, levels) in [(M4F, all), (M0, &["3", "z"]), (S390X, &["3", "z"])] {
        for &level in levels {
            let mut cargo = core.cargo("no_panic", level);
            let built = cargo.args(["--bin", "panic", "--keep-going"]).output()?;
            let errors = String::from_utf8_lossy(&built.stderr);
            let failed = |program: &str| errors.contains(&format!("(bin \"{program}\")"));
            if failed("no_panic") || !failed("panic") || !errors.contains(MISSING) {
                let message = "a panic can be reached, or the control does not fail by one";
                return Err(format!("{}, opt-level {level}: {message}\n{errors}", core.name).into());
            }
            println!("{}, opt-level {level}: links without a panic, and the control does not link", core.name);
        }
    }
    Ok(())
}
