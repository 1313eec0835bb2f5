//! A trapezoid with triggers: when to flash so that each flash stands for an equal share of the exposure.
//!
//! `cargo run --example trapezoid`

use shutter_curve::{Hz, ShutterCurve, TimedCurve, expect};

/// In seconds: starts to open, is open, starts to close, is closed. A `static` is built by the compiler.
static SHUTTER: ShutterCurve = expect!(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
/// The timer counts microseconds, and the lamp needs 0.5 ms between two flashes.
const FLASH: TimedCurve = expect!(SHUTTER.at(Hz(1_000_000))).min_gap(500);
const TICKS: [u32; 12] = expect!(FLASH.ticks());

fn main() {
    println!("flash  tick, µs   gap  openness  collected");
    let mut last = 0;
    for (i, tick) in TICKS.into_iter().enumerate() {
        let t = tick as f32 / 1e6;
        let gap = tick - last;
        println!("{i:5} {tick:9} {gap:5} {:9.2} {:10.4}", SHUTTER.openness(t), SHUTTER.cdf(t));
        last = tick;
    }
    // More would come closer than the lamp allows: this says how many do not, and a schedule refuses them.
    println!("\nof 64 flashes {} keep the gap", FLASH.max_triggers(64));
    if let Err(error) = FLASH.ticks::<64>() {
        println!("a frame of 64 is refused: {error}");
    }
}
