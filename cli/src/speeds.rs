//! Several plans as a table: the speeds of a shutter.

use crate::facts::Facts;
use crate::plan::Plan;
use crate::unit::short;

/// A row for each plan, under the names of what stands in it.
pub fn text(plans: &[(String, Plan)]) -> String {
    let row = |(name, plan): &(String, Plan)| {
        let (facts, unit) = (Facts::new(plan), plan.unit());
        let optional =
            |seconds: Option<f64>| seconds.map_or("-".into(), |seconds| unit.show(seconds));
        let delta = facts.delta_ev.map_or("-".into(), |delta| format!("{delta:+.2}"));
        let name: String = name.chars().filter(|c| !c.is_control()).collect();
        [
            name,
            optional(plan.nominal),
            unit.show(facts.exposure),
            delta,
            format!("{} %", short(100.0 * facts.efficiency, 3)),
            optional(plan.delay.map(|delay| delay.seconds)),
            format!("{} of {}", plan.triggers.len(), plan.most),
        ]
    };
    let header = ["scene", "nominal", "exposure TV", "ΔEV", "efficiency", "delay", "triggers"];
    let mut rows = vec![header.map(String::from)];
    rows.extend(plans.iter().map(row));
    columns(&rows)
}

/// The rows with their columns below each other: the first from the left, the others from the right.
pub fn columns<const N: usize>(rows: &[[String; N]]) -> String {
    let width = |i: usize| rows.iter().map(|row| row[i].chars().count()).max().unwrap_or_default();
    let widths: [usize; N] = std::array::from_fn(width);
    let line = |row: &[String; N]| {
        let cells = row.iter().zip(widths).enumerate().map(|(i, (cell, width))| match i {
            0 => format!("{cell:width$}"),
            _ => format!("  {cell:>width$}"),
        });
        cells.collect::<String>().trim_end().to_string() + "\n"
    };
    rows.iter().map(line).collect()
}
