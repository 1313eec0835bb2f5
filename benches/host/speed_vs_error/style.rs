//! How all the pictures look.

use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub type Chart<'a, 'b> =
    ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Drawn at twice the size, since the pen moves by whole units; whoever shows a picture scales it.
pub const SCALE: i32 = 2;

pub const INK: RGBColor = RGBColor(45, 51, 59);
pub const FAINT: RGBColor = RGBColor(232, 235, 239);
pub const GREY: RGBColor = RGBColor(140, 149, 159);
pub const BLUE: RGBColor = RGBColor(9, 105, 218);
pub const ORANGE: RGBColor = RGBColor(225, 111, 36);

/// Text, by its size and its place relative to the point it is put at.
pub fn text(size: i32, h: HPos, v: VPos) -> TextStyle<'static> {
    ("sans-serif", size * SCALE).into_font().color(&INK).pos(Pos::new(h, v))
}

/// An empty picture.
pub fn picture(path: &str, size: (u32, u32)) -> Area<'_> {
    let scale = SCALE as u32;
    let area = SVGBackend::new(path, (size.0 * scale, size.1 * scale)).into_drawing_area();
    area.fill(&WHITE).expect("a picture");
    area
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
        .label_style(("sans-serif", 13 * SCALE).into_font().color(&INK))
        .axis_desc_style(("sans-serif", 14 * SCALE).into_font().color(&INK))
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
        .label_font(("sans-serif", 13 * SCALE).into_font().color(&INK))
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
