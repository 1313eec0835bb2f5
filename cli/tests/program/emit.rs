//! Each form that a plan is emitted in: it compiles or parses as it stands, without a warning, and holds the crate's
//! ticks and the numbers of the plan to the bit.

use std::env;
use std::path::Path;
use std::process::Command;

use serde_json::{Value, json};
use shutter_curve::ShutterCurve;
use shutter_plan::emit::{Form, emit, identifier, module, several};
use shutter_plan::lamp::Lamp;
use shutter_plan::plan::{Plan, Row, Trigger};

use crate::scenes::{BOX, LEAF, MEASURED, TIMES, with};
use crate::support::{Folder, SCENES, has, keys, number, planned, report, scenes};

fn text(form: Form, name: &str, plan: &Plan) -> String {
    emit(form, name, plan, false).unwrap()
}

fn object(name: &str, plan: &Plan) -> Value {
    serde_json::from_str(&text(Form::Json, name, plan)).unwrap()
}

/// A shutter in the light's path.
fn in_path(changes: &str) -> Plan {
    planned(LEAF, &format!("timer_hz = 1_000_000; set_up = 'in_path'; {changes}"))
}

fn curve_of(plan: &Plan) -> &ShutterCurve {
    &plan.curve.as_ref().unwrap().shutter
}

/// What a command prints that has to succeed without a word.
fn output(command: &mut Command) -> String {
    let output = command.output().expect("the command is there");
    let err = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && err.is_empty(), "{command:?}\n{err}");
    String::from_utf8(output.stdout).unwrap()
}

/// Runs a compiler of Rust in a folder.
fn rustc(compiler: impl AsRef<Path>, folder: &Folder, args: &[&str]) {
    let mut rustc = Command::new(compiler.as_ref());
    output(rustc.args(["--edition", "2024", "--out-dir", ".", "-D", "warnings"]).args(args).current_dir(&folder.0));
}

/// Scenes in which something counts from the edge, some of them in a timer of 16 bits that wraps in the frame.
fn from_the_edge() -> Vec<(String, Plan)> {
    let all = "unit = 'ms'\nopen_start = 1\ntimer_hz = 1_000_000\nset_up = 'emulated'\ndelay = 10\n";
    let curve = format!("{all}open_end = 1\nclose_start = 5\nclose_end = 5\ntriggers = 4\n");
    let times = format!("{all}trigger_times = [1.5, 2.5, 3.5, 4.5]\n");
    let scenes = [
        ("even", &curve, "timer_bits = 16; sync_falls = true; min_gap = 0"),
        ("lit", &curve, "timer_bits = 16; sync_falls = false; pulse = 0.2; min_gap = 0.1"),
        ("times", &times, "timer_bits = 16; sync_falls = true; min_gap = 0.5"),
        ("wide", &curve, "sync_falls = false; min_gap = 0; sync_settles = 20"),
        ("early", &curve, "sync_falls = false; min_gap = 0; delay = -0.3"),
    ];
    scenes.map(|(name, scene, changes)| (name.into(), planned(scene, changes))).into()
}

/// The speeds of a shutter: three exposures of the same leaves, on one timer.
fn speeds(names: [&str; 3], changes: &str) -> Vec<(String, Plan)> {
    let set_up = if changes.contains("duty") { "in_path" } else { "emulated" };
    let speed = |(name, length): (&str, f64)| {
        let curve = format!("open_end = 0.5; close_start = {}; close_end = {length}", length - 0.5);
        let frame = format!("triggers = {}; timer_hz = 1_000_000; min_gap = 0", 2.0 * length);
        let changes = format!("unit = 'ms'; {curve}; {frame}; set_up = '{set_up}'; {changes}");
        (name.to_string(), planned(BOX, &changes))
    };
    [(names[0], 2.0), (names[1], 4.0), (names[2], 16.0)].map(speed).into()
}

/// Trigger times without a curve, with a delay, and a speed that has a curve.
fn measured() -> Vec<(String, Plan)> {
    let times = "unit = 'ms'\nopen_start = 1\ntrigger_times = [2.0004, 2.5, 3.1]\nmin_gap = 0.1\n";
    let curve =
        "unit = 'ms'\nopen_start = 0\nopen_end = 1\nclose_start = 4\nclose_end = 5\ntriggers = 4\nmin_gap = 0\n";
    let speed = |(name, scene, delay): (&str, _, _)| {
        let changes = format!("timer_hz = 1_000_000; set_up = 'emulated'; delay = {delay}");
        (name.into(), planned(scene, &format!("{changes}; sync_falls = true")))
    };
    [("bounce", times, "4.247"), ("good", curve, "4")].map(speed).into()
}

/// Several plans under one name.
fn shutters() -> Vec<(&'static str, Vec<(String, Plan)>)> {
    vec![
        ("late", speeds(["1-500", "brief", "slow speed"], "delay = 4.247; sync_falls = true")),
        ("dosed", speeds(["1-60", "longer", "long"], "duty = 0.3")),
        ("unexplained", measured()),
    ]
}

/// When to trigger, or when to switch on and off, in turn.
fn ticks(plan: &Plan) -> Vec<u32> {
    let early = plan.sync.early;
    let of = |it: &Trigger| it.pulse.map_or(vec![it.ticks - early], |(on, off)| vec![on - early, off - early]);
    plan.triggers.iter().flat_map(of).collect()
}

/// A plan's numbers, as the programs below print them: each on a line.
fn numbers(plan: &Plan) -> Vec<u32> {
    let (ticks, sync, hz) = (ticks(plan), plan.sync, f64::from(plan.timer.hz));
    let mut all = vec![plan.timer.hz, plan.triggers.len() as u32];
    all.extend(&ticks);
    let Some(delay) = sync.delay else { return all };
    // The frame is over, the lamp has had its gap, and the contact its time to settle.
    let ticks_of = |time: Option<f64>| (time.unwrap_or_default() * hz).round() as u32;
    let (gap, settles) = (plan.scene.flashes.min_gap, plan.scene.shutter.sync_settles);
    let ready = sync.ticks + ticks[ticks.len() - 1] + ticks_of(gap).max(1);
    all.extend([u32::from(delay.falls.unwrap()), sync.ticks, ready.max(ticks_of(settles))]);
    let flashes = ticks.chunks(ticks.len() / plan.triggers.len());
    let on_off = |flash: &[u32]| [flash[0], if flash.len() == 2 { flash[1] } else { flash[0] + 7 }];
    for flash in [flashes.clone().next(), flashes.last()].into_iter().flatten() {
        all.extend(on_off(flash).map(|tick| sync.ticks + tick));
    }
    // Where the timer counted 60 000 at the edge.
    let last = u32::MAX >> (32 - plan.timer.bits);
    all.extend(ticks.iter().map(|tick| (60_000 + sync.ticks + tick) & last));
    all
}

fn lines(numbers: impl IntoIterator<Item = u32>) -> String {
    numbers.into_iter().map(|number| format!("{number}\n")).collect()
}

/// What a program prints of an array of speeds.
fn of_speeds(plans: &[(String, Plan)], name: fn(&str) -> String) -> String {
    let speed = |(called, plan): &(String, Plan)| {
        let edge = plan.sync.delay.map(|_| [plan.sync.ticks, plan.hold_off]);
        let numbers = edge.into_iter().flatten().chain([plan.triggers.len() as u32]).chain(ticks(plan));
        format!("{}\n{}", name(called), lines(numbers))
    };
    plans.iter().map(speed).collect()
}

/// Each module as it is emitted, which needs no crate, and with its curve, which holds the crate's ticks: in a library
/// that asks for documentation, with all that Clippy could say; and as private modules, of which nothing is used, with
/// one curve, as each takes the compiler long.
#[test]
fn rust_compiles_and_holds_the_ticks_of_the_crate() {
    let folder = Folder::new("rust");
    let source = format!("{SCENES}/../../src/lib.rs");
    rustc(compiler(), &folder, &["--crate-type", "rlib", "--crate-name", "shutter_curve", &source]);
    let [mut body, mut expected] = [const { String::new() }; 2];
    let mut modules = Vec::new();
    let mut add = |name: &str, text: String| {
        let file = name.replace(|c: char| !c.is_alphanumeric(), "_");
        let has_curve = text.contains("ShutterCurve");
        folder.write(&format!("{file}.rs"), text);
        modules.push((file.clone(), has_curve));
        file
    };
    for (name, plan) in scenes().into_iter().chain(from_the_edge()) {
        let text = text(Form::Rust, &name, &plan);
        assert!(!text.contains("shutter_curve") && text.starts_with(BY), "{text}");
        let bits = plan.timer.bits;
        // The compiler takes its time to build a curve: straight ramps and others, triggers and both kinds of pulses.
        if ["leaf", "led", "lit", "trapezoid"].contains(&name.as_str()) {
            let curve = emit(Form::Rust, &name, &plan, true).unwrap();
            assert!(curve.starts_with(&text), "{name}");
            let file = add(&format!("curve_{name}"), curve);
            // Of the others the crate knows no more than the curve.
            let held = match plan.lamp {
                Lamp::Triggered if bits == 32 && plan.sync.early == 0 => {
                    "timed.trigger_ticks(COUNT as u32).unwrap().eq(TICKS)".into()
                }
                Lamp::Doses { duty } => {
                    format!("timed.pulse_ticks(COUNT as u32, {duty:?}).unwrap().map(|it| (it.on, it.off)).eq(PULSES)")
                }
                _ => "timed.length() > 0".into(),
            };
            body += &format!(
                "{{ use emitted::{file}::*;
                let timed = SHUTTER.at(shutter_curve::Hz(TIMER_HZ)).unwrap().min_gap(0).min_pulse(0);
                assert!({held}); p(SHUTTER.exposure().to_bits()); }}\n"
            );
            expected += &lines([curve_of(&plan).exposure().to_bits()]);
        }
        let file = add(&format!("of_{name}"), text);
        body += &format!("{{ use emitted::{file}::*; p(TIMER_HZ); p(u32::try_from(COUNT).unwrap());\n");
        body += match plan.lamp.has_pulses() {
            true => "for (on, off) in PULSES { p(on); p(off); }\n",
            false => "for tick in TICKS { p(tick); }\n",
        };
        if plan.sync.delay.is_some() {
            // In a constant, as a firmware may have it.
            body += &format!(
                "const LAST: (u{bits}, u{bits}) = on_off(COUNT - 1, 7);
                p(SYNC_FALLS); p(DELAY_TICKS); p(HOLD_OFF_TICKS);
                for (on, off) in [on_off(0, 7), LAST] {{ p(on); p(off); }}\n"
            );
            body += match plan.lamp.has_pulses() {
                true => "for (on, off) in due(60_000) { p(on); p(off); }\n",
                false => "for tick in due(60_000) { p(tick); }\n",
            };
        }
        body += "}\n";
        expected += &lines(numbers(&plan));
    }
    for (name, plans) in shutters() {
        let has_curves = plans.iter().all(|(_, plan)| plan.curve.is_some());
        let file = add(name, several(Form::Rust, name, &plans, has_curves).unwrap());
        let edge = if plans[0].1.sync.delay.is_some() { "p(it.delay_ticks); p(it.hold_off_ticks);" } else { "" };
        let (ticks, print) = match plans[0].1.lamp.has_pulses() {
            true => ("pulses", "for (on, off) in it.pulses { p(*on); p(*off); }"),
            false => ("ticks", "for tick in it.ticks { p(*tick); }"),
        };
        let curve = if has_curves { "assert!(it.shutter.exposure() > 0.0);" } else { "" };
        body += &format!(
            "for it in &emitted::{file}::SPEEDS {{
                println!(\"{{}}\", it.name); {edge} p(u32::try_from(it.{ticks}.len()).unwrap()); {print} {curve} }}\n"
        );
        expected += &of_speeds(&plans, str::to_string);
    }
    modules.sort();
    let linked = ["--extern", "shutter_curve=libshutter_curve.rlib", "--extern", "emitted=libemitted.rlib"];
    let declared = |(file, _): &(String, bool)| format!("/// .\npub mod {file};\n");
    folder.write("emitted.rs", format!("//! .\n#![no_std]\n{}", modules.iter().map(declared).collect::<String>()));
    let lints = ["--crate-type", "rlib", "-D", "missing_docs", "-D", "clippy::pedantic", "emitted.rs"];
    rustc("clippy-driver", &folder, &[&linked[..2], &lints].concat());
    let mut rustfmt = Command::new("rustfmt");
    let with_defaults = ["--check", "--edition", "2024", "--config", "use_small_heuristics=Default", "emitted.rs"];
    output(rustfmt.args(with_defaults).current_dir(&folder.0));
    let few = modules.iter().filter(|(file, has_curve)| !has_curve || file == "curve_leaf");
    let private = few.map(|(file, _)| format!("mod {file};\n"));
    let print = "fn p(x: impl Into<u64>) { println!(\"{}\", x.into()); }";
    folder.write("main.rs", format!("{}{print}\nfn main() {{\n{body}}}\n", private.collect::<String>()));
    rustc(compiler(), &folder, &[&linked[..], &["main.rs"]].concat());
    assert_eq!(output(&mut Command::new(folder.path("main"))), expected);
}

fn compiler() -> std::ffi::OsString {
    env::var_os("RUSTC").unwrap_or("rustc".into())
}

/// By what a text was made.
const BY: &str = concat!("// Made by `shutter plan` ", env!("CARGO_PKG_VERSION"), ".\n");

/// By both compilers, all in one file, each header twice, as headers come.
#[test]
fn c_compiles_in_one_file_and_holds_the_same_ticks() {
    let folder = Folder::new("c");
    let [mut includes, mut body, mut expected] = [const { String::new() }; 3];
    let mut add = |file: &str, text: String| {
        folder.write(file, text);
        includes += &format!("#include \"{file}\"\n").repeat(2);
    };
    for (name, plan) in scenes().into_iter().chain(from_the_edge()) {
        add(&format!("{name}.h"), text(Form::C, &name, &plan));
        let (lower, bits) = (identifier(&name), plan.timer.bits);
        let (upper, n) = (lower.to_ascii_uppercase(), plan.triggers.len());
        let arrays: &[_] = if plan.lamp.has_pulses() { &["on", "off"] } else { &["ticks"] };
        let each = |print: &dyn Fn(String) -> String| {
            let prints: String = arrays.iter().map(|array| print(format!("{lower}_{array}[i]"))).collect();
            format!("for (int i = 0; i < {n}; i++) {{ {prints} }}\n")
        };
        body += &format!("P({upper}_TIMER_HZ); P({upper}_COUNT);\n{}", each(&|ticks| format!("P({ticks});")));
        if plan.sync.delay.is_some() {
            let due = each(&|ticks| format!("P({lower}_due((uint{bits}_t)60000, {ticks}));"));
            body += &format!(
                "P({upper}_SYNC_FALLS); P({upper}_DELAY_TICKS); P({upper}_HOLD_OFF_TICKS);
                for (int i = 0; i < 2; i++) {{ uint{bits}_t on, off;
                    {lower}_on_off(i ? {n} - 1 : 0, 7, &on, &off); P(on); P(off); }}\n{due}"
            );
        }
        expected += &lines(numbers(&plan));
    }
    for (name, plans) in shutters() {
        add(&format!("{name}.h"), several(Form::C, name, &plans, false).unwrap());
        let array = format!("{name}_speeds[s]");
        let edge = format!("P({array}.delay_ticks); P({array}.hold_off_ticks);");
        let edge = if plans[0].1.sync.delay.is_some() { &edge } else { "" };
        let ticks = match plans[0].1.lamp.has_pulses() {
            true => format!("P({array}.on[i]); P({array}.off[i]);"),
            false => format!("P({array}.ticks[i]);"),
        };
        body += &format!(
            "for (unsigned s = 0; s < {}_SPEEDS; s++) {{ puts({array}.name); {edge} P({array}.count);
                for (unsigned i = 0; i < {array}.count; i++) {{ {ticks} }} }}\n",
            name.to_ascii_uppercase()
        );
        expected += &of_speeds(&plans, identifier);
    }
    let print = "#include <stdio.h>\n#define P(x) printf(\"%lu\\n\", (unsigned long)(x))";
    let source = format!("{includes}{print}\nint main(void) {{\n{body}return 0;\n}}\n");
    for (variable, compiler, standard, file) in
        [("CC", "cc", "-std=c99", "main.c"), ("CXX", "c++", "-std=c++11", "main.cpp")]
    {
        folder.write(file, &source);
        let program = folder.path("main");
        let compiler = env::var(variable).unwrap_or(compiler.into());
        let is_there = Command::new(&compiler).arg("--version").output().is_ok();
        assert!(is_there, "no compiler {compiler}: this test compiles headers with $CC, or cc, and $CXX, or c++");
        let mut compile = Command::new(compiler);
        compile.args([standard, "-pedantic", "-Wall", "-Wextra", "-Werror", "-o"]);
        output(compile.arg(&program).arg(folder.path(file)));
        assert_eq!(output(&mut Command::new(&program)), expected, "{file}");
    }
}

/// A header of the same name with other ticks would be left out in silence.
#[test]
fn two_different_headers_of_one_name_do_not_compile() {
    let folder = Folder::new("twice");
    for (file, triggers) in [("a.h", 3), ("b.h", 4)] {
        let plan = planned(BOX, &format!("set_up = 'emulated'; triggers = {triggers}"));
        folder.write(file, text(Form::C, "box", &plan));
    }
    folder.write("main.c", "#include \"a.h\"\n#include \"b.h\"\n");
    let run = folder.shell("cc -fsyntax-only main.c");
    let told = run.err.contains("box_ticks");
    assert!(run.code != Some(0) && told, "{run:?}");
}

#[test]
fn speeds_that_do_not_go_together_are_refused() {
    let with = |changes: &str| {
        let mut plans = speeds(["1-500", "box", "slow speed"], "delay = 1; sync_falls = true");
        let curve = "open_end = 1; close_end = 2; timer_hz = 1_000_000; set_up = 'emulated'";
        plans[1].1 = planned(BOX, &format!("{curve}; {changes}"));
        plans
    };
    let refused = |form, plans: &[_]| several(form, "camera", plans, false).err();
    // A row tells less than an object, and an array's elements tell the same.
    let (arrays, lists) = (&[Form::Rust, Form::C][..], &[Form::Rust, Form::C, Form::Csv][..]);
    let edge = "delay = 1; sync_falls = true; ";
    for (forms, changes, reason) in [
        (lists, "timer_hz = 999; lamp_lag = 0.1", "timer_hz: 1000000 in 1-500, 999 in box; one list is for one timer"),
        (arrays, "", "delay: 1-500 has one and box has none; an array needs all or none"),
        (lists, "delay = 1; sync_falls = false", "sync_falls: 1-500 and box differ; one list is for one edge"),
        (lists, &format!("{edge}set_up = 'in_path'"), "set_up: 1-500 and box differ; one list is for one set-up"),
        (lists, &format!("{edge}lamp_lag = 0.1"), "lamp_lag: 1-500 and box differ; one list is for one lamp"),
        (arrays, &format!("{edge}pulse = 0.1"), "pulses: one of 1-500 and box has them; an array needs all or none"),
    ] {
        for form in [Form::Rust, Form::C, Form::Csv, Form::Json] {
            let is_refused = forms.contains(&form).then_some(reason);
            assert_eq!(refused(form, &with(changes)).as_deref(), is_refused, "{form:?}: {changes}");
        }
    }
    // The first has no edge, and the two behind it differ.
    let [plain, other] = ["", "delay = 1; sync_falls = false"].map(with);
    let three = [("plain".into(), plain[1].1.clone()), other[0].clone(), other[1].clone()];
    assert_eq!(refused(Form::Csv, &three).unwrap(), "sync_falls: 1-500 and box differ; one list is for one edge");
    for form in [Form::Csv, Form::Json] {
        let twice = [plain[0].clone(), plain[0].clone()];
        assert_eq!(refused(form, &twice).unwrap(), "1-500 and 1-500 would both be called 1-500");
    }
    let plans = speeds(["1-500", "Slow-Speed", "slow speed"], "");
    assert_eq!(refused(Form::C, &plans).unwrap(), "Slow-Speed and slow speed would both be called slow_speed");
}

#[test]
fn speeds_are_rows_and_objects() {
    for (name, plans) in shutters() {
        let one = |form: Form| plans.iter().map(move |(name, plan)| text(form, name, plan));
        let rows: String = one(Form::Csv).map(|text| text.strip_prefix(HEAD).unwrap().to_string()).collect();
        assert_eq!(several(Form::Csv, name, &plans, false).unwrap(), format!("{HEAD}{rows}"));
        let objects: Vec<Value> = one(Form::Json).map(|text| serde_json::from_str(&text).unwrap()).collect();
        let array: Value = serde_json::from_str(&several(Form::Json, name, &plans, false).unwrap()).unwrap();
        assert_eq!(array, Value::from(objects));
    }
}

/// Nobody's set-up, timer, gap or edge is assumed, in no form.
#[test]
fn hardware_gets_nothing_that_nobody_gave() {
    let edge = "sync_falls = false # the edge of the camera's sync that triggered the oscilloscope -> ";
    for (without, keys) in [
        ("timer_hz", &["timer_hz"][..]),
        ("min_gap", &["min_gap"]),
        (edge, &["sync_falls"]),
        // The trace's edge is not that of another delay.
        (&format!("{edge}delay = 4; delay = 4.2470172 -> delay = 4.2470172\nsync_falls = true"), &["sync_falls"]),
        ("set_up; timer_hz; min_gap", &["set_up", "set_up", "timer_hz", "min_gap"]),
    ] {
        let plan = planned(MEASURED, without);
        let told = several(Form::C, "camera", &[("leaf".to_string(), plan.clone())], false).unwrap_err();
        for form in [Form::Rust, Form::C, Form::Csv, Form::Json] {
            let reason = emit(form, "leaf", &plan, false).unwrap_err();
            let asked = reason.lines().filter_map(|line| line.split_once(" = ")).map(|it| it.0.trim());
            let asked = asked.filter(|key| !key.starts_with('#'));
            assert_eq!((asked.collect::<Vec<_>>(), &told), (keys.to_vec(), &format!("leaf: {reason}")), "{reason}");
        }
    }
    // Nobody is left with the one set-up that is offered.
    let asked = emit(Form::C, "times", &planned(TIMES, ""), false).unwrap_err();
    assert!(asked.contains("in the light's path it needs a curve"), "{asked}");
}

/// The names of the columns.
const HEAD: &str = "scene,index,u,time_s,ticks,gap_ticks,from_edge_ticks,on_ticks,off_ticks,dose\n";

#[test]
fn times_without_a_curve_are_told_to_be_so() {
    let speeds = measured();
    let [times, curve] = [0, 1].map(|i| &speeds[i].1);
    for form in [Form::Rust, Form::C] {
        has(&text(form, "bounce", times), &["no curve: trigger times as measured"], &[]);
    }
    has(&emit(Form::Rust, "bounce", times, true).unwrap_err(), &["and no curve"], &[]);
    let csv = text(Form::Csv, "bounce", times);
    let rows = "bounce,0,,0.0020004,1000,,5247,,,\nbounce,1,,0.0025,1500,500,5747,,,\n\
                bounce,2,,0.0031,2100,600,6347,,,\n";
    assert_eq!(csv, format!("{HEAD}{rows}"));
    // All forms have the same keys.
    let [json, beside] = [times, curve].map(|plan| object("bounce", plan));
    let first = &json["triggers"][0];
    assert_eq!((number(first, "time_s"), number(first, "from_edge_ticks")), (0.0020004, 5247.0));
    assert_eq!(keys(&json), keys(&beside));
    assert_eq!(keys(first), HEAD.trim().split(',').skip(1).collect::<Vec<_>>());
    assert!(json["exposure_s"].is_null() && first["u"].is_null());
    let csv = several(Form::Csv, "camera", &speeds, false).unwrap();
    assert!(csv.starts_with(&format!("{HEAD}{rows}good,0,0.125,")), "{csv}");
}

/// Both hold the numbers of the plan.
fn csv_and_json_are_right(name: &str, plan: &Plan) {
    let csv = text(Form::Csv, name, plan);
    let rows = csv::Reader::from_reader(csv.as_bytes()).into_deserialize().map(Result::unwrap);
    let json: Value = object(name, plan);
    for rows in [rows.collect::<Vec<Row>>(), serde_json::from_value(json["triggers"].clone()).unwrap()] {
        assert_eq!(rows.len(), plan.triggers.len(), "{name}");
        for (i, (row, trigger)) in rows.iter().zip(&plan.triggers).enumerate() {
            let pulse = row.on_ticks.zip(row.off_ticks);
            let read = Trigger { u: row.u, time: f64::from(row.time_s as f32), ticks: row.ticks, pulse };
            let edge = plan.sync.delay.map(|_| plan.sync.ticks + row.ticks);
            assert_eq!((row.index, read, row.from_edge_ticks), (i, *trigger, edge), "{name}");
        }
        let gaps = rows.iter().map(|row| row.gap_ticks);
        assert!(gaps.eq([None].into_iter().chain(plan.gaps().map(Some))), "{name}");
    }
    let (curve, delay) = (curve_of(plan), plan.sync.delay);
    assert_eq!((&json["scene"], &json["timer_hz"]), (&name.into(), &plan.timer.hz.into()));
    let exact = ["exposure_s", "efficiency"].map(|key| number(&json, key) as f32);
    assert_eq!(exact, [curve.exposure(), curve.efficiency()]);
    assert_eq!(json["direct_triggers"], curve.direct_triggers());
    assert_eq!(json["delay_s"].as_f64(), delay.map(|delay| delay.seconds));
    assert_eq!(json["delay_ticks"].as_u64(), delay.map(|_| plan.sync.ticks.into()));
    assert!(number(&json, "opening_s") >= 0.0 && number(&json, "half_open_s") > 0.0);
    assert_eq!(json["delta_ev"].is_null(), plan.scene.shutter.nominal.is_none());
}

#[test]
fn csv_and_json_parse_and_hold_the_same_numbers() {
    scenes().iter().for_each(|(name, plan)| csv_and_json_are_right(name, plan));
    // Numbers at both ends of what a scene may hold come back as they were.
    for (factor, timer_hz) in [(1e-18, u32::MAX), (1e-7, u32::MAX), (7e8, 1)] {
        let times = format!("open_start = -{factor:e}; open_end = {factor:e}; close_start = {factor:e}");
        let frame = format!("triggers = 1; timer_hz = {timer_hz}; min_gap = 0; set_up = 'emulated'");
        let plan = planned(BOX, &format!("{times}; close_end = {:e}; {frame}", 1.7 * factor));
        csv_and_json_are_right("x", &plan);
        curve_is_right(&plan);
    }
    // Numbers with all the digits that they have.
    let plan = planned(
        "open_start = 1e-9\nopen_end = 0.002512345678\nclose_start = 0.00751234567\nclose_end = 0.0101234567\n\
         shutteropening = [0.0912345678, 1e-9, 0.15123456, 0.987654321, 0.84567891, 0.9999999, 0.9123456, 1e-30]\n",
        "triggers = 3; timer_hz = 12_345_678; min_gap = 0; set_up = 'emulated'",
    );
    curve_is_right(&plan);
}

/// The module's curve has the numbers of the plan.
fn curve_is_right(planned: &Plan) {
    let rust = emit(Form::Rust, "x", planned, true).unwrap();
    let (linear, cubic) = (rust.split_once("linear("), rust.split_once("shutteropening("));
    let (_, numbers) = linear.or(cubic).unwrap();
    let numbers = numbers.split(['[', ']', '(', ')', ',', ' ', '\n']);
    let numbers: Vec<f32> =
        numbers.map_while(|it| if it.is_empty() { Some(None) } else { it.parse().ok().map(Some) }).flatten().collect();
    let shape = planned.curve.as_ref().unwrap().shape;
    assert_eq!(numbers, [&shape.times[..], shape.inner.as_slice().concat().as_slice()].concat());
}

#[test]
fn any_name_becomes_one_that_a_program_can_have() {
    for (name, of_c, of_rust) in [
        ("leaf", "leaf", "leaf"),
        ("Leaf 2", "leaf_2", "leaf_2"),
        ("1-250", "shutter_1_250", "shutter_1_250"),
        ("__box__", "box", "box_"),
        ("shutter_curve", "shutter_curve", "shutter_curve_"),
        ("µ / \u{202e}", "shutter", "shutter"),
        ("", "shutter", "shutter"),
        ("self", "self", "self_"),
        ("yield", "yield", "yield_"),
    ] {
        assert_eq!((identifier(name), module(name)), (of_c.into(), of_rust.into()));
    }
}

/// A name comes from a file, and files have names of any kind.
#[test]
fn no_name_breaks_a_form() {
    let plan = planned(BOX, "set_up = 'emulated'");
    let name = "*/ \n#error \u{202e}\"\\";
    let [rust, c] = [Form::Rust, Form::C].map(|form| text(form, name, &plan));
    assert!(rust.contains("\n// scene        *_ _#error _\"\\\n"), "{rust}");
    has(&c, &["\n * scene        *_ _#error _\"\\\n", " error_ticks[ERROR_COUNT] = {"], &[]);
    let json: Value = object(name, &plan);
    assert_eq!(json["scene"], name);
}

/// A module says from where its ticks count; what an array says of all holds for the one that is moved as well.
#[test]
fn a_module_says_what_its_ticks_count_from() {
    let delay = "delay = 2; sync_falls = true; ";
    for form in [Form::Rust, Form::C] {
        for (keys, told) in [
            ("lamp_lag = 0.7", " to the start of opening, less the lamp's lag."),
            ("lamp_lag = 3", "No delay is left: the lamp's lag is longer"),
            ("delay = -0.2", "None: the shutter opens before the edge"),
        ] {
            let moved = in_path(&format!("{delay}{keys}"));
            has(&text(form, "scene", &moved), &[told, "When to trigger, counted from the end of the delay."], &[]);
            if keys == "delay = -0.2" {
                let both = [("plain".into(), in_path(delay)), ("early".into(), moved)];
                let both = several(form, "both", &both, false).unwrap();
                assert_eq!(both.matches("counted from the end of the delay").count(), 2, "{both}");
            }
        }
    }
}

/// What the command line says counts for one run, and is refused where the scene's own would be.
#[test]
fn the_command_line_answers_for_one_run() {
    let folder = Folder::new("line");
    folder.write("scene.toml", with(LEAF, "delay = 2"));
    folder.write("pulse.toml", with(LEAF, "delay = 2; pulse = 0.1"));
    let line = "plan scene.toml --emit json --timer-hz 1MHz";
    let answers = format!("{line} --set-up in_path --sync-falls true");
    for (more, keys) in [
        ("--pulse 100us", "pulse = 0.1"),
        ("--fully-open --lamp-lag 1ms", "fully_open = true; lamp_lag = 1"),
        ("--duty 0.5 --min-pulse 10us", "duty = 0.5; min_pulse = 0.01"),
    ] {
        let whole = in_path(&format!("delay = 2; sync_falls = true; {keys}"));
        let run = folder.run(&format!("{answers} {more}")).well();
        assert_eq!(run.out, text(Form::Json, "scene", &whole));
        // In every form, a table as well.
        assert_eq!(run.err.contains("dims the flashes to"), more.contains("--pulse"), "{}", run.err);
    }
    folder.refuses(&[
        (&format!("{answers} --duty 0.5 --fully-open"), "cannot be used with"),
        // As in the file: no pulse is dropped without a word.
        ("plan pulse.toml --fully-open --set-up in_path", "fully_open: it is for flashes whose length"),
        ("plan pulse.toml --duty 0.5", "duty: a scene has `duty` or `pulse`"),
        (line, "set_up = \"in_path\""),
        (line, "sync_falls"),
    ]);
}

/// What a scene keeps of its fit goes along: the bound of the efficiency, and each doubt. Comments are comments.
#[test]
fn what_the_fit_doubted_is_in_every_form() {
    let measured = "[shutter.measured]\ntrace = \"x.csv\"\nmodel = \"straight ramps\"\nunit = \"ms\"\nexposure = 5.5\n\
                    exposure_error = 0.1\nefficiency = \"at most 80 %\"\nwarnings = [\"the lamp flickers\"]\n[flashes]";
    let comments = "# Exposure bracket: 3 frames\n# Warning: do not look into the lamp\n";
    let times = "unit = 'ms'\nopen_start = 1\ntrigger_times = [2]\nmin_gap = 0\n";
    for scene in [LEAF, times] {
        let commented = comments.to_string()
            + &with(scene, &format!("set_up = 'emulated'; timer_hz = 1_000_000; [flashes] -> {measured}"));
        let plan = Plan::parse(&commented).unwrap();
        for form in [Form::Rust, Form::C] {
            let module = text(form, "scene", &plan);
            let measured = "measured     exposure 5.50 ± 0.10 ms, efficiency at most 80 %\n";
            has(&module, &[measured, "doubt        the lamp flickers\n"], &["bracket", "do not look"]);
        }
        let doubts = &object("scene", &plan)["doubts"];
        assert_eq!(doubts[0], json!({ "code": "trace", "text": "the lamp flickers", "remedy": null }));
        // Without its checksum, anything may have been changed.
        assert_eq!(doubts[1]["code"], "edited");
        has(&report(&plan), &["\ndoubt        the lamp flickers\n"], &["do not look"]);
    }
}
