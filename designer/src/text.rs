//! A scene as the text that the program reads, and as it writes it.

use std::fmt::Write;

use shutter_plan::fitted;
use shutter_plan::scene::Scene;
use toml::Table;

/// The shutter, with its checksum where it was measured, and the flashes; below what was measured, what its user has
/// still to tell is told in comments, as a fit does it.
pub fn text(scene: &Scene) -> String {
    let (shutter, flashes) = (&scene.shutter, &scene.flashes);
    let given = Table::try_from(flashes).unwrap_or_default();
    let asked = match shutter.measured {
        Some(_) => fitted::flashes(shutter, flashes.triggers.unwrap_or_default() as usize),
        None => "\n[flashes]\n".into(),
    };
    let key = |line: &str| line.trim_start_matches("# ").split(" = ").next().map(String::from).unwrap_or_default();
    let mut rest = given.clone();
    let mut text = shutter.text();
    let of = |key: &str| match given[key].as_float().filter(|x| x.fract() == 0.0 && x.abs() < 1e15) {
        Some(whole) => format!("{key} = {whole}\n"),
        None => format!("{key} = {}\n", given[key]),
    };
    for line in asked.lines() {
        let key = key(line);
        match (given.contains_key(&key), rest.remove(&key)) {
            (true, Some(_)) => text += &of(&key),
            (true, None) => {}
            (false, _) => _ = writeln!(text, "{line}"),
        }
    }
    rest.keys().fold(text, |text, key| text + &of(key))
}
