//! Fits to a trace, and what is told of them.

use serde::{Deserialize, Serialize};
use shutter_fit::delay::Sync;
use shutter_fit::fact::{Fact, Message};
use shutter_fit::trace::{self, Light, Reading, Recording, Refusal, Tell, Trace};
use shutter_fit::unit::Unit;
use shutter_fit::{Fit, From, Options, report, speed};
use shutter_plan::fitted::{curve_shutter, shutter};
use shutter_plan::scene::Shutter;

/// More samples are drawn as the least and the greatest of neighbours.
const MOST: usize = 2000;

/// How a file is to be read, and what of it is to be fitted; what is left out is the file's own.
#[derive(Default, Deserialize)]
#[serde(default)]
pub struct Asked {
    unit: Option<Unit>,
    /// The samples in a second.
    rate: Option<f64>,
    /// The first time that counts, in seconds, and the last one.
    from: Option<f64>,
    to: Option<f64>,
    /// The time's and the signal's column, from 1, or the signal's alone.
    columns: Vec<usize>,
    /// The sync's column, from 1.
    sync: Option<usize>,
    light: Light,
    /// The signal of full light.
    full: Option<f64>,
    /// Which pulse, from 1.
    frame: Option<usize>,
    triggers: u32,
}

/// A trace: what its columns are called, how it was read, and its fit or what is in the way of that.
#[derive(Serialize)]
pub struct Measured {
    names: Vec<Option<String>>,
    read: Option<Reading>,
    /// The whole record, as (seconds of the file, signal).
    raw: Vec<[f64; 2]>,
    fit: Result<Fitted, Message>,
}

/// A trace's fit. Times are in seconds of the scene.
#[derive(Serialize)]
struct Fitted {
    /// As the program writes it.
    shutter: Shutter,
    /// The curve beside a trace's own triggers, which it does not explain.
    curve: Shutter,
    facts: Vec<Fact>,
    /// As the program prints it.
    report: String,
    kind: &'static str,
    /// The nearest full stop of a dial.
    nearest_s: Option<f64>,
    pulses: usize,
    pulse: usize,
    /// By what share the exposures of all pulses differ.
    scatter: f64,
    light_lowers: bool,
    rms: f64,
    /// Each with its standard error.
    triggers: Vec<(f64, f64)>,
    warnings: Vec<Message>,
    /// The trace as (time, openness, residual).
    samples: Vec<[f64; 3]>,
}

/// Reads the trace in `bytes`, and fits it.
pub fn measured(name: &str, bytes: Vec<u8>, asked: &Asked, progress: &mut dyn FnMut(f64)) -> Measured {
    let names = trace::columns(&bytes).unwrap_or_default();
    let options = trace::Options {
        unit: asked.unit,
        columns: asked.columns.iter().map(usize::to_string).collect(),
        rate: asked.rate,
        from: asked.from,
        to: asked.to,
        sync: asked.sync.map(|number| number.to_string()),
    };
    let recording = trace::open(&bytes, &options);
    let pairs = |trace: &Trace| trace.times.iter().zip(&trace.values).map(|(t, v)| [*t, *v]).collect();
    // The window is one of the whole record.
    let has_window = asked.from.or(asked.to).is_some();
    let whole = has_window.then(|| trace::open(&bytes, &trace::Options { from: None, to: None, ..options }));
    let shown = whole.as_ref().unwrap_or(&recording);
    let raw = shown.as_ref().map_or(Vec::new(), |it| fewer(pairs(&it.trace)));
    drop(bytes);
    let read = recording.as_ref().ok().map(|recording| recording.reading.clone());
    let fit = recording.and_then(|it| fitted(name, it, asked, progress)).map_err(|it| it.message());
    Measured { names, read, raw, fit }
}

fn fitted(name: &str, recording: Recording, asked: &Asked, progress: &mut dyn FnMut(f64)) -> Result<Fitted, Refusal> {
    let options = Options {
        full: asked.full,
        frame: asked.frame,
        light: asked.light,
        triggers: Some(asked.triggers),
        sync: recording.sync.map(Sync::Channel),
        ..Options::default()
    };
    let mut fit = shutter_fit::fit(&recording.trace, &options, progress)?;
    fit.reading = Some(recording.reading);
    fit.warnings.splice(..0, recording.warnings);
    let (own, start) = (shutter(&fit, name, None)?, fit.opens);
    let curve = moved(curve_shutter(&fit, name, None)?, fit.best().signal.curve.start - start);
    let signal = &fit.best().signal;
    let samples = fit.samples.times.iter().zip(&fit.samples.values).map(|(&t, &v)| {
        let residual = (v - fit.value(t)) / signal.gain;
        [t - start, (v - signal.dark) / signal.gain, residual]
    });
    Ok(Fitted {
        curve: if own.trigger_times.is_some() { curve } else { own.clone() },
        shutter: own,
        facts: facts(&fit),
        report: report::text(name, &fit),
        kind: fit.chosen.title(),
        nearest_s: speed::nearest(fit.exposure.value),
        pulses: fit.frames.count,
        pulse: fit.frames.fitted,
        scatter: fit.frames.scatter,
        light_lowers: fit.inverted,
        rms: fit.best().rms,
        triggers: fit.triggers.iter().map(|m| (m.value - start, m.error)).collect(),
        warnings: fit.warnings.iter().map(Tell::message).collect(),
        samples: fewer(samples.collect()),
    })
}

/// A curve's shutter, so many seconds later.
fn moved(shutter: Shutter, by: f64) -> Shutter {
    let unit = shutter.unit();
    let later = |t: Option<f64>| t.map(|t| shutter_fit::unit::rounded(t + unit.of(by), 12));
    let Shutter { open_start, open_end, close_start, close_end, .. } = shutter;
    let [open_start, open_end, close_start, close_end] = [open_start, open_end, close_start, close_end].map(later);
    Shutter { open_start, open_end, close_start, close_end, ..shutter }
}

/// What the trace tells, in place of what its curve does.
fn facts(fit: &Fit) -> Vec<Fact> {
    let exposure = Fact::new("exposure", "exposure_s", fit.exposure.value, report::exposure(fit));
    [
        exposure.error(Some(fit.exposure.error)),
        Fact::words("times", speed::times(fit).join("; ")),
        Fact::words("efficiency", report::efficiency(fit)),
        Fact::words("test", test(fit)),
    ]
    .into()
}

/// Does a curve explain the trace?
fn test(fit: &Fit) -> String {
    match report::untested(fit) {
        _ if fit.from == From::Trace => "no curve explains the trace: the flashes are at the trace's own times".into(),
        _ if !fit.test.explained => "no curve explains the trace".into(),
        Some(why) => format!("untested: {why}"),
        None => "the curve explains the trace".into(),
    }
}

/// Of many samples the least and the greatest of neighbours.
fn fewer<const N: usize>(samples: Vec<[f64; N]>) -> Vec<[f64; N]> {
    if samples.len() <= MOST {
        return samples;
    }
    let together = samples.len().div_ceil(MOST / 2);
    let ends = |few: &[[f64; N]]| {
        let by_value = |a: &&[f64; N], b: &&[f64; N]| a[1].total_cmp(&b[1]);
        let ends = [few.iter().min_by(by_value), few.iter().max_by(by_value)];
        let mut ends = ends.map(|end| end.copied().unwrap_or([0.0; N]));
        ends.sort_by(|a, b| a[0].total_cmp(&b[0]));
        ends
    };
    samples.chunks(together).flat_map(ends).collect()
}

#[cfg(test)]
mod tests {
    use shutter_fit::trace::Warning;

    use super::*;

    #[test]
    fn no_message_names_an_argument_of_the_program() {
        let (refusals, warnings) = (Refusal::each(), Warning::each());
        let all = refusals.iter().map(Tell::message).chain(warnings.iter().map(Tell::message));
        all.for_each(|Message { text, .. }| assert!(!text.contains("--"), "{text}"));
    }
}
