//! Prints what the page takes from here: scenes of `cli/scenes`, the order of the numbers in a question
//! and of the codes in an answer, where the crate lives.

use std::error::Error;
use std::fs;

use designer::flat::{self, KEYS};
use serde::Serialize;
use serde_json::{Value, json};
use shutter_fit::unit::Unit;
use shutter_plan::fault::{Code, Fault};
use shutter_plan::plan::Plan;
use shutter_plan::scene::Scene;
use strum::VariantNames;

const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../cli/scenes");
/// The one place that has the repository's address.
const MANIFEST: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.toml");
/// What the page offers.
const OFFERED: [&str; 5] = ["leaf", "trapezoid", "box", "liquid-crystal", "measured"];

#[derive(Serialize)]
struct Told<'a> {
    repository: Option<&'a str>,
    units: &'a [Unit],
    keys: &'a [&'a str],
    codes: &'a [&'a str],
    presets: Vec<Value>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let preset = |name| {
        let text = fs::read_to_string(format!("{SCENES}/{name}.toml"))?;
        let located = |fault: Fault| fault.locate(name, &text);
        let scene = Scene::parse(&text).map_err(located)?;
        Plan::new(&scene).map_err(located)?;
        Ok::<_, Box<dyn Error>>(json!({ "name": name, "scene": flat::object(&scene) }))
    };
    let presets = OFFERED.into_iter().map(preset).collect::<Result<Vec<_>, _>>()?;
    let manifest = fs::read_to_string(MANIFEST)?;
    let mut lines = manifest.lines();
    let repository = lines.find_map(|line| line.strip_prefix("repository = "));
    let repository = repository.map(|it| it.trim_matches('"'));
    let units = Unit::ALL;
    let told = Told { repository, units: &units, keys: &KEYS, codes: Code::VARIANTS, presets };
    println!("{}", serde_json::to_string(&told)?);
    Ok(())
}
