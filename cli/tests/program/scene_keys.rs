//! docs/scene.md has each key that the program knows, and no other, and says which are required.

use shutter::planned::Planned;

/// The cells of each row: the key, and what holds without it.
fn rows() -> Vec<(&'static str, &'static str)> {
    let rows = include_str!("../../../docs/scene.md").lines().filter(|line| line.starts_with("| `"));
    rows.map(|row| {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        (cells[1].trim_matches('`'), cells[3])
    })
    .collect()
}

/// What the program expects where it finds another key.
fn known(scene: &str) -> Vec<String> {
    let fault = Planned::parse(&format!("other = 0\n{scene}")).err().expect("no such key");
    let reason = fault.reason();
    let (_, expected) = reason.split_once("expected one of ").expect("a list of keys");
    expected.split('`').skip(1).step_by(2).map(String::from).collect()
}

#[test]
fn the_page_has_every_key() {
    let mut told: Vec<&str> = rows().iter().map(|row| row.0).collect();
    let mut keys = known("");
    keys.sort();
    told.sort();
    assert_eq!(told, keys);
    let of_times = known("trigger_times = [1]");
    assert!(of_times.iter().all(|key| told.contains(&key.as_str())), "{of_times:?}");
}

#[test]
fn the_page_says_what_is_required() {
    let required = rows().into_iter().filter(|row| row.1 == "required").map(|row| row.0);
    let required: Vec<&str> = required.collect();
    let scene = |without: &str| -> String {
        let lines = required.iter().zip(1..).filter(|(key, _)| **key != without);
        let value = |key: &str, place| if key == "min_gap" { 0 } else { place };
        lines.map(|(key, place)| format!("{key} = {}\n", value(key, place))).collect()
    };
    let reason = |without| Planned::parse(&scene(without)).err().map(|fault| fault.reason());
    assert_eq!(reason(""), None);
    for key in &required {
        assert_eq!(reason(key), Some(format!("missing field `{key}`")));
    }
}
