//! Trigger times without a curve as an SVG: a mark for each on an axis of time.

use std::error::Error;

use chart::plotters::prelude::*;
use chart::plotters::style::text_anchor::{HPos, VPos};
use chart::{Axis, INK, SCALE, axes, pen};
use shutter_fit::unit::{count, decimals, trimmed};

use super::drawing::{draw_marks, is_near, page, time_range};
use crate::report::axis;
use shutter_plan::plan::Plan;

const SIZE: (i32, i32) = (900, 240);

/// The triggers of the scene `name`.
pub fn svg(name: &str, times: &Plan) -> Result<String, Box<dyn Error>> {
    let (unit, zero) = (times.unit, times.origin());
    let [start, end] = [times.start, times.start + times.length].map(|time| unit.of(time - zero));
    let title = format!("The triggers of the shutter {name} over time, as measured");
    let facts = format!("no curve: {} as measured", count(times.triggers.len() as u64, "trigger"));
    page(SIZE, &title, [name, &facts], &[], |page| {
        let (time, places) = (axis(times), decimals(end - start, 3));
        let across = Axis { range: time_range(times), name: Some(&time), labels: 11, label: &|t| trimmed(*t, places) };
        let up = Axis { range: 0.0..1.2, name: None, labels: 6, label: &|_| String::new() };
        let mut graph = axes(page, across, up, 20)?;
        let marks = times.triggers.iter().map(|trigger| (unit.of(trigger.time - zero), 1.0));
        draw_marks(&mut graph, marks, |(t, y)| vec![(t, 0.0), (t, y)])?;
        let edge = is_near(times).then_some((0.0, "sync"));
        for (t, words) in edge.into_iter().chain([(start, "opens")]) {
            graph.draw_series([PathElement::new([(t, 0.0), (t, 1.0)], pen(INK, 1.2))])?;
            let label = chart::text(13 * SCALE, HPos::Left, VPos::Bottom);
            let place = EmptyElement::at((t, 1.0));
            graph.draw_series([place + Text::new(words, (6 * SCALE, -4 * SCALE), label)])?;
        }
        Ok(())
    })
}
