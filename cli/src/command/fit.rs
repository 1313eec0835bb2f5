//! `shutter fit`: a measured trace in, the simplest shutter that serves out, as a scene.

use std::fs::File;
use std::io::{Read, Write};
use std::path::PathBuf;
use std::time::Duration;

use clap::ValueEnum;
use clap::builder::RangedI64ValueParser;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use shutter_fit::trace::{self, Column, Light, Recording, Refusal, Trace, Warning};
use shutter_fit::unit::Unit;
use shutter_fit::{Fit, Kind, Options, Tolerance};

use super::output::{print, svg_path, write_whole};
use crate::fitted::{self, Zero};
use crate::picture;
use crate::plan::MOST_TRIGGERS;

/// Without progress for so long, nobody waits for any.
const PATIENCE: Duration = Duration::from_secs(1);
/// A longer file is no trace of a shutter, and would fill the memory.
const LONGEST: u64 = 1 << 28;

/// Fit the simplest shutter to a measured trace, and write it as a scene
///
/// The trace is a CSV with a time and a signal in each row, as oscilloscopes, logic analysers and shutter testers export it.
/// The report goes to standard output, warnings to standard error. If the trace is refused, the exit code is 2, and nothing is
/// written.
#[derive(clap::Args, Clone)]
pub struct Args {
    /// The trace
    pub(super) trace: PathBuf,
    /// Other traces, of other speeds: a table of them all instead of the report
    #[arg(value_name = "TRACE")]
    pub(super) others: Vec<PathBuf>,
    /// What each trace's speed is called, in their order: 1/250, 4ms
    #[arg(long, value_name = "TIME,...", value_delimiter = ',', value_parser = speed)]
    pub(super) nominal: Vec<f64>,
    /// Write the scene to this file, for `shutter plan`; of several traces, a folder of them
    #[arg(long, value_name = "SCENE.toml")]
    pub(super) out: Option<PathBuf>,
    /// Write the picture to this file: trace, curve, residual, triggers
    #[arg(long, value_name = "FILE.svg", value_parser = svg_path)]
    pub(super) picture: Option<PathBuf>,
    /// The unit of the times, where the header does not tell
    #[arg(long)]
    unit: Option<Unit>,
    /// The columns of the time and the signal, or of the signal alone: numbers from 1, or names
    #[arg(long, value_name = "TIME,SIGNAL", value_delimiter = ',', num_args = 1)]
    columns: Vec<String>,
    /// The samples in a second, where the rows hold no time
    #[arg(long, value_name = "HERTZ", value_parser = positive)]
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
    /// How many triggers
    #[arg(long, value_name = "N", default_value_t = Options::TRIGGERS, value_parser = trigger_count())]
    triggers: u32,
    /// The mains' frequency in hertz: a hum in the trace has it
    #[arg(long, value_name = "50|60", value_parser = mains)]
    mains: Option<f64>,
    /// When the edge of the camera's sync comes, in the trace: 0, 1.5ms; the scene has the delay from there to the opening
    #[arg(long, value_name = "TIME", value_parser = time, allow_hyphen_values = true)]
    sync: Option<f64>,
    /// The report's form; `json` is one object, whose names stay as they are
    #[arg(long, default_value = "text")]
    report: Report,
    /// Where the scene's time 0 is
    #[arg(long, default_value = "trace")]
    pub(super) zero: Zero,
}

/// The form of what goes to standard output.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Report {
    /// For a reader
    Text,
    /// For a program
    Json,
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x.is_finite() => Ok(x),
        _ => Err("a number above 0 is required".into()),
    }
}

fn mains(text: &str) -> Result<f64, String> {
    match text {
        "50" => Ok(50.0),
        "60" => Ok(60.0),
        _ => Err("50 or 60 is required".into()),
    }
}

fn trigger_count() -> RangedI64ValueParser<u32> {
    clap::value_parser!(u32).range(1..=i64::from(MOST_TRIGGERS))
}

fn tolerance(text: &str) -> Result<Tolerance, String> {
    let wrong = || "write 0.1% (of the exposure), or a time as in 20us, 0.02ms, 2e-5s".to_string();
    let text = text.trim();
    // The `e` of an exponent belongs to the number.
    let start = text.find(|c: char| c == '%' || (c.is_alphabetic() && c != 'e'));
    let (number, unit) = text.split_at(start.ok_or_else(wrong)?);
    let number: f64 = number.trim().parse().map_err(|_| wrong())?;
    if !(number >= 0.0 && number.is_finite()) {
        return Err(wrong());
    }
    if unit == "%" {
        return Ok(Tolerance::Share(0.01 * number));
    }
    let unit = Unit::from_str(unit, false).map_err(|_| wrong())?;
    Ok(Tolerance::Seconds(unit.seconds(number)))
}

/// A time in seconds, written with its unit; 0 needs none.
fn time(text: &str) -> Result<f64, String> {
    let wrong = || "write a time as in 0, 1.5ms, -20us, 2e-5s".to_string();
    let text = text.trim();
    let is_unit = |c: char| c.is_alphabetic() && c != 'e';
    let (number, unit) = text.split_at(text.find(is_unit).unwrap_or(text.len()));
    let number: f64 = number.trim().parse().map_err(|_| wrong())?;
    match Unit::from_str(unit, false) {
        _ if unit.is_empty() && number == 0.0 => Ok(0.0),
        Ok(unit) if number.is_finite() => Ok(unit.seconds(number)),
        _ => Err(wrong()),
    }
}

/// What a speed is called: a part of a second, or a time.
fn speed(text: &str) -> Result<f64, String> {
    let seconds = match text.trim().strip_prefix("1/") {
        Some(number) => {
            number.parse::<f64>().map(|number| 1.0 / number).map_err(|e| e.to_string())?
        }
        None => time(text)?,
    };
    if seconds > 0.0 && seconds.is_finite() {
        return Ok(seconds);
    }
    Err("write a speed as in 1/250, 4ms".into())
}

impl Args {
    /// Is a table asked for?
    pub fn is_many(&self) -> bool {
        !(self.others.is_empty() && self.nominal.is_empty())
    }
}

pub fn run(args: &Args, out: &mut dyn Write, err: &mut dyn Write) -> Result<(), String> {
    let refused = |reason: String| format!("{}: {reason}", args.trace.display());
    let Recording { trace, reading, mut warnings } = read(args).map_err(refused)?;
    let mut fit = fitted(&trace, args).map_err(|refusal| refused(refusal.to_string()))?;
    fit.reading = Some(reading);
    warnings.extend(fit.warnings.iter().cloned());

    let name = args.trace.file_name().unwrap_or_default().to_string_lossy();
    let scene =
        fitted::scene(&fit, &name, args.zero).map_err(|refusal| refused(refusal.to_string()))?;
    if scene.zero != args.zero && args.out.is_some() {
        warnings.push(Warning::ZeroMoved);
    }

    if let Some(file) = &args.picture {
        let svg = picture::trace(&name, &fit).map_err(|e| format!("the picture: {e}"))?;
        write_whole(file, &svg)?;
    }
    if let Some(file) = &args.out {
        write_whole(file, &scene.text)?;
    }
    for warning in &warnings {
        // There is no one to tell if standard error cannot be written.
        let _ = writeln!(err, "warning: {warning}");
    }
    if args.report == Report::Json {
        return print(out, &shutter_fit::json(&name, &fit, &warnings));
    }
    let mut report = shutter_fit::text(&name, &fit);
    if args.out.is_none() {
        report += &format!("\nThe scene, which --out SCENE.toml writes:\n\n{}", scene.text);
    }
    print(out, &report)
}

/// The fit of the trace, and what is doubtful about it.
pub(super) fn measure(args: &Args) -> Result<(Fit, Vec<Warning>), String> {
    let Recording { trace, mut warnings, .. } = read(args)?;
    let fit = fitted(&trace, args).map_err(|refusal| refusal.to_string())?;
    warnings.extend(fit.warnings.iter().cloned());
    Ok((fit, warnings))
}

/// The trace, how it was read, and what is doubtful about its file.
fn read(args: &Args) -> Result<Recording, String> {
    let mut bytes = Vec::new();
    // No more than that, whatever the file says of its size: a device may have no end.
    let file = File::open(&args.trace).map_err(|e| e.to_string())?;
    file.take(LONGEST + 1).read_to_end(&mut bytes).map_err(|e| e.to_string())?;
    if bytes.len() as u64 > LONGEST {
        return Err(format!("more than {} MB: cut the trace to the pulse", LONGEST >> 20));
    }
    let columns = args.columns.iter().map(|column| Column::parse(column)).collect();
    let options = trace::Options { unit: args.unit, columns, rate: args.rate };
    trace::open(&bytes, &options).map_err(|refusal| refusal.to_string())
}

/// The fit, with a bar for whoever waits for it.
fn fitted(trace: &Trace, args: &Args) -> Result<Fit, Refusal> {
    let options = Options {
        model: args.model,
        tolerance: args.tolerance,
        full: args.full,
        frame: args.frame,
        light: args.light,
        triggers: args.triggers,
        mains: args.mains,
        sync: args.sync,
    };
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
    let fit = shutter_fit::fit(trace, &options, &mut progress);
    bar.finish_and_clear();
    fit
}
