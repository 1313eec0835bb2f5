//! The plan as text for a terminal: its facts, the drawing, the table.

use std::io::stdout;
use std::iter::once;

use shutter_curve::ShutterCurve;
use shutter_fit::report::hidden_rows;
use shutter_fit::unit::{decimals, short};
use terminal_size::terminal_size_of;
use textplots::{Chart, LabelBuilder, LabelFormat, Plot, Shape};

use crate::speeds::columns;
use shutter_plan::facts::Facts;
use shutter_plan::lamp::{Lamp, SetUp};
use shutter_plan::plan::{Plan, Row, Trigger};

/// With more triggers than this, a full line at each would hide the curve.
const MOST_LINES: usize = 36;
/// The columns of what is no terminal, and the most that a drawing takes.
const COLUMNS: u16 = 80;
/// The drawing's height in dots, 4 a character.
const HEIGHT: u32 = 39;

/// The columns of the terminal.
pub fn width() -> u16 {
    terminal_size_of(stdout()).map_or(COLUMNS, |(columns, _)| columns.0.min(COLUMNS))
}

/// The plan of the scene `name`, for a terminal of so many columns.
pub fn text(name: &str, plan: &Plan, columns: u16) -> String {
    let lines = Facts::new(plan).lines(name);
    let facts: String = lines.iter().map(|(name, fact)| format!("{name:11}  {fact}\n")).collect();
    // The labels beside a drawing take 8.
    let cells = usize::from(columns.max(32) - 8);
    let drawn = plan.curve.as_ref().map_or(String::new(), |curve| drawing(plan, &curve.shutter, cells));
    format!("{facts}\n{drawn}{}", table(plan))
}

/// What an axis of time is called, and what it counts from.
pub fn axis(plan: &Plan) -> String {
    let from = if plan.sync.delay.is_some() { " from the sync's edge" } else { "" };
    format!("time{from} ({})", plan.unit.name())
}

/// The openness over time with a line up to it at each trigger.
fn drawing(plan: &Plan, curve: &ShutterCurve, cells: usize) -> String {
    let (unit, zero) = (plan.unit, plan.origin());
    // Two dots a character.
    let dots = 2 * cells as u32 - 1;
    let (start, end) = (curve.open_start(), curve.close_end());
    // Counted from the start: a late start would leave f32 too few digits for a short interval.
    let x = |t: f32| t - start;
    let times = (0..=dots).map(|i| start + (end - start) * (i as f32 / dots as f32));
    // From just before to just after, so that a jump at an end is drawn.
    let times = once(start.next_down()).chain(times).chain(once(end.next_up()));
    let line: Vec<_> = times.map(|t| (x(t), curve.openness(t))).collect();
    let graph = Shape::Lines(&line);
    let tallest = if plan.triggers.len() > MOST_LINES { 0.1 } else { 1.0 };
    let stem = |trigger: &Trigger| {
        let t = trigger.time as f32;
        [(x(t), 0.0), (x(t), curve.openness(t).min(tallest))]
    };
    let stems: Vec<_> = plan.triggers.iter().map(stem).collect();
    let stems: Vec<_> = stems.iter().map(|stem| Shape::Lines(stem)).collect();

    let mut chart = Chart::new_with_y_range(dots, HEIGHT, 0.0, x(end), 0.0, 1.0);
    let label = move |x: f32| short(unit.of(f64::from(start + x) - zero), 5);
    let mut chart = chart
        .x_label_format(LabelFormat::Custom(Box::new(label)))
        .y_label_format(LabelFormat::Custom(Box::new(|y| format!("{y}"))))
        .lineplot(&graph);
    for stem in &stems {
        chart = chart.lineplot(stem);
    }
    chart.axis();
    chart.figures();
    format!("openness over {}, a line at each trigger\n{chart}\n", axis(plan))
}

/// A row for each trigger, under the columns that a scene has.
fn table(plan: &Plan) -> String {
    let (unit, rows, timer, zero) = (plan.unit, plan.rows(), plan.timer, plan.origin());
    // A digit more than tells one tick from the next, as far as f32 has them.
    let tick = unit.of(1.0 / f64::from(timer.hz));
    let places = decimals(tick, 2).min(decimals(unit.of(plan.length), 7));
    let (by_curve, has_edge, has_pulses) = (plan.curve.is_some(), plan.sync.delay.is_some(), plan.lamp.has_pulses());
    let is_dimmed = by_curve && !matches!(plan.lamp, Lamp::Doses { .. } | Lamp::FullyOpen);
    let is_dimmed = is_dimmed && plan.scene.flashes.set_up == Some(SetUp::InPath);
    let (from, name) = (if has_edge { "from edge" } else { "time" }, unit.name());
    // Between pulses, the gap is darkness.
    let gap = if has_pulses { "apart" } else { "gap" };
    let names = [
        (true, "#".into(), 5),
        (by_curve, "u".into(), 7),
        (true, format!("{from} ({name})"), 13),
        (timer.is_given, "ticks".into(), 10),
        (timer.is_given && has_edge, "from edge".into(), 10),
        (has_pulses, "on".into(), 10),
        (has_pulses, "off".into(), 10),
        (is_dimmed, "dose (%)".into(), 8),
        (true, format!("{gap} ({name})"), 13),
    ];
    let cells = |cells: [String; 9]| -> Vec<String> {
        let cells = cells.iter().zip(&names).filter(|(_, (is_there, ..))| *is_there);
        cells.map(|(cell, (.., width))| format!("{cell:>width$}")).collect()
    };
    let mut last: Option<f64> = None;
    let row = |row: &Row| {
        // Rounded as it is printed, so that a gap is the difference of what stands there.
        let rounding = 10f64.powi(places as i32);
        let time = (unit.of(row.time_s - zero) * rounding).round() / rounding;
        let gap = last.replace(time).map_or("-".into(), |last| format!("{:.places$}", time - last));
        let count = |ticks: Option<u32>| ticks.unwrap_or_default().to_string();
        let switched = |ticks: Option<u32>| match ticks {
            Some(ticks) if !timer.is_given => {
                format!("{:.places$}", unit.of(plan.start - zero + plan.seconds(ticks)))
            }
            ticks => count(ticks),
        };
        cells([
            row.index.to_string(),
            format!("{:.5}", row.u.unwrap_or_default()),
            format!("{time:.places$}"),
            row.ticks.to_string(),
            count(row.from_edge_ticks),
            switched(row.on_ticks),
            switched(row.off_ticks),
            short(100.0 * row.dose.unwrap_or_default(), 3),
            gap,
        ])
    };
    let header = cells(names.each_ref().map(|(_, name, _)| name.clone()));
    let hidden = hidden_rows(rows.len());
    let mut lines = columns(header, rows.iter().map(row).collect::<Vec<_>>());
    let hidden = hidden.start + 1..hidden.end + 1;
    let more = (!hidden.is_empty()).then(|| format!("  ...  {} more\n", hidden.len()));
    lines.splice(hidden, more);
    lines.concat()
}
