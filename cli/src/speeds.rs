//! Several plans as a table: the speeds of a shutter.

use shutter_fit::unit::{short, stops};

use crate::facts::Facts;
use crate::planned::Planned;

/// A row for each plan, under the names of what stands in it.
pub fn text(plans: &[(String, Planned)]) -> String {
    let row = |(name, planned): &(String, Planned)| {
        let unit = planned.unit;
        // Times without a curve tell of no exposure.
        let by_curve = planned.plan().map(|plan| (plan, Facts::new(plan)));
        let facts = by_curve.as_ref().map(|(_, facts)| facts);
        let optional =
            |seconds: Option<f64>| seconds.map_or("-".into(), |seconds| unit.show(seconds));
        let delta = facts.and_then(|facts| facts.delta_ev);
        let efficiency = facts.map(|facts| format!("{} %", short(100.0 * facts.efficiency, 3)));
        let triggers = planned.rows().len();
        let name: String = name.chars().filter(|c| !c.is_control()).collect();
        [
            name,
            optional(planned.nominal),
            optional(facts.map(|facts| facts.exposure)),
            delta.map_or("-".into(), stops),
            efficiency.unwrap_or("-".into()),
            optional(planned.delay.map(|delay| delay.seconds)),
            match by_curve {
                Some((plan, _)) => format!("{triggers} of {}", plan.most),
                None => format!("{triggers} as measured"),
            },
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
