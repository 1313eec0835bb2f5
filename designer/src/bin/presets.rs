//! Prints what the page takes from here: scenes of `cli/scenes`, the order of the numbers in a question
//! and of the codes in an answer, where the crate lives.

use std::error::Error;
use std::fs;

use serde::Serialize;
use shutter::fault::Code;
use shutter::scene::{self, KEYS, Scene};
use shutter_fit::unit::Unit;
use strum::VariantNames;

const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../cli/scenes");
/// The one place that has the repository's address.
const MANIFEST: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.toml");
/// What the page offers.
const OFFERED: [&str; 5] = ["leaf", "trapezoid", "box", "liquid-crystal", "measured"];

#[derive(Serialize)]
struct Preset {
    name: &'static str,
    scene: Scene,
}

fn main() -> Result<(), Box<dyn Error>> {
    let preset = |name| {
        let text = fs::read_to_string(format!("{SCENES}/{name}.toml"))?;
        let scene = scene::parse(&text).map_err(|fault| fault.locate(name, &text))?;
        Ok::<_, Box<dyn Error>>(Preset { name, scene })
    };
    let presets = OFFERED.into_iter().map(preset).collect::<Result<Vec<_>, _>>()?;
    let manifest = fs::read_to_string(MANIFEST)?;
    let mut lines = manifest.lines();
    let repository = lines.find_map(|line| line.strip_prefix("repository = "));
    println!("export const REPOSITORY = {};", repository.unwrap_or("null"));
    println!("export const UNITS = {};", serde_json::to_string(&Unit::ALL)?);
    println!("export const KEYS = {};", serde_json::to_string(&KEYS)?);
    println!("export const CODES = {};", serde_json::to_string(Code::VARIANTS)?);
    println!("export default {};", serde_json::to_string(&presets)?);
    Ok(())
}
