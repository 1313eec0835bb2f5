//! Each form that a plan is emitted in, of each scene that ships: it compiles or parses as it stands, and holds the
//! crate's ticks and the numbers of the plan to the bit.

use std::env;
use std::fmt::Display;
use std::path::Path;
use std::process::Command;
use std::sync::OnceLock;

use serde::Deserialize;
use serde_json::Value;
use shutter_plan::emit::{Form, emit, identifier, module, several};
use shutter_plan::lamp::Lamp;
use shutter_plan::plan::{Plan, Trigger};

use shutter_curve::ShutterCurve;

use crate::refusals::{BOX, MEASURED};
use crate::support::{Folder, SCENES, has, keys, number, planned, scenes};

fn text(form: Form, name: &str, plan: &Plan) -> String {
    emit(form, name, plan, false).unwrap()
}

fn curve_of(plan: &Plan) -> &ShutterCurve {
    &plan.curve.as_ref().unwrap().shutter
}

fn has_pulses(plan: &Plan) -> bool {
    plan.triggers[0].pulse.is_some()
}

/// What a command prints that has to succeed.
fn output(command: &mut Command) -> String {
    let output = command.output().expect("the command is there");
    let err = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && err.is_empty(), "{command:?}\n{err}");
    String::from_utf8(output.stdout).unwrap()
}

/// The triggers or pulses, as the test programs print them.
fn lines(planned: &Plan) -> String {
    planned.triggers.iter().map(line).collect()
}

fn line(trigger: &Trigger) -> String {
    match trigger.pulse {
        Some((on, off)) => format!("{on} {off}\n"),
        None => format!("{}\n", trigger.ticks),
    }
}

/// Runs the compiler in a folder, without a warning.
fn rustc(folder: &Folder, args: &[&str]) {
    compile(env::var_os("RUSTC").unwrap_or("rustc".into()).as_ref(), folder, args);
}

fn compile(compiler: &Path, folder: &Folder, args: &[&str]) {
    let mut rustc = Command::new(compiler);
    output(rustc.args(["--edition", "2024", "--out-dir", "."]).args(args).current_dir(&folder.0));
}

/// The output of a program of these modules and statements.
fn ran(folder: &Folder, main: &str, args: &[&str]) -> String {
    folder.write("main.rs", main);
    rustc(folder, &[args, &["-D", "warnings", "main.rs"]].concat());
    output(&mut Command::new(folder.path("main")))
}

/// Compiles a file of modules as a library that asks for documentation, with all that Clippy could say, and checks how
/// they are written.
fn is_clean(folder: &Folder, file: &str, modules: &[impl Display], linked: &[&str]) {
    let module = |name| format!("/// .\npub mod {name};\n");
    let modules: String = modules.iter().map(module).collect();
    folder.write(file, format!("//! .\n#![no_std]\n{modules}"));
    let args = ["--crate-type", "lib", "-D", "missing_docs", "-D", "clippy::pedantic", file];
    compile("clippy-driver".as_ref(), folder, &[&["-D", "warnings"], linked, &args].concat());
    let mut rustfmt = Command::new("rustfmt");
    let with_defaults = ["--check", "--edition", "2024", "--config", "use_small_heuristics=Default"];
    output(rustfmt.args(with_defaults).arg(file).current_dir(&folder.0));
}

/// The crate by itself, which has no dependencies, built once; as an argument of the compiler.
fn the_crate() -> &'static str {
    static BUILT: OnceLock<String> = OnceLock::new();
    BUILT.get_or_init(|| {
        let (folder, source) = (Folder::new("crate"), format!("{SCENES}/../../src/lib.rs"));
        rustc(&folder, &["--crate-type", "rlib", "--crate-name", "shutter_curve", &source]);
        format!("shutter_curve={}", folder.path("libshutter_curve.rlib").display())
    })
}

/// Without the crate as it is emitted; with its curve, it holds the crate's ticks.
#[test]
fn rust_compiles_alone_and_holds_the_ticks_of_the_crate() {
    let folder = Folder::new("rust");
    let [mut alone, mut curves] = [const { Vec::new() }; 2];
    let (mut main, mut expected) = (String::new(), String::new());
    for (name, planned) in scenes() {
        let (module, plan) = (format!("scene_{}", name.replace('-', "_")), &planned);
        let curve = emit(Form::Rust, &name, &planned, true).unwrap();
        let text = text(Form::Rust, &name, &planned);
        assert!(!text.contains("shutter_curve") && curve.starts_with(&text), "{text}");
        let pulses = text.contains("PULSES");
        assert_eq!((pulses, text.contains("TICKS: [")), (has_pulses(plan), !pulses));
        folder.write(&format!("{module}.rs"), text);
        folder.write(&format!("{module}_curve.rs"), curve);
        main += &format!(
            "{{ use alone::{module} as scene; use curves::{module}_curve as curve;
            let _timed = curve::SHUTTER.at(shutter_curve::Hz(curve::TIMER_HZ)).unwrap().min_gap(0).min_pulse(0);\n"
        );
        main += match pulses {
            true => {
                "assert_eq!(scene::PULSES, curve::PULSES); for (on, off) in scene::PULSES { println!(\"{on} {off}\"); }"
            }
            false => {
                "assert!(_timed.trigger_ticks(curve::COUNT as u32).unwrap().eq(scene::TICKS));
                for tick in scene::TICKS { println!(\"{tick}\"); }"
            }
        };
        if let Lamp::Doses { duty } = plan.lamp {
            main += &format!(
                "let pulses = _timed.pulse_ticks(curve::COUNT as u32, {duty:?}).unwrap();
                assert!(pulses.map(|pulse| (pulse.on, pulse.off)).eq(scene::PULSES));"
            );
        }
        main += "println!(\"{:08x}\", curve::SHUTTER.exposure().to_bits()); }\n";
        expected += &format!("{}{:08x}\n", lines(&planned), curve_of(&planned).exposure().to_bits());
        curves.push(format!("{module}_curve"));
        alone.push(module);
    }
    is_clean(&folder, "alone.rs", &alone, &[]);
    is_clean(&folder, "curves.rs", &curves, &["--extern", the_crate()]);
    let libraries = ["--extern", "alone=libalone.rlib", "--extern", "curves=libcurves.rlib"];
    let args = [&libraries[..], &["--extern", the_crate(), "-L", "../crate"]].concat();
    assert_eq!(ran(&folder, &format!("fn main() {{\n{main}}}\n"), &args), expected);
}

#[test]
fn speeds_are_an_array_of_rust_and_nothing_unused_is_warned_of() {
    let folder = Folder::new("rust_speeds");
    let (late, lit) = (speeds("delay = 4.247; sync_falls = true"), speeds("duty = 0.3"));
    let times = several(Form::Rust, "times", &measured(), false).unwrap();
    folder.write("times.rs", times);
    folder.write("late.rs", several(Form::Rust, "late", &late, false).unwrap());
    folder.write("lit.rs", several(Form::Rust, "lit", &lit, true).unwrap());
    let one = text(Form::Rust, "one", &late[0].1);
    let by = concat!("// Made by `shutter plan` ", env!("CARGO_PKG_VERSION"), ".\n");
    assert!(one.starts_with(by), "{one}");
    folder.write("one.rs", one);
    is_clean(&folder, "lib.rs", &["late", "lit", "times"], &["--extern", the_crate()]);
    // Private modules of which next to nothing is used.
    let main = r#"mod late; mod lit; mod one; mod times;
        fn main() {
            println!("{} {}", late::box_::DELAY_TICKS, late::shutter_1_500::COUNT);
            for speed in &late::SPEEDS { println!("{} {} {:?}", speed.name, speed.delay_ticks, speed.ticks); }
            for speed in &times::SPEEDS { println!("{} {:?}", speed.delay_ticks, speed.ticks); }
            for speed in &lit::SPEEDS {
                let n = u32::try_from(speed.pulses.len()).unwrap();
                let timed = speed.shutter.at(shutter_curve::Hz(lit::TIMER_HZ)).unwrap();
                let pulses = timed.pulse_ticks(n, 0.3).unwrap();
                assert!(pulses.map(|pulse| (pulse.on, pulse.off)).eq(speed.pulses.iter().copied()));
            }
        }"#;
    let mut expected = String::from("4247 4\n");
    for (name, speed) in &late {
        let ticks: Vec<_> = speed.triggers.iter().map(|trigger| trigger.ticks).collect();
        expected += &format!("{name} 4247 {ticks:?}\n");
    }
    expected += "4247 [1000, 1500, 2100]\n4000 [1000, 2000, 3000, 4000]\n";
    assert_eq!(ran(&folder, main, &["--extern", the_crate()]), expected);
}

/// A program by both compilers, without a warning; what it prints, by either.
fn compiled(folder: &Folder, includes: &str, body: &str) -> String {
    let source = format!("{includes}#include <stdio.h>\nint main(void) {{\n{body}return 0;\n}}\n");
    let printed = [("CC", "cc", "-std=c99", "main.c"), ("CXX", "c++", "-std=c++11", "main.cpp")].map(
        |(variable, compiler, standard, file)| {
            folder.write(file, &source);
            let program = folder.path("main");
            let compiler = env::var(variable).unwrap_or(compiler.into());
            let is_there = Command::new(&compiler).arg("--version").output().is_ok();
            assert!(is_there, "no compiler {compiler}: this test compiles headers with $CC, or cc, and $CXX, or c++");
            let mut compile = Command::new(compiler);
            compile.args([standard, "-pedantic", "-Wall", "-Wextra", "-Werror", "-o"]);
            output(compile.arg(&program).arg(folder.path(file)));
            output(&mut Command::new(&program))
        },
    );
    let [c, cpp] = printed;
    assert_eq!(c, cpp);
    c
}

/// All scenes that ship in one file, each header twice, as headers come.
#[test]
fn c_compiles_in_one_file_and_holds_the_same_ticks() {
    let folder = Folder::new("c");
    let (mut includes, mut body, mut expected) = (String::new(), String::new(), String::new());
    let scenes = scenes();
    for (name, planned) in &scenes {
        folder.write(&format!("{name}.h"), text(Form::C, name, planned));
        includes += &format!("#include \"{name}.h\"\n").repeat(2);
        let (plan, lower) = (planned, name.replace('-', "_"));
        let upper = lower.to_ascii_uppercase();
        let print = match has_pulses(plan) {
            true => format!("\"%lu %lu\\n\", (unsigned long){lower}_on[i], (unsigned long){lower}_off[i]"),
            false => format!("\"%lu\\n\", (unsigned long){lower}_ticks[i]"),
        };
        body += &format!(
            "printf(\"%lu\\n\", (unsigned long){upper}_TIMER_HZ);
            for (unsigned i = 0; i < {upper}_COUNT; i++) printf({print});\n"
        );
        expected += &format!("{}\n{}", plan.timer.hz, lines(planned));
        if let Some(delay) = plan.sync.delay {
            body += &format!("printf(\"%lu %d\\n\", (unsigned long){upper}_DELAY_TICKS, {upper}_SYNC_FALLS);\n");
            expected += &format!("{} {}\n", plan.sync.ticks, u8::from(delay.falls.unwrap()));
        }
    }
    assert!(scenes.iter().any(|(_, planned)| planned.sync.delay.is_some()));
    assert_eq!(compiled(&folder, &includes, &body), expected);
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
    let told = run.err.contains("two different schedules are called box");
    assert!(run.code != Some(0) && told, "{run:?}");
}

/// The speeds of a shutter: three exposures of the same leaves, on one timer.
fn speeds(changes: &str) -> Vec<(String, Plan)> {
    let set_up = if changes.contains("duty") { "in_path" } else { "emulated" };
    let speed = |(name, length): (&str, f64)| {
        let curve = format!("open_end = 0.5; close_start = {}; close_end = {length}", length - 0.5);
        let frame = format!("triggers = {}; timer_hz = 1_000_000; min_gap = 0", 2.0 * length);
        let changes = format!("unit = 'ms'; {curve}; {frame}; set_up = '{set_up}'; {changes}");
        (name.to_string(), planned(BOX, &changes))
    };
    [("1-500", 2.0), ("box", 4.0), ("slow speed", 16.0)].map(speed).into()
}

#[test]
fn speeds_are_an_array_of_c() {
    let delay = "camera_speeds[s].delay_ticks";
    let ticks = "\"%lu\\n\", (unsigned long)camera_speeds[s].ticks[i]";
    let pulse = "\"%lu %lu\\n\", (unsigned long)camera_speeds[s].on[i], (unsigned long)camera_speeds[s].off[i]";
    let names = ["shutter_1_500", "box", "slow_speed"];
    for (folder, plans, names, delay, print) in [
        ("late", speeds("delay = 4.247; sync_falls = true"), &names[..], delay, ticks),
        ("lit", speeds("duty = 0.3"), &names, "0", pulse),
        ("times", measured().into(), &["bounce", "good"], delay, ticks),
    ] {
        let folder = Folder::new(folder);
        folder.write("camera.h", several(Form::C, "camera", &plans, false).unwrap());
        // The same scene by itself is the same text.
        let (name, slow) = &plans[plans.len() - 1];
        folder.write("slow.h", text(Form::C, name, slow));
        let includes = ["camera.h", "slow.h", "camera.h"].map(|file| format!("#include \"{file}\"\n"));
        let body = format!(
            "for (unsigned s = 0; s < CAMERA_SPEEDS; s++) {{
                printf(\"%s %lu \", camera_speeds[s].name, (unsigned long)CAMERA_TIMER_HZ);
                printf(\"%lu\\n\", (unsigned long){delay});
                for (unsigned i = 0; i < camera_speeds[s].count; i++) printf({print});
            }}"
        );
        let expected = plans.iter().zip(names).map(|((_, speed), name)| {
            let delay = speed.sync.ticks;
            format!("{name} 1000000 {delay}\n{}", lines(speed))
        });
        assert_eq!(compiled(&folder, &includes.concat(), &body), expected.collect::<String>());
    }
}

#[test]
fn speeds_that_do_not_go_together_are_refused() {
    let with = |changes: &str| {
        let mut plans = speeds("delay = 1; sync_falls = true");
        let curve = "open_end = 1; close_end = 2; timer_hz = 1_000_000; set_up = 'emulated'";
        plans[1].1 = planned(BOX, &format!("{curve}; {changes}"));
        plans
    };
    let refused = |form, plans: &[_]| several(form, "camera", plans, false).unwrap_err();
    for (changes, reason) in [
        ("timer_hz = 999", "timer_hz: 1000000 in 1-500, 999 in box; one list is for one timer"),
        ("", "delay: 1-500 has one and box has none; an array needs all or none"),
        ("delay = 1; sync_falls = false", "sync_falls: 1-500 and box differ; an array is for one edge"),
        (
            "delay = 1; sync_falls = true; set_up = 'in_path'",
            "set_up: 1-500 and box differ; an array is for one set-up",
        ),
        (
            "delay = 1; sync_falls = true; pulse = 0.1",
            "pulses: one of 1-500 and box has them; an array needs all or none",
        ),
    ] {
        assert_eq!([Form::Rust, Form::C].map(|form| refused(form, &with(changes))), [reason; 2]);
    }
    // A row tells no rate, and an object does.
    let plans = with("timer_hz = 999");
    assert!(refused(Form::Csv, &plans).starts_with("timer_hz: "));
    assert!(several(Form::Json, "camera", &plans, false).is_ok());
    let mut plans = speeds("");
    plans[1].0 = "Slow-Speed".into();
    let reason = "Slow-Speed and slow speed would both be called slow_speed";
    assert_eq!(refused(Form::C, &plans), reason);
}

#[test]
fn speeds_are_rows_and_objects() {
    let plans = speeds("delay = 4.247; sync_falls = true");
    let csv = several(Form::Csv, "camera", &plans, false).unwrap();
    assert!(csv.starts_with(&format!("{HEAD}1-500,0,0.125,")), "{csv}");
    assert_eq!(csv.lines().count(), 1 + 4 + 8 + 32);
    let json = several(Form::Json, "camera", &plans, false).unwrap();
    let json: Value = serde_json::from_str(&json).unwrap();
    let scenes: Vec<_> = json.as_array().unwrap().iter().map(|scene| &scene["scene"]).collect();
    assert_eq!(scenes, ["1-500", "box", "slow speed"]);
    assert_eq!((number(&json[0], "delay_s"), number(&json[0], "delay_ticks")), (0.004247, 4247.0));
}

/// What the boards' projects start from, as the program writes it.
#[test]
fn the_modules_of_the_boards_are_those_of_the_measured_scene() {
    let folder = Folder::new("boards");
    folder.write("measured.toml", MEASURED);
    for (board, hz) in [("pico", "125MHz"), ("stm32f4", "100MHz")] {
        let module = format!("{board}.rs");
        folder.run(&format!("plan measured.toml --timer-hz {hz} --emit rust --to {module}")).well();
        let shipped = std::fs::read_to_string(format!("{SCENES}/../../boards/{board}/src/leaf.rs"));
        assert_eq!(folder.text(&module), shipped.unwrap(), "{board}");
    }
}

/// What counts from the edge, in both counts that a timer may have, with a wrap in the frame.
#[test]
fn flashes_are_counted_from_the_edge_in_rust_and_in_c() {
    let folder = Folder::new("edge");
    let all = "unit = 'ms'\nopen_start = 1\ntimer_hz = 1_000_000\nmin_gap = 0\nset_up = 'emulated'\ndelay = 10\n";
    let curve = &format!("{all}open_end = 1\nclose_start = 5\nclose_end = 5\ntriggers = 4\n");
    let times = &format!("{all}trigger_times = [1.5, 2.5, 3.5, 4.5]\n");
    let [mut mods, mut includes, mut rust, mut c] = [const { String::new() }; 4];
    let names = ["even", "lit", "times", "wide"];
    for (name, scene, changes) in [
        ("even", curve, "timer_bits = 16; sync_falls = true"),
        ("lit", curve, "timer_bits = 16; sync_falls = false; pulse = 0.2"),
        ("times", times, "timer_bits = 16; sync_falls = true"),
        ("wide", curve, "sync_falls = false"),
    ] {
        let plan = planned(scene, changes);
        folder.write(&format!("{name}.rs"), text(Form::Rust, name, &plan));
        folder.write(&format!("{name}.h"), text(Form::C, name, &plan));
        mods += &format!("mod {name};\n");
        includes += &format!("#include \"{name}.h\"\n");
        let bits = plan.timer.bits;
        // In a constant, as a firmware may have it.
        rust += &format!(
            "{{
                use {name}::*;
                const LAST: (u{bits}, u{bits}) = on_off(COUNT - 1, 7);
                println!(\"{{}} {{:?}} {{LAST:?}} {{:?}}\", SYNC_FALLS, on_off(0, 7), due(60_000).collect::<Vec<_>>());
            }}\n"
        );
        let upper = name.to_uppercase();
        let due = match name {
            "lit" => "printf(\"(%d, %d), \", (int)lit_due(60000, lit_on[i]), (int)lit_due(60000, lit_off[i]))".into(),
            _ => format!("printf(\"%d, \", (int){name}_due(60000, {name}_ticks[i]))"),
        };
        c += &format!(
            "{{
                uint{bits}_t on, off;
                printf(\"%s\", {upper}_SYNC_FALLS ? \"true\" : \"false\");
                {name}_on_off(0, 7, &on, &off); printf(\" (%d, %d)\", (int)on, (int)off);
                {name}_on_off({upper}_COUNT - 1, 7, &on, &off); printf(\" (%d, %d) [\", (int)on, (int)off);
                for (int i = 0; i < {upper}_COUNT; i++) {due};
                printf(\"]\\n\");
            }}\n"
        );
    }
    is_clean(&folder, "lib.rs", &names, &[]);
    // 60000 + 10000 + 500 is 4964 after the wrap of 16 bits.
    let due = "true (10500, 10507) (13500, 13507) [4964, 5964, 6964, 7964]\n";
    let lit = "false (10400, 10600) (13400, 13600) [(4864, 5064), (5864, 6064), (6864, 7064), (7864, 8064)]\n";
    let wide = "false (10500, 10507) (13500, 13507) [70500, 71500, 72500, 73500]\n";
    let expected = [due, lit, due, wide].concat();
    assert_eq!(ran(&folder, &format!("{mods}fn main() {{\n{rust}}}\n"), &[]), expected);
    assert_eq!(compiled(&folder, &includes, &c).replace(", ]", "]"), expected);
}

/// Nobody's set-up, timer or edge is assumed.
#[test]
fn hardware_gets_nothing_that_nobody_gave() {
    let without = |keys: &str| {
        let plan = planned(MEASURED, keys);
        let forms = [Form::Rust, Form::C, Form::Csv, Form::Json];
        let [reason, others @ ..] = forms.map(|form| emit(form, "leaf", &plan, false).unwrap_err());
        assert!(others.iter().all(|other| *other == reason), "{others:?}");
        let told = several(Form::C, "camera", &[("leaf".to_string(), plan)], false).unwrap_err();
        assert_eq!(told, format!("leaf: {reason}"));
        reason
    };
    let head = "hardware needs what only you know; write it below [flashes], or say --set-up, --timer-hz, --min-gap, \
                --sync-falls:";
    let gap = "\n  min_gap = ...        # what your lamp needs between two flashes; 0 if that is nothing";
    let timer = "\n  timer_hz = ...       # your timer's rate, in Hz";
    let edge = "\n  sync_falls = ...     # true, or false if the delay counts from an edge that rises";
    let set_up = "
  set_up = \"emulated\"  # the camera's own shutter stays open: the first, the middle and the last flash \
         give 100, 100 and 100 %
  set_up = \"in_path\"   # this shutter is in the light's path, and dims them to 43.5, 100 and 51.2 %; all alike
                       # with `duty = 0.5` (a lamp that takes pulses) or `fully_open = true` (xenon)";
    assert_eq!(without("timer_hz"), format!("{head}{timer}"));
    assert_eq!(without("min_gap"), format!("{head}{gap}"));
    assert_eq!(
        without("sync_falls = false # the edge of the camera's sync that triggered the oscilloscope -> "),
        format!("{head}{edge}")
    );
    assert_eq!(without("set_up"), format!("{head}{set_up}"));
    assert_eq!(without("set_up; timer_hz; min_gap"), format!("{head}{set_up}{timer}{gap}"));
    // Nobody is left with the one set-up that is offered.
    let times = planned(crate::refusals::TIMES, "");
    let asked = emit(Form::C, "times", &times, false).unwrap_err();
    assert!(asked.contains("in the light's path it needs a curve"), "{asked}");
}

/// Trigger times without a curve, with a delay, and a speed that has one.
fn measured() -> [(String, Plan); 2] {
    let times = "unit = 'ms'\nopen_start = 1\ntrigger_times = [2.0004, 2.5, 3.1]\nmin_gap = 0.1\n";
    let curve =
        "unit = 'ms'\nopen_start = 0\nopen_end = 1\nclose_start = 4\nclose_end = 5\ntriggers = 4\nmin_gap = 0\n";
    [("bounce", times, "4.247"), ("good", curve, "4")].map(|(name, scene, delay)| {
        let changes = format!("timer_hz = 1_000_000; set_up = 'emulated'; delay = {delay}");
        (name.into(), planned(scene, &format!("{changes}; sync_falls = true")))
    })
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
    let [json, beside] =
        [times, curve].map(|plan| serde_json::from_str::<Value>(&text(Form::Json, "bounce", plan)).unwrap());
    let first = &json["triggers"][0];
    assert_eq!((number(first, "time_s"), number(first, "from_edge_ticks")), (0.0020004, 5247.0));
    assert_eq!(keys(&json), keys(&beside));
    assert_eq!(keys(first), HEAD.trim().split(',').skip(1).collect::<Vec<_>>());
    assert!(json["exposure_s"].is_null() && first["u"].is_null());
    let csv = several(Form::Csv, "camera", &speeds, false).unwrap();
    assert!(csv.starts_with(&format!("{HEAD}{rows}good,0,0.125,")), "{csv}");
}

/// A row of CSV, or a trigger of JSON.
#[derive(Debug, Deserialize)]
struct Row {
    index: usize,
    u: f32,
    time_s: f64,
    ticks: u32,
    gap_ticks: Option<u32>,
    from_edge_ticks: Option<u32>,
    on_ticks: Option<u32>,
    off_ticks: Option<u32>,
}

#[derive(Deserialize)]
struct Document {
    scene: String,
    timer_hz: u32,
    delay_s: Option<f64>,
    delay_ticks: Option<u32>,
    opening_s: f32,
    half_open_s: f32,
    exposure_s: f32,
    efficiency: f32,
    direct_triggers: u32,
    delta_ev: Option<f32>,
    triggers: Vec<Row>,
}

/// Both hold the numbers of the plan.
fn csv_and_json_are_right(name: &str, planned: &Plan) {
    let plan = planned;
    let csv = text(Form::Csv, name, planned);
    let rows = csv::Reader::from_reader(csv.as_bytes()).into_deserialize().map(Result::unwrap);
    let json: Document = serde_json::from_str(&text(Form::Json, name, planned)).unwrap();
    for rows in [rows.collect::<Vec<Row>>(), json.triggers] {
        assert_eq!(rows.len(), plan.triggers.len(), "{name}");
        for (i, (row, trigger)) in rows.iter().zip(&plan.triggers).enumerate() {
            let pulse = row.on_ticks.zip(row.off_ticks);
            let read = Trigger { u: Some(row.u), time: f64::from(row.time_s as f32), ticks: row.ticks, pulse };
            let edge = plan.sync.delay.map(|_| plan.sync.ticks + row.ticks);
            assert_eq!((row.index, read, row.from_edge_ticks), (i, *trigger, edge), "{name}");
        }
        let gaps = rows.iter().map(|row| row.gap_ticks);
        assert!(gaps.eq([None].into_iter().chain(plan.gaps().map(Some))), "{name}");
    }
    assert_eq!((json.scene.as_str(), json.timer_hz), (name, plan.timer.hz));
    assert_eq!(json.exposure_s, curve_of(plan).exposure());
    assert_eq!(json.efficiency, curve_of(plan).efficiency());
    assert!(json.opening_s >= 0.0 && json.half_open_s > 0.0);
    assert_eq!(json.direct_triggers, curve_of(plan).direct_triggers());
    let delay = plan.sync.delay.map(|delay| (delay.seconds, plan.sync.ticks));
    assert_eq!(json.delay_s.zip(json.delay_ticks), delay);
    assert_eq!(json.delta_ev.is_some(), plan.scene.shutter.nominal.is_some());
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
    for words in
        ["\n * scene        *_ _#error _\"\\\n", "\n#ifndef ERROR_SCHEDULE_H\n", " error_ticks[ERROR_COUNT] = {"]
    {
        assert!(c.contains(words), "{c}");
    }
    let json: Value = serde_json::from_str(&text(Form::Json, name, &plan)).unwrap();
    assert_eq!(json["scene"], name);
}
