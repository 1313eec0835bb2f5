//! Cycles on the microcontroller, from the tables that `benches/cortex-m` wrote into `docs/cost.md`.

/// A method's cycles on the soft curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Cost {
    /// A baseline's name, or this crate's number of cells.
    pub method: String,
    pub seed: String,
    pub mean: f64,
    pub max: f64,
}

/// The rows of the soft curve in the tables of the inverse; none where the file is not there.
pub fn read(path: &str) -> Vec<Cost> {
    let text = std::fs::read_to_string(path).unwrap_or_default();
    let mut header: Vec<&str> = Vec::new();
    let mut costs = Vec::new();
    for line in text.lines() {
        let cells: Vec<&str> = line.split('|').map(|cell| cell.trim().trim_matches('*')).collect();
        if cells.get(1) == Some(&"curve") {
            header = cells;
        } else if cells.get(1) == Some(&"soft") {
            let cell = |name| Some(cells[header.iter().position(|cell| *cell == name)?]);
            let (Some(method), Some(mean), Some(max)) =
                (cell("method").or(cell("CELLS")), cell("mean"), cell("max"))
            else {
                continue;
            };
            // The tables without that column are of the default; the baselines have none.
            let default = if cell("CELLS").is_some() { "none" } else { "" };
            let seed = cell("seed").unwrap_or(default);
            if let (Ok(mean), Ok(max)) = (mean.parse(), max.parse()) {
                costs.push(Cost { method: method.into(), seed: seed.into(), mean, max });
            }
        }
    }
    costs
}
