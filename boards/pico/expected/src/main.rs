//! Prints what the emulator tells the controller, what it has to answer, and when each pulse has to come: by
//! `trigger_ticks` on this machine, apart from the controller's own planning.

mod frame;
mod from_trace;
mod hostile;
mod line;
mod plain;
mod shipped;
mod step;

use serde_json::json;
use strobe::{CURVES, OVERHEAD, TICK_HZ};

fn main() {
    let built = plain::Built::new();
    let mut steps = plain::stored();
    steps.extend(plain::built(&built));
    steps.extend(shipped::steps(plain::single(&built)));
    steps.extend(shipped::saves());
    steps.extend(from_trace::steps());
    // For the alarm beside it.
    let alarm: Vec<u32> = CURVES[0].trigger_ticks(32, TICK_HZ).unwrap().collect();
    println!("{}", json!({ "overhead": OVERHEAD, "steps": steps, "alarm": alarm }));
}
