//! Each form that a plan is emitted in, of each scene that ships: it compiles or parses as it stands, and holds the crate's
//! ticks and the numbers of the plan to the bit.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use std::{env, fs};

use serde::Deserialize;
use shutter::emit::Form;
use shutter::plan::{Plan, Trigger};
use shutter::planned::Planned;

/// The plan in a form that takes any.
fn emit(form: Form, name: &str, plan: &Plan) -> String {
    shutter::emit::emit(form, name, &plan.clone().into(), false).unwrap()
}

fn with_curve(name: &str, plan: &Plan) -> String {
    shutter::emit::emit(Form::Rust, name, &plan.clone().into(), true).unwrap()
}

fn several(form: Form, name: &str, plans: &[(String, Plan)]) -> Result<String, String> {
    let plans: Vec<_> =
        plans.iter().map(|(name, plan)| (name.clone(), plan.clone().into())).collect();
    shutter::emit::several(form, name, &plans, false)
}

const CLI: &str = env!("CARGO_MANIFEST_DIR");

/// The scenes that ship, by their names.
fn plans() -> Vec<(String, Plan)> {
    let scenes = fs::read_dir(format!("{CLI}/scenes")).unwrap().map(|f| f.unwrap().path());
    let plan = |path: PathBuf| {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let plan = Plan::parse(&fs::read_to_string(&path).unwrap()).expect(&name);
        (name, plan)
    };
    let mut plans: Vec<_> = scenes.map(plan).collect();
    plans.sort_by(|a, b| a.0.cmp(&b.0));
    // Straight ramps and others; both kinds of pulses and none.
    assert!(plans.len() >= 8);
    assert!(plans.iter().filter(|(_, plan)| plan.triggers[0].pulse.is_some()).count() >= 2);
    plans
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("emit").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// What a command prints that has to succeed.
fn output(command: &mut Command) -> String {
    let output = command.output().expect("the command is there");
    let err = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && err.is_empty(), "{command:?}\n{err}");
    String::from_utf8(output.stdout).unwrap()
}

/// A trigger or a pulse, as the test programs print it.
fn line(trigger: &Trigger) -> String {
    match trigger.pulse {
        Some((on, off)) => format!("{on} {off}\n"),
        None => format!("{}\n", trigger.ticks),
    }
}

/// Runs the compiler in a folder, without a warning.
fn rustc(folder: &Path, args: &[&str]) {
    compile(env::var_os("RUSTC").unwrap_or("rustc".into()).as_ref(), folder, args);
}

fn compile(compiler: &Path, folder: &Path, args: &[&str]) {
    let mut rustc = Command::new(compiler);
    output(rustc.args(["--edition", "2024", "--out-dir", "."]).args(args).current_dir(folder));
}

/// Compiles a file of modules as a library, with all that Clippy could say, and checks how they are written.
fn is_clean(folder: &Path, file: &str, linked: &[&str]) {
    let args = ["--crate-type", "lib", "-D", "missing_docs", "-D", "clippy::pedantic", file];
    compile("clippy-driver".as_ref(), folder, &[&["-D", "warnings"], linked, &args].concat());
    let mut rustfmt = Command::new("rustfmt");
    let with_defaults =
        ["--check", "--edition", "2024", "--config", "use_small_heuristics=Default"];
    output(rustfmt.args(with_defaults).arg(file).current_dir(folder));
}

/// The crate by itself, which has no dependencies, built once; as an argument of the compiler.
fn the_crate() -> &'static str {
    static BUILT: OnceLock<String> = OnceLock::new();
    BUILT.get_or_init(|| {
        let (folder, source) = (folder("crate"), format!("{CLI}/../src/lib.rs"));
        rustc(&folder, &["--crate-type", "rlib", "--crate-name", "shutter_curve", &source]);
        format!("shutter_curve={}", folder.join("libshutter_curve.rlib").display())
    })
}

/// Without the crate as it is emitted; with its curve, it holds the crate's ticks.
#[test]
fn rust_compiles_alone_and_holds_the_ticks_of_the_crate() {
    let folder = folder("rust");
    // A library that asks for documentation takes the modules as well.
    let [mut alone, mut curves] = ["//! .\n#![no_std]\n"; 2].map(String::from);
    let (mut main, mut expected) = (String::new(), String::new());
    for (name, plan) in plans() {
        let module = format!("scene_{}", name.replace('-', "_"));
        let curve = with_curve(&name, &plan);
        let text = emit(Form::Rust, &name, &plan);
        assert!(!text.contains("shutter_curve") && curve.starts_with(&text), "{text}");
        let pulses = text.contains("PULSES");
        assert_eq!(
            (pulses, text.contains("TICKS: [")),
            (plan.triggers[0].pulse.is_some(), !pulses)
        );
        fs::write(folder.join(format!("{module}.rs")), text).unwrap();
        fs::write(folder.join(format!("{module}_curve.rs")), curve).unwrap();
        alone += &format!("/// .\npub mod {module};\n");
        curves += &format!("/// .\npub mod {module}_curve;\n");
        main += &format!("{{ use alone::{module} as scene; use curves::{module}_curve as curve;\n");
        main += match pulses {
            true => "assert_eq!(scene::PULSES, curve::PULSES); for (on, off) in scene::PULSES { println!(\"{on} {off}\"); }",
            false => "assert!(curve::SHUTTER.trigger_ticks(curve::COUNT as u32, curve::TIMER_HZ).unwrap().eq(scene::TICKS));
                for tick in scene::TICKS { println!(\"{tick}\"); }",
        };
        if let shutter::lamp::Lamp::Doses { duty } = plan.lamp {
            main += &format!(
                "let pulses = curve::SHUTTER.pulse_ticks(curve::COUNT as u32, {duty:?}, curve::TIMER_HZ).unwrap();
                assert!(pulses.map(|pulse| (pulse.on, pulse.off)).eq(scene::PULSES));"
            );
        }
        main += "println!(\"{:08x}\", curve::SHUTTER.exposure().to_bits()); }\n";
        expected.extend(plan.triggers.iter().map(line));
        expected += &format!("{:08x}\n", plan.curve.exposure().to_bits());
    }
    fs::write(folder.join("alone.rs"), alone).unwrap();
    fs::write(folder.join("curves.rs"), curves).unwrap();
    let linked = ["--extern", the_crate()];
    is_clean(&folder, "alone.rs", &[]);
    is_clean(&folder, "curves.rs", &linked);
    fs::write(folder.join("main.rs"), format!("fn main() {{\n{main}}}\n")).unwrap();
    let libraries = ["--extern", "alone=libalone.rlib", "--extern", "curves=libcurves.rlib"];
    rustc(&folder, &[&libraries[..], &["-L", "../crate", "-D", "warnings", "main.rs"]].concat());
    assert_eq!(output(&mut Command::new(folder.join("main"))), expected);
}

#[test]
fn speeds_are_an_array_of_rust_and_nothing_unused_is_warned_of() {
    let folder = folder("rust_speeds");
    let (late, lit) = (speeds("delay = 4.247\nsync_falls = true\n"), speeds("duty = 0.3\n"));
    let write = |file: &str, text: String| fs::write(folder.join(file), text).unwrap();
    write("late.rs", several(Form::Rust, "late", &late).unwrap());
    let planned: Vec<_> =
        lit.iter().map(|(name, plan)| (name.clone(), plan.clone().into())).collect();
    write("lit.rs", shutter::emit::several(Form::Rust, "lit", &planned, true).unwrap());
    let one = emit(Form::Rust, "one", &late[0].1);
    assert!(one.starts_with(concat!(
        "// Made by `shutter plan` ",
        env!("CARGO_PKG_VERSION"),
        ".\n"
    )));
    write("one.rs", one);
    write("lib.rs", "//! .\n#![no_std]\n/// .\npub mod late;\n/// .\npub mod lit;\n".into());
    is_clean(&folder, "lib.rs", &["--extern", the_crate()]);
    // Private modules of which next to nothing is used.
    let main = r#"mod late; mod lit; mod one;
        fn main() {
            println!("{} {}", late::box_::DELAY_TICKS, late::shutter_1_500::COUNT);
            for speed in &late::SPEEDS { println!("{} {} {:?}", speed.name, speed.delay_ticks, speed.ticks); }
            for speed in &lit::SPEEDS {
                let pulses = speed.shutter.pulse_ticks(u32::try_from(speed.pulses.len()).unwrap(), 0.3, lit::TIMER_HZ).unwrap();
                assert!(pulses.map(|pulse| (pulse.on, pulse.off)).eq(speed.pulses.iter().copied()));
            }
        }"#;
    write("main.rs", main.into());
    rustc(&folder, &["-D", "warnings", "--extern", the_crate(), "main.rs"]);
    let mut expected = String::from("4247 4\n");
    for (name, plan) in &late {
        let ticks: Vec<_> = plan.triggers.iter().map(|trigger| trigger.ticks).collect();
        expected += &format!("{name} 4247 {ticks:?}\n");
    }
    assert_eq!(output(&mut Command::new(folder.join("main"))), expected);
}

/// A program by both compilers, without a warning; what it prints, by either.
fn compiled(folder: &Path, source: &str) -> String {
    let mut printed = Vec::new();
    for (variable, compiler, standard, file) in
        [("CC", "cc", "-std=c99", "main.c"), ("CXX", "c++", "-std=c++11", "main.cpp")]
    {
        fs::write(folder.join(file), source).unwrap();
        let program = folder.join("main");
        let compiler = env::var(variable).unwrap_or(compiler.into());
        let is_there = Command::new(&compiler).arg("--version").output().is_ok();
        assert!(
            is_there,
            "no compiler {compiler}: this test compiles headers with $CC, or cc, and $CXX, or c++"
        );
        let mut compile = Command::new(compiler);
        compile.args([standard, "-pedantic", "-Wall", "-Wextra", "-Werror", "-o"]);
        output(compile.arg(&program).arg(folder.join(file)));
        printed.push(output(&mut Command::new(&program)));
    }
    assert_eq!(printed[0], printed[1]);
    printed.remove(0)
}

/// C's statements that print the ticks of such a name, as [`line`] does.
fn print_c(lower: &str, upper: &str, has_pulses: bool) -> String {
    let print = match has_pulses {
        true => {
            format!("\"%lu %lu\\n\", (unsigned long){lower}_on[i], (unsigned long){lower}_off[i]")
        }
        false => format!("\"%lu\\n\", (unsigned long){lower}_ticks[i]"),
    };
    format!(
        "printf(\"%lu\\n\", (unsigned long){upper}_TIMER_HZ);
        for (unsigned i = 0; i < {upper}_COUNT; i++) printf({print});\n"
    )
}

/// All scenes that ship in one file, each header twice, as headers come.
#[test]
fn c_compiles_in_one_file_and_holds_the_same_ticks() {
    let folder = folder("c");
    let (mut includes, mut body, mut expected) = (String::new(), String::new(), String::new());
    let plans = plans();
    for (name, plan) in &plans {
        fs::write(folder.join(format!("{name}.h")), emit(Form::C, name, plan)).unwrap();
        includes += &format!("#include \"{name}.h\"\n").repeat(2);
        let lower = name.replace('-', "_");
        let upper = lower.to_ascii_uppercase();
        body += &print_c(&lower, &upper, plan.triggers[0].pulse.is_some());
        let lines: String = plan.triggers.iter().map(line).collect();
        expected += &format!("{}\n{lines}", plan.timer.hz);
        if let Some(delay) = plan.delay {
            body += &format!(
                "printf(\"%lu %d\\n\", (unsigned long){upper}_DELAY_TICKS, {upper}_SYNC_FALLS);\n"
            );
            expected += &format!("{} {}\n", delay.ticks, u8::from(delay.falls.unwrap()));
        }
    }
    assert!(plans.iter().any(|(_, plan)| plan.delay.is_some()));
    let main = format!("{includes}#include <stdio.h>\nint main(void) {{\n{body}return 0;\n}}\n");
    assert_eq!(compiled(&folder, &main), expected);
}

/// A header of the same name with other ticks would be left out in silence.
#[test]
fn two_different_headers_of_one_name_do_not_compile() {
    let folder = folder("twice");
    let text = include_str!("../scenes/box.toml");
    let other = text.replace("triggers = 10", "triggers = 11");
    assert_ne!(text, other);
    for (file, text) in [("a.h", text), ("b.h", &other)] {
        fs::write(folder.join(file), emit(Form::C, "box", &Plan::parse(text).unwrap())).unwrap();
    }
    fs::write(folder.join("main.c"), "#include \"a.h\"\n#include \"b.h\"\n").unwrap();
    let compile =
        Command::new("cc").arg("-fsyntax-only").arg(folder.join("main.c")).output().unwrap();
    let err = String::from_utf8_lossy(&compile.stderr);
    assert!(
        !compile.status.success() && err.contains("two different schedules are called box"),
        "{err}"
    );
}

/// The speeds of a shutter: three exposures of the same leaves, on one timer.
fn speeds(lines: &str) -> Vec<(String, Plan)> {
    let set_up = if lines.contains("duty") { "in_path" } else { "emulated" };
    [("1-500", 2.0), ("box", 4.0), ("slow speed", 16.0)]
        .map(|(name, length)| {
            let text = format!(
                "unit = 'ms'\nopen_start = 0\nopen_end = 0.5\nclose_start = {}\nclose_end = {}\n\
                 triggers = {}\ntimer_hz = 1_000_000\nmin_gap = 0\nset_up = '{set_up}'\n{lines}",
                length - 0.5,
                length,
                2.0 * length
            );
            (name.to_string(), Plan::parse(&text).unwrap())
        })
        .into()
}

#[test]
fn speeds_are_an_array_of_c() {
    for (folder_name, keys, pulses) in
        [("speeds", "delay = 4.247\nsync_falls = true\n", false), ("lit", "duty = 0.3\n", true)]
    {
        let folder = folder(folder_name);
        let plans = speeds(keys);
        fs::write(folder.join("camera.h"), several(Form::C, "camera", &plans).unwrap()).unwrap();
        // The same scene by itself is the same text.
        let (name, plan) = &plans[2];
        fs::write(folder.join("slow.h"), emit(Form::C, name, plan)).unwrap();
        let delay = if pulses { "0" } else { "camera_speeds[s].delay_ticks" };
        let print = match pulses {
            true => {
                "\"%lu %lu\\n\", (unsigned long)camera_speeds[s].on[i], (unsigned long)camera_speeds[s].off[i]"
            }
            false => "\"%lu\\n\", (unsigned long)camera_speeds[s].ticks[i]",
        };
        let main = format!(
            "#include \"camera.h\"\n#include \"slow.h\"\n#include \"camera.h\"\n#include <stdio.h>
            int main(void) {{
                for (unsigned s = 0; s < CAMERA_SPEEDS; s++) {{
                    printf(\"%s %lu %lu\\n\", camera_speeds[s].name, (unsigned long)CAMERA_TIMER_HZ, (unsigned long){delay});
                    for (unsigned i = 0; i < camera_speeds[s].count; i++) printf({print});
                }}
                return 0;
            }}"
        );
        let names = ["shutter_1_500", "box", "slow_speed"];
        let expected = plans.iter().zip(names).map(|((_, plan), name)| {
            let lines: String = plan.triggers.iter().map(line).collect();
            format!("{name} 1000000 {}\n{lines}", plan.delay.map_or(0, |delay| delay.ticks))
        });
        assert_eq!(compiled(&folder, &main), expected.collect::<String>());
    }
}

#[test]
fn speeds_that_do_not_go_together_are_refused() {
    let both = |other: &str| {
        let mut plans = speeds("delay = 1\nsync_falls = true\n");
        plans[1].1 = Plan::parse(other).unwrap();
        [Form::Rust, Form::C].map(|form| several(form, "camera", &plans).unwrap_err())
    };
    let one =
        "open_start = 0\nopen_end = 1\nclose_start = 1\nclose_end = 2\ntriggers = 4\nmin_gap = 0\n";
    for (lines, reason) in [
        (
            "timer_hz = 999\nset_up = 'emulated'",
            "timer_hz: 1000000 in 1-500, 999 in box; one list is for one timer",
        ),
        (
            "timer_hz = 1_000_000\nset_up = 'emulated'",
            "delay: 1-500 has one and box has none; an array needs all or none",
        ),
        (
            "timer_hz = 1_000_000\ndelay = 1\nsync_falls = false\nset_up = 'emulated'",
            "sync_falls: 1-500 and box differ; an array is for one edge",
        ),
        (
            "timer_hz = 1_000_000\ndelay = 1\nsync_falls = true\nset_up = 'in_path'",
            "set_up: 1-500 and box differ; an array is for one set-up",
        ),
        (
            "timer_hz = 1_000_000\ndelay = 1\nsync_falls = true\nset_up = 'emulated'\npulse = 0.1",
            "pulses: one of 1-500 and box has them; an array needs all or none",
        ),
    ] {
        assert_eq!(both(&format!("{one}{lines}")), [reason, reason]);
    }
    let mut plans = speeds("");
    plans[1].1 = Plan::parse(&format!("{one}timer_hz = 999\nset_up = 'emulated'")).unwrap();
    // A row tells no rate, and an object does.
    assert!(several(Form::Csv, "camera", &plans).unwrap_err().starts_with("timer_hz: "));
    assert!(several(Form::Json, "camera", &plans).is_ok());
    let mut plans = speeds("");
    plans[1].0 = "Slow-Speed".into();
    let reason = several(Form::C, "camera", &plans).unwrap_err();
    assert_eq!(reason, "Slow-Speed and slow speed would both be called slow_speed");
}

#[test]
fn speeds_are_rows_and_objects() {
    let plans = speeds("delay = 4.247\nsync_falls = true\n");
    let csv = several(Form::Csv, "camera", &plans).unwrap();
    assert!(
        csv.starts_with("scene,index,u,time_s,ticks,gap_ticks,from_edge_ticks,on_ticks,off_ticks,dose\n1-500,0,0.125,"),
        "{csv}"
    );
    assert_eq!(csv.lines().count(), 1 + 4 + 8 + 32);
    let json: serde_json::Value =
        serde_json::from_str(&several(Form::Json, "camera", &plans).unwrap()).unwrap();
    let scenes: Vec<_> = json.as_array().unwrap().iter().map(|scene| &scene["scene"]).collect();
    assert_eq!(scenes, ["1-500", "box", "slow speed"]);
    assert_eq!((&json[0]["delay_s"], &json[0]["delay_ticks"]), (&0.004247.into(), &4247.into()));
}

/// What the boards' projects start from, as the program writes it.
#[test]
fn the_modules_of_the_boards_are_those_of_the_measured_scene() {
    for (board, hz) in [("pico", "125MHz"), ("stm32f4", "100MHz")] {
        let module = folder(board).join("leaf.rs");
        let scene = format!("{CLI}/scenes/measured.toml");
        let mut program = Command::new(env!("CARGO_BIN_EXE_shutter"));
        program.args(["plan", &scene, "--timer-hz", hz, "--emit", "rust", "--to"]).arg(&module);
        assert!(program.output().unwrap().status.success(), "{board}");
        let shipped = format!("{CLI}/../boards/{board}/src/leaf.rs");
        let [made, shipped] =
            [module, shipped.into()].map(|file| fs::read_to_string(file).unwrap());
        assert_eq!(made, shipped, "{board}");
    }
}

/// What counts from the edge, in both counts that a timer may have, with a wrap in the frame.
#[test]
fn flashes_are_counted_from_the_edge_in_rust_and_in_c() {
    let folder = folder("edge");
    let curve = "unit = 'ms'\nopen_start = 1\ntimer_hz = 1_000_000\nmin_gap = 0\nset_up = 'emulated'\ndelay = 10\nopen_end = 1\nclose_start = 5\n\
                 close_end = 5\ntriggers = 4\n";
    let times = "unit = 'ms'\nopen_start = 1\ntimer_hz = 1_000_000\nmin_gap = 0\nset_up = 'emulated'\ndelay = 10\ntrigger_times = [1.5, 2.5, 3.5, 4.5]\n";
    let [mut mods, mut includes, mut rust, mut c] = [const { String::new() }; 4];
    for (name, text) in [
        ("even", format!("{curve}timer_bits = 16\nsync_falls = true\n")),
        ("lit", format!("{curve}timer_bits = 16\nsync_falls = false\npulse = 0.2\n")),
        ("times", format!("{times}timer_bits = 16\nsync_falls = true\n")),
        ("wide", format!("{curve}sync_falls = false\n")),
    ] {
        let plan = Planned::parse(&text).unwrap();
        let [module, header] = [Form::Rust, Form::C]
            .map(|form| shutter::emit::emit(form, name, &plan, false).unwrap());
        fs::write(folder.join(format!("{name}.rs")), module).unwrap();
        fs::write(folder.join(format!("{name}.h")), header).unwrap();
        mods += &format!("/// .\npub mod {name};\n");
        includes += &format!("#include \"{name}.h\"\n");
        rust += &format!(
            "{{
                use {name}::*;
                // In a constant, as a firmware may have it.
                const LAST: ({0}, {0}) = on_off(COUNT - 1, 7);
                println!(\"{{}} {{:?}} {{LAST:?}} {{:?}}\", SYNC_FALLS, on_off(0, 7), due(60_000).collect::<Vec<_>>());
            }}\n",
            if name == "wide" { "u32" } else { "u16" }
        );
        let upper = name.to_uppercase();
        let due = match name {
            "lit" => "printf(\"(%d, %d), \", (int)lit_due(60000, lit_on[i]), (int)lit_due(60000, lit_off[i]))".into(),
            _ => format!("printf(\"%d, \", (int){name}_due(60000, {name}_ticks[i]))"),
        };
        let int = if name == "wide" { "uint32_t" } else { "uint16_t" };
        c += &format!(
            "{{
                {int} on, off;
                printf(\"%s\", {upper}_SYNC_FALLS ? \"true\" : \"false\");
                {name}_on_off(0, 7, &on, &off); printf(\" (%d, %d)\", (int)on, (int)off);
                {name}_on_off({upper}_COUNT - 1, 7, &on, &off); printf(\" (%d, %d) [\", (int)on, (int)off);
                for (int i = 0; i < {upper}_COUNT; i++) {due};
                printf(\"]\\n\");
            }}\n"
        );
    }
    fs::write(folder.join("lib.rs"), format!("//! .\n#![no_std]\n{mods}")).unwrap();
    is_clean(&folder, "lib.rs", &[]);
    fs::write(folder.join("main.rs"), format!("{mods}fn main() {{\n{rust}}}\n")).unwrap();
    rustc(&folder, &["main.rs"]);
    // 60000 + 10000 + 500 is 4964 after the wrap of 16 bits.
    let due = "true (10500, 10507) (13500, 13507) [4964, 5964, 6964, 7964]\n";
    let lit = "false (10400, 10600) (13400, 13600) [(4864, 5064), (5864, 6064), (6864, 7064), (7864, 8064)]\n";
    let wide = "false (10500, 10507) (13500, 13507) [70500, 71500, 72500, 73500]\n";
    let expected = [due, lit, due, wide].concat();
    assert_eq!(output(&mut Command::new(folder.join("main"))), expected);
    let main = format!("{includes}#include <stdio.h>\nint main(void) {{\n{c}return 0;\n}}\n");
    assert_eq!(compiled(&folder, &main).replace(", ]", "]"), expected);
}

/// Nobody's set-up, timer or edge is assumed.
#[test]
fn hardware_gets_nothing_that_nobody_gave() {
    let text = include_str!("../scenes/measured.toml");
    let without = |keys: &[&str]| {
        let kept = text.lines().filter(|line| !keys.iter().any(|key| line.starts_with(key)));
        let plan =
            Planned::parse(&kept.map(|line| format!("{line}\n")).collect::<String>()).unwrap();
        let forms = [Form::Rust, Form::C, Form::Csv, Form::Json];
        let [reason, others @ ..] =
            forms.map(|form| shutter::emit::emit(form, "leaf", &plan, false).unwrap_err());
        assert!(others.iter().all(|other| *other == reason), "{others:?}");
        let several = [("leaf".to_string(), plan)];
        let told = shutter::emit::several(Form::C, "camera", &several, false).unwrap_err();
        assert_eq!(told, format!("leaf: {reason}"));
        reason
    };
    let head = "hardware needs what only you know; write it into the scene, or say --set-up, --timer-hz, --sync-falls:";
    let timer = "\n  timer_hz = ...       # your timer's rate, in Hz";
    let edge =
        "\n  sync_falls = ...     # true, or false if the delay counts from an edge that rises";
    let set_up = "
  set_up = \"emulated\"  # the camera's own shutter stays open: the first, the middle and the last flash give 100, 100 and 100 %
  set_up = \"in_path\"   # this shutter is in the light's path, and dims them to 43.5, 100 and 51.2 %; all alike
                       # with `duty = 0.5` (a lamp that takes pulses) or `fully_open = true` (xenon)";
    assert_eq!(without(&["timer_hz"]), format!("{head}{timer}"));
    assert_eq!(without(&["sync_falls"]), format!("{head}{edge}"));
    assert_eq!(without(&["set_up"]), format!("{head}{set_up}"));
    let all = ["set_up", "timer_hz", "sync_falls"];
    assert_eq!(without(&all), format!("{head}{set_up}{timer}{edge}"));
}

/// Trigger times without a curve, with a delay, and a speed that has one.
fn measured() -> (Planned, Planned) {
    let times = "unit = 'ms'\nopen_start = 1\ntrigger_times = [2.0004, 2.5, 3.1]\ntimer_hz = 1_000_000\nmin_gap = 0.1\n\
                 set_up = 'emulated'\ndelay = 4.247\nsync_falls = true\n";
    let curve = "unit = 'ms'\nopen_start = 0\nopen_end = 1\nclose_start = 4\nclose_end = 5\ntriggers = 4\n\
                 timer_hz = 1_000_000\nmin_gap = 0\nset_up = 'emulated'\ndelay = 4\nsync_falls = true\n";
    (Planned::parse(times).unwrap(), Planned::parse(curve).unwrap())
}

#[test]
fn times_without_a_curve_stand_beside_a_curve() {
    let folder = folder("times");
    let (times, curve) = measured();
    for form in [Form::Rust, Form::C] {
        let alone = shutter::emit::emit(form, "bounce", &times, false).unwrap();
        assert!(alone.contains("no curve: trigger times as measured"), "{alone}");
    }
    let none = shutter::emit::emit(Form::Rust, "bounce", &times, true).unwrap_err();
    assert!(none.contains("and no curve"), "{none}");
    let speeds = [("bounce".to_string(), times), ("good".to_string(), curve)];
    for (form, file) in [(Form::Rust, "camera.rs"), (Form::C, "camera.h")] {
        let both = shutter::emit::several(form, "camera", &speeds, false).unwrap();
        fs::write(folder.join(file), both).unwrap();
    }
    let main = "mod camera; fn main() { for speed in &camera::SPEEDS { println!(\"{} {:?}\", speed.delay_ticks, speed.ticks); } }";
    fs::write(folder.join("main.rs"), main).unwrap();
    rustc(&folder, &["-D", "warnings", "main.rs"]);
    let expected = "4247 [1000, 1500, 2100]\n4000 [1000, 2000, 3000, 4000]\n";
    assert_eq!(output(&mut Command::new(folder.join("main"))), expected);
    let main = "#include \"camera.h\"\n#include <stdio.h>\nint main(void) {
        for (unsigned s = 0; s < CAMERA_SPEEDS; s++) {
            printf(\"%d [\", (int)camera_speeds[s].delay_ticks);
            for (unsigned i = 0; i < camera_speeds[s].count; i++) printf(\"%d, \", (int)camera_speeds[s].ticks[i]);
            printf(\"]\\n\");
        }
        return 0; }";
    assert_eq!(compiled(&folder, main).replace(", ]", "]"), expected);
}

#[test]
fn times_without_a_curve_are_rows_and_objects() {
    let (times, curve) = measured();
    let csv = shutter::emit::emit(Form::Csv, "bounce", &times, false).unwrap();
    let rows = "scene,index,u,time_s,ticks,gap_ticks,from_edge_ticks,on_ticks,off_ticks,dose\n\
                bounce,0,,0.0020004,1000,,5247,,,\nbounce,1,,0.0025,1500,500,5747,,,\n\
                bounce,2,,0.0031,2100,600,6347,,,\n";
    assert_eq!(csv, rows);
    let json = shutter::emit::emit(Form::Json, "bounce", &times, false).unwrap();
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    let first = &json["triggers"][0];
    assert_eq!((&first["time_s"], &first["from_edge_ticks"]), (&0.0020004.into(), &5247.into()));
    // All forms have the same keys.
    let beside = shutter::emit::emit(Form::Json, "good", &curve, false).unwrap();
    let beside: serde_json::Value = serde_json::from_str(&beside).unwrap();
    let keys =
        |json: &serde_json::Value| json.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    assert_eq!(keys(&json), keys(&beside));
    let names: Vec<_> = csv.lines().next().unwrap().split(',').skip(1).collect();
    assert_eq!(keys(first), names);
    assert_eq!(
        (&json["exposure_s"], &first["u"]),
        (&serde_json::Value::Null, &serde_json::Value::Null)
    );
    let speeds = [("bounce".to_string(), times), ("good".to_string(), curve)];
    let csv = shutter::emit::several(Form::Csv, "camera", &speeds, false).unwrap();
    assert!(csv.contains("\nbounce,0,,0.0020004,1000,,5247,,,\n"), "{csv}");
    assert!(csv.contains("\ngood,0,0.125,"), "{csv}");
}

/// A row of CSV, or a trigger of JSON.
#[derive(Debug, Deserialize)]
struct Row {
    index: usize,
    u: f32,
    time_s: f32,
    ticks: u32,
    gap_ticks: Option<u32>,
    from_edge_ticks: Option<u32>,
    on_ticks: Option<u32>,
    off_ticks: Option<u32>,
}

fn assert_same(name: &str, plan: &Plan, rows: &[Row]) {
    assert_eq!(rows.len(), plan.triggers.len(), "{name}");
    for (i, (row, trigger)) in rows.iter().zip(&plan.triggers).enumerate() {
        let pulse = row.on_ticks.zip(row.off_ticks);
        let read = Trigger { u: row.u, time: row.time_s, ticks: row.ticks, pulse };
        assert_eq!(row.from_edge_ticks, plan.delay.map(|delay| delay.ticks + row.ticks), "{name}");
        assert_eq!((row.index, read), (i, *trigger), "{name}");
    }
}

#[test]
fn csv_parses_and_holds_the_same_numbers() {
    for (name, plan) in plans() {
        let text = emit(Form::Csv, &name, &plan);
        let reader = csv::Reader::from_reader(text.as_bytes());
        let rows: Vec<Row> = reader.into_deserialize().map(Result::unwrap).collect();
        assert_same(&name, &plan, &rows);
        let gaps = rows.iter().map(|row| row.gap_ticks);
        assert!(gaps.eq([None].into_iter().chain(plan.gaps().map(Some))), "{name}");
    }
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

#[test]
fn json_parses_and_holds_the_same_numbers() {
    for (name, plan) in plans() {
        let document: Document = serde_json::from_str(&emit(Form::Json, &name, &plan)).unwrap();
        assert_eq!((document.scene, document.timer_hz), (name.clone(), plan.timer.hz));
        assert_eq!(document.exposure_s, plan.curve.exposure());
        assert_eq!(document.efficiency, plan.curve.efficiency());
        assert!(document.opening_s >= 0.0 && document.half_open_s > 0.0);
        assert_eq!(document.direct_triggers, plan.curve.direct_triggers());
        let delay = document.delay_s.zip(document.delay_ticks);
        assert_eq!(delay, plan.delay.map(|delay| (delay.seconds, delay.ticks)));
        assert_eq!(document.delta_ev.is_some(), plan.nominal.is_some());
        assert_same(&name, &plan, &document.triggers);
    }
}

/// A name comes from a file, and files have names of any kind.
#[test]
fn no_name_breaks_a_form() {
    let plan = Plan::parse(include_str!("../scenes/box.toml")).unwrap();
    let name = "*/ \n#error \u{202e}\"\\";
    let [rust, c] = [Form::Rust, Form::C].map(|form| emit(form, name, &plan));
    assert!(rust.contains("\n// scene        *_ _#error _\"\\\n"), "{rust}");
    assert!(c.contains("\n * scene        *_ _#error _\"\\\n"), "{c}");
    assert!(
        c.contains("\n#ifndef ERROR_SCHEDULE_H\n") && c.contains(" error_ticks[ERROR_COUNT] = {"),
        "{c}"
    );
    let json: serde_json::Value = serde_json::from_str(&emit(Form::Json, name, &plan)).unwrap();
    assert_eq!(json["scene"], name);
}

/// Numbers at both ends of what a scene may hold come back as they were.
#[test]
fn great_and_small_numbers_round_trip() {
    for (factor, timer_hz) in [(1e-18, u32::MAX), (1e-7, u32::MAX), (7e8, 1)] {
        let text = format!(
            "open_start = -{factor:e}\nopen_end = {factor:e}\nclose_start = {factor:e}\nclose_end = {:e}\n\
             triggers = 1\ntimer_hz = {timer_hz}\nmin_gap = 0\nset_up = 'emulated'\n",
            1.7 * factor
        );
        let plan = Plan::parse(&text).expect(&text);
        let csv = emit(Form::Csv, "x", &plan);
        let rows: Vec<Row> = csv::Reader::from_reader(csv.as_bytes())
            .into_deserialize()
            .map(Result::unwrap)
            .collect();
        assert_same("csv", &plan, &rows);
        let json: Document = serde_json::from_str(&emit(Form::Json, "x", &plan)).unwrap();
        assert_same("json", &plan, &json.triggers);
        let times = numbers(&with_curve("x", &plan), "linear(", ')');
        assert_eq!(times, plan.shape.times);
    }
    // Numbers with all the digits that they have.
    let plan = Plan::parse(
        "open_start = 1e-9\nopen_end = 0.002512345678\nclose_start = 0.00751234567\nclose_end = 0.0101234567\n\
         shutteropening = [0.0912345678, 1e-9, 0.15123456, 0.987654321, 0.84567891, 0.9999999, 0.9123456, 1e-30]\n\
         triggers = 3\ntimer_hz = 12_345_678\nmin_gap = 0\nset_up = 'emulated'\n",
    )
    .unwrap();
    let rust = with_curve("x", &plan);
    let [times, inner] = [0, 1].map(|i| {
        numbers(
            rust.split_once("shutteropening(").unwrap().1.splitn(3, '[').nth(i + 1).unwrap(),
            "",
            ']',
        )
    });
    assert_eq!(times, plan.shape.times);
    assert_eq!(inner, plan.shape.inner.unwrap());
}

/// The numbers between `from` and `to`.
fn numbers(text: &str, from: &str, to: char) -> Vec<f32> {
    let list = text.split_once(from).unwrap().1.split_once(to).unwrap().0;
    list.split(", ").map(|number| number.parse().unwrap()).collect()
}
