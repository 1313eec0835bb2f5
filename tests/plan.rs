//! The main example: every scene that ships is planned, and a file that is wrong leaves nothing behind.

#[allow(dead_code)] // `main` alone
#[path = "../examples/plan/main.rs"]
mod example;

use std::ffi::OsString;
use std::fs;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/scenes");

/// How a run ended, and what it wrote.
struct Run {
    code: u8,
    out: String,
    err: String,
}

fn run<const N: usize>(args: [&Path; N]) -> Run {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let code = example::run(command_line(args), &mut out, &mut err);
    Run { code, out: String::from_utf8(out).unwrap(), err: String::from_utf8(err).unwrap() }
}

fn command_line<const N: usize>(args: [&Path; N]) -> Vec<OsString> {
    [Path::new("plan")].iter().chain(&args).map(|arg| arg.as_os_str().to_owned()).collect()
}

/// An empty directory for one test.
fn empty_dir(name: &str) -> PathBuf {
    let dir = Path::new(env!("CARGO_TARGET_TMPDIR")).join("plan").join(name);
    let _ = fs::remove_dir_all(&dir);
    fs::create_dir_all(&dir).unwrap();
    dir
}

fn names_in(dir: &Path) -> Vec<OsString> {
    let mut names: Vec<_> = fs::read_dir(dir).unwrap().map(|f| f.unwrap().file_name()).collect();
    names.sort();
    names
}

/// The table's rows, as their columns.
fn table(out: &str) -> Vec<Vec<&str>> {
    let rows = out.lines().skip_while(|line| !line.trim_start().starts_with('#')).skip(1);
    rows.map(|row| row.split_whitespace().collect()).collect()
}

#[test]
fn every_scene_that_ships_is_planned_and_drawn() {
    let dir = empty_dir("scenes");
    let scenes: Vec<_> = fs::read_dir(SCENES).unwrap().map(|f| f.unwrap().path()).collect();
    assert!(scenes.len() >= 4);
    for scene in &scenes {
        let picture = dir.join(scene.file_stem().unwrap()).with_extension("svg");
        let run = run([scene, Path::new("--out"), &picture]);
        assert_eq!((run.code, run.err.as_str()), (0, ""), "{}", scene.display());
        assert!(run.out.lines().all(|line| line.chars().count() <= 80));
        assert!(run.out.contains("exposure ") && run.out.contains("efficiency "));
        let svg = fs::read_to_string(picture).unwrap();
        assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
        assert!(svg.contains("openness") && svg.contains("fraction of the exposure"));
        assert!(svg.contains("time ("));
    }
    assert_eq!(names_in(&dir).len(), scenes.len(), "nothing but the pictures");
}

#[test]
fn the_default_is_the_soft_scene() {
    let named = run([&Path::new(SCENES).join("soft.toml")]);
    let default = run([]);
    assert_eq!(default.code, 0);
    assert_eq!(default.out, named.out);
}

#[test]
fn a_box_is_evenly_spaced() {
    let run = run([&Path::new(SCENES).join("box.toml")]);
    let rows = table(&run.out);
    assert_eq!(rows.len(), 10);
    for (i, row) in rows.iter().enumerate() {
        // 100 µs at 25 MHz: 250 ticks a share, the trigger in its middle.
        assert_eq!(row[0], i.to_string());
        assert_eq!(row[1].parse(), Ok((i as f64 * 2.0 + 1.0) / 20.0));
        assert_eq!(row[2].parse(), Ok(i as f64 * 10.0 + 5.0));
        assert_eq!(row[3], (i * 250 + 125).to_string());
        assert_eq!(row[4].parse().ok(), (i > 0).then_some(10.0));
    }
}

#[test]
fn a_long_table_is_shortened_in_the_middle() {
    let run = run([&Path::new(SCENES).join("strobe.toml")]);
    let rows = table(&run.out);
    assert_eq!(rows.len(), 25);
    assert_eq!((rows[0][0], rows[11][0], rows[13][0], rows[24][0]), ("0", "11", "88", "99"));
    assert_eq!(rows[12], ["...", "76", "more"]);
}

#[test]
fn a_share_is_shaded_for_each_trigger() {
    let picture = empty_dir("shares").join("soft.svg");
    assert_eq!(run([Path::new("--out"), &picture]).code, 0);
    let svg = fs::read_to_string(picture).unwrap();
    assert_eq!(svg.matches("<polygon").count(), 12);
    // One dot on the openness and one on the cdf.
    assert_eq!(svg.matches("<circle").count(), 24);
}

/// A scene that is right. At 3/4 s of exposure and a gap of 1/10 s, 7 triggers are sure.
const GOOD: &str = "\
# a trapezoid
open_start = 0.0
open_end = 0.25
close_start = 0.75
close_end = 1.0
triggers = 7
timer_hz = 1000
min_gap = 0.1
";

/// The line of `GOOD` that a key is on; a key that is added comes on the first line after.
const fn line(key: &str) -> Option<usize> {
    match key.as_bytes() {
        b"open_start" => Some(2),
        b"open_end" => Some(3),
        b"close_start" => Some(4),
        b"close_end" => Some(5),
        b"triggers" => Some(6),
        b"timer_hz" => Some(7),
        b"min_gap" => Some(8),
        _ => Some(9),
    }
}

/// `GOOD` with `key` set to `value`.
fn with(key: &str, value: &str) -> String {
    let text = without(key);
    let at = line(key).unwrap() - 1;
    let mut lines: Vec<_> = text.lines().map(String::from).collect();
    lines.insert(at, format!("{key} = {value}"));
    lines.join("\n") + "\n"
}

fn without(key: &str) -> String {
    let is_other = |line: &&str| line.split(' ').next() != Some(key);
    GOOD.lines().filter(is_other).map(|line| format!("{line}\n")).collect()
}

/// The error of a scene; after seeing that nothing was written, and an older picture is as it was.
fn error_of(dir: &Path, scene: &str) -> String {
    let (file, picture, older) = (dir.join("bad.toml"), dir.join("new.svg"), dir.join("older.svg"));
    fs::write(&file, scene).unwrap();
    fs::write(&older, "older").unwrap();
    let mut err = String::new();
    for picture in [&picture, &older] {
        let run = run([&file, Path::new("--out"), picture]);
        assert_eq!(run.code, 2, "{scene}\n{}", run.err);
        assert_eq!(run.out, "", "{scene}");
        err = run.err;
    }
    assert_eq!(names_in(dir), ["bad.toml", "older.svg"], "{scene}");
    assert_eq!(fs::read_to_string(&older).unwrap(), "older");
    err
}

/// Does this scene fail with this reason, on this line if one is named?
fn fails(dir: &Path, scene: &str, at: Option<usize>, reason: &str) {
    let err = error_of(dir, scene);
    let file = dir.join("bad.toml").display().to_string();
    let expected = match at {
        Some(line) => {
            let source = scene.lines().nth(line - 1).unwrap();
            format!("error: {file}:{line}: {reason}\n  {line} | {source}\n")
        }
        None => format!("error: {file}: {reason}\n"),
    };
    assert_eq!(err, expected, "{scene}");
}

#[test]
fn the_scene_that_the_bad_ones_are_made_from_is_good() {
    let file = empty_dir("good").join("good.toml");
    fs::write(&file, GOOD).unwrap();
    assert_eq!(run([&file]).err, "");
    fs::write(&file, with("shutteropening", "[0.1, 0, 0.15, 1, 0.85, 1, 0.9, 0]")).unwrap();
    assert_eq!(run([&file]).err, "");
}

#[test]
fn a_missing_key_is_named() {
    let dir = empty_dir("missing");
    for key in
        ["open_start", "open_end", "close_start", "close_end", "triggers", "timer_hz", "min_gap"]
    {
        fails(&dir, &without(key), None, &format!("missing field `{key}`"));
    }
    fails(&dir, "", None, "missing field `open_start`");
}

#[test]
fn an_unknown_key_is_named() {
    let err = error_of(&empty_dir("unknown"), &with("colour", "3"));
    assert!(err.contains("bad.toml:9: unknown field `colour`, expected one of `open_start`"));
}

#[test]
fn what_is_not_toml_is_an_error() {
    let dir = empty_dir("syntax");
    let twice = format!("{GOOD}triggers = 3\n");
    fails(&dir, &twice, Some(9), "duplicate key");
    let err = error_of(&dir, &with("triggers", "= 3"));
    assert!(err.contains("bad.toml:6: "), "{err}");
    // Nor is what is not text.
    fs::write(dir.join("bad.toml"), b"\xff").unwrap();
    let run = run([&dir.join("bad.toml")]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("valid UTF-8"), "{}", run.err);
}

#[test]
fn a_wrong_type_is_an_error() {
    let dir = empty_dir("types");
    for (key, value, reason) in [
        ("open_end", "\"soon\"", "invalid type: string \"soon\", expected f32"),
        ("close_end", "true", "invalid type: boolean `true`, expected f32"),
        ("triggers", "4.5", "invalid type: floating point `4.5`, expected u32"),
        ("triggers", "-1", "invalid value: integer `-1`, expected u32"),
        ("timer_hz", "5_000_000_000", "invalid value: integer `5000000000`, expected u32"),
        ("min_gap", "\"\"", "invalid type: string \"\", expected f64"),
        ("shutteropening", "0.5", "invalid type: floating point `0.5`, expected a sequence"),
        ("shutteropening", "[0, 1, 'x']", "invalid type: string \"x\", expected f32"),
    ] {
        fails(&dir, &with(key, value), line(key), reason);
    }
}

#[test]
fn a_number_out_of_range_is_an_error() {
    let dir = empty_dir("range");
    let (count, gap) =
        ("triggers: 1 to 10000 can be planned", "min_gap: seconds, 0 or more, are required");
    for (key, value, reason) in [
        ("triggers", "0", count),
        ("triggers", "10_001", count),
        ("min_gap", "-0.1", gap),
        ("min_gap", "inf", gap),
        ("min_gap", "nan", gap),
        (
            "shutteropening",
            "[0.1, 0.0, 0.2, 1.0, 0.8, 1.0, 0.9]",
            "shutteropening: 8 numbers are required, not 7",
        ),
        (
            "shutteropening",
            "[0.1, 0.0, 0.2, 1.0, 0.8, 1.0, 0.9, 0.0, 0.0]",
            "shutteropening: 8 numbers are required, not 9",
        ),
        ("timer_hz", "0", "the tick rate is 0"),
        (
            "timer_hz",
            "2147483649",
            "the interval is longer than 2^31 ticks; a rate of up to 2147483648 ticks in the curve's unit of time keeps to that",
        ),
    ] {
        fails(&dir, &with(key, value), line(key), reason);
    }
}

#[test]
fn a_bad_curve_is_an_error() {
    let dir = empty_dir("curve");
    let order =
        "times out of order: open_start <= open_end <= close_start <= close_end is required";
    let length = "the interval is shorter than 2^-64 (5.4e-20) or longer than 2^64 (1.8e19)";
    for (key, value, at, reason) in [
        (
            "open_start",
            "nan",
            "open_start",
            "opening ramp: a control point is NaN, infinite or beyond f32 (3.4e38)",
        ),
        (
            "close_end",
            "-inf",
            "close_end",
            "closing ramp: a control point is NaN, infinite or beyond f32 (3.4e38)",
        ),
        (
            "close_end",
            "1e39",
            "close_end",
            "closing ramp: a control point is NaN, infinite or beyond f32 (3.4e38)",
        ),
        ("open_start", "0.3", "open_end", order),
        ("open_end", "0.8", "close_start", order),
        ("close_end", "0.7", "close_end", order),
        ("close_end", "1e30", "close_end", length),
    ] {
        fails(&dir, &with(key, value), line(at), reason);
    }
    for (numbers, reason) in [
        (
            "[nan, 0, 0.15, 1, 0.85, 1, 0.9, 0]",
            "opening ramp: a control point is NaN, infinite or beyond f32 (3.4e38)",
        ),
        (
            "[0.9, 0, 0.15, 1, 0.85, 1, 0.9, 0]",
            "opening ramp: time turns back along it; t1 and t2 are fractions of the whole interval, 0 at open_start and 1 at close_end",
        ),
        (
            "[0.1, 0, 0.15, 1, 0.1, 1, 0.9, 0]",
            "closing ramp: time turns back along it; t5 and t6 are fractions of the whole interval, 0 at open_start and 1 at close_end",
        ),
        ("[0.1, -1, 0.15, 1, 0.85, 1, 0.9, 0]", "opening ramp: the openness falls below 0"),
        ("[0.1, 0, 0.15, 1, 0.85, 2, 0.9, 0]", "closing ramp: the openness rises above 1"),
    ] {
        fails(&dir, &with("shutteropening", numbers), line("shutteropening"), reason);
    }
}

#[test]
fn triggers_too_close_are_an_error_that_says_how_many_fit() {
    let dir = empty_dir("gap");
    // They come at 265.625 and 359.375 ticks.
    let reason =
        "triggers 1 and 2 come 93 ticks apart, and 100 are required; up to 7 triggers keep that";
    fails(&dir, &with("triggers", "8"), line("triggers"), reason);
    // Two on one tick, though no gap is asked for.
    let slow = with("timer_hz", "6").replace("min_gap = 0.1", "min_gap = 0");
    let reason =
        "triggers 1 and 2 come 0 ticks apart, and 1 are required; up to 4 triggers keep that";
    fails(&dir, &slow, line("triggers"), reason);
}

/// 0.1 s is 100 ticks, though no binary fraction is 0.1; and 99.9 ticks need 100, 100.1 need 101.
#[test]
fn a_gap_of_whole_ticks_is_kept_to_the_tick() {
    let file = empty_dir("whole").join("box.toml");
    let scene = |gap: &str| {
        let times = "open_start = 0\nopen_end = 0\nclose_start = 1\nclose_end = 1\n";
        format!("{times}triggers = 10\ntimer_hz = 1000\nmin_gap = {gap}\n")
    };
    for (gap, code) in [("0.1", 0), ("0.099", 0), ("0.0999", 0), ("0.1001", 2)] {
        fs::write(&file, scene(gap)).unwrap();
        assert_eq!(run([&file]).code, code, "{gap}");
    }
}

#[test]
fn a_file_that_cannot_be_read_is_an_error() {
    let dir = empty_dir("unreadable");
    for scene in [dir.join("none.toml"), dir.clone()] {
        let run = run([&scene, Path::new("--out"), &dir.join("new.svg")]);
        assert_eq!(run.code, 2);
        assert!(run.err.starts_with(&format!("error: {}: ", scene.display())));
        assert!(names_in(&dir).is_empty());
    }
}

#[test]
fn a_picture_that_cannot_be_written_is_an_error() {
    let dir = empty_dir("unwritable");
    fs::create_dir_all(dir.join("taken.svg/inside")).unwrap();
    for picture in [dir.join("none/new.svg"), dir.join("taken.svg")] {
        let run = run([Path::new("--out"), &picture]);
        assert_eq!((run.code, run.out.as_str()), (2, ""));
        assert!(run.err.starts_with(&format!("error: {}: ", picture.display())));
        assert_eq!(names_in(&dir), ["taken.svg"]);
    }
}

/// A second name of an older picture keeps showing it, since the new one is another file, whole before it
/// takes the place.
#[test]
fn a_picture_takes_its_place_as_a_whole() {
    let dir = empty_dir("replaced");
    let (picture, second) = (dir.join("a.svg"), dir.join("b.svg"));
    fs::write(&picture, "older").unwrap();
    fs::hard_link(&picture, &second).unwrap();
    assert_eq!(run([Path::new("--out"), &picture]).code, 0);
    assert!(fs::read_to_string(&picture).unwrap().starts_with("<svg "));
    assert_eq!(fs::read_to_string(&second).unwrap(), "older");
    assert_eq!(names_in(&dir), ["a.svg", "b.svg"]);
}

#[test]
fn a_picture_is_named_svg() {
    let dir = empty_dir("png");
    let run = run([Path::new("--out"), &dir.join("new.png")]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("name it FILE.svg"), "{}", run.err);
    assert!(names_in(&dir).is_empty());
}

#[test]
fn help_is_no_error() {
    let run = run([Path::new("--help")]);
    assert_eq!((run.code, run.err.as_str()), (0, ""));
    assert!(run.out.contains("Usage: plan [OPTIONS] [SCENE]"));
}

/// Takes nothing.
struct Refusing(ErrorKind);

impl Write for Refusing {
    fn write(&mut self, _: &[u8]) -> io::Result<usize> {
        Err(self.0.into())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_reader_that_leaves_is_no_error_and_a_full_disk_is() {
    for (refusal, code) in [(ErrorKind::BrokenPipe, 0), (ErrorKind::StorageFull, 2)] {
        let mut err = Vec::new();
        assert_eq!(example::run(command_line([]), &mut Refusing(refusal), &mut err), code);
        assert_eq!(err.is_empty(), code == 0);
    }
}
