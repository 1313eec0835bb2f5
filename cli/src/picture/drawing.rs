//! What the program's pictures have in common: a plan's axis of time, curves, marks and legends.

use std::error::Error;
use std::iter::once;
use std::ops::Range;

use chart::plotters::prelude::*;
use chart::plotters::style::text_anchor::{HPos, VPos};
use chart::{Area, Axis, BLUE, Drawn, GREY, Graph, INK, LIGHT, SCALE, VERMILION, axes, pen, picture};
use shutter_curve::ShutterCurve;
use shutter_fit::unit::{decimals, trimmed};

use shutter_plan::plan::Plan;

/// The points along a curve, or along all shares of it.
pub const POINTS: usize = 800;
/// With more triggers than this, their marks would run into each other.
pub const MOST_MARKS: usize = 50;

/// What lies below the function `at` of time between two times.
pub fn below(from: f32, to: f32, points: usize, at: impl Fn(f32) -> (f64, f64)) -> Vec<(f64, f64)> {
    let ends = [from, to].map(|t| (at(t).0, 0.0));
    once(ends[0]).chain(steps(from, to, points).map(at)).chain(once(ends[1])).collect()
}

/// From just before to just after the curve, so that a jump at an end is drawn.
pub fn draw_curve(graph: &mut Graph, plan: &Plan, curve: &ShutterCurve, f: impl Fn(f32) -> f32) -> Drawn {
    let (start, end, zero) = (curve.open_start(), curve.close_end(), plan.origin());
    let times = once(start.next_down()).chain(steps(start, end, POINTS)).chain(once(end.next_up()));
    let line = times.map(|t| (plan.unit.of(f64::from(t) - zero), f64::from(f(t))));
    graph.draw_series(LineSeries::new(line, pen(BLUE, 2.5)))?;
    Ok(())
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

/// The axis of time: the interval, and a little room on either side. It begins or ends with the edge of the camera's
/// sync, where that is near.
pub fn time_range(plan: &Plan) -> Range<f64> {
    let [start, end] = [plan.start, plan.start + plan.length].map(|time| plan.unit.of(time - plan.origin()));
    let (start, end) = if is_near(plan) { (start.min(0.0), end.max(0.0)) } else { (start, end) };
    let room = 0.03 * (end - start);
    start - room..end + room
}

/// Can the edge of the sync, at 0, be on the axis without squeezing the curve?
pub fn is_near(plan: &Plan) -> bool {
    plan.sync.delay.is_some_and(|delay| delay.seconds.abs() <= 1.5 * plan.length)
}

/// So many steps from `from` to `to`, both ends included.
pub fn steps(from: f32, to: f32, n: usize) -> impl Iterator<Item = f32> + Clone {
    (0..=n).map(move |i| from + (to - from) * (i as f32 / n as f32))
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
fn legend(area: &Area, page: i32, keys: &[(&str, Key)]) -> Drawn {
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
        let label = chart::text(13 * SCALE, HPos::Left, VPos::Center);
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

/// An SVG of this size with what `draw` draws on it below a heading: the name of what is drawn, its facts, and signs.
pub(super) fn page(
    size: (i32, i32),
    title: &str,
    [name, facts]: [&str; 2],
    keys: &[(&str, Key)],
    draw: impl FnOnce(&Area) -> Drawn,
) -> Result<String, Box<dyn Error>> {
    picture(size, title, |page| {
        let (heading, rest) = page.split_vertically(if keys.is_empty() { 70 } else { 88 } * SCALE);
        let middle = size.0 * SCALE / 2;
        for (text, size, y) in [(name, 19, 22), (facts, 14, 48)] {
            let centred = chart::text(size * SCALE, HPos::Center, VPos::Center);
            heading.draw_text(text, &centred, (middle, y * SCALE))?;
        }
        legend(&heading, size.0, keys)?;
        draw(&rest)
    })
}
