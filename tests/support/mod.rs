//! What tests and benchmarks share; each takes it in with `mod support`, the benchmarks by its path.
#![allow(dead_code)] // Each user needs a part.

pub mod aimed;
pub mod baseline;
pub mod cases;
pub mod curves;
pub mod oracle;
pub mod peers;
pub mod promise;
pub mod rendering;
