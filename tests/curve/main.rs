//! Tests of the public interface, one file for each of its promises; those of what is private are in `tests/inside`.

#[path = "../support/mod.rs"]
mod support;

mod claims;
mod oracle_check;
mod promises;
mod properties;
mod refusals;
mod slips;
mod ticks;
