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
mod settings;

pub use change::{Change, Refused};
pub use curves::CURVES;
#[cfg(feature = "faults")]
pub use fault::plant;
pub use frame::Frame;
pub use limits::{LONGEST_FRAME, MIN_LOW, MIN_PULSE, OVERHEAD, TICK_HZ};
pub use lines::{Broken, Lines};
pub use settings::Settings;

/// docs/firmware.md's code, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../../../docs/firmware.md")]
mod firmware_guide {}
