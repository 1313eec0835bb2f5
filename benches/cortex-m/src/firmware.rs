//! Builds the firmware and runs it in QEMU.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

/// A core that the firmware is measured on, as a board of QEMU's.
#[derive(Clone, Copy)]
pub struct Core {
    pub name: &'static str,
    pub target: &'static str,
    board: &'static str,
}

pub const M4F: Core =
    Core { name: "Cortex-M4F", target: "thumbv7em-none-eabihf", board: "mps2-an386" };
/// A Cortex-M0+'s code, run by a Cortex-M3, which executes the same instructions.
pub const M0: Core = Core { name: "Cortex-M0+", target: "thumbv6m-none-eabi", board: "mps2-an385" };

/// The crate's seeds, each a feature or none.
pub const SEEDS: [&str; 3] = ["", "libm", "micromath"];

/// The nested workspace.
pub fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Builds a program of the firmware with one of the crate's seeds, a feature or none.
pub fn build(core: Core, program: &str, seed: &str) -> Result<PathBuf, String> {
    let mut cargo = cargo(core, program, seed);
    let status = cargo.status().map_err(|error| format!("cargo: {error}"))?;
    if !status.success() {
        return Err(format!("cannot build {program} for {}; has rustc the target?", core.target));
    }
    Ok(elf(core, program))
}

pub fn elf(core: Core, program: &str) -> PathBuf {
    let target =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| folder().join("target"), PathBuf::from);
    target.join(core.target).join("release").join(program)
}

/// The command that builds a program.
pub fn cargo(core: Core, program: &str, seed: &str) -> Command {
    let mut cargo = Command::new("cargo");
    cargo.current_dir(folder()).args(["build", "--quiet", "--release", "--package", "firmware"]);
    cargo.args(["--bin", program, "--target", core.target, "--features", seed]);
    // These replace the flags that the crate's example needs. The compiler's stack figures need a flag
    // that is not stable.
    cargo.env("RUSTFLAGS", "-C link-arg=-Tlink.x -Z emit-stack-sizes").env("RUSTC_BOOTSTRAP", "1");
    cargo
}

/// Starts a program in QEMU, its output piped; `options` are QEMU's.
pub fn start(core: Core, elf: &Path, options: &[String]) -> Result<Child, String> {
    Command::new("qemu-system-arm")
        .args(["-M", core.board, "-nographic", "-monitor", "none", "-serial", "null"])
        .args(["-semihosting-config", "enable=on,target=native", "-kernel"])
        .arg(elf)
        .args(options)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|error| format!("qemu-system-arm: {error}"))
}

/// What a program writes.
pub fn output(core: Core, elf: &Path) -> Result<Vec<u8>, String> {
    let child = start(core, elf, &[])?;
    let output = child.wait_with_output().map_err(|error| error.to_string())?;
    if !output.status.success() {
        return Err(format!("{}: {}", elf.display(), String::from_utf8_lossy(&output.stderr)));
    }
    Ok(output.stdout)
}
