//! The plan as text for a terminal: its facts, the drawing, the table.

use std::fmt::{self, Display, Write};
use std::io::stdout;
use std::iter::once;

use shutter_fit::report::hidden_rows;
use shutter_fit::unit::{decimals, short};
use terminal_size::terminal_size_of;
use textplots::{Chart, LabelBuilder, LabelFormat, Plot, Shape};

use crate::facts;
use crate::lamp::{Lamp, SetUp};
use crate::plan::{Plan, Trigger};
use crate::planned::{Planned, Row};
use crate::times::Times;

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
pub fn text(name: &str, plan: &Planned, columns: u16) -> String {
    let mut lines = facts::lines(name, plan);
    lines.extend(facts::spread(plan).map(|spread| ("spread", spread)));
    lines.extend(facts::drift(plan).map(|frames| {
        let frames = short(frames, 2);
        ("drift", format!("a tick a second moves the delay by 1 % of a share in {frames} frames"))
    }));
    let facts: String = lines.iter().map(|(name, fact)| format!("{name:11}  {fact}\n")).collect();
    // The labels beside a drawing take 8.
    let cells = usize::from(columns.max(32) - 8);
    let drawn = match plan {
        Planned::Curve(plan) => drawings(plan, cells),
        Planned::Times(times) => line_of_time(times, cells),
    };
    let mut text = format!("{facts}\n{drawn}\n");
    table(&mut text, plan).expect("a string takes all");
    text
}

fn drawings(plan: &Plan, cells: usize) -> String {
    let (unit, curve) = (plan.unit.name(), &plan.curve);
    let openness = drawing(plan, cells, |t| curve.openness(t));
    let cdf = drawing(plan, cells, |t| curve.cdf(t));
    format!(
        "openness over time ({unit}), a line at each trigger\n{openness}\n\
         fraction of the exposure collected over time ({unit})\n{cdf}"
    )
}

/// The triggers on a line of time.
fn line_of_time(times: &Times, cells: usize) -> String {
    let unit = times.unit;
    let mut line = vec!['─'; cells];
    for trigger in &times.triggers {
        let part = (trigger.time - times.open_start) / times.length;
        line[(part * (cells - 1) as f64).round() as usize] = '┼';
    }
    let ends = [times.open_start, times.open_start + times.length];
    let [first, last] = ends.map(|time| short(unit.of(time), 5));
    let (name, line, width) = (unit.name(), String::from_iter(line), cells.saturating_sub(first.len()));
    format!("triggers over time ({name})\n{line}\n{first}{last:>width$}\n")
}

/// The function `f` of time with a line up to it at each trigger.
fn drawing(plan: &Plan, cells: usize, f: impl Fn(f32) -> f32) -> String {
    let unit = plan.unit;
    // Two dots a character.
    let (dots, curve) = (2 * cells as u32 - 1, &plan.curve);
    let (start, end) = (curve.open_start(), curve.close_end());
    // Counted from the start: a late start would leave f32 too few digits for a short interval.
    let x = |t: f32| t - start;
    let times = (0..=dots).map(|i| start + (end - start) * (i as f32 / dots as f32));
    // From just before to just after, so that a jump at an end is drawn.
    let times = once(start.next_down()).chain(times).chain(once(end.next_up()));
    let line: Vec<_> = times.map(|t| (x(t), f(t))).collect();
    let graph = Shape::Lines(&line);
    let tallest = if plan.triggers.len() > MOST_LINES { 0.1 } else { 1.0 };
    let stem = |&Trigger { time, .. }: &Trigger| [(x(time), 0.0), (x(time), f(time).min(tallest))];
    let stems: Vec<_> = plan.triggers.iter().map(stem).collect();
    let stems: Vec<_> = stems.iter().map(|stem| Shape::Lines(stem)).collect();

    let mut chart = Chart::new_with_y_range(dots, HEIGHT, 0.0, x(end), 0.0, 1.0);
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

fn table(out: &mut String, planned: &Planned) -> fmt::Result {
    let (unit, rows, timer) = (planned.unit, planned.rows(), planned.timer);
    // A digit more than tells one tick from the next, as far as f32 has them.
    let tick = unit.of(1.0 / f64::from(timer.hz));
    let places = decimals(tick, 2).min(decimals(unit.of(planned.length), 7));
    let has_pulses = rows.iter().any(|row| row.on_ticks.is_some());
    let is_dimmed = planned.plan().is_some_and(|plan| {
        plan.set_up == Some(SetUp::InPath) && matches!(plan.lamp, Lamp::Triggered | Lamp::Equal { .. })
    });
    // Columns that a scene need not have.
    let column = |is_there: bool, cell: &dyn Display, width: usize| match is_there {
        true => format!("  {cell:>width$}"),
        false => String::new(),
    };
    let (by_curve, has_edge) = (planned.plan().is_some(), planned.delay.is_some());
    let ticks = |name: &dyn Display, edge: &dyn Display, on: &dyn Display, off: &dyn Display| {
        // By the timer's count at the sync's edge, where that is known.
        column(timer.is_given, name, 10)
            + &column(timer.is_given && has_edge, edge, 10)
            + &column(has_pulses, on, 10)
            + &column(has_pulses, off, 10)
    };
    // Between pulses, the gap is darkness.
    let gap = if has_pulses { "apart" } else { "gap" };
    let [time, gap] = ["time", gap].map(|what| format!("{what} ({})", unit.name()));
    writeln!(
        out,
        "    #{}  {time:>13}{}{}  {gap:>13}",
        column(by_curve, &"u", 7),
        ticks(&"ticks", &"from edge", &"on", &"off"),
        column(is_dimmed, &"dose (%)", 8),
    )?;
    let hidden = hidden_rows(rows.len());
    let mut last: Option<f64> = None;
    for (i, row) in rows.iter().enumerate() {
        if i == hidden.start {
            writeln!(out, "  ...  {} more", hidden.len())?;
        }
        // Rounded as it is printed, so that a gap is the difference of what stands there.
        let rounding = 10f64.powi(places as i32);
        let time = (unit.of(row.time_s) * rounding).round() / rounding;
        let gap = last.replace(time).map_or("-".into(), |last| format!("{:.places$}", time - last));
        if hidden.contains(&i) {
            continue;
        }
        let Row { u, ticks: own, from_edge_ticks, on_ticks, off_ticks, dose, .. } = row;
        let edges = [on_ticks, off_ticks].map(|ticks| match (planned.plan(), ticks) {
            (Some(plan), Some(ticks)) if !timer.is_given => {
                let from = f64::from(plan.curve.open_start());
                format!("{:.places$}", unit.of(from + plan.seconds(*ticks)))
            }
            _ => ticks.unwrap_or_default().to_string(),
        });
        writeln!(
            out,
            "{i:5}{}  {time:13.places$}{}{}  {gap:>13}",
            column(by_curve, &format_args!("{:.5}", u.unwrap_or_default()), 7),
            ticks(own, &from_edge_ticks.unwrap_or_default(), &edges[0], &edges[1]),
            column(is_dimmed, &short(100.0 * dose.unwrap_or_default(), 3), 8),
        )?;
    }
    Ok(())
}
