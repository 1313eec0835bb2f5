// Made by `shutter plan` 0.2.0.
//
// scene        measured
// shutter      opens 4.247 to 6.8739, closes 10.959 to 12.958 ms after the sync
// times        T1 2.6269 ms opening, T2 4.0849 ms fully open, T3 1.9988 ms closing
// half open    TE 6.2364 ms, between the half openings
// exposure     TV 6.2541 ms, fully open for as much light
// efficiency   71.8 %
// trace        leaf.csv
// measured     exposure 6.2541 ± 0.0015 ms, efficiency at most 74.6 %
// timer        25000000 Hz
// delay        4.247 ms from the sync's rising edge to the start of opening
// known to     ± 0.15 ms to the opening, ± 0.0024 ms to any trigger
// gap          at least 0.1 ms; the closest two come 0.39088 ms apart
// set-up       emulated: equal flashes while the camera's own shutter stays open
// triggers     16; 62 keep the gap, 63 do not
// direct       no frame of up to 630 triggers needs a search
// drift        a tick a second moves the delay by 1 % of a share in 7542 frames

/// The timer's rate.
#[allow(dead_code)]
pub const TIMER_HZ: u32 = 25_000_000;

/// Which edge of the camera's sync counts: the falling one, or the rising one.
#[allow(dead_code)]
pub const SYNC_FALLS: bool = false;

/// So many flashes.
#[allow(dead_code)]
pub const COUNT: usize = 16;

/// From the edge of the camera's sync to the start of opening.
#[allow(dead_code)]
pub const DELAY_TICKS: u32 = 106_175;

/// So long after an edge no other one counts: the frame is over then, and lamp and sync are ready.
#[allow(dead_code)]
pub const HOLD_OFF_TICKS: u32 = 299_326;

/// When to trigger, counted from the start of opening.
#[allow(dead_code, clippy::unreadable_literal)]
#[rustfmt::skip]
pub const TICKS: [u32; COUNT] = [
    32391, 48161, 59197, 69077, 78849, 88621, 98394, 108166, 117938, 127710, 137482, 147254, 157026,
    166798, 176964, 190651,
];

/// When to switch flash `i` on, and when off, in ticks after the edge: it is `width` ticks long.
#[allow(dead_code)]
#[must_use]
pub const fn on_off(i: usize, width: u32) -> (u32, u32) {
    let on = DELAY_TICKS + TICKS[i];
    (on, on + width)
}

/// The timer's counts at which to trigger, where it counted `edge` at the edge of the camera's sync; they wrap. Take no
/// other edge for `HOLD_OFF_TICKS` after this one.
#[allow(dead_code)]
#[must_use]
pub fn due(edge: u32) -> impl ExactSizeIterator<Item = u32> {
    let at = move |ticks: u32| edge.wrapping_add(DELAY_TICKS).wrapping_add(ticks);
    TICKS.iter().map(move |&ticks| at(ticks))
}

use shutter_curve::{ShutterCurve, expect};

/// The shutter, its times in seconds.
#[allow(dead_code, clippy::unreadable_literal)]
#[rustfmt::skip]
pub static SHUTTER: ShutterCurve = expect!(ShutterCurve::shutteropening(
    [0.0, 0.0026268899, 0.0067117787, 0.008710602],
    [0.1227014, 0.0005208, 0.1941086, 0.9329666, 0.852301, 0.9329666, 0.9066354, 0.0005208],
));
