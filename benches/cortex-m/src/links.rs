//! No panic: a program that links only if none can be reached, and a control that must not link.

use crate::firmware::{M0, M4F, SEEDS, cargo};

/// The function that the programs' panic handler calls, and that does not exist.
const MISSING: &str = "undefined symbol: a_panic_can_be_reached";

pub fn run() -> Result<(), String> {
    for core in [M4F, M0] {
        for seed in SEEDS {
            let named =
                format!("{}, seed {}", core.name, if seed.is_empty() { "none" } else { seed });
            if let Some(errors) = failure(core, "no_panic", seed)? {
                return Err(format!("{named}: a panic can be reached\n{errors}"));
            }
            match failure(core, "panic", seed)? {
                Some(errors) if errors.contains(MISSING) => {}
                Some(errors) => {
                    return Err(format!("{named}: the control fails for another reason\n{errors}"));
                }
                None => {
                    return Err(format!("{named}: the control links, so the check sees nothing"));
                }
            }
            println!("{named}: links without a panic, and the control does not link");
        }
    }
    Ok(())
}

/// What the linker says, if a program does not link.
fn failure(
    core: crate::firmware::Core,
    program: &str,
    seed: &str,
) -> Result<Option<String>, String> {
    let output = cargo(core, program, seed).output().map_err(|error| format!("cargo: {error}"))?;
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    Ok((!output.status.success()).then_some(errors))
}
