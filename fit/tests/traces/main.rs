//! The tests of reading and fitting traces in one, which is compiled and linked once.

mod exports;
mod families;
mod files;
mod generator;
mod physics;
mod unseen;
