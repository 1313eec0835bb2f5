//! Several plans as a table: the speeds of a shutter.

use shutter_fit::unit::{short, stops};

use shutter_plan::facts::Facts;
use shutter_plan::plan::Plan;

/// A row for each plan, under the names of what stands in it.
pub fn text(plans: &[(String, Plan)]) -> String {
    let row = |(name, plan): &(String, Plan)| {
        let (facts, unit) = (Facts::new(plan), plan.unit);
        // Times without a curve tell of no exposure.
        let time = |key| facts.number(key).map_or("-".into(), |seconds| unit.show(seconds));
        let triggers = plan.triggers.len();
        [
            printable(name),
            time("nominal_s"),
            time("exposure_s"),
            facts.number("delta_ev").map_or("-".into(), stops),
            facts.number("efficiency").map_or("-".into(), |part| short(100.0 * part, 3) + " %"),
            time("delay_s"),
            match &plan.curve {
                Some(curve) => format!("{triggers} of {}", curve.most),
                None => format!("{triggers} as measured"),
            },
        ]
    };
    let header = ["scene", "nominal", "exposure TV", "ΔEV", "efficiency", "delay", "triggers"];
    table(header, plans.iter().map(row))
}

/// A name on one line.
pub fn printable(name: &str) -> String {
    name.chars().filter(|c| !c.is_control()).collect()
}

/// The lines of a header and of the rows below it, in columns: the first from the left, the others from the right.
pub fn columns(header: Vec<String>, rows: Vec<Vec<String>>) -> Vec<String> {
    let rows = [vec![header], rows].concat();
    let width = |i: usize| rows.iter().map(|row| row[i].chars().count()).max().unwrap_or_default();
    let widths: Vec<usize> = (0..rows[0].len()).map(width).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).enumerate().map(|(i, (cell, width))| match i {
            0 => format!("{cell:width$}"),
            _ => format!("  {cell:>width$}"),
        });
        cells.collect::<String>().trim_end().to_string() + "\n"
    };
    rows.iter().map(line).collect()
}

/// The same as one text.
pub fn table<const N: usize>(header: [&str; N], rows: impl Iterator<Item = [String; N]>) -> String {
    columns(header.map(String::from).to_vec(), rows.map(Vec::from).collect()).concat()
}
