//! The program `shutter`; see `shutter --help`.

use std::process::ExitCode;
use std::{env, io};

fn main() -> ExitCode {
    shutter::command::run(env::args_os(), &mut io::stdout().lock(), &mut io::stderr().lock()).into()
}
