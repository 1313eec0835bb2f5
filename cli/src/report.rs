//! The plan as text for a terminal: its facts, the drawing, the table.

use std::fmt::{self, Display, Write};
use std::iter::once;

use textplots::{Chart, LabelBuilder, LabelFormat, Plot, Shape};

use crate::facts;
use crate::lamp::Lamp;
use crate::plan::{Plan, Trigger};
use crate::rows::hidden_rows;
use crate::unit::{Unit, decimals, short};

/// With more triggers than this, a full line at each would hide the curve.
const MOST_LINES: usize = 36;
/// The drawing's size in dots, 2 by 4 a character: with its labels it fits in 80 columns.
const DOTS: (u32, u32) = (143, 39);

/// The plan of the scene `name`, for a terminal.
pub fn text(name: &str, plan: &Plan) -> String {
    let mut text = String::new();
    write_text(&mut text, name, plan).expect("a string takes all");
    text
}

fn write_text(out: &mut String, name: &str, plan: &Plan) -> fmt::Result {
    let unit = plan.unit();
    for (name, fact) in facts::lines(name, plan) {
        writeln!(out, "{name:11}  {fact}")?;
    }
    let curve = &plan.curve;
    writeln!(out, "\nopenness over time ({}), a line at each trigger", unit.name())?;
    out.push_str(&drawing(plan, unit, |t| curve.opening(t)));
    writeln!(out, "\nfraction of the exposure collected over time ({})", unit.name())?;
    out.push_str(&drawing(plan, unit, |t| curve.cdf(t)));
    writeln!(out)?;
    table(out, plan, unit)
}

/// The function `f` of time with a line up to it at each trigger.
fn drawing(plan: &Plan, unit: Unit, f: impl Fn(f32) -> f32) -> String {
    let curve = &plan.curve;
    let (start, end) = (curve.open_start(), curve.close_end());
    // Counted from the start: a late start would leave f32 too few digits for a short interval.
    let x = |t: f32| t - start;
    let times = (0..=DOTS.0).map(|i| start + (end - start) * (i as f32 / DOTS.0 as f32));
    // From just before to just after, so that a jump at an end is drawn.
    let times = once(start.next_down()).chain(times).chain(once(end.next_up()));
    let line: Vec<_> = times.map(|t| (x(t), f(t))).collect();
    let graph = Shape::Lines(&line);
    let tallest = if plan.triggers.len() > MOST_LINES { 0.1 } else { 1.0 };
    let stem = |&Trigger { time, .. }: &Trigger| [(x(time), 0.0), (x(time), f(time).min(tallest))];
    let stems: Vec<_> = plan.triggers.iter().map(stem).collect();
    let stems: Vec<_> = stems.iter().map(|stem| Shape::Lines(stem)).collect();

    let mut chart = Chart::new_with_y_range(DOTS.0, DOTS.1, 0.0, x(end), 0.0, 1.0);
    let label = move |x: f32| short(unit.of(start + x), 5);
    let mut chart = chart
        .x_label_format(LabelFormat::Custom(Box::new(label)))
        .y_label_format(LabelFormat::Custom(Box::new(|y| format!("{y}"))))
        .lineplot(&graph);
    for stem in &stems {
        chart = chart.lineplot(stem);
    }
    chart.axis();
    chart.figures();
    chart.to_string()
}

fn table(out: &mut String, plan: &Plan, unit: Unit) -> fmt::Result {
    // A digit more than tells one tick from the next, as far as f32 has them.
    let tick = unit.of(plan.seconds(1));
    let places = decimals(tick, 2).min(decimals(unit.of(plan.length()), 7));
    let has_pulses = plan.lamp != Lamp::Triggered;
    let pulse = |on: &dyn Display, off: &dyn Display| match has_pulses {
        true => format!("  {on:>10}  {off:>10}"),
        false => String::new(),
    };
    let time = format!("time ({})", unit.name());
    // By the timer's count at the sync's edge, where that is known.
    let edge = |ticks: &dyn Display| match plan.delay {
        Some(_) => format!("  {ticks:>10}"),
        None => String::new(),
    };
    // Between pulses, the gap is darkness.
    let gap = if has_pulses { "apart" } else { "gap" };
    let gap = format!("{gap} ({})", unit.name());
    writeln!(
        out,
        "    #        u  {time:>13}       ticks{}{}  {gap:>13}",
        edge(&"from edge"),
        pulse(&"on", &"off")
    )?;
    let hidden = hidden_rows(plan.triggers.len());
    let mut last: Option<f64> = None;
    for (i, trigger) in plan.triggers.iter().enumerate() {
        if i == hidden.start {
            writeln!(out, "  ...  {} more", hidden.len())?;
        }
        // Rounded as it is printed, so that a gap is the difference of what stands there.
        let rounding = 10f64.powi(places as i32);
        let time = (unit.of(trigger.time) * rounding).round() / rounding;
        let gap = last.replace(time).map_or("-".into(), |last| format!("{:.places$}", time - last));
        if hidden.contains(&i) {
            continue;
        }
        let Trigger { u, ticks, pulse: times, .. } = trigger;
        let (on, off) = times.unwrap_or_default();
        let pulse = pulse(&on, &off);
        let edge = edge(&plan.from_edge(*ticks).unwrap_or_default());
        writeln!(out, "{i:5}  {u:.5}  {time:13.places$}  {ticks:10}{edge}{pulse}  {gap:>13}")?;
    }
    Ok(())
}
