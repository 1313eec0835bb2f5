//! A strobe controller without its registers: lines of text become settings, settings become a frame of pulses in the
//! words that the board's state machine reads.
#![no_std]
#![forbid(unsafe_code)]

mod change;
mod duration;
mod fault;
mod frame;
mod lines;
mod settings;

pub use change::{Change, Refused};
pub use frame::{Frame, LONGEST_FRAME, MIN_LOW, MIN_PULSE, OVERHEAD};
pub use lines::{Broken, Lines};
pub use settings::{CURVES, Settings};

/// The rate at which the state machine runs, and so the unit of every duration: 8 ns.
pub const TICK_HZ: u32 = 125_000_000;

/// docs/firmware.md's code, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../../../docs/firmware.md")]
mod firmware_guide {}
