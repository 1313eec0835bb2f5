//! The program: its arguments, the files it reads and writes, its exit code.
//!
//! Whatever goes wrong is told on standard error with exit code 2, and no file is written then.

mod fit;
mod fit_many;
mod input;
mod mark;
mod output;
mod plan;
mod quantity;
mod read;
mod settings;

use std::ffi::OsString;
use std::io::Write;

use clap::{Parser, Subcommand};

/// The exit code for whatever goes wrong, as clap's.
const FAILED: u8 = 2;

/// From a camera's shutter to the ticks at which firmware fires flashes
///
/// Without a command, it plans a soft shutter as an example.
#[derive(Parser)]
#[command(name = "shutter", version, args_conflicts_with_subcommands = true)]
struct Args {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Subcommand)]
enum Command {
    Plan(Box<plan::Args>),
    Fit(Box<fit::Args>),
}

/// The whole program; the answer is its exit code.
pub fn run(args: impl IntoIterator<Item = OsString>, out: &mut dyn Write, err: &mut dyn Write) -> u8 {
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
    let ended = match args.command.unwrap_or_else(|| Command::Plan(Box::default())) {
        Command::Plan(args) => plan::run(&args, out, err),
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
