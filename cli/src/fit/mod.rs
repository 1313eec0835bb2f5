//! From a measured trace to the simplest shutter that serves.
pub mod curve;
pub mod ramp;
