//! A folder in which the program is run, what comes of that, and traces.

use std::path::PathBuf;
use std::process::Command;
use std::{env, fs, path::Path};

use serde_json::Value;
use shutter_fit::trace::Trace;
use shutter_plan::plan::Plan;

use crate::generator::Random;
use crate::scenes::with;

/// The scenes that ship.
pub const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes");

/// Their names and plans. There are straight ramps and others; pulses and none.
pub fn scenes() -> Vec<(String, Plan)> {
    let files = fs::read_dir(SCENES).unwrap().map(|file| file.unwrap().file_name());
    let mut names: Vec<_> = files.map(|name| name.into_string().unwrap()).collect();
    names.sort();
    let names = names.iter().map(|name| name.trim_end_matches(".toml"));
    let text = |name: &str| fs::read_to_string(format!("{SCENES}/{name}.toml")).unwrap();
    let scenes: Vec<_> = names.map(|name| (name.to_string(), Plan::parse(&text(name)).unwrap())).collect();
    assert!(scenes.len() >= 7 && scenes.iter().any(|it| it.1.triggers[0].pulse.is_some()));
    scenes
}

/// The plan of a scene with changes.
#[track_caller]
pub fn planned(scene: &str, changes: &str) -> Plan {
    let text = with(scene, changes);
    Plan::parse(&text).unwrap_or_else(|fault| panic!("{}", fault.locate("scene", &text)))
}

pub fn report(plan: &Plan) -> String {
    shutter::report::text("scene", plan, 80)
}

/// The text has all of these words, and none of those.
#[track_caller]
pub fn has(text: &str, all: &[&str], none: &[&str]) {
    all.iter().for_each(|words| assert!(text.contains(words), "{words}\n{text}"));
    none.iter().for_each(|words| assert!(!text.contains(words), "{words}\n{text}"));
}

/// How a run ended, and what it wrote; no code where it was killed.
#[derive(Debug, PartialEq)]
pub struct Run {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

impl Run {
    /// The run, which ended well.
    #[track_caller]
    pub fn well(self) -> Self {
        assert_eq!(self.code, Some(0), "{}", self.err);
        self
    }

    /// What it printed, which ended well and without a word.
    #[track_caller]
    pub fn quietly(self) -> String {
        assert_eq!((self.code, self.err.as_str()), (Some(0), ""));
        self.out
    }

    /// It ended well, and printed these words.
    #[track_caller]
    pub fn prints(self, words: &[&str]) -> Self {
        has(&self.out, words, &[]);
        self.well()
    }

    /// It ended well, and told these words.
    #[track_caller]
    pub fn tells(self, words: &[&str]) -> Self {
        has(&self.err, words, &[]);
        self.well()
    }
}

/// A folder of a test's own.
pub struct Folder(pub PathBuf);

impl Folder {
    /// An empty one.
    pub fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("program").join(name);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        Self(folder)
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        fs::write(self.path(name), bytes).unwrap();
    }

    pub fn text(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    pub fn names(&self) -> Vec<String> {
        let files = fs::read_dir(&self.0).unwrap().map(|file| file.unwrap().file_name());
        let mut names: Vec<_> = files.map(|name| name.into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// All files, links and what they hold.
    pub fn all(&self) -> Vec<(String, Option<PathBuf>, Option<Vec<u8>>)> {
        let file = |name: String| {
            let path = self.path(&name);
            let text = path.is_file().then(|| fs::read(&path).unwrap());
            (name, fs::read_link(&path).ok(), text)
        };
        self.names().into_iter().map(file).collect()
    }

    /// Runs the program here with these arguments, as a shell takes them.
    pub fn run(&self, args: &str) -> Run {
        self.shell(&format!("exec \"$shutter\" {args}"))
    }

    /// Runs a line of a shell here, with the program as `$shutter`.
    pub fn shell(&self, line: &str) -> Run {
        let mut sh = Command::new("sh");
        let sh = sh.args(["-c", line]).env("shutter", env!("CARGO_BIN_EXE_shutter"));
        let run = sh.current_dir(&self.0).output().unwrap();
        let [out, err] = [run.stdout, run.stderr].map(|text| String::from_utf8(text).unwrap());
        Run { code: run.status.code(), out, err }
    }

    /// The fit of traces as JSON.
    #[track_caller]
    pub fn json(&self, args: &str) -> Value {
        serde_json::from_str(&self.run(&format!("fit {args} --report json")).well().out).unwrap()
    }

    /// Each run is refused for its reason, leaves all files as they were, and prints nothing but the report of a fit
    /// whose files fail.
    #[track_caller]
    pub fn refuses(&self, runs: &[(&str, &str)]) {
        for (args, reason) in runs {
            let before = self.all();
            let run = self.run(args);
            assert!(run.code == Some(2) && run.err.contains(reason), "{args}: {run:?}");
            assert!(run.out.is_empty() || run.out.contains("\nexposure "), "{args}: {}", run.out);
            assert!(self.all() == before, "{args}");
        }
    }
}

/// A number of an object.
#[track_caller]
pub fn number(json: &Value, key: &str) -> f64 {
    json[key].as_f64().unwrap_or_else(|| panic!("{key} of {json}"))
}

/// An object's keys.
pub fn keys(json: &Value) -> Vec<String> {
    json.as_object().unwrap().keys().cloned().collect()
}

/// The codes of a fit's warnings.
pub fn codes(json: &Value) -> Vec<&str> {
    json["warnings"].as_array().unwrap().iter().map(|it| it["code"].as_str().unwrap()).collect()
}

/// The rows of a plan's table, as their columns.
pub fn table(out: &str) -> Vec<Vec<&str>> {
    let rows = out.lines().skip_while(|line| !line.trim_start().starts_with('#')).skip(1);
    rows.map(|row| row.split_whitespace().collect()).collect()
}

/// Opens from 2 to 4 ms and closes from 7 to 9: an exposure of 5 ms.
pub fn trapezoid(t: f64) -> f64 {
    (t - 0.002).min(0.009 - t).clamp(0.0, 0.002) / 0.002
}

/// So many samples of `f` in 12 ms, with noise.
pub fn sampled(f: impl Fn(f64) -> f64, n: usize, noise: f64) -> Trace {
    let mut random = Random::new(11);
    let times: Vec<f64> = (0..n).map(|i| 0.012 * i as f64 / n as f64).collect();
    let values = times.iter().map(|t| 0.1 + 2.0 * f(*t) + 2.0 * noise * random.normal()).collect();
    Trace { times, values }
}

/// A row for each sample.
pub fn rows(trace: &Trace, row: impl Fn(f64, f64) -> String) -> String {
    trace.times.iter().zip(&trace.values).map(|(t, v)| row(*t, *v) + "\n").collect()
}

/// A trace as a file, with its times in ms.
pub fn csv(trace: &Trace) -> String {
    String::from("time_ms,v\n") + &rows(trace, |t, v| format!("{:.4},{v:.5}", 1e3 * t))
}

/// The file of the trapezoid, or of one that is so many times slower.
pub fn leaf(slower: f64) -> String {
    let Trace { mut times, values } = sampled(trapezoid, 1200, 0.005);
    times.iter_mut().for_each(|t| *t *= slower);
    csv(&Trace { times, values })
}
