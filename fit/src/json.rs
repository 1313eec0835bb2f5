//! A fit for another program: one object, whose names and codes stay as they are.

use serde_json::{Value, json};

use crate::delay::Delay;
use crate::errors::Measured;
use crate::outcome::{Fit, From};
use crate::trace::{Clock, Reading, Warning};

/// The fit of the trace `name`, with all warnings about it, as an object of JSON. What is not known is null, and all
/// times but the delay count from the trace's time 0.
pub fn json(name: &str, fit: &Fit, warnings: &[Warning]) -> Value {
    let [_, open_s, closes_s, closed_s] = fit.best().signal.curve.times();
    let (unit, rate_hz) = match fit.reading.as_ref().map(|reading| reading.clock) {
        Some(Clock::Unit(unit)) => (Some(unit.name()), None),
        Some(Clock::Rate(hertz)) => (None, Some(hertz)),
        None => (None, None),
    };
    let switch = fit.delay.as_ref().and_then(|delay| delay.switch);
    let of_delay = |of: fn(&Delay) -> f64| fit.delay.as_ref().map(of);
    let told = |warning: &Warning| json!({ "code": warning.code(), "text": warning.to_string() });
    json!({
        "trace": name,
        "model": fit.chosen.title(),
        "because": crate::report::because(fit),
        "exposure_s": fit.exposure.value,
        "exposure_error_s": fit.exposure.error,
        "efficiency": fit.efficiency.value,
        "efficiency_error": fit.most_efficiency().is_none().then_some(fit.efficiency.error),
        "efficiency_most": fit.most_efficiency(),
        "nominal_s": fit.nominal,
        "delay_s": of_delay(Delay::mean),
        "delay_error_s": of_delay(Delay::error),
        "delay_trigger_error_s": of_delay(Delay::trigger_error),
        "delay_spread_s": fit.delay.as_ref().and_then(Delay::spread),
        "delay_worst_s": fit.delay.as_ref().and_then(Delay::worst),
        "sync_falls": switch.map(|switch| switch.falls()),
        "sync_threshold": switch.map(|switch| switch.threshold),
        "delay_shots": fit.delay.as_ref().map(|delay| delay.shots.len()),
        "opens_s": fit.opens,
        "open_s": open_s,
        "closes_s": closes_s,
        "closed_s": closed_s,
        "parts_error_s": (fit.from == From::Model).then(|| fit.parts.map(|part| part.error)),
        "half_light_s": fit.half_light(),
        "rise_fall_s": fit.rise_and_fall(),
        "triggers": triggers(&fit.triggers),
        "triggers_from": if fit.from == From::Model { "model" } else { "trace" },
        "model_triggers": triggers(&fit.model_triggers),
        "columns": fit.reading.as_ref().map(columns),
        "unit": unit,
        "rate_hz": rate_hz,
        "samples": fit.samples.times.len(),
        "pulses": fit.frames.count,
        "pulse": fit.frames.fitted,
        "light_lowers": fit.inverted,
        "fit": {
            "explained": fit.test.explained,
            "tested": fit.test.tested,
            "sigma": fit.test.sigma,
            "structure": fit.test.share,
            "structure_at_s": fit.test.at,
            "rms": fit.best().rms,
        },
        "warnings": warnings.iter().map(told).collect::<Value>(),
    })
}

fn triggers(of: &[Measured]) -> Value {
    of.iter().map(|m| json!({ "time_s": m.value, "error_s": m.error })).collect()
}

fn columns(Reading { columns, time, signal, sync, .. }: &Reading) -> Value {
    json!({
        "count": columns,
        "time": time.as_ref().map(|time| time.0),
        "time_name": time.as_ref().map(|time| &time.1),
        "signal": signal.0,
        "signal_name": signal.1,
        "sync": sync.as_ref().map(|sync| sync.0),
        "sync_name": sync.as_ref().map(|sync| &sync.1),
    })
}
