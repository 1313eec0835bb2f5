//! What is loaded after the page has begun: forms to take away, scenes that are opened, fits to a trace.

use serde::{Deserialize, Serialize};
use shutter::emit::{self, Form};
use shutter::fit::{self, Options, Zero};
use shutter::plan::Plan;
use shutter::scene;
use shutter::trace;
use shutter::unit::Unit;

use crate::answer::{Wrong, json};

/// More samples are drawn as the least and the greatest of neighbours.
const MOST: usize = 2000;
/// A longer trace would fill a page's memory.
const LONGEST: usize = 256 << 20;

/// What the page asks. A scene is the text of its TOML.
#[derive(Deserialize)]
#[serde(tag = "ask", rename_all = "lowercase")]
enum Question {
    /// The plan in one of the forms.
    Emit { name: String, scene: String, form: String },
    /// The numbers of a scene.
    Scene { name: String, scene: String },
    /// The scene that fits a trace, which is the question's payload.
    Fit { name: String, unit: Option<Unit>, rate: Option<f64> },
}

/// Answers a question. A fit tells its progress.
pub fn ask(question: &[u8], payload: Vec<u8>, progress: &mut dyn FnMut(f64)) -> String {
    match serde_json::from_slice(question) {
        Ok(Question::Emit { name, scene, form }) => json(&emitted(&name, &scene, &form)),
        Ok(Question::Scene { name, scene }) => json(&checked(&name, &scene)),
        Ok(Question::Fit { name, unit, rate }) => {
            json(&fitted(&name, payload, unit, rate, progress))
        }
        Err(error) => json(&Err::<(), _>(error.to_string().into())),
    }
}

/// A plan in one of the forms, and what its file is called.
#[derive(Serialize)]
struct Emitted {
    text: String,
    file: String,
}

fn emitted(name: &str, scene: &str, form: &str) -> Result<Emitted, Wrong> {
    let (form, file) = match form {
        // The file's name is the module's.
        "rust" => (Form::Rust, emit::module(name) + ".rs"),
        "c" => (Form::C, emit::identifier(name) + ".h"),
        "csv" => (Form::Csv, emit::identifier(name) + ".csv"),
        "json" => (Form::Json, emit::identifier(name) + ".json"),
        "pico" => (Form::Pico, emit::identifier(name) + ".txt"),
        _ => return Err(format!("there is no form {form}").into()),
    };
    Ok(Emitted { text: emit::emit(form, name, &plan(name, scene)?)?, file })
}

/// The scene, if it can be planned.
fn checked(name: &str, text: &str) -> Result<scene::Scene, Wrong> {
    let scene = scene::parse(text).map_err(|fault| fault.locate(name, text))?;
    Plan::new(&scene).map_err(|fault| fault.locate(name, text))?;
    Ok(scene)
}

fn plan(name: &str, text: &str) -> Result<Plan, Wrong> {
    Ok(Plan::parse(text).map_err(|fault| fault.locate(name, text))?)
}

/// A trace, and the scene that fits it.
#[derive(Serialize)]
struct Fitted {
    /// As `shutter fit` writes it.
    scene: String,
    /// As `shutter fit` prints it.
    report: String,
    kind: &'static str,
    because: String,
    rms: f64,
    exposure: String,
    warnings: Vec<String>,
    /// The trace as (time in seconds of the scene, openness, residual).
    samples: Vec<(f64, f64, f64)>,
}

/// Fits the trace in `bytes`.
fn fitted(
    name: &str,
    bytes: Vec<u8>,
    unit: Option<Unit>,
    rate: Option<f64>,
    progress: &mut dyn FnMut(f64),
) -> Result<Fitted, Wrong> {
    if bytes.len() > LONGEST {
        return Err(format!("{} MB: cut the trace to the pulse", bytes.len() >> 20).into());
    }
    let text = trace::decode(&bytes).map_err(|refusal| refusal.to_string())?;
    drop(bytes);
    let reading = trace::Options { unit, rate, ..Default::default() };
    let (trace, mut warnings) =
        trace::read(&text, &reading).map_err(|refusal| refusal.to_string())?;
    drop(text);
    let fit =
        fit::fit(&trace, &Options::default(), progress).map_err(|refusal| refusal.to_string())?;
    let scene = fit.scene(name, Zero::Open).map_err(|refusal| refusal.to_string())?;
    warnings.extend(fit.warnings.iter().cloned());
    let best = fit.best();
    let (signal, start) = (&best.signal, best.signal.curve.start);
    let samples: Vec<_> = fit
        .samples
        .times
        .iter()
        .zip(&fit.samples.values)
        .map(|(&t, &v)| {
            let residual = (v - fit.value(t)) / signal.gain;
            (t - start, (v - signal.dark) / signal.gain, residual)
        })
        .collect();
    Ok(Fitted {
        scene: scene.text,
        report: fit::text(name, &fit),
        kind: fit.chosen.title(),
        because: fit::because(&fit),
        rms: best.rms,
        exposure: fit::plus_minus(
            fit.unit().of(fit.exposure.value),
            fit.unit().of(fit.exposure.error),
            fit.unit().name(),
        ),
        warnings: warnings.iter().map(ToString::to_string).collect(),
        samples: fewer(samples),
    })
}

/// Of many samples the least and the greatest of neighbours.
fn fewer(samples: Vec<(f64, f64, f64)>) -> Vec<(f64, f64, f64)> {
    if samples.len() <= MOST {
        return samples;
    }
    let together = samples.len().div_ceil(MOST / 2);
    let ends = |few: &[(f64, f64, f64)]| {
        let by_value = |a: &&(f64, f64, f64), b: &&(f64, f64, f64)| a.1.total_cmp(&b.1);
        let ends = [few.iter().min_by(by_value), few.iter().max_by(by_value)];
        let mut ends = ends.map(|end| end.copied().unwrap_or_default());
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        ends
    };
    samples.chunks(together).flat_map(ends).collect()
}
