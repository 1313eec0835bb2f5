//! What is wrong with a scene is refused at its line, in words that say what would be right; what is just right is not,
//! and has the ticks, doses and facts that are worked out by hand.

use shutter_fit::unit::short;
use shutter_plan::facts::Facts;
use shutter_plan::plan::Plan;

use crate::session::wrapped;
use crate::support::report;

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

/// The keys of a shutter; all others are of the flashes.
const SHUTTER: [&str; 11] = [
    "sync_settles",
    "unit",
    "open_",
    "close_",
    "shutteropening",
    "trigger_times",
    "delay",
    "delay_spread",
    "sync_falls",
    "nominal",
    "measured",
];

fn is_of_shutter(key: &str) -> bool {
    SHUTTER.iter().any(|of| if of.ends_with('_') { key.starts_with(of) } else { key == *of })
}

/// Lines of keys as the two tables of a scene.
pub fn tables(lines: &str) -> String {
    if lines.contains("[shutter]") {
        return lines.into();
    }
    let (mut tables, mut of) = ([String::from("[shutter]\n"), String::from("[flashes]\n")], 0);
    for line in lines.lines() {
        if let Some((key, _)) = line.split_once(" = ") {
            of = usize::from(!is_of_shutter(key));
        }
        tables[of] += &format!("{line}\n");
    }
    tables.concat()
}

/// A scene with changes, parted by `; `: `KEY = VALUE` in place of the key's line or below all of its table, `KEY`
/// without it, `A -> B`.
pub fn with(scene: &str, changes: &str) -> String {
    let mut text = tables(scene);
    for change in changes.split("; ").filter(|change| !change.is_empty()) {
        if let Some((from, to)) = change.split_once(" ->") {
            assert!(text.contains(from), "{from}\n{text}");
            text = text.replace(from, to.trim_start());
            continue;
        }
        let (key, value) = change.split_once(" = ").unwrap_or((change, ""));
        let line = if value.is_empty() { String::new() } else { format!("{change}\n") };
        match text.lines().find(|line| line.split(" = ").next() == Some(key)) {
            Some(old) => text = text.replace(&format!("{old}\n"), &line),
            None if is_of_shutter(key) => text = text.replace("[flashes]\n", &format!("{line}[flashes]\n")),
            None => text += &line,
        }
    }
    text
}

/// What a plan has: a number of each trigger, its table, or a fact by its key or by how its line begins.
fn has(plan: &Plan, what: &str) -> String {
    let (rows, report) = (serde_json::to_value(plan.rows()).unwrap(), report(plan));
    let (facts, below) = report.split_once("\n\n").unwrap();
    let shown = |x: f64| format!(" {}", short(x, 5));
    let numbers: String = match rows[0].get(what) {
        Some(_) => rows.as_array().unwrap().iter().filter_map(|row| row[what].as_f64()).map(shown).collect(),
        None => Facts::new(plan).number(what).map_or(String::new(), shown),
    };
    let is_asked = |line: &&str| line.starts_with(what);
    let lines: Vec<&str> = match what {
        "table" => below.lines().skip_while(|line| !line.trim_start().starts_with('#')).collect(),
        _ => facts.lines().filter(is_asked).collect(),
    };
    let lines: String = lines.iter().map(|line| wrapped(&format!("  {line}"))).collect();
    match (numbers.as_str(), lines.as_str()) {
        ("", "") => format!("  no {what}\n"),
        ("", lines) => lines.into(),
        (numbers, _) => wrapped(&format!("  {what}{numbers}")),
    }
}

/// Every case is a scene and its changes, and behind `?` what is asked of its plan; below it, and those before it of
/// which the same is told, stands that. `SNAPSHOTS=overwrite` writes what is told now.
#[test]
fn a_scene_is_refused_at_its_line_or_planned() {
    let cases = include_str!("scenes.txt").lines().filter(|line| !line.starts_with("  "));
    let told = |case: &str| -> String {
        let (case, asked) = case.split_once(" ? ").unwrap_or((case, ""));
        let Some((name, changes)) = case.split_once(':') else { return String::new() };
        let scene = match name {
            "TRAPEZOID" => TRAPEZOID,
            "BOX" => BOX,
            "LEAF" => LEAF,
            "IN_PATH" => &with(LEAF, "timer_hz = 1_000_000; set_up = 'in_path'"),
            "MEASURED" => MEASURED,
            "TIMES" => TIMES,
            "FLAT" | "NOTHING" => "",
            "NO_SHUTTER" => "[flashes]\ntriggers = 1\n",
            _ => return String::new(),
        };
        let flat = (name == "FLAT").then(|| LEAF.to_string());
        let text = flat.unwrap_or_else(|| match scene {
            "[flashes]\ntriggers = 1\n" => scene.into(),
            _ => with(scene, &changes.trim().replace("\\n", "\n")),
        });
        let fault = match Plan::parse(&text) {
            Ok(_) if asked.is_empty() => return "  planned\n".into(),
            Ok(plan) => return asked.split(' ').map(|what| has(&plan, what)).collect(),
            Err(fault) => fault,
        };
        let located = fault.locate("a", &text);
        let mut lines = located.lines();
        let (_, reason) = lines.next().unwrap().split_once(' ').unwrap();
        let (mut at, mut notes) = ("", lines.peekable());
        // It points to the line of its key, or of its table's value.
        if let Some((_, source)) = notes.next_if(|line| line.contains(" | ")).and_then(|it| it.split_once(" | ")) {
            assert!(source.contains(fault.name()), "{case}\n{located}");
            at = "at its line, ";
        }
        let lines = [format!("  {at}{reason}")].into_iter().chain(notes.map(|note| format!("  {note}")));
        lines.map(|line| wrapped(&line)).collect()
    };
    let (mut now, mut last) = (String::new(), String::new());
    for case in cases {
        let told = told(case);
        if told != last {
            now += &last;
        }
        now += &format!("{case}\n");
        last = told;
    }
    now += &last;
    snapbox::assert_data_eq!(now, snapbox::file!["scenes.txt"].raw());
}

/// And 10 000 triggers are the most.
#[test]
fn many_times_are_planned() {
    for (n, is_planned) in [(10_000, true), (10_001, false)] {
        let times: Vec<String> = (5..5 + n).map(|time| time.to_string()).collect();
        let text = tables(&format!("open_start = 0\ntrigger_times = [{}]\nmin_gap = 0\n", times.join(",")));
        assert_eq!(Plan::parse(&text).is_ok(), is_planned, "{n}");
    }
}
