//! A fit as the shutter of a scene.

use shutter_fit::report::{because, efficiency};
use shutter_fit::trace::{Refusal, Warning};
use shutter_fit::unit::{Unit, count, decimals, rounded};
use shutter_fit::{Curve, Fit, From, Kind, Reason, delay};

use crate::fault::What;
use crate::plan::Plan;
use crate::scene::{Flashes, Measured, Scene, Shutter};

/// A ramp or a plateau is at least this share of the greatest time: four times what the crate asks for.
const LEAST: f64 = 1.0 / (1 << 22) as f64;
/// The digits of a time, counted from the interval's first.
const DIGITS: i32 = 8;

/// The fit of the trace `name` as a shutter in this unit, or the one that suits it; its times count from the start of
/// opening. Where the results are the trace's own, it has their trigger times and no curve, unless a model was asked
/// for.
///
/// # Errors
/// Where it cannot be planned.
pub fn shutter(fit: &Fit, name: &str, unit: Option<Unit>) -> Result<Shutter, Refusal> {
    if fit.from == From::Model || fit.reason == Reason::Asked {
        return curve_shutter(fit, name, unit);
    }
    let of = Numbers::new(fit, unit);
    let times = fit.triggers.iter().map(|trigger| of.time(trigger.value - fit.opens));
    planned(fit, Shutter { trigger_times: Some(times.collect()), ..of.shutter(fit, name, fit.opens) })
}

/// The chosen model's curve, whether it explains the trace or not.
///
/// # Errors
/// Where it cannot be planned.
pub fn curve_shutter(fit: &Fit, name: &str, unit: Option<Unit>) -> Result<Shutter, Refusal> {
    let of = Numbers::new(fit, unit);
    let curve = fit.best().signal.curve;
    let opens = curve.start;
    let curve = resolved(&curve.mapped(1.0, -opens));
    let [_, open_end, close_start, close_end] = curve.times().map(|time| Some(of.time(time)));
    let has_ramps = fit.chosen > Kind::Trapezoid;
    let own = Shutter {
        open_end,
        close_start,
        close_end,
        shutteropening: has_ramps.then(|| inner(&curve).map(|x| to(x, 7)).to_vec()),
        ..of.shutter(fit, name, opens)
    };
    planned(fit, own)
}

/// What a user writes once: a table of the flashes, with what only they know left out.
pub fn flashes(shutter: &Shutter, triggers: usize) -> String {
    let (unit, has_curve) = (shutter.unit(), shutter.trigger_times.is_none());
    let in_path = match has_curve {
        true => "\n# set_up = \"in_path\"  # this shutter is in the light's path, and dims the flashes",
        false => "; in the light's path it needs a curve (--model free)",
    };
    let name = unit.name();
    format!(
        "\n# Yours: a fit writes this table once, and leaves it as it is.\n[flashes]\nunit = \"{name}\"\n\
         triggers = {triggers}\n\
         # set_up = \"emulated\" # the camera's own shutter stays open, and equal flashes expose as this shutter \
         does{in_path}\n\
         # timer_hz = 1000000 # your timer's rate, in Hz\n\
         # min_gap = 0.1 # {name}, what your lamp needs between two flashes\n\
         # delay = 2.5 # {name}, if you know better than the trace; with sync_falls = true or false\n"
    )
}

/// The shutter, if it can be planned.
fn planned(fit: &Fit, shutter: Shutter) -> Result<Shutter, Refusal> {
    let flashes = Flashes { triggers: Some(fit.triggers.len() as f64), ..Flashes::default() };
    // Whether its triggers come behind the edge depends on the lamp.
    let alone = Shutter { delay: None, delay_spread: None, sync_falls: None, ..shutter.clone() };
    match Plan::new(&Scene { shutter: alone, flashes, is_edited: false }) {
        Ok(_) => Ok(shutter),
        Err(fault) => {
            let crowded = matches!(*fault.what, What::Close { .. } | What::TimesClose(_));
            Err(Refusal::NoScene { reason: fault.reason(), crowded })
        }
    }
}

/// A fit's numbers as a scene has them.
struct Numbers {
    unit: Unit,
    places: usize,
}

impl Numbers {
    fn new(fit: &Fit, unit: Option<Unit>) -> Self {
        let unit = unit.unwrap_or(fit.unit());
        Self { unit, places: decimals(unit.of(fit.best().signal.curve.length()), DIGITS) }
    }

    fn time(&self, seconds: f64) -> f64 {
        to(self.unit.of(seconds), self.places)
    }

    /// All but the curve or the triggers, of a shutter that opens at this time of the trace.
    fn shutter(&self, fit: &Fit, name: &str, opens: f64) -> Shutter {
        let delay = fit.delay.as_ref();
        Shutter {
            unit: Some(self.unit),
            open_start: Some(0.0),
            // A model that does not explain the trace may open elsewhere.
            delay: delay.map(|delay| self.time(delay.mean() + opens - fit.opens)),
            delay_spread: delay.and_then(|it| it.spread()).map(|spread| rounded(self.unit.of(spread), 2)),
            sync_falls: delay.and_then(|delay| delay.switch).map(|switch| switch.falls()),
            sync_settles: settles(fit).map(|seconds| rounded(self.unit.of(seconds), 2)),
            nominal: fit.nominal.map(|it| rounded(self.unit.of(it), 7)),
            measured: Some(measured(fit, name)),
            ..Shutter::default()
        }
    }
}

/// For so long after its first edge a contact bounces.
fn settles(fit: &Fit) -> Option<f64> {
    fit.warnings.iter().find_map(|warning| match warning {
        Warning::SyncBounced { by, .. } => Some(1.1 * by),
        _ => None,
    })
}

/// What was read, and what came of it.
fn measured(fit: &Fit, name: &str) -> Measured {
    let (unit, delay) = (fit.unit(), fit.delay.as_ref());
    let error = |seconds: f64| rounded(unit.of(seconds), 2);
    let places = decimals(unit.of(fit.exposure.value), DIGITS);
    let model = match (fit.from, fit.reason) {
        (From::Trace, Reason::Asked) => {
            format!("{}, as asked, though it does not explain the trace", fit.chosen.title())
        }
        (From::Trace, _) => {
            let times = count(fit.triggers.len() as u64, "trigger");
            format!("none explains the trace: its own {times}; --model {} writes the nearest curve", fit.chosen.name())
        }
        _ => format!("{}, {}", fit.chosen.title(), because(fit)),
    };
    Measured {
        trace: one_line(name),
        read: fit.reading.as_ref().map(|reading| one_line(&reading.to_string())),
        model,
        unit,
        exposure: to(unit.of(fit.exposure.value), places),
        exposure_error: error(fit.exposure.error),
        peak: (fit.peak < 1.0).then_some(rounded(fit.peak, DIGITS)),
        efficiency: efficiency(fit),
        sync: delay.and_then(|it| it.switch).map(|switch| one_line(&delay::switch(&switch))),
        delay_error: delay.map(|it| error(it.error())),
        trigger_error: delay.map(|it| error(it.trigger_error())),
        delay_worst: delay.and_then(|it| it.worst()).map(error),
        shots: delay.map(|it| it.shots.len()),
        warnings: fit.warnings.iter().map(|warning| one_line(&warning.to_string())).collect(),
        checksum: None,
    }
}

/// `x` to so many decimals.
fn to(x: f64, places: usize) -> f64 {
    format!("{x:.places$}").parse().unwrap_or(x) + 0.0
}

fn one_line(text: &str) -> String {
    text.replace(|c: char| c.is_control(), "?")
}

/// The curve without the ramps, or the plateau, that are too short for `f32`.
fn resolved(curve: &Curve) -> Curve {
    let least = LEAST * curve.start.abs().max(curve.end().abs());
    let kept = |length: f64| if length < least { 0.0 } else { length };
    Curve { opening: kept(curve.opening), plateau: kept(curve.plateau), closing: kept(curve.closing), ..*curve }
}

/// The inner control points as `shutteropening` has them.
fn inner(curve: &Curve) -> [f64; 8] {
    let length = curve.length();
    let [o, c] = curve.controls;
    let opening = |x: f64| curve.opening * x / length;
    // The closing ramp's are counted back from the end.
    let closing = |x: f64| (length - curve.closing * x) / length;
    [opening(o[0]), o[1], opening(o[2]), o[3], closing(c[2]), c[3], closing(c[0]), c[1]]
}
