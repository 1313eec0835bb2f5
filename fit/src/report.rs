//! A fit as text: what was measured, each candidate, the results with their standard errors.

use std::fmt::{self, Write};
use std::ops::Range;

use serde_json::{Value, json};

use crate::curve::fractions;
use crate::delay::{self, Delay};
use crate::errors::Measured;
use crate::fact::{self, Fact};
use crate::outcome::{Fit, From, Reason, Test};
use crate::signal::Kind;
use crate::speed;
use crate::trace::{Warning, from_opening, sampling_interval};
use crate::unit::{MOST_PLACES, Unit, decimals, fixed, plus_minus, short, trimmed, without_dust};

/// Longer tables lose their middle; half as many rows stay at each end.
const MOST_ROWS: usize = 25;

/// The rows of a table of `n` that are left out.
pub fn hidden_rows(n: usize) -> Range<usize> {
    if n > MOST_ROWS { MOST_ROWS / 2..n - MOST_ROWS / 2 } else { n..n }
}

/// The fit of the trace `name`, for a terminal.
pub fn text(name: &str, fit: &Fit) -> String {
    let mut text = String::new();
    write_trace(&mut text, name, fit).expect("a string takes all");
    for part in [write_models, write_results, write_triggers] {
        text.push('\n');
        part(&mut text, fit).expect("a string takes all");
    }
    text
}

fn write_trace(out: &mut String, name: &str, fit: &Fit) -> fmt::Result {
    let (times, signal) = (&fit.samples.times, &fit.best().signal);
    let step = sampling_interval(times);
    writeln!(out, "trace        {name}")?;
    if let Some(reading) = &fit.reading {
        writeln!(out, "signal       {}", reading.among(&reading.signal))?;
        writeln!(out, "times        {}", reading.times())?;
        if let Some(sync) = &reading.sync {
            writeln!(out, "sync         {}", reading.among(sync))?;
        }
    }
    if let Some(switch) = fit.delay.as_ref().and_then(|delay| delay.switch) {
        writeln!(out, "             {}", delay::switch(&switch))?;
    }
    write!(out, "pulse        {} of {}", fit.frames.fitted, fit.frames.count)?;
    if fit.frames.count > 1 {
        let scatter = short(100.0 * without_dust(fit.frames.scatter, 1.0), 2);
        write!(out, "; the exposures scatter by {scatter} %")?;
    }
    let (apart, rate) = (Unit::fit(step).show(step), short(1.0 / step, 4));
    writeln!(out, "\nsamples      {}, {apart} apart: {rate} Hz", times.len())?;
    let gain = short(signal.gain, 4);
    let dark = short(without_dust(fit.as_measured(signal.dark), signal.gain), 4);
    let way = if fit.inverted { "below" } else { "above" };
    writeln!(out, "light        {gain} {way} the dark at {dark}")
}

/// Each candidate, which was chosen, and why.
fn write_models(out: &mut String, fit: &Fit) -> fmt::Result {
    let unit = fit.unit();
    writeln!(out, "  model                   opening      open   closing   rms %    ΔBIC    shift")?;
    for candidate in &fit.candidates {
        let kind = candidate.signal.kind;
        let c = &candidate.signal.curve;
        let mark = if kind == fit.chosen { '*' } else { ' ' };
        let time = |t: f64, digits| short(unit.of(without_dust(t, c.length())), digits);
        let [opens, open, closes] = [c.opening, c.plateau, c.closing].map(|t| time(t, 4));
        let rms = short(100.0 * without_dust(candidate.rms, 1.0), 3);
        let shift = time(candidate.shift, 2);
        let bic = trimmed(candidate.delta_bic, 0);
        let title = kind.title();
        writeln!(out, "{mark} {title:22}  {opens:>8}  {open:>8}  {closes:>8}  {rms:>6}  {bic:>6}  {shift:>7}")?;
    }
    let name = unit.name();
    writeln!(out, "  in {name}; shift: the most by which a trigger lies off the free model's")?;
    writeln!(out, "chosen       {}", fit.chosen.title())?;
    writeln!(out, "because      {}", because(fit))?;
    writeln!(out, "fit          {}", judgement(fit))
}

fn write_results(out: &mut String, fit: &Fit) -> fmt::Result {
    for (label, told) in fact::lines(&facts(fit)) {
        writeln!(out, "{label:13}{told}")?;
    }
    writeln!(out, "             (standard errors behind ±)")
}

/// The chosen curve, and what it is good for: times are in seconds, and count from the trace's time 0.
pub fn facts(fit: &Fit) -> Vec<Fact> {
    let (unit, places) = (fit.unit(), speed::places(fit));
    let curve = &fit.best().signal.curve;
    let [_, open_s, closes_s, closed_s] = curve.times();
    let [start, open_end, close_start, end] = curve.times().map(|time| fixed(unit.of(time), places));
    let name = unit.name();
    let (delay, [to_opening, spread]) = (fit.delay.as_ref(), delay::told(fit.delay.as_ref(), unit));
    let of_delay = |of: fn(&Delay) -> f64| delay.map(of);
    let switch = delay.and_then(|delay| delay.switch);
    let ramps = (fit.chosen > Kind::Trapezoid).then(|| {
        let [o, c] = curve.controls.map(|controls| controls.map(|x| trimmed(x, 3)).join(" "));
        let told = "(the closing ramp seen backwards; fractions of each ramp)";
        Fact::words("ramps", format!("x1 y1 x2 y2: {o} opening, {c} closing\n             {told}"))
    });
    let why = fit.most_efficiency().map_or("", |_| ": a soft start or end does not show");
    let most = fit.most_efficiency();
    let peak = (fit.peak < 1.0).then(|| format!("{} % of full light", short(100.0 * fit.peak, 4)));
    let silent = |key, value: Value| Fact::new("", key, value, "");
    let delays = vec![
        Fact::new("delay", "delay_s", of_delay(Delay::mean), to_opening).error(of_delay(Delay::error)),
        silent("delay_trigger_error_s", json!(of_delay(Delay::trigger_error))),
        Fact::new("spread", "delay_spread_s", delay.and_then(Delay::spread), spread),
        silent("delay_worst_s", json!(delay.and_then(Delay::worst))),
        silent("delay_shots", json!(delay.map(|delay| delay.shots.len()))),
        silent("sync_falls", json!(switch.map(|switch| switch.falls()))),
        silent("sync_threshold", json!(switch.map(|switch| switch.threshold))),
    ];
    let light = vec![
        Fact::words("tester", speed::times(fit).join("\n             ")),
        silent("half_light_s", json!(fit.half_light())),
        silent("rise_fall_s", json!(fit.rise_and_fall())),
        Fact::new("exposure", "exposure_s", fit.exposure.value, exposure(fit) + &source(fit))
            .error(Some(fit.exposure.error)),
        Fact::new("speed", "nominal_s", fit.nominal, speed::speed(fit).unwrap_or_default()),
        Fact::new("efficiency", "efficiency", fit.efficiency.value, efficiency(fit) + why)
            .error(Some(fit.efficiency.error).filter(|_| most.is_none())),
        silent("efficiency_most", json!(most)),
        Fact::words("peak", peak.unwrap_or_default()),
    ];
    let curve = vec![
        Fact::new("opens", "opens_s", fit.opens, format!("from {start} to {open_end} {name}")),
        silent("open_s", json!(open_s)),
        Fact::new("closes", "closes_s", closes_s, format!("from {close_start} to {end} {name}")),
        silent("closed_s", json!(closed_s)),
        silent("parts_error_s", json!((fit.from == From::Model).then(|| fit.parts.map(|part| part.error)))),
    ];
    [curve, delays, ramps.into_iter().collect(), light].concat()
}

/// Why nothing tells whether the model explains the trace, where nothing does.
pub fn untested(fit: &Fit) -> Option<&'static str> {
    let is_of_light =
        |it: &Warning| !matches!(it, Warning::Clipped { .. } | Warning::CutTail { .. } | Warning::Pulsed { .. });
    match fit.exposure {
        _ if !fit.test.explained => None,
        _ if !fit.test.tested => Some("there is too little dark to know the noise by"),
        Measured { value, error } if error > 0.5 * value => Some("the trace tells too little"),
        _ if fit.warnings.iter().all(is_of_light) => None,
        _ => Some("what is recorded is not the light alone"),
    }
}

fn judgement(fit: &Fit) -> String {
    let Test { explained, sigma, share, at, .. } = fit.test;
    match untested(fit) {
        Some(why) => format!("untested: {why}"),
        None if explained => "the model explains the trace".into(),
        _ => format!(
            "structure that the model has not: {} % of the light,\n             {} ({} standard deviations)",
            short(100.0 * share.abs(), 2),
            from_opening(at - fit.best().signal.curve.start),
            short(sigma, 2)
        ),
    }
}

/// What the exposure is taken from, where that is not the model.
fn source(fit: &Fit) -> String {
    let Measured { value, error } = fit.model_exposure;
    match fit.from {
        From::Model => String::new(),
        From::Trace => {
            format!(", by the trace (the model: {})", fit.unit().plus_minus(value, error))
        }
    }
}

fn write_triggers(out: &mut String, fit: &Fit) -> fmt::Result {
    let unit = fit.unit();
    let (time, error) = (format!("time ({})", unit.name()), format!("error ({})", unit.name()));
    let beside = if fit.from == From::Trace { "  by the model" } else { "" };
    writeln!(out, "    #        u  {time:>15}  {error:>12}{beside}")?;
    let least = fit.triggers.iter().map(|trigger| unit.of(trigger.error));
    // Two digits of the least error, and as many decimals for all: a column that the eye can run down.
    let places = decimals(least.fold(f64::INFINITY, f64::min), 2).min(MOST_PLACES);
    let hidden = hidden_rows(fit.triggers.len());
    let all = fractions(fit.triggers.len() as u32).zip(&fit.triggers);
    for (i, (u, trigger)) in all.enumerate() {
        if i == hidden.start {
            writeln!(out, "  ...  {} more", hidden.len())?;
        }
        if hidden.contains(&i) {
            continue;
        }
        let (time, error) = (at(fit, trigger.value), unit.of(trigger.error));
        write!(out, "{i:5}  {u:.5}  {time:>15}  {error:>12.places$}")?;
        match fit.from {
            From::Model => writeln!(out)?,
            From::Trace => writeln!(out, "  {:>12}", at(fit, fit.model_triggers[i].value))?,
        }
    }
    Ok(())
}

/// A time, to a hundredth of a per mille of the interval.
fn at(fit: &Fit, seconds: f64) -> String {
    let unit = fit.unit();
    let places = decimals(unit.of(fit.best().signal.curve.length()), 5);
    fixed(unit.of(seconds), places)
}

/// The exposure and its standard error.
pub fn exposure(fit: &Fit) -> String {
    let Measured { value, error } = fit.exposure;
    fit.unit().plus_minus(value, error)
}

/// The efficiency and its standard error, or the most that it may be.
pub fn efficiency(fit: &Fit) -> String {
    let Measured { value, error } = fit.efficiency;
    match fit.most_efficiency() {
        Some(most) => format!("at most {} %", short(100.0 * most, 3)),
        None => plus_minus(100.0 * value, 100.0 * error, "%"),
    }
}

/// Why the model was chosen.
pub fn because(fit: &Fit) -> String {
    match fit.reason {
        Reason::Asked => "as asked".into(),
        Reason::Explains => "the simplest that explains the trace".into(),
        Reason::Criterion { effective } => {
            format!("best for its number of parameters (BIC); {} independent samples", trimmed(effective, 0))
        }
    }
}
