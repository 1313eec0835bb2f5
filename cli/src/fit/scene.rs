//! A fit as a scene for `shutter plan`.

use super::curve::Curve;
use super::delay;
use super::errors::Measured;
use super::outcome::{Fit, From};
use super::ramp::STRAIGHT;
use super::report::{because, efficiency, exposure};
use super::signal::Kind;
use crate::plan::Plan;
use crate::trace::Refusal;
use crate::unit::{Unit, decimals, trimmed};

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
/// The digits of a time, counted from the interval's first.
const DIGITS: i32 = 8;
/// Between triggers there are at least so many ticks, if a timer of at most 1 GHz can do that.
const TICKS: f64 = 100.0;

impl Fit {
    /// The fit as a scene; `name` tells in a comment where it came from.
    ///
    /// # Errors
    /// Where no scene can be made of it that can be planned.
    pub fn scene(&self, name: &str, zero: Zero) -> Result<Scene, Refusal> {
        let curve = self.best().signal.curve;
        let rounding = f64::from(f32::EPSILON) / 2.0 * curve.start.abs().max(curve.end().abs());
        let zero = if rounding > ROUNDING * curve.length() { Zero::Open } else { zero };
        let curve = match zero {
            Zero::Trace => curve,
            Zero::Open => curve.mapped(1.0, -curve.start),
        };
        let mut refused = String::new();
        // Rounding may push an extreme curve beyond what the crate accepts: a little nearer to a straight line it holds.
        for nearer in std::iter::once(0.0).chain((0..10).map(|i| 1e-7 * 4f64.powi(i))) {
            let text = self.write(name, &pulled(&curve, nearer));
            match Plan::parse(&text) {
                Ok(_) => return Ok(Scene { text, zero }),
                Err(fault) => refused = fault.reason,
            }
        }
        Err(Refusal::NoScene { reason: refused })
    }

    fn write(&self, name: &str, curve: &Curve) -> String {
        let unit = Unit::fit(curve.length());
        let name: String = name.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
        let n = self.triggers.len();
        let mut text = format!("# Fitted to {name}: {}, {}.\n", self.chosen.title(), because(self));
        if let Some(reading) = &self.reading {
            let reading = reading.to_string().replace(|c: char| c.is_control(), "?");
            text += &format!("# Read: {reading}.\n");
        }
        text += &format!(
            "# Exposure {}, efficiency {}, standard errors behind ±.\n",
            exposure(self),
            efficiency(self),
        );
        if self.from == From::Trace {
            text += &self.trace_triggers(curve);
        }
        for warning in &self.warnings {
            text += &format!("# Warning: {warning}.\n");
        }
        text += &format!("unit = \"{}\"\n", unit.name());
        let places = decimals(unit.of(curve.length()), DIGITS);
        let keys = ["open_start", "open_end", "close_start", "close_end"];
        for (key, time) in keys.into_iter().zip(curve.times()) {
            text += &format!("{key} = {}\n", trimmed(unit.of(time), places));
        }
        if self.chosen > Kind::Trapezoid {
            let numbers = inner(curve).map(|x| trimmed(x, 7)).join(", ");
            text += "# The ramps' inner control points t1 y1 t2 y2, t5 y5 t6 y6: times as fractions of the interval.\n";
            text += &format!("shutteropening = [{numbers}]\n");
        }
        text += &delay::line(self, unit, places);
        let hz = timer_hz(self.exposure.value / self.peak / n as f64, curve.length());
        text += &format!("triggers = {n}\ntimer_hz = {hz} # your timer's\n");
        text +=
            &format!("min_gap = 0 # {}, what your lamp needs between two flashes\n", unit.name());
        text
    }
}

impl Fit {
    /// The triggers of the trace, as times after the scene's time 0. A curve cannot say them: they are a comment.
    fn trace_triggers(&self, curve: &Curve) -> String {
        let unit = Unit::fit(curve.length());
        let zero = self.best().signal.curve.start - curve.start;
        let places = decimals(unit.of(curve.length()), DIGITS);
        let shown = |m: &Measured| trimmed(unit.of(m.value - zero), places);
        let times: Vec<String> = self.triggers.iter().map(shown).collect();
        let mut text = String::from(
            "# The curve below does not explain the trace. The trace's own triggers, in the unit below:\n\
             # trace_triggers = [\n",
        );
        for few in times.chunks(8) {
            text += &format!("#   {},\n", few.join(", "));
        }
        text + "# ]\n"
    }
}

/// The curve with its control numbers so far on the way to a straight line's.
fn pulled(curve: &Curve, by: f64) -> Curve {
    let controls = curve
        .controls
        .map(|controls| std::array::from_fn(|k| controls[k] + by * (STRAIGHT[k] - controls[k])));
    Curve { controls, ..*curve }
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

/// A timer that tells the triggers apart, without more ticks than `u32` holds.
fn timer_hz(gap: f64, length: f64) -> u32 {
    let mut hz: u32 = 1_000_000;
    while gap * f64::from(hz) < TICKS && hz < 1_000_000_000 {
        hz *= 10;
    }
    while length * f64::from(hz) > f64::from(1u32 << 30) && hz > 1 {
        hz /= 10;
    }
    hz
}
