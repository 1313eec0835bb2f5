//! The program: its arguments, the files it reads and writes, its exit code.
//!
//! Whatever goes wrong is told on standard error with exit code 2, and nothing is written then.

mod design;
mod fit;
mod plan;

use std::ffi::OsString;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::{fs, process};

use clap::{Parser, Subcommand};

/// The exit code for whatever goes wrong, as clap's.
const FAILED: u8 = 2;

/// From a camera's shutter to the ticks at which a firmware triggers
///
/// Without a command, `plan` of a soft shutter.
#[derive(Parser)]
#[command(name = "shutter", version, args_conflicts_with_subcommands = true)]
struct Args {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Subcommand)]
enum Command {
    Plan(plan::Args),
    Design(design::Args),
    Fit(Box<fit::Args>),
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
            let _ = writeln!(out, "{}", help.to_string().trim_end());
            return 0;
        }
    };
    let ended = match args.command.unwrap_or_else(|| Command::Plan(plan::Args::default())) {
        Command::Plan(args) => plan::run(&args, out),
        Command::Design(args) => design::run(&args, out),
        Command::Fit(args) => fit::run(&args, out, err),
    };
    match ended {
        Ok(()) => 0,
        Err(reason) => {
            let _ = writeln!(err, "error: {reason}");
            FAILED
        }
    }
}

/// The name of a picture's file, as an argument.
fn svg_path(name: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(name);
    let is_svg = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("svg"));
    if is_svg { Ok(path) } else { Err("the picture is an SVG: name it FILE.svg".into()) }
}

/// Writes all of `text` to standard output.
fn print(out: &mut dyn Write, text: &str) -> Result<(), String> {
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        // Who reads this has seen enough.
        Err(e) if e.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written.map_err(|e| format!("standard output: {e}")),
    }
}

/// Writes a file as a whole or not at all: beside its place first, then renamed into it.
fn write_whole(path: &Path, contents: &str) -> Result<(), String> {
    let mut beside = path.as_os_str().to_owned();
    beside.push(format!(".{}.tmp", process::id()));
    let written: io::Result<()> =
        fs::write(&beside, contents).and_then(|()| fs::rename(&beside, path));
    if written.is_err() {
        // If this fails as well, the first error is the one to tell.
        let _ = fs::remove_file(&beside);
    }
    written.map_err(|e| format!("{}: {e}", path.display()))
}
