//! The two set-ups side by side: which doses of light the same shutter leaves of equal pulses, and of those made for
//! it.

use std::error::Error;

use chart::plotters::prelude::*;
use chart::plotters::style::text_anchor::{HPos, VPos};
use chart::{Area, Axis, BLUE, Drawn, SCALE, VERMILION, axes, pen};
use shutter_curve::ShutterCurve;
use shutter_fit::unit::short;

use super::drawing::{below, draw_curve, graph, lit, page, steps};
use crate::report::axis;
use shutter_plan::lamp::Lamp;
use shutter_plan::plan::Plan;

const SIZE: (i32, i32) = (1000, 760);
const TITLE: i32 = 34;
const LEFT: i32 = 650;
/// With more pulses than this, their doses would not be legible below their bars.
const MOST_LABELS: usize = 12;
/// How much of each share the lamp is on, where the scene does not say.
const DUTY: f32 = 0.5;

/// The plan's pulses in both set-ups, as an SVG: equal ones around the triggers while the camera's own shutter stays
/// open, the same with the shutter in the light's path, and pulses of equal doses there.
pub fn set_ups(name: &str, plan: &Plan) -> Result<String, Box<dyn Error>> {
    let curve = &plan.curve.as_ref().ok_or("the set-ups are told apart by a curve, and the scene has none")?.shutter;
    let n = plan.triggers.len();
    let duty = match plan.lamp {
        Lamp::Doses { duty } => duty,
        _ => DUTY,
    };
    // As long as a pulse of the same dose where the shutter is fully open, so that both set-ups get the same light.
    let length = duty * curve.exposure() / n as f32;
    let around = |t: f32| (t - 0.5 * length, t + 0.5 * length);
    let equal: Vec<_> = plan.triggers.iter().map(|trigger| around(trigger.time as f32)).collect();
    let time = |i: usize, part: f32| curve.inverse_cdf((i as f32 + 0.5 + part * duty) / n as f32);
    let even = (0..n).map(|i| (time(i, -0.5), time(i, 0.5))).collect();
    let rows = [
        ("The curve is emulated: the camera stays open, equal pulses come at the triggers", false, &equal),
        ("The shutter is in the light's path: it dims the same pulses a second time", true, &equal),
        ("The shutter is in the light's path: these pulses get equal doses through it", true, &even),
    ];
    let title = format!("The doses of {n} pulses with the shutter {name}, emulated and in the light's path");
    let name = format!("{name}: the light of {n} pulses in the two set-ups");
    let facts = "outlined: the lamp is on; filled: its light that arrives; dashed: the curve that is meant";
    page(SIZE, &title, [&name, facts], &[], |page| {
        for (area, row) in page.split_evenly((rows.len(), 1)).iter().zip(rows) {
            let (title, rest) = area.split_vertically(TITLE * SCALE);
            let label = chart::text(15 * SCALE, HPos::Left, VPos::Center);
            title.draw_text(row.0, &label, (24 * SCALE, 20 * SCALE))?;
            let (left, right) = rest.split_horizontally(LEFT * SCALE);
            let (is_shuttered, pulses) = (row.1, row.2);
            draw_light(&left, plan, curve, is_shuttered, pulses)?;
            let dose = |&(on, off): &(f32, f32)| match is_shuttered {
                true => (curve.cdf(off) - curve.cdf(on)) * curve.exposure() / length,
                false => (off - on) / length,
            };
            draw_doses(&right, &pulses.iter().map(|pulse| dose(pulse).into()).collect::<Vec<_>>())?;
        }
        Ok(())
    })
}

/// The lamp in outlines, and what of its light comes through.
fn draw_light(area: &Area, plan: &Plan, curve: &ShutterCurve, is_shuttered: bool, pulses: &[(f32, f32)]) -> Drawn {
    let (unit, zero, name) = (plan.unit, plan.origin(), axis(plan));
    let time = |t: f32| unit.of(f64::from(t) - zero);
    let mut graph = graph(area, plan, "openness", Some(&name), 0.0..1.08)?;
    let at = |t: f32| {
        let openness = if is_shuttered { curve.openness(t) } else { 1.0 };
        (time(t), f64::from(openness))
    };
    graph.draw_series(pulses.iter().map(|&(on, off)| Polygon::new(below(on, off, 32, at), lit())))?;
    graph.draw_series(pulses.iter().map(|&(on, off)| {
        let (on, off) = (time(on), time(off));
        PathElement::new([(on, 0.0), (on, 1.0), (off, 1.0), (off, 0.0)], pen(VERMILION, 1.0))
    }))?;
    if is_shuttered {
        draw_curve(&mut graph, plan, curve, |t| curve.openness(t))
    } else {
        // The curve as it is meant, and the camera as it is.
        let start = curve.open_start();
        let curve = steps(start, curve.close_end(), 100).map(|t| (time(t), f64::from(curve.openness(t))));
        let dashes = DashedLineSeries::new(curve, 6 * SCALE, 5 * SCALE, pen(BLUE, 1.5));
        graph.draw_series(dashes)?;
        Ok(())
    }
}

/// A bar for the dose of each pulse, 1 being that of an equal pulse which nothing dims.
fn draw_doses(area: &Area, doses: &[f64]) -> Drawn {
    let n = doses.len() as f64;
    let pulse = |x: &f64| format!("{x:.0}");
    let percent = |y: &f64| format!("{:.0} %", 100.0 * y);
    let across = Axis { range: -0.5..n - 0.5, name: Some("pulse"), labels: doses.len().min(6), label: &pulse };
    let up = Axis { range: 0.0..1.3, name: Some("dose"), labels: 4, label: &percent };
    let mut graph = axes(area, across, up, 62)?;
    let bars = (0u32..).zip(doses).map(|(i, &dose)| {
        let i = f64::from(i);
        Rectangle::new([(i - 0.36, 0.0), (i + 0.36, dose)], lit())
    });
    graph.draw_series(bars)?;
    if doses.len() <= MOST_LABELS {
        let label = chart::text(10 * SCALE, HPos::Center, VPos::Bottom);
        let labels = (0u32..).zip(doses).map(|(i, &dose)| {
            let percent = short((100.0 * dose).round(), 3);
            EmptyElement::at((f64::from(i), dose)) + Text::new(percent, (0, -3 * SCALE), label.clone())
        });
        graph.draw_series(labels)?;
    }
    Ok(())
}
