//! A fit for another program: one object, whose names and codes stay as they are.

use serde_json::{Map, Value, json};

use crate::errors::Measured;
use crate::fact;
use crate::outcome::{Fit, From};
use crate::report::{because, facts, untested};
use crate::trace::{Clock, Reading, Tell, Warning};

/// The fit of the trace `name`, with all warnings about it, as an object of JSON. What is not known is null, and all
/// times but the delay count from the trace's time 0.
pub fn json(name: &str, fit: &Fit, warnings: &[Warning]) -> Value {
    let (unit, rate_hz) = match fit.reading.as_ref().map(|reading| reading.clock) {
        Some(Clock::Unit(unit)) => (Some(unit.name()), None),
        Some(Clock::Rate(hertz)) => (None, Some(hertz)),
        None => (None, None),
    };
    let mut all = Map::new();
    all.insert("trace".into(), json!(name));
    all.append(&mut fact::numbers(&facts(fit)));
    // What is not known is null.
    for error in ["efficiency_error", "delay_error_s"] {
        all.entry(error).or_insert(Value::Null);
    }
    let told: Vec<_> = warnings.iter().map(Tell::message).collect();
    let more = json!({
        "model": fit.chosen.title(),
        "because": because(fit),
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
            "tested": untested(fit).is_none(),
            "sigma": fit.test.sigma,
            "structure": fit.test.share,
            "structure_at_s": fit.test.at,
            "rms": fit.best().rms,
        },
        "warnings": told,
    });
    if let Value::Object(mut more) = more {
        all.append(&mut more);
    }
    all.into()
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
