//! Plans a shutter's triggers: a scene file in, a checked list of trigger times out, with a picture of it.
//!
//! ```text
//! cargo run --example plan
//! cargo run --example plan -- examples/scenes/leaf.toml --out leaf.svg
//! ```
//!
//! A scene that is wrong is an error with its line and reason on stderr and exit code 2; nothing is
//! written then.

mod picture;
mod plan;
mod report;
mod scene;
mod unit;

use std::ffi::OsString;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::{env, fs, process};

use clap::Parser;

use plan::Plan;

/// The scene without a file, and the name it goes by.
const DEFAULT: (&str, &str) = ("soft", include_str!("../scenes/soft.toml"));
/// The exit code for whatever goes wrong, as clap's.
const FAILED: u8 = 2;

/// Plans a shutter's triggers, each in the middle of an equal share of the exposure.
#[derive(Parser)]
#[command(name = "plan")]
struct Args {
    /// The scene, as in examples/scenes; a soft shutter if left out
    scene: Option<PathBuf>,
    /// Write the picture to this file
    #[arg(long, value_name = "FILE.svg", value_parser = svg_path)]
    out: Option<PathBuf>,
}

fn svg_path(name: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(name);
    let is_svg = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("svg"));
    if is_svg { Ok(path) } else { Err("the picture is an SVG: name it FILE.svg".into()) }
}

fn main() -> ExitCode {
    run(env::args_os(), &mut io::stdout().lock(), &mut io::stderr().lock()).into()
}

/// The whole program; the answer is its exit code.
pub fn run(
    args: impl IntoIterator<Item = OsString>,
    out: &mut dyn Write,
    err: &mut dyn Write,
) -> u8 {
    // There is no one to tell if stderr cannot be written.
    let args = match Args::try_parse_from(args) {
        Ok(args) => args,
        Err(usage) if usage.use_stderr() => {
            let _ = write!(err, "{usage}");
            return FAILED;
        }
        Err(help) => {
            let _ = write!(out, "{help}");
            return 0;
        }
    };
    match plan(&args, out) {
        Ok(()) => 0,
        Err(reason) => {
            let _ = writeln!(err, "error: {reason}");
            FAILED
        }
    }
}

fn plan(args: &Args, out: &mut dyn Write) -> Result<(), String> {
    let (name, plan) = match &args.scene {
        Some(path) => (stem(path), read(path)?),
        None => (DEFAULT.0.into(), checked(DEFAULT.0, DEFAULT.1)?),
    };
    if let Some(path) = &args.out {
        let svg = picture::svg(&name, &plan).map_err(|e| format!("the picture: {e}"))?;
        write_whole(path, &svg).map_err(|e| format!("{}: {e}", path.display()))?;
    }
    match out.write_all(report::text(&name, &plan).as_bytes()).and_then(|()| out.flush()) {
        // Who reads this has seen enough.
        Err(e) if e.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written.map_err(|e| format!("standard output: {e}")),
    }
}

fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into()
}

fn read(path: &Path) -> Result<Plan, String> {
    let file = path.display().to_string();
    let text = fs::read_to_string(path).map_err(|e| format!("{file}: {e}"))?;
    checked(&file, &text)
}

fn checked(file: &str, text: &str) -> Result<Plan, String> {
    scene::parse(text).and_then(|scene| Plan::new(&scene)).map_err(|fault| fault.locate(file, text))
}

/// Writes a file as a whole or not at all: beside its place first, then renamed into it.
fn write_whole(path: &Path, contents: &str) -> io::Result<()> {
    let mut beside = path.as_os_str().to_owned();
    beside.push(format!(".{}.tmp", process::id()));
    let written = fs::write(&beside, contents).and_then(|()| fs::rename(&beside, path));
    if written.is_err() {
        // If this fails as well, the first error is the one to tell.
        let _ = fs::remove_file(&beside);
    }
    written
}
