//! From a measured trace to the simplest shutter that serves. There is no file, terminal, thread or clock in it.
//!
//! [`fit`] takes a trace that [`crate::trace`] has read, and gives a [`Fit`]. Its stages, in the order in which they happen:
//!
//! - [`crate::trace`]: the pulses, each in its frame, and the noise; `shots`: which frames are fitted;
//! - `frame`: a frame fitted by every kind: in its own `units`, as `bins`, by a `search` from `starts` with `solve`, with the
//!   `columns` of a drift and a `hum`, and the `noise` that is left;
//! - `choice`: the kinds compared, and one chosen;
//! - `errors`: its results with their standard errors; `doubts`: what may be wrong with them;
//! - `structure`, `patterns` (one by a `lag`): does that explain the samples? `explain`: or does a flicker? `running`: the results of the samples themselves, where it does not;
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
mod explain;
mod frame;
mod gaps;
mod hum;
mod json;
mod kind;
mod lag;
mod missed;
mod noise;
mod outcome;
mod patterns;
mod ramp;
pub mod report;
pub mod rows;
mod running;
mod search;
mod shots;
mod signal;
mod solve;
mod speed;
mod starts;
mod structure;
pub mod trace;
pub mod unit;
mod units;

use crate::trace::{Light, Pulses, Refusal, Trace, Warning, pulses, undone};
pub use curve::Curve;
pub use delay::{Delay, Sync};
pub use errors::Measured;
use frame::FrameFits;
pub use json::json;
pub use outcome::{Candidate, Fit, Frames, From, Options, Reason, Test, Tolerance};
pub use report::{because, text};
pub use signal::{Flicker, Hum, Kind, Signal};

/// The most triggers of a frame that are judged and planned.
pub const MOST_TRIGGERS: u32 = 10_000;

/// Fits a trace. `progress` is told the share that is done.
///
/// # Errors
/// A trace without a whole pulse or with too few samples, a frame that is not there, a full light below what is seen.
pub fn fit(
    trace: &Trace,
    options: &Options,
    progress: &mut dyn FnMut(f64),
) -> Result<Fit, Refusal> {
    let n = options.triggers.clamp(1, MOST_TRIGGERS);
    let pulses = found(trace, options.light)?;
    let asked = shots::asked(&pulses.frames, options.frame)?;
    let gap = gaps::gaps(&pulses, &pulses.frames[asked])?;
    let counted = Frames::new(&pulses.frames, asked);
    let differ = shots::differ(&pulses.frames, counted.scatter, pulses.relative_noise());
    let fits = &explain::fits(&pulses, &pulses.frames[asked], options.mains, progress);
    progress(1.0);

    let candidates = choice::candidates(fits, n);
    let (chosen, reason) = choice::choose(options, &candidates, fits);
    let peak = outcome::peak(options.full, &pulses, &candidates[chosen as usize])?;
    let (test, hidden) = judged(fits, chosen, reason);
    let mut model = errors::results(fits, chosen, n).with_hidden(hidden);
    let from_trace = if test.explained { None } else { running::results(fits, Kind::Free, n) };
    let from = if from_trace.is_some() { From::Trace } else { From::Model };
    let results = match from_trace {
        Some(results) => {
            model = model.apart_from(&results);
            results
        }
        None => model.clone(),
    };
    let [model, results] = [model, results].map(|results| results.outside(&fits.units, peak));

    let frame = &pulses.frames[asked];
    let mut fit = Fit {
        candidates,
        chosen,
        reason,
        exposure: results.exposure,
        efficiency: results.efficiency,
        opens: results.start.value,
        delay: None,
        triggers: results.triggers,
        from,
        model_exposure: model.exposure,
        model_triggers: model.triggers,
        test,
        peak,
        frames: counted,
        nominal: None,
        reading: None,
        warnings: pulses.warnings.clone(),
        samples: pulses.trace.part(&frame.samples),
        inverted: pulses.inverted,
        middle: fits.units.seconds(0.0),
    };
    fit.warnings.extend(gap);
    if let Some(sync) = &options.sync {
        let signal = fit.best().signal;
        let (delay, doubts) =
            delay::measure(sync, &signal, results.start, &fit.triggers, &pulses, asked)?;
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

/// The pulses of the trace; those without a capacitor before the recorder, where the dark asks for that.
fn found(trace: &Trace, light: Light) -> Result<Pulses, Refusal> {
    let plain = pulses(trace, light);
    let is_sound = !matches!(plain, Err(Refusal::Unsound | Refusal::TooFewSamples { .. }));
    let coupled = if is_sound && light == Light::Auto { undone(trace) } else { None };
    let Some((mut pulses, seconds, error)) = coupled else { return plain };
    pulses.warnings.push(Warning::Coupled { seconds });
    // Under the pulse and behind it the level is off by what its charge is not known to.
    let open = pulses.frames.iter().map(|frame| frame.exposure).fold(0.0, f64::max);
    pulses.rounding = pulses.rounding.hypot(0.15 * error * open / seconds * pulses.light());
    Ok(pulses)
}

/// Does the chosen kind explain the trace, and by what shares of the exposure may triggers and exposure be off nevertheless? A kind that
/// was taken for a tolerance need not follow every sample: there the freest is asked.
fn judged(fits: &FrameFits, chosen: Kind, reason: Reason) -> (Test, [f64; 2]) {
    let kind = match reason {
        Reason::Tolerance(_) => Kind::Free,
        _ => chosen,
    };
    let found = structure::structure(fits, kind);
    let at = fits.units.seconds(found.at);
    let test = Test {
        explained: found.explained,
        tested: found.tested,
        sigma: found.sigma,
        unseen: found.unseen,
        share: found.share,
        at,
    };
    (test, found.hidden)
}
