//! What is loaded after the page has begun: what is told of a scene, forms to take away, scenes that are opened, fits.

use serde::de::IntoDeserializer;
use serde::de::value::Error;
use serde::{Deserialize, Serialize};
use shutter_plan::emit::{self, Form};
use shutter_plan::facts::Facts;
use shutter_plan::fault::{Fault, Key};
use shutter_plan::fitted;
use shutter_plan::plan::{MOST_TRIGGERS, Plan};
use shutter_plan::scene::{Flashes, Scene};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::fits::{Asked, measured};

#[wasm_bindgen]
extern "C" {
    /// The page is told the share of the work that is done.
    #[wasm_bindgen(js_namespace = globalThis)]
    fn progress(share: f64);
}

/// The facts of a scene, or what is wrong with it. What is asked is in TOML; answers are in JSON: what was asked for as
/// `Ok`, or else what is wrong as `Err`.
#[wasm_bindgen]
pub fn tell(scene: &str) -> String {
    answer(read(scene).map(|scene| told(&scene)))
}

/// The plan of a scene in one of the forms; as `toml`, the scene itself.
#[wasm_bindgen]
pub fn emit(name: &str, scene: &str, form: &str) -> String {
    answer(read(scene).and_then(|scene| emitted(name, &scene, form)))
}

/// The scene that a text has.
#[wasm_bindgen]
pub fn open(name: &str, text: &str) -> String {
    answer(opened(name, text))
}

/// The scene that fits the trace in `bytes`, which is read as is asked for. It tells its progress.
#[wasm_bindgen]
pub fn fit(name: &str, asked: &str, bytes: Vec<u8>) -> String {
    let asked = toml::from_str(asked).map_err(|error| error.message().to_string());
    answer(asked.map(|asked: Asked| measured(name, bytes, &asked, &mut |share| progress(share))))
}

/// The scene that the page has. One that was changed by hand keeps the checksum that it does not match.
fn read(text: &str) -> Result<Scene, String> {
    let scene = Scene::parse(text).map_err(|fault| fault.reason())?;
    let is_edited = scene.shutter.measured.as_ref().is_some_and(|it| it.checksum.is_some());
    Ok(Scene { is_edited, ..scene })
}

fn answer(answer: Result<impl Serialize, String>) -> String {
    serde_json::to_string(&answer).unwrap_or_default()
}

/// The facts of a scene, what is doubtful about them, or what is wrong.
#[derive(Serialize)]
struct Told {
    #[serde(flatten)]
    facts: Option<Facts>,
    wrong: Option<Wrong>,
}

#[derive(Serialize)]
struct Wrong {
    key: Key,
    inner: Option<(usize, usize)>,
    text: String,
    /// What would help, each tried.
    remedies: Vec<(String, Flashes)>,
}

/// What is told of a scene.
fn told(scene: &Scene) -> Told {
    match Plan::new(scene) {
        Ok(plan) => Told { facts: Some(Facts::new(&plan)), wrong: None },
        Err(Fault { key, inner, what, .. }) => {
            let wrong = Wrong { key, inner, text: what.to_string(), remedies: remedies(scene) };
            Told { facts: None, wrong: Some(wrong) }
        }
    }
}

fn remedies(scene: &Scene) -> Vec<(String, Flashes)> {
    let with = |change: &dyn Fn(&mut Flashes)| {
        let mut scene = scene.clone();
        change(&mut scene.flashes);
        Plan::new(&scene).is_ok().then_some(scene.flashes)
    };
    let fewer = |n: u32| with(&|flashes| flashes.triggers = Some(n.into()));
    let asked = scene.flashes.triggers.unwrap_or_default() as u32;
    let (mut low, mut high) = (0, asked.min(MOST_TRIGGERS + 1));
    while high > low + 1 {
        let middle = low.midpoint(high);
        *(if fewer(middle).is_some() { &mut low } else { &mut high }) = middle;
    }
    let few = format!("Use {low} flash{}", if low > 1 { "es" } else { "" });
    let plain = |flashes: &mut Flashes| {
        *flashes = Flashes { pulse: None, duty: None, min_pulse: None, fully_open: None, ..*flashes }
    };
    let all = [
        (few, fewer(low).filter(|_| low > 0)),
        ("Ask for no gap".into(), with(&|flashes| flashes.min_gap = Some(0.0))),
        ("Take a timer of 32 bits".into(), with(&|flashes| flashes.timer_bits = None)),
        ("Use plain flashes".into(), with(&plain)),
    ];
    all.into_iter().filter_map(|(words, flashes)| Some((words, flashes?))).collect()
}

/// What is taken away, and what its file is called.
#[derive(Serialize)]
struct Emitted {
    text: String,
    file: String,
}

fn emitted(name: &str, scene: &Scene, form: &str) -> Result<Emitted, String> {
    let form: Result<_, Error> = Form::deserialize(form.into_deserializer());
    let Ok(form) = form else {
        return Ok(Emitted { text: text(scene), file: file(name) });
    };
    let plan = Plan::new(scene).map_err(|fault| fault.reason())?;
    Ok(Emitted { text: emit::emit(form, name, &plan, false)?, file: form.file(name) })
}

/// The shutter, with its checksum where it was measured, and the flashes; below what was measured, what its user has
/// still to tell is told in comments, as a fit does it.
fn text(scene: &Scene) -> String {
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

/// What a scene's file is called.
fn file(name: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '_' { c } else { '-' };
    name.chars().map(plain).collect::<String>() + ".toml"
}

/// The scene, if it can be planned.
fn opened(name: &str, text: &str) -> Result<Scene, String> {
    let mut scene = Scene::parse(text).map_err(|fault| fault.locate(name, text))?;
    if scene.shutter.trigger_times.is_some() {
        let reason = "these are trigger times as they were measured, and this page needs the curve that they lack: \
                      open their trace here, or give the times to `shutter plan` in a terminal";
        return Err(format!("{name}: {reason}"));
    }
    Plan::new(&scene).map_err(|fault| fault.locate(name, text))?;
    if let Some(measured) = scene.shutter.measured.as_mut().filter(|_| !scene.is_edited) {
        measured.checksum = None;
    }
    Ok(scene)
}
