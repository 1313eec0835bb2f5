//! `shutter plan`: scene files in, checked lists of trigger times out, with a picture of one.

use std::error::Error;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use super::output::{print, svg_path, write_whole};
use crate::emit::Form;
use crate::planned::Planned;
use crate::{emit, picture, report, speeds};

/// The scene without a file, and the name it goes by.
const DEFAULT: (&str, &str) = ("soft", include_str!("../../scenes/soft.toml"));

/// Plan a shutter's triggers, each in the middle of an equal share of the exposure
///
/// Several scenes are the speeds of a shutter: a table of them, or one text with an array of all.
#[derive(clap::Args, Default)]
pub struct Args {
    /// The scenes, as in cli/scenes; a soft shutter if left out
    scenes: Vec<PathBuf>,
    /// Write the picture to this file
    #[arg(long, value_name = "FILE.svg", value_parser = svg_path)]
    out: Option<PathBuf>,
    /// Write the picture of both set-ups, the curve emulated and the shutter in the light's path, to this file
    #[arg(long, value_name = "FILE.svg", value_parser = svg_path)]
    set_ups: Option<PathBuf>,
    /// Print this form alone
    #[arg(long, value_name = "FORM")]
    emit: Option<Form>,
    /// What it is called; the scene's file name, or `shutter` for several, if left out
    #[arg(long)]
    name: Option<String>,
}

pub fn run(args: &Args, out: &mut dyn Write) -> Result<(), String> {
    match args.scenes.as_slice() {
        [] => one(args, DEFAULT.0.into(), checked(DEFAULT.0, DEFAULT.1)?, out),
        [path] => one(args, stem(path), read(path)?, out),
        paths => several(args, paths, out),
    }
}

type Draw = fn(&str, &Planned) -> Result<String, Box<dyn Error>>;

fn one(args: &Args, name: String, plan: Planned, out: &mut dyn Write) -> Result<(), String> {
    let name = args.name.clone().unwrap_or(name);
    let text = match args.emit {
        Some(form) => emit::emit(form, &name, &plan)?,
        None => report::text(&name, &plan),
    };
    let draw = |path: &Option<PathBuf>, draw: Draw| match path {
        Some(path) => {
            write_whole(path, &draw(&name, &plan).map_err(|e| format!("the picture: {e}"))?)
        }
        None => Ok(()),
    };
    draw(&args.out, picture::svg)?;
    draw(&args.set_ups, set_ups)?;
    print(out, &text)
}

/// The picture of both set-ups, whose doses come from a curve.
fn set_ups(name: &str, plan: &Planned) -> Result<String, Box<dyn Error>> {
    let curve =
        plan.plan().ok_or("the set-ups are told apart by a curve, and the scene has none")?;
    picture::set_ups(name, curve)
}

fn several(args: &Args, paths: &[PathBuf], out: &mut dyn Write) -> Result<(), String> {
    if args.out.is_some() || args.set_ups.is_some() {
        return Err("a picture is of one scene".into());
    }
    let plans = paths.iter().map(|path| Ok((stem(path), read(path)?)));
    let plans = plans.collect::<Result<Vec<_>, String>>()?;
    let name = args.name.as_deref().unwrap_or("shutter");
    let text = match args.emit {
        Some(form) => emit::several(form, name, &plans)?,
        None => speeds::text(&plans),
    };
    print(out, &text)
}

fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into()
}

fn read(path: &Path) -> Result<Planned, String> {
    let file = path.display().to_string();
    let text = fs::read_to_string(path).map_err(|e| format!("{file}: {e}"))?;
    checked(&file, &text)
}

fn checked(file: &str, text: &str) -> Result<Planned, String> {
    Planned::parse(text).map_err(|fault| fault.locate(file, text))
}
