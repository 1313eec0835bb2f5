//! A fit as an SVG: the trace with the curve through it and the triggers, and below it what the curve misses.

use std::error::Error;
use std::ops::Range;

use chart::plotters::prelude::*;
use chart::{Area, BLUE, Drawn, GREY, SCALE, pen};
use shutter_fit::trace::Trace;
use shutter_fit::unit::short;
use shutter_fit::{Fit, From};

use super::drawing::{FITTED, OWN_TRIGGER, TRACE, TRIGGER, draw_marks, graph, page};

const SIZE: (i32, i32) = (900, 640);
const SIGNAL: i32 = 340;
/// More samples than this are drawn as the least and the greatest of neighbours.
const MOST: usize = 3000;
/// The points along the curve.
const POINTS: usize = 1500;

/// The fit of the trace `name`, as an SVG.
pub fn trace(name: &str, fit: &Fit) -> Result<String, Box<dyn Error>> {
    let title = format!("The trace {name} and the curve fitted to it, with its triggers; the residual");
    let facts = format!(
        "{}: exposure {}{}, rms {} % of the light",
        fit.chosen.title(),
        fit.unit().show(fit.exposure.value),
        if fit.from == From::Trace { " by the trace" } else { "" },
        short(100.0 * fit.best().rms, 3),
    );
    let keys = [TRACE, FITTED, if fit.from == From::Model { TRIGGER } else { OWN_TRIGGER }];
    page(SIZE, &title, [name, &facts], &keys, |page| {
        let (upper, lower) = page.split_vertically(SIGNAL * SCALE);
        draw_signal(&upper, fit)?;
        draw_residual(&lower, fit)
    })
}

fn draw_signal(area: &Area, fit: &Fit) -> Drawn {
    let (unit, sign) = (fit.unit(), if fit.inverted { -1.0 } else { 1.0 });
    let raw = samples(fit, |_, v| sign * v);
    let range = range(raw.iter().map(|(_, v)| *v), 0.06);
    let (first, last) = ends(fit);
    let mut graph = graph(area, (None, unit.of(first)..unit.of(last)), ("signal", range), 72)?;
    graph.draw_series(LineSeries::new(raw, pen(GREY, 1.0)))?;
    let at = |t: f64| (unit.of(t), sign * fit.value(t));
    // A box's edges are drawn as such: a point on either side of each.
    let curve = fit.best().signal.curve;
    let mut times: Vec<f64> = (0..=POINTS).map(|i| first + (last - first) * i as f64 / POINTS as f64).collect();
    let nudge = 1e-9 * curve.length();
    times.extend(curve.times().iter().flat_map(|t| [t - nudge, t + nudge]));
    times.retain(|t| (first..=last).contains(t));
    times.sort_by(f64::total_cmp);
    graph.draw_series(LineSeries::new(times.into_iter().map(at), pen(BLUE, 2.5)))?;
    let dark = sign * fit.best().signal.dark;
    // The trace's own stand on the trace: the curve is elsewhere.
    let seen = |t: f64| match fit.from {
        From::Model => at(t),
        From::Trace => (unit.of(t), sign * between(fit, t)),
    };
    if fit.from == From::Trace {
        let model = fit.model_triggers.iter().map(|trigger| at(trigger.value));
        graph.draw_series(model.map(|(t, v)| PathElement::new([(t, dark), (t, v)], pen(BLUE, 0.8))))?;
    }
    let marks = fit.triggers.iter().map(|trigger| seen(trigger.value));
    draw_marks(&mut graph, marks, |(t, v)| vec![(t, dark), (t, v)])
}

/// The trace at a time.
fn between(fit: &Fit, t: f64) -> f64 {
    let Trace { times, values } = &fit.samples;
    let k = times.partition_point(|time| *time < t).clamp(1, times.len() - 1);
    let part = ((t - times[k - 1]) / (times[k] - times[k - 1])).clamp(0.0, 1.0);
    values[k - 1] + part * (values[k] - values[k - 1])
}

fn draw_residual(area: &Area, fit: &Fit) -> Drawn {
    let unit = fit.unit();
    let gain = fit.best().signal.gain;
    let missed = samples(fit, |t, v| 100.0 * (v - fit.value(t)) / gain);
    // Edges within one sample would hide all else.
    let mut sizes: Vec<f64> = missed.iter().map(|(_, m)| m.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let most = 1.4 * sizes[(sizes.len() - 1) * 99 / 100].max(1e-3);
    let time = format!("time ({})", unit.name());
    let [first, last] = [ends(fit).0, ends(fit).1].map(|time| unit.of(time));
    let mut graph = graph(area, (Some(&time), first..last), ("residual (% of the light)", -most..most), 72)?;
    let kept = missed.into_iter().map(|(t, m)| (t, m.clamp(-most, most)));
    graph.draw_series(LineSeries::new(kept, pen(GREY, 1.0)))?;
    graph.draw_series([PathElement::new([(first, 0.0), (last, 0.0)], pen(BLUE, 2.5))])?;
    Ok(())
}

fn ends(fit: &Fit) -> (f64, f64) {
    let times = &fit.samples.times;
    (times[0], times[times.len() - 1])
}

/// What `f` makes of the samples; of many, the least and the greatest of neighbours.
fn samples(fit: &Fit, f: impl Fn(f64, f64) -> f64) -> Vec<(f64, f64)> {
    let unit = fit.unit();
    let samples = fit.samples.times.iter().zip(&fit.samples.values);
    let all: Vec<(f64, f64)> = samples.map(|(t, v)| (unit.of(*t), f(*t, *v))).collect();
    if all.len() <= MOST {
        return all;
    }
    let together = all.len().div_ceil(MOST / 2);
    let ends = |few: &[(f64, f64)]| {
        let least = few.iter().map(|(_, v)| *v).fold(f64::INFINITY, f64::min);
        let greatest = few.iter().map(|(_, v)| *v).fold(f64::NEG_INFINITY, f64::max);
        [(few[0].0, least), (few[few.len() - 1].0, greatest)]
    };
    all.chunks(together).flat_map(ends).collect()
}

fn range(values: impl Iterator<Item = f64>, room: f64) -> Range<f64> {
    let ends = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) = values.fold(ends, |(low, high), v| (low.min(v), high.max(v)));
    let room = room * (high - low);
    low - room..high + room
}
