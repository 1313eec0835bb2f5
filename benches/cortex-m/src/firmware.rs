//! Builds the firmware and runs it in QEMU.

use std::ffi::OsStr;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

/// What the firmware's programs are built for and run on.
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

pub const M4F: Core = core("Cortex-M4F", "thumbv7em-none-eabihf", Board("mps2-an386"));
/// A Cortex-M0+'s code, run by a Cortex-M3, which executes the same instructions.
pub const M0: Core = core("Cortex-M0+", "thumbv6m-none-eabi", Board("mps2-an385"));
pub const M33: Core = core("Cortex-M33", "thumbv8m.main-none-eabihf", Board("mps2-an505"));
pub const IMC: Core = core("riscv32imc", "riscv32imc-unknown-none-elf", Linux("qemu-riscv32"));
pub const IMAFC: Core =
    core("riscv32imafc", "riscv32imafc-unknown-none-elf", Linux("qemu-riscv32"));
pub const RISCV64: Core = core("riscv64gc", "riscv64gc-unknown-none-elf", Linux("qemu-riscv64"));
pub const I686: Core = core("i686", "i686-unknown-linux-gnu", Linux("qemu-i386"));
pub const S390X: Core = core("s390x", "s390x-unknown-linux-gnu", Linux("qemu-s390x"));
pub const POWERPC: Core = core("powerpc", "powerpc-unknown-linux-gnu", Linux("qemu-ppc"));
pub const WASM: Core = core("wasm32", "wasm32-unknown-unknown", Node);

impl Core {
    /// What the disassembler is told, since an older one does not take it from the file.
    pub fn disassembled_with(self) -> Option<&'static str> {
        match self {
            M33 => Some("--mattr=+fp-armv8d16sp,+dsp"),
            IMC => Some("--mattr=+m,+c"),
            IMAFC => Some("--mattr=+m,+a,+f,+c"),
            _ => None,
        }
    }
}

const fn core(name: &'static str, target: &'static str, runs_in: RunsIn) -> Core {
    Core { name, target, runs_in }
}

pub const QEMU: &str = "qemu-system-arm";
pub const OBJDUMP: &str = "llvm-objdump";

/// How a program is built: with one of the crate's seeds, a feature or none, and at an optimisation level.
#[derive(Clone, Copy)]
pub struct Flavour {
    pub seed: &'static str,
    pub level: &'static str,
    pub debug: bool,
}

impl Flavour {
    /// As what is measured is built.
    pub const fn fast(seed: &'static str) -> Self {
        Self { seed, level: OPT_LEVEL, debug: false }
    }
}

/// Gives WebAssembly what it asks for: a way to print.
const NODE: &str = "node";
const HOST: &str = "
import { readFileSync } from 'node:fs';
const host = { write: (at, length) => process.stdout.write(new Uint8Array(program.exports.memory.buffer, at, length)) };
const { instance: program } = await WebAssembly.instantiate(readFileSync(process.argv[1]), { host });
program.exports._start();
";

/// The firmware's, as the compiler takes it.
const OPT_LEVEL: &str = "3";

/// The crate's seeds, each a feature or none.
pub const SEEDS: [&str; 3] = ["", "libm", "micromath"];

/// The nested workspace.
pub fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Builds a program of the firmware.
pub fn build(core: Core, program: &str, flavour: Flavour) -> Result<PathBuf, String> {
    let mut cargo = cargo(core, program, flavour);
    let status = cargo.status().map_err(|error| format!("cargo: {error}"))?;
    if !status.success() {
        return Err(format!(
            "cannot build {program} for {}; `rustup target add {0}`, or run this by .ci/matrix.sh",
            core.target
        ));
    }
    let suffix = if core == WASM { ".wasm" } else { "" };
    let target =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| folder().join("target"), PathBuf::from);
    let profile = if flavour.debug { "debug" } else { "release" };
    Ok(target.join(core.target).join(profile).join(format!("{program}{suffix}")))
}

/// The command that builds a program.
pub fn cargo(core: Core, program: &str, Flavour { seed, level, debug }: Flavour) -> Command {
    let mut cargo = Command::new("cargo");
    cargo.current_dir(folder()).args(["build", "--quiet", "--package", "firmware"]);
    cargo.args(["--bin", program, "--target", core.target, "--features", seed]);
    // These replace the flags that the crate's example needs. The compiler's stack figures need a flag
    // that is not stable.
    let flags = match core.runs_in {
        Board(_) => "-C link-arg=-Tlink.x -Z emit-stack-sizes",
        // No library of Linux's is linked, so none of its linkers is needed.
        Linux(_) => {
            "-C linker=rust-lld -C linker-flavor=ld.lld -C relocation-model=static -Z emit-stack-sizes"
        }
        Node => "",
    };
    cargo.env("RUSTFLAGS", flags).env("RUSTC_BOOTSTRAP", "1");
    if debug {
        cargo.env("CARGO_PROFILE_DEV_PANIC", "abort");
    } else {
        cargo.arg("--release").env("CARGO_PROFILE_RELEASE_OPT_LEVEL", level);
        cargo.env("CARGO_PROFILE_RELEASE_PANIC", "abort");
    }
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
        // The one that the script does not set up.
        Some(NODE) => return format!("{name} not found: install Node.js (Debian: nodejs)"),
        Some(name) if name.starts_with("qemu-") => "install QEMU's user mode (Debian: qemu-user)",
        Some(OBJDUMP) => "install LLVM (Debian: llvm, or rustup's llvm-tools on the PATH)",
        _ => "install Rust",
    };
    format!("{name} not found: {install}, or run this by .ci/matrix.sh")
}

/// Starts a program, its input, output and errors piped; `options` are QEMU's.
pub fn start(core: Core, program: &Path, options: &[String]) -> Result<Child, String> {
    let (runner, first): (&str, &[&str]) = match core.runs_in {
        Board(board) => (
            QEMU,
            &[
                "-M",
                board,
                "-nographic",
                "-monitor",
                "none",
                "-serial",
                "null",
                "-semihosting-config",
                "enable=on,target=native",
            ],
        ),
        Linux(qemu) => (qemu, &[]),
        Node => (NODE, &["--input-type=module", "-e", HOST]),
    };
    let mut command = Command::new(runner);
    command.args(first).args(options);
    command.args(matches!(core.runs_in, Board(_)).then_some("-kernel")).arg(program);
    command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|error| missing(OsStr::new(runner), &error))
}

/// Starts a program that finds this in its memory, in [`firmware::SELECTED`] and behind.
pub fn start_with(
    core: Core,
    program: &Path,
    memory: &[u8],
    options: &[String],
) -> Result<Child, String> {
    let Board(_) = core.runs_in else {
        let mut child = start(core, program, options)?;
        // A program that stops early is found out by its status.
        let _ = child.stdin.take().map(|mut stdin| stdin.write_all(memory));
        return Ok(child);
    };
    let file = program.with_extension("memory");
    std::fs::write(&file, memory).map_err(|error| format!("{}: {error}", file.display()))?;
    let at = ::firmware::selected_at(core == M33);
    let loader = format!("loader,file={},addr={at:#x},force-raw=on", file.display());
    start(core, program, &[options, &["-device".into(), loader]].concat())
}

/// What a program writes.
pub fn output(core: Core, program: &Path) -> Result<Vec<u8>, String> {
    let child = start(core, program, &[])?;
    let output = child.wait_with_output().map_err(|error| error.to_string())?;
    if !output.status.success() {
        let texts = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
        return Err(format!("{}: {}", program.display(), texts.join("\n")));
    }
    Ok(output.stdout)
}
