//! What all pictures are drawn with, those of the benchmarks as well: the page, a graph, pens and marks.

use std::error::Error;
use std::iter::once;
use std::ops::Range;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use shutter_fit::unit::{Unit, decimals, trimmed};

use super::style::{self, Area, BLUE, FAINT, GREY, Graph, INK, LIGHT, VERMILION, dressed};
use crate::plan::Plan;

/// What was drawn is on the page.
pub type Drawn = Result<(), Box<dyn Error>>;

/// Drawn so much larger than it is shown, since the pen moves by whole units.
pub const SCALE: i32 = 8;
/// The points along a curve, or along all shares of it.
pub const POINTS: usize = 800;
/// With more triggers than this, their marks would run into each other.
pub const MOST_MARKS: usize = 50;

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

/// What lies below the function `at` of time between two times.
pub fn below(from: f32, to: f32, points: usize, unit: Unit, at: impl Fn(f32) -> (f64, f64)) -> Vec<(f64, f64)> {
    let top = steps(from, to, points).map(at);
    once((unit.of(from), 0.0)).chain(top).chain(once((unit.of(to), 0.0))).collect()
}

/// From just before to just after the curve, so that a jump at an end is drawn.
pub fn draw_curve(graph: &mut Graph, plan: &Plan, f: impl Fn(f32) -> f32) -> Drawn {
    let (start, end) = (plan.curve.open_start(), plan.curve.close_end());
    let times = once(start.next_down()).chain(steps(start, end, POINTS)).chain(once(end.next_up()));
    let line = times.map(|t| (plan.unit.of(t), f64::from(f(t))));
    graph.draw_series(LineSeries::new(line, pen(BLUE, 2.5)))?;
    Ok(())
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
        .label_style(style::font(14 * SCALE))
        .axis_desc_style(style::font(15 * SCALE))
        .x_desc(x.name.unwrap_or_default())
        .y_desc(y.name.unwrap_or_default())
        .x_labels(x.labels)
        .y_labels(y.labels)
        .x_label_formatter(x.label)
        .y_label_formatter(y.label)
        .draw()?;
    Ok(graph)
}

/// An empty graph over the time of the plan.
pub fn graph<'a, 'b>(
    area: &'a Area<'b>,
    plan: &Plan,
    y: &str,
    x: Option<&str>,
    range: Range<f64>,
) -> Result<Graph<'a, 'b>, Box<dyn Error>> {
    let places = decimals(plan.unit.of(plan.length), 3);
    let time = Axis { range: time_range(plan), name: x, labels: 11, label: &|t| trimmed(*t, places) };
    axes(area, time, Axis { range, name: Some(y), labels: 6, label: &|y| format!("{y:.1}") }, 60)
}

/// The axis of time: the interval, and a little room on either side.
pub fn time_range(plan: &Plan) -> Range<f64> {
    let unit = plan.unit;
    let (start, end) = (unit.of(plan.curve.open_start()), unit.of(plan.curve.close_end()));
    let start = sync(plan).filter(|edge| is_near(plan, *edge)).unwrap_or(start);
    let room = 0.03 * (end - start);
    start - room..end + room
}

/// The edge of the camera's sync on the plan's axis of time.
pub fn sync(plan: &Plan) -> Option<f64> {
    let unit = plan.unit;
    plan.delay.map(|delay| unit.of(plan.curve.open_start()) - unit.of(delay.seconds))
}

/// Can the edge be on the axis without squeezing the curve?
pub fn is_near(plan: &Plan, edge: f64) -> bool {
    plan.unit.of(plan.curve.open_start()) - edge <= 1.5 * plan.unit.of(plan.length)
}

/// So many steps from `from` to `to`, both ends included.
pub fn steps(from: f32, to: f32, n: usize) -> impl Iterator<Item = f32> + Clone {
    (0..=n).map(move |i| from + (to - from) * (i as f32 / n as f32))
}

/// For lines of this width, as they are shown.
pub fn pen(color: RGBColor, width: f64) -> ShapeStyle {
    color.stroke_width((width * f64::from(SCALE)) as u32)
}

/// While the lamp is on.
pub fn lit() -> ShapeStyle {
    LIGHT.filled()
}

/// A trigger.
pub fn dot<C>(at: C) -> Circle<C, i32> {
    Circle::new(at, 4 * SCALE, VERMILION.filled())
}

/// A control point.
pub fn knob<C>(at: C) -> Circle<C, i32> {
    Circle::new(at, 5 * SCALE, pen(INK, 1.5))
}

/// A sign of a graph.
pub(super) enum Key {
    Line,
    Trace,
    Dot,
    Lamp,
    Handle,
}

/// What the signs mean, below the heading on a page of this width.
pub(super) fn legend(area: &Area, page: i32, keys: &[(&str, Key)]) -> Drawn {
    // By so much a letter is wide, at most.
    let width = |name: &str| 34 + 8 * name.len() as i32;
    let all: i32 = keys.iter().map(|(name, _)| width(name)).sum();
    let (mut x, y) = ((page - all) / 2 * SCALE, 74 * SCALE);
    for (name, key) in keys {
        let (from, middle, to) = (x, x + 11 * SCALE, x + 22 * SCALE);
        let line = |color, width| PathElement::new([(from, y), (to, y)], pen(color, width));
        match key {
            Key::Line => area.draw(&line(BLUE, 2.5))?,
            Key::Trace => area.draw(&line(GREY, 1.2))?,
            Key::Dot => area.draw(&dot((middle, y)))?,
            Key::Lamp => {
                area.draw(&Rectangle::new([(from + 4 * SCALE, y - 6 * SCALE), (to - 4 * SCALE, y + 6 * SCALE)], lit()))?
            }
            Key::Handle => {
                area.draw(&line(GREY, 2.0))?;
                area.draw(&knob((to - 4 * SCALE, y)))?;
            }
        }
        let label = style::text(13 * SCALE, HPos::Left, VPos::Center);
        area.draw_text(name, &label, (to + 7 * SCALE, y))?;
        x += width(name) * SCALE;
    }
    Ok(())
}

/// A line to each mark, and a dot on it where these do not run into each other.
pub fn draw_marks(
    graph: &mut Graph,
    marks: impl ExactSizeIterator<Item = (f64, f64)> + Clone,
    line: impl Fn((f64, f64)) -> Vec<(f64, f64)>,
) -> Drawn {
    let lines = marks.clone().map(|mark| PathElement::new(line(mark), pen(VERMILION, 1.2)));
    graph.draw_series(lines)?;
    if marks.len() <= MOST_MARKS {
        graph.draw_series(marks.map(dot))?;
    }
    Ok(())
}

/// The name of what is drawn, and its facts, on a page of this width.
pub fn write_heading(area: &Area, width: i32, name: &str, facts: &str) -> Drawn {
    let middle = width * SCALE / 2;
    for (text, size, y) in [(name, 19, 22), (facts, 14, 48)] {
        let centred = style::text(size * SCALE, HPos::Center, VPos::Center);
        area.draw_text(text, &centred, (middle, y * SCALE))?;
    }
    Ok(())
}
