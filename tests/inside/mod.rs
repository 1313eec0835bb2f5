//! Tests of what is not public, compiled into the crate's own test.

mod bound;
mod cdf;
mod certificate;
mod left;
mod octave;
mod transcribed;
