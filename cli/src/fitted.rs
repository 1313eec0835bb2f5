//! A fit as a scene for `shutter plan`.

use shutter_fit::report::{because, efficiency, exposure};
use shutter_fit::trace::Refusal;
use shutter_fit::unit::{Unit, decimals, short, trimmed};
use shutter_fit::{Curve, Fit, From, Kind, Reason, delay};

use crate::fault::{Fault, What};
use crate::planned::Planned;
use crate::scene::KEYS;

/// Where a scene's time 0 is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "terminal", derive(clap::ValueEnum))]
pub enum Zero {
    /// As in the trace.
    #[default]
    Trace,
    /// Where the shutter starts to open.
    Open,
}

/// A scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// As TOML.
    pub text: String,
    /// Where its time 0 is in fact: where times would be lost in rounding, time 0 moves to the start of opening.
    pub zero: Zero,
}

/// By its rounding to `f32`, a time may be off by this share of the interval; else time 0 moves.
const ROUNDING: f64 = 1e-6;
/// A ramp or a plateau is at least this share of the greatest time: four times what the crate asks for.
const LEAST: f64 = 1.0 / (1 << 22) as f64;
/// The digits of a time, counted from the interval's first.
const DIGITS: i32 = 8;

/// The fit as a scene, in this unit or the one that suits it; `name` tells in a comment where it came from. Where the
/// results are the trace's own, the scene has their trigger times and no curve, unless a model was asked for.
///
/// # Errors
/// Where no scene can be made of it that can be planned.
pub fn scene(fit: &Fit, name: &str, zero: Zero, unit: Option<Unit>) -> Result<Scene, Refusal> {
    if fit.from == From::Model || fit.reason == Reason::Asked {
        return curve_scene(fit, name, zero, unit);
    }
    planned(write_times(fit, name, zero, unit.unwrap_or(fit.unit())), zero)
}

/// The scene of the chosen model's curve, whether it explains the trace or not.
pub fn curve_scene(fit: &Fit, name: &str, zero: Zero, unit: Option<Unit>) -> Result<Scene, Refusal> {
    let unit = unit.unwrap_or(fit.unit());
    let curve = fit.best().signal.curve;
    let rounding = f64::from(f32::EPSILON) / 2.0 * curve.start.abs().max(curve.end().abs());
    let zero = if rounding > ROUNDING * curve.length() { Zero::Open } else { zero };
    let curve = if zero == Zero::Open { curve.mapped(1.0, -curve.start) } else { curve };
    planned(write_curve(fit, name, &resolved(&curve), unit), zero)
}

/// The scene, if it can be planned.
fn planned(text: String, zero: Zero) -> Result<Scene, Refusal> {
    match Planned::parse(&text) {
        Ok(_) => Ok(Scene { text, zero }),
        Err(fault) => Err(no_scene(&fault)),
    }
}

/// What keeps a fit from being a scene.
pub fn no_scene(fault: &Fault) -> Refusal {
    let crowded = matches!(*fault.what, What::Close { .. } | What::TimesClose(_));
    Refusal::NoScene { reason: fault.reason(), crowded }
}

fn write_curve(fit: &Fit, name: &str, curve: &Curve, unit: Unit) -> String {
    let (title, because) = (fit.chosen.title(), because(fit));
    let mut text = format!("# Fitted to {}: {title}, {because}.\n", shown(name));
    if fit.from == From::Trace {
        text += "# This curve does not explain the trace, and its triggers are not the trace's own, which `shutter \
                 fit` without --model writes.\n";
    }
    text += &comments(fit, unit);
    let places = decimals(unit.of(curve.length()), DIGITS);
    for (key, time) in KEYS.into_iter().zip(curve.times()) {
        text += &format!("{key} = {}\n", trimmed(unit.of(time), places));
    }
    if fit.chosen > Kind::Trapezoid {
        let numbers = inner(curve).map(|x| trimmed(x, 7)).join(", ");
        text += "# The ramps' inner control points t1 y1 t2 y2, t5 y5 t6 y6: times as fractions of the interval.\n";
        text += &format!("shutteropening = [{numbers}]\n");
    }
    text += &delay::line(fit.delay.as_ref(), unit, places);
    text += &format!("triggers = {}\n", fit.triggers.len());
    text + &asked(fit, unit, true)
}

/// The trace's own triggers.
fn write_times(fit: &Fit, name: &str, zero: Zero, unit: Unit) -> String {
    let curve = &fit.best().signal.curve;
    let places = decimals(unit.of(curve.length()), DIGITS);
    let zero = if zero == Zero::Open { fit.opens } else { 0.0 };
    let time = |seconds: f64| trimmed(unit.of(seconds - zero), places);
    let model = fit.chosen.name();
    let mut text = format!(
        "# Measured in {}: no model explains the trace, so these are its own trigger times, without a curve.\n\
         # `--model {model}` writes the curve that comes nearest.\n",
        shown(name),
    );
    text += &comments(fit, unit);
    text += &format!("open_start = {}\ntrigger_times = [\n", time(fit.opens));
    for few in fit.triggers.chunks(8) {
        let few: Vec<String> = few.iter().map(|trigger| time(trigger.value)).collect();
        text += &format!("    {},\n", few.join(", "));
    }
    text += "]\n";
    text += &delay::line(fit.delay.as_ref(), unit, places);
    text + &asked(fit, unit, false)
}

/// What was read, and what came of it; below that, the unit.
fn comments(fit: &Fit, unit: Unit) -> String {
    let mut text = String::new();
    if let Some(reading) = &fit.reading {
        text += &format!("# Read: {}.\n", shown(&reading.to_string()));
    }
    if let Some(switch) = fit.delay.as_ref().and_then(|delay| delay.switch) {
        text += &format!("# Sync: it {}.\n", delay::switch(&switch));
    }
    text += &format!("# Exposure {}, efficiency {}, standard errors behind ±.\n", exposure(fit), efficiency(fit),);
    for warning in &fit.warnings {
        text += &format!("# Warning: {warning}.\n");
    }
    text + &format!("unit = \"{}\"\n", unit.name())
}

/// On one line.
fn shown(text: &str) -> String {
    text.replace(|c: char| c.is_control(), "?")
}

/// What is not measured: the lines that its user has to write, the lamp's gap, and what the speed is called.
fn asked(fit: &Fit, unit: Unit, has_curve: bool) -> String {
    let nominal = fit.nominal.map(|it| format!("nominal = {}\n", short(unit.of(it), 7)));
    let in_path = match has_curve {
        true => "\n# set_up = \"in_path\" # this shutter is in the light's path, and dims the flashes",
        false => "; in the light's path it needs a curve (--model free)",
    };
    format!(
        "# set_up = \"emulated\" # the camera's own shutter stays open, and equal flashes expose as this shutter \
         does{in_path}\n\
         # timer_hz = ... # your timer's rate, in Hz\n\
         min_gap = 0 # {}, what your lamp needs between two flashes\n{}",
        unit.name(),
        nominal.unwrap_or_default()
    )
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
