//! The picture of the report.

use chart::plotters::prelude::*;
use chart::plotters::style::text_anchor::{HPos, VPos};
use chart::{Area, Axis, BLUE, GREY, INK, SCALE, VERMILION, axes, pen, picture};

use crate::Result;
use crate::methods::METHODS;
use crate::report::Measured;

/// Where the methods' names are, beside the dots of their greatest errors: apart where two dots come close.
const NAMES: [(i32, i32, HPos); METHODS.len()] = [
    (9, 0, HPos::Left),
    (0, -13, HPos::Center),
    (0, -27, HPos::Center),
    // Below the ring.
    (0, 59, HPos::Center),
    (-9, -5, HPos::Right),
    (-14, 54, HPos::Center),
    (9, 0, HPos::Left),
    (-9, 10, HPos::Right),
];

/// A power of ten, of 1 or less.
fn power(exponent: f64) -> String {
    match "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(-exponent.round() as usize) {
        None | Some('⁰') => "1".into(),
        Some(raised) => format!("10⁻{raised}"),
    }
}

/// Error against time and against cycles: the greatest (full) and the mean error (ring) of each method, over what a
/// sample costs.
pub fn frontier(measured: &Measured) -> Result<String> {
    let title = "Error against time and against cycles: this crate and its peers";
    picture((1240, 520), title, |page| {
        let areas = page.split_evenly((1, 2));
        panel(&areas[0], "nanoseconds a sample on the host, soft curve", &measured.times, measured)?;
        panel(&areas[1], "mean cycles a sample on a Cortex-M4F (model), soft curve", &measured.cycles, measured)?;
        legend(&areas[1])
    })
}

fn panel(area: &Area, name: &str, costs: &[f64], measured: &Measured) -> Result {
    let logs = costs.iter().map(|cost| cost.log2());
    let low = logs.clone().fold(f64::INFINITY, f64::min);
    let high = logs.fold(f64::NEG_INFINITY, f64::max);
    let label = |x: &f64| format!("{:.0}", 2f64.powf(x.round()));
    let x = Axis { range: low - 1.8..high + 1.4, name: Some(name), labels: 11, label: &label };
    let y =
        Axis { range: -9.5..0.5, name: Some("error, as a share of the interval"), labels: 6, label: &|y| power(*y) };
    let mut graph = axes(area, x, y, 62)?;
    for (((method, errors), cost), (dx, dy, h)) in METHODS.iter().zip(&measured.errors).zip(costs).zip(NAMES) {
        let color = method.color;
        let [most, mean] = [errors.greatest, errors.mean].map(|error| (cost.log2(), error.max(1e-10).log10()));
        graph.draw_series([PathElement::new([most, mean], color.mix(0.4).stroke_width(2 * SCALE as u32))])?;
        graph.draw_series([
            Circle::new(most, 5 * SCALE, color.filled()),
            Circle::new(mean, 4 * SCALE, pen(color, 2.0)),
        ])?;
        let text = chart::text(13 * SCALE, h, VPos::Center);
        let name = method.name.replace('`', "").replace("inverse_cdf, ", "");
        let name = Text::new(name, (dx * SCALE, dy * SCALE), text);
        graph.draw_series([EmptyElement::at(most) + name])?;
    }
    Ok(())
}

/// Names colours and signs, where there is room.
fn legend(area: &Area) -> Result {
    for (row, (name, style)) in [
        ("this crate", BLUE.filled()),
        ("others, for every curve", VERMILION.filled()),
        ("square roots, on a trapezoid", GREY.filled()),
        ("greatest error", INK.filled()),
        ("mean error", pen(INK, 2.0)),
    ]
    .into_iter()
    .enumerate()
    {
        let (x, y) = (380 * SCALE, (170 + 22 * row as i32) * SCALE);
        area.draw(&Circle::new((x, y), 9 * SCALE / 2, style))?;
        let text = chart::text(13 * SCALE, HPos::Left, VPos::Center);
        area.draw(&Text::new(name, (x + 14 * SCALE, y), text))?;
    }
    Ok(())
}
