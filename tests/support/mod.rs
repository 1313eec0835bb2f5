//! What tests and benchmarks share; each takes it in with `mod support`, the benchmarks by its path.
#![allow(dead_code)] // Each user needs a part.

pub mod curves;
pub mod families;
pub mod oracle;
pub mod promise;
pub mod questions;

/// How many times as many random curves are tried: `TIMES=16` before a command, as CI has it.
pub fn times() -> u64 {
    std::env::var("TIMES").map_or(1, |times| times.parse().expect("a whole number"))
}
