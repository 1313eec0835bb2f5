//! Between the scene and the lamp: set-up, edge, timer, lag. What nobody gave is asked for, and what fires wrongly is
//! refused.

use serde_json::{Value, json};
use shutter_plan::emit::{Form, emit, several};
use shutter_plan::lamp::SetUp;
use shutter_plan::plan::Plan;

use crate::refusals::{LEAF, with};
use crate::support::{Folder, has, planned, report, table};

fn hardware(changes: &str) -> Plan {
    planned(LEAF, &format!("timer_hz = 1_000_000; set_up = 'in_path'; {changes}"))
}

fn text(form: Form, plan: &Plan) -> String {
    emit(form, "scene", plan, false).unwrap()
}

fn object(plan: &Plan) -> Value {
    serde_json::from_str(&text(Form::Json, plan)).unwrap()
}

/// A column of the objects.
fn column(plan: &Plan, key: &str) -> Vec<f64> {
    object(plan)["triggers"].as_array().unwrap().iter().map(|it| it[key].as_f64().unwrap()).collect()
}

#[test]
fn a_shutter_in_the_path_dims_flashes_and_says_by_how_much() {
    let plan = hardware("triggers = 5");
    // The triggers come where 0.55, 1.65 ... of 5.5 ms are collected: at openness sqrt(1.1), which is 1, and so on.
    let open = |t: f64| (t - 1.0).min((8.0 - t) / 2.0).clamp(0.0, 1.0);
    for (dose, time) in column(&plan, "dose").into_iter().zip(column(&plan, "time_s")) {
        assert!((dose - open(1e3 * time)).abs() < 1e-3, "{dose} {time}");
    }
    let dimmed = hardware("triggers = 11");
    let told = "set-up       in the light's path, which dims the flashes to 70.7, 100 and 50 %\n";
    has(&report(&dimmed), &[told, "dose (%)", "      70.7 "], &[]);
    has(&text(Form::Rust, &dimmed), &[&format!("\n// {told}")], &[]);
    // Equal pulses are dimmed as well, those of duty are not; the camera's own shutter dims none.
    let pulses = column(&hardware("triggers = 11; pulse = 0.1"), "dose");
    assert!((pulses[0] - 0.707).abs() < 1e-2 && pulses[5] == 1.0, "{pulses:?}");
    let equal = column(&hardware("triggers = 11; duty = 0.5"), "dose");
    assert!(equal.iter().all(|dose| (dose - 1.0).abs() < 0.01), "{equal:?}");
    assert_eq!(column(&hardware("triggers = 11; set_up = 'emulated'"), "dose"), [1.0; 11]);
}

/// Flashes of one length get one dose each where the shutter is fully open.
#[test]
fn fully_open_spreads_flashes_over_the_plateau() {
    let plan = hardware("fully_open = true");
    assert_eq!(column(&plan, "ticks"), [1500.0, 2500.0, 3500.0, 4500.0]);
    assert_eq!(column(&plan, "dose"), [1.0; 4]);
    has(&report(&plan), &["set-up       in the light's path; one dose each, while it is fully open\n"], &[]);
    assert_ne!(column(&hardware("fully_open = false"), "ticks"), column(&plan, "ticks"));
}

/// A lamp that shines late is triggered as much earlier: from the edge as from the opening.
#[test]
fn a_lamps_lag_is_taken_off() {
    let delay = "delay = 2; sync_falls = true; ";
    let plain = [1500.0, 2500.0, 3500.0, 4500.0];
    for (keys, delay_ticks, less, less_from_edge) in [
        ("lamp_lag = 0.7", None, 700.0, None),
        ("delay = 2; sync_falls = true; lamp_lag = 0.7", Some(1300), 0.0, Some(-1300.0)),
        // What is longer than the delay is taken off the ticks.
        ("delay = 2; sync_falls = true; lamp_lag = 3.5", Some(0), 1500.0, Some(1500.0)),
    ] {
        let plan = hardware(&format!("fully_open = true; {keys}"));
        assert_eq!(object(&plan)["delay_ticks"].as_u64(), delay_ticks, "{keys}");
        assert_eq!(column(&plan, "ticks"), plain.map(|tick| tick - less), "{keys}");
        if let Some(less) = less_from_edge {
            assert_eq!(column(&plan, "from_edge_ticks"), plain.map(|tick| tick - less), "{keys}");
        }
    }
    let [late, longer] = ["0.7", "3"].map(|lag| hardware(&format!("{delay}lamp_lag = {lag}")));
    has(&report(&late), &["lamp lag     0.7 ms: the lamp is triggered so much earlier\n"], &[]);
    for form in [Form::Rust, Form::C] {
        // What is said of all ticks of an array holds for the one that opens early as well.
        let both = [("plain".into(), hardware(delay)), ("early".into(), hardware("sync_falls = true; delay = -0.2"))];
        let both = several(form, "both", &both, false).unwrap();
        assert_eq!(both.matches("counted from the end of the delay").count(), 2, "{both}");
        let late = text(form, &late);
        let told =
            [" to the start of opening, less the lamp's lag.", "When to trigger, counted from the end of the delay."];
        has(&late, &told, &[]);
        has(&text(form, &longer), &["No delay is left: the lamp's lag is longer"], &[]);
    }
    // Pulses, and times without a curve.
    let pulse = hardware("triggers = 1; lamp_lag = 1; pulse = 1");
    let edges = ["ticks", "on_ticks", "off_ticks"].map(|key| column(&pulse, key)[0]);
    assert_eq!(edges, [2250.0, 1750.0, 2750.0]);
    let times = "unit = 'ms'\nopen_start = 1\ntrigger_times = [2, 3]\ntimer_hz = 1000\nmin_gap = 0\n\
                 set_up = 'emulated'\nlamp_lag = 1";
    assert_eq!(column(&planned(times, ""), "ticks"), [0.0, 1.0]);
}

/// Without a rate there are times, and no tick of a rate that nobody gave.
#[test]
fn a_scene_without_a_timer_is_reported_in_times() {
    let text = report(&planned(LEAF, "delay = 2; duty = 0.5; timer_bits = 16"));
    has(&text, &["timer        none, so there are times alone; timer_hz gives ticks\n"], &[]);
    let (_, below) = text.split_once("\n    #").unwrap();
    assert!(!below.contains("ticks") && !text.contains("drift"), "{text}");
    // The first pulse, of a quarter of the first share: from 0.34375 to 1.03125 ms of full light.
    let first = &table(&text)[0];
    let row: Vec<f64> = first.iter().filter_map(|it| it.parse().ok()).collect();
    let time = |light: f64| 2.0 + if light < 0.5 { (2.0 * light).sqrt() } else { 0.5 + light };
    for (told, light) in row[2..].iter().zip([0.6875, 0.34375, 1.03125]) {
        assert!((told - time(light)).abs() < 1e-5, "{row:?}");
    }
    // However short or long the frame and its delay are.
    for keys in ["unit = 'ns'; delay = 0", "unit = 's'; delay = 0", "delay = 1e9"] {
        planned(LEAF, keys);
    }
}

/// What the command line says counts for one run, and is refused where the scene's own would be.
#[test]
fn the_command_line_answers_for_one_run() {
    let folder = Folder::new("line");
    folder.write("scene.toml", with(LEAF, "delay = 2"));
    folder.write("pulse.toml", with(LEAF, "delay = 2; pulse = 0.1"));
    let line = "plan scene.toml --emit json --timer-hz 1MHz";
    let answers = format!("{line} --set-up in_path --sync-falls true");
    for (more, keys) in [
        ("--pulse 100us", "pulse = 0.1"),
        ("--fully-open --lamp-lag 1ms", "fully_open = true; lamp_lag = 1"),
        ("--duty 0.5 --min-pulse 10us", "duty = 0.5; min_pulse = 0.01"),
    ] {
        let whole = hardware(&format!("delay = 2; sync_falls = true; {keys}"));
        let run = folder.run(&format!("{answers} {more}")).well();
        assert_eq!(run.out, text(Form::Json, &whole));
        // In every form, a table as well.
        assert_eq!(run.err.contains("dims the flashes to"), more.contains("--pulse"), "{}", run.err);
    }
    folder.refuses(&[
        (&format!("{answers} --duty 0.5 --fully-open"), "cannot be used with"),
        // As in the file: no pulse is dropped without a word.
        ("plan pulse.toml --fully-open --set-up in_path", "fully_open: it is for flashes whose length"),
        ("plan pulse.toml --duty 0.5", "duty: a scene has `duty` or `pulse`"),
        (line, "set_up = \"in_path\""),
        (line, "sync_falls"),
    ]);
}

/// What a scene keeps of its fit goes along: the bound of the efficiency, and each doubt. Comments are comments.
#[test]
fn what_the_fit_doubted_is_in_every_form() {
    let measured = "[shutter.measured]\ntrace = \"x.csv\"\nmodel = \"straight ramps\"\nunit = \"ms\"\nexposure = 5.5\n\
                    exposure_error = 0.1\nefficiency = \"at most 80 %\"\nwarnings = [\"the lamp flickers\"]\n[flashes]";
    let comments = "# Exposure bracket: 3 frames\n# Warning: do not look into the lamp\n";
    let times = "unit = 'ms'\nopen_start = 1\ntrigger_times = [2]\nmin_gap = 0\n";
    for scene in [LEAF, times] {
        let text = comments.to_string()
            + &with(scene, &format!("set_up = 'emulated'; timer_hz = 1_000_000; [flashes] -> {measured}"));
        let plan = Plan::parse(&text).unwrap();
        for form in [Form::Rust, Form::C] {
            let text = self::text(form, &plan);
            let measured = "measured     exposure 5.50 ± 0.10 ms, efficiency at most 80 %\n";
            has(&text, &[measured, "doubt        the lamp flickers\n"], &["bracket", "do not look"]);
        }
        let doubts = &object(&plan)["doubts"];
        assert_eq!(doubts[0], json!({ "code": "trace", "text": "the lamp flickers", "remedy": null }));
        // Without its checksum, anything may have been changed.
        assert_eq!(doubts[1]["code"], "edited");
        has(&report(&plan), &["\ndoubt        the lamp flickers\n"], &["do not look"]);
    }
}

#[test]
fn a_set_up_has_the_name_that_a_scene_gives_it() {
    for set_up in [SetUp::Emulated, SetUp::InPath] {
        assert_eq!(planned(LEAF, &format!("set_up = '{}'", set_up.name())).scene.flashes.set_up, Some(set_up));
    }
}
