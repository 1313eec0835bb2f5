//! Builds what is measured, for each processor, and runs it there.

use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

use crate::Result;

/// What the programs are built for and run on.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Core {
    pub name: &'static str,
    pub target: &'static str,
    runs_in: RunsIn,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum RunsIn {
    /// A board of QEMU's with an Arm core.
    Board(&'static str),
    /// QEMU's user mode for a processor.
    Linux(&'static str),
    Node,
}

use RunsIn::{Board, Linux, Node};

const fn core(name: &'static str, target: &'static str, runs_in: RunsIn) -> Core {
    Core { name, target, runs_in }
}

/// A Cortex-M0+'s code, run by a Cortex-M3, which executes the same instructions.
pub const M0: Core = core("Cortex-M0+", "thumbv6m-none-eabi", Board("mps2-an385"));
pub const M4F: Core = core("Cortex-M4F", "thumbv7em-none-eabihf", Board("mps2-an386"));
pub const M33: Core = core("Cortex-M33", "thumbv8m.main-none-eabihf", Board("mps2-an505"));
pub const IMC: Core = core("riscv32imc", "riscv32imc-unknown-none-elf", Linux("qemu-riscv32"));
pub const IMAFC: Core = core("riscv32imafc", "riscv32imafc-unknown-none-elf", Linux("qemu-riscv32"));
const RISCV64: Core = core("riscv64gc", "riscv64gc-unknown-none-elf", Linux("qemu-riscv64"));
const I686: Core = core("i686", "i686-unknown-linux-gnu", Linux("qemu-i386"));
pub const S390X: Core = core("s390x", "s390x-unknown-linux-gnu", Linux("qemu-s390x"));
const POWERPC: Core = core("powerpc", "powerpc-unknown-linux-gnu", Linux("qemu-ppc"));
const WASM: Core = core("wasm32", "wasm32-unknown-unknown", Node);

/// All of them, the slowest first: floats in software, both orders of bytes, 32 bits and 64, and two compilers' back
/// ends without a common ancestor of Arm's.
pub const CORES: [Core; 10] = [M0, IMC, I686, S390X, WASM, M4F, M33, IMAFC, RISCV64, POWERPC];

impl Core {
    /// Does it compute in `f32`?
    pub fn has_fpu(self) -> bool {
        [M4F, M33, IMAFC].contains(&self)
    }
}

pub const QEMU: &str = "qemu-system-arm";
pub const OBJDUMP: &str = "llvm-objdump";

/// Gives WebAssembly what it asks for: a way to print.
const NODE: &str = "node";
const HOST: &str = "
import { readFileSync } from 'node:fs';
const host = { write: (at, length) => process.stdout.write(new Uint8Array(program.exports.memory.buffer, at, length)) };
const { instance: program } = await WebAssembly.instantiate(readFileSync(process.argv[1]), { host });
program.exports._start();
";

/// The level at which what is measured is optimised, as the compiler takes it.
const OPT_LEVEL: &str = "3";

/// The nested workspace.
pub fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Builds a program, and says where it is.
pub fn build(core: Core, program: &str) -> Result<PathBuf> {
    if !cargo(core, program, OPT_LEVEL).status()?.success() {
        let target = core.target;
        let help = format!("`rustup target add {target}`, or run this by .ci/matrix.sh");
        return Err(format!("cannot build {program} for {target}; {help}").into());
    }
    let suffix = if core.runs_in == Node { ".wasm" } else { "" };
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| folder().join("target"), PathBuf::from);
    Ok(target.join(core.target).join("release").join(format!("{program}{suffix}")))
}

/// The machine's own compiler, where `.ci/thumb.sh` has brought another.
pub fn host_rustc() -> Option<OsString> {
    std::env::var_os("HOST_RUSTC")
}

fn has_target(rustc: &OsStr, target: &str) -> bool {
    let folder = Command::new(rustc).args(["--print", "target-libdir", "--target", target]).output();
    folder.is_ok_and(|folder| Path::new(String::from_utf8_lossy(&folder.stdout).trim()).is_dir())
}

/// The command that builds a program.
pub fn cargo(core: Core, program: &str, level: &str) -> Command {
    let mut cargo = Command::new("cargo");
    cargo.current_dir(folder()).args(["build", "--quiet", "--release", "--package", "measured"]);
    cargo.args(["--bin", program, "--target", core.target]);
    if program == "cost" {
        cargo.args(["--features", "cost"]);
    }
    // These replace the flags that the crate's example needs. The compiler's stack figures need a flag that is not
    // stable. On a board each function begins at a word, since the fetch counts: else its cycles would change with what
    // lies before it.
    let flags = match core.runs_in {
        Board(_) => "-C link-arg=-Tlink.x -Z emit-stack-sizes -C llvm-args=-align-all-functions=2",
        // No library of Linux's is linked, so none of its linkers is needed.
        Linux(_) => "-C linker=rust-lld -C linker-flavor=ld.lld -C relocation-model=static -Z emit-stack-sizes",
        Node => "",
    };
    cargo.env("RUSTFLAGS", flags).env("RUSTC_BOOTSTRAP", "1");
    cargo.env("CARGO_PROFILE_RELEASE_PANIC", "abort").env("CARGO_PROFILE_RELEASE_OPT_LEVEL", level);
    if core == WASM {
        // The machine's own compiler has the target where rustup could add it, and is the faster one.
        if let Some(rustc) = host_rustc().filter(|rustc| has_target(rustc, core.target)) {
            cargo.env("RUSTC", rustc);
        }
        // On one processor of 32 bits overflows are checked, as they are on the host where it is debugged.
        cargo.env("CARGO_PROFILE_RELEASE_OVERFLOW_CHECKS", "true");
    }
    cargo
}

/// What the figures depend on: the compiler and QEMU, as they name themselves, and the optimisation.
pub fn made_with() -> Result<String> {
    let version = |program: &str| {
        let text = succeeded(program, Command::new(program).arg("--version").output())?.stdout;
        Ok::<_, crate::Error>(String::from_utf8_lossy(&text).lines().next().unwrap_or("").to_owned())
    };
    let rustc = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".into());
    Ok(format!("{}, opt-level {OPT_LEVEL};\n{}", version(&rustc)?, version(QEMU)?))
}

/// What a program gave; or why it did not start, or why it failed.
pub fn succeeded(program: &str, output: std::io::Result<Output>) -> Result<Output> {
    let output = output.map_err(|error| missing(program, &error))?;
    if !output.status.success() {
        let texts = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
        return Err(format!("{program}: {}", texts.join("\n")).into());
    }
    Ok(output)
}

fn missing(program: &str, error: &std::io::Error) -> String {
    let help = match error.kind() {
        ErrorKind::NotFound if program == NODE => "; install Node.js (Debian: nodejs)",
        ErrorKind::NotFound => "; install it, or run this by .ci/matrix.sh",
        _ => "",
    };
    format!("{program}: {error}{help}")
}

/// Starts a program on a file's bytes, its output and errors piped; `options` are QEMU's.
pub fn start(core: Core, program: &Path, input: Option<File>, options: &[&str]) -> Result<Child> {
    let (runner, first) = match core.runs_in {
        Board(board) => (QEMU, vec!["-M", board]),
        Linux(qemu) => (qemu, vec![]),
        Node => (NODE, vec!["--input-type=module", "-e", HOST]),
    };
    let mut command = Command::new(runner);
    command.args(first).args(options);
    if let Board(_) = core.runs_in {
        command.args(["-nographic", "-monitor", "none", "-serial", "null"]);
        command.args(["-semihosting-config", "enable=on,target=native", "-kernel"]);
    }
    command.arg(program).stdin(input.map_or_else(Stdio::null, Stdio::from));
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
    child.map_err(|error| missing(runner, &error).into())
}

/// What a program prints, without an input.
pub fn output(core: Core, program: &Path) -> Result<Vec<u8>> {
    let output = start(core, program, None, &[])?.wait_with_output();
    Ok(succeeded(&program.display().to_string(), output)?.stdout)
}
