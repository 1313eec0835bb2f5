//! The pictures of the report.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use crate::accuracy::Figures;
use crate::methods::{DEFAULT, METHODS, TABLE, TEXTBOOK};
use crate::style::{Axis, BLUE, Chart, GREY, INK, SCALE, VERMILION, chart, legend, picture, text};
use crate::support::cases::{judge, shutter};
use crate::support::curves::{random_hard, random_typical};
use crate::support::oracle::{Curve, Exact, Points};
use crate::support::rendering::{PIXELS, PULSES, Picture, Pulses};
use crate::timing;

/// Error against time: the greatest (full) and the mean error (ring) of each method, over what a sample
/// costs. A panel is a name and the cost of methods by their places.
pub fn frontier(path: &str, panels: &[(&'static str, Vec<(usize, f64)>)], figures: &[Figures]) {
    let title = "Error against time and against cycles: this crate and its peers";
    picture(path, (620 * panels.len() as u32, 520), title, |root| {
        for (area, (name, costs)) in root.split_evenly((1, panels.len())).iter().zip(panels) {
            let logs = costs.iter().map(|(_, cost)| cost.log2());
            let low = logs.clone().fold(f64::INFINITY, f64::min);
            let high = logs.fold(f64::NEG_INFINITY, f64::max);
            let x = Axis {
                name,
                range: low - 1.8..high + 1.4,
                label: |x| format!("{:.0}", 2f64.powf(x.round())),
                labels: 8,
            };
            let y = Axis::decades("error, as a share of the interval", -9.5..0.5);
            let mut chart = chart(area, "", &x, &y);
            for &(method, cost) in costs {
                let color = if METHODS[method].is_ours { BLUE } else { VERMILION };
                let (most, mean) = figures[method].of_interval;
                let at = |error: f64| (cost.log2(), error.max(1e-10).log10());
                let line = PathElement::new([at(most), at(mean)], color.mix(0.4).stroke_width(4));
                draw(&mut chart, [line]);
                draw(&mut chart, [Circle::new(at(most), 10, color.filled())]);
                draw(&mut chart, [Circle::new(at(mean), 8, color.stroke_width(4))]);
                // Where two points come close, their names keep apart.
                let (dx, dy, h) = match METHODS[method].name {
                    "`CELLS = 16`" => (-18, 0, HPos::Right),
                    "`CELLS = 8`" => (0, -26, HPos::Center),
                    "table of 256" => (-18, -10, HPos::Right),
                    "table of 1024" => (-18, 14, HPos::Right),
                    _ => (18, 0, HPos::Left),
                };
                let label = METHODS[method].name.replace('`', "");
                let label = Text::new(label, (dx, dy), text(13, h, VPos::Center));
                draw(&mut chart, [EmptyElement::at(at(most)) + label]);
            }
            frontier_legend(&mut chart);
        }
    });
}

/// What colours and signs of the frontier mean: series without points, for their names.
fn frontier_legend<'a, 'b: 'a>(chart: &mut Chart<'a, 'b>) {
    let keys = [
        ("this crate", BLUE.filled()),
        ("others", VERMILION.filled()),
        ("greatest error", INK.filled()),
        ("mean error", INK.stroke_width(4)),
    ];
    for (name, style) in keys {
        let none = std::iter::empty::<Circle<(f64, f64), i32>>();
        let series = chart.draw_series(none).expect("drawn");
        series.label(name).legend(move |(x, y)| Circle::new((x + 18, y), 9, style));
    }
    legend(chart, SeriesLabelPosition::MiddleLeft);
}

fn draw<'b, E>(chart: &mut Chart<'_, 'b>, elements: impl IntoIterator<Item = E>)
where
    for<'e> &'e E: plotters::element::PointCollection<'e, (f64, f64)>,
    E: plotters::element::Drawable<SVGBackend<'b>>,
{
    chart.draw_series(elements).expect("drawn");
}

/// A line with its name in the legend.
fn line(
    chart: &mut Chart,
    name: &str,
    color: RGBColor,
    width: u32,
    points: impl IntoIterator<Item = (f64, f64)>,
) {
    let style = color.stroke_width(2 * width);
    let series = chart.draw_series(LineSeries::new(points, style)).expect("drawn");
    if !name.is_empty() {
        series.label(name).legend(move |(x, y)| PathElement::new([(x, y), (x + 36, y)], style));
    }
}

/// The error over u in ulp(t) on three curves: this crate, the textbook Newton and a table.
pub fn over_u(path: &str) {
    let high: Points = [(0.0, 0.0), (0.0833, 0.0), (0.1667, 0.0), (0.25, 1.0)];
    let mirror: Points = [(0.75, 1.0), (0.8333, 0.0), (0.9167, 0.0), (1.0, 0.0)];
    let curves = [
        ("soft", timing::curve(0)),
        ("all ramp", timing::curve(1)),
        ("ends of order p⁴", Curve::shutter(high, mirror)),
    ];
    let title = "The error over u on three curves: this crate, the textbook Newton and a table";
    picture(path, (1240, 400), title, |root| {
        for (area, (name, curve)) in root.split_evenly((1, 3)).iter().zip(&curves) {
            let y = Axis::decades("error in ulp(t)", -2.5..7.5);
            let mut chart = chart(area, name, &Axis::plain("u", 0.0..1.0), &y);
            let exact = Exact::new(curve);
            let methods = [
                (TABLE, VERMILION, "table of 256"),
                (TEXTBOOK, GREY, "textbook Newton"),
                (DEFAULT, BLUE, "this crate"),
            ];
            for (method, color, name) in methods {
                let inverse = (METHODS[method].build)(curve);
                // The greatest of 16 neighbours: what matters, and a line that one can read.
                let points = (1..256).map(|i| {
                    let errors = (0..16).map(|k| (i as f32 + k as f32 / 16.0) / 256.0).map(|u| {
                        let t = inverse.inverse_cdf(u);
                        exact.forward_ulp(t, exact.inverse_cdf(u))
                    });
                    let most = errors.fold(0.0, f64::max);
                    (f64::from(i) / 256.0, most.max(3e-3).log10())
                });
                line(&mut chart, name, color, 2, points);
            }
            legend(&mut chart, SeriesLabelPosition::UpperMiddle);
        }
    });
}

/// How the errors in ulp(t) are spread, with their signs.
pub fn histogram(path: &str, figures: &[Figures]) {
    let title = "How the errors of the inverse are spread";
    picture(path, (720, 400), title, |root| {
        const BINS: usize = 64;
        let width = 1.6 / BINS as f64;
        let bins = |errors: &[f32]| {
            let mut bins = [0.0; BINS];
            for error in errors {
                let bin = ((f64::from(*error) + 0.8) / width) as usize;
                bins[bin.min(BINS - 1)] += 1.0 / errors.len() as f64 / width;
            }
            bins
        };
        let (ours, compact) = (bins(&figures[DEFAULT].signed), bins(&figures[0].signed));
        let most = ours.iter().chain(&compact).fold(1.0, |most: f64, height| most.max(*height));
        let x = Axis::plain("t - exact, in ulp(t)", -0.8..0.8);
        let y = Axis::plain("density", 0.0..1.05 * most);
        let mut chart = chart(root, "", &x, &y);
        let edge = |i: usize| i as f64 * width - 0.8;
        let bars = ours.iter().enumerate().map(|(i, height)| {
            Rectangle::new([(edge(i), 0.0), (edge(i + 1), *height)], BLUE.mix(0.55).filled())
        });
        let series = chart.draw_series(bars).expect("drawn");
        series.label("CELLS = 8").legend(|(x, y)| {
            Rectangle::new([(x, y - 10), (x + 36, y + 10)], BLUE.mix(0.55).filled())
        });
        let steps = compact.iter().enumerate();
        let steps = steps.flat_map(|(i, height)| [(edge(i), *height), (edge(i + 1), *height)]);
        line(&mut chart, "CELLS = 0", INK, 2, steps);
        let ideal = [(-0.5, 0.0), (-0.5, 1.0), (0.5, 1.0), (0.5, 0.0)];
        line(&mut chart, "rounding alone, errors even", VERMILION, 2, ideal);
        legend(&mut chart, SeriesLabelPosition::UpperRight);
    });
}

/// Where the worst backward errors lie: each random curve's worst u and its error.
pub fn worst_cases(path: &str, curves: u64, tick: impl Fn()) {
    let title = "Where the worst errors of the inverse lie";
    picture(path, (1240, 420), title, |root| {
        // Octaves from the earlier end, then from the later one.
        let place = |u: f32| {
            if u < 0.5 {
                32.0 + f64::from(u).log2().max(-32.0)
            } else {
                30.0 - (1.0 - f64::from(u)).log2().max(-30.0)
            }
        };
        let y = Axis::plain("greatest error in ulp(u)", 0.0..1.05);
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
        let mut chart = chart(root, "", &x, &y);
        let kinds = [
            ("hard curves", VERMILION, random_hard as fn(u64, u64) -> Curve),
            ("typical curves", BLUE, random_typical),
        ];
        for (name, color, random) in kinds {
            let points: Vec<_> = (0..curves)
                .map(|i| {
                    let curve = random(5, i);
                    let ours = shutter::<8>(&curve);
                    let verdict = judge(&Exact::new(&curve), |u| ours.inverse_cdf(u));
                    tick();
                    (place(verdict.at), verdict.backward)
                })
                .collect();
            let dots = points.into_iter().map(|at| Circle::new(at, 4, color.mix(0.5).filled()));
            let series = chart.draw_series(dots).expect("drawn");
            series.label(name).legend(move |(x, y)| Circle::new((x + 18, y), 8, color.filled()));
        }
        line(&mut chart, "promised", INK, 1, [(0.0, 1.0), (56.0, 1.0)]);
        legend(&mut chart, SeriesLabelPosition::MiddleRight);
    });
}

fn superscript(n: i32) -> String {
    let raised = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    n.to_string().bytes().map(|digit| raised[usize::from(digit - b'0')]).collect()
}

/// A moving bar exposed in three ways: what one sees, and the error against the number of pulses.
pub fn rendering(path: &str, errors: &[(Pulses, Vec<(u32, f64)>)]) {
    const SHOWN: u32 = 32;
    let title = "A moving bar exposed in pulses, and the error against their number";
    picture(path, (1240, 430), title, |root| {
        let (strips, plot) = root.split_horizontally(700 * SCALE);
        let scene = Picture::new(&timing::curve(0));
        let rows = [("exact".to_string(), scene.exact().to_vec())].into_iter().chain(
            PULSES.map(|pulses| (name(pulses).to_string(), scene.exposed(pulses, SHOWN, 1))),
        );
        let title =
            format!("A bar moves by 3.5 of its widths while the shutter is open: {SHOWN} pulses");
        strips
            .draw(&Text::new(title, (20 * SCALE, 24 * SCALE), text(15, HPos::Left, VPos::Center)))
            .expect("drawn");
        for (row, (name, values)) in rows.enumerate() {
            let top = (52 + 90 * row as i32) * SCALE;
            strips
                .draw(&Text::new(name, (20 * SCALE, top), text(13, HPos::Left, VPos::Center)))
                .expect("drawn");
            // Light adds up; eyes and screens do not: the usual exponent.
            // Full light is not the page's white, which turns dark on dark pages.
            let grey = |value: &f64| (254.0 * (value / 0.45).clamp(0.0, 1.0).powf(1.0 / 2.2)) as u8;
            let x = |pixel: usize| (20 + 660 * pixel as i32 / PIXELS as i32) * SCALE;
            let mut pixel = 0;
            for run in values.chunk_by(|a, b| grey(a) == grey(b)) {
                // A bit into the next one, which covers it: between two that only adjoin, a seam would show.
                let end = (x(pixel + run.len()) + SCALE).min(x(PIXELS));
                let corners = [(x(pixel), top + 12 * SCALE), (end, top + 66 * SCALE)];
                let grey = grey(&run[0]);
                let style = RGBColor(grey, grey, grey).filled();
                strips.draw(&Rectangle::new(corners, style)).expect("drawn");
                pixel += run.len();
            }
        }
        let y = Axis::decades("root-mean-square error", -5.0..0.0);
        let x = Axis {
            name: "pulses",
            range: 5.8..12.2,
            label: |x| format!("{:.0}", 2f64.powf(x.round())),
            labels: 7,
        };
        let mut chart = chart(&plot, "", &x, &y);
        for ((pulses, errors), color) in errors.iter().zip([BLUE, VERMILION, GREY]) {
            let points = errors.iter().map(|(n, error)| (f64::from(*n).log2(), error.log10()));
            draw(&mut chart, points.clone().map(|at| Circle::new(at, 6, color.filled())));
            line(&mut chart, name(*pulses), color, 2, points);
        }
        legend(&mut chart, SeriesLabelPosition::UpperRight);
    });
}

pub fn name(pulses: Pulses) -> &'static str {
    match pulses {
        Pulses::Triggers => "triggers of this crate",
        Pulses::Weighted => "equally spaced, weighted by openness",
        Pulses::Random => "random, as the curve has it",
    }
}
