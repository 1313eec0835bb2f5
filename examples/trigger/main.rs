//! Firmware that plans and fires with the crate: a timer's interrupt places each pulse, and the clock judges it. It
//! runs on QEMU's board mps2-an386, a Cortex-M4F at 25 MHz:
//!
//! ```text
//! cargo trigger
//! ```
//!
//! It exits with 0 only if each pulse of each frame came once, at most `LATEST` ticks after its own tick and never
//! before, with the minimum gap kept, and if the counter wrapped within a frame. `TRIGGER_FAULT=lost` before the
//! command plants a fault, which the check has to see; `FAULTS` lists all.
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
         On this machine run another example: density or motion_blur."
    );
}
