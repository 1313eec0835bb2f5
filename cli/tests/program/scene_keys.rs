//! docs/scene.md has each key that the program knows, and no other, and says which are required.

use shutter_plan::plan::Plan;
use shutter_plan::scene::{Flashes, Scene, Shutter};

/// The keys of a table of the page, and what holds without each.
fn rows(table: &str) -> Vec<(&'static str, &'static str)> {
    let page = include_str!("../../../docs/scene.md");
    let (_, below) = page.split_once(&format!("\n## `[{table}]`")).expect("its heading");
    let rows = below.lines().take_while(|line| !line.starts_with("## ")).filter(|line| line.starts_with("| `"));
    let cells = rows.map(|row| row.split(" | ").collect::<Vec<_>>());
    cells.map(|cells| (cells[0].trim_start_matches("| ").trim_matches('`'), cells[2])).collect()
}

#[test]
fn the_page_has_every_key() {
    let keys = |table: serde_json::Value| table.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    let [shutter, flashes] = [
        keys(serde_json::to_value(Shutter::default()).unwrap()),
        keys(serde_json::to_value(Flashes::default()).unwrap()),
    ];
    for (table, mut known) in [("shutter", shutter), ("flashes", flashes)] {
        let mut told: Vec<&str> = rows(table).iter().map(|row| row.0).collect();
        known.retain(|key| key != "measured");
        told.sort();
        known.sort();
        assert_eq!(told, known);
        let fault = Scene::parse(&format!("[shutter]\n[flashes]\n[{table}.none]\n")).unwrap_err().reason();
        assert!(known.iter().all(|key| fault.contains(&format!("`{key}`"))), "{fault}");
    }
}

#[test]
fn the_page_says_what_is_required() {
    let required = |table| rows(table).into_iter().filter(|row| row.1.starts_with("required")).map(|row| row.0);
    let scene = |without: &str| {
        let lines = |keys: Vec<&str>| -> String {
            let keys = keys.iter().zip(1..).filter(|(key, _)| **key != without);
            keys.map(|(key, place)| format!("{key} = {place}\n")).collect()
        };
        let [shutter, flashes] = ["shutter", "flashes"].map(|table| lines(required(table).collect()));
        format!("[shutter]\n{shutter}[flashes]\n{flashes}")
    };
    let reason = |without: &str| Plan::parse(&scene(without)).err().map(|fault| fault.reason());
    assert_eq!(reason(""), None);
    for key in required("shutter").chain(required("flashes")) {
        assert_eq!(reason(key), Some(format!("{key}: it is required")));
    }
}

/// And in no other, for each key that is a time.
#[test]
fn a_time_is_in_the_unit_of_its_table() {
    let shutter = "open_start = 1@\nopen_end = 2@\nclose_start = 6@\nclose_end = 8@\ndelay = 4@\ndelay_spread = 0.1@\n\
                   sync_falls = true\nsync_settles = 50@\nnominal = 5@\n";
    let flashes =
        ["lamp_lag = 0.2%\nduty = 0.5\nmin_pulse = 0.01%\n", "pulse = 0.3%\ndelay = 3%\ndelay_spread = 0.2%\n"];
    let common = "triggers = 4\ntimer_hz = 1e6\nmin_gap = 0.1%\n";
    let others = "unit shutteropening trigger_times measured timer_bits set_up fully_open";
    let known = format!("{shutter}{}{common}{others}", flashes.concat());
    for table in [serde_json::to_value(Shutter::default()), serde_json::to_value(Flashes::default())] {
        for key in table.unwrap().as_object().unwrap().keys() {
            assert!(known.split_whitespace().any(|word| word == key), "{key}");
        }
    }
    for flashes in flashes {
        let played = |[ours, theirs]: [(&str, &str); 2]| {
            let [own, other] = [("shutter", ours, shutter), ("flashes", theirs, flashes)]
                .map(|(table, (unit, _), keys)| format!("[{table}]\nunit = '{unit}'\n{keys}"));
            let plan =
                Plan::parse(&format!("{own}{other}{common}").replace('@', ours.1).replace('%', theirs.1)).unwrap();
            (serde_json::to_string(&plan.rows()).unwrap(), plan.scene)
        };
        let all = [("ms", ""), ("µs", "e3"), ("μs", "e3"), ("us", "e3"), ("ns", "e6"), ("s", "e-3")];
        for [ours, theirs] in all.iter().flat_map(|ours| all.map(|theirs| [*ours, theirs])) {
            assert_eq!(played([ours, theirs]), played([all[0]; 2]), "{ours:?} {theirs:?}");
        }
    }
}
