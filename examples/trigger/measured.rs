// Made by `shutter plan` 0.2.0.
//
// scene        measured
// shutter      opens from 4.247 to 6.8739, closes from 10.959 to 12.958 ms
// times        T1 2.6269 ms opening, T2 4.0849 ms fully open, T3 1.9988 ms closing
// half open    TE 6.2364 ms, between the half openings
// exposure     TV 6.2541 ms, fully open for as much light
// efficiency   71.8 %
// timer        25000000 Hz
// delay        4.247 ms from the sync's edge to the start of opening
// gap          at least 0.1 ms; the closest two come 0.39088 ms apart
// set-up       emulated: equal flashes while the camera's own shutter stays open
// triggers     16; up to 62 keep the gap
// direct       frames of up to 630 triggers never need a search

#![allow(dead_code, clippy::unreadable_literal)]

use shutter_curve::{ShutterCurve, valid};

/// The shutter, its times in seconds.
#[rustfmt::skip]
pub static SHUTTER: ShutterCurve = valid(ShutterCurve::shutteropening(
    [0.0042470167, 0.006873907, 0.010958795, 0.0129576195],
    [0.1227014, 0.0005208, 0.1941086, 0.9329666, 0.8523011, 0.9329666, 0.9066354, 0.0005208],
));

/// The timer's rate.
pub const TIMER_HZ: u32 = 25000000;

/// From the edge of the camera's sync to the start of opening.
pub const DELAY_TICKS: u32 = 106175;

/// When to trigger. Ticks count from the start of opening, which comes [`DELAY_TICKS`] after the edge of the camera's sync; add both to the timer's count at the edge, wrapping.
#[rustfmt::skip]
pub const TICKS: [u32; 16] = [
    32391, 48161, 59197, 69077, 78849, 88621, 98394, 108166, 117938, 127710, 137482, 147254, 157026,
    166798, 176964, 190651,
];
