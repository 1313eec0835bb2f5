//! `shutter fit`: a measured trace in, the simplest shutter that serves out, as a scene.

use std::convert::Infallible;
use std::io::Write;
use std::iter::once;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::ValueEnum;
use clap::builder::RangedI64ValueParser;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use shutter_fit::trace::{self, Column, Light, Recording, Refusal, Trace, Warning};
use shutter_fit::unit::{Unit, count};
use shutter_fit::{Fit, Kind, Options, Sync, Tolerance, delay};

use super::fit_many::{self, Speed};
use super::input::{self, file_name, shown, stem};
use super::kept::Old;
use super::output::{Outputs, svg_path};
use super::quantity::{rate, speed, time, tolerance};
use crate::fitted::{self, Zero};
use crate::picture;
use crate::plan::MOST_TRIGGERS;
use crate::planned::Planned;

/// Without progress for so long, nobody waits for any.
const PATIENCE: Duration = Duration::from_secs(1);

/// Fit the simplest shutter to a measured trace, and write it as a scene
///
/// The trace is a CSV with a time and a signal in each row, as oscilloscopes, logic analysers and shutter testers export it.
/// The report goes to standard output, warnings to standard error. If the trace is refused, the exit code is 2, and nothing is
/// written.
#[derive(clap::Args)]
pub struct Args {
    /// The trace; `-` is standard input
    trace: PathBuf,
    /// Other traces, of other speeds: a table of them all instead of the report
    #[arg(value_name = "TRACE")]
    others: Vec<PathBuf>,
    /// What each trace's speed is called, in their order: 1/250, 4ms
    #[arg(long, value_name = "TIME,...", value_delimiter = ',', value_parser = speed)]
    nominal: Vec<f64>,
    /// Write the scene to this file, for `shutter plan`, and keep what a user wrote there; of several traces, a folder of them;
    /// `-` is standard output, in place of the report
    #[arg(long, value_name = "SCENE.toml")]
    out: Option<PathBuf>,
    /// Write the picture to this file: trace, curve, residual, triggers
    #[arg(long, value_name = "FILE.svg", value_parser = svg_path)]
    picture: Option<PathBuf>,
    /// Replace files that hold something else
    #[arg(long)]
    force: bool,
    /// The unit of the times, where the header does not tell
    #[arg(long)]
    unit: Option<Unit>,
    /// The columns of the time and the signal, or of the signal alone: numbers from 1, or names
    #[arg(long, value_name = "TIME,SIGNAL", value_delimiter = ',', num_args = 1)]
    columns: Vec<String>,
    /// The samples in a second, where the rows hold no time: 48000, 250kHz
    #[arg(long, value_name = "HERTZ", value_parser = rate)]
    rate: Option<f64>,
    /// Which way light moves the signal
    #[arg(long, default_value = "auto")]
    light: Light,
    /// The signal of a shutter that is fully open, where this one never is
    #[arg(long, value_name = "SIGNAL", allow_negative_numbers = true)]
    full: Option<f64>,
    /// Which pulse, from 1; the one of median exposure if left out
    #[arg(long, value_name = "NUMBER")]
    frame: Option<usize>,
    /// The shutter's model; the simplest that serves if left out
    #[arg(long)]
    model: Option<Kind>,
    /// Take the simplest model whose triggers are as near to the free model's: 0.1% (of the exposure), 20us
    #[arg(long, value_parser = tolerance, conflicts_with = "model", allow_hyphen_values = true)]
    tolerance: Option<Tolerance>,
    /// How many triggers; as many as the scene has that is there, or 16, if left out
    #[arg(long, value_name = "N", value_parser = trigger_count())]
    triggers: Option<u32>,
    /// The mains' frequency in hertz: a hum in the trace has it
    #[arg(long, value_name = "50|60", value_parser = mains)]
    mains: Option<f64>,
    /// The column of the camera's sync, by number or name, or the time of its edge in the trace: CH2, 3, 0, 1.5ms; the scene has
    /// the delay from the edge to the opening, and how it differs between shots
    #[arg(long, value_name = "COLUMN|TIME", value_parser = sync, allow_hyphen_values = true)]
    sync: Option<Asked>,
    /// The report's form; `json` is an object, or an array of those of several traces, whose names stay as they are
    #[arg(long, default_value = "text")]
    report: Report,
    /// Where the scene's time 0 is
    #[arg(long, default_value = "trace")]
    zero: Zero,
}

/// The form of what goes to standard output.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Report {
    /// For a reader
    Text,
    /// For a program
    Json,
}

/// What is told of the sync.
#[derive(Clone)]
enum Asked {
    Time(f64),
    Column(Column),
}

fn sync(text: &str) -> Result<Asked, Infallible> {
    Ok(time(text).map_or_else(|_| Asked::Column(Column::parse(text)), Asked::Time))
}

fn mains(text: &str) -> Result<f64, String> {
    match text {
        "50" => Ok(50.0),
        "60" => Ok(60.0),
        _ => Err("50 or 60 is required".into()),
    }
}

pub(super) fn trigger_count() -> RangedI64ValueParser<u32> {
    clap::value_parser!(u32).range(1..=i64::from(MOST_TRIGGERS))
}

pub fn run(args: &Args, out: &mut dyn Write, err: &mut dyn Write) -> Result<(), String> {
    let traces: Vec<&Path> = once(&args.trace).chain(&args.others).map(PathBuf::as_path).collect();
    if args.picture.is_some() && traces.len() > 1 {
        return Err("--picture: a picture is of one trace".into());
    }
    if !args.nominal.is_empty() && args.nominal.len() != traces.len() {
        let speeds = count(args.nominal.len() as u64, "speed");
        let traces = count(traces.len() as u64, "trace");
        return Err(format!("--nominal: {speeds} for {traces}"));
    }
    let scenes: Vec<PathBuf> = match (&args.out, traces.as_slice()) {
        (None, _) => Vec::new(),
        (Some(file), [_]) => vec![file.clone()],
        (Some(folder), traces) => {
            traces.iter().map(|trace| folder.join(stem(trace) + ".toml")).collect()
        }
    };
    let to: Vec<&Path> = scenes.iter().chain(&args.picture).map(PathBuf::as_path).collect();
    let mut outputs = Outputs::new(&traces, &to, args.force)?;

    let (mut fits, mut beside) = (Vec::new(), Vec::new());
    for (i, path) in traces.iter().enumerate() {
        let old = scenes.get(i).map_or(Ok(None), |file| old(&mut outputs, file))?;
        let triggers = args.triggers.or(old.as_ref().and_then(Old::triggers));
        let refused = |reason: String| format!("{}: {reason}", shown(path));
        let (mut fit, warnings) = measure(args, path, triggers).map_err(refused)?;
        fit.nominal = args.nominal.get(i).copied();
        fits.push(fit);
        beside.push((old, warnings));
    }
    delay::pool(fits.iter_mut().filter_map(|fit| Some((fit.exposure.value, fit.delay.as_mut()?))));

    let (mut speeds, mut told, mut shown_scene) = (Vec::new(), String::new(), String::new());
    for (i, (fit, (old, mut warnings))) in fits.into_iter().zip(beside).enumerate() {
        let (path, file) = (traces[i], scenes.get(i));
        let refused = |reason: String| format!("{}: {reason}", shown(path));
        let name = file_name(path);
        let scene = fitted::scene(&fit, &name, args.zero, old.as_ref().map(Old::unit))
            .map_err(|refusal| refused(refusal.to_string()))?;
        if scene.zero != args.zero && file.is_some() {
            warnings.push(Warning::ZeroMoved);
        }
        let whose = if traces.len() > 1 { shown(path) + ": " } else { String::new() };
        for warning in &warnings {
            told += &format!("warning: {whose}{warning}\n");
        }
        let (text, kept) = match old {
            Some(old) => merged(&old, &scene.text, file)?,
            None => (scene.text, Vec::new()),
        };
        if let (Some(file), false) = (file, kept.is_empty()) {
            told += &format!("{}: kept {}\n", file.display(), kept.join(", "));
        }
        match file {
            Some(file) => outputs.replace(file, text)?,
            None => shown_scene = text,
        }
        speeds.push(Speed { name, fit, warnings });
    }
    if let (Some(file), [Speed { name, fit, .. }]) = (&args.picture, speeds.as_slice()) {
        outputs.add(file, picture::trace(name, fit).map_err(|e| format!("the picture: {e}"))?)?;
    }
    let report = match (args.report, speeds.as_slice()) {
        (Report::Json, speeds) => json(speeds),
        (_, [Speed { name, fit, .. }]) => {
            let text = shutter_fit::text(name, fit);
            match scenes.is_empty() {
                true => {
                    format!("{text}\nThe scene, which --out SCENE.toml writes:\n\n{shown_scene}")
                }
                false => text,
            }
        }
        (_, speeds) => fit_many::table(speeds),
    };
    outputs.finish(out, &report)?;
    // There is no one to tell if standard error cannot be written.
    let _ = err.write_all(told.as_bytes());
    Ok(())
}

/// The scene that is there already, unless it is to be replaced.
fn old(outputs: &mut Outputs, file: &Path) -> Result<Option<Old>, String> {
    match outputs.old(file)?.filter(|text| !text.is_empty()) {
        None => Ok(None),
        Some(text) => Old::parse(&text).map(Some).ok_or_else(|| {
            format!(
                "{}: it holds something other than a scene; --force replaces it",
                file.display()
            )
        }),
    }
}

/// The new scene with what is kept of the old one, if it can be planned.
fn merged(old: &Old, text: &str, file: Option<&PathBuf>) -> Result<(String, Vec<String>), String> {
    let (text, kept) = old.kept_in(text);
    Planned::parse(&text).map_err(|fault| {
        let file = file.map(|file| file.display().to_string()).unwrap_or_default();
        format!("{file}: with what it keeps, {}; --force replaces it all", fault.reason)
    })?;
    Ok((text, kept))
}

/// One object, or an array of those of several.
fn json(speeds: &[Speed]) -> String {
    let object = |it: &Speed| shutter_fit::json(&it.name, &it.fit, &it.warnings);
    let json = match speeds {
        [one] => object(one),
        several => several.iter().map(object).collect(),
    };
    format!("{json:#}\n")
}

/// The fit of a trace, and what is doubtful about it.
fn measure(args: &Args, path: &Path, triggers: Option<u32>) -> Result<(Fit, Vec<Warning>), String> {
    let columns = args.columns.iter().map(|column| Column::parse(column)).collect();
    let (edge, sync) = match &args.sync {
        Some(Asked::Time(time)) => (Some(Sync::Edge(*time)), None),
        Some(Asked::Column(column)) => (None, Some(column.clone())),
        None => (None, None),
    };
    let options = trace::Options { unit: args.unit, columns, rate: args.rate, sync };
    let told = |refusal: Refusal| refusal.to_string();
    let Recording { trace, sync, reading, mut warnings } =
        trace::open(&input::read(path)?, &options).map_err(told)?;
    if edge.is_some() && reading.is_counted() {
        return Err(format!(
            "--sync: times are counted from the first row, and nothing tells how long that is before or after the edge; name the \
             column of the sync, or take a record with times; read: {reading}"
        ));
    }
    let options = Options {
        model: args.model,
        tolerance: args.tolerance,
        full: args.full,
        frame: args.frame,
        light: args.light,
        triggers: triggers.unwrap_or(Options::TRIGGERS),
        mains: args.mains,
        sync: edge.or(sync.map(Sync::Channel)),
    };
    let mut fit =
        fitted(&trace, &options).map_err(|refusal| format!("{refusal}; read: {reading}"))?;
    fit.reading = Some(reading);
    warnings.extend(fit.warnings.iter().cloned());
    Ok((fit, warnings))
}

/// The fit, with a bar for whoever waits for it.
fn fitted(trace: &Trace, options: &Options) -> Result<Fit, Refusal> {
    let bar = ProgressBar::with_draw_target(Some(1000), ProgressDrawTarget::hidden());
    if let Ok(style) = ProgressStyle::with_template("fitting {bar:30} {percent:>3} % {elapsed}") {
        bar.set_style(style);
    }
    let mut progress = |done: f64| {
        if bar.is_hidden() && bar.elapsed() > PATIENCE {
            bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        bar.set_position((1000.0 * done) as u64);
    };
    let fit = shutter_fit::fit(trace, options, &mut progress);
    bar.finish_and_clear();
    fit
}
