//! `shutter plan`: every scene that ships is planned, and a file that is wrong leaves nothing behind.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, ErrorKind, Write};

use shutter_plan::scene::Scene;

use crate::scenes::{TRAPEZOID, tables};
use crate::support::{Folder, SCENES, has, planned, report, scenes, table};

fn path(scene: &str) -> String {
    format!("{SCENES}/{scene}.toml")
}

#[test]
fn every_scene_that_ships_is_planned_and_drawn() {
    for (name, _) in scenes() {
        let folder = Folder::new("scenes");
        fs::copy(path(&name), folder.path("a.toml")).unwrap();
        let run = folder.run("plan a.toml --out a.svg");
        assert_eq!(run.err, "wrote a.svg\n", "{name}");
        assert!(run.out.lines().all(|line| line.chars().count() <= 80));
        let run = run.prints(&["exposure ", "efficiency "]);
        let picture = folder.text("a.svg");
        assert!(picture.contains("\n<svg ") && picture.ends_with("</svg>\n"));
        for words in ["openness", "fraction of the exposure", "time"] {
            assert!(picture.contains(words), "{words}");
        }
        assert_eq!(folder.names(), ["a.svg", "a.toml"], "nothing but the picture");
        // A gap is the difference of the times that are printed.
        for pair in table(&run.out).windows(2).filter(|pair| pair.iter().all(|row| row[0] != "...")) {
            let number = |text: &str| text.parse::<f64>().unwrap();
            let (apart, gap) = (number(pair[1][2]) - number(pair[0][2]), pair[1].last().unwrap());
            let places = gap.split_once('.').map_or(0, |(_, places)| places.len());
            assert_eq!(*gap, format!("{apart:.places$}"), "{name}: {pair:?}");
        }
    }
}

/// And so it shows the crate as it is. It is drawn by `shutter plan --force --out docs/curve.svg`.
#[test]
fn the_picture_of_the_docs_is_as_it_is_drawn() {
    let folder = Folder::new("docs");
    folder.run("plan --out curve.svg").well();
    let svg = folder.text("curve.svg");
    assert!(svg == fs::read_to_string(format!("{SCENES}/../../docs/curve.svg")).unwrap(), "docs/curve.svg is old");
    // A share is shaded for each trigger, with a dot on the openness and one on the cdf; eight control points have four
    // handles.
    for (mark, count) in [
        ("<polygon", 12),
        (r##"r="32" opacity="1" fill="#D55E00""##, 12 + 12),
        (r##"r="40" opacity="1" fill="none""##, 8),
        (r##"stroke="#78818B" stroke-width="16""##, 4),
    ] {
        assert_eq!(svg.matches(mark).count(), count, "{mark}");
    }
}

#[test]
fn a_picture_has_a_title_and_colours_for_the_dark() {
    let svg = shutter::picture::svg("a & b <c>", &planned(TRAPEZOID, "triggers = 1")).unwrap();
    let title = "<title>Openness and exposure of the shutter a &amp; b &lt;c> over time, with its triggers</title>";
    assert_eq!(svg.lines().nth(1), Some(title));
    assert!(svg.contains("1 trigger in the middle of the exposure"));
    // In the light's path, of a lamp's pulse there is what comes through.
    for (set_up, is_flat) in [("emulated", true), ("in_path", false)] {
        let plan = planned(TRAPEZOID, &format!("triggers = 1; pulse = 0.9; set_up = '{set_up}'"));
        let svg = shutter::picture::svg("lit", &plan).unwrap();
        let (_, points) = svg.split_once("fill=\"#F0AB7C\" points=\"").unwrap();
        let heights = points.split('"').next().unwrap().split(' ').filter_map(|point| point.split_once(','));
        let heights: BTreeSet<_> = heights.map(|(_, y)| y).collect();
        assert_eq!(heights.len() == 2, is_flat, "{set_up}: {heights:?}");
    }
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
    let out = report(&planned(TRAPEZOID, "triggers = 100; timer_hz = 32768; min_gap = 0"));
    let rows = table(&out);
    assert_eq!(rows.len(), 25);
    assert_eq!((rows[0][0], rows[11][0], rows[13][0], rows[24][0]), ("0", "11", "88", "99"));
    assert_eq!(rows[12], ["...", "76", "more"]);
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

/// An edge far before the curve would squeeze it: it is told, not drawn to scale.
#[test]
fn a_delay_is_drawn_or_told() {
    for (delay, told) in [("0.125", ["\nsync\n", "delay 0.125 s"]), ("100", ["sync 100 s before"; 2])] {
        let plan = planned(TRAPEZOID, &format!("min_gap = 0; delay = {delay}"));
        let svg = shutter::picture::svg("late", &plan).unwrap();
        has(&svg, &told, &[]);
        // The edge stands before the curve.
        let left = |stroke: &str| -> Option<i32> {
            let (_, points) = svg.split_once(stroke)?.1.split_once("points=\"")?;
            points.split(',').next()?.parse().ok()
        };
        let edge = left("stroke=\"#2D333B\" stroke-width=\"16\"");
        assert_eq!(edge.is_some(), delay == "0.125");
        assert!(edge < left("stroke=\"#0072B2\" stroke-width=\"20\""), "{edge:?}");
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
