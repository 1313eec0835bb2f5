//! Builds the firmware and runs it in QEMU.

use std::ffi::OsStr;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

/// A core that the firmware is measured on, as a board of QEMU's.
#[derive(Clone, Copy)]
pub struct Core {
    pub name: &'static str,
    pub target: &'static str,
    pub has_fpu: bool,
    board: &'static str,
}

pub const M4F: Core = Core {
    name: "Cortex-M4F",
    target: "thumbv7em-none-eabihf",
    has_fpu: true,
    board: "mps2-an386",
};
/// A Cortex-M0+'s code, run by a Cortex-M3, which executes the same instructions.
pub const M0: Core =
    Core { name: "Cortex-M0+", target: "thumbv6m-none-eabi", has_fpu: false, board: "mps2-an385" };

pub const QEMU: &str = "qemu-system-arm";
pub const OBJDUMP: &str = "llvm-objdump";

/// The firmware's, as the compiler takes it.
const OPT_LEVEL: &str = "3";

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
    cargo.env("CARGO_PROFILE_RELEASE_OPT_LEVEL", OPT_LEVEL);
    cargo
}

/// What the figures depend on: the compiler and QEMU, as they name themselves, and the optimisation.
pub fn made_with() -> Result<String, String> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version = |program: &OsStr| {
        let output = Command::new(program).arg("--version").output();
        let text = output.map_err(|error| missing(program, &error))?.stdout;
        Ok::<_, String>(String::from_utf8_lossy(&text).lines().next().unwrap_or("").to_owned())
    };
    let (rustc, qemu) = (version(&rustc)?, version(OsStr::new(QEMU))?);
    Ok(format!("{rustc}, opt-level {OPT_LEVEL}; {qemu}"))
}

/// Why a program does not start, and what to do.
pub fn missing(program: &OsStr, error: &std::io::Error) -> String {
    let name = program.display();
    if error.kind() != ErrorKind::NotFound {
        return format!("{name}: {error}");
    }
    let install = match program.to_str() {
        Some(QEMU) => "install QEMU (Debian: qemu-system-arm)",
        Some(OBJDUMP) => "install LLVM (Debian: llvm, or rustup's llvm-tools on the PATH)",
        _ => "install Rust",
    };
    format!("{name} not found: {install}, or run this by .ci/thumb.sh")
}

/// Starts a program in QEMU, its output piped; `options` are QEMU's.
pub fn start(core: Core, elf: &Path, options: &[String]) -> Result<Child, String> {
    Command::new(QEMU)
        .args(["-M", core.board, "-nographic", "-monitor", "none", "-serial", "null"])
        .args(["-semihosting-config", "enable=on,target=native", "-kernel"])
        .arg(elf)
        .args(options)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|error| missing(OsStr::new(QEMU), &error))
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
