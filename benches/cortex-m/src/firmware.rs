//! Builds what is measured, for each processor, and runs it there, with the tools of `.ci/thumb.sh`.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

use crate::Result;

/// What the programs are built for and run on.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Core {
    pub name: &'static str,
    pub target: &'static str,
    /// In its user mode. That for Arm's other cores executes these ones' instructions, too.
    qemu: &'static str,
}

const fn core(name: &'static str, target: &'static str, qemu: &'static str) -> Core {
    Core { name, target, qemu }
}

pub const M0: Core = core("Cortex-M0+", "thumbv6m-none-eabi", "qemu-arm");
pub const M4F: Core = core("Cortex-M4F", "thumbv7em-none-eabihf", "qemu-arm");
pub const M33: Core = core("Cortex-M33", "thumbv8m.main-none-eabihf", "qemu-arm");
pub const IMC: Core = core("riscv32imc", "riscv32imc-unknown-none-elf", "qemu-riscv32");
pub const IMAFC: Core = core("riscv32imafc", "riscv32imafc-unknown-none-elf", "qemu-riscv32");
pub const S390X: Core = core("s390x", "s390x-unknown-linux-gnu", "qemu-s390x");

/// The level at which what is measured is optimised, as the compiler takes it.
const OPT_LEVEL: &str = "3";

impl Core {
    /// Does it compute in `f32`?
    pub fn has_fpu(self) -> bool {
        [M4F, M33, IMAFC].contains(&self)
    }

    /// A command with the core's compiler and emulator.
    fn command(self, program: &str) -> Command {
        let mut command = Command::new(folder().join("../../.ci/thumb.sh"));
        command.current_dir(folder()).env("TARGETS", self.target).env("TOOLS", "linux").arg(program);
        command
    }

    /// The command that builds a program.
    pub fn cargo(self, program: &str, level: &str) -> Command {
        let mut cargo = self.command("cargo");
        cargo.args(["build", "--quiet", "--release", "--package", "measured", "--bin", program]);
        cargo.args(["--target", self.target]);
        if program == "cost" {
            cargo.args(["--features", "cost"]);
        }
        // Each function begins at a word, as the fetch counts: else its cycles would change with what lies before it.
        // No library of Linux's is linked, so none of its linkers is needed.
        let flags = "-C linker=rust-lld -C linker-flavor=ld.lld -C relocation-model=static \
            -C llvm-args=-align-all-functions=2";
        // On one processor of 32 bits overflows are checked, as they are on the host where it is debugged.
        let checks = self == IMC && program == "answers";
        cargo.env("CARGO_PROFILE_RELEASE_OVERFLOW_CHECKS", checks.to_string());
        cargo.env("RUSTFLAGS", flags).env("RUSTC_BOOTSTRAP", "1").env("CARGO_PROFILE_RELEASE_PANIC", "abort");
        cargo.env("CARGO_PROFILE_RELEASE_OPT_LEVEL", level);
        cargo
    }

    /// Builds a program, and says where it is.
    pub fn build(self, program: &str) -> Result<PathBuf> {
        if !self.cargo(program, OPT_LEVEL).status()?.success() {
            return Err(format!("cannot build {program} for {}", self.target).into());
        }
        let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| folder().join("target"), PathBuf::from);
        Ok(target.join(self.target).join("release").join(program))
    }

    /// Starts a program on a file's bytes, its output and errors piped; `options` are QEMU's.
    pub fn start(self, program: &Path, input: Option<File>, options: &[&str]) -> Result<Child> {
        let mut command = self.command(self.qemu);
        command.args(options).arg(program).stdin(input.map_or_else(Stdio::null, Stdio::from));
        Ok(command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn()?)
    }

    /// What a program prints, without an input.
    pub fn output(self, program: &Path) -> Result<Vec<u8>> {
        Ok(succeeded(self.start(program, None, &[])?.wait_with_output()?)?.stdout)
    }
}

/// The nested workspace.
pub fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// What a program gave; or why it failed.
pub fn succeeded(output: Output) -> Result<Output> {
    if !output.status.success() {
        let texts = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
        return Err(texts.join("\n").into());
    }
    Ok(output)
}

/// What the figures depend on: the compiler and QEMU, as they name themselves, and the optimisation.
pub fn made_with() -> Result<String> {
    let versions = M4F.command("sh").args(["-c", "${RUSTC:-rustc} --version; qemu-arm --version"]).output()?;
    let text = String::from_utf8(succeeded(versions)?.stdout)?;
    let lines: Vec<_> = text.lines().take(2).collect();
    Ok(format!("{}, opt-level {OPT_LEVEL}", lines.join(", ")))
}
