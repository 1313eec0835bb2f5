//! The picture of docs/internals/fit.md.

use std::error::Error;

use chart::plotters::prelude::{LineSeries, PathElement, RGBColor, SeriesLabelPosition, Text};
use chart::plotters::style::text_anchor::{HPos, VPos};
use chart::{Axis, SCALE};

use crate::shutters::TUNED;

/// The errors of each shutter's traces, by the share of traces that do better.
pub fn picture(errors: [Vec<f64>; 7]) -> Result<String, Box<dyn Error>> {
    let colors = [0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7, 0xE69F00, 0x56B4E9, 0x78818B]
        .map(|rgb: u32| RGBColor((rgb >> 16) as u8, (rgb >> 8) as u8, rgb as u8));
    let label = |x: &f64| format!("{}", (1e3 * 10f64.powf(*x)).round() / 1e3);
    let error = Axis {
        range: -3.0..0.3,
        name: Some("error of the trigger times, rms (% of the exposure)"),
        labels: 4,
        label: &label,
    };
    let percent = |share: &f64| format!("{:.0} %", 100.0 * share);
    let share =
        Axis { range: 0.0..1.0, name: Some("share of the traces that are better"), labels: 10, label: &percent };
    chart::picture((900, 480), "Errors of the trigger times of fitted traces, by shutter", |page| {
        let mut graph = chart::axes(page, error, share, 72)?;
        // What is required.
        for (error, share) in [(0.05f64, 0.5), (0.3, 0.9)] {
            let x = error.log10();
            graph
                .draw_series([PathElement::new([(-3.0, share), (x, share), (x, 0.0)], chart::pen(chart::INK, 1.0))])?;
            let name = format!("{} within {error} %", percent(&share));
            let place = chart::text(13 * SCALE, HPos::Left, VPos::Top);
            graph.draw_series([Text::new(name, (x + 0.02, share - 0.01), place)])?;
        }
        for ((shutter, color), mut errors) in TUNED.into_iter().zip(colors).zip(errors) {
            errors.sort_by(f64::total_cmp);
            let n = errors.len() as f64;
            let share = |i: usize| (i as f64 + 0.5) / n;
            let line = errors.into_iter().enumerate().map(|(i, error)| ((100.0 * error).log10().max(-3.0), share(i)));
            let pen = chart::pen(color, 2.0);
            let legend = move |(x, y)| PathElement::new([(x, y), (x + 22 * SCALE, y)], pen);
            graph.draw_series(LineSeries::new(line, pen))?.label(shutter).legend(legend);
        }
        let mut labels = graph.configure_series_labels();
        labels.position(SeriesLabelPosition::LowerRight).label_font(chart::font(14 * SCALE));
        labels.legend_area_size(30 * SCALE).margin(12 * SCALE).draw()?;
        Ok(())
    })
}
