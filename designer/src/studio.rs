//! What is loaded after the page has begun: forms to take away, scenes that are opened, fits to a trace.

use serde::{Deserialize, Serialize};
use serde_json::Value;
use shutter_fit::delay::{self, Sync};
use shutter_fit::trace::{self, Column, Light, Preview, Reading, Recording, Refusal, Trace};
use shutter_fit::unit::Unit;
use shutter_fit::{From, Options, report, speed};
use shutter_plan::emit::{self, Form};
use shutter_plan::fault::Fault;
use shutter_plan::fitted::{self, Zero, no_scene};
use shutter_plan::plan::Plan;
use shutter_plan::scene::{Flashes, Scene};

use crate::flat;
use crate::words::{self, Told};

/// More samples are drawn as the least and the greatest of neighbours.
const MOST: usize = 2000;
/// The first rows of a file that are shown.
const ROWS: usize = 6;

/// What the page asks. A scene is the text of its TOML.
#[derive(Deserialize)]
#[serde(tag = "ask", rename_all = "lowercase")]
enum Question {
    /// The plan in one of the forms.
    Emit { name: String, scene: String, form: Form },
    /// The numbers of a scene.
    Scene { name: String, scene: String },
    /// The scene that fits a trace, which is the question's payload.
    Fit { name: String, asked: Asked },
}

/// Answers a question. A fit tells its progress.
pub fn ask(question: &[u8], payload: Vec<u8>, progress: &mut dyn FnMut(f64)) -> String {
    match serde_json::from_slice(question) {
        Ok(Question::Emit { name, scene, form }) => json(&emitted(&name, &scene, form)),
        Ok(Question::Scene { name, scene }) => json(&checked(&name, &scene)),
        Ok(Question::Fit { name, asked }) => json(&Ok(measured(&name, payload, &asked, progress))),
        Err(error) => json(&Err::<(), _>(error.to_string())),
    }
}

/// The answer: what was asked for as `Ok`, or else what is wrong as `Err`.
fn json(answer: &Result<impl Serialize, String>) -> String {
    serde_json::to_string(answer).unwrap_or_default()
}

/// A plan in one of the forms, and what its file is called.
#[derive(Serialize)]
struct Emitted {
    text: String,
    file: String,
}

fn emitted(name: &str, scene: &str, form: Form) -> Result<Emitted, String> {
    let plan = Plan::parse(scene).map_err(|fault| fault.locate(name, scene))?;
    Ok(Emitted { text: emit::emit(form, name, &plan, false)?, file: form.file(name) })
}

/// The scene, if it can be planned.
fn checked(name: &str, text: &str) -> Result<Value, String> {
    let located = |fault: Fault| fault.locate(name, text);
    let scene = Scene::parse(text).map_err(located)?;
    if Plan::new(&scene).map_err(located)?.curve.is_none() {
        let reason = "these are trigger times as they were measured, and this page needs the curve that they lack: \
                      open their trace here, or give the times to `shutter plan` in a terminal";
        return Err(format!("{name}: {reason}"));
    }
    Ok(flat::object(&scene))
}

/// How a file is to be read, and what of it is to be fitted; what is left out is the file's own.
#[derive(Default, Deserialize)]
#[serde(default)]
struct Asked {
    unit: Option<Unit>,
    /// The samples in a second.
    rate: Option<f64>,
    /// The first time that counts, in seconds, and the last one.
    from: Option<f64>,
    to: Option<f64>,
    /// The time's and the signal's column, from 1, or the signal's alone.
    columns: Vec<usize>,
    /// The sync's column, from 1.
    sync: Option<usize>,
    light: Light,
    /// The signal of full light.
    full: Option<f64>,
    /// Which pulse, from 1.
    frame: Option<usize>,
    triggers: u32,
}

/// A trace: what its file begins with, how it was read, and its fit or what is in the way of that.
#[derive(Serialize)]
struct Measured {
    #[serde(flatten)]
    preview: Preview,
    read: Option<Reading>,
    /// What was read, as (seconds of the file, signal).
    raw: Vec<[f64; 2]>,
    fit: Result<Fitted, Told>,
}

/// A trace's fit.
#[derive(Serialize)]
struct Fitted {
    /// The curve, from its start of opening on.
    scene: Value,
    /// Where the curve does not explain the trace: the trace's own triggers as the program writes them.
    own: Option<Own>,
    /// As the program prints it.
    report: String,
    kind: &'static str,
    /// As a program reads it.
    json: serde_json::Value,
    /// The efficiency, and the times of testers, as the report has them.
    efficiency: String,
    tester: String,
    /// From the sync's edge to the opening, where that is known.
    delay: Option<String>,
    exposure: String,
    /// In seconds after the opening, each with its standard error.
    triggers: Vec<(f64, f64)>,
    /// By what share the exposures of all pulses differ.
    scatter: f64,
    warnings: Vec<Told>,
    /// The trace as (time in seconds of the scene, openness, residual).
    samples: Vec<[f64; 3]>,
}

/// A trace's own triggers.
#[derive(Serialize)]
struct Own {
    /// In seconds from the start of opening.
    times: Vec<f64>,
    timer_hz: u32,
    /// From there to where the curve starts to open, in seconds.
    until_curve: f64,
}

/// Reads the trace in `bytes`, and fits it.
fn measured(name: &str, bytes: Vec<u8>, asked: &Asked, progress: &mut dyn FnMut(f64)) -> Measured {
    let preview = trace::preview(&bytes, ROWS).unwrap_or_default();
    let columns = asked.columns.iter().map(|number| Column::Number(*number)).collect();
    let options = trace::Options {
        unit: asked.unit,
        columns,
        rate: asked.rate,
        from: asked.from,
        to: asked.to,
        sync: asked.sync.map(Column::Number),
    };
    let recording = trace::open(&bytes, &options);
    drop(bytes);
    let read = recording.as_ref().ok().map(|recording| recording.reading.clone());
    let pairs = |trace: &Trace| trace.times.iter().zip(&trace.values).map(|(t, v)| [*t, *v]).collect();
    let raw = recording.as_ref().map_or(Vec::new(), |recording| fewer(pairs(&recording.trace)));
    let fit = recording
        .and_then(|recording| fitted(name, recording, asked, progress))
        .map_err(|refusal| words::refusal(&refusal, asked.light != Light::Auto));
    Measured { preview, read, raw, fit }
}

fn fitted(name: &str, recording: Recording, asked: &Asked, progress: &mut dyn FnMut(f64)) -> Result<Fitted, Refusal> {
    let options = Options {
        full: asked.full,
        frame: asked.frame,
        light: asked.light,
        triggers: Some(asked.triggers),
        sync: recording.sync.map(Sync::Channel),
        ..Options::default()
    };
    let mut fit = shutter_fit::fit(&recording.trace, &options, progress)?;
    fit.reading = Some(recording.reading);
    // The page shows a curve, be it one that does not explain the trace: a warning says so.
    let (shutter, _) = fitted::curve_shutter(&fit, name, Zero::Open, None)?;
    let flashes = Flashes { triggers: Some(fit.triggers.len() as f64), ..Flashes::default() };
    let scene = Scene { shutter, flashes: flashes.clone(), is_edited: false };
    let warnings = recording.warnings.iter().chain(&fit.warnings).map(words::warning).collect();
    let signal = &fit.best().signal;
    let own = match fit.from {
        From::Model => None,
        From::Trace => {
            let (shutter, _) = fitted::shutter(&fit, name, Zero::Open, None)?;
            let own = Scene { shutter, flashes, is_edited: false };
            let own = Plan::new(&own).map_err(|fault| no_scene(&fault))?;
            let times = own.triggers.iter().map(|trigger| trigger.time).collect();
            Some(Own { times, timer_hz: own.timer.hz, until_curve: signal.curve.start - fit.opens })
        }
    };
    let start = signal.curve.start - own.as_ref().map_or(0.0, |own| own.until_curve);
    let samples = fit.samples.times.iter().zip(&fit.samples.values).map(|(&t, &v)| {
        let residual = (v - fit.value(t)) / signal.gain;
        [t - start, (v - signal.dark) / signal.gain, residual]
    });
    Ok(Fitted {
        scene: flat::object(&scene),
        report: shutter_fit::text(name, &fit),
        kind: fit.chosen.title(),
        json: shutter_fit::json(name, &fit, &[]),
        exposure: report::exposure(&fit),
        efficiency: report::efficiency(&fit),
        tester: speed::times(&fit).join("; "),
        delay: fit.delay.as_ref().map(|delay| delay::told(Some(delay), fit.unit())),
        own,
        triggers: fit.triggers.iter().map(|m| (m.value - start, m.error)).collect(),
        scatter: fit.frames.scatter,
        warnings,
        samples: fewer(samples.collect()),
    })
}

/// Of many samples the least and the greatest of neighbours.
fn fewer<const N: usize>(samples: Vec<[f64; N]>) -> Vec<[f64; N]> {
    if samples.len() <= MOST {
        return samples;
    }
    let together = samples.len().div_ceil(MOST / 2);
    let ends = |few: &[[f64; N]]| {
        let by_value = |a: &&[f64; N], b: &&[f64; N]| a[1].total_cmp(&b[1]);
        let ends = [few.iter().min_by(by_value), few.iter().max_by(by_value)];
        let mut ends = ends.map(|end| end.copied().unwrap_or([0.0; N]));
        ends.sort_by(|a, b| a[0].total_cmp(&b[0]));
        ends
    };
    samples.chunks(together).flat_map(ends).collect()
}
