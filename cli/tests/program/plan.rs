//! `shutter plan`: every scene that ships is planned, and a file that is wrong leaves nothing behind.

use std::fs;
use std::io::{self, ErrorKind, Write};

use serde_json::Value;
use shutter_plan::emit::{Form, emit};
use shutter_plan::plan::Plan;
use shutter_plan::scene::Scene;

use crate::refusals::{BOX, MEASURED, TRAPEZOID, tables, with};
use crate::support::{Folder, SCENES, planned, report, scene, scenes, table};

fn path(scene: &str) -> String {
    format!("{SCENES}/{scene}.toml")
}

#[test]
fn every_scene_that_ships_is_planned_and_drawn() {
    for (name, _) in scenes() {
        let folder = Folder::new("scenes");
        fs::copy(path(&name), folder.path("a.toml")).unwrap();
        let run = folder.run("plan a.toml --out a.svg --set-ups both.svg");
        assert_eq!(run.err, "wrote a.svg\nwrote both.svg\n", "{name}");
        assert!(run.out.lines().all(|line| line.chars().count() <= 80));
        let run = run.prints(&["exposure ", "efficiency "]);
        let [picture, set_ups] = ["a.svg", "both.svg"].map(|file| folder.text(file));
        for svg in [&picture, &set_ups] {
            assert!(svg.contains("\n<svg ") && svg.ends_with("</svg>\n"));
        }
        for words in ["openness", "fraction of the exposure", "time"] {
            assert!(picture.contains(words), "{words}");
        }
        assert_eq!(folder.names(), ["a.svg", "a.toml", "both.svg"], "nothing but the pictures");
        // A gap is the difference of the times that are printed.
        for pair in table(&run.out).windows(2).filter(|pair| pair.iter().all(|row| row[0] != "...")) {
            let number = |text: &str| text.parse::<f64>().unwrap();
            let (apart, gap) = (number(pair[1][2]) - number(pair[0][2]), pair[1].last().unwrap());
            let places = gap.split_once('.').map_or(0, |(_, places)| places.len());
            assert_eq!(*gap, format!("{apart:.places$}"), "{name}: {pair:?}");
        }
    }
}

/// And so they show the crate as it is. They are drawn by
/// `shutter plan --force --out docs/curve.svg --set-ups docs/set-ups.svg`.
#[test]
fn the_pictures_of_the_docs_are_as_they_are_drawn() {
    let folder = Folder::new("docs");
    folder.run("plan --out curve.svg --set-ups set-ups.svg").well();
    for picture in ["curve.svg", "set-ups.svg"] {
        let kept = fs::read_to_string(format!("{SCENES}/../../docs/{picture}")).unwrap();
        assert!(folder.text(picture) == kept, "docs/{picture} is old");
    }
    let svg = folder.text("curve.svg");
    // A share is shaded for each trigger. One dot on the openness, one on the cdf, one in the legend; eight control
    // points and one in the legend, four handles and one.
    for (mark, count) in [
        ("<polygon", 12),
        (r##"r="32" opacity="1" fill="#D55E00""##, 12 + 12 + 1),
        (r##"r="40" opacity="1" fill="none""##, 8 + 1),
        (r##"stroke="#78818B" stroke-width="16""##, 4 + 1),
    ] {
        assert_eq!(svg.matches(mark).count(), count, "{mark}");
    }
}

#[test]
fn both_set_ups_are_drawn_with_their_doses() {
    for scene in ["soft", "led", "projector", "box", "strobe"] {
        let svg = shutter::picture::set_ups(scene, &self::scene(scene)).unwrap();
        assert!(svg.contains("prefers-color-scheme: dark"));
        let doses = |percent: &str| svg.matches(&format!("\n{percent}\n</text>")).count();
        // What a flash has lost that comes where soft is open to 0.611.
        match scene {
            "soft" | "led" => {
                assert_eq!((doses("100"), doses("61"), doses("96")), (12 + 8 + 12, 2, 2))
            }
            // And the axes of time end at 100 µs.
            "box" => assert_eq!(doses("100"), 30 + 3),
            _ => (),
        }
    }
}

#[test]
fn a_picture_has_a_title_and_colours_for_the_dark() {
    let svg = shutter::picture::svg("a & b <c>", &planned(TRAPEZOID, "triggers = 1")).unwrap();
    let title = "<title>Openness and exposure of the shutter a &amp; b &lt;c> over time, with its triggers</title>";
    assert_eq!(svg.lines().nth(1), Some(title));
    assert!(svg.contains("1 trigger in the middle of the exposure"));
    let (head, drawn) = svg.split_once("</style>").unwrap();
    assert!(head.contains("@media (prefers-color-scheme: dark)"));
    // Each colour that is drawn has another for the dark.
    for color in drawn
        .split([' ', '>'])
        .filter_map(|word| word.strip_prefix("fill=").or(word.strip_prefix("stroke=")).filter(|c| c.starts_with("\"#")))
    {
        assert!(head.contains(&format!("[fill={color}]")), "{color}");
    }
}

#[test]
fn a_long_table_is_shortened_in_the_middle() {
    let out = report(&scene("strobe"));
    let rows = table(&out);
    assert_eq!(rows.len(), 25);
    assert_eq!((rows[0][0], rows[11][0], rows[13][0], rows[24][0]), ("0", "11", "88", "99"));
    assert_eq!(rows[12], ["...", "76", "more"]);
}

/// Ticks of a rate that is rounded, and of times that `f32` moves, are doubted in every form that has room for it.
#[test]
fn ticks_that_may_be_others_are_doubted() {
    let json = |plan: &Plan| emit(Form::Json, "scene", plan, false).unwrap();
    let moved = "f32 moves the curve's times by up to 58 ticks; they are nearest where open_start is 0";
    for (start, hz, doubts) in [
        (0.0003, "100_000_000", vec![]),
        (10.0003, "100_000", vec![]),
        (10.0003, "100_000_000", vec![moved]),
        (0.0, "100_000.4", vec![]),
    ] {
        let [a, b, c, d] = [0.0, 0.002, 0.006, 0.008].map(|t| start + t);
        let curve = format!("open_start = {a}; open_end = {b}; close_start = {c}; close_end = {d}");
        let frame = format!("triggers = 4; min_gap = 0; set_up = 'emulated'; timer_hz = {hz}");
        let plan = planned(TRAPEZOID, &format!("{curve}; {frame}"));
        assert_eq!(
            serde_json::from_str::<Value>(&json(&plan)).unwrap()["doubts"]
                .as_array()
                .unwrap()
                .iter()
                .map(|it| &it["text"])
                .collect::<Vec<_>>(),
            doubts
        );
        let module = emit(Form::Rust, "scene", &plan, false).unwrap();
        assert_eq!(module.matches("\n// doubt ").count(), doubts.len(), "{module}");
    }
    let slow = "open_start = 0\ntrigger_times = [20, 40]\nmin_gap = 0\nset_up = 'emulated'\n";
    let told = json(&planned(slow, "timer_hz = 1.5"));
    assert!(told.contains("\"the timer has 1.5 Hz, planned as 2: 20 ticks off at the end\""), "{told}");
}

/// As docs/firmware.md says: a share of 6.2541 ms / 16 is 9772 ticks; a frame takes 12.958 ms.
#[test]
fn the_report_tells_when_a_drift_matters() {
    for (hz, frames) in [("25000000", 7542), ("1000000", 302)] {
        let told = report(&planned(MEASURED, &format!("timer_hz = {hz}")));
        let line = "\ndrift        a tick a second moves the delay by 1 % of a share in ";
        assert!(told.contains(&format!("{line}{frames} frames\n")), "{told}");
    }
    assert!(!report(&scene("soft")).contains("\ndrift"));
}

#[test]
fn a_unit_scales_all_times() {
    let curve = "duty = 0.5; set_up = 'in_path'; triggers = 7; timer_hz = 1000";
    let csv = |plan: &Plan| emit(Form::Csv, "x", plan, false).unwrap();
    let plain = planned(TRAPEZOID, &format!("min_gap = 0.05; nominal = 0.5; min_pulse = 0.01; {curve}"));
    for (unit, factor) in [("ms", 1e3), ("µs", 1e6), ("μs", 1e6), ("us", 1e6), ("ns", 1e9), ("s", 1.0)] {
        let times = [
            ("open_end", 0.25),
            ("close_start", 0.75),
            ("close_end", 1.0),
            ("min_gap", 0.05),
            ("nominal", 0.5),
            ("min_pulse", 0.01),
        ];
        let times = times.map(|(key, time)| format!("{key} = {}; ", time * factor)).concat();
        let scaled = planned(TRAPEZOID, &format!("unit = \"{unit}\"; {times}{curve}"));
        assert_eq!(csv(&scaled), csv(&plain), "{unit}");
        assert!(report(&scaled).contains("ΔEV +0.58"), "{}", report(&scaled));
    }
}
/// Decimals in or at the end of the box, some of them rounded to seven digits, on any scale and up to a hundred
/// intervals from time 0: neither the unit's conversion nor `f32` carries one out of it.
#[test]
fn what_lies_in_the_box_lies_in_it_in_every_unit() {
    let mut state = 1u64;
    let mut below = |n: i64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 33) as i64 % n
    };
    for _ in 0..500 {
        let n = [8, 10, 12, 25, 49, 64, 80, 125, 300][below(9) as usize];
        let mut times = [0, below(n + 1), below(n + 1), n];
        times.sort_unstable();
        // Of each inner time an end of its ramp, or any place on it.
        let ramps = [[times[0], times[1]], [times[2], times[3]]];
        let inner = ramps.map(|[from, to]| {
            let mut inner = [0, 1].map(|_| match below(4) {
                0 => from,
                1 => to,
                _ => from + below(to - from + 1),
            });
            inner.sort_unstable();
            inner.map(|at| {
                let fraction = (1e7 * at as f64 / n as f64).round() / 1e7;
                format!("{fraction}, {}", below(11) as f64 / 10.0)
            })
        });
        let (offset, power) = (below(201 * n) - 100 * n, below(7) - 3);
        for (unit, more) in [("s", -3), ("ms", 0), ("us", 3), ("ns", 6)] {
            let keys = ["open_start", "open_end", "close_start", "close_end"].iter().zip(times);
            let times =
                keys.map(|(key, time)| format!("{key} = {}e{}\n", offset + time, power + more)).collect::<String>();
            let text = format!(
                "unit = \"{unit}\"\n{times}shutteropening = [{}]\ntriggers = 1\ntimer_hz = 1\nmin_gap = 0\n",
                inner.as_flattened().join(", ")
            );
            let curve = Scene::parse(&tables(&text)).and_then(|scene| shutter_plan::shape::curve(&scene.shutter));
            assert!(curve.is_ok(), "{}", curve.unwrap_err().locate("scene", &text));
        }
    }
}

/// Everything that is asked of a delay: it is printed, counted from, drawn, and checked.
#[test]
fn a_delay_is_counted_from_the_edge_of_the_sync() {
    for (unit, factor) in [("s", 1.0), ("ms", 1e3)] {
        let [open, close, end, delay] = [0.25, 0.75, 1.0, 0.125].map(|time| time * factor);
        let times = format!("open_end = {open}; close_start = {close}; close_end = {end}; delay = {delay}");
        let changes = format!("unit = \"{unit}\"; {times}; triggers = 3; min_gap = 0; sync_falls = true");
        let plan = planned(TRAPEZOID, &changes);
        let out = report(&plan);
        let fact = format!("delay        {delay} {unit} from the sync's falling edge to the start of opening\n");
        assert!(out.contains(&fact) && out.lines().all(|line| line.chars().count() <= 80), "{out}");
        // The third column counts from the opening, the fourth from the edge.
        let rows = table(&out);
        let columns = |i: usize| rows.iter().map(move |row| row[i].parse::<u32>().unwrap());
        assert!(columns(3).eq([250, 500, 750]) && columns(4).eq([375, 625, 875]), "{out}");
        let svg = shutter::picture::svg("late", &plan).unwrap();
        assert!(svg.contains("\nsync\n") || svg.contains(">sync<"), "the edge is drawn");
        assert!(svg.contains(&format!("delay {delay} {unit}")), "and the delay");
    }
    // An edge far before the curve would squeeze it: it is told, not drawn to scale.
    let svg = shutter::picture::svg("late", &planned(TRAPEZOID, "min_gap = 0; delay = 100")).unwrap();
    assert!(svg.contains("sync 100 s before"));
    let out = report(&planned(TRAPEZOID, ""));
    let none = "delay        none known: ticks count from the start of opening";
    assert!(out.contains(none) && !out.contains("from edge"), "{out}");
    // The trace's edge is not that of another delay.
    let own = "delay = 1; sync_falls = true; [flashes] -> [flashes]\ndelay = 2";
    assert!(report(&planned(TRAPEZOID, own)).contains("2 s from the sync's edge (sync_falls: which?) to"));
    // The longest that fits, and one as good as none, of whose zero no sign is kept.
    let delay = |delay| Plan::parse(&with(TRAPEZOID, delay)).unwrap().sync;
    assert_eq!(delay("delay = 2147482.648").ticks + 1000, 1 << 31);
    let none = delay("delay = -0.0");
    assert!(none.ticks == 0 && none.delay.unwrap().seconds.is_sign_positive());
}

#[test]
fn pulses_come_around_the_triggers_or_take_equal_shares() {
    for (lamp, pulses) in [
        ("min_gap = 0.15; pulse = 0.1", &[[75, 175], [325, 425], [575, 675], [825, 925]][..]),
        ("min_gap = 0.15; duty = 0.4", &[[75, 175], [325, 425], [575, 675], [825, 925]]),
        // They touch where the lamp is always on, and a pulse of a whole share fits as well.
        ("min_gap = 0; pulse = 0.25", &[[0, 250], [250, 500], [500, 750], [750, 1000]]),
        ("min_gap = 0; duty = 1", &[[0, 250], [250, 500], [500, 750], [750, 1000]]),
        // Half a tick of an odd length comes after the trigger.
        ("triggers = 1; pulse = 0.003", &[[499, 502]]),
    ] {
        let out = report(&planned(BOX, lamp));
        let edges = |row: Vec<&str>| [4, 5].map(|i| row[i].parse::<u32>().unwrap());
        assert_eq!(table(&out).into_iter().map(edges).collect::<Vec<_>>(), pulses, "{lamp}");
    }
}

/// The drawings take the width that there is; 40 columns suffice.
#[test]
fn drawings_fit_the_terminal() {
    for (name, plan) in scenes() {
        for columns in [32, 40, 60, 80] {
            let text = shutter::report::text(&name, &plan, columns);
            let is_drawn = |line: &&str| line.contains(['─', '│', '⣀', '⡇', '⠁', '⢸', '┼']);
            let widest = text.lines().filter(is_drawn).map(|line| line.chars().count()).max();
            let fits = (columns - 12..=columns).contains(&(widest.unwrap() as u16));
            assert!(fits, "{columns}: {widest:?}\n{text}");
        }
    }
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
        let (line, mut err) = (["shutter".into(), "plan".into()], Vec::new());
        assert_eq!(shutter::command::run(line, &mut Refusing(refusal), &mut err), code);
        assert_eq!(err.is_empty(), code == 0);
    }
}
