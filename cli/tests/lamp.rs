//! Between the scene and the lamp: set-up, edge, timer, lag. What nobody gave is asked for, and what fires wrongly is refused.

use std::fs;
use std::path::{Path, PathBuf};

use shutter::emit::{Form, emit};
use shutter::lamp::SetUp;
use shutter::planned::Planned;

/// Opens in 1 ms, is open for 4, closes in 2.
const SCENE: &str =
    "unit = 'ms'\nopen_start = 1\nopen_end = 2\nclose_start = 6\nclose_end = 8\nmin_gap = 0\n";

fn planned(keys: &str) -> Planned {
    let text = format!("{SCENE}{keys}");
    Planned::parse(&text).map_err(|fault| fault.locate("scene", &text)).unwrap()
}

/// The reason why a scene with these keys is refused.
fn refused(keys: &str) -> String {
    Planned::parse(&format!("{SCENE}{keys}")).err().unwrap_or_else(|| panic!("{keys}")).reason()
}

fn report(keys: &str) -> String {
    shutter::report::text("scene", &planned(keys), 80)
}

fn json(plan: &Planned) -> serde_json::Value {
    serde_json::from_str(&emit(Form::Json, "scene", plan, false).unwrap()).unwrap()
}

/// A column of the objects.
fn column(json: &serde_json::Value, key: &str) -> Vec<f64> {
    let triggers = json["triggers"].as_array().unwrap();
    triggers.iter().map(|it| it[key].as_f64().unwrap()).collect()
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("lamp").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// A run of the program: its code, and what it printed.
fn run(args: &[&str]) -> (u8, String) {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let args = ["shutter"].iter().chain(args).map(Into::into);
    let code = shutter::command::run(args, &mut out, &mut err);
    out.extend(err);
    (code, String::from_utf8(out).unwrap())
}

const HARDWARE: &str = "timer_hz = 1_000_000\nset_up = 'in_path'\n";

#[test]
fn a_shutter_in_the_path_dims_flashes_and_says_by_how_much() {
    let plan = planned(&format!("{HARDWARE}triggers = 5\n"));
    let json = json(&plan);
    // The triggers come where 0.55, 1.65 ... of 5.5 ms are collected: at openness sqrt(1.1), which is 1, and so on.
    let open = |t: f64| (t - 1.0).min((8.0 - t) / 2.0).clamp(0.0, 1.0);
    let expected = column(&json, "time_s").into_iter().map(|t| open(1e3 * t));
    for (dose, expected) in column(&json, "dose").into_iter().zip(expected) {
        assert!((dose - expected).abs() < 1e-3, "{dose} {expected}");
    }
    let text = report(&format!("{HARDWARE}triggers = 11\n"));
    assert!(
        text.contains(
            "set-up       in the light's path, which dims the flashes to 70.7, 100 and 50 %\n"
        ),
        "{text}"
    );
    assert!(text.contains("dose (%)") && text.contains("      70.7 "), "{text}");
    let module = emit(Form::Rust, "scene", &planned(&format!("{HARDWARE}triggers = 11\n")), false);
    assert!(module.unwrap().contains(
        "\n// set-up       in the light's path, which dims the flashes to 70.7, 100 and 50 %\n"
    ));
    // Equal pulses are dimmed as well, those of duty are not; the camera's own shutter dims none.
    let doses = |keys: &str| column(&self::json(&planned(keys)), "dose");
    let pulses = doses(&format!("{HARDWARE}triggers = 11\npulse = 0.1\n"));
    assert!((pulses[0] - 0.707).abs() < 1e-2 && pulses[5] == 1.0, "{pulses:?}");
    let equal = doses(&format!("{HARDWARE}triggers = 11\nduty = 0.5\n"));
    assert!(equal.iter().all(|dose| (dose - 1.0).abs() < 0.01), "{equal:?}");
    let emulated = doses("timer_hz = 1_000_000\nset_up = 'emulated'\ntriggers = 11\n");
    assert_eq!(emulated, [1.0; 11]);
}

/// Flashes of one length get one dose each where the shutter is fully open.
#[test]
fn fully_open_spreads_flashes_over_the_plateau() {
    let keys = format!("{HARDWARE}triggers = 4\nfully_open = true\n");
    let json = json(&planned(&keys));
    assert_eq!(column(&json, "ticks"), [1500.0, 2500.0, 3500.0, 4500.0]);
    assert_eq!(column(&json, "dose"), [1.0; 4]);
    let text = report(&keys);
    assert!(
        text.contains("set-up       in the light's path; one dose each, while it is fully open\n"),
        "{text}"
    );
    let plain = planned(&format!("{HARDWARE}triggers = 4\nfully_open = false\n"));
    assert_ne!(column(&self::json(&plain), "ticks"), column(&json, "ticks"));
    // No tick is rounded to where the shutter moves.
    let slow = refused("timer_hz = 100\nset_up = 'in_path'\nfully_open = true\ntriggers = 1\n");
    assert_eq!(slow, "the frame does not fit; no number of triggers keeps that");
    let none = SCENE.replace("close_start = 6", "close_start = 2") + &keys;
    let reason = Planned::parse(&none).err().unwrap().reason();
    assert_eq!(reason, "fully_open: this shutter begins to close as soon as it is open");
}

#[test]
fn what_is_for_the_other_set_up_is_refused() {
    for (keys, reason) in [
        (
            "set_up = 'emulated'\nduty = 0.5\n",
            "duty: it is for a shutter in the light's path, and set_up is \"emulated\"; there, `pulse` makes equal pulses",
        ),
        (
            "set_up = 'emulated'\nfully_open = true\n",
            "fully_open: it is for a shutter in the light's path, and set_up is \"emulated\"; there, flashes come at the triggers",
        ),
        (
            "fully_open = true\nduty = 0.5\n",
            "fully_open: it is for flashes whose length is the lamp's own, and this scene makes pulses",
        ),
        (
            "fully_open = true\npulse = 0.1\n",
            "fully_open: it is for flashes whose length is the lamp's own, and this scene makes pulses",
        ),
        ("set_up = 'xenon'\n", "set_up: \"emulated\" or \"in_path\" is required"),
        ("sync_falls = 1\ndelay = 1\n", "sync_falls: true or false is required"),
        ("sync_falls = true\n", "sync_falls: it goes with a delay"),
    ] {
        assert_eq!(refused(&format!("triggers = 4\n{keys}")), reason);
    }
    let times =
        "unit = 'ms'\nopen_start = 1\ntrigger_times = [2, 3]\ntimer_hz = 1000\nmin_gap = 0\n";
    let reason = |keys: &str| Planned::parse(&format!("{times}{keys}")).err().unwrap().reason();
    assert!(reason("set_up = 'in_path'\n").contains("comes from its curve"));
    assert!(reason("fully_open = true\n").contains("this scene has none"));
    // Nobody is left with the one set-up that is offered.
    let asked = emit(Form::C, "times", &Planned::parse(times).unwrap(), false).unwrap_err();
    assert!(asked.contains("in the light's path it needs a curve"), "{asked}");
}

/// A lamp that shines late is triggered as much earlier: from the edge as from the opening.
#[test]
fn a_lamps_lag_is_taken_off() {
    let ticks = |keys: &str| {
        let json = json(&planned(&format!("{HARDWARE}triggers = 4\nfully_open = true\n{keys}")));
        let from = if json["delay_ticks"].is_null() { "ticks" } else { "from_edge_ticks" };
        (json["delay_ticks"].as_u64(), column(&json, "ticks"), column(&json, from))
    };
    let plain = [1500.0, 2500.0, 3500.0, 4500.0];
    let off = |by: f64| plain.map(|tick| tick - by);
    assert_eq!(ticks("lamp_lag = 0.7\n"), (None, off(700.0).into(), off(700.0).into()));
    let delay = "delay = 2\nsync_falls = true\n";
    assert_eq!(
        ticks(&format!("{delay}lamp_lag = 0.7\n")),
        (Some(1300), plain.into(), off(-1300.0).into())
    );
    // What is longer than the delay is taken off the ticks.
    assert_eq!(
        ticks(&format!("{delay}lamp_lag = 3.5\n")),
        (Some(0), off(1500.0).into(), off(1500.0).into())
    );
    let text = report(&format!("{HARDWARE}triggers = 4\n{delay}lamp_lag = 0.7\n"));
    assert!(
        text.contains("lamp lag     0.7 ms: the lamp is triggered so much earlier\n"),
        "{text}"
    );
    let late = format!("{HARDWARE}triggers = 4\n{delay}lamp_lag = 0.7\n");
    for form in [Form::Rust, Form::C] {
        let text = emit(form, "scene", &planned(&late), false).unwrap();
        assert!(text.contains(" to the start of opening, less the lamp's lag."), "{text}");
        assert!(text.contains("When to trigger, counted from the end of the delay."), "{text}");
        let longer = planned(&late.replace("lamp_lag = 0.7", "lamp_lag = 3"));
        let text = emit(form, "scene", &longer, false).unwrap();
        assert!(text.contains("No delay is left: the lamp's lag is longer"), "{text}");
    }
    // Pulses, and below times without a curve.
    let keys = "triggers = 1\nlamp_lag = 1\npulse = 1\n";
    let pulse = json(&planned(&format!("{HARDWARE}{keys}")));
    let [tick, on, off] = ["ticks", "on_ticks", "off_ticks"].map(|key| column(&pulse, key)[0]);
    assert_eq!([tick, on, off], [2250.0, 1750.0, 2750.0]);
    for (keys, reason) in [
        (
            "lamp_lag = 1.6\n".to_string(),
            "lamp_lag: the first trigger would come 0.1 ms before the start of opening, from where ticks count without a delay; a lag of 1.5 ms is the most",
        ),
        (
            format!("{delay}lamp_lag = 3.75\n"),
            "lamp_lag: the first trigger would come 0.25 ms before the edge of the sync; a lag of 3.5 ms is the most",
        ),
        ("lamp_lag = -1\n".into(), "lamp_lag: 0 or more is required"),
        ("lamp_lag = inf\n".into(), "lamp_lag: a finite number is required"),
    ] {
        assert_eq!(refused(&format!("{HARDWARE}triggers = 4\nfully_open = true\n{keys}")), reason);
    }
    let times = "unit = 'ms'\nopen_start = 1\ntrigger_times = [2, 3]\ntimer_hz = 1000\nmin_gap = 0\nset_up = 'emulated'\nlamp_lag = ";
    let plan = Planned::parse(&format!("{times}1")).unwrap();
    assert_eq!(column(&json(&plan), "ticks"), [0.0, 1.0]);
    assert!(Planned::parse(&format!("{times}2")).is_err());
}

/// Without a rate there are times, and no tick of a rate that nobody gave.
#[test]
fn a_scene_without_a_timer_is_reported_in_times() {
    let text = report("triggers = 4\ndelay = 2\nduty = 0.5\ntimer_bits = 16\n");
    assert!(
        text.contains("timer        none, so there are times alone; timer_hz gives ticks\n"),
        "{text}"
    );
    let (_, table) = text.split_once("\n    #").unwrap();
    assert!(
        !table.contains("ticks") && !table.contains("edge") && !text.contains("drift"),
        "{text}"
    );
    // The first pulse, of a quarter of the first share: from 0.34375 to 1.03125 ms of full light.
    let row: Vec<f64> =
        table.lines().nth(1).unwrap().split_whitespace().filter_map(|it| it.parse().ok()).collect();
    let time = |light: f64| 1.0 + if light < 0.5 { (2.0 * light).sqrt() } else { 0.5 + light };
    for (told, light) in row[2..].iter().zip([0.6875, 0.34375, 1.03125]) {
        assert!((told - time(light)).abs() < 1e-5, "{row:?}");
    }
    // What is refused is told in times as well.
    let close = SCENE.replace("min_gap = 0\n", "min_gap = 1.2\n") + "triggers = 5\n";
    let reason = Planned::parse(&close).err().unwrap().reason();
    assert_eq!(
        reason,
        "triggers 0 and 1 come 1.1 ms apart, and 1.2 ms is required; up to 4 triggers keep that"
    );
    // However short or long the frame and its delay are.
    for (unit, delay) in [("ns", "0"), ("s", "0"), ("ms", "1e9")] {
        let text =
            format!("{SCENE}triggers = 4\ndelay = {delay}\n").replace("'ms'", &format!("'{unit}'"));
        assert!(Planned::parse(&text).is_ok(), "{text}");
    }
}

/// What the command line says counts for one run, and is refused where the scene's own would be.
#[test]
fn the_command_line_answers_for_one_run() {
    let file = folder("line").join("scene.toml");
    let file = file.to_str().unwrap();
    let bare = format!("{SCENE}triggers = 4\ndelay = 2\npulse = 0.1\n");
    fs::write(file, &bare).unwrap();
    let answers = ["--set-up", "in_path", "--timer-hz", "1MHz", "--sync-falls", "true"];
    let plan =
        |more: &[&str]| run(&[&["plan", file, "--emit", "json"], &answers[..], more].concat());
    let whole =
        planned(&format!("{HARDWARE}triggers = 4\ndelay = 2\nsync_falls = true\npulse = 0.1\n"));
    assert_eq!(plan(&[]), (0, emit(Form::Json, "scene", &whole, false).unwrap()));
    let whole = planned(&format!(
        "{HARDWARE}triggers = 4\ndelay = 2\nsync_falls = true\nfully_open = true\n"
    ));
    assert_eq!(plan(&["--fully-open"]), (0, emit(Form::Json, "scene", &whole, false).unwrap()));
    let whole =
        planned(&format!("{HARDWARE}triggers = 4\ndelay = 2\nsync_falls = true\nduty = 0.5\n"));
    assert_eq!(plan(&["--duty", "0.5"]), (0, emit(Form::Json, "scene", &whole, false).unwrap()));
    let (code, told) = plan(&["--duty", "0.5", "--fully-open"]);
    assert!(code == 2 && told.contains("cannot be used with"), "{told}");
    let (code, told) = run(&["plan", file, "--emit", "json", "--timer-hz", "1MHz"]);
    assert!(
        code == 2 && told.contains("set_up = \"in_path\"") && told.contains("sync_falls"),
        "{told}"
    );
    assert_eq!(fs::read_to_string(file).unwrap(), bare);
}

/// What a scene keeps of its fit goes along: the bound of the efficiency, and each doubt.
#[test]
fn what_the_fit_doubted_is_in_every_form() {
    let head = "# Fitted to x.csv: straight ramps.\n# Exposure 5.5 ± 0.1 ms, efficiency at most 80 %, standard errors behind ±.\n\
                # Warning: the lamp flickers.\n";
    let plan = |text: String| Planned::parse(&text).unwrap();
    let curve = plan(format!("{head}{SCENE}{HARDWARE}triggers = 4\n# Warning: not the fit's.\n"));
    let times = "unit = 'ms'\nopen_start = 1\ntrigger_times = [2]\ntimer_hz = 1000\nmin_gap = 0\nset_up = 'emulated'\n";
    for plan in [curve, plan(format!("{head}{times}"))] {
        for form in [Form::Rust, Form::C] {
            let text = emit(form, "scene", &plan, false).unwrap();
            assert!(
                text.contains("measured     exposure 5.5 ± 0.1 ms, efficiency at most 80 %\n"),
                "{text}"
            );
            assert!(
                text.contains("doubt        the lamp flickers.\n")
                    && !text.contains("not the fit's"),
                "{text}"
            );
        }
        assert_eq!(json(&plan)["doubts"], serde_json::json!(["the lamp flickers."]));
        assert!(
            shutter::report::text("scene", &plan, 80)
                .contains("\ndoubt        the lamp flickers.\n")
        );
    }
}

#[test]
fn a_set_up_has_the_name_that_a_scene_gives_it() {
    for set_up in [SetUp::Emulated, SetUp::InPath] {
        let plan = planned(&format!("triggers = 1\nset_up = '{}'\n", set_up.name()));
        assert_eq!(plan.set_up, Some(set_up));
    }
}
