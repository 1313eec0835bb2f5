//! What the crate costs on a microcontroller: figures of docs/internals/cost.md.

use serde::Serialize;

/// A call's cycles on typical shutters and the most that were found, on a Cortex-M4F by a model; and its code's bytes.
#[derive(Serialize)]
pub struct Cost {
    call: &'static str,
    typical: u32,
    worst: u32,
    code: u32,
}

include!(concat!(env!("OUT_DIR"), "/cost.rs"));
