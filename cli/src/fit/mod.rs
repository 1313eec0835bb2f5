//! From a measured trace to the simplest shutter that serves. There is no file, terminal, thread or clock in it.
//!
//! [`fit`] takes a trace that [`crate::trace`] has read, and gives a [`Fit`]. Its stages, in the order in which they happen:
//!
//! - [`crate::trace`]: the pulses, each in its frame, and the noise; `shots`: which frames are fitted;
//! - `frame`: a frame fitted by every kind: in its own `units`, as `bins`, by a `search` from `starts` with `solve`, with the
//!   `columns` of a drift and a `hum`, and the `noise` that is left;
//! - `shots`, `choice`: the kinds compared, and one chosen;
//! - `errors`: its results with their standard errors; `doubts`: what may be wrong with them;
//! - `report`, `scene`: the [`Fit`] as text, and as a scene for `shutter plan`.
//!
//! What is fitted is a `signal`, made of a `curve` with two `ramp`s.

mod bins;
mod choice;
mod columns;
mod curve;
mod doubts;
mod errors;
mod frame;
mod hum;
mod missed;
mod noise;
mod outcome;
mod ramp;
mod report;
mod scene;
mod search;
mod shots;
mod signal;
mod solve;
mod starts;
mod units;

use std::iter::once;

use crate::plan::MOST_TRIGGERS;
use crate::trace::{Pulses, Refusal, Trace, pulses};
pub use curve::Curve;
pub use errors::Measured;
use frame::FrameFits;
pub use outcome::{Candidate, Fit, Frames, Options, Reason, Tolerance};
pub use report::{because, plus_minus, text};
pub use scene::{Scene, Zero};
use shots::Shots;
pub use signal::{Hum, Kind, Signal};

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
    let pulses = pulses(trace, options.light)?;
    let asked = shots::asked(&pulses.frames, options.frame)?;
    let frames = fit_frames(&pulses, asked, options, progress);
    let (fits, shots) = (&frames[0], Shots::new(&frames, n));

    let candidates = choice::candidates(fits, shots.as_ref(), n);
    let (chosen, reason) = choice::choose(options, &candidates, fits, shots.as_ref());
    let peak = outcome::peak(options.full, &pulses, &candidates[chosen as usize])?;
    let results = errors::results(fits, chosen, n).outside(&fits.units, peak);

    let frame = &pulses.frames[asked];
    let mut fit = Fit {
        candidates,
        chosen,
        reason,
        exposure: results.exposure,
        efficiency: results.efficiency,
        triggers: results.triggers,
        peak,
        frames: Frames::new(&pulses.frames, asked),
        warnings: pulses.warnings.clone(),
        samples: pulses.trace.part(&frame.samples),
        inverted: pulses.inverted,
        middle: fits.units.seconds(0.0),
    };
    let doubts = doubts::doubts(&fit, fits, &pulses, frame, options.full.is_some());
    fit.warnings.extend(doubts);
    Ok(fit)
}

/// The frame that is asked for, fitted by every kind, and others like it where these help to choose a kind.
fn fit_frames(
    pulses: &Pulses,
    asked: usize,
    options: &Options,
    progress: &mut dyn FnMut(f64),
) -> Vec<FrameFits> {
    let shots_decide = options.model.is_none() && options.tolerance.is_none();
    let others = if shots_decide { shots::others(&pulses.frames, asked) } else { Vec::new() };
    let steps = 1.0 + others.len() as f64;
    let mut frames = Vec::new();
    for (i, k) in once(asked).chain(others).enumerate() {
        let mut progress = |done: f64| progress((i as f64 + done) / steps);
        frames.push(FrameFits::new(pulses, &pulses.frames[k], &mut progress));
    }
    progress(1.0);
    frames
}
