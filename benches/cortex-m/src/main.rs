//! What the crate costs on a microcontroller: instructions, cycles, bytes and stack.
//!
//! ```text
//! cargo run --release -- --budgets    # on a Cortex-M4F and a Cortex-M0+; exits with 1 where one is broken
//! cargo run --release -- --write-docs # tables of five processors, in ../../docs/internals/cost.md; some minutes
//! cargo run --release -- --answers    # do answers differ on the host and on other processors?
//! cargo run --release -- --links      # a firmware that links only if nothing can panic, at every level
//! ```
//!
//! It needs the targets of `.ci/matrix.sh`, qemu-system-arm, QEMU's user mode and llvm-objdump, all of which that
//! script sets up, and Node.js.

mod answers;
mod budget;
mod disassembly;
mod firmware;
mod links;
mod measure;
mod model;
mod report;
mod trace;

use std::process::ExitCode;

type Error = Box<dyn std::error::Error + Send + Sync>;
type Result<T = (), E = Error> = std::result::Result<T, E>;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let result = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["--write-docs"] => report::write(),
        ["--budgets"] => budget::run(),
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
