//! From a measured trace to the simplest shutter that serves. There is no file, terminal, thread or clock in it.
//!
//! [`fit`] takes a trace that [`crate::trace`] has read, [`fit_records`] several of one setting, and gives a [`Fit`].
//! Its stages, in the order in which they happen:
//!
//! - [`crate::trace`]: the pulses, each in its frame, and the noise; `shots`: which frames are fitted;
//! - `choice`: the frame fitted, the kinds compared, and one chosen. It asks `columns`, which adds a drift, a `hum` or
//!   a flicker where the samples show it to what `frame` fits: every kind, in the frame's own `units`, as `bins`, by a
//!   `search` from starts with `solve`, and the `noise` that is left;
//! - `structure`, `patterns` (one by a `lag`): does a fit explain the samples? `columns` and `choice` ask that, too;
//! - `errors`: the results with their standard errors; `running`: those of the samples themselves, where no curve
//!   explains them; `delay`: from the sync to the opening;
//! - `doubts`: what may be wrong with them, as a [`trace::Warning`];
//! - `report`, `json`: the [`Fit`] as text, and for a program.
//!
//! What is fitted is a `signal`, made of a `curve` with two `ramp`s.

mod bins;
mod choice;
mod columns;
mod curve;
pub mod delay;
mod doubts;
mod errors;
pub mod fact;
mod frame;
mod hum;
mod json;
mod lag;
mod missed;
mod noise;
mod outcome;
mod patterns;
mod ramp;
pub mod report;
mod running;
mod search;
mod shots;
mod signal;
mod solve;
pub mod speed;
mod structure;
pub mod trace;
pub mod unit;
mod units;

use std::borrow::Cow;

use crate::trace::{Frame, Light, Pulses, Refusal, Timing, Trace, Warning, guessed, median, pulses, start, undone};
pub use curve::Curve;
pub use delay::{Delay, Sync};
pub use errors::Measured;
pub use json::json;
use missed::Parts;
pub use outcome::{Candidate, Fit, Frames, From, Options, Reason, Test};
pub use report::{because, text};
pub use signal::{Flicker, Hum, Kind, Signal};
use structure::Structure;

/// The most triggers of a frame that are judged and planned.
pub const MOST_TRIGGERS: u32 = 10_000;

/// A trace whose pulses are found, and its sync.
#[derive(Clone)]
pub struct Record {
    pulses: Pulses,
    sync: Option<Sync>,
    timing: Timing,
}

impl Record {
    /// A trace with the `light`, `sync` and `timing` of its options; all others count in [`fit_records`].
    ///
    /// # Errors
    /// A trace without a whole pulse or with too few samples.
    pub fn new(trace: &Trace, options: &Options) -> Result<Self, Refusal> {
        let (sync, timing) = (options.sync.clone(), options.timing.clone());
        Ok(Self { pulses: found(trace, options.light)?, sync, timing })
    }

    /// With all its times, and those of its sync's channel, moved.
    fn shift(&mut self, by: f64) {
        self.pulses.shift(by);
        if let Some(Sync::Channel(channel)) = &mut self.sync {
            channel.shift(by);
        }
    }

    /// What its pulse of median exposure collects, in seconds of full light, before a model is fitted.
    pub fn exposure(&self) -> f64 {
        median(self.pulses.frames.iter().map(|frame| frame.exposure).collect())
    }
}

/// By how much the exposures of records differ, as a share of the shortest, and is that so little that they are of one
/// setting?
pub fn setting(records: &[Record]) -> (f64, bool) {
    let differ = shots::apart(records.iter().map(Record::exposure));
    (differ, differ <= shots::ALIKE)
}

/// Fits a trace. `progress` is told the share that is done.
///
/// # Errors
/// What [`Record::new`] and [`fit_records`] refuse.
pub fn fit(trace: &Trace, options: &Options, progress: &mut dyn FnMut(f64)) -> Result<Fit, Refusal> {
    fit_records(&[Record::new(trace, options)?], options, progress)
}

/// Fits the shots of all these records, which are of one setting, as if they were in one: the curve is that of the shot
/// of median exposure, and each shot gives a delay.
///
/// # Errors
/// A frame that is not there, a full light below what is seen, a sync that tells no delay.
///
/// # Panics
/// Without a record.
pub fn fit_records(records: &[Record], options: &Options, progress: &mut dyn FnMut(f64)) -> Result<Fit, Refusal> {
    let n = options.triggers.unwrap_or(16).clamp(1, MOST_TRIGGERS);
    let frames: Vec<Frame> = Shot::all(records).iter().map(|shot| shot.frame.clone()).collect();
    let asked = shots::asked(&frames, options.frame)?;
    // Times are those of the fitted shot's own segment.
    let Shot { record, frame, .. } = Shot::all(records)[asked];
    let later = records[record].timing.later(frame.crossings[0]);
    let mut records = Cow::Borrowed(records);
    if later != 0.0 {
        records.to_mut()[record].shift(-later);
    }
    let records = &records[..];
    let shots = Shot::all(records);
    let Shot { record, pulses, frame } = shots[asked];
    let gap = shots::gaps(pulses, frame)?;
    let counted = Frames::new(&frames, asked);
    let differ = shots::differ(&frames, pulses.relative_noise());
    let fits = &choice::fits(pulses, frame, options.mains, progress);
    progress(1.0);

    let is_explained = || structure::structure(fits, Kind::Free).test.explained;
    if pulses.bent && fits.of(Kind::Free).solution.signal.coupling.is_none()
        || (pulses.bent || pulses.coupled.is_some()) && !is_explained()
    {
        return Err(Refusal::Coupled);
    }
    // Of a record without any dark nothing tells the light.
    let Parts { pulse, .. } = Parts::new(fits, Kind::Free);
    if pulse.len() == pulses.trace.times.len() {
        return Err(Refusal::CutPulse { begins: true, ends: true });
    }
    let candidates = choice::candidates(fits, n);
    let (chosen, reason) = choice::choose(options, &candidates, fits);
    let peak = outcome::peak(options.full, pulses, &candidates[chosen as usize])?;
    let Structure { mut test, hidden, .. } = structure::structure(fits, chosen);
    test.at = fits.units.seconds(test.at);
    let mut model = errors::results(fits, chosen, n).with_hidden(hidden);
    let from_trace = |n| match chosen {
        _ if test.explained => None,
        Kind::Free => running::results(fits, Kind::Free, &model, n),
        _ => running::results(fits, Kind::Free, &errors::results(fits, Kind::Free, 1), n),
    };
    let early = from_trace(16).unwrap_or_else(|| errors::results(fits, chosen, 16)).outside(&fits.units, peak);
    let from_trace = from_trace(n);
    let from = if from_trace.is_some() { From::Trace } else { From::Model };
    let results = match from_trace {
        Some(mut results) => {
            // Full light is in doubt where the model is.
            let apart = results.exposure.value - model.exposure.value;
            model = model.apart_from(&results);
            results.exposure.widen(apart);
            results
        }
        None => model.clone(),
    };
    let [model, results] =
        [model, results].map(|results| results.outside(&fits.units, peak).timed(&records[record].timing));

    let mut fit = Fit {
        candidates,
        chosen,
        reason,
        exposure: results.exposure,
        efficiency: results.efficiency,
        parts: model.parts,
        opens: results.start.value,
        delay: None,
        triggers: results.triggers,
        from,
        model_exposure: model.exposure,
        model_triggers: model.triggers,
        test,
        peak,
        record,
        frames: counted,
        nominal: None,
        reading: None,
        warnings: pulses.warnings.clone(),
        samples: fits.uncoupled(pulses.recorded().part(&frame.samples)),
        inverted: pulses.inverted,
        middle: fits.units.seconds(0.0),
    };
    // What is doubtful of other records, once.
    Warning::add(&mut fit.warnings, records.iter().flat_map(|other| other.pulses.warnings.clone()));
    fit.warnings.extend(gap);
    let signal = fit.best().signal;
    let starts = [results.start, early.triggers[0]];
    if let Some((delay, doubts)) = delay::measure(records, &shots, asked, &signal, starts, &fit.triggers)? {
        fit.delay = Some(delay);
        fit.warnings.extend(doubts);
    }
    // Pulses of a lamp are no shots.
    let are_shots = !fit.warnings.iter().any(|warning| matches!(warning, Warning::Pulsed { .. }));
    if differ && are_shots {
        fit.warnings.push(Warning::ShotsDiffer { scatter: counted.scatter });
    }
    let doubts = doubts::doubts(&fit, fits, frame, options.full.is_some());
    fit.warnings.extend(doubts);
    if fit.is_determined() { Ok(fit) } else { Err(Refusal::Undetermined) }
}

/// A frame, and where it was recorded.
#[derive(Clone, Copy)]
struct Shot<'a> {
    record: usize,
    pulses: &'a Pulses,
    frame: &'a Frame,
}

impl<'a> Shot<'a> {
    fn all(records: &'a [Record]) -> Vec<Self> {
        let of = |(record, of): (usize, &'a Record)| {
            let pulses = &of.pulses;
            pulses.frames.iter().map(move |frame| Self { record, pulses, frame })
        };
        records.iter().enumerate().flat_map(of).collect()
    }
}

/// The pulses of the trace; those without a capacitor before the recorder, where one takes much of the light.
fn found(trace: &Trace, light: Light) -> Result<Pulses, Refusal> {
    let plain = pulses(trace, light);
    let may_be_coupled = match &plain {
        Ok(pulses) => pulses.bent,
        Err(refusal) => !matches!(refusal, Refusal::Unsound | Refusal::TooFewSamples { .. } | Refusal::NoPulse { .. }),
    };
    let coupled = may_be_coupled.then(|| coupled(trace, light)).flatten();
    coupled.filter(|coupled| !coupled.bent).map_or(plain, Ok)
}

fn coupled(trace: &Trace, light: Light) -> Option<Pulses> {
    let rates = guessed(trace)?;
    let mut found = pulses(&undone(trace, rates, start(trace)), light).ok()?;
    let sign = if found.inverted { -1.0 } else { 1.0 };
    let mut left = found.trace.times.iter().peekable();
    let recorded = trace.times.iter().zip(&trace.values).filter(|(t, _)| left.next_if_eq(t).is_some());
    let (times, values) = recorded.map(|(t, v)| (*t, sign * v)).unzip();
    found.coupled = Some((Trace { times, values }, rates));
    Some(found)
}
