//! A fit for another program: one object, whose names and codes stay as they are.

use serde::Serialize;

use crate::errors::Measured;
use crate::outcome::{Fit, From};
use crate::trace::{Clock, Reading, Warning};

#[derive(Serialize)]
struct Json<'a> {
    trace: &'a str,
    model: &'static str,
    because: String,
    exposure_s: f64,
    exposure_error_s: f64,
    efficiency: f64,
    efficiency_error: f64,
    nominal_s: Option<f64>,
    /// From the edge of the camera's sync to the opening.
    delay_s: Option<f64>,
    delay_error_s: Option<f64>,
    /// After the trace's time 0, as all times but the delay.
    opens_s: f64,
    open_s: f64,
    closes_s: f64,
    closed_s: f64,
    triggers: Vec<Trigger>,
    triggers_from: &'static str,
    model_triggers: Vec<Trigger>,
    columns: Option<Columns<'a>>,
    unit: Option<&'static str>,
    rate_hz: Option<f64>,
    samples: usize,
    pulses: usize,
    pulse: usize,
    light_lowers: bool,
    fit: Test,
    warnings: Vec<Told>,
}

#[derive(Serialize)]
struct Trigger {
    time_s: f64,
    error_s: f64,
}

#[derive(Serialize)]
struct Columns<'a> {
    count: usize,
    time: Option<usize>,
    time_name: Option<&'a str>,
    signal: usize,
    signal_name: Option<&'a str>,
}

#[derive(Serialize)]
struct Test {
    explained: bool,
    tested: bool,
    sigma: f64,
    structure: f64,
    structure_at_s: f64,
    rms: f64,
}

#[derive(Serialize)]
struct Told {
    code: &'static str,
    text: String,
}

fn triggers(of: &[Measured]) -> Vec<Trigger> {
    of.iter().map(|m| Trigger { time_s: m.value, error_s: m.error }).collect()
}

fn columns(reading: &Reading) -> Columns<'_> {
    Columns {
        count: reading.columns,
        time: reading.time.as_ref().map(|(number, _)| *number),
        time_name: reading.time.as_ref().and_then(|(_, name)| name.as_deref()),
        signal: reading.signal.0,
        signal_name: reading.signal.1.as_deref(),
    }
}

/// The fit of the trace `name`, with all warnings about it, as an object of JSON.
pub fn json<'a>(name: &'a str, fit: &'a Fit, warnings: &[Warning]) -> impl Serialize + use<'a> {
    let [_, open_s, closes_s, closed_s] = fit.best().signal.curve.times();
    let told = |warning: &Warning| Told { code: warning.code(), text: warning.to_string() };
    let (unit, rate_hz) = match fit.reading.as_ref().map(|reading| reading.clock) {
        Some(Clock::Unit(unit)) => (Some(unit.name()), None),
        Some(Clock::Rate(hertz)) => (None, Some(hertz)),
        None => (None, None),
    };
    Json {
        trace: name,
        model: fit.chosen.title(),
        because: crate::report::because(fit),
        exposure_s: fit.exposure.value,
        exposure_error_s: fit.exposure.error,
        efficiency: fit.efficiency.value,
        efficiency_error: fit.efficiency.error,
        nominal_s: fit.nominal,
        delay_s: fit.delay.map(|delay| delay.value),
        delay_error_s: fit.delay.map(|delay| delay.error),
        opens_s: fit.opens,
        open_s,
        closes_s,
        closed_s,
        triggers: triggers(&fit.triggers),
        triggers_from: match fit.from {
            From::Model => "model",
            From::Trace => "trace",
        },
        model_triggers: triggers(&fit.model_triggers),
        columns: fit.reading.as_ref().map(columns),
        unit,
        rate_hz,
        samples: fit.samples.times.len(),
        pulses: fit.frames.count,
        pulse: fit.frames.fitted,
        light_lowers: fit.inverted,
        fit: Test {
            explained: fit.test.explained,
            tested: fit.test.tested,
            sigma: fit.test.sigma,
            structure: fit.test.share,
            structure_at_s: fit.test.at,
            rms: fit.best().rms,
        },
        warnings: warnings.iter().map(told).collect(),
    }
}
