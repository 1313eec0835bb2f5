//! `shutter plan`: a scene file in, a checked list of trigger times out, with a picture of it.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use super::{print, svg_path, write_whole};
use crate::plan::Plan;
use crate::{picture, report, scene};

/// The scene without a file, and the name it goes by.
const DEFAULT: (&str, &str) = ("soft", include_str!("../../scenes/soft.toml"));

/// Plan a shutter's triggers, each in the middle of an equal share of the exposure
#[derive(clap::Args, Default)]
pub struct Args {
    /// The scene, as in cli/scenes; a soft shutter if left out
    scene: Option<PathBuf>,
    /// Write the picture to this file
    #[arg(long, value_name = "FILE.svg", value_parser = svg_path)]
    out: Option<PathBuf>,
}

pub fn run(args: &Args, out: &mut dyn Write) -> Result<(), String> {
    let (name, plan) = match &args.scene {
        Some(path) => (stem(path), read(path)?),
        None => (DEFAULT.0.into(), checked(DEFAULT.0, DEFAULT.1)?),
    };
    if let Some(path) = &args.out {
        let svg = picture::svg(&name, &plan).map_err(|e| format!("the picture: {e}"))?;
        write_whole(path, &svg)?;
    }
    print(out, &report::text(&name, &plan))
}

fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into()
}

fn read(path: &Path) -> Result<Plan, String> {
    let file = path.display().to_string();
    let text = fs::read_to_string(path).map_err(|e| format!("{file}: {e}"))?;
    checked(&file, &text)
}

fn checked(file: &str, text: &str) -> Result<Plan, String> {
    scene::parse(text).and_then(|scene| Plan::new(&scene)).map_err(|fault| fault.locate(file, text))
}
