//! A strobe controller without its registers: lines of text become settings, settings become a frame of pulses in the
//! words that the board's state machine reads.
#![no_std]
#![forbid(unsafe_code)]

mod change;
mod curves;
mod duration;
#[cfg(feature = "faults")]
mod fault;
mod frame;
mod limits;
mod lines;
mod record;
mod refused;
mod settings;
pub mod store;

pub use change::{Change, Request};
pub use curves::CURVES;
#[cfg(feature = "faults")]
pub use fault::{Fault, is_planted, plant};
pub use frame::Frame;
pub use limits::{LATEST, LONGEST_FRAME, MIN_LOW, MIN_PULSE, MOST_PULSES, OVERHEAD, TICK_HZ};
pub use lines::{Broken, Lines};
pub use refused::Refused;
pub use settings::{Curve, Edge, Frames, Light, Numbers, Settings};

/// docs/firmware.md's code, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../../../docs/firmware.md")]
mod firmware_guide {}
