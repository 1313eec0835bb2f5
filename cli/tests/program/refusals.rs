//! What is wrong with a scene is refused at its line, in words that say what would be right; and what is just right is
//! not.

use shutter::planned::Planned;

/// At 3/4 s of exposure and a gap of 1/10 s, 7 triggers are sure.
pub const TRAPEZOID: &str = "open_start = 0.0\nopen_end = 0.25\nclose_start = 0.75\nclose_end = 1.0\ntriggers = 7\n\
                             timer_hz = 1000\nmin_gap = 0.1\n";
pub const BOX: &str =
    "open_start = 0\nopen_end = 0\nclose_start = 1\nclose_end = 1\ntriggers = 4\ntimer_hz = 1000\nmin_gap = 0.1\n";
/// Opens in 1 ms, is open for 4, closes in 2.
pub const LEAF: &str =
    "unit = 'ms'\nopen_start = 1\nopen_end = 2\nclose_start = 6\nclose_end = 8\nmin_gap = 0\ntriggers = 4\n";
/// Its frame ends 12.9576195 ms after the edge.
pub const MEASURED: &str = include_str!("../../scenes/measured.toml");
pub const TIMES: &str = "unit = 'ms'\nopen_start = 4.1\ntimer_hz = 1_000_000\nmin_gap = 0.1\n\
                         trigger_times = [\n  5.0, 5.5,\n  6.1004,\n]\n";

/// A scene with changes, parted by `; `: `KEY = VALUE` in place of the key's line or below all, `KEY` without it, `A ->
/// B`.
pub fn with(scene: &str, changes: &str) -> String {
    let mut text = scene.to_string();
    for change in changes.split("; ").filter(|change| !change.is_empty()) {
        if let Some((from, to)) = change.split_once(" -> ") {
            assert!(text.contains(from), "{from}\n{text}");
            text = text.replace(from, to);
            continue;
        }
        let (key, value) = change.split_once(" = ").unwrap_or((change, ""));
        let line = if value.is_empty() { String::new() } else { format!("{change}\n") };
        match text.lines().find(|line| line.split(" = ").next() == Some(key)) {
            Some(old) => text = text.replace(&format!("{old}\n"), &line),
            None => text += &line,
        }
    }
    text
}

/// What is to be told of a scene: the reason, at the last line that begins so.
fn expected(text: &str, line: &str, reason: &str) -> String {
    let is_at = |it: &(usize, &str)| it.1.trim_start().starts_with(line);
    match text.lines().enumerate().filter(is_at).last() {
        _ if line.is_empty() => format!("a.toml: {reason}"),
        Some((k, source)) => format!("a.toml:{0}: {reason}\n  {0} | {source}", k + 1),
        None => panic!("no line begins with {line}:\n{text}"),
    }
}

const HZ: &str = "timer_hz: a rate from 1 to 4294967295 is required";
const COUNT: &str = "triggers: a whole number from 1 to 10000 is required";
const ORDER: &str = "times out of order: open_start <= open_end <= close_start <= close_end is required";
const UNIT: &str = "unit: \"s\", \"ms\", \"us\" or \"ns\" is required";
const FLASHES: &str = "fully_open: it is for flashes whose length is the lamp's own, and this scene makes pulses";
const LATE: &str =
    "delay: the frame ends more than 2^31 ticks after the edge; with up to 2147482648 ticks of delay it does not";

/// The scene, what is changed, how the line begins that is at fault, and the reason; for `…` there may be any words.
/// Without a reason it is planned.
#[rustfmt::skip]
const SCENES: &[(&str, &str, &str, &str)] = &[
    (TRAPEZOID, "", "", ""),
    (TRAPEZOID, "shutteropening = [0.1, 0, 0.15, 1, 0.85, 1, 0.9, 0]", "", ""),
    // Keys and values.
    ("", "", "", "missing field `open_start`"),
    (TRAPEZOID, "open_start", "", "missing field `open_start`"),
    (TRAPEZOID, "min_gap", "", "missing field `min_gap`"),
    (TRAPEZOID, "colour = 3", "colour", "unknown field `colour`, expected one of `unit`, `open_start`…\
        `sync_falls`, `lamp_lag`, `set_up`, `fully_open`, `trigger_times`"),
    (TRAPEZOID, "min_gap = 0.1 -> min_gap = 0.1\ntriggers = 3", "triggers", "duplicate key"),
    (TRAPEZOID, "triggers = = 3", "triggers", "…"),
    (TRAPEZOID, "open_end = \"soon\"", "open_end", "open_end: a number is required"),
    (TRAPEZOID, "close_end = true", "close_end", "close_end: a number is required"),
    (TRAPEZOID, "timer_hz = 'fast'", "timer_hz", "timer_hz: a number is required"),
    (TRAPEZOID, "min_gap = \"\"", "min_gap", "min_gap: a number is required"),
    (TRAPEZOID, "shutteropening = 0.5", "shutteropening", "shutteropening: numbers in brackets are required"),
    (TRAPEZOID, "shutteropening = [0, 1, 'x']", "shutteropening", "shutteropening: a number is required"),
    (TRAPEZOID, "unit = 3", "unit", UNIT),
    (TRAPEZOID, "unit = 'min'", "unit", UNIT),
    (LEAF, "set_up = 'xenon'", "set_up", "set_up: \"emulated\" or \"in_path\" is required"),
    (LEAF, "delay = 1; sync_falls = 1", "sync_falls", "sync_falls: true or false is required"),
    (LEAF, "sync_falls = true", "sync_falls", "sync_falls: it goes with a delay"),
    // Numbers out of range.
    (TRAPEZOID, "triggers = 0", "triggers", COUNT),
    (TRAPEZOID, "triggers = 4.5", "triggers", COUNT),
    (TRAPEZOID, "triggers = -1", "triggers", COUNT),
    (TRAPEZOID, "triggers = 10_001", "triggers", COUNT),
    (TRAPEZOID, "min_gap = -0.1", "min_gap", "min_gap: 0 or more is required"),
    (TRAPEZOID, "min_gap = inf", "min_gap", "min_gap: a finite number is required"),
    (TRAPEZOID, "min_gap = nan", "min_gap", "min_gap: a finite number is required"),
    (TRAPEZOID, "shutteropening = [0.1, 0.0, 0.2, 1.0, 0.8, 1.0, 0.9]", "shutteropening",
        "shutteropening: 8 numbers are required, not 7"),
    (TRAPEZOID, "shutteropening = [0.1, 0.0, 0.2, 1.0, 0.8, 1.0, 0.9, 0.0, 0.0]", "shutteropening",
        "shutteropening: 8 numbers are required, not 9"),
    (TRAPEZOID, "shutteropening = [nan, 0, 0.15, 1, 0.85, 1, 0.9, 0]", "shutteropening",
        "shutteropening: a finite number is required"),
    (TRAPEZOID, "shutteropening = [0.1, 0, 0.15, 1, 0.85, 1, 0.9, 1e39]", "shutteropening",
        "shutteropening: a finite number is required"),
    (TRAPEZOID, "timer_hz = 0", "timer_hz", HZ),
    (TRAPEZOID, "timer_hz = 0.4", "timer_hz", HZ),
    (TRAPEZOID, "timer_hz = -1", "timer_hz", HZ),
    (TRAPEZOID, "timer_hz = nan", "timer_hz", HZ),
    (TRAPEZOID, "timer_hz = 5_000_000_000", "timer_hz", HZ),
    (TRAPEZOID, "timer_hz = 2147483649", "timer_hz",
        "timer_hz: the interval is longer than 2^31 ticks; up to 2147483648 Hz it is not"),
    (BOX, "nominal = 0", "nominal", "nominal: more than 0 is required"),
    (BOX, "nominal = inf", "nominal", "nominal: a finite number is required"),
    // Curves.
    (TRAPEZOID, "open_start = nan", "open_start", "open_start: a finite number is required"),
    (TRAPEZOID, "close_end = -inf", "close_end", "close_end: a finite number is required"),
    (TRAPEZOID, "close_end = 1e39", "close_end", "close_end: it is beyond f32 (3.4e38 s)"),
    (TRAPEZOID, "open_start = 0.3", "open_end", ORDER),
    (TRAPEZOID, "open_end = 0.8", "close_start", ORDER),
    (TRAPEZOID, "close_end = 0.7", "close_end", ORDER),
    (TRAPEZOID, "close_end = 1e30", "close_end",
        "the interval is shorter than 2^-64 (5.4e-20) or longer than 2^64 (1.8e19); it lasts 1e30 s"),
    (LEAF, "open_start = 0; open_end = 1e-9; close_start = 0.75; close_end = 1", "open_end",
        "opening ramp: it is shorter than \
        2^-24 of the greatest time; make it longer, or give it no length; it lasts 1e-9 ms"),
    (LEAF, "open_start = -1; open_end = -0.5; close_start = -1e-9; close_end = 0", "close_end",
        "closing ramp: it is shorter than 2^-24 …"),
    (LEAF, "open_start = -1; open_end = 0; close_start = 1e-9; close_end = 1", "close_start",
        "plateau: it is shorter than 2^-24 …"),
    (LEAF, "open_start = 131071000; open_end = 131071000; close_start = 131072000; close_end = 131072000", "close_end",
        "the interval is too short for its distance from time 0: below 2^-16 of its greatest time; count times \
         from a nearer origin; it lasts 1000 ms"),
    (TRAPEZOID, "= 0. -> = 1_700_000_000.; close_end = 1_700_000_001.0", "open_end",
        "open_end: f32 is off by 25 % of the interval here; count the times from nearer to open_start"),
    // Triggers that are too close: they come at 265.625 and 359.375 ticks, and two on one tick though no gap is asked
    // for.
    (TRAPEZOID, "triggers = 8", "triggers",
        "triggers 1 and 2 come 93 ticks apart, and 100 are required; 7 triggers keep that"),
    (TRAPEZOID, "timer_hz = 6; min_gap = 0", "triggers",
        "triggers 1 and 2 come 0 ticks apart, and 1 is required; 5 triggers keep that"),
    (TRAPEZOID, "triggers = 2; min_gap = 0.5", "triggers",
        "triggers 0 and 1 come 375 ticks apart, and 500 are required; 1 trigger keeps that"),
    (LEAF, "triggers = 5; min_gap = 1.2", "triggers",
        "triggers 0 and 1 come 1.1 ms apart, and 1.2 ms is required; 4 triggers keep that"),
    // 0.1 s is 100 ticks, though no binary fraction is 0.1; and 99.9 ticks need 100, 100.1 need 101.
    (BOX, "triggers = 10; min_gap = 0.1", "", ""),
    (BOX, "triggers = 10; min_gap = 0.099", "", ""),
    (BOX, "triggers = 10; min_gap = 0.0999", "", ""),
    (BOX, "triggers = 10; min_gap = 0.1001", "triggers",
        "triggers 0 and 1 come 100 ticks apart, and 101 are required…"),
    // Timers: a prime has no prescaler that leaves a whole rate.
    (MEASURED, "timer_hz = 84_000_000; timer_bits = 16", "timer_bits",
        "timer_bits: the frame ends at tick 1088440, and with 16 bits \
        it may end at 32768 at the latest; a prescaler of 35 fits: timer_hz = 2400000"),
    (MEASURED, "timer_hz = 83_999_971; timer_bits = 16", "timer_bits",
        "…a prescaler of 34 fits: timer_hz = 2470587.382"),
    (MEASURED, "timer_bits = 24", "timer_bits", "timer_bits: 16 or 32 is required"),
    (TIMES, "timer_hz = 1000; timer_bits = 16; delay = 1000; 5.0, 5.5,\n  6.1004 -> 5000, 31772", "", ""),
    (TIMES, "timer_hz = 1000; timer_bits = 16; delay = 1000; 5.0, 5.5,\n  6.1004 -> 5000, 31773", "timer_bits",
        "timer_bits: the frame ends at tick 32769,…"),
    // Delays. The frame takes 1000 ticks of 1 kHz; 2^31 - 1000 are left for the delay.
    (TRAPEZOID, "delay = -1e-9", "delay", "delay: 0 or more is required; an edge cannot trigger what comes before it"),
    (TRAPEZOID, "delay = nan", "delay", "delay: a finite number is required"),
    (TRAPEZOID, "delay = inf", "delay", "delay: a finite number is required"),
    (TRAPEZOID, "delay = -inf", "delay", "delay: a finite number is required"),
    (TRAPEZOID, "delay = \"soon\"", "delay", "delay: a number is required"),
    (TRAPEZOID, "delay = 2147482.648", "", ""),
    (TRAPEZOID, "delay = 2147482.6486", "delay", LATE),
    (TRAPEZOID, "delay = 1e300", "delay", LATE),
    (TRAPEZOID, "delay_spread = 0.1", "delay_spread", "delay_spread: 0 or more is required, and a delay"),
    (TRAPEZOID, "delay = 1; delay_spread = -1", "delay_spread", "delay_spread: 0 or more is required, and a delay"),
    // Pulses.
    (BOX, "pulse = 0", "pulse", "pulse: more than 0 is required"),
    (BOX, "pulse = -1", "pulse", "pulse: more than 0 is required"),
    (BOX, "pulse = nan", "pulse", "pulse: a finite number is required"),
    (BOX, "pulse = 'x'", "pulse", "pulse: a number is required"),
    (BOX, "pulse = 0.0004", "pulse", "pulse: it is less than half a tick of 1000 Hz"),
    (BOX, "duty = 0", "duty", "duty: above 0 and at most 1 is required"),
    (BOX, "duty = 1.001", "duty", "duty: above 0 and at most 1 is required"),
    (BOX, "duty = nan", "duty", "duty: above 0 and at most 1 is required"),
    (BOX, "min_pulse = 0.1", "min_pulse", "min_pulse: it goes with duty, which makes pulses of many lengths"),
    (BOX, "duty = 0.5; pulse = 0.1", "duty",
        "duty and pulse: a scene has one of them (pulse where the curve is emulated, duty where \
        the shutter is in the light's path)"),
    (BOX, "pulse = 0.2", "pulse",
        "pulses of 200 ticks: pulses 0 and 1 come 50 ticks apart, and 100 are required; those of up to 150 \
        ticks fit, or 3 triggers keep that"),
    (BOX, "pulse = 0.3", "pulse",
        "pulses of 300 ticks: pulses 0 and 1 overlap by 50 ticks, and 100 are required; those of up to 150 \
        ticks fit, or 2 triggers keep that"),
    (BOX, "pulse = 1e30", "pulse",
        "pulses of 4294967295 ticks: pulses 0 and 1 overlap by 4294967045 ticks, and 100 are required; \
        those of up to 150 ticks fit"),
    (BOX, "duty = 0.8", "triggers",
        "pulses 0 and 1 come 50 ticks apart, and 100 are required; 2 triggers keep that; a smaller \
        duty leaves more"),
    (BOX, "duty = 0.5; min_pulse = 0.2", "triggers",
        "pulse 0 lasts 125 ticks, and 200 are required; 2 triggers keep that; a \
        greater duty lasts longer"),
    (BOX, "duty = 1e-9", "triggers",
        "pulse 0 lasts 0 ticks, and 1 is required; no number of triggers keeps that; a greater duty lasts \
        longer"),
    // A single pulse that just fits, or is too long for the time before its trigger, after it, or for both.
    (BOX, "triggers = 1; close_start = 0; pulse = 0.587", "", ""),
    (BOX, "triggers = 1; close_start = 0; pulse = 0.588", "pulse",
        "pulses of 588 ticks: they reach beyond the time that the shutter is open; those of up to 587 ticks fit"),
    (BOX, "triggers = 1; open_end = 1; pulse = 0.586", "", ""),
    (BOX, "triggers = 1; open_end = 1; pulse = 0.587", "pulse",
        "pulses of 587 ticks: they reach beyond the time that the shutter is open; those of up to 586 ticks fit"),
    (BOX, "triggers = 1; pulse = 1", "", ""),
    (BOX, "triggers = 1; pulse = 1.001", "pulse",
        "pulses of 1001 ticks: they reach beyond the time that the shutter is open; those of up to 1000 ticks fit"),
    // What is for the other set-up, and a plateau that has no room.
    (LEAF, "set_up = 'emulated'; duty = 0.5", "duty",
        "duty: it is for a shutter in the light's path, and set_up is \"emulated\"; \
        there, `pulse` makes equal pulses"),
    (LEAF, "set_up = 'emulated'; fully_open = true", "fully_open",
        "fully_open: it is for a shutter in the light's path, and set_up is \
        \"emulated\"; there, flashes come at the triggers"),
    (LEAF, "duty = 0.5; fully_open = true", "fully_open", FLASHES),
    (LEAF, "pulse = 0.1; fully_open = true", "fully_open", FLASHES),
    (LEAF, "close_start = 2; fully_open = true", "fully_open",
        "fully_open: this shutter begins to close as soon as it is open"),
    // No tick is rounded to where the shutter moves.
    (LEAF, "triggers = 1; timer_hz = 100; set_up = 'in_path'; fully_open = true", "triggers",
        "the frame does not fit; no number of triggers keeps that"),
    // A lamp's lag. Without a delay it may take all that comes before the first trigger.
    (LEAF, "timer_hz = 1_000_000; set_up = 'in_path'; fully_open = true; lamp_lag = 1.5", "", ""),
    (LEAF, "timer_hz = 1_000_000; set_up = 'in_path'; fully_open = true; lamp_lag = 1.6", "lamp_lag",
        "lamp_lag: the first trigger would come 0.1 ms before the start of opening, from where ticks count without \
        a delay; a lag of 1.5 ms is the most"),
    (LEAF, "timer_hz = 1_000_000; set_up = 'in_path'; fully_open = true; delay = 2; lamp_lag = 3.75", "lamp_lag",
        "lamp_lag: the first trigger would come 0.25 ms before the edge of the sync; a lag of 3.5 ms is the most"),
    (LEAF, "lamp_lag = -1", "lamp_lag", "lamp_lag: 0 or more is required"),
    (LEAF, "lamp_lag = inf", "lamp_lag", "lamp_lag: a finite number is required"),
    (TIMES, "lamp_lag = 0.9", "", ""),
    (TIMES, "lamp_lag = 1", "lamp_lag", "lamp_lag: the first trigger would come 0.1 ms before the start of opening…"),
    // Times without a curve.
    (TIMES, "close_end = 9", "close_end",
        "close_end: it is a curve's, and the triggers of this scene are given by their times"),
    (TIMES, "shutteropening = 9", "shutteropening",
        "shutteropening: it is a curve's, and the triggers of this scene are given by their times"),
    (TIMES, "triggers = 3", "triggers", "triggers: their number is that of trigger_times"),
    (TIMES, "pulse = 0.1", "pulse",
        "pulse: pulses are checked against a curve, and a scene with trigger_times has none"),
    (TIMES, "duty = 0.1", "duty", "duty: pulses are checked against a curve, and a scene with trigger_times has none"),
    (TIMES, "min_pulse = 0.1", "min_pulse",
        "min_pulse: pulses are checked against a curve, and a scene with trigger_times has none"),
    (TIMES, "fully_open = true", "fully_open",
        "fully_open: when the shutter is fully open is a curve's, and this scene has none"),
    (TIMES, "set_up = 'in_path'", "set_up",
        "set_up: what a shutter in the light's path leaves of a flash comes from its curve…"),
    (TIMES, "open_start", "", "missing field `open_start`"),
    (TIMES, "min_gap", "", "missing field `min_gap`"),
    (TIMES, "5.5 -> '5.5'", "trigger_times", "trigger_times: a number is required"),
    (TIMES, "5.5 -> nan", "5.0", "trigger_times: a finite number is required"),
    (TIMES, "open_start = inf", "open_start", "open_start: a finite number is required"),
    (TIMES, "5.0, 5.5,\n  6.1004, -> ", "trigger_times", "trigger_times: 1 to 10000 can be planned, not 0"),
    (TIMES, "6.1004 -> 5.2", "5.2", "trigger_times: trigger 2 comes before trigger 1"),
    (TIMES, "5.0 -> 4.0", "4.0", "trigger_times: trigger 0 comes before open_start, from where ticks count"),
    (TIMES, "6.1004 -> 5.5991", "5.5991", "trigger_times: triggers 1 and 2 come 99 ticks apart, and 100 are required"),
    // Whatever the lamp needs, a timer fires once a tick.
    (TIMES, "min_gap = 0; 6.1004 -> 5.5001", "5.5001",
        "trigger_times: triggers 1 and 2 come 0 ticks apart, and 1 is required"),
    (TIMES, "6.1004 -> 2147487.748", "", ""),
    (TIMES, "6.1004 -> 2147487.749", "2147487.749",
        "trigger_times: trigger 2 comes more than 2^31 ticks after open_start; count from \
        nearer to it, or take a slower timer"),
    (TIMES, "timer_hz = 0", "timer_hz", HZ),
    (TIMES, "min_gap = -1", "min_gap", "min_gap: 0 or more is required"),
    (TIMES, "nominal = 0", "nominal", "nominal: more than 0 is required"),
    (TIMES, "delay = -1", "delay", "delay: 0 or more is required; an edge cannot trigger what comes before it"),
];

/// Is it the text that is expected, in which `…` stands for any words?
fn is_it(told: &str, expected: &str) -> bool {
    let mut parts = expected.split('…');
    let Some(mut rest) = told.strip_prefix(parts.next().unwrap_or_default()) else { return false };
    for part in parts {
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
    }
    rest.is_empty()
}

#[test]
fn a_scene_is_refused_at_its_line_or_planned() {
    let wrong = SCENES.iter().filter_map(|(scene, changes, line, reason)| {
        let text = with(scene, changes);
        let Err(fault) = Planned::parse(&text) else {
            return (!reason.is_empty()).then(|| format!("planned, not refused: {changes}"));
        };
        let told = fault.locate("a.toml", &text);
        let expected = expected(&text, line, reason);
        (!is_it(&told, &expected)).then(|| format!("{changes}:\n{told}\nin place of\n{expected}"))
    });
    let wrong: Vec<String> = wrong.collect();
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), SCENES.len(), wrong.join("\n"));
}

/// And 10 000 triggers are the most.
#[test]
fn many_times_are_planned() {
    for (n, is_planned) in [(10_000, true), (10_001, false)] {
        let times: Vec<String> = (5..5 + n).map(|time| time.to_string()).collect();
        let text = format!("open_start = 0\ntrigger_times = [{}]\nmin_gap = 0\n", times.join(","));
        assert_eq!(Planned::parse(&text).is_ok(), is_planned, "{n}");
    }
}

#[test]
fn wrong_control_points_are_refused_with_their_convention() {
    let is = |scene: &str, numbers: &str, reason: &str, hint: &str| {
        let text = with(scene, &format!("shutteropening = {numbers}"));
        let notes = "  The numbers are [t1, y1, t2, y2, t5, y5, t6, y6].";
        let hint = match hint {
            "" => String::new(),
            _ => {
                format!("\n  As {hint} they would fit; that is\n  shutteropening = [0.1, 0, 0.15, 1, 0.85, 1, 0.9, 0]")
            }
        };
        let expected = expected(&text, "shutteropening", reason);
        assert_eq!(Planned::parse(&text).err().unwrap().locate("a.toml", &text), format!("{expected}\n{notes}{hint}"));
    };
    let fraction = |point: &str, number: &str| {
        format!(
            "the time of its {point} inner point has to lie on the ramp, as a fraction of the whole interval: 0 \
             at open_start, 1 at close_end; it is {number}"
        )
    };
    let openness = |point: &str, number: &str| {
        format!("the openness of its {point} inner point has to be in [0, 1]; it is {number}")
    };
    let crossed = "its first inner point is later than its second by more than 15/16 of the ramp; move them closer";
    for (numbers, ramp, reason, hint) in [
        ("[1.9, 0, 0.15, 1, 0.85, 1, 0.9, 0]", "opening", fraction("first", "1.9"), ""),
        ("[0.1, 0, 1.2500003, 1, 0.85, 1, 0.9, 0]", "opening", fraction("second", "1.2500003"), ""),
        ("[0.1, 0, 0.15, 1, -0.1, 1, 0.9, 0]", "closing", fraction("first", "-0.1"), ""),
        ("[0.1, 0, 0.15, 1, 0.85, 1, 1e9, 0]", "closing", fraction("second", "1000000000"), ""),
        ("[0.1, -1e-9, 0.15, 1, 0.85, 1, 0.9, 0]", "opening", openness("first", "-1e-9"), ""),
        ("[0.1, 0, 0.15, 1.2, 0.85, 1, 0.9, 0]", "opening", openness("second", "1.2"), ""),
        ("[0.1, 0, 0.15, 1, 0.85, 2, 0.9, 0]", "closing", openness("first", "2"), ""),
        ("[0.1, 0, 0.15, 1, 0.85, 1, 0.9, -0.5]", "closing", openness("second", "-0.5"), ""),
        ("[0.25, 0, 0, 1, 0.85, 1, 0.9, 0]", "opening", crossed.into(), ""),
        ("[0.4, 0, 0.6, 1, 0.4, 1, 0.6, 0]", "opening", fraction("first", "0.4"), "fractions of each ramp"),
    ] {
        is(TRAPEZOID, numbers, &format!("{ramp} ramp: {reason}"), hint);
    }
    // Times for fractions, in ms and in seconds; what are seconds here would also fit as fractions of each ramp.
    let brief = with(TRAPEZOID, "open_end = 0.0025; close_start = 0.0075; close_end = 0.01");
    let ms = with(TRAPEZOID, "unit = 'ms'; open_end = 2.5; close_start = 7.5; close_end = 10");
    is(&ms, "[1, 0, 1.5, 1, 8.5, 1, 9, 0]", &format!("opening ramp: {}", fraction("first", "1")), "times in ms");
    is(
        &brief,
        "[0.001, 0, 0.0015, 1, 0.0085, 1, 0.009, 0]",
        &format!("closing ramp: {}", fraction("first", "0.0085")),
        "times in s",
    );
}
