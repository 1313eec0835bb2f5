//! How all pictures look, those of the program, the benchmarks and the fit's tables: pages, axes, pens and text, on
//! light and on dark backgrounds.

use std::error::Error;
use std::ops::Range;

pub use plotters;
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// What is drawn on.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// A graph with its axes.
pub type Graph<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// What was drawn is on the page.
pub type Drawn = Result<(), Box<dyn Error>>;

/// Drawn so much larger than it is shown, since the pen moves by whole units.
pub const SCALE: i32 = 8;
/// For the curve, and for what is ours.
pub const BLUE: RGBColor = RGBColor(0, 114, 178);
/// For what the lamp does, and for what others do.
pub const VERMILION: RGBColor = RGBColor(213, 94, 0);
/// Its light.
pub const LIGHT: RGBColor = RGBColor(240, 171, 124);
/// The two shades of neighbouring shares.
pub const SHARES: [RGBColor; 2] = [RGBColor(164, 211, 240), RGBColor(217, 238, 250)];
/// Text.
pub const INK: RGBColor = RGBColor(45, 51, 59);
/// Axes, handles and what is only compared with.
pub const GREY: RGBColor = RGBColor(120, 129, 139);
/// The lines of a grid.
pub const FAINT: RGBColor = RGBColor(232, 235, 239);

/// Each colour beside the one that it becomes on a dark background.
const DARK: [(RGBColor, RGBColor); 9] = [
    (WHITE, RGBColor(13, 17, 23)),
    (BLUE, RGBColor(77, 171, 247)),
    (VERMILION, RGBColor(255, 146, 72)),
    (LIGHT, RGBColor(158, 84, 36)),
    (SHARES[0], RGBColor(26, 62, 92)),
    (SHARES[1], RGBColor(18, 40, 60)),
    (INK, RGBColor(209, 215, 224)),
    (GREY, RGBColor(139, 148, 158)),
    (FAINT, RGBColor(38, 45, 54)),
];

/// An SVG of this size with what `draw` draws on it.
pub fn picture(size: (i32, i32), title: &str, draw: impl FnOnce(&Area) -> Drawn) -> Result<String, Box<dyn Error>> {
    let mut svg = String::new();
    let shown = (size.0 as u32, size.1 as u32);
    let drawn = (shown.0 * SCALE as u32, shown.1 * SCALE as u32);
    {
        let page = SVGBackend::with_string(&mut svg, drawn).into_drawing_area();
        page.fill(&WHITE)?;
        draw(&page)?;
        page.present()?;
    }
    Ok(dressed(&svg, drawn, shown, title))
}

/// A finished SVG as a page shows it: at the size `shown` of all that was `drawn`, with a title for those who hear it,
/// and with the colours of the page's background.
pub fn dressed(svg: &str, drawn: (u32, u32), shown: (u32, u32), title: &str) -> String {
    let size = |(width, height)| format!(r#"width="{width}" height="{height}""#);
    let svg = svg.replacen(&size(drawn), &format!(r#"{} role="img""#, size(shown)), 1);
    let title = title.replace('&', "&amp;").replace('<', "&lt;");
    let hex = |RGBColor(r, g, b): RGBColor| format!("#{r:02X}{g:02X}{b:02X}");
    let rules = DARK.map(|(light, dark)| {
        let (light, dark) = (hex(light), hex(dark));
        format!("[fill=\"{light}\"]{{fill:{dark}}}[stroke=\"{light}\"]{{stroke:{dark}}}\n")
    });
    let head = format!(
        "<title>{title}</title>\n<style>@media (prefers-color-scheme: dark) {{\n{}}}</style>\n",
        rules.concat()
    );
    match svg.find(">\n") {
        Some(end) => format!("{}{head}{}", &svg[..end + 2], &svg[end + 2..]),
        None => svg,
    }
}

/// An axis.
pub struct Axis<'a> {
    /// From where to where it goes.
    pub range: Range<f64>,
    /// What it shows.
    pub name: Option<&'a str>,
    /// How many numbers it has at most.
    pub labels: usize,
    /// How these are written.
    pub label: &'a dyn Fn(&f64) -> String,
}

/// An empty graph, with so much room for the numbers of the axis `y`. Without a name, `x` is that of the graph below.
pub fn axes<'a, 'b>(area: &'a Area<'b>, x: Axis, y: Axis, room: i32) -> Result<Graph<'a, 'b>, Box<dyn Error>> {
    let mut graph = ChartBuilder::on(area)
        .margin_left(16 * SCALE)
        .margin_right(24 * SCALE)
        .margin_top(8 * SCALE)
        .margin_bottom(8 * SCALE)
        .x_label_area_size(if x.name.is_some() { 50 } else { 28 } * SCALE)
        .y_label_area_size(room * SCALE)
        .build_cartesian_2d(x.range, y.range)?;
    graph
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(pen(FAINT, 1.0))
        .axis_style(pen(GREY, 1.0))
        .set_all_tick_mark_size(5 * SCALE)
        .label_style(font(14 * SCALE))
        .axis_desc_style(font(15 * SCALE))
        .x_desc(x.name.unwrap_or_default())
        .y_desc(y.name.unwrap_or_default())
        .x_labels(x.labels)
        .y_labels(y.labels)
        .x_label_formatter(x.label)
        .y_label_formatter(y.label)
        .draw()?;
    Ok(graph)
}

/// For lines of this width, as they are shown.
pub fn pen(color: RGBColor, width: f64) -> ShapeStyle {
    color.stroke_width((width * f64::from(SCALE)) as u32)
}

/// Text of this size.
pub fn font(size: i32) -> TextStyle<'static> {
    ("sans-serif", size).into_font().color(&INK)
}

/// Text of this size, by its place relative to the point it is put at.
pub fn text(size: i32, h: HPos, v: VPos) -> TextStyle<'static> {
    font(size).pos(Pos::new(h, v))
}
