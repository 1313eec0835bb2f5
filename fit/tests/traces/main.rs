//! The tests of reading and fitting traces in one, which is compiled and linked once.

// Some of what is not public, each with its own test.
#[allow(dead_code)]
#[path = "../../src/curve.rs"]
mod curve;
#[allow(dead_code)]
#[path = "../../src/trace/names.rs"]
mod names;
#[allow(dead_code)]
#[path = "../../src/ramp.rs"]
mod ramp;
use shutter_fit::unit;

mod exports;
mod families;
mod files;
mod generator;
mod integral;
mod judge;
mod physics;
mod picture;
mod shutters;
mod words;
