//! What the program says, as someone meets it who works with it: a session of a shell, whose lines are run anew, and
//! whose answers stand in `session.txt`. `SNAPSHOTS=overwrite` writes what is said now.

use std::fs;

use crate::scenes::{BOX, MEASURED, TIMES, TRAPEZOID, with};
use crate::support::{Folder, SCENES, leaf, rows, sampled, trapezoid};
use crate::sync;

#[test]
fn the_session_is_as_it_was() {
    let folder = Folder::new("session");
    let text = leaf(1.0);
    folder.write("leaf.csv", fs::read(format!("{SCENES}/../traces/leaf.csv")).unwrap());
    folder.write("trace.csv", &text);
    folder.write("slow.csv", leaf(2.0));
    folder.write("cut.csv", &text[..text.len() / 2]);
    let trace = sampled(trapezoid, 1200, 0.005);
    folder.write("values.csv", rows(&trace, |_, v| format!("{v}")));
    // The second one opens 1 ms later, and closes 1.5 ms later.
    let second = |t: f64| 0.1 + (t - 0.003).min(0.0105 - t).clamp(0.0, 0.002) / 0.001;
    let sensors = rows(&trace, |t, v| format!("{t:.6},{v:.5},{:.5}", second(t)));
    folder.write("sensors.csv", format!("time_s,A,B\n{sensors}"));
    // Rows that are counted, and those whose first one is told to be at -1.5 ms.
    folder.write("rated.csv", format!("Sample rate: 100 kHz\nA\n{}", rows(&trace, |_, v| format!("{v}"))));
    let counted = rows(&trace, |t, v| format!("{:.0},{v}", 1e5 * t));
    folder.write("counted.csv", format!("Sample rate: 100 kHz\nn,v\n{counted}"));
    folder.write("zero.csv", folder.text("rated.csv").replace("A\n", "HOffset,-1.5e-3\nA\n"));
    folder.write("measured.toml", MEASURED);
    folder.write("bare.toml", with(TRAPEZOID, ""));
    folder.write("box.toml", with(BOX, "pulse = 0.1"));
    folder.write("times.toml", with(TIMES, "delay = 1; nominal = 2"));
    ["five.csv", "one.csv"].iter().zip(sync::shots()).for_each(|(name, text)| folder.write(name, text));
    folder.write("trace.json", r#"{"t": [0, 1, 2], "v": [0, 1, 0]}"#);
    fs::create_dir(folder.path("folder.csv")).unwrap();
    let said = |line: &str| {
        let Some(command) = line.strip_prefix("$ ") else { return format!("{line}\n") };
        let before = folder.all();
        let run = folder.shell(&command.replace("shutter ", "\"$shutter\" "));
        if run.code == Some(2) {
            assert!(folder.all() == before, "{line}: a refused run leaves all as it was");
        }
        let code = if run.code == Some(0) { String::new() } else { format!("? {}\n", run.code.unwrap_or(-1)) };
        let err = run.err.replace("\n\nFor more information, try '--help'.", "");
        format!("{line}\n{code}{}{}", wrapped(&run.out), wrapped(&err))
    };
    let lines = include_str!("session.txt").lines();
    let now: String = lines.filter(|line| line.starts_with("$ ") || line.starts_with('#')).map(said).collect();
    snapbox::assert_data_eq!(now, snapbox::file!["session.txt"].raw());
}

/// In lines of at most 120 columns.
pub fn wrapped(text: &str) -> String {
    let mut all = String::new();
    for line in text.lines() {
        let mut width = 0;
        for word in line.split_inclusive(' ') {
            if width + word.chars().count() > 118 && width > 0 {
                all = all.trim_end().to_string() + "\n  ";
                width = 2;
            }
            all += word;
            width += word.chars().count();
        }
        all = all.trim_end_matches(' ').to_string() + "\n";
    }
    all
}
