//! No panic: a program that links only if none can be reached, and a control that must not link.

use crate::firmware::{Core, Flavour, IMC, M0, M4F, RISCV64, SEEDS, cargo};

/// The function that the programs' panic handler calls, and that does not exist.
const MISSING: &str = "undefined symbol: a_panic_can_be_reached";

/// As the compiler takes them: a check that one level proves needless may stay at another.
const LEVELS: [&str; 5] = ["3", "2", "1", "s", "z"];

pub fn run() -> Result<(), String> {
    let mut reached = 0;
    // With 64 bits a slice takes a way of its own.
    for core in [M4F, M0, IMC, RISCV64] {
        for level in LEVELS {
            // The seeds are for the search alone, which is the same everywhere.
            let seeds = if core == M4F && level == LEVELS[0] { &SEEDS[..] } else { &SEEDS[..1] };
            for seed in seeds {
                let named = format!(
                    "{}, opt-level {level}, seed {}",
                    core.name,
                    if seed.is_empty() { "none" } else { seed }
                );
                let flavour = Flavour { seed, level, debug: false };
                if let Some(errors) = failure(core, "no_panic", flavour)? {
                    println!("{named}: A PANIC CAN BE REACHED\n{errors}");
                    reached += 1;
                    continue;
                }
                match failure(core, "panic", flavour)? {
                    Some(errors) if errors.contains(MISSING) => {}
                    Some(errors) => {
                        return Err(format!(
                            "{named}: the control fails for another reason\n{errors}"
                        ));
                    }
                    None => {
                        return Err(format!(
                            "{named}: the control links, so the check sees nothing"
                        ));
                    }
                }
                println!("{named}: links without a panic, and the control does not link");
            }
        }
    }
    if reached > 0 { Err(format!("a panic can be reached in {reached} programs")) } else { Ok(()) }
}

/// What the linker says, if a program does not link.
fn failure(core: Core, program: &str, flavour: Flavour) -> Result<Option<String>, String> {
    let output =
        cargo(core, program, flavour).output().map_err(|error| format!("cargo: {error}"))?;
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    Ok((!output.status.success()).then_some(errors))
}
