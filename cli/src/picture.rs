//! The plan as an SVG: openness over time in shares of equal exposure, and below it their sum.

use std::error::Error;
use std::iter::once;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::plan::Plan;
use crate::unit::{Unit, decimals, short, trimmed};

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Graph<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;
type Drawn = Result<(), Box<dyn Error>>;

const SIZE: (i32, i32) = (900, 680);
/// Drawn so much larger and shown at `SIZE`, since the pen moves by whole units.
const SCALE: i32 = 8;
const HEADING: i32 = 64;
const OPENNESS: i32 = 330;

/// Colours that stay apart for colour-blind eyes, after Okabe and Ito.
const BLUE: RGBColor = RGBColor(0, 114, 178);
const VERMILION: RGBColor = RGBColor(213, 94, 0);
const SHARES: [RGBColor; 2] = [RGBColor(164, 211, 240), RGBColor(217, 238, 250)];
const INK: RGBColor = RGBColor(45, 51, 59);
const GREY: RGBColor = RGBColor(140, 149, 159);
const FAINT: RGBColor = RGBColor(232, 235, 239);

/// With more triggers than this, their marks would run into each other.
const MOST_MARKS: usize = 50;
/// The height of the ticks that stand for so many.
const TICK: f64 = 0.04;
/// The points along a curve, or along all shares of it.
const POINTS: usize = 800;

/// The plan of the scene `name`, as an SVG.
///
/// # Errors
/// Where it cannot be drawn.
pub fn svg(name: &str, plan: &Plan) -> Result<String, Box<dyn Error>> {
    let mut svg = String::new();
    let drawn = (SIZE.0 * SCALE, SIZE.1 * SCALE);
    {
        let page = SVGBackend::with_string(&mut svg, (drawn.0 as u32, drawn.1 as u32));
        let page = page.into_drawing_area();
        page.fill(&WHITE)?;
        let (heading, rest) = page.split_vertically(HEADING * SCALE);
        let (upper, lower) = rest.split_vertically(OPENNESS * SCALE);
        write_heading(&heading, name, plan)?;
        draw_openness(&upper, plan)?;
        draw_cdf(&lower, plan)?;
        page.present()?;
    }
    let size = |(width, height)| format!(r#"width="{width}" height="{height}""#);
    Ok(svg.replacen(&size(drawn), &size(SIZE), 1))
}

fn write_heading(area: &Area, name: &str, plan: &Plan) -> Drawn {
    let unit = plan.unit();
    let facts = format!(
        "exposure {}, efficiency {} %; triggers: {}, each in the middle of an equal share of the exposure",
        unit.show(plan.curve.exposure()),
        short(100.0 * f64::from(plan.curve.efficiency()), 4),
        plan.triggers.len(),
    );
    let middle = SIZE.0 * SCALE / 2;
    area.draw_text(name, &text(19), (middle, 22 * SCALE))?;
    area.draw_text(&facts, &text(14), (middle, 48 * SCALE))?;
    Ok(())
}

fn draw_openness(area: &Area, plan: &Plan) -> Drawn {
    let (curve, unit) = (&plan.curve, plan.unit());
    let at = |t: f32| (unit.of(t), f64::from(curve.opening(t)));
    let mut graph = graph(area, plan, unit, "openness", None)?;
    let n = plan.triggers.len();
    let edge = |i: usize| curve.inverse_cdf(i as f32 / n as f32);
    let share = |i: usize| {
        let (from, to) = (edge(i), edge(i + 1));
        let top = steps(from, to, POINTS / n + 2).map(at);
        let path = once((unit.of(from), 0.0)).chain(top).chain(once((unit.of(to), 0.0)));
        Polygon::new(path.collect::<Vec<_>>(), SHARES[i % 2])
    };
    graph.draw_series((0..n).map(share))?;
    draw_curve(&mut graph, plan, unit, |t| curve.opening(t))?;
    let marks = plan.triggers.iter().map(|trigger| at(trigger.time));
    draw_marks(&mut graph, marks, |(t, f)| vec![(t, 0.0), (t, f)])
}

fn draw_cdf(area: &Area, plan: &Plan) -> Drawn {
    let (curve, unit) = (&plan.curve, plan.unit());
    let time = format!("time ({})", unit.name);
    let mut graph = graph(area, plan, unit, "fraction of the exposure", Some(&time))?;
    let left = time_range(plan, unit).start;
    draw_curve(&mut graph, plan, unit, |t| curve.cdf(t))?;
    let marks = plan.triggers.iter().map(|mark| (unit.of(mark.time), f64::from(mark.u)));
    // How a time is found: from the fraction to the curve, and down.
    draw_marks(&mut graph, marks, |(t, u)| vec![(left, u), (t, u), (t, 0.0)])
}

/// From just before to just after the curve, so that a jump at an end is drawn.
fn draw_curve(graph: &mut Graph, plan: &Plan, unit: Unit, f: impl Fn(f32) -> f32) -> Drawn {
    let (start, end) = (plan.curve.open_start(), plan.curve.close_end());
    let times = once(start.next_down()).chain(steps(start, end, POINTS)).chain(once(end.next_up()));
    let line = times.map(|t| (unit.of(t), f64::from(f(t))));
    graph.draw_series(LineSeries::new(line, pen(BLUE, 2.5)))?;
    Ok(())
}

/// A line to each mark and a dot on it; ticks at the bottom where there are too many.
fn draw_marks(
    graph: &mut Graph,
    marks: impl ExactSizeIterator<Item = (f64, f64)> + Clone,
    line: impl Fn((f64, f64)) -> Vec<(f64, f64)>,
) -> Drawn {
    if marks.len() > MOST_MARKS {
        let tick = |(t, _)| PathElement::new([(t, 0.0), (t, TICK)], pen(VERMILION, 1.0));
        graph.draw_series(marks.map(tick))?;
        return Ok(());
    }
    graph
        .draw_series(marks.clone().map(|mark| PathElement::new(line(mark), pen(VERMILION, 1.2))))?;
    graph.draw_series(marks.map(|mark| Circle::new(mark, 4 * SCALE, VERMILION.filled())))?;
    Ok(())
}

/// An empty graph over the time of the plan, from 0 to 1. The upper shares the lower's name of the axis.
fn graph<'a, 'b>(
    area: &'a Area<'b>,
    plan: &Plan,
    unit: Unit,
    y: &str,
    x: Option<&str>,
) -> Result<Graph<'a, 'b>, Box<dyn Error>> {
    let mut graph = ChartBuilder::on(area)
        .margin_left(16 * SCALE)
        .margin_right(24 * SCALE)
        .margin_top(8 * SCALE)
        .margin_bottom(8 * SCALE)
        .x_label_area_size(if x.is_some() { 50 } else { 28 } * SCALE)
        .y_label_area_size(60 * SCALE)
        .build_cartesian_2d(time_range(plan, unit), 0.0..1.05)?;
    let places = decimals(unit.of(plan.length()), 3);
    graph
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(pen(FAINT, 1.0))
        .axis_style(pen(GREY, 1.0))
        .set_all_tick_mark_size(5 * SCALE)
        .label_style(font(14))
        .axis_desc_style(font(15))
        .x_desc(x.unwrap_or_default())
        .y_desc(y)
        .x_labels(11)
        .y_labels(6)
        .x_label_formatter(&|t| trimmed(*t, places))
        .y_label_formatter(&|y| format!("{y:.1}"))
        .draw()?;
    Ok(graph)
}

/// The axis of time: the interval, and a little room on either side.
fn time_range(plan: &Plan, unit: Unit) -> Range<f64> {
    let (start, end) = (unit.of(plan.curve.open_start()), unit.of(plan.curve.close_end()));
    let room = 0.03 * (end - start);
    start - room..end + room
}

/// So many steps from `from` to `to`, both ends included.
fn steps(from: f32, to: f32, n: usize) -> impl Iterator<Item = f32> {
    (0..=n).map(move |i| from + (to - from) * (i as f32 / n as f32))
}

fn pen(color: RGBColor, width: f64) -> ShapeStyle {
    color.stroke_width((width * f64::from(SCALE)) as u32)
}

fn font(size: i32) -> TextStyle<'static> {
    ("sans-serif", size * SCALE).into_font().color(&INK)
}

fn text(size: i32) -> TextStyle<'static> {
    font(size).pos(Pos::new(HPos::Center, VPos::Center))
}
