//! The plan as an SVG: openness over time in shares of equal exposure, and below it their sum.

mod drawing;
mod trace;

use std::error::Error;
use std::iter::once;
use std::ops::Range;

use chart::plotters::prelude::*;
use chart::plotters::style::text_anchor::{HPos, VPos};
use chart::{Area, BLUE, Drawn, GREY, Graph, INK, LIGHT, SCALE, SHARES, pen};
use shutter_curve::ShutterCurve;
use shutter_fit::unit::{count, short};

use crate::report::axis;
use drawing::{HANDLE, LAMP, MOST_MARKS, OPENNESS, TRIGGER, draw_marks, graph, page};
use shutter_plan::lamp::{FullyOpen, Lamp, SetUp};
use shutter_plan::plan::{Curve, Plan};
pub use trace::trace;

const SIZE: (i32, i32) = (900, 704);
const UPPER: i32 = 330;
/// The points along a curve, or along all shares of it.
const POINTS: usize = 800;
/// The height of the ticks that stand for so many.
const TICK: f64 = 0.04;

/// The plan of the scene `name`, as an SVG.
pub fn svg(name: &str, plan: &Plan) -> Result<String, Box<dyn Error>> {
    let Some(curve) = &plan.curve else {
        return Err("it is of a curve, and the scene has none; `shutter fit --picture` draws the trace with its \
                    triggers"
            .into());
    };
    let title = format!("Openness and exposure of the shutter {name} over time, with its triggers");
    let facts = format!(
        "exposure {}, efficiency {} %, {}",
        plan.unit.show(curve.exposure()),
        short(100.0 * f64::from(curve.efficiency()), 4),
        match plan.triggers.len() {
            n if plan.lamp == Lamp::FullyOpen => {
                format!("{} in equal steps while it is fully open", count(n as u64, "trigger"))
            }
            1 => "1 trigger in the middle of the exposure".into(),
            n => format!("{n} triggers, each in the middle of an equal share of the exposure"),
        },
    );
    let mut keys = vec![OPENNESS, TRIGGER];
    keys.extend(plan.lamp.has_pulses().then_some(LAMP));
    keys.extend(curve.shape.inner.map(|_| HANDLE));
    page(SIZE, &title, [name, &facts], &keys, |page| {
        let (upper, lower) = page.split_vertically(UPPER * SCALE);
        draw_openness(&upper, plan, curve)?;
        draw_cdf(&lower, plan, curve)
    })
}

fn draw_openness(area: &Area, plan: &Plan, Curve { shape, shutter: curve, .. }: &Curve) -> Drawn {
    let (unit, zero) = (plan.unit, plan.origin());
    let time = |t: f32| unit.of(f64::from(t) - zero);
    let at = |t: f32| (time(t), f64::from(curve.openness(t)));
    let ramps = shape.ramps().map(|ramps| ramps.map(|ramp| ramp.points()));
    let heights = ramps.iter().flatten().flatten().map(|(_, y)| f64::from(*y));
    let (low, high) = heights.fold((0.0, 1.0), |(low, high): (f64, f64), y| (low.min(y), high.max(y)));
    let room = 0.05 * (high - low);
    let range = if low < 0.0 { low - room } else { 0.0 }..high + room;
    let mut graph = graph(area, (None, time_range(plan)), ("openness", range), 60)?;
    let n = plan.triggers.len();
    let edge = |i: usize| match plan.lamp {
        Lamp::FullyOpen => FullyOpen::new(curve).time(i as f64 / n as f64) as f32,
        _ => curve.inverse_cdf(i as f32 / n as f32),
    };
    let share = |i: usize| Polygon::new(below(edge(i), edge(i + 1), POINTS / n + 2, at), SHARES[i % 2]);
    graph.draw_series((0..n).map(share))?;
    // Of a shutter in the light's path, the light that it lets through.
    let is_dimmed = matches!(plan.lamp, Lamp::Doses { .. }) || plan.scene.flashes.set_up == Some(SetUp::InPath);
    let lamp = |t: f32| if is_dimmed { at(t) } else { (time(t), 1.0) };
    let seconds = |ticks| (plan.start + plan.seconds(ticks)) as f32;
    graph.draw_series(
        plan.pulses().map(|(on, off)| Polygon::new(below(seconds(on), seconds(off), 16, lamp), LIGHT.filled())),
    )?;
    draw_curve(&mut graph, plan, curve, |t| curve.openness(t))?;
    draw_sync(&mut graph, plan)?;
    let marks = plan.triggers.iter().map(|trigger| at(trigger.time as f32));
    draw_triggers(&mut graph, marks, |(t, f)| vec![(t, 0.0), (t, f)])?;
    for ramp in ramps.iter().flatten() {
        let points = ramp.map(|(t, y)| (time(t), f64::from(y)));
        for [end, inner] in [[points[0], points[1]], [points[3], points[2]]] {
            graph.draw_series([PathElement::new([end, inner], pen(GREY, 2.0))])?;
            graph.draw_series([end, inner].map(|at| Circle::new(at, 5 * SCALE, pen(INK, 1.5))))?;
        }
    }
    Ok(())
}

/// The edge of the camera's sync, and the delay from there to the start of opening.
fn draw_sync(graph: &mut Graph, plan: &Plan) -> Drawn {
    let unit = plan.unit;
    let Some(delay) = plan.sync.delay else { return Ok(()) };
    let (edge, start) = (0.0, unit.of(delay.seconds));
    let label = chart::text(13 * SCALE, HPos::Left, VPos::Bottom);
    let is_near = is_near(plan);
    let from = if is_near { edge } else { time_range(plan).start };
    if is_near {
        graph.draw_series([PathElement::new([(edge, 0.0), (edge, 1.0)], pen(INK, 2.0))])?;
    }
    // An arrow whose tip is the start of opening.
    let (y, tip) = (0.62, 0.012 * unit.of(plan.length));
    let head = [(start - tip, y + 0.025), (start, y), (start - tip, y - 0.025)];
    graph.draw_series([PathElement::new([(from, y), (start, y)], pen(INK, 1.2))])?;
    graph.draw_series([PathElement::new(head, pen(INK, 1.2))])?;
    let sync = if is_near { "sync".into() } else { format!("sync {} before", unit.show(delay.seconds)) };
    let words = [(sync, 0.9), (format!("delay {}", unit.show(delay.seconds)), y)];
    for (words, y) in words.into_iter().take(if is_near { 2 } else { 1 }) {
        let place = EmptyElement::at((from, y));
        graph.draw_series([place + Text::new(words, (6 * SCALE, -4 * SCALE), label.clone())])?;
    }
    Ok(())
}

fn draw_cdf(area: &Area, plan: &Plan, Curve { shutter: curve, .. }: &Curve) -> Drawn {
    let (unit, zero) = (plan.unit, plan.origin());
    let (name, range) = (axis(plan), time_range(plan));
    let left = range.start;
    let mut graph = graph(area, (Some(&name), range), ("fraction of the exposure", 0.0..1.05), 60)?;
    draw_curve(&mut graph, plan, curve, |t| curve.cdf(t))?;
    let marks = plan.triggers.iter().map(|mark| (unit.of(mark.time - zero), mark.u.unwrap_or_default().into()));
    // How a time is found: from the fraction to the curve, and down.
    draw_triggers(&mut graph, marks, |(t, u)| vec![(left, u), (t, u), (t, 0.0)])
}

/// What lies below the function `at` of time between two times.
fn below(from: f32, to: f32, points: usize, at: impl Fn(f32) -> (f64, f64)) -> Vec<(f64, f64)> {
    let ends = [from, to].map(|t| (at(t).0, 0.0));
    once(ends[0]).chain(steps(from, to, points).map(at)).chain(once(ends[1])).collect()
}

/// So many steps from `from` to `to`, both ends included.
fn steps(from: f32, to: f32, n: usize) -> impl Iterator<Item = f32> {
    (0..=n).map(move |i| from + (to - from) * (i as f32 / n as f32))
}

/// From just before to just after the curve, so that a jump at an end is drawn.
fn draw_curve(graph: &mut Graph, plan: &Plan, curve: &ShutterCurve, f: impl Fn(f32) -> f32) -> Drawn {
    let (start, end, zero) = (curve.open_start(), curve.close_end(), plan.origin());
    let times = once(start.next_down()).chain(steps(start, end, POINTS)).chain(once(end.next_up()));
    let line = times.map(|t| (plan.unit.of(f64::from(t) - zero), f64::from(f(t))));
    graph.draw_series(LineSeries::new(line, pen(BLUE, 2.5)))?;
    Ok(())
}

/// The axis of time: the interval, and a little room on either side. It begins or ends with the edge of the camera's
/// sync, where that is near.
fn time_range(plan: &Plan) -> Range<f64> {
    let [start, end] = [plan.start, plan.start + plan.length].map(|time| plan.unit.of(time - plan.origin()));
    let (start, end) = if is_near(plan) { (start.min(0.0), end.max(0.0)) } else { (start, end) };
    let room = 0.03 * (end - start);
    start - room..end + room
}

/// Can the edge of the sync, at 0, be on the axis without squeezing the curve?
fn is_near(plan: &Plan) -> bool {
    plan.sync.delay.is_some_and(|delay| delay.seconds.abs() <= 1.5 * plan.length)
}

/// A line to each mark and a dot on it; ticks at the bottom where there are too many.
fn draw_triggers(
    graph: &mut Graph,
    marks: impl ExactSizeIterator<Item = (f64, f64)> + Clone,
    line: impl Fn((f64, f64)) -> Vec<(f64, f64)>,
) -> Drawn {
    let is_many = marks.len() > MOST_MARKS;
    let line = |(t, y)| if is_many { vec![(t, 0.0), (t, TICK)] } else { line((t, y)) };
    draw_marks(graph, marks, line)
}
