//! What depends on the seed: the rows of this build, and those of the same bench built with other features.

use std::process::{Command, Stdio};

use crate::accuracy::Figures;
use crate::methods::{METHODS, TEXTBOOK};
use crate::timing::Time;

/// The seed of this build.
pub const SEED: &str = if cfg!(feature = "libm") {
    "libm"
} else if cfg!(feature = "micromath") {
    "micromath"
} else {
    "none"
};

/// What depends on the seed.
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
pub struct SeedRow {
    pub seed: String,
    pub cells: String,
    /// Ratios to the textbook Newton's single calls.
    pub soft_single: f64,
    pub soft_slice: f64,
    pub all_ramp_single: f64,
    pub all_ramp_slice: f64,
    pub forward: f64,
    pub backward: f64,
    pub mean: f64,
    pub worst: u32,
}

/// The rows of this run, of its figures by method and its times by curve and method.
pub fn rows(figures: &[Figures], times: &[Vec<Time>]) -> Vec<SeedRow> {
    let ours = METHODS.iter().enumerate().filter(|(_, method)| method.is_ours);
    ours.map(|(index, method)| {
        let figures = &figures[index];
        let [soft, all_ramp] = [0, 1].map(|curve: usize| {
            let (time, textbook) = (times[curve][index], times[curve][TEXTBOOK].single);
            [time.single / textbook, time.slice / textbook]
        });
        SeedRow {
            seed: SEED.into(),
            cells: method.cost.into(),
            soft_single: soft[0],
            soft_slice: soft[1],
            all_ramp_single: all_ramp[0],
            all_ramp_slice: all_ramp[1],
            forward: figures.quantile(1.0),
            backward: figures.backward,
            mean: figures.evaluations.0,
            worst: figures.evaluations.1,
        }
    })
    .collect()
}

/// The rows of a run with other features, which prints them as CSV.
pub fn others(features: &str) -> Result<Vec<SeedRow>, Box<dyn std::error::Error>> {
    let cargo = std::env::var_os("CARGO").unwrap_or("cargo".into());
    let output = Command::new(cargo)
        .args(["bench", "--quiet", "--package", "benches", "--bench", "speed_vs_error"])
        .args(["--features", features, "--", "--seed-rows"])
        .stderr(Stdio::inherit())
        .output()?;
    if !output.status.success() {
        return Err(format!("the run with features {features:?} failed").into());
    }
    let rows = csv::Reader::from_reader(&*output.stdout).into_deserialize();
    Ok(rows.collect::<Result<_, _>>()?)
}
