//! `shutter plan`: every scene that ships is planned, and a file that is wrong leaves nothing behind.

use std::ffi::{OsStr, OsString};
use std::fs;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use shutter::emit::{Form, emit};
use shutter::plan::Plan;
use shutter::planned::Planned;
use shutter_curve::ShutterCurve;

const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes");

/// How a run ended, and what it wrote.
struct Run {
    code: u8,
    out: String,
    err: String,
}

fn run<const N: usize>(args: [&Path; N]) -> Run {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let code = shutter::command::run(command_line(args), &mut out, &mut err);
    Run { code, out: String::from_utf8(out).unwrap(), err: String::from_utf8(err).unwrap() }
}

fn command_line<const N: usize>(args: [&Path; N]) -> Vec<OsString> {
    [Path::new("shutter"), Path::new("plan")]
        .iter()
        .chain(&args)
        .map(|arg| arg.as_os_str().to_owned())
        .collect()
}

/// An empty directory for one test.
fn empty_dir(name: &str) -> PathBuf {
    let dir = Path::new(env!("CARGO_TARGET_TMPDIR")).join("plan").join(name);
    let _ = fs::remove_dir_all(&dir);
    fs::create_dir_all(&dir).unwrap();
    dir
}

fn names_in(dir: &Path) -> Vec<OsString> {
    let mut names: Vec<_> = fs::read_dir(dir).unwrap().map(|f| f.unwrap().file_name()).collect();
    names.sort();
    names
}

/// The scenes that ship.
fn scenes() -> Vec<PathBuf> {
    let scenes: Vec<_> = fs::read_dir(SCENES).unwrap().map(|f| f.unwrap().path()).collect();
    assert!(scenes.len() >= 8);
    scenes
}

/// The table's rows, as their columns.
fn table(out: &str) -> Vec<Vec<&str>> {
    let rows = out.lines().skip_while(|line| !line.trim_start().starts_with('#')).skip(1);
    rows.map(|row| row.split_whitespace().collect()).collect()
}

#[test]
fn every_scene_that_ships_is_planned_and_drawn() {
    let dir = empty_dir("scenes");
    let scenes = scenes();
    for scene in &scenes {
        let picture = dir.join(scene.file_stem().unwrap()).with_extension("svg");
        let set_ups = picture.with_extension("set-ups.svg");
        let run = run([scene, Path::new("--out"), &picture, Path::new("--set-ups"), &set_ups]);
        let wrote = format!("wrote {}\nwrote {}\n", picture.display(), set_ups.display());
        assert_eq!((run.code, run.err), (0, wrote), "{}", scene.display());
        assert!(run.out.lines().all(|line| line.chars().count() <= 80));
        assert!(run.out.contains("exposure ") && run.out.contains("efficiency "));
        let svg = fs::read_to_string(picture).unwrap();
        assert!(svg.contains("\n<svg ") && svg.ends_with("</svg>\n"));
        assert!(svg.contains("openness") && svg.contains("fraction of the exposure"));
        assert!(svg.contains("time ("));
        let svg = fs::read_to_string(set_ups).unwrap();
        assert!(svg.contains("\n<svg ") && svg.ends_with("</svg>\n"));
    }
    assert_eq!(names_in(&dir).len(), 2 * scenes.len(), "nothing but the pictures");
}

#[test]
fn the_default_is_the_soft_scene() {
    let named = run([&Path::new(SCENES).join("soft.toml")]);
    let default = run([]);
    assert_eq!(default.code, 0);
    assert_eq!(default.out, named.out);
}

#[test]
fn without_a_command_it_plans() {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    assert_eq!(shutter::command::run(["shutter".into()], &mut out, &mut err), 0);
    assert_eq!(String::from_utf8(out).unwrap(), run([]).out);
}

#[test]
fn a_form_is_all_that_is_printed() {
    for scene in scenes() {
        let plan = Plan::parse(&fs::read_to_string(&scene).unwrap()).unwrap();
        let scene_name = scene.file_stem().unwrap().to_str().unwrap();
        for (name, form) in
            [("rust", Form::Rust), ("c", Form::C), ("csv", Form::Csv), ("json", Form::Json)]
        {
            let run = run([&scene, Path::new("--emit"), Path::new(name)]);
            assert_eq!((run.code, run.err.as_str()), (0, ""), "{scene_name}");
            assert_eq!(run.out, emit(form, scene_name, &plan.clone().into(), false).unwrap());
        }
    }
    let run = run([Path::new("--emit"), Path::new("pascal")]);
    assert_eq!((run.code, run.out.as_str()), (2, ""));
    assert!(run.err.contains("[possible values: rust, c, csv, json]"), "{}", run.err);
}

/// And so they show the crate as it is. They are drawn by
/// `shutter plan --force --out docs/curve.svg --set-ups docs/set-ups.svg`.
#[test]
fn the_pictures_of_the_docs_are_as_they_are_drawn() {
    let dir = empty_dir("docs");
    let [curve, set_ups] = ["curve.svg", "set-ups.svg"].map(|name| dir.join(name));
    let run = run([Path::new("--out"), &curve, Path::new("--set-ups"), &set_ups]);
    assert_eq!(run.code, 0);
    for picture in [curve, set_ups] {
        let kept = Path::new(SCENES).join("../../docs").join(picture.file_name().unwrap());
        let same = fs::read_to_string(&picture).unwrap() == fs::read_to_string(&kept).unwrap();
        assert!(same, "{} is old", kept.display());
    }
}

#[test]
fn both_set_ups_are_drawn_with_their_doses() {
    let dir = empty_dir("set_ups");
    for scene in ["soft", "led", "projector", "box", "strobe"] {
        let picture = dir.join(scene).with_extension("svg");
        let file = Path::new(SCENES).join(scene).with_extension("toml");
        assert_eq!(run([&file, Path::new("--set-ups"), &picture]).code, 0, "{scene}");
        let svg = fs::read_to_string(&picture).unwrap();
        assert!(svg.contains("prefers-color-scheme: dark"));
        let doses = |percent: &str| svg.matches(&format!("\n{percent}\n</text>")).count();
        // What a flash has lost that comes where soft is open to 0.611.
        match scene {
            "soft" | "led" => {
                assert_eq!((doses("100"), doses("61"), doses("96")), (12 + 8 + 12, 2, 2))
            }
            // And the axes of time end at 100 µs.
            "box" => assert_eq!(doses("100"), 30 + 3),
            _ => (),
        }
    }
}

#[test]
fn a_picture_has_a_title_and_colours_for_the_dark() {
    let picture = empty_dir("title").join("a & b <c>.svg");
    let scene = picture.with_extension("toml");
    fs::write(&scene, GOOD).unwrap();
    assert_eq!(run([&scene, Path::new("--out"), &picture]).code, 0);
    let svg = fs::read_to_string(&picture).unwrap();
    let title = "<title>Openness and exposure of the shutter a &amp; b &lt;c> over time, with its triggers</title>";
    assert_eq!(svg.lines().nth(2), Some(title));
    let (head, drawn) = svg.split_once("</style>").unwrap();
    assert!(head.contains("@media (prefers-color-scheme: dark)"));
    // Each colour that is drawn has another for the dark.
    for color in drawn.split([' ', '>']).filter_map(|word| {
        word.strip_prefix("fill=").or(word.strip_prefix("stroke=")).filter(|c| c.starts_with("\"#"))
    }) {
        assert!(head.contains(&format!("[fill={color}]")), "{color}");
    }
}

#[test]
fn a_box_is_evenly_spaced() {
    let run = run([&Path::new(SCENES).join("box.toml")]);
    let rows = table(&run.out);
    assert_eq!(rows.len(), 10);
    for (i, row) in rows.iter().enumerate() {
        // 100 µs at 25 MHz: 250 ticks a share, the trigger in its middle.
        assert_eq!(row[0], i.to_string());
        assert_eq!(row[1].parse(), Ok((i as f64 * 2.0 + 1.0) / 20.0));
        assert_eq!(row[2].parse(), Ok(i as f64 * 10.0 + 5.0));
        assert_eq!(row[3], (i * 250 + 125).to_string());
        assert_eq!(row[4].parse().ok(), (i > 0).then_some(10.0));
    }
}

#[test]
fn a_long_table_is_shortened_in_the_middle() {
    let run = run([&Path::new(SCENES).join("strobe.toml")]);
    let rows = table(&run.out);
    assert_eq!(rows.len(), 25);
    assert_eq!((rows[0][0], rows[11][0], rows[13][0], rows[24][0]), ("0", "11", "88", "99"));
    assert_eq!(rows[12], ["...", "76", "more"]);
}

#[test]
fn a_share_is_shaded_for_each_trigger() {
    let picture = empty_dir("shares").join("soft.svg");
    assert_eq!(run([Path::new("--out"), &picture]).code, 0);
    let svg = fs::read_to_string(picture).unwrap();
    assert_eq!(svg.matches("<polygon").count(), 12);
    // One dot on the openness, one on the cdf, one in the legend.
    assert_eq!(svg.matches(r##"r="32" opacity="1" fill="#D55E00""##).count(), 12 + 12 + 1);
    // Eight control points and one in the legend, four handles and one.
    assert_eq!(svg.matches(r##"r="40" opacity="1" fill="none""##).count(), 8 + 1);
    assert_eq!(svg.matches(r##"stroke="#78818B" stroke-width="16""##).count(), 4 + 1);
}

/// A scene that is right. At 3/4 s of exposure and a gap of 1/10 s, 7 triggers are sure.
const GOOD: &str = "\
# a trapezoid
open_start = 0.0
open_end = 0.25
close_start = 0.75
close_end = 1.0
triggers = 7
timer_hz = 1000
min_gap = 0.1
";

/// The line of `GOOD` that a key is on; a key that is added comes on the first line after.
const fn line(key: &str) -> Option<usize> {
    match key.as_bytes() {
        b"open_start" => Some(2),
        b"open_end" => Some(3),
        b"close_start" => Some(4),
        b"close_end" => Some(5),
        b"triggers" => Some(6),
        b"timer_hz" => Some(7),
        b"min_gap" => Some(8),
        _ => Some(9),
    }
}

/// `GOOD` with `key` set to `value`.
fn with(key: &str, value: &str) -> String {
    let text = without(key);
    let at = line(key).unwrap() - 1;
    let mut lines: Vec<_> = text.lines().map(String::from).collect();
    lines.insert(at, format!("{key} = {value}"));
    lines.join("\n") + "\n"
}

fn without(key: &str) -> String {
    let is_other = |line: &&str| line.split(' ').next() != Some(key);
    GOOD.lines().filter(is_other).map(|line| format!("{line}\n")).collect()
}

/// The error of a scene; after seeing that nothing was written, and an older picture is as it was.
fn error_of(dir: &Path, scene: &str) -> String {
    let (file, picture, older) = (dir.join("bad.toml"), dir.join("new.svg"), dir.join("older.svg"));
    fs::write(&file, scene).unwrap();
    fs::write(&older, "older").unwrap();
    let mut err = String::new();
    for picture in [&picture, &older] {
        let run = run([&file, Path::new("--out"), picture]);
        assert_eq!(run.code, 2, "{scene}\n{}", run.err);
        assert_eq!(run.out, "", "{scene}");
        err = run.err;
    }
    assert_eq!(names_in(dir), ["bad.toml", "older.svg"], "{scene}");
    assert_eq!(fs::read_to_string(&older).unwrap(), "older");
    err
}

/// Does this scene fail with this reason, on this line if one is named?
fn fails(dir: &Path, scene: &str, at: Option<usize>, reason: &str) {
    let err = error_of(dir, scene);
    let file = dir.join("bad.toml").display().to_string();
    let expected = match at {
        Some(line) => {
            let source = scene.lines().nth(line - 1).unwrap();
            format!("error: {file}:{line}: {reason}\n  {line} | {source}\n")
        }
        None => format!("error: {file}: {reason}\n"),
    };
    assert_eq!(err, expected, "{scene}");
}

#[test]
fn the_scene_that_the_bad_ones_are_made_from_is_good() {
    let file = empty_dir("good").join("good.toml");
    fs::write(&file, GOOD).unwrap();
    assert_eq!(run([&file]).err, "");
    fs::write(&file, with("shutteropening", "[0.1, 0, 0.15, 1, 0.85, 1, 0.9, 0]")).unwrap();
    assert_eq!(run([&file]).err, "");
}

#[test]
fn a_missing_key_is_named() {
    let dir = empty_dir("missing");
    for key in ["open_start", "open_end", "close_start", "close_end", "triggers", "min_gap"] {
        fails(&dir, &without(key), None, &format!("missing field `{key}`"));
    }
    fails(&dir, "", None, "missing field `open_start`");
}

#[test]
fn an_unknown_key_is_named() {
    let err = error_of(&empty_dir("unknown"), &with("colour", "3"));
    assert!(
        err.contains("bad.toml:9: unknown field `colour`, expected one of `unit`, `open_start`")
            && err.contains("`sync_falls`, `lamp_lag`, `set_up`, `fully_open`, or `trigger_times` in place of a curve\n"),
        "{err}"
    );
}

#[test]
fn what_is_not_toml_is_an_error() {
    let dir = empty_dir("syntax");
    let twice = format!("{GOOD}triggers = 3\n");
    fails(&dir, &twice, Some(9), "duplicate key");
    let err = error_of(&dir, &with("triggers", "= 3"));
    assert!(err.contains("bad.toml:6: "), "{err}");
    // Nor is what is not text.
    fs::write(dir.join("bad.toml"), b"\xff").unwrap();
    let run = run([&dir.join("bad.toml")]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("bad.toml: it is no text in UTF-8"), "{}", run.err);
}

#[test]
fn a_wrong_type_is_an_error() {
    const NUMBER: &str = "a number is required";
    const COUNT: &str = "a whole number from 1 to 10000 is required";
    let dir = empty_dir("types");
    for (key, value, reason) in [
        ("open_end", "\"soon\"", NUMBER),
        ("close_end", "true", NUMBER),
        ("triggers", "4.5", COUNT),
        ("triggers", "-1", COUNT),
        ("timer_hz", "'fast'", NUMBER),
        ("min_gap", "\"\"", NUMBER),
        ("shutteropening", "0.5", "numbers in brackets are required"),
        ("shutteropening", "[0, 1, 'x']", NUMBER),
        ("unit", "3", "\"s\", \"ms\", \"us\" or \"ns\" is required"),
        ("unit", "'min'", "\"s\", \"ms\", \"us\" or \"ns\" is required"),
    ] {
        fails(&dir, &with(key, value), line(key), &format!("{key}: {reason}"));
    }
}

#[test]
fn a_number_out_of_range_is_an_error() {
    let dir = empty_dir("range");
    let count = "triggers: a whole number from 1 to 10000 is required";
    let gap = "min_gap: 0 or more is required";
    for (key, value, reason) in [
        ("triggers", "0", count),
        ("triggers", "10_001", count),
        ("min_gap", "-0.1", gap),
        ("min_gap", "inf", "min_gap: a finite number is required"),
        ("min_gap", "nan", "min_gap: a finite number is required"),
        (
            "shutteropening",
            "[0.1, 0.0, 0.2, 1.0, 0.8, 1.0, 0.9]",
            "shutteropening: 8 numbers are required, not 7",
        ),
        (
            "shutteropening",
            "[0.1, 0.0, 0.2, 1.0, 0.8, 1.0, 0.9, 0.0, 0.0]",
            "shutteropening: 8 numbers are required, not 9",
        ),
        ("timer_hz", "0", "timer_hz: a rate from 1 to 4294967295 is required"),
        ("timer_hz", "0.4", "timer_hz: a rate from 1 to 4294967295 is required"),
        ("timer_hz", "-1", "timer_hz: a rate from 1 to 4294967295 is required"),
        ("timer_hz", "nan", "timer_hz: a rate from 1 to 4294967295 is required"),
        ("timer_hz", "5_000_000_000", "timer_hz: a rate from 1 to 4294967295 is required"),
        (
            "timer_hz",
            "2147483649",
            "timer_hz: the interval is longer than 2^31 ticks; up to 2147483648 Hz it is not",
        ),
    ] {
        fails(&dir, &with(key, value), line(key), reason);
    }
}

/// The measured shutter, whose frame ends 12.9576195 ms after the edge, on such a timer.
fn on_timer(keys: &str) -> Result<shutter::planned::Planned, String> {
    let text = include_str!("../scenes/measured.toml").replace("timer_hz = 25000000", keys);
    shutter::planned::Planned::parse(&text).map_err(|fault| fault.locate("leaf.toml", &text))
}

#[test]
fn a_timer_of_16_bits_holds_a_frame_or_gets_a_prescaler() {
    let err = on_timer("timer_hz = 84_000_000\ntimer_bits = 16").err().unwrap();
    let reason = "timer_bits: the frame ends at tick 1088440, and with 16 bits it may end at 32768 at the latest; \
                  a prescaler of 35 fits: timer_hz = 2400000\n";
    assert!(err.contains(&format!("leaf.toml:15: {reason}")), "{err}");
    // A prime has no prescaler that leaves a whole rate.
    let err = on_timer("timer_hz = 83_999_971\ntimer_bits = 16").err().unwrap();
    assert!(err.contains("a prescaler of 34 fits: timer_hz = 2470587.382\n"), "{err}");
    for (keys, told) in [
        ("timer_hz = 2400000\ntimer_bits = 16", "2400000 Hz; 16 bits"),
        (
            "timer_hz = 2470587.382\ntimer_bits = 16",
            "2470587.382 Hz, planned as 2470587: 0.0049 ticks off at the end; 16 bits",
        ),
        ("timer_hz = 25000000\ntimer_bits = 32", "25000000 Hz"),
    ] {
        let facts = shutter::facts::lines("leaf", &on_timer(keys).unwrap());
        assert!(facts.contains(&("timer", told.into())), "{facts:?}");
    }
    let err = on_timer("timer_hz = 25000000\ntimer_bits = 24").err().unwrap();
    assert!(err.contains("leaf.toml:15: timer_bits: 16 or 32 is required\n"), "{err}");
    // The last tick that fits, and the next one.
    let times = |last| {
        format!(
            "open_start = 0\ntrigger_times = [{last}]\ntimer_hz = 1\ntimer_bits = 16\nmin_gap = 0\ndelay = 1000"
        )
    };
    assert!(shutter::times::Times::parse(&times(31768)).is_ok());
    let fault = shutter::times::Times::parse(&times(31769)).unwrap_err();
    assert!(fault.reason().contains("ends at tick 32769,"), "{}", fault.reason());
}

/// Ticks of a rate that is rounded, and of times that `f32` moves, are doubted in every form that has room for it.
#[test]
fn ticks_that_may_be_others_are_doubted() {
    let scene = |start: f64, hz: &str| {
        let [a, b, c, d] = [0.0, 0.002, 0.006, 0.008].map(|t| start + t);
        let text = format!(
            "open_start = {a}\nopen_end = {b}\nclose_start = {c}\nclose_end = {d}\n\
             triggers = 4\nmin_gap = 0\nset_up = 'emulated'\ntimer_hz = {hz}\n"
        );
        Planned::parse(&text).unwrap()
    };
    let moved =
        "f32 moves the curve's times by up to 58 ticks; they are nearest where open_start is 0.";
    for (plan, doubts) in [
        (scene(0.0003, "100_000_000"), vec![]),
        (scene(10.0003, "100_000"), vec![]),
        (scene(10.0003, "100_000_000"), vec![moved]),
        (scene(0.0, "1000.4"), vec![]),
    ] {
        let json = emit(Form::Json, "scene", &plan, false).unwrap();
        let json: serde_json::Value = serde_json::from_str(&json).unwrap();
        assert_eq!(json["doubts"], serde_json::json!(doubts));
        let module = emit(Form::Rust, "scene", &plan, false).unwrap();
        assert_eq!(module.matches("\n// doubt ").count(), doubts.len(), "{module}");
    }
    let slow = "unit = 's'\nopen_start = 0\ntrigger_times = [20, 40]\nmin_gap = 0\nset_up = 'emulated'\ntimer_hz = 1.5";
    let json = emit(Form::Json, "slow", &Planned::parse(slow).unwrap(), false).unwrap();
    assert!(json.contains("\"1.5 Hz, planned as 2: 20 ticks off at the end\""), "{json}");
}

/// As docs/firmware.md says.
#[test]
fn the_report_tells_when_a_drift_matters() {
    let report = |keys| shutter::report::text("leaf", &on_timer(keys).unwrap(), 80);
    let line = |n| {
        format!("\ndrift        a tick a second moves the delay by 1 % of a share in {n} frames\n")
    };
    // A share of 6.2541 ms / 16 is 9772 ticks; a frame takes 12.958 ms.
    assert!(report("timer_hz = 25000000").contains(&line("7542")));
    assert!(report("timer_hz = 1000000").contains(&line("302")));
    let none = include_str!("../scenes/soft.toml");
    let none = shutter::planned::Planned::parse(none).unwrap();
    assert!(!shutter::report::text("soft", &none, 80).contains("\ndrift"));
}

#[test]
fn a_bad_curve_is_an_error() {
    let dir = empty_dir("curve");
    let order =
        "times out of order: open_start <= open_end <= close_start <= close_end is required";
    let length = "the interval is shorter than 2^-64 (5.4e-20) or longer than 2^64 (1.8e19); it lasts 1e30 s";
    for (key, value, at, reason) in [
        ("open_start", "nan", "open_start", "open_start: a finite number is required"),
        ("close_end", "-inf", "close_end", "close_end: a finite number is required"),
        ("close_end", "1e39", "close_end", "close_end: it is beyond f32 (3.4e38 s)"),
        ("open_start", "0.3", "open_end", order),
        ("open_end", "0.8", "close_start", order),
        ("close_end", "0.7", "close_end", order),
        ("close_end", "1e30", "close_end", length),
    ] {
        fails(&dir, &with(key, value), line(at), reason);
    }
    for numbers in ["[nan, 0, 0.15, 1, 0.85, 1, 0.9, 0]", "[0.1, 0, 0.15, 1, 0.85, 1, 0.9, 1e39]"] {
        let reason = "shutteropening: a finite number is required";
        fails(&dir, &with("shutteropening", numbers), line("shutteropening"), reason);
    }
}

#[test]
fn what_is_too_short_for_f32_is_an_error_at_its_end() {
    let dir = empty_dir("short");
    let short = |part: &str| {
        format!(
            "{part}: it is shorter than 2^-24 of the greatest time; make it longer, or give it no length; it lasts 1e-9 ms"
        )
    };
    let far = "the interval is too short for its distance from time 0: below 2^-16 of its greatest time; count times \
               from a nearer origin; it lasts 1000 ms";
    for (times, at, reason) in [
        (["0", "1e-9", "0.75", "1"], 2, short("opening ramp")),
        (["-1", "0", "1e-9", "1"], 3, short("plateau")),
        (["-1", "-0.5", "-1e-9", "0"], 4, short("closing ramp")),
        (["131071000", "131071000", "131072000", "131072000"], 4, far.into()),
    ] {
        let keys = ["open_start", "open_end", "close_start", "close_end"];
        let times = keys.iter().zip(times).map(|(key, time)| format!("{key} = {time}\n"));
        let times: String = times.collect();
        let scene = format!("{times}unit = \"ms\"\ntriggers = 1\ntimer_hz = 1000\nmin_gap = 0\n");
        fails(&dir, &scene, Some(at), &reason);
    }
}

/// What is told below an error of the inner control points.
const ORDER: &str = "  The numbers are [t1, y1, t2, y2, t5, y5, t6, y6].\n";

#[test]
fn wrong_control_points_are_an_error_that_names_their_convention() {
    let dir = empty_dir("convention");
    let (opening, closing) = ("opening ramp", "closing ramp");
    let wrong = |what: &str, point: &str, rule: &str, number: &str| {
        format!("the {what} of its {point} inner point has to {rule}; it is {number}")
    };
    let on_ramp =
        "lie on the ramp, as a fraction of the whole interval: 0 at open_start, 1 at close_end";
    let fraction = |point: &str, number: &str| wrong("time", point, on_ramp, number);
    let openness = |point: &str, number: &str| wrong("openness", point, "be in [0, 1]", number);
    let crossed = "its first inner point is later than its second by more than 15/16 of the ramp; move them closer";
    for (numbers, ramp, reason, hint) in [
        ("[1.9, 0, 0.15, 1, 0.85, 1, 0.9, 0]", opening, fraction("first", "1.9"), ""),
        ("[0.1, 0, 1.2500003, 1, 0.85, 1, 0.9, 0]", opening, fraction("second", "1.2500003"), ""),
        ("[0.1, 0, 0.15, 1, -0.1, 1, 0.9, 0]", closing, fraction("first", "-0.1"), ""),
        ("[0.1, 0, 0.15, 1, 0.85, 1, 1e9, 0]", closing, fraction("second", "1000000000"), ""),
        ("[0.1, -1e-9, 0.15, 1, 0.85, 1, 0.9, 0]", opening, openness("first", "-1e-9"), ""),
        ("[0.1, 0, 0.15, 1.2, 0.85, 1, 0.9, 0]", opening, openness("second", "1.2"), ""),
        ("[0.1, 0, 0.15, 1, 0.85, 2, 0.9, 0]", closing, openness("first", "2"), ""),
        ("[0.1, 0, 0.15, 1, 0.85, 1, 0.9, -0.5]", closing, openness("second", "-0.5"), ""),
        ("[0.25, 0, 0, 1, 0.85, 1, 0.9, 0]", opening, crossed.into(), ""),
        (
            "[0.4, 0, 0.6, 1, 0.4, 1, 0.6, 0]",
            opening,
            fraction("first", "0.4"),
            "  As fractions of each ramp they would fit; that is
  shutteropening = [0.1, 0, 0.15, 1, 0.85, 1, 0.9, 0]
",
        ),
    ] {
        let scene = with("shutteropening", numbers);
        let file = dir.join("bad.toml").display().to_string();
        let expected = format!(
            "error: {file}:9: {ramp}: {reason}\n  9 | shutteropening = {numbers}\n{ORDER}{hint}"
        );
        assert_eq!(error_of(&dir, &scene), expected);
    }
    // Times for fractions, in ms and in seconds; what are seconds here would also fit as fractions of each ramp.
    for (unit, second, numbers) in [
        ("ms", 1e3, "[1, 0, 1.5, 1, 8.5, 1, 9, 0]"),
        ("s", 1.0, "[0.001, 0, 0.0015, 1, 0.0085, 1, 0.009, 0]"),
    ] {
        let [open_end, close_start, close_end] = [0.0025, 0.0075, 0.01].map(|time| time * second);
        let scene = format!(
            "unit = \"{unit}\"\nopen_start = 0\nopen_end = {open_end}\nclose_start = {close_start}\n\
             close_end = {close_end}\ntriggers = 1\ntimer_hz = 1000\nmin_gap = 0\nshutteropening = {numbers}\n"
        );
        let err = error_of(&dir, &scene);
        let hint = format!(
            "  As times in {unit} they would fit; that is
  shutteropening = [0.1, 0, 0.15, 1, 0.85, 1, 0.9, 0]
"
        );
        assert!(err.ends_with(&hint), "{err}");
    }
}

#[test]
fn a_time_that_f32_cannot_tell_from_another_is_an_error() {
    let dir = empty_dir("rounded");
    let scene = ["open_start", "open_end", "close_start", "close_end"]
        .iter()
        .fold(GOOD.to_string(), |text, key| {
            text.replace(&format!("{key} = 0"), &format!("{key} = 1_700_000_000"))
        })
        .replace("close_end = 1.0", "close_end = 1_700_000_001.0");
    let reason = "open_end: f32 is off by 25 % of the interval here; count the times from nearer to open_start";
    let file = dir.join("bad.toml").display().to_string();
    let expected = format!("error: {file}:3: {reason}\n  3 | open_end = 1_700_000_000.25\n");
    assert_eq!(error_of(&dir, &scene), expected);
}

#[test]
fn a_unit_scales_all_times() {
    let dir = empty_dir("unit");
    let plain = dir.join("good.toml");
    fs::write(
        &plain,
        format!("{GOOD}nominal = 0.5\nduty = 0.5\nmin_pulse = 0.01\nset_up = 'in_path'\n")
            .replace("min_gap = 0.1", "min_gap = 0.05"),
    )
    .unwrap();
    let csv = |file: &Path| {
        let csv = ["--emit", "csv", "--name", "x"].map(Path::new);
        let run = run([file, csv[0], csv[1], csv[2], csv[3]]);
        assert_eq!(run.err, "");
        run.out
    };
    for (unit, factor) in
        [("ms", 1e3), ("µs", 1e6), ("μs", 1e6), ("us", 1e6), ("ns", 1e9), ("s", 1.0)]
    {
        let text = format!(
            "unit = \"{unit}\"\nopen_start = 0\nopen_end = {}\nclose_start = {}\nclose_end = {}\n\
             triggers = 7\ntimer_hz = 1000\nmin_gap = {}\nnominal = {}\nduty = 0.5\nmin_pulse = {}\n\
             set_up = 'in_path'\n",
            0.25 * factor,
            0.75 * factor,
            factor,
            0.05 * factor,
            0.5 * factor,
            0.01 * factor
        );
        let file = dir.join("scaled.toml");
        fs::write(&file, text).unwrap();
        assert_eq!(csv(&file), csv(&plain), "{unit}");
        let report = run([&file]).out;
        assert!(report.contains("ΔEV +0.58"), "{report}");
    }
}

/// Decimals in or at the end of the box, some of them rounded to seven digits, on any scale and up to a hundred
/// intervals from time 0: neither the unit's conversion nor `f32` carries one out of it.
#[test]
fn what_lies_in_the_box_lies_in_it_in_every_unit() {
    let mut state = 1u64;
    let mut below = |n: i64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 33) as i64 % n
    };
    for _ in 0..2000 {
        let n = [8, 10, 12, 25, 49, 64, 80, 125, 300][below(9) as usize];
        let mut times = [0, below(n + 1), below(n + 1), n];
        times.sort_unstable();
        // Of each inner time an end of its ramp, or any place on it.
        let ramps = [[times[0], times[1]], [times[2], times[3]]];
        let inner = ramps.map(|[from, to]| {
            let mut inner = [0, 1].map(|_| match below(4) {
                0 => from,
                1 => to,
                _ => from + below(to - from + 1),
            });
            inner.sort_unstable();
            inner.map(|at| {
                let fraction = (1e7 * at as f64 / n as f64).round() / 1e7;
                format!("{fraction}, {}", below(11) as f64 / 10.0)
            })
        });
        let (offset, power) = (below(201 * n) - 100 * n, below(7) - 3);
        for (unit, more) in [("s", -3), ("ms", 0), ("us", 3), ("ns", 6)] {
            let keys = ["open_start", "open_end", "close_start", "close_end"].iter().zip(times);
            let times = keys
                .map(|(key, time)| format!("{key} = {}e{}\n", offset + time, power + more))
                .collect::<String>();
            let text = format!(
                "unit = \"{unit}\"\n{times}shutteropening = [{}]\ntriggers = 1\ntimer_hz = 1\nmin_gap = 0\n",
                inner.as_flattened().join(", ")
            );
            let curve = shutter::scene::parse(&text).and_then(|scene| scene.curve());
            assert!(curve.is_ok(), "{}", curve.unwrap_err().locate("scene", &text));
        }
    }
}

/// Everything that is asked of a delay: it is printed, counted from, drawn, and checked.
#[test]
fn a_delay_is_counted_from_the_edge_of_the_sync() {
    let dir = empty_dir("delay");
    let (file, picture) = (dir.join("late.toml"), dir.join("late.svg"));
    for (unit, factor) in [("s", 1.0), ("ms", 1e3)] {
        let times = [0.25, 0.75, 1.0].map(|time| time * factor);
        let text = format!(
            "unit = \"{unit}\"\nopen_start = 0\nopen_end = {}\nclose_start = {}\nclose_end = {}\n\
             triggers = 3\ntimer_hz = 1000\nmin_gap = 0\ndelay = {}\nsync_falls = true\n",
            times[0],
            times[1],
            times[2],
            0.125 * factor
        );
        fs::write(&file, text).unwrap();
        let run = run([&file, Path::new("--out"), &picture]);
        assert_eq!(run.code, 0, "{}", run.err);
        let fact = format!(
            "delay        {} {unit} from the sync's falling edge to the start of opening\n",
            0.125 * factor
        );
        assert!(run.out.contains(&fact), "{}", run.out);
        assert!(run.out.lines().all(|line| line.chars().count() <= 80), "{}", run.out);
        // The third column counts from the opening, the fourth from the edge.
        let rows = table(&run.out);
        let columns = |i: usize| rows.iter().map(move |row| row[i].parse::<u32>().unwrap());
        assert!(columns(3).eq([250, 500, 750]), "{}", run.out);
        assert!(columns(4).eq([375, 625, 875]), "{}", run.out);
        let svg = fs::read_to_string(&picture).unwrap();
        assert!(svg.contains("\nsync\n") || svg.contains(">sync<"), "the edge is drawn");
        assert!(svg.contains(&format!("delay {} {unit}", 0.125 * factor)), "and the delay");
    }
    // An edge far before the curve would squeeze it: it is told, not drawn to scale.
    fs::write(&file, with("min_gap", "0\ndelay = 100")).unwrap();
    assert_eq!(run([&file, Path::new("--out"), &picture]).code, 0);
    assert!(fs::read_to_string(&picture).unwrap().contains("sync 100 s before"));
    // Without one, that is said.
    fs::write(&file, GOOD).unwrap();
    let out = run([&file]).out;
    assert!(
        out.contains("delay        none known: ticks count from the start of opening"),
        "{out}"
    );
    assert!(!out.contains("from edge"));
}

#[test]
fn a_delay_that_cannot_be_is_an_error() {
    let dir = empty_dir("wrong_delay");
    let late = |delay: &str| format!("{GOOD}delay = {delay}\n");
    let at = Some(GOOD.lines().count() + 1);
    let negative = "delay: 0 or more is required; an edge cannot trigger what comes before it";
    fails(&dir, &late("-1e-9"), at, negative);
    for number in ["nan", "inf", "-inf"] {
        fails(&dir, &late(number), at, "delay: a finite number is required");
    }
    fails(&dir, &late("\"soon\""), at, "delay: a number is required");
    // The frame takes 1000 ticks of 1 kHz; 2^31 - 1000 are left for the delay.
    let far = "delay: the frame ends more than 2^31 ticks after the edge; with up to 2147482648 ticks of delay it does not";
    fails(&dir, &late("2147482.6486"), at, far);
    fails(&dir, &late("1e300"), at, far);
    let plan = Plan::parse(&late("2147482.648")).unwrap();
    assert_eq!(plan.delay.map(|delay| delay.ticks + 1000), Some(1 << 31));
    // As good as none, and no sign of its zero is kept.
    let none = Plan::parse(&late("-0.0")).unwrap().delay.unwrap();
    assert!(none.ticks == 0 && none.seconds.is_sign_positive());
}

/// The speeds of a shutter: what a tester's list has, or one text of them all.
#[test]
fn several_scenes_are_a_table_or_one_text() {
    let dir = empty_dir("speeds");
    let [slow, fast] = ["slow", "fast"].map(|name| dir.join(name).with_extension("toml"));
    fs::write(
        &slow,
        format!("{GOOD}nominal = 0.75\nset_up = 'emulated'\ndelay = 0.5\nsync_falls = true\n"),
    )
    .unwrap();
    fs::write(
        &fast,
        format!("{GOOD}nominal = 0.375\nset_up = 'emulated'\ndelay = 0.5\nsync_falls = true\n"),
    )
    .unwrap();
    let both = run([&slow, &fast]);
    assert_eq!((both.code, both.err.as_str()), (0, ""));
    let expected = "\
scene  nominal  exposure TV    ΔEV  efficiency  delay  triggers
slow    750 ms       750 ms  +0.00        75 %  500 ms    7 of 7
fast    375 ms       750 ms  +1.00        75 %  500 ms    7 of 7
";
    let words = |text: &str| text.split_whitespace().map(String::from).collect::<Vec<_>>();
    assert_eq!(
        words(
            &both
                .out
                .replace("0.75 s", "750 ms")
                .replace("0.375 s", "375 ms")
                .replace("0.5 s", "500 ms")
        ),
        words(expected),
        "{}",
        both.out
    );
    let header = run([
        &slow,
        &fast,
        Path::new("--emit"),
        Path::new("c"),
        Path::new("--name"),
        Path::new("my camera"),
    ]);
    assert!(
        header.out.contains("static const my_camera_speed my_camera_speeds[MY_CAMERA_SPEEDS] = {"),
        "{}",
        header.err
    );
    let named =
        run([&slow, Path::new("--emit"), Path::new("c"), Path::new("--name"), Path::new("leaf")]);
    assert!(named.out.contains("leaf_ticks[LEAF_COUNT]"));
    let picture = dir.join("no.svg");
    let drawn = run([&slow, &fast, Path::new("--out"), &picture]);
    assert_eq!((drawn.code, drawn.err.as_str()), (2, "error: a picture is of one scene\n"));
    assert!(!picture.exists());
    // One that is wrong is named, and nothing is printed.
    fs::write(&fast, without("min_gap")).unwrap();
    let wrong = run([&slow, &fast]);
    assert!(
        wrong.out.is_empty() && wrong.err.contains("fast.toml: missing field"),
        "{}",
        wrong.err
    );
}

#[test]
fn facts_of_a_trapezoid_are_those_of_its_geometry() {
    let file = empty_dir("facts").join("good.toml");
    fs::write(&file, format!("{GOOD}nominal = 0.75\n")).unwrap();
    let out = run([&file]).out;
    let direct = ShutterCurve::<8>::linear(0.0, 0.25, 0.75, 1.0).unwrap().direct_triggers();
    for fact in [
        "times        T1 0.25 s opening, T2 0.5 s fully open, T3 0.25 s closing\n",
        "half open    TE 0.75 s,",
        "exposure     TV 0.75 s,",
        "efficiency   75 %\n",
        "nominal      0.75 s, ΔEV +0.00\n",
        "triggers     7; up to 7 keep the gap\n",
        &format!("direct       frames of up to {direct} triggers never need a search\n"),
    ] {
        assert!(out.contains(fact), "{fact}\n{out}");
    }
}

#[test]
fn a_gap_is_the_difference_of_the_times_that_are_printed() {
    for scene in fs::read_dir(SCENES).unwrap().map(|f| f.unwrap().path()) {
        let run = run([&scene]);
        let rows = table(&run.out);
        for pair in rows.windows(2).filter(|pair| pair.iter().all(|row| row[0] != "...")) {
            let number = |text: &str| text.parse::<f64>().unwrap();
            let apart = number(pair[1][2]) - number(pair[0][2]);
            let gap = pair[1].last().unwrap();
            let places = gap.split_once('.').map_or(0, |(_, places)| places.len());
            assert_eq!(*gap, format!("{apart:.places$}"), "{}: {pair:?}", scene.display());
        }
    }
}

/// `GOOD` with a box for its curve, and these lines.
fn boxed(lines: &str) -> String {
    format!(
        "open_start = 0\nopen_end = 0\nclose_start = 1\nclose_end = 1\ntimer_hz = 1000\n{lines}\n"
    )
}

#[test]
fn pulses_come_around_the_triggers_or_take_equal_shares() {
    let file = empty_dir("pulses").join("box.toml");
    let pulses = |lines: &str| -> Vec<[u32; 2]> {
        fs::write(&file, boxed(lines)).unwrap();
        let run = run([&file]);
        assert_eq!(run.err, "", "{lines}");
        let edges = |row: Vec<&str>| [4, 5].map(|i| row[i].parse().unwrap());
        table(&run.out).into_iter().map(edges).collect()
    };
    let [equal, doses] = ["pulse = 0.1", "duty = 0.4"]
        .map(|lamp| pulses(&format!("triggers = 4\nmin_gap = 0.15\n{lamp}")));
    assert_eq!(equal, [[75, 175], [325, 425], [575, 675], [825, 925]]);
    assert_eq!(doses, equal);
    // They touch where the lamp is always on, and a pulse of a whole share fits as well.
    for lamp in ["pulse = 0.25", "duty = 1"] {
        let all = pulses(&format!("triggers = 4\nmin_gap = 0\n{lamp}"));
        assert_eq!(all, [[0, 250], [250, 500], [500, 750], [750, 1000]]);
    }
    // Half a tick of an odd length comes after the trigger.
    assert_eq!(pulses("triggers = 1\nmin_gap = 0\npulse = 0.003"), [[499, 502]]);
}

/// On a curve that dims, each pulse lets the same dose through: the integral of the openness, here in closed form.
#[test]
fn doses_are_equal_through_the_curve() {
    let file = empty_dir("doses").join("triangle.toml");
    let triangle = "open_start = 0\nopen_end = 0.5\nclose_start = 0.5\nclose_end = 1\n";
    let scene =
        format!("{triangle}triggers = 7\ntimer_hz = 100_000_000\nmin_gap = 0\nduty = 0.3\n");
    fs::write(&file, scene).unwrap();
    let run = run([&file]);
    let collected = |ticks: &str| {
        let t = ticks.parse::<f64>().unwrap() / 1e8;
        if t < 0.5 { t * t } else { 0.5 - (1.0 - t) * (1.0 - t) }
    };
    let rows = table(&run.out);
    assert_eq!(rows.len(), 7);
    for row in rows {
        let dose = collected(row[5]) - collected(row[4]);
        assert!((dose - 0.3 * 0.5 / 7.0).abs() < 1e-7, "{row:?}: {dose}");
    }
}

#[test]
fn wrong_pulses_are_an_error_that_says_what_fits() {
    let dir = empty_dir("wrong_pulses");
    let four = "triggers = 4\nmin_gap = 0.1\n";
    for (lamp, at, reason) in [
        ("pulse = 0", 8, "pulse: more than 0 is required"),
        ("pulse = -1", 8, "pulse: more than 0 is required"),
        ("pulse = nan", 8, "pulse: a finite number is required"),
        ("pulse = 'x'", 8, "pulse: a number is required"),
        ("pulse = 0.0004", 8, "pulse: it is less than half a tick of 1000 Hz"),
        ("duty = 0", 8, "duty: above 0 and at most 1 is required"),
        ("duty = 1.001", 8, "duty: above 0 and at most 1 is required"),
        ("duty = nan", 8, "duty: above 0 and at most 1 is required"),
        ("nominal = 0", 8, "nominal: more than 0 is required"),
        ("nominal = inf", 8, "nominal: a finite number is required"),
        ("min_pulse = 0.1", 8, "min_pulse: it goes with duty, which makes pulses of many lengths"),
        (
            "duty = 0.5\npulse = 0.1",
            8,
            "duty and pulse: a scene has one of them (pulse where the curve is emulated, duty where the shutter is in \
             the light's path)",
        ),
        (
            "pulse = 0.2",
            8,
            "pulses of 200 ticks: pulses 0 and 1 come 50 ticks apart, and 100 are required; those of up to 150 ticks \
             fit, or up to 3 triggers keep that",
        ),
        (
            "pulse = 0.3",
            8,
            "pulses of 300 ticks: pulses 0 and 1 overlap by 50 ticks, and 100 are required; those of up to 150 ticks \
             fit, or up to 2 triggers keep that",
        ),
        (
            "pulse = 1e30",
            8,
            "pulses of 4294967295 ticks: pulses 0 and 1 overlap by 4294967045 ticks, and 100 are required; those of \
             up to 150 ticks fit",
        ),
        (
            "duty = 0.8",
            6,
            "pulses 0 and 1 come 50 ticks apart, and 100 are required; up to 2 triggers keep that; a smaller duty leaves more",
        ),
        (
            "duty = 0.5\nmin_pulse = 0.2",
            6,
            "pulse 0 lasts 125 ticks, and 200 are required; up to 2 triggers keep that; a greater duty lasts longer",
        ),
        (
            "duty = 1e-9",
            6,
            "pulse 0 lasts 0 ticks, and 1 is required; no number of triggers keeps that; a greater duty lasts longer",
        ),
    ] {
        fails(&dir, &boxed(&format!("{four}{lamp}")), Some(at), reason);
    }
    // A single pulse that is too long for the time before its trigger, or after it, or for both; and one that just fits.
    let falling = "open_start = 0\nopen_end = 0\nclose_start = 0\nclose_end = 1\n";
    let rising = "open_start = 0\nopen_end = 1\nclose_start = 1\nclose_end = 1\n";
    let all = "open_start = 0\nopen_end = 0\nclose_start = 1\nclose_end = 1\n";
    for (curve, longest) in [(falling, 587), (rising, 586), (all, 1000)] {
        let scene = |pulse: u32| {
            let pulse = f64::from(pulse) / 1000.0;
            format!("{curve}triggers = 1\ntimer_hz = 1000\nmin_gap = 0\npulse = {pulse}\n")
        };
        let reason = format!(
            "pulses of {} ticks: they reach beyond the time that the shutter is open; those of up to {longest} ticks \
             fit",
            longest + 1
        );
        fails(&dir, &scene(longest + 1), Some(8), &reason);
        fs::write(dir.join("bad.toml"), scene(longest)).unwrap();
        assert_eq!(run([&dir.join("bad.toml")]).err, "");
    }
}

#[test]
fn one_is_not_many() {
    let dir = empty_dir("one");
    let two = with("triggers", "2").replace("min_gap = 0.1", "min_gap = 0.5");
    let reason =
        "triggers 0 and 1 come 375 ticks apart, and 500 are required; 1 trigger keeps that";
    fails(&dir, &two, Some(6), reason);
    let file = dir.join("good.toml");
    fs::write(&file, two.replace("triggers = 2", "triggers = 1")).unwrap();
    let run = run([&file, Path::new("--out"), &dir.join("one.svg")]);
    assert!(run.out.contains("triggers     1; 1 keeps the gap"), "{}", run.out);
    let svg = fs::read_to_string(dir.join("one.svg")).unwrap();
    assert!(svg.contains("1 trigger in the middle of the exposure"));
}

/// What the command line sets counts, in the units that people write; a scene need not have it then.
#[test]
fn settings_of_the_command_line_count() {
    let file = empty_dir("settings").join("box.toml");
    let curve = "unit = 'ms'\nopen_start = 0\nopen_end = 0\nclose_start = 10\nclose_end = 10\n";
    let planned = |scene: &str, args: &[&str]| {
        fs::write(&file, scene).unwrap();
        let args: Vec<_> =
            [file.as_os_str()].into_iter().chain(args.iter().map(OsStr::new)).collect();
        let (mut out, mut err) = (Vec::new(), Vec::new());
        let line = ["shutter", "plan"].map(OsStr::new).into_iter().chain(args).map(OsString::from);
        let code = shutter::command::run(line, &mut out, &mut err);
        let [out, err] = [out, err].map(|text| String::from_utf8(text).unwrap());
        if code == 0 { out } else { err }
    };
    let whole = format!("{curve}triggers = 24\ntimer_hz = 84_000_000\nmin_gap = 0.1\nduty = 0.3\n");
    let plain = format!("{curve}pulse = 0.2\ntimer_hz = 1000\n");
    let settings =
        ["--triggers", "24", "--timer-hz", "84MHz", "--min-gap", "100us", "--duty", "0.3"];
    let expected = planned(&whole, &[]);
    assert!(
        expected.contains("timer        84000000 Hz\n") && expected.contains("0.1 ms"),
        "{expected}"
    );
    assert_eq!(planned(curve, &settings), expected);
    assert_eq!(planned(&plain, &settings), expected);
    for (args, reason) in [
        (["--triggers", "2000"], "\n  The command line sets some of this scene.\n"),
        (["--min-gap", "100"], "write a time as in 0, 1.5ms"),
        (["--min-gap", "-1us"], "0 or more is required"),
        (["--timer-hz", "84"], "box.toml:6: pulses 0 and 1 come 0 ticks apart"),
        (["--timer-hz", "1.5Hz"], "a whole number of Hz"),
        (["--timer-hz", "84mega"], "write a rate above 0 as in 48000, 32.768kHz, 84MHz"),
        (["--duty", "1.5"], "duty: above 0 and at most 1 is required"),
        (["--triggers", "0"], "--triggers"),
    ] {
        let told = planned(&whole, &args);
        assert!(told.contains(reason), "{args:?}: {told}");
    }
    assert_eq!(planned(&whole, &["--timer-hz", "32.768kHz"]).matches("32768 Hz").count(), 1);
}

/// The drawings take the width that there is; 40 columns suffice.
#[test]
fn drawings_fit_the_terminal() {
    for scene in scenes() {
        let plan = Planned::parse(&fs::read_to_string(&scene).unwrap()).unwrap();
        for columns in [32, 40, 60, 80] {
            let text = shutter::report::text("x", &plan, columns);
            let is_drawn = |line: &&str| line.contains(['─', '│', '⣀', '⡇', '⠁', '⢸', '┼']);
            let widest = text.lines().filter(is_drawn).map(|line| line.chars().count()).max();
            let widest = widest.unwrap();
            assert!(
                (columns - 12..=columns).contains(&(widest as u16)),
                "{columns}: {widest}\n{text}"
            );
        }
    }
}

#[test]
fn triggers_too_close_are_an_error_that_says_how_many_fit() {
    let dir = empty_dir("gap");
    // They come at 265.625 and 359.375 ticks.
    let reason =
        "triggers 1 and 2 come 93 ticks apart, and 100 are required; up to 7 triggers keep that";
    fails(&dir, &with("triggers", "8"), line("triggers"), reason);
    // Two on one tick, though no gap is asked for.
    let slow = with("timer_hz", "6").replace("min_gap = 0.1", "min_gap = 0");
    let reason =
        "triggers 1 and 2 come 0 ticks apart, and 1 is required; up to 5 triggers keep that";
    fails(&dir, &slow, line("triggers"), reason);
}

/// 0.1 s is 100 ticks, though no binary fraction is 0.1; and 99.9 ticks need 100, 100.1 need 101.
#[test]
fn a_gap_of_whole_ticks_is_kept_to_the_tick() {
    let file = empty_dir("whole").join("box.toml");
    let scene = |gap: &str| {
        let times = "open_start = 0\nopen_end = 0\nclose_start = 1\nclose_end = 1\n";
        format!("{times}triggers = 10\ntimer_hz = 1000\nmin_gap = {gap}\n")
    };
    for (gap, code) in [("0.1", 0), ("0.099", 0), ("0.0999", 0), ("0.1001", 2)] {
        fs::write(&file, scene(gap)).unwrap();
        assert_eq!(run([&file]).code, code, "{gap}");
    }
}

#[test]
fn a_file_that_cannot_be_read_is_an_error() {
    let dir = empty_dir("unreadable");
    for scene in [dir.join("none.toml"), dir.clone()] {
        let run = run([&scene, Path::new("--out"), &dir.join("new.svg")]);
        assert_eq!(run.code, 2);
        assert!(run.err.starts_with(&format!("error: {}: ", scene.display())));
        assert!(names_in(&dir).is_empty());
    }
}

#[test]
fn a_picture_is_named_svg() {
    let dir = empty_dir("png");
    let run = run([Path::new("--out"), &dir.join("new.png")]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("name it FILE.svg"), "{}", run.err);
    assert!(names_in(&dir).is_empty());
}

#[test]
fn help_is_no_error() {
    let run = run([Path::new("--help")]);
    assert_eq!((run.code, run.err.as_str()), (0, ""));
    assert!(
        run.out.contains("Usage: shutter plan [OPTIONS] [SCENES]...") && run.out.ends_with("')\n")
    );
}

/// Takes nothing.
struct Refusing(ErrorKind);

impl Write for Refusing {
    fn write(&mut self, _: &[u8]) -> io::Result<usize> {
        Err(self.0.into())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_reader_that_leaves_is_no_error_and_a_full_disk_is() {
    for (refusal, code) in [(ErrorKind::BrokenPipe, 0), (ErrorKind::StorageFull, 2)] {
        let mut err = Vec::new();
        assert_eq!(shutter::command::run(command_line([]), &mut Refusing(refusal), &mut err), code);
        assert_eq!(err.is_empty(), code == 0);
    }
}
