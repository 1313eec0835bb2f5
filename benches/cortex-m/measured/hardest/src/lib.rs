//! What the build script found: the curves of the tests' reference data and their hard cases, each with its hard
//! inputs.

/// As Rust.
pub const CURVES: &str = include_str!(concat!(env!("OUT_DIR"), "/curves.rs"));
