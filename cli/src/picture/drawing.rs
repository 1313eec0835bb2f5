//! What the program's pictures have in common: a page with its heading and legend, and marks.

use std::error::Error;

use chart::plotters::prelude::*;
use chart::plotters::style::text_anchor::{HPos, VPos};
use chart::{Area, BLUE, Drawn, GREY, Graph, INK, LIGHT, SCALE, VERMILION, pen, picture};

/// With more triggers than this, their marks would run into each other.
pub const MOST_MARKS: usize = 50;

/// While the lamp is on.
pub fn lit() -> ShapeStyle {
    LIGHT.filled()
}

/// A trigger.
fn dot<C>(at: C) -> Circle<C, i32> {
    Circle::new(at, 4 * SCALE, VERMILION.filled())
}

/// A control point.
pub fn knob<C>(at: C) -> Circle<C, i32> {
    Circle::new(at, 5 * SCALE, pen(INK, 1.5))
}

/// A sign of a graph.
pub enum Key {
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
pub fn page(
    size: (i32, i32),
    title: &str,
    [name, facts]: [&str; 2],
    keys: &[(&str, Key)],
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
