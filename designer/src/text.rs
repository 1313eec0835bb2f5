//! A scene as the text that the program reads, and as it writes it.

use shutter_plan::fitted;
use shutter_plan::scene::Scene;

/// The shutter, with its checksum where it was measured, and the flashes; below what was measured, what its user has
/// still to tell is told in comments, as a fit does it.
pub fn text(scene: &Scene) -> String {
    let (shutter, flashes) = (&scene.shutter, &scene.flashes);
    let asked = match shutter.measured {
        Some(_) => fitted::flashes(shutter, flashes.triggers.unwrap_or_default() as usize),
        None => "\n[flashes]\n".into(),
    };
    let written = toml::to_string(flashes).unwrap_or_default();
    // Whole numbers without a point, as far as TOML has such.
    let whole = |line: &&str| line.len() < 30;
    let given = written.lines().map(|line| line.strip_suffix(".0").filter(whole).unwrap_or(line));
    let key = |line: &str| line.trim_start_matches("# ").split(" = ").next().map(String::from);
    let mut lines: Vec<_> = asked.lines().collect();
    for line in given {
        // What is given goes in the place of what is asked for.
        let at = lines.iter().position(|it| key(it) == key(line)).unwrap_or(lines.len());
        lines.retain(|it| key(it) != key(line));
        lines.insert(at, line);
    }
    shutter.text() + &lines.join("\n") + "\n"
}
