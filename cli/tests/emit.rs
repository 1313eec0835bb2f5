//! Each form that a plan is emitted in, of each scene that ships: it compiles or parses as it stands, and holds the crate's
//! ticks and the numbers of the plan to the bit.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;
use shutter::emit::{Form, emit};
use shutter::plan::{Plan, Trigger};

const CLI: &str = env!("CARGO_MANIFEST_DIR");

/// The scenes that ship, by their names.
fn plans() -> Vec<(String, Plan)> {
    let scenes = fs::read_dir(format!("{CLI}/scenes")).unwrap().map(|f| f.unwrap().path());
    let plan = |path: PathBuf| {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let plan = Plan::parse(&fs::read_to_string(&path).unwrap()).expect(&name);
        (name, plan)
    };
    let plans: Vec<_> = scenes.map(plan).collect();
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

/// A trigger's ticks and pulse, as the test programs print them.
fn line(trigger: &Trigger) -> String {
    match trigger.pulse {
        Some((on, off)) => format!("{} {on} {off}\n", trigger.ticks),
        None => format!("{}\n", trigger.ticks),
    }
}

#[test]
fn rust_compiles_with_the_crate_and_holds_its_ticks() {
    let folder = folder("rust");
    let rustc = |args: &[&str]| {
        let mut rustc = Command::new(std::env::var_os("RUSTC").unwrap_or("rustc".into()));
        rustc.args(["--edition", "2024", "--out-dir", "."]).args(args).current_dir(&folder);
        output(&mut rustc);
    };
    let linked = ["-D", "warnings", "--extern", "shutter_curve=libshutter_curve.rlib"];
    // The crate by itself: it has no dependencies.
    let source = format!("{CLI}/../src/lib.rs");
    rustc(&["--crate-type", "rlib", "--crate-name", "shutter_curve", "-O", &source]);
    // A library that asks for documentation takes the module as well.
    fs::write(folder.join("lib.rs"), "//! .\n#![no_std]\n/// .\npub mod scene;\n").unwrap();
    for (name, plan) in plans() {
        let text = emit(Form::Rust, &name, &plan);
        fs::write(folder.join("scene.rs"), &text).unwrap();
        rustc(&[&linked[..], &["--crate-type", "lib", "-D", "missing_docs", "lib.rs"]].concat());
        let pulses = text.contains("PULSES");
        assert_eq!(pulses, plan.triggers[0].pulse.is_some());
        let print = if pulses {
            r#"for (tick, (on, off)) in scene::TICKS.iter().zip(scene::PULSES) { println!("{tick} {on} {off}"); }"#
        } else {
            r#"for tick in scene::TICKS { println!("{tick}"); }"#
        };
        let main = format!(
            "pub mod scene;
            fn main() {{
                let n = scene::TICKS.len() as u32;
                let ticks = scene::SHUTTER.trigger_ticks(n, scene::TIMER_HZ).unwrap();
                assert!(ticks.eq(scene::TICKS));
                println!(\"{{:08x}}\", scene::SHUTTER.exposure().to_bits());
                {print}
            }}"
        );
        fs::write(folder.join("main.rs"), main).unwrap();
        rustc(&[&linked[..], &["main.rs"]].concat());
        let lines: String = plan.triggers.iter().map(line).collect();
        let expected = format!("{:08x}\n{lines}", plan.curve.exposure().to_bits());
        assert_eq!(output(&mut Command::new(folder.join("main"))), expected, "{name}");
    }
}

#[test]
fn c_compiles_as_c99_and_holds_the_same_ticks() {
    let folder = folder("c");
    for (name, plan) in plans() {
        let text = emit(Form::C, &name, &plan);
        fs::write(folder.join("scene.h"), &text).unwrap();
        let pulse = match text.contains("shutter_on") {
            true => {
                r#"printf(" %lu %lu", (unsigned long)shutter_on[i], (unsigned long)shutter_off[i]);"#
            }
            false => "",
        };
        // Twice, as headers come.
        let main = format!(
            "#include \"scene.h\"
            #include \"scene.h\"
            #include <stdio.h>
            int main(void) {{
                printf(\"%lu\\n\", (unsigned long)SHUTTER_TIMER_HZ);
                for (unsigned i = 0; i < sizeof shutter_ticks / sizeof *shutter_ticks; i++) {{
                    printf(\"%lu\", (unsigned long)shutter_ticks[i]);
                    {pulse}
                    printf(\"\\n\");
                }}
                return 0;
            }}"
        );
        fs::write(folder.join("main.c"), main).unwrap();
        output(
            Command::new("cc")
                .args(["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-o"])
                .arg(folder.join("main"))
                .arg(folder.join("main.c")),
        );
        let lines: String = plan.triggers.iter().map(line).collect();
        let expected = format!("{}\n{lines}", plan.timer_hz);
        assert_eq!(output(&mut Command::new(folder.join("main"))), expected, "{name}");
    }
}

/// A row of CSV, or a trigger of JSON.
#[derive(Debug, Deserialize)]
struct Row {
    index: usize,
    u: f32,
    #[serde(alias = "time_s")]
    time: f32,
    ticks: u32,
    gap_ticks: Option<u32>,
    on: Option<u32>,
    off: Option<u32>,
}

fn assert_same(name: &str, plan: &Plan, rows: &[Row]) {
    assert_eq!(rows.len(), plan.triggers.len(), "{name}");
    for (i, (row, trigger)) in rows.iter().zip(&plan.triggers).enumerate() {
        let read =
            Trigger { u: row.u, time: row.time, ticks: row.ticks, pulse: row.on.zip(row.off) };
        assert_eq!((row.index, read), (i, *trigger), "{name}");
    }
}

#[test]
fn csv_parses_and_holds_the_same_numbers() {
    for (name, plan) in plans() {
        let text = emit(Form::Csv, &name, &plan);
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let header: Vec<_> = reader.headers().unwrap().iter().map(String::from).collect();
        let pulses = plan.triggers[0].pulse.is_some();
        let names = ["index", "u", "time_s", "ticks", "gap_ticks", "on", "off"];
        assert_eq!(header, names[..if pulses { 7 } else { 5 }], "{name}");
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
    opening: f32,
    half_open: f32,
    exposure: f32,
    efficiency: f32,
    direct_triggers: u32,
    delta_ev: Option<f32>,
    triggers: Vec<Row>,
}

#[test]
fn json_parses_and_holds_the_same_numbers() {
    for (name, plan) in plans() {
        let document: Document = serde_json::from_str(&emit(Form::Json, &name, &plan)).unwrap();
        assert_eq!((document.scene, document.timer_hz), (name.clone(), plan.timer_hz));
        assert_eq!(document.exposure, plan.curve.exposure());
        assert_eq!(document.efficiency, plan.curve.efficiency());
        assert!(document.opening >= 0.0 && document.half_open > 0.0);
        assert_eq!(document.direct_triggers, plan.curve.direct_triggers());
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
    assert!(c.contains("\n#define SHUTTER______ERROR_____H\n"), "{c}");
    let json: serde_json::Value = serde_json::from_str(&emit(Form::Json, name, &plan)).unwrap();
    assert_eq!(json["scene"], name);
}

/// Numbers at both ends of what a scene may hold come back as they were.
#[test]
fn great_and_small_numbers_round_trip() {
    for (factor, timer_hz) in [(1e-18, u32::MAX), (1e-7, u32::MAX), (7e8, 1)] {
        let text = format!(
            "open_start = -{factor:e}\nopen_end = {factor:e}\nclose_start = {factor:e}\nclose_end = {:e}\n\
             triggers = 1\ntimer_hz = {timer_hz}\nmin_gap = 0\n",
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
        let times = numbers(&emit(Form::Rust, "x", &plan), "linear(", ')');
        assert_eq!(times, plan.shape.times);
    }
    // Numbers with all the digits that they have.
    let plan = Plan::parse(
        "open_start = 1e-9\nopen_end = 0.002512345678\nclose_start = 0.00751234567\nclose_end = 0.0101234567\n\
         shutteropening = [0.0912345678, 1e-9, 0.15123456, 0.987654321, 0.84567891, 0.9999999, 0.9123456, 1e-30]\n\
         triggers = 3\ntimer_hz = 12_345_678\nmin_gap = 0\n",
    )
    .unwrap();
    let rust = emit(Form::Rust, "x", &plan);
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
