//! What a shutter tester says: the exposure beside the nearest speed of the scale, and the curve's times by their
//! names.

use crate::errors::Measured;
use crate::outcome::{Fit, From};
use crate::unit::{decimals, plus_minus, short, stops};

/// The full steps of the usual scale that are no powers of two, in parts of a second.
const FRACTIONS: [f64; 13] = [8000.0, 4000.0, 2000.0, 1000.0, 500.0, 250.0, 125.0, 60.0, 30.0, 15.0, 8.0, 4.0, 2.0];

/// A speed as a dial has it, its part of a second with so many decimals.
fn dial(seconds: f64, places: usize) -> String {
    // From a third of a second on, seconds are what a dial shows.
    if seconds < 0.3 { format!("1/{:.places$} s", 1.0 / seconds) } else { format!("{} s", short(seconds, 3)) }
}

/// The nearest speed of the scale, in seconds; none where that is more than a step away, as of what is no camera's
/// shutter.
pub fn nearest(seconds: f64) -> Option<f64> {
    let whole = (0..10).map(|k| f64::from(1 << k));
    let scale = FRACTIONS.into_iter().map(|part| 1.0 / part).chain(whole);
    let far = |speed: &f64| (seconds / speed).log2().abs();
    scale.min_by(|a, b| far(a).total_cmp(&far(b))).filter(|it| far(it) < 0.75)
}

/// The exposure beside what it is called, or the nearest speed of the scale.
pub fn speed(fit: &Fit) -> Option<String> {
    let seconds = fit.exposure.value;
    let (nominal, called) = match fit.nominal {
        Some(nominal) => (nominal, format!("{} nominal", dial(nominal, 0))),
        None => {
            let nearest = nearest(seconds)?;
            (nearest, format!("nearest full stop {}", dial(nearest, 0)))
        }
    };
    let ev = (seconds / nominal).log2();
    // No digit finer than the error.
    let parts = 1.0 / seconds;
    let places = decimals(parts * fit.exposure.error / seconds, 1).min(usize::from(parts < 100.0));
    let dial = dial(seconds, places);
    Some(format!("{dial} measured, {called}: {} EV", stops(ev)))
}

/// T1 to T3, as testers call them, with their errors, and TE and TOT to the digits that the length's error leaves.
pub fn times(fit: &Fit) -> [String; 2] {
    let unit = fit.unit();
    let curve = fit.best().signal.curve;
    let places = places(fit);
    let show = |seconds: f64| format!("{:.places$}", unit.of(seconds));
    // The errors are those of a curve that explains the trace.
    let part = |Measured { value, error }: Measured| match fit.from {
        From::Trace => show(value),
        From::Model => plus_minus(unit.of(value), unit.of(error), "").trim_end().into(),
    };
    let [opening, open, closing] = fit.parts.map(part);
    let [from, to] = fit.half_light();
    let half = show(to - from);
    let [rise, fall] = fit.rise_and_fall().map(show);
    let by = if fit.from == From::Trace { ", by the model" } else { "" };
    let total = show(curve.length());
    let name = unit.name();
    [
        format!("T1 {opening}, T2 {open}, T3 {closing} {name}{by}"),
        format!("TE {half} at half light, TOT {total}; 10 to 90 % in {rise} and {fall} {name}"),
    ]
}

/// The decimals of the curve's times: one digit more than their error has, and five digits at most.
pub fn places(fit: &Fit) -> usize {
    let unit = fit.unit();
    let length = unit.of(fit.best().signal.curve.length());
    let share = fit.efficiency.error / fit.efficiency.value;
    let finest = decimals(length, 5);
    if share > 0.0 && share.is_finite() { decimals(share * length, 1).min(finest) } else { finest }
}
