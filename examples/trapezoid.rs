//! A trapezoid with triggers: when to flash so that each flash stands for an equal share of the exposure.
//!
//! `cargo run --example trapezoid`

use shutter_curve::{ScheduleError, ShutterCurve, expect_valid};

/// In seconds: starts to open, is open, starts to close, is closed. A `static` is built by the compiler.
static SHUTTER: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
/// The timer counts microseconds, and the lamp needs 0.5 ms between two flashes.
const TICK_HZ: u32 = 1_000_000;
const MIN_GAP: u32 = 500;

fn main() -> Result<(), ScheduleError> {
    let mut ticks = [0; 12];
    SHUTTER.ticks_into(&mut ticks, TICK_HZ, MIN_GAP)?;
    println!("flash  tick, µs   gap  openness  collected");
    let mut last = 0;
    for (i, tick) in ticks.into_iter().enumerate() {
        let t = tick as f32 / TICK_HZ as f32;
        let gap = tick - last;
        println!("{i:5} {tick:9} {gap:5} {:9.2} {:10.4}", SHUTTER.openness(t), SHUTTER.cdf(t));
        last = tick;
    }
    // More would come closer than the lamp allows: this says how many do not, and a schedule refuses them.
    let most = SHUTTER.max_triggers(64, TICK_HZ, MIN_GAP)?;
    println!("\nof 64 flashes at most {most} keep the gap");
    if let Err(error) = SHUTTER.ticks_into(&mut [0; 64], TICK_HZ, MIN_GAP) {
        println!("a schedule of 64 is refused: {error}");
    }
    Ok(())
}
