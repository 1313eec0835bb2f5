//! What the crate costs on a microcontroller: instructions, cycles, bytes and stack.
//!
//! ```text
//! cargo run --release                 # a Cortex-M4F's and a Cortex-M0+'s costs; exits with 1 where one is too high
//! cargo run --release -- --write-docs # tables of five processors, in ../../docs/internals/cost.md; some minutes
//! cargo run --release -- --answers    # do answers differ on the host and on other processors?
//! cargo run --release -- --links      # a firmware that links only if nothing can panic, at every level
//! ```
//!
//! `.ci/thumb.sh` sets up the compilers and emulators that these need.

mod answers;
mod budget;
mod firmware;
mod links;
mod measure;
mod model;
mod report;
#[path = "../../../tests/support/mod.rs"]
mod support;
mod trace;

use std::process::ExitCode;

type Error = Box<dyn std::error::Error + Send + Sync>;
type Result<T = (), E = Error> = std::result::Result<T, E>;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let result = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["--write-docs"] => report::write(),
        [] => budget::run(),
        ["--answers"] => answers::run(),
        ["--links"] => links::run(),
        _ => Err("usage: see src/main.rs".into()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
