//! The tests of the program in one, which is compiled and linked once.

// Each test needs a part.
#[allow(dead_code)]
#[path = "../../../fit/tests/traces/generator.rs"]
mod generator;
#[allow(dead_code)]
#[path = "../../../fit/tests/traces/shutters.rs"]
mod shutters;

mod emit;
mod fit;
mod fuzz;
mod outputs;
mod plan;
mod scene_keys;
mod scenes;
mod session;
mod support;
mod sync;
mod times;
