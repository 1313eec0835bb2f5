//! No panic: a program that links only if none can be reached, and a control that must not link, both built at once.

use crate::firmware::{Flavour, IMC, M0, M4F, RISCV64, SEEDS, cargo};

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
                let built = cargo(core, "no_panic", flavour)
                    .args(["--bin", "panic", "--keep-going"])
                    .output()
                    .map_err(|error| format!("cargo: {error}"))?;
                let errors = String::from_utf8_lossy(&built.stderr);
                let failed = |program: &str| errors.contains(&format!("(bin \"{program}\")"));
                if built.status.success() {
                    return Err(format!("{named}: the control links, so the check sees nothing"));
                } else if failed("no_panic") {
                    println!("{named}: A PANIC CAN BE REACHED\n{errors}");
                    reached += 1;
                } else if failed("panic") && errors.contains(MISSING) {
                    println!("{named}: links without a panic, and the control does not link");
                } else {
                    return Err(format!("{named}: the control fails for another reason\n{errors}"));
                }
            }
        }
    }
    if reached > 0 { Err(format!("a panic can be reached in {reached} programs")) } else { Ok(()) }
}
