//! The pictures of the report: as those of `shutter`.

use std::collections::HashSet;
use std::ops::Range;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use shutter::picture::style::{self, Area, BLUE, FAINT, GREY, Graph, INK, VERMILION, dressed};

use crate::accuracy::judge;
use crate::methods::Method::{Nearer, Octaves4, Octaves8, Octaves16, RootFpu, RootLibm, Table256};
use crate::methods::{METHODS, Method, SOFT, TRAPEZOID};
use crate::report::{Measured, cycles, time};
use crate::support::cases::shutter;
use crate::support::curves::{random_hard, random_typical};
use crate::support::oracle::{Curve, Exact};
use crate::support::promise::BACKWARD;

/// Drawn at twice the size, since the pen moves by whole units.
const SCALE: i32 = 2;

/// Text, by its size and its place relative to the point it is put at.
fn text(size: i32, h: HPos, v: VPos) -> TextStyle<'static> {
    style::text(size * SCALE, h, v)
}

/// A picture of this size and title, with what `draw` draws on it.
fn picture(path: &str, size: (u32, u32), title: &str, draw: impl FnOnce(&Area)) {
    let mut svg = String::new();
    let drawn = (size.0 * SCALE as u32, size.1 * SCALE as u32);
    {
        let area = SVGBackend::with_string(&mut svg, drawn).into_drawing_area();
        area.fill(&WHITE).expect("a picture");
        draw(&area);
        area.present().expect("a picture");
    }
    // What is said of each dot and is so without being said.
    let svg = svg.replace(" stroke=\"none\" stroke-width=\"1\"/>", "/>");
    let svg = svg.replace(" opacity=\"1\"", "");
    std::fs::write(path, dressed(&svg, drawn, size, title)).expect("the picture is written");
}

/// An axis: what it shows, from where to where, and how its numbers are written.
struct Axis {
    name: &'static str,
    range: Range<f64>,
    label: fn(&f64) -> String,
    labels: usize,
}

fn graph<'a, 'b>(area: &Area<'b>, x: &Axis, y: &Axis) -> Graph<'a, 'b> {
    let mut graph = ChartBuilder::on(area)
        .margin(12 * SCALE)
        .x_label_area_size(46 * SCALE)
        .y_label_area_size(62 * SCALE)
        .build_cartesian_2d(x.range.clone(), y.range.clone())
        .expect("a graph");
    graph
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(FAINT.stroke_width(2))
        .axis_style(GREY.stroke_width(2))
        .label_style(style::font(13 * SCALE))
        .axis_desc_style(style::font(14 * SCALE))
        .x_desc(x.name)
        .y_desc(y.name)
        .x_labels(x.labels)
        .y_labels(y.labels)
        .x_label_formatter(&x.label)
        .y_label_formatter(&y.label)
        .draw()
        .expect("axes");
    graph
}

/// Names colours and signs: a series without points for each, and the legend, in a corner.
fn legend<'a, 'b: 'a>(graph: &mut Graph<'a, 'b>, keys: &[(&str, ShapeStyle)], position: SeriesLabelPosition) {
    for (name, style) in keys {
        let none = std::iter::empty::<Circle<(f64, f64), i32>>();
        let (series, style) = (graph.draw_series(none).expect("drawn"), *style);
        series.label(*name).legend(move |(x, y)| Circle::new((x + 18, y), 9, style));
    }
    graph
        .configure_series_labels()
        .position(position)
        .background_style(WHITE.mix(0.85))
        .border_style(FAINT)
        .legend_area_size(30 * SCALE)
        .margin(8 * SCALE)
        .label_font(style::font(13 * SCALE))
        .draw()
        .expect("a legend");
}

/// A whole number, raised.
fn superscript(n: i32) -> String {
    let raised = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let sign = if n < 0 { "⁻" } else { "" };
    let digits = n.abs().to_string();
    let digits = digits.bytes().map(|digit| raised[usize::from(digit - b'0')]);
    format!("{sign}{}", digits.collect::<String>())
}

/// Error against time and against cycles: the greatest (full) and the mean error (ring) of each method, over what a
/// sample costs.
pub fn frontier(path: &str, measured: &Measured) {
    let on = |method: Method| if method.is_root() { TRAPEZOID } else { SOFT };
    let times = METHODS.map(|method| time(&measured.times[on(method)], method));
    let cycles = METHODS.map(|method| cycles(measured, method, on(method)));
    let panels = [
        ("nanoseconds a sample on the host, soft curve", times),
        ("mean cycles a sample on a Cortex-M4F (model), soft curve", cycles),
    ];
    let title = "Error against time and against cycles: this crate and its peers";
    picture(path, (1240, 520), title, |root| {
        for (area, (name, costs)) in root.split_evenly((1, 2)).iter().zip(&panels) {
            let logs = costs.iter().flatten().map(|cost| cost.log2());
            let low = logs.clone().fold(f64::INFINITY, f64::min);
            let high = logs.fold(f64::NEG_INFINITY, f64::max);
            let x = Axis {
                name,
                range: low - 1.8..high + 1.4,
                label: |x| format!("{:.0}", 2f64.powf(x.round())),
                labels: 8,
            };
            let y = Axis {
                name: "error, as a share of the interval",
                range: -9.5..0.5,
                label: |y| match y.round() as i32 {
                    0 => "1".into(),
                    y => format!("10{}", superscript(y)),
                },
                labels: 11,
            };
            let mut graph = graph(area, &x, &y);
            for ((method, figures), cost) in METHODS.iter().zip(&measured.figures).zip(costs) {
                let Some(cost) = cost else { continue };
                let color = match method {
                    method if method.is_ours() => BLUE,
                    method if method.is_root() => GREY,
                    _ => VERMILION,
                };
                let (most, mean) = figures.of_interval;
                let at = |error: f64| (cost.log2(), error.max(1e-10).log10());
                let line = PathElement::new([at(most), at(mean)], color.mix(0.4).stroke_width(4));
                draw(&mut graph, [line]);
                draw(&mut graph, [Circle::new(at(most), 10, color.filled())]);
                draw(&mut graph, [Circle::new(at(mean), 8, color.stroke_width(4))]);
                // Where two points come close, their names keep apart.
                let (dx, dy, h) = match method {
                    Octaves16 => (-24, -26, HPos::Right),
                    Octaves8 => (0, -54, HPos::Center),
                    Octaves4 => (0, -26, HPos::Center),
                    Table256 => (-18, -10, HPos::Right),
                    RootFpu => (-18, 20, HPos::Right),
                    // Below the ring.
                    Nearer => (0, 118, HPos::Center),
                    RootLibm => (0, 104, HPos::Center),
                    _ => (18, 0, HPos::Left),
                };
                let label = method.name().replace('`', "");
                let label = Text::new(label, (dx, dy), text(13, h, VPos::Center));
                draw(&mut graph, [EmptyElement::at(at(most)) + label]);
            }
            let keys = [
                ("this crate", BLUE.filled()),
                ("others, for every curve", VERMILION.filled()),
                ("square roots, on a trapezoid", GREY.filled()),
                ("greatest error", INK.filled()),
                ("mean error", INK.stroke_width(4)),
            ];
            // Where the second has room.
            if *name == panels[1].0 {
                legend(&mut graph, &keys, SeriesLabelPosition::MiddleRight);
            }
        }
    });
}

fn draw<'b, E>(graph: &mut Graph<'_, 'b>, elements: impl IntoIterator<Item = E>)
where
    for<'e> &'e E: plotters::element::PointCollection<'e, (f64, f64)>,
    E: plotters::element::Drawable<SVGBackend<'b>>,
{
    graph.draw_series(elements).expect("drawn");
}

/// Where the worst backward errors lie: each random curve's worst u and its error.
pub fn worst_cases(path: &str, curves: u64) {
    let title = "Where the worst errors of the inverse lie";
    picture(path, (1240, 420), title, |root| {
        // Octaves from the earlier end, then from the later one.
        let place = |u: f32| {
            if u < 0.5 { 32.0 + f64::from(u).log2().max(-32.0) } else { 30.0 - (1.0 - f64::from(u)).log2().max(-30.0) }
        };
        let y =
            Axis { name: "greatest backward error, ulp(u)", range: 0.0..0.55, label: |y| format!("{y:.1}"), labels: 6 };
        let x = Axis {
            name: "u where it occurs",
            range: 0.0..56.0,
            label: |x| match x.round() as i32 {
                0 => "≤ 2⁻³²".into(),
                x @ ..31 => format!("2⁻{}", superscript(32 - x)),
                31 => "1/2".into(),
                x => format!("1 - 2⁻{}", superscript(x - 30)),
            },
            labels: 15,
        };
        let mut graph = graph(root, &x, &y);
        let kinds = [(VERMILION, random_hard as fn(u64, u64) -> Curve), (BLUE, random_typical)];
        for (color, random) in kinds {
            let points = (0..curves).map(|i| {
                let curve = random(5, i);
                let ours = shutter::<8>(&curve);
                let verdict = judge(&Exact::new(&curve), |u| ours.inverse_cdf(u));
                (place(verdict.at), verdict.backward)
            });
            // Of those in a cell of an octave and 1/75 ulp, the greatest.
            let mut points: Vec<(f64, f64)> = points.collect();
            points.sort_by(|a, b| b.1.total_cmp(&a.1));
            let mut seen = HashSet::new();
            points.retain(|(x, y)| seen.insert((*x as u32, (75.0 * y) as u32)));
            draw(&mut graph, points.into_iter().map(|at| Circle::new(at, 4, color.filled())));
        }
        draw(&mut graph, [PathElement::new([(0.0, BACKWARD), (56.0, BACKWARD)], INK.stroke_width(2))]);
        let keys = [
            ("hard curves", VERMILION.filled()),
            ("typical curves", BLUE.filled()),
            (&format!("promised: {BACKWARD}"), INK.filled()),
        ];
        legend(&mut graph, &keys, SeriesLabelPosition::MiddleRight);
    });
}
