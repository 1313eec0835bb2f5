//! No panic: a program that links only if none can be reached, and a control that must not link, both built at once.

use crate::Result;
use crate::firmware::{M0, M4F, S390X};

/// The function that the programs' panic handler calls, and that does not exist.
const MISSING: &str = "undefined symbol: a_panic_can_be_reached";

pub fn run() -> Result {
    let mut reached = 0;
    // A check that one level proves needless may stay at another. Most of what a level changes is the same for every
    // processor, so one without an FPU and one with 64 bits have two.
    let all: &[_] = &["3", "2", "1", "s", "z"];
    for (core, levels) in [(M4F, all), (M0, &["3", "z"]), (S390X, &["3", "z"])] {
        for &level in levels {
            let named = format!("{}, opt-level {level}", core.name);
            let mut cargo = core.cargo("no_panic", level);
            let built = cargo.args(["--bin", "panic", "--keep-going"]).output()?;
            let errors = String::from_utf8_lossy(&built.stderr);
            let failed = |program: &str| errors.contains(&format!("(bin \"{program}\")"));
            if built.status.success() {
                return Err(format!("{named}: the control links: the check sees nothing").into());
            } else if failed("no_panic") {
                println!("{named}: A PANIC CAN BE REACHED\n{errors}");
                reached += 1;
            } else if failed("panic") && errors.contains(MISSING) {
                println!("{named}: links without a panic, and the control does not link");
            } else {
                return Err(format!("{named}: the control fails otherwise\n{errors}").into());
            }
        }
    }
    if reached > 0 {
        return Err(format!("a panic can be reached in {reached} programs").into());
    }
    Ok(())
}
