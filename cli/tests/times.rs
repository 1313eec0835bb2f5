//! Trigger times without a curve: a trace that no model explains becomes a scene of its own triggers, which `shutter plan`
//! turns into ticks, and what is wrong with such a scene is refused at its place.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use shutter::scene;
use shutter::times::Times;

/// The exit code, standard output and standard error of the program.
fn run<S: AsRef<std::ffi::OsStr>>(args: impl IntoIterator<Item = S>) -> (u8, String, String) {
    let args = ["shutter".into()].into_iter().chain(args.into_iter().map(|a| a.as_ref().into()));
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let code = shutter::command::run(args.collect::<Vec<OsString>>(), &mut out, &mut err);
    (code, String::from_utf8(out).unwrap(), String::from_utf8(err).unwrap())
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("times").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// A trace in ms of blades that bounce: between two dips they are open. It starts long after time 0 where `zero` is far.
fn bounces(path: &Path, zero: f64) {
    let dip = |t: f64, at: f64| 0.35 * (-((t - at) / 0.15).powi(2)).exp();
    traced(path, zero, |t| openness(t) * (1.0 - dip(t, 3.3) - 0.5 * dip(t, 4.0)));
}

/// Opens from 2 to 3 ms, and closes from 8 to 9.
fn openness(t: f64) -> f64 {
    (t - 2.0).min(9.0 - t).clamp(0.0, 1.0)
}

/// A trace of 12 ms, with noise.
fn traced(path: &Path, zero: f64, light: impl Fn(f64) -> f64) {
    let mut state = 7u32;
    let mut noise = || {
        let mut unit = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24)
        };
        (0..12).map(|_| unit()).sum::<f64>() - 6.0
    };
    let rows = (0..2400).map(|i| {
        let t = 0.005 * f64::from(i);
        let v = 0.1 + 2.0 * light(t) + 0.006 * noise();
        format!("{:.3},{v:.5}\n", zero + t)
    });
    fs::write(path, format!("time (ms),light\n{}", rows.collect::<String>())).unwrap();
}

/// What `fit --report json` says of a trace, and the scene that it writes.
fn fitted(trace: &Path, scene: &Path, more: &[&str]) -> (serde_json::Value, String) {
    let mut args = vec!["fit".into(), trace.as_os_str().to_owned(), "--out".into(), scene.into()];
    args.extend(more.iter().map(OsString::from));
    args.extend(["--report".into(), "json".into()]);
    let (code, out, err) = run(args);
    assert_eq!(code, 0, "{err}");
    (serde_json::from_str(&out).unwrap(), fs::read_to_string(scene).unwrap())
}

/// A trigger's tick is the nearest to its time in the trace, from the start of opening; and from the edge, by two roundings.
#[test]
fn the_ticks_of_a_trace_that_no_model_explains_are_its_own_triggers() {
    let folder = folder("trace");
    let (trace, scene) = (folder.join("bounce.csv"), folder.join("bounce.toml"));
    // Where f32 would have lost the times, these are kept.
    for zero in [0.0, 3.6e6] {
        bounces(&trace, zero);
        let edge = format!("{}ms", zero + 1.0);
        let (json, text) = fitted(&trace, &scene, &["--triggers", "37", "--sync", &edge]);
        assert_eq!(json["triggers_from"], "trace");
        assert!(!text.contains("\nclose_end") && text.contains("\ntrigger_times = ["), "{text}");
        assert!(text.contains("no model explains the trace"), "{text}");

        let (code, out, err) = run([
            Path::new("plan"),
            &scene,
            Path::new("--emit=json"),
            Path::new("--set-up=emulated"),
            Path::new("--timer-hz=1MHz"),
            Path::new("--sync-falls=false"),
        ]);
        assert_eq!((code, err.as_str()), (0, ""));
        let plan: serde_json::Value = serde_json::from_str(&out).unwrap();
        let hz = plan["timer_hz"].as_f64().unwrap();
        let opens = json["opens_s"].as_f64().unwrap();
        let delay = opens - 1e-3 * (zero + 1.0);
        let triggers = json["triggers"].as_array().unwrap();
        assert_eq!(plan["triggers"].as_array().unwrap().len(), 37);
        for (given, planned) in triggers.iter().zip(plan["triggers"].as_array().unwrap()) {
            let time = given["time_s"].as_f64().unwrap();
            // The scene's eighth digit, and half a tick.
            let off =
                |ticks: &serde_json::Value, by: f64| (ticks.as_f64().unwrap() / hz - by).abs() * hz;
            assert!(off(&planned["ticks"], time - opens) < 0.51, "{given} {planned}");
            assert!(
                off(&planned["from_edge_ticks"], time - opens + delay) < 1.02,
                "{given} {planned}"
            );
            assert!((planned["time_s"].as_f64().unwrap() - time).abs() < 1e-9);
        }
        // They are not the model's, which differ by more than a tick, and whose errors say so.
        let models = json["model_triggers"].as_array().unwrap();
        let number = |of: &serde_json::Value, key: &str| of[key].as_f64().unwrap();
        let mut most = 0.0;
        for (own, model) in triggers.iter().zip(models) {
            let apart = (number(own, "time_s") - number(model, "time_s")).abs();
            assert!(number(model, "error_s") >= apart, "{own} {model}");
            most = f64::max(most, apart * hz);
        }
        assert!(most > 10.0);
    }
}

/// A blade that lets light through before it opens for good: ticks count from the first of it.
#[test]
fn light_before_the_opening_is_triggered_too() {
    let folder = folder("early");
    let (trace, scene) = (folder.join("early.csv"), folder.join("early.toml"));
    traced(&trace, 0.0, |t| openness(t).max(0.2 * f64::from((0.9..1.3).contains(&t))));
    let (json, text) = fitted(&trace, &scene, &["--triggers", "200"]);
    let times = Times::parse(&text).unwrap();
    // 0.08 ms of 6.08, in full light.
    let early = times.triggers.iter().filter(|trigger| trigger.time < 1.4e-3).count();
    assert!((2..=3).contains(&early), "{early}");
    let opens = json["opens_s"].as_f64().unwrap();
    // The dark is searched in twelfths, here of 0.4 ms.
    assert!((0.5e-3..=0.91e-3).contains(&opens), "{opens}");
    assert!((times.open_start - opens).abs() < 1e-9);
}

#[test]
fn who_asks_for_a_model_gets_its_curve_and_is_told() {
    let folder = folder("model");
    let (trace, scene) = (folder.join("bounce.csv"), folder.join("bounce.toml"));
    bounces(&trace, 0.0);
    let (json, text) = fitted(&trace, &scene, &["--model", "trapezoid"]);
    assert_eq!(json["triggers_from"], "trace");
    assert!(
        text.contains("\n# This curve does not explain the trace, and its triggers are not"),
        "{text}"
    );
    assert!(text.contains("\nclose_end = ") && !text.contains("trigger_times"), "{text}");
    assert_eq!(run([Path::new("plan"), &scene]).0, 0);
}

/// With time 0 at the opening, nothing else changes.
#[test]
fn time_0_is_where_it_is_asked_for() {
    let folder = folder("zero");
    let (trace, scene) = (folder.join("bounce.csv"), folder.join("bounce.toml"));
    bounces(&trace, 0.0);
    let plan = |zero: &str| {
        let (json, text) = fitted(&trace, &scene, &["--zero", zero]);
        (json["opens_s"].as_f64().unwrap(), Times::parse(&text).unwrap())
    };
    let ((opens, by_trace), (_, by_opening)) = (plan("trace"), plan("open"));
    assert_eq!(by_opening.open_start, 0.0);
    assert!((by_trace.open_start - opens).abs() < 1e-10);
    let ticks = |times: &Times| times.triggers.iter().map(|t| t.ticks).collect::<Vec<_>>();
    assert_eq!(ticks(&by_trace), ticks(&by_opening));
}

const GOOD: &str = "\
unit = 'ms'
open_start = 4.1
trigger_times = [
    5.0, 5.5,
    6.1004,
]
timer_hz = 1_000_000
min_gap = 0.1
";

#[test]
fn the_plan_says_that_there_is_no_curve_and_shows_the_times() {
    let folder = folder("plan");
    let (scene, picture) = (folder.join("bounce.toml"), folder.join("bounce.svg"));
    fs::write(&scene, format!("{GOOD}delay = 1\nnominal = 2\n")).unwrap();
    let (code, out, err) = run([Path::new("plan"), &scene, Path::new("--out"), &picture]);
    assert!(code == 0 && err.starts_with("wrote ") && err.lines().count() == 1, "{err}");
    for line in [
        "shutter      no curve: trigger times as measured",
        "opens        at 4.1 ms, from where ticks count",
        "nominal      2 ms",
        "gap          at least 0.1 ms; the closest two come 0.5 ms apart",
        "    #      time (ms)       ticks   from edge       gap (ms)",
        "    0         5.0000         900        1900              -",
        "    2         6.1004        2000        3000         0.6004",
    ] {
        assert!(out.contains(&format!("{line}\n")), "{line}\n{out}");
    }
    // The axis goes from the opening to the last trigger, with a mark for each.
    let axis = out.lines().find(|line| line.contains('┼')).unwrap();
    let marks: Vec<usize> =
        axis.chars().enumerate().filter(|(_, c)| *c == '┼').map(|(i, _)| i).collect();
    assert_eq!(marks, [32, 50, 71]);
    // Its mark, and a dot on it, and the sync.
    let svg = fs::read_to_string(&picture).unwrap();
    assert_eq!(svg.matches(r##"r="32" opacity="1" fill="#D55E00""##).count(), 3);
    for words in ["no curve: 3 triggers as measured", "sync", "opens"] {
        assert!(svg.contains(words), "{words}");
    }
    let set_ups = folder.join("set-ups.svg");
    let (code, _, err) = run([Path::new("plan"), &scene, Path::new("--set-ups"), &set_ups]);
    assert_eq!(code, 2);
    assert!(err.contains("the set-ups are told apart by a curve, and the scene has none"), "{err}");
    assert!(!set_ups.exists());
}

/// A lone trigger at the opening has no time to be drawn along.
#[test]
fn one_trigger_at_the_opening_is_planned_and_drawn() {
    let folder = folder("one");
    let (scene, picture) = (folder.join("one.toml"), folder.join("one.svg"));
    fs::write(&scene, "open_start = 1\ntrigger_times = [1]\ntimer_hz = 10\nmin_gap = 0\n").unwrap();
    let (code, out, err) = run([Path::new("plan"), &scene, Path::new("--out"), &picture]);
    assert!(code == 0 && err.starts_with("wrote ") && err.lines().count() == 1, "{err}");
    assert!(out.contains("    0           1000           0"), "{out}");
    assert!(picture.exists());
}

#[test]
fn speeds_with_and_without_a_curve_are_a_table() {
    let folder = folder("speeds");
    let (times, curve) = (folder.join("a.toml"), folder.join("b.toml"));
    fs::write(&times, format!("{GOOD}nominal = 2\n")).unwrap();
    fs::write(&curve, "open_start = 0\nopen_end = 1\nclose_start = 4\nclose_end = 5\ntriggers = 4\ntimer_hz = 1000\nmin_gap = 0\n").unwrap();
    let (code, out, _) = run([Path::new("plan"), &times, &curve]);
    assert_eq!(code, 0);
    let rows: Vec<Vec<&str>> = out.lines().map(|line| line.split_whitespace().collect()).collect();
    assert_eq!(rows[1], ["a", "2", "ms", "-", "-", "-", "-", "3", "as", "measured"]);
    assert_eq!(rows[2][..3], ["b", "-", "4"]);
}

#[test]
fn what_is_wrong_with_given_times_is_refused_at_its_place() {
    let with = |from: &str, to: &str| {
        assert!(GOOD.contains(from));
        GOOD.replace(from, to)
    };
    let added = |line: &str| format!("{GOOD}{line}\n");
    let no_curve = "it is a curve's, and the triggers of this scene are given by their times";
    let no_pulses = "pulses are checked against a curve, and a scene with trigger_times has none";
    let far = "trigger 2 comes more than 2^31 ticks after open_start; count from nearer to it, or take a slower timer";
    for (text, line, reason) in [
        (added("close_end = 9"), Some(9), format!("close_end: {no_curve}")),
        (added("shutteropening = 9"), Some(9), format!("shutteropening: {no_curve}")),
        (added("triggers = 3"), Some(9), "triggers: their number is that of trigger_times".into()),
        (added("pulse = 0.1"), Some(9), format!("pulse: {no_pulses}")),
        (added("duty = 0.1"), Some(9), format!("duty: {no_pulses}")),
        (added("min_pulse = 0.1"), Some(9), format!("min_pulse: {no_pulses}")),
        (with("open_start = 4.1\n", ""), None, "missing field `open_start`".into()),
        (with("min_gap = 0.1\n", ""), None, "missing field `min_gap`".into()),
        (with("5.5", "'5.5'"), Some(3), "trigger_times: a number is required".into()),
        (with("5.5", "nan"), Some(4), "trigger_times: a finite number is required".into()),
        (with("4.1", "inf"), Some(2), "open_start: a finite number is required".into()),
        (
            with("5.0, 5.5,\n    6.1004,", ""),
            Some(3),
            "trigger_times: 1 to 10000 can be planned, not 0".into(),
        ),
        (with("6.1004", "5.2"), Some(5), "trigger_times: trigger 2 comes before trigger 1".into()),
        (
            with("5.0", "4.0"),
            Some(4),
            "trigger_times: trigger 0 comes before open_start, from where ticks count".into(),
        ),
        (
            with("6.1004", "5.5991"),
            Some(5),
            "trigger_times: triggers 1 and 2 come 99 ticks apart, and 100 are required".into(),
        ),
        (
            // Whatever the lamp needs, a timer fires once a tick.
            with("min_gap = 0.1", "min_gap = 0").replace("6.1004", "5.5001"),
            Some(5),
            "trigger_times: triggers 1 and 2 come 0 ticks apart, and 1 is required".into(),
        ),
        (with("6.1004", "3e6"), Some(5), format!("trigger_times: {far}")),
        (
            with("1_000_000", "0"),
            Some(7),
            "timer_hz: a rate from 1 to 4294967295 is required".into(),
        ),
        (with("min_gap = 0.1", "min_gap = -1"), Some(8), "min_gap: 0 or more is required".into()),
        (added("nominal = 0"), Some(9), "nominal: more than 0 is required".into()),
        (
            added("delay = -1"),
            Some(9),
            "delay: 0 or more is required; an edge cannot trigger what comes before it".into(),
        ),
    ] {
        let fault = Times::parse(&text).expect_err(&reason);
        assert_eq!(fault.reason(), reason, "{text}");
        let at = fault.at.map(|at| text[..at].matches('\n').count() + 1);
        assert_eq!(at, line, "{reason}");
    }
    // At the limits, and just beyond.
    let many = |n: u32| {
        let times: Vec<String> = (0..n).map(|i| format!("{}", 5 + i)).collect();
        format!(
            "open_start = 0\ntrigger_times = [{}]\ntimer_hz = 1\nmin_gap = 0\n",
            times.join(",")
        )
    };
    assert_eq!(Times::parse(&many(10_000)).unwrap().triggers.len(), 10_000);
    assert!(Times::parse(&many(10_001)).is_err());
    assert_eq!(Times::parse(&with("6.1004", "2147487.748")).unwrap().triggers[2].ticks, 1 << 31);
    assert!(Times::parse(&with("6.1004", "2147487.749")).is_err());
}

/// Whoever needs a curve is told that there is none, rather than of an unknown key.
#[test]
fn where_a_curve_is_required_such_a_scene_is_refused_by_its_name() {
    let fault = scene::parse(GOOD).err().unwrap();
    assert!(
        fault.reason().starts_with("trigger_times: this scene has times as they were measured")
    );
    assert_eq!(fault.at.map(|at| &GOOD[at..at + 13]), Some("trigger_times"));
}
