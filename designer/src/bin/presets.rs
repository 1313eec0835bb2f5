//! Prints the module that the page takes from here: the scenes of `cli/scenes`, and the order of the numbers in a question.

use std::error::Error;
use std::fs;

use serde::Serialize;
use shutter::scene::{self, KEYS, Scene};
use shutter_fit::unit::Unit;

const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../cli/scenes");
/// The page begins with it.
const FIRST: &str = "soft";

const CAPTIONS: [(&str, &str); 9] = [
    ("box", "all or nothing: electronic"),
    ("leaf", "blades in a lens"),
    ("led", "an LED behind a shutter"),
    ("liquid-crystal", "open at once, a long tail"),
    ("measured", "fitted to a trace"),
    ("projector", "a triangle of 20 pulses"),
    ("soft", "smooth, as renderers have it"),
    ("strobe", "100 flashes of a swing"),
    ("trapezoid", "the slit of a focal plane"),
];

const MEASURED: &str = "A leaf shutter as an oscilloscope recorded it, and the curve that was fitted to that \
                        trace. Its ticks count from the camera's sync, 4.2 ms before it opens.";

#[derive(Serialize)]
struct Preset {
    name: String,
    /// The comment above the scene, or a story in its place.
    about: String,
    /// What is told of it below its picture.
    caption: &'static str,
    scene: Scene,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut presets = Vec::new();
    for file in fs::read_dir(SCENES)? {
        let path = file?.path();
        let text = fs::read_to_string(&path)?;
        let comment = text.lines().map_while(|line| line.strip_prefix("# "));
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let about = match name.as_str() {
            // What stands above it is the fit's report.
            "measured" => MEASURED.into(),
            _ => comment.collect::<Vec<_>>().join(" "),
        };
        let caption = CAPTIONS.iter().find(|(of, _)| *of == name).map(|(_, caption)| *caption);
        let caption = caption.ok_or_else(|| format!("{name}: no caption"))?;
        let scene = scene::parse(&text).map_err(|fault| fault.locate(&name, &text))?;
        presets.push(Preset { name, about, caption, scene });
    }
    presets.sort_by_key(|preset| (preset.name != FIRST, preset.name.clone()));
    println!("export const UNITS = {};", serde_json::to_string(&Unit::ALL)?);
    println!("export const KEYS = {};", serde_json::to_string(&KEYS)?);
    println!("export default {};", serde_json::to_string(&presets)?);
    Ok(())
}
