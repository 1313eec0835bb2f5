//! How the report's pictures look: as those of `shutter`.

use std::ops::Range;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use shutter::picture::style::{self, dressed};
pub use shutter::picture::style::{Area, BLUE, FAINT, GREY, Graph as Chart, INK, VERMILION};

/// Drawn at twice the size, since the pen moves by whole units.
pub const SCALE: i32 = 2;

/// Text, by its size and its place relative to the point it is put at.
pub fn text(size: i32, h: HPos, v: VPos) -> TextStyle<'static> {
    style::text(size * SCALE, h, v)
}

/// A picture of this size and title, with what `draw` draws on it.
pub fn picture(path: &str, size: (u32, u32), title: &str, draw: impl FnOnce(&Area)) {
    let mut svg = String::new();
    let drawn = (size.0 * SCALE as u32, size.1 * SCALE as u32);
    {
        let area = SVGBackend::with_string(&mut svg, drawn).into_drawing_area();
        area.fill(&WHITE).expect("a picture");
        draw(&area);
        area.present().expect("a picture");
    }
    std::fs::write(path, dressed(&svg, drawn, size, title)).expect("the picture is written");
}

/// An axis: what it shows, from where to where, and how its numbers are written.
pub struct Axis {
    pub name: &'static str,
    pub range: Range<f64>,
    pub label: fn(&f64) -> String,
    pub labels: usize,
}

impl Axis {
    pub fn plain(name: &'static str, range: Range<f64>) -> Self {
        Self { name, range, label: |x| format!("{}", (x * 1000.0).round() / 1000.0), labels: 6 }
    }

    /// An axis that counts decades: 10 to the power of its numbers.
    pub fn decades(name: &'static str, range: Range<f64>) -> Self {
        let labels = (range.end - range.start).ceil() as usize + 1;
        Self { name, range, label: |x| power(*x), labels }
    }
}

pub fn chart<'a, 'b>(area: &Area<'b>, title: &str, x: &Axis, y: &Axis) -> Chart<'a, 'b> {
    let mut chart = ChartBuilder::on(area)
        .caption(title, text(17, HPos::Center, VPos::Center))
        .margin(12 * SCALE)
        .x_label_area_size(46 * SCALE)
        .y_label_area_size(62 * SCALE)
        .build_cartesian_2d(x.range.clone(), y.range.clone())
        .expect("a chart");
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(FAINT.stroke_width(2))
        .axis_style(GREY.stroke_width(2))
        .label_style(style::font(13 * SCALE))
        .axis_desc_style(style::font(14 * SCALE))
        .x_desc(x.name)
        .y_desc(y.name)
        .x_labels(x.labels)
        .y_labels(y.labels)
        .x_label_formatter(&x.label)
        .y_label_formatter(&y.label)
        .draw()
        .expect("axes");
    chart
}

/// The legend, in a corner.
pub fn legend<'a, 'b: 'a>(chart: &mut Chart<'a, 'b>, position: SeriesLabelPosition) {
    chart
        .configure_series_labels()
        .position(position)
        .background_style(WHITE.mix(0.85))
        .border_style(FAINT)
        .legend_area_size(30 * SCALE)
        .margin(8 * SCALE)
        .label_font(style::font(13 * SCALE))
        .draw()
        .expect("a legend");
}

/// 10 to the power of a whole number, as one writes it.
fn power(exponent: f64) -> String {
    let exponent = exponent.round() as i32;
    if (0..=3).contains(&exponent) {
        return 10i32.pow(exponent as u32).to_string();
    }
    let raised = exponent
        .to_string()
        .chars()
        .map(|c| match c {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            digit => char::from_u32(u32::from(digit) - u32::from('0') + 0x2070).unwrap_or(digit),
        })
        .collect::<String>();
    format!("10{raised}")
}
