//! Trigger times without a curve: a trace that no model explains becomes a scene of its own triggers, which `shutter
//! plan` turns into ticks.

use serde_json::Value;
use shutter_plan::plan::Plan;

use crate::scenes::{TIMES, TRAPEZOID, tables, with};
use crate::support::{Folder, number, rows, sampled};

/// Blades that bounce: between two dips they are open.
fn bounces(t: f64) -> f64 {
    let dip = |at: f64| 0.35 * (-((t - at) / 0.15).powi(2)).exp();
    openness(t) * (1.0 - dip(3.3) - 0.5 * dip(4.0))
}

/// Opens from 2 to 3 ms, and closes from 8 to 9.
fn openness(t: f64) -> f64 {
    (t - 2.0).min(9.0 - t).clamp(0.0, 1.0)
}

/// A folder with a trace in ms that starts at a time.
fn folder(name: &str, zero: f64, light: fn(f64) -> f64) -> Folder {
    let folder = Folder::new(&format!("times_{name}"));
    let trace = sampled(|t| light(1e3 * t), 2400, 0.003);
    let rows = rows(&trace, |t, v| format!("{:.3},{v:.5}", zero + 1e3 * t));
    folder.write("a.csv", format!("time (ms),light\n{rows}"));
    folder
}

/// What `fit --report json` says of the trace, and the scene that it writes.
fn fitted(folder: &Folder, more: &str) -> (Value, String) {
    let json = folder.json(&format!("a.csv --out a.toml {more}"));
    (json, folder.text("a.toml"))
}

/// A trigger's tick is the nearest to its time in the trace, from the start of opening; and from the edge, by two
/// roundings.
#[test]
fn the_ticks_of_a_trace_that_no_model_explains_are_its_own_triggers() {
    // Where f32 would have lost the times, these are kept.
    for zero in [0.0, 3.6e6] {
        let folder = folder("trace", zero, bounces);
        let (json, text) = fitted(&folder, &format!("--triggers 37 --sync {}ms", zero + 1.0));
        assert_eq!(json["triggers_from"], "trace");
        assert!(!text.contains("\nclose_end") && text.contains("\ntrigger_times = ["), "{text}");
        assert!(text.contains("\nmodel = \"none explains the trace: its own 37 triggers; --model "), "{text}");

        let plan = "plan a.toml --emit=json --set-up=emulated --timer-hz=1MHz --min-gap=0 --sync-falls=false";
        let plan: Value = serde_json::from_str(&folder.run(plan).well().out).unwrap();
        let (hz, opens) = (number(&plan, "timer_hz"), number(&json, "opens_s"));
        let delay = opens - 1e-3 * (zero + 1.0);
        let [triggers, models] = ["triggers", "model_triggers"].map(|key| json[key].as_array().unwrap());
        assert_eq!(plan["triggers"].as_array().unwrap().len(), 37);
        for (given, planned) in triggers.iter().zip(plan["triggers"].as_array().unwrap()) {
            let time = number(given, "time_s");
            // The scene's eighth digit, and half a tick.
            let off = |key: &str, by: f64| (number(planned, key) / hz - by).abs() * hz;
            assert!(off("ticks", time - opens) < 0.51, "{given} {planned}");
            assert!(off("from_edge_ticks", time - opens + delay) < 1.02, "{given} {planned}");
            assert!((number(planned, "time_s") - (time - opens)).abs() < 1e-9);
        }
        // They are not the model's, which differ by more than a tick, and whose errors say so.
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
    let early = |t: f64| openness(t).max(0.2 * f64::from((0.9..1.3).contains(&t)));
    let (json, text) = fitted(&folder("early", 0.0, early), "--triggers 200");
    let times = Plan::parse(&text).unwrap();
    // 0.08 ms of 6.08, in full light.
    let opens = number(&json, "opens_s");
    let early = times.triggers.iter().filter(|trigger| opens + trigger.time < 1.4e-3).count();
    assert!((2..=3).contains(&early), "{early}");
    // The dark is searched in twelfths, here of 0.4 ms.
    assert!((0.5e-3..=0.91e-3).contains(&opens), "{opens}");
}

#[test]
fn who_asks_for_a_model_gets_its_curve_and_is_told() {
    let folder = folder("model", 0.0, bounces);
    let (json, text) = fitted(&folder, "--model trapezoid --sync 1ms");
    assert_eq!(json["triggers_from"], "trace");
    let doubt = "as asked, though it does not explain the trace";
    assert!(text.contains(doubt) && text.contains("\nclose_end = "), "{text}");
    assert!(!text.contains("trigger_times"), "{text}");
    folder.run("plan a.toml").well();
    // It opens elsewhere than the trace does, and its delay ends there: its middle trigger comes when the fit's does.
    let plan = Plan::parse(&text).unwrap();
    let middle = number(&json["model_triggers"][8], "time_s");
    assert!((plan.sync.delay.unwrap().seconds + plan.triggers[8].time - (middle - 1e-3)).abs() < 1e-8, "{json}");
    assert!((number(&json, "delay_s") - plan.sync.delay.unwrap().seconds).abs() > 1e-5, "{json}");
}

#[test]
fn the_plan_says_that_there_is_no_curve() {
    let folder = Folder::new("times_plan");
    folder.write("a.toml", with(TIMES, "delay = 1; nominal = 2"));
    folder.refuses(&[("plan a.toml --out a.svg", "the picture: it is of a curve, and the scene has none")]);
    // A lone trigger at the opening takes no time.
    folder.write("a.toml", tables("open_start = 1\ntrigger_times = [1]\ntimer_hz = 10\nmin_gap = 0\n"));
    folder.run("plan a.toml").prints(&["    0           1000           0"]);
    // Beside a curve it is a row of a table.
    folder.write("a.toml", with(TIMES, "nominal = 2"));
    folder.write("b.toml", with(TRAPEZOID, "close_start = 4; close_end = 4.25; triggers = 4; min_gap = 0"));
    let out = folder.run("plan a.toml b.toml").well().out;
    let rows: Vec<Vec<&str>> = out.lines().map(|line| line.split_whitespace().collect()).collect();
    assert_eq!(rows[1], ["a", "2", "ms", "-", "-", "-", "-", "3", "as", "measured"]);
}
