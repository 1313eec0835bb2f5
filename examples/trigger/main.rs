//! Firmware that triggers: a frame's pulses, each placed and fired by a timer's interrupt and
//! checked against the clock. It runs on the mps2-an386 board, a Cortex-M4F at 25 MHz, that QEMU has:
//!
//! ```text
//! cargo trigger
//! ```
//!
//! It exits with 0 only if every pulse of every frame came once, in order, with the minimum gap kept, never before its
//! tick and the delay after the edge of the camera's sync and at most `LATEST` ticks after that, and if the counter
//! wrapped within a frame.
//! `TRIGGER_FAULT=lost` (or `twice`, `early`, `late`, `close`, `nodelay`, `nowrap`) before that command plants such
//! a fault, which the check sees: it exits with 1. With 2 if the fault is another one.
#![cfg_attr(target_os = "none", no_std, no_main)]
// Registers are written, as they must be, in `board` alone; the entry and the handler take unsafe attributes.
#![cfg_attr(target_os = "none", allow(unsafe_code))]

#[cfg(target_os = "none")]
mod board;
#[cfg(target_os = "none")]
mod firmware;
/// A measured leaf shutter: `shutter fit cli/traces/leaf.csv --sync 0`, then `shutter plan --emit rust` for this
/// board's timer.
#[cfg(target_os = "none")]
mod measured;

#[cfg(not(target_os = "none"))]
fn main() {
    eprintln!(
        "This is firmware for a Cortex-M4F. Type this to run it in QEMU; what it needs is fetched into a cache:\n\n    \
         .ci/thumb.sh cargo trigger\n\n\
         On this machine run another example: density, trapezoid or motion_blur."
    );
}
