//! The seeds that this run was not built with: the same bench, built with other features.

use std::process::{Command, Stdio};

use crate::methods::{METHODS, TEXTBOOK};
use crate::report::{Measured, SEED};

/// What depends on the seed.
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
pub struct SeedRow {
    pub seed: String,
    pub cells: String,
    /// Ratios to the textbook Newton.
    pub soft: f64,
    pub all_ramp: f64,
    pub forward: f64,
    pub backward: f64,
    pub mean: f64,
    pub worst: u32,
}

/// The rows of this run.
pub fn rows(measured: &Measured) -> Vec<SeedRow> {
    let ours = METHODS.iter().enumerate().filter(|(_, method)| method.is_ours);
    ours.map(|(index, method)| {
        let figures = &measured.figures[index];
        let ratio = |curve: usize| {
            measured.times[curve][index].single / measured.times[curve][TEXTBOOK].single
        };
        SeedRow {
            seed: SEED.into(),
            cells: method.cost.into(),
            soft: ratio(0),
            all_ramp: ratio(1),
            forward: figures.quantile(1.0),
            backward: figures.backward,
            mean: figures.evaluations.0,
            worst: figures.evaluations.1,
        }
    })
    .collect()
}

/// The rows of a run with other features, which prints them as CSV.
pub fn others(features: &str) -> crate::Result<Vec<SeedRow>> {
    let cargo = std::env::var_os("CARGO").unwrap_or("cargo".into());
    let output = Command::new(cargo)
        .args(["bench", "--quiet", "--bench", "speed_vs_error", "--no-default-features"])
        .args(["--features", features, "--", "--seed-rows"])
        .stderr(Stdio::inherit())
        .output()?;
    if !output.status.success() {
        return Err(format!("the run with features {features:?} failed").into());
    }
    let rows = csv::Reader::from_reader(&*output.stdout).into_deserialize();
    Ok(rows.collect::<Result<_, _>>()?)
}
