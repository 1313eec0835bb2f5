//! Several plans as a table: the speeds of a shutter.

use shutter_fit::unit::{short, stops};

use crate::facts::Facts;
use crate::plan::Plan;
use crate::planned::Planned;

/// A row for each plan, under the names of what stands in it.
pub fn text(plans: &[(String, Planned)]) -> String {
    let row = |(name, planned): &(String, Planned)| {
        let unit = planned.unit;
        // Times without a curve tell of no exposure.
        let plan = planned.plan();
        let optional = |seconds: Option<f64>| seconds.map_or("-".into(), |seconds| unit.show(seconds));
        let delta = plan.and_then(|plan| Facts::new(plan).delta_ev);
        let percent = |plan: &Plan| short(100.0 * f64::from(plan.curve.efficiency()), 3) + " %";
        let triggers = planned.rows().len();
        [
            printable(name),
            optional(planned.nominal),
            optional(plan.map(|plan| plan.curve.exposure().into())),
            delta.map_or("-".into(), stops),
            plan.map_or("-".into(), percent),
            optional(planned.delay.map(|delay| delay.seconds)),
            match plan {
                Some(plan) => format!("{triggers} of {}", plan.most),
                None => format!("{triggers} as measured"),
            },
        ]
    };
    let header = ["scene", "nominal", "exposure TV", "ΔEV", "efficiency", "delay", "triggers"];
    columns(header, plans.iter().map(row))
}

/// A name on one line.
pub fn printable(name: &str) -> String {
    name.chars().filter(|c| !c.is_control()).collect()
}

/// The rows below their header, in columns: the first from the left, the others from the right.
pub fn columns<const N: usize>(header: [&str; N], rows: impl Iterator<Item = [String; N]>) -> String {
    let rows: Vec<_> = std::iter::once(header.map(String::from)).chain(rows).collect();
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
