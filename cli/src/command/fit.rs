//! `shutter fit`: a measured trace in, the simplest shutter that serves out, as a scene.

use std::fs::File;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::ValueEnum;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::output::{print, svg_path, write_whole};
use crate::fit::{self, Fit, Kind, Options, Tolerance, Zero};
use crate::picture;
use crate::trace::{self, Column, Light, Warning};
use crate::unit::Unit;

/// Without progress for so long, nobody waits for any.
const PATIENCE: Duration = Duration::from_secs(1);
/// A longer file is no trace of a shutter, and would fill the memory.
const LONGEST: u64 = 1 << 28;

/// Fit the simplest shutter to a measured trace, and write it as a scene
///
/// The trace is a CSV with a time and a signal in each row, as oscilloscopes, logic analysers and shutter testers export it.
/// The report goes to standard output, warnings to standard error. If the trace is refused, the exit code is 2, and nothing is
/// written.
#[derive(clap::Args)]
pub struct Args {
    /// The trace
    trace: PathBuf,
    /// Write the scene to this file, for `shutter plan`
    #[arg(long, value_name = "SCENE.toml")]
    out: Option<PathBuf>,
    /// Write the picture to this file: trace, curve, residual, triggers
    #[arg(long, value_name = "FILE.svg", value_parser = svg_path)]
    picture: Option<PathBuf>,
    /// The unit of the times, where the header does not tell
    #[arg(long)]
    unit: Option<UnitName>,
    /// The columns of the time and the signal, or of the signal alone: numbers from 1, or names
    #[arg(long, value_name = "TIME,SIGNAL", value_delimiter = ',', num_args = 1)]
    columns: Vec<String>,
    /// The samples in a second, where the rows hold no time
    #[arg(long, value_name = "HERTZ", value_parser = positive)]
    rate: Option<f64>,
    /// Which way light moves the signal
    #[arg(long, default_value = "auto")]
    light: LightName,
    /// The signal of a shutter that is fully open, where this one never is
    #[arg(long, value_name = "SIGNAL", allow_negative_numbers = true)]
    full: Option<f64>,
    /// Which pulse, from 1; the one of median exposure if left out
    #[arg(long, value_name = "NUMBER")]
    frame: Option<usize>,
    /// The shutter's model; the simplest that serves if left out
    #[arg(long)]
    model: Option<ModelName>,
    /// Take the simplest model whose triggers are as near to the free model's: 0.1% (of the exposure), 20us
    #[arg(long, value_parser = tolerance, conflicts_with = "model", allow_hyphen_values = true)]
    tolerance: Option<Tolerance>,
    /// How many triggers
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    triggers: u32,
    /// Where the scene's time 0 is
    #[arg(long, default_value = "trace")]
    zero: ZeroName,
}

#[derive(Clone, Copy, ValueEnum)]
enum UnitName {
    S,
    Ms,
    #[value(alias = "µs", alias = "μs")]
    Us,
    Ns,
}

#[derive(Clone, Copy, ValueEnum)]
enum LightName {
    /// It begins and ends in the dark
    Auto,
    /// Light raises it
    Up,
    /// Light lowers it
    Down,
}

#[derive(Clone, Copy, ValueEnum)]
enum ModelName {
    /// All open or all closed
    Box,
    /// Straight ramps
    Trapezoid,
    /// Cubic ramps that mirror each other but for their length
    Symmetric,
    /// Any cubic ramps
    Free,
}

#[derive(Clone, Copy, ValueEnum)]
enum ZeroName {
    /// As in the trace
    Trace,
    /// Where the shutter starts to open
    Open,
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x.is_finite() => Ok(x),
        _ => Err("a number above 0 is required".into()),
    }
}

fn tolerance(text: &str) -> Result<Tolerance, String> {
    let wrong = || "write 0.1% (of the exposure), or a time as in 20us, 0.02ms, 2e-5s".to_string();
    let text = text.trim();
    let start =
        text.find(|c: char| c == '%' || c == 'µ' || c == 'μ' || (c.is_alphabetic() && c != 'e'));
    let (number, unit) = text.split_at(start.ok_or_else(wrong)?);
    let number: f64 = number.trim().parse().map_err(|_| wrong())?;
    if !(number >= 0.0 && number.is_finite()) {
        return Err(wrong());
    }
    Ok(match unit {
        "%" => Tolerance::Share(0.01 * number),
        "s" => Tolerance::Seconds(number),
        "ms" => Tolerance::Seconds(Unit::Millisecond.seconds(number)),
        "us" | "µs" | "μs" => Tolerance::Seconds(Unit::Microsecond.seconds(number)),
        "ns" => Tolerance::Seconds(Unit::Nanosecond.seconds(number)),
        _ => return Err(wrong()),
    })
}

impl Args {
    fn reading(&self) -> trace::Options {
        let unit = self.unit.map(|unit| match unit {
            UnitName::S => Unit::Second,
            UnitName::Ms => Unit::Millisecond,
            UnitName::Us => Unit::Microsecond,
            UnitName::Ns => Unit::Nanosecond,
        });
        let columns = self.columns.iter().map(|column| Column::parse(column)).collect();
        trace::Options { unit, columns, rate: self.rate }
    }

    fn fitting(&self) -> Options {
        Options {
            model: self.model.map(|model| match model {
                ModelName::Box => Kind::Box,
                ModelName::Trapezoid => Kind::Trapezoid,
                ModelName::Symmetric => Kind::Symmetric,
                ModelName::Free => Kind::Free,
            }),
            tolerance: self.tolerance,
            full: self.full,
            frame: self.frame,
            light: match self.light {
                LightName::Auto => Light::Auto,
                LightName::Up => Light::Up,
                LightName::Down => Light::Down,
            },
            triggers: self.triggers,
        }
    }
}

pub fn run(args: &Args, out: &mut dyn Write, err: &mut dyn Write) -> Result<(), String> {
    let path = &args.trace;
    let (fit, mut warnings) = fitted(args).map_err(|e| format!("{}: {e}", path.display()))?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let zero = match args.zero {
        ZeroName::Trace => Zero::Trace,
        ZeroName::Open => Zero::Open,
    };
    let scene = fit.scene(&name, zero).map_err(|e| format!("{}: {e}", path.display()))?;
    if scene.zero != zero && args.out.is_some() {
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
    let mut text = fit::text(&name, &fit);
    if args.out.is_none() {
        text += &format!("\nThe scene, which --out SCENE.toml writes:\n\n{}", scene.text);
    }
    print(out, &text)
}

/// The fit, and all warnings.
fn fitted(args: &Args) -> Result<(Fit, Vec<Warning>), String> {
    let text = read(&args.trace)?;
    let (trace, mut warnings) =
        trace::read(&text, &args.reading()).map_err(|refusal| refusal.to_string())?;
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
    let fit = fit::fit(&trace, &args.fitting(), &mut progress);
    bar.finish_and_clear();
    let fit = fit.map_err(|refusal| refusal.to_string())?;
    warnings.extend(fit.warnings.iter().cloned());
    Ok((fit, warnings))
}

fn read(path: &Path) -> Result<String, String> {
    let mut bytes = Vec::new();
    // No more than that, whatever the file says of its size: a device may have no end.
    let file = File::open(path).map_err(|e| e.to_string())?;
    file.take(LONGEST + 1).read_to_end(&mut bytes).map_err(|e| e.to_string())?;
    if bytes.len() as u64 > LONGEST {
        return Err(format!("more than {} MB: cut the trace to the pulse", LONGEST >> 20));
    }
    trace::decode(&bytes).map_err(|refusal| refusal.to_string())
}
