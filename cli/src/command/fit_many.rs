//! `shutter fit` of several traces: the speeds of a shutter, as a tester's list has them.

use std::io::Write;
use std::path::PathBuf;

use shutter_fit::unit::{count, plus_minus, short};
use shutter_fit::{Fit, From, Measured};

use super::fit::{Args, measure};
use super::output::{print, write_whole};
use crate::fitted;
use crate::speeds::columns;

/// A trace with what came of it.
struct Speed {
    name: String,
    nominal: Option<f64>,
    fit: Fit,
}

pub fn run(args: &Args, out: &mut dyn Write, err: &mut dyn Write) -> Result<(), String> {
    if args.picture.is_some() {
        return Err("a picture is of one trace".into());
    }
    let paths: Vec<&PathBuf> = std::iter::once(&args.trace).chain(&args.others).collect();
    if !args.nominal.is_empty() && args.nominal.len() != paths.len() {
        let speeds = count(args.nominal.len() as u64, "speed");
        let traces = count(paths.len() as u64, "trace");
        return Err(format!("--nominal: {speeds} for {traces}"));
    }
    let (mut speeds, mut told, mut scenes) = (Vec::new(), String::new(), Vec::new());
    for (i, path) in paths.into_iter().enumerate() {
        let mut one = args.clone();
        one.trace.clone_from(path);
        let refused = |reason: String| format!("{}: {reason}", path.display());
        let (fit, warnings) = measure(&one).map_err(refused)?;
        for warning in warnings {
            told += &format!("warning: {}: {warning}\n", path.display());
        }
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let nominal = args.nominal.get(i).copied();
        scenes.push((path, scene(&fit, &name, args, nominal).map_err(refused)?));
        speeds.push(Speed { name, nominal, fit });
    }
    if let Some(folder) = &args.out {
        // What one of them would overwrite of another is known before anything is written.
        let mut files: Vec<_> = scenes
            .iter()
            .map(|(path, text)| {
                (folder.join(path.file_stem().unwrap_or_default()).with_extension("toml"), text)
            })
            .collect();
        files.sort();
        if let Some(pair) = files.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            return Err(format!("two traces would both be written to {}", pair[0].0.display()));
        }
        for (file, text) in files {
            write_whole(&file, text)?;
        }
    }
    // There is no one to tell if standard error cannot be written.
    let _ = err.write_all(told.as_bytes());
    print(out, &table(&speeds))
}

/// The scene of one of the traces, with the name of its speed.
fn scene(fit: &Fit, name: &str, args: &Args, nominal: Option<f64>) -> Result<String, String> {
    let text = fitted::scene(fit, name, args.zero).map_err(|refusal| refusal.to_string())?.text;
    // In the unit that the scene is written in.
    Ok(match nominal {
        Some(seconds) => format!("{text}nominal = {}\n", short(fit.unit().of(seconds), 7)),
        None => text,
    })
}

/// A row for each trace.
fn table(speeds: &[Speed]) -> String {
    let header = ["trace", "nominal", "measured", "ΔEV", "spread", "pulses", "model"];
    let mut rows = vec![header.map(String::from)];
    rows.extend(speeds.iter().map(row));
    columns(&rows)
        + "measured: TV, fully open for as much light, ± one standard error; spread: how much the pulses of a trace differ\n"
}

fn row(Speed { name, nominal, fit }: &Speed) -> [String; 7] {
    let unit = fit.unit();
    let Measured { value, error } = fit.exposure;
    let stops = |nominal: f64| {
        let (ev, of_ev) = ((value / nominal).log2(), error / value / std::f64::consts::LN_2);
        let sign = if ev < 0.0 { "-" } else { "+" };
        format!("{sign}{}", plus_minus(ev.abs(), of_ev, "").trim_end())
    };
    let spread = match fit.frames.count {
        ..=1 => "-".into(),
        _ => format!("{} %", short(100.0 * fit.frames.scatter, 2)),
    };
    [
        name.chars().filter(|c| !c.is_control()).collect(),
        nominal.map_or("-".into(), |nominal| unit.show(nominal)),
        plus_minus(unit.of(value), unit.of(error), unit.name()),
        nominal.map_or("-".into(), stops),
        spread,
        fit.frames.count.to_string(),
        match fit.from {
            From::Model => fit.chosen.title().into(),
            From::Trace => "none: by the trace".into(),
        },
    ]
}
