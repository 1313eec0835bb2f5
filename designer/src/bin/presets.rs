//! Prints the scenes of `cli/scenes` as the module that the page takes its presets from.

use std::error::Error;
use std::fs;

use serde::Serialize;
use shutter::scene::{self, Scene};

const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../cli/scenes");
/// The page begins with it.
const FIRST: &str = "soft";

#[derive(Serialize)]
struct Preset {
    name: String,
    /// The comment above the scene.
    about: String,
    scene: Scene,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut presets = Vec::new();
    for file in fs::read_dir(SCENES)? {
        let path = file?.path();
        let text = fs::read_to_string(&path)?;
        let comment = text.lines().map_while(|line| line.strip_prefix("# "));
        let about = comment.collect::<Vec<_>>().join(" ");
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let scene = scene::parse(&text).map_err(|fault| fault.locate(&name, &text))?;
        presets.push(Preset { name, about, scene });
    }
    presets.sort_by_key(|preset| (preset.name != FIRST, preset.name.clone()));
    println!("// The scenes of cli/scenes.\nexport default {};", serde_json::to_string(&presets)?);
    Ok(())
}
