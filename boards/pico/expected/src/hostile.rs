//! Lines that are answered, and change nothing, whatever they hold.

use shutter_curve::ScheduleError;
use strobe::TICK_HZ;

use crate::frame::Frame;
use crate::line::{Line, refused};
use crate::step::curve;

/// All of them, for a board whose frame is this.
pub fn lines(frame: Frame) -> Vec<Line> {
    let mut lines = durations();
    lines.extend(curves());
    lines.extend(words());
    lines.push(refused("frames 2 1us", overlap(frame)));
    lines.extend(bytes());
    lines
}

/// A line that is too long.
pub const LONG: &[u8] = &[b'x'; 1000];
const DURATION: &str = "a duration is a number and ns, us, ms or s, below 34 s: 100us, 4.247ms";
const PULSES: &str = "n takes a number of pulses, at least 1: n 32";
const UNKNOWN: &str = "unknown; there are n, gap, pulse, duty, delay, edge, frames, curve, save, ?";
const NUMBERS: &str = "curve takes a number from 1 to 3, or open_start open_end close_start close_end, and t1 y1 t2 y2 t5 \
                       y5 t6 y6 unless the ramps are straight";
const DUTY: &str = "duty takes a number above 0 and at most 1: duty 0.3";
const EDGE: &str = "edge takes rising or falling";
const FRAMES: &str =
    "frames takes 1, or a number and the time from one frame to the next: frames 3 20ms";
const ALONE: &str = "nothing may follow this word";

/// A curve that the crate refuses.
fn refused_curve(line: &str) -> Line {
    refused(line, curve(line).unwrap_err())
}

/// What is said of frames that follow each other too closely.
fn overlap(frame: Frame) -> String {
    let ticks: Vec<u32> = frame.curve.trigger_ticks(frame.pulses, TICK_HZ).unwrap().collect();
    let least = ticks[ticks.len() - 1] - ticks[0] + frame.gap;
    format!("from one frame to the next at least {}ns are required", 8 * least)
}

/// Numbers of pulses, and durations.
fn durations() -> Vec<Line> {
    vec![
        refused("n 0", PULSES),
        refused("n", PULSES),
        refused("n -1", PULSES),
        refused("n 1 2", PULSES),
        refused("n 4294967296", PULSES),
        refused("n 4294967295", ScheduleError::CapacityExceeded { capacity: 64 }),
        refused("gap", DURATION),
        refused("gap 100", DURATION),
        refused("gap us", DURATION),
        refused("gap -1us", DURATION),
        refused("gap 1.us", DURATION),
        refused("gap 35s", DURATION),
        refused("gap 99999999999999999999ns", DURATION),
        refused("gap 18446744073709551615s", DURATION),
        refused("gap 1\u{3bc}s", DURATION),
        refused("pulse 0ns", "a pulse takes at least 16ns"),
        refused("pulse", DURATION),
    ]
}

/// Curves.
fn curves() -> Vec<Line> {
    vec![
        refused("curve", NUMBERS),
        refused("curve 0", NUMBERS),
        refused("curve 4", NUMBERS),
        refused("curve 1 1", NUMBERS),
        refused("curve 0 1 2 3 4 5 6 7 8 9 10", NUMBERS),
        refused("curve 0 1 2 3 4 5 6 7 8 9 10 11 12", NUMBERS),
        refused("curve 0 1 2 3 4 5 6 7 8 9 10 x", NUMBERS),
        refused_curve("curve nan 1 2 3 .1 0 .2 1 .7 1 .9 0"),
        refused_curve("curve 0 1 2 3 .1 0 .2 1 .7 1 1e99 0"),
        refused_curve("curve 0 2 1 3 .1 0 .2 1 .7 1 .9 0"),
        refused_curve("curve 0 1 2 3 .1 0 .2 2 .7 1 .9 0"),
        refused("curve 0 1 2", NUMBERS),
        refused("curve 0 1 2 3 4", NUMBERS),
        refused_curve("curve 0 2 1 3"),
    ]
}

/// What is not as it is to be written.
fn words() -> Vec<Line> {
    vec![
        refused("duty", DUTY),
        refused("duty 0", DUTY),
        refused("duty 1.01", DUTY),
        refused("duty nan", DUTY),
        refused("duty 30%", DUTY),
        refused("delay", DURATION),
        refused("delay -1ms", DURATION),
        refused("delay 1e-3s", DURATION),
        refused("delay 18s", "a pulse comes at most 17 s after the edge"),
        refused("edge", EDGE),
        refused("edge up", EDGE),
        refused("edge rising falling", EDGE),
        refused("frames", FRAMES),
        refused("frames 0", FRAMES),
        refused("frames 3", FRAMES),
        refused("frames 1 20ms", FRAMES),
        refused("frames 3 20", FRAMES),
        refused("frames 3 20ms 1", FRAMES),
        refused("frames 17 20ms", "one edge starts at most 1024 pulses"),
        refused("frames 3 8.6s", "a pulse comes at most 17 s after the edge"),
        refused("? n", ALONE),
        refused("save 1", ALONE),
    ]
}

/// Other words, and other bytes.
fn bytes() -> Vec<Line> {
    vec![
        refused("hello", UNKNOWN),
        refused("N 32", UNKNOWN),
        refused("\0\x01\x7f", UNKNOWN),
        refused(b"n \xff\xfe", "the line is not UTF-8"),
        refused(&LONG[..256], UNKNOWN),
        refused(&LONG[..257], "the line is longer than 256 bytes"),
        refused(LONG, "the line is longer than 256 bytes"),
    ]
}
