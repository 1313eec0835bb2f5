//! The tests of the program in one, which is compiled and linked once.

#[path = "../../../fit/tests/traces/generator.rs"]
mod generator;
#[path = "../../../fit/tests/traces/judge.rs"]
mod judge;

mod emit;
mod fit;
mod fuzz;
mod lamp;
mod outputs;
mod plan;
mod refusals;
mod scene_keys;
mod session;
mod support;
mod sync;
mod table;
mod times;
