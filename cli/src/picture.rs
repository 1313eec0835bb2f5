//! The plan as an SVG: openness over time in shares of equal exposure, and below it their sum.

mod set_ups;
pub mod style;
mod trace;

use std::error::Error;
use std::iter::once;
use std::ops::Range;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use crate::lamp::Lamp;
use crate::plan::{Plan, Trigger};
use crate::unit::{Unit, decimals, short, trimmed};
pub use set_ups::set_ups;
use style::{Area, BLUE, FAINT, GREY, Graph, INK, LIGHT, SHARES, VERMILION, dressed};
pub use trace::trace;

type Drawn = Result<(), Box<dyn Error>>;

const SIZE: (i32, i32) = (900, 704);
/// Drawn so much larger than it is shown, since the pen moves by whole units.
const SCALE: i32 = 8;
const HEADING: i32 = 88;
const OPENNESS: i32 = 330;

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
    let title = format!("Openness and exposure of the shutter {name} over time, with its triggers");
    picture(SIZE, &title, |page| {
        let (heading, rest) = page.split_vertically(HEADING * SCALE);
        let (upper, lower) = rest.split_vertically(OPENNESS * SCALE);
        write_heading(&heading, name, plan)?;
        draw_openness(&upper, plan)?;
        draw_cdf(&lower, plan)
    })
}

/// An SVG of this size with what `draw` draws on it.
fn picture(
    size: (i32, i32),
    title: &str,
    draw: impl FnOnce(&Area) -> Drawn,
) -> Result<String, Box<dyn Error>> {
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

fn write_heading(area: &Area, name: &str, plan: &Plan) -> Drawn {
    let unit = plan.unit();
    let facts = format!(
        "exposure {}, efficiency {} %, {}",
        unit.show(plan.curve.exposure()),
        short(100.0 * f64::from(plan.curve.efficiency()), 4),
        match plan.triggers.len() {
            1 => "1 trigger in the middle of the exposure".into(),
            n => format!("{n} triggers, each in the middle of an equal share of the exposure"),
        },
    );
    let middle = SIZE.0 * SCALE / 2;
    area.draw_text(name, &centred(19), (middle, 22 * SCALE))?;
    area.draw_text(&facts, &centred(14), (middle, 48 * SCALE))?;
    legend(area, plan)
}

/// What the signs of the upper graph mean.
fn legend(area: &Area, plan: &Plan) -> Drawn {
    let mut keys = vec![("openness", Key::Line), ("trigger", Key::Dot)];
    match plan.lamp {
        Lamp::Triggered => (),
        Lamp::Equal { .. } => keys.push(("lamp on", Key::Lamp)),
        Lamp::Doses { .. } => keys.push(("lamp on: equal doses", Key::Lamp)),
    }
    if plan.shape.inner.is_some() {
        keys.push(("control point and its handle", Key::Handle));
    }
    // By so much a letter is wide, at most.
    let width = |name: &str| 34 + 8 * name.len() as i32;
    let all: i32 = keys.iter().map(|(name, _)| width(name)).sum();
    let (mut x, y) = ((SIZE.0 - all) / 2 * SCALE, 74 * SCALE);
    for (name, key) in keys {
        let (from, middle, to) = (x, x + 11 * SCALE, x + 22 * SCALE);
        match key {
            Key::Line => area.draw(&PathElement::new([(from, y), (to, y)], pen(BLUE, 2.5)))?,
            Key::Dot => area.draw(&dot((middle, y)))?,
            Key::Lamp => area.draw(&Rectangle::new(
                [(from + 4 * SCALE, y - 6 * SCALE), (to - 4 * SCALE, y + 6 * SCALE)],
                lit(),
            ))?,
            Key::Handle => {
                area.draw(&PathElement::new([(from, y), (to, y)], pen(GREY, 2.0)))?;
                area.draw(&knob((to - 4 * SCALE, y)))?;
            }
        }
        let label = style::text(13 * SCALE, HPos::Left, VPos::Center);
        area.draw_text(name, &label, (to + 7 * SCALE, y))?;
        x += width(name) * SCALE;
    }
    Ok(())
}

enum Key {
    Line,
    Dot,
    Lamp,
    Handle,
}

fn draw_openness(area: &Area, plan: &Plan) -> Drawn {
    let (curve, unit) = (&plan.curve, plan.unit());
    let at = |t: f32| (unit.of(t), f64::from(curve.opening(t)));
    let ramps = plan.shape.ramps().map(|ramps| ramps.map(|ramp| ramp.points()));
    let heights = ramps.iter().flatten().flatten().map(|(_, y)| f64::from(*y));
    let (low, high) =
        heights.fold((0.0, 1.0), |(low, high): (f64, f64), y| (low.min(y), high.max(y)));
    let room = 0.05 * (high - low);
    let range = if low < 0.0 { low - room } else { 0.0 }..high + room;
    let mut graph = graph(area, plan, unit, "openness", None, range)?;
    let n = plan.triggers.len();
    let edge = |i: usize| curve.inverse_cdf(i as f32 / n as f32);
    let share = |i: usize| {
        Polygon::new(below(edge(i), edge(i + 1), POINTS / n + 2, unit, at), SHARES[i % 2])
    };
    graph.draw_series((0..n).map(share))?;
    graph.draw_series(pulses(plan).map(|(on, off)| match plan.lamp {
        Lamp::Doses { .. } => Polygon::new(below(on, off, 16, unit, at), lit()),
        _ => {
            let (on, off) = (unit.of(on), unit.of(off));
            Polygon::new(vec![(on, 0.0), (on, 1.0), (off, 1.0), (off, 0.0)], lit())
        }
    }))?;
    draw_curve(&mut graph, plan, unit, |t| curve.opening(t))?;
    let marks = plan.triggers.iter().map(|trigger| at(trigger.time));
    draw_marks(&mut graph, marks, |(t, f)| vec![(t, 0.0), (t, f)])?;
    for ramp in ramps.iter().flatten() {
        let points = ramp.map(|(t, y)| (unit.of(t), f64::from(y)));
        for [end, inner] in [[points[0], points[1]], [points[3], points[2]]] {
            graph.draw_series([PathElement::new([end, inner], pen(GREY, 2.0))])?;
            graph.draw_series([end, inner].map(knob))?;
        }
    }
    Ok(())
}

fn draw_cdf(area: &Area, plan: &Plan) -> Drawn {
    let (curve, unit) = (&plan.curve, plan.unit());
    let time = format!("time ({})", unit.name());
    let y = "fraction of the exposure";
    let mut graph = graph(area, plan, unit, y, Some(&time), 0.0..1.05)?;
    let left = time_range(plan, unit).start;
    draw_curve(&mut graph, plan, unit, |t| curve.cdf(t))?;
    let marks = plan.triggers.iter().map(|mark| (unit.of(mark.time), f64::from(mark.u)));
    // How a time is found: from the fraction to the curve, and down.
    draw_marks(&mut graph, marks, |(t, u)| vec![(left, u), (t, u), (t, 0.0)])
}

/// When the lamp is on, in seconds.
fn pulses(plan: &Plan) -> impl Iterator<Item = (f32, f32)> {
    let time = |ticks| (f64::from(plan.curve.open_start()) + plan.seconds(ticks)) as f32;
    let pulses = plan.triggers.iter().filter_map(|trigger: &Trigger| trigger.pulse);
    pulses.map(move |(on, off)| (time(on), time(off)))
}

/// What lies below the function `at` of time between two times.
fn below(
    from: f32,
    to: f32,
    points: usize,
    unit: Unit,
    at: impl Fn(f32) -> (f64, f64),
) -> Vec<(f64, f64)> {
    let top = steps(from, to, points).map(at);
    once((unit.of(from), 0.0)).chain(top).chain(once((unit.of(to), 0.0))).collect()
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
    graph.draw_series(marks.map(dot))?;
    Ok(())
}

/// An empty graph over the time of the plan. The upper shares the lower's name of the axis.
fn graph<'a, 'b>(
    area: &'a Area<'b>,
    plan: &Plan,
    unit: Unit,
    y: &str,
    x: Option<&str>,
    range: Range<f64>,
) -> Result<Graph<'a, 'b>, Box<dyn Error>> {
    let mut graph = ChartBuilder::on(area)
        .margin_left(16 * SCALE)
        .margin_right(24 * SCALE)
        .margin_top(8 * SCALE)
        .margin_bottom(8 * SCALE)
        .x_label_area_size(if x.is_some() { 50 } else { 28 } * SCALE)
        .y_label_area_size(60 * SCALE)
        .build_cartesian_2d(time_range(plan, unit), range)?;
    let places = decimals(unit.of(plan.length()), 3);
    graph
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(pen(FAINT, 1.0))
        .axis_style(pen(GREY, 1.0))
        .set_all_tick_mark_size(5 * SCALE)
        .label_style(style::font(14 * SCALE))
        .axis_desc_style(style::font(15 * SCALE))
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
fn steps(from: f32, to: f32, n: usize) -> impl Iterator<Item = f32> + Clone {
    (0..=n).map(move |i| from + (to - from) * (i as f32 / n as f32))
}

fn pen(color: RGBColor, width: f64) -> ShapeStyle {
    color.stroke_width((width * f64::from(SCALE)) as u32)
}

/// While the lamp is on.
fn lit() -> ShapeStyle {
    LIGHT.filled()
}

/// A trigger.
fn dot<C>(at: C) -> Circle<C, i32> {
    Circle::new(at, 4 * SCALE, VERMILION.filled())
}

/// A control point.
fn knob<C>(at: C) -> Circle<C, i32> {
    Circle::new(at, 5 * SCALE, pen(INK, 1.5))
}

fn centred(size: i32) -> TextStyle<'static> {
    style::text(size * SCALE, HPos::Center, VPos::Center)
}
