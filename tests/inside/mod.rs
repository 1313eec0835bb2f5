//! Tests of what is not public, compiled into the crate's own test.

mod bound;
mod certificate;
mod left;
mod octave;
mod units;
