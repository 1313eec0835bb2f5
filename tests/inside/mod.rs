//! Tests of what is not public, compiled into the crate's own test.

#[path = "../support/mod.rs"]
mod support;

mod certificate;
mod exact;
