//! Prints what the emulator tells the controller, what it has to answer, and when each pulse has to come: by
//! `trigger_ticks` on this machine, apart from the controller's own planning.

use serde_json::{Value, json};
use shutter_curve::{CurveError, ScheduleError, ShutterCurve};
use strobe::{CURVES, OVERHEAD, TICK_HZ};

/// What is armed: the settings of a frame, as this script knows them.
#[derive(Clone, Copy)]
struct Frame<'a> {
    curve: &'a ShutterCurve,
    pulses: u32,
    gap: u32,
    length: u32,
}

/// What is sent, and the answer that is to come before the next step, if one is.
type Line = (Vec<u8>, Option<String>);

/// A line that is accepted.
fn ok(line: &str, settings: &str) -> Line {
    (format!("{line}\n").into(), Some(format!("ok {settings}")))
}

/// A line that changes nothing.
fn refused(line: impl AsRef<[u8]>, reason: impl ToString) -> Line {
    ([line.as_ref(), b"\n"].concat(), Some(format!("refused: {}", reason.to_string())))
}

/// A curve that the crate refuses.
fn refused_curve(line: &str) -> Line {
    refused(line, curve(line).unwrap_err())
}

/// The curve of such a line.
fn curve(line: &str) -> Result<ShutterCurve, CurveError> {
    let numbers: Vec<f32> = line.split(' ').skip(1).map(|number| number.parse().unwrap()).collect();
    let (times, inner) = numbers.split_at(4);
    ShutterCurve::shutteropening(times.try_into().unwrap(), inner.try_into().unwrap())
}

/// Lines that are sent at once, with their answers.
fn lines(lines: &[Line]) -> Value {
    let bytes: Vec<u8> = lines.iter().flat_map(|(bytes, _)| bytes).copied().collect();
    let answers: Vec<&String> = lines.iter().filter_map(|(_, answer)| answer.as_ref()).collect();
    json!({ "send": bytes, "answers": answers })
}

/// A frame is started; the lines come while it is fired.
fn frame(frame: Frame, meanwhile: &[Line]) -> Value {
    let ticks: Vec<u32> = frame.curve.trigger_ticks(frame.pulses, TICK_HZ).unwrap().collect();
    let mut step = lines(meanwhile);
    step["frame"] = json!({ "ticks": ticks, "gap": frame.gap, "length": frame.length });
    step
}

/// What the crate says of a frame whose pulses are too close.
fn gap_error(frame: Frame) -> String {
    let mut ticks = vec![0; frame.pulses as usize];
    let error = frame.curve.schedule_into(&mut ticks, TICK_HZ, frame.gap).unwrap_err();
    let most = frame.curve.most_triggers(frame.pulses, TICK_HZ, frame.gap).unwrap();
    format!("{error}; up to n {most} it is kept")
}

const ASYMMETRIC: &str = "curve 0 0.002 0.004 0.009 0.05 0.1 0.15 1 0.6 1 0.7 0";
const BOX: &str = "curve 0 0 1e-3 1e-3 0 0.5 0 1 1 1 1 0.5";
const X: &[u8] = &[b'x'; 1000];
const DURATION: &str = "a duration is a whole number and ns, us, ms or s, below 34 s: 100us";
const PULSES: &str = "n takes a number of pulses, at least 1: n 32";
const UNKNOWN: &str = "unknown; there are n, gap, pulse, curve";
const NUMBERS: &str = "curve takes a number from 1 to 3, or twelve: open_start open_end close_start close_end \
                       t1 y1 t2 y2 t5 y5 t6 y6";

fn main() {
    let [soft, leaf, crystal] = &CURVES;
    let [asymmetric, abrupt] = &[curve(ASYMMETRIC).unwrap(), curve(BOX).unwrap()];

    let at_first = Frame { curve: soft, pulses: 12, gap: 12_500, length: 250 };
    let more = Frame { pulses: 32, ..at_first };
    let short = Frame { curve: leaf, gap: 2_500, ..more };
    let dense = Frame { curve: crystal, pulses: 64, length: 2, ..short };
    let built = Frame { curve: asymmetric, ..dense };
    // The state machine's least time from one pulse to the next: 125 us less 48 ns.
    let touching = Frame { curve: abrupt, pulses: 8, length: 15_619, ..built };
    let single = Frame { pulses: 1, ..touching };

    let too_close = gap_error(Frame { curve: leaf, ..more });
    let too_many = ScheduleError::CapacityExceeded { capacity: 64 };
    let too_long = gap_error(Frame { gap: 15_620 + 6, ..touching });
    let steps = [
        frame(at_first, &[ok("n 32", "n 32, gap 100us, pulse 2us, curve 1")]),
        frame(more, &[refused("curve 2", too_close)]),
        frame(
            more,
            &[
                ok("gap 20us", "n 32, gap 20us, pulse 2us, curve 1"),
                ok("curve 2", "n 32, gap 20us, pulse 2us, curve 2"),
            ],
        ),
        frame(short, &[]),
        lines(&[
            ok("  curve\t3 \r", "n 32, gap 20us, pulse 2us, curve 3"),
            ok("pulse 16ns", "n 32, gap 20us, pulse 16ns, curve 3"),
            ok("n 64", "n 64, gap 20us, pulse 16ns, curve 3"),
            refused("n 65", too_many),
        ]),
        // The frame that was armed before is fired first.
        frame(short, &[]),
        // Whatever comes in, it is answered, and nothing changes.
        lines(&[
            refused("n 0", PULSES),
            refused("n", PULSES),
            refused("n -1", PULSES),
            refused("n 1 2", PULSES),
            refused("n 4294967296", PULSES),
            refused("n 4294967295", too_many),
            refused("gap", DURATION),
            refused("gap 100", DURATION),
            refused("gap us", DURATION),
            refused("gap -1us", DURATION),
            refused("gap 1.5us", DURATION),
            refused("gap 35s", DURATION),
            refused("gap 99999999999999999999ns", DURATION),
            refused("gap 18446744073709551615s", DURATION),
            refused("gap 1\u{3bc}s", DURATION),
            refused("pulse 0ns", "a pulse takes at least 16ns"),
            refused("pulse", DURATION),
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
            refused("hello", UNKNOWN),
            refused("N 32", UNKNOWN),
            refused("\0\x01\x7f", UNKNOWN),
            refused(b"n \xff\xfe", "the line is not UTF-8"),
            refused(&X[..256], UNKNOWN),
            refused(&X[..257], "the line is longer than 256 bytes"),
            refused(X, "the line is longer than 256 bytes"),
        ]),
        // The curve takes a quarter of a second to build: meanwhile, frames come as they were, and bytes are lost.
        frame(dense, &[(format!("{ASYMMETRIC}\n").into(), None)]),
        frame(dense, &[]),
        lines(&[(X.into(), Some("ok n 64, gap 20us, pulse 16ns, curve of its own".into()))]),
        frame(dense, &[]),
        lines(&[refused(
            "",
            "bytes of the line were lost; wait for an answer before the next line",
        )]),
        frame(built, &[ok("n 8", "n 8, gap 20us, pulse 16ns, curve of its own")]),
        lines(&[
            ok(BOX, "n 8, gap 20us, pulse 16ns, curve of its own"),
            ok("pulse 124952ns", "n 8, gap 20us, pulse 124952ns, curve of its own"),
            refused("pulse 124960ns", too_long),
        ]),
        frame(Frame { pulses: 8, ..built }, &[]),
        frame(touching, &[ok("n 1", "n 1, gap 20us, pulse 124952ns, curve of its own")]),
        frame(single, &[]),
    ];
    // For the alarm beside it.
    let alarm: Vec<u32> = soft.trigger_ticks(32, TICK_HZ).unwrap().collect();
    println!("{}", json!({ "overhead": OVERHEAD, "steps": steps, "alarm": alarm }));
}
