//! What the program's pictures have in common: a page with its heading and legend, and marks.

use std::error::Error;
use std::ops::Range;

use chart::plotters::prelude::*;
use chart::plotters::style::text_anchor::{HPos, VPos};
use chart::{Area, Axis, BLUE, Drawn, GREY, Graph, LIGHT, SCALE, VERMILION, axes, pen, picture};
use shutter_fit::unit::{decimals, trimmed};

/// With more triggers than this, their marks would run into each other.
pub const MOST_MARKS: usize = 50;

/// What a sign of a graph looks like in a text, its colour, and what it means.
pub type Key = (&'static str, RGBColor, &'static str);

pub const OPENNESS: Key = ("━", BLUE, "openness");
pub const FITTED: Key = ("━", BLUE, "fitted curve");
pub const TRACE: Key = ("━", GREY, "trace");
pub const TRIGGER: Key = ("●", VERMILION, "trigger");
pub const OWN_TRIGGER: Key = ("●", VERMILION, "trigger by the trace");
pub const LAMP: Key = ("■", LIGHT, "lamp on");
pub const HANDLE: Key = ("○", GREY, "control point and its handle");

/// What the signs mean, below the heading on a page of this width.
fn legend(area: &Area, page: i32, keys: &[Key]) -> Drawn {
    // By so much a letter is wide, at most.
    let width = |name: &str| 34 + 8 * name.len() as i32;
    let all: i32 = keys.iter().map(|(.., name)| width(name)).sum();
    let (mut x, y) = ((page - all) / 2 * SCALE, 74 * SCALE);
    for (sign, color, name) in keys {
        let label = chart::text(13 * SCALE, HPos::Left, VPos::Center);
        area.draw_text(sign, &chart::text(17 * SCALE, HPos::Left, VPos::Center).color(color), (x, y))?;
        area.draw_text(name, &label, (x + 18 * SCALE, y))?;
        x += width(name) * SCALE;
    }
    Ok(())
}

/// An empty graph over this time, with so much room for the numbers beside it.
pub fn graph<'a, 'b>(
    area: &'a Area<'b>,
    (x, time): (Option<&str>, Range<f64>),
    (y, range): (&str, Range<f64>),
    room: i32,
) -> Result<Graph<'a, 'b>, Box<dyn Error>> {
    let [across, up] = [&time, &range].map(|range| decimals(range.end - range.start, 3));
    let time = Axis { range: time, name: x, labels: 11, label: &|t| trimmed(*t, across) };
    axes(area, time, Axis { range, name: Some(y), labels: 6, label: &|y| trimmed(*y, up) }, room)
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
        graph.draw_series(marks.map(|mark| Circle::new(mark, 4 * SCALE, VERMILION.filled())))?;
    }
    Ok(())
}

/// An SVG of this size with what `draw` draws on it below a heading: the name of what is drawn, its facts, and signs.
pub fn page(
    size: (i32, i32),
    title: &str,
    [name, facts]: [&str; 2],
    keys: &[Key],
    draw: impl FnOnce(&Area) -> Drawn,
) -> Result<String, Box<dyn Error>> {
    picture(size, title, |page| {
        let (heading, rest) = page.split_vertically(88 * SCALE);
        let middle = size.0 * SCALE / 2;
        for (text, size, y) in [(name, 19, 22), (facts, 14, 48)] {
            let centred = chart::text(size * SCALE, HPos::Center, VPos::Center);
            heading.draw_text(text, &centred, (middle, y * SCALE))?;
        }
        legend(&heading, size.0, keys)?;
        draw(&rest)
    })
}
