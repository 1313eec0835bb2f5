//! Prints what the page takes from here: scenes of `cli/scenes` and what is told of them, and the units.

use std::error::Error;
use std::fs;

use serde::Serialize;
use shutter_fit::unit::Unit;
use shutter_plan::facts::Facts;
use shutter_plan::plan::Plan;
use shutter_plan::scene::Scene;

const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../cli/scenes");
/// What the page offers.
const OFFERED: [&str; 5] = ["leaf", "trapezoid", "box", "liquid-crystal", "measured"];

#[derive(Serialize)]
struct Preset {
    name: &'static str,
    scene: Scene,
    told: Facts,
}

#[derive(Serialize)]
struct Told<'a> {
    units: &'a [Unit],
    presets: Vec<Preset>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let preset = |name| {
        let text = fs::read_to_string(format!("{SCENES}/{name}.toml"))?;
        let scene = Scene::parse(&text).map_err(|fault| fault.locate(name, &text))?;
        let plan = Plan::new(&scene).map_err(|fault| fault.locate(name, &text))?;
        Ok::<_, Box<dyn Error>>(Preset { name, scene, told: Facts::new(&plan) })
    };
    let presets = OFFERED.into_iter().map(preset).collect::<Result<Vec<_>, _>>()?;
    println!("{}", serde_json::to_string(&Told { units: &Unit::ALL, presets })?);
    Ok(())
}
