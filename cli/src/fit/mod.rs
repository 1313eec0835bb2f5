#![allow(missing_docs)]
//! From a measured trace to the simplest shutter that serves.
pub mod bins;
pub mod curve;
pub mod errors;
pub mod frame;
mod hum;
pub mod ramp;
pub mod signal;
pub mod solve;
pub mod starts;
