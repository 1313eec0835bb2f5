//! Between the scene and the lamp: set-up, edge, timer, lag. What nobody gave is asked for, and what fires wrongly is
//! refused.

use serde_json::{Value, json};
use shutter_plan::emit::{Form, emit, several};
use shutter_plan::lamp::SetUp;
use shutter_plan::plan::Plan;

use crate::scenes::{LEAF, with};
use crate::support::{Folder, has, planned, report};

fn hardware(changes: &str) -> Plan {
    planned(LEAF, &format!("timer_hz = 1_000_000; set_up = 'in_path'; {changes}"))
}

fn text(form: Form, plan: &Plan) -> String {
    emit(form, "scene", plan, false).unwrap()
}

fn object(plan: &Plan) -> Value {
    serde_json::from_str(&text(Form::Json, plan)).unwrap()
}

/// A module says from where its ticks count; what an array says of all holds for the one that is moved as well.
#[test]
fn a_module_says_what_its_ticks_count_from() {
    let delay = "delay = 2; sync_falls = true; ";
    for form in [Form::Rust, Form::C] {
        for (keys, told) in [
            ("lamp_lag = 0.7", " to the start of opening, less the lamp's lag."),
            ("lamp_lag = 3", "No delay is left: the lamp's lag is longer"),
            ("delay = -0.2", "None: the shutter opens before the edge"),
        ] {
            let moved = hardware(&format!("{delay}{keys}"));
            has(&text(form, &moved), &[told, "When to trigger, counted from the end of the delay."], &[]);
            if keys == "delay = -0.2" {
                let both = [("plain".into(), hardware(delay)), ("early".into(), moved)];
                let both = several(form, "both", &both, false).unwrap();
                assert_eq!(both.matches("counted from the end of the delay").count(), 2, "{both}");
            }
        }
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
