//! From a measured trace to the simplest shutter that serves.
//!
//! [`fit`] takes a [`Trace`] and gives a [`Fit`]: each candidate's curve, which one was chosen and why, the exposure, the
//! efficiency and the trigger times with their standard errors, and what is doubtful. [`Fit::scene`] writes it down for
//! `shutter plan`. There is no file, terminal, thread or clock in it.

mod bins;
mod curve;
mod errors;
mod frame;
mod hum;
mod outcome;
mod ramp;
mod report;
mod scene;
mod shots;
mod signal;
mod solve;
mod starts;

use std::iter::once;

use crate::trace::{Frame, Pulses, Refusal, Trace, Warning, pulses};
pub use curve::Curve;
pub use errors::Measured;
use frame::FrameFit;
pub use outcome::{Candidate, Fit, Frames, Options, Reason, Tolerance};
pub use report::{because, plus_minus, text};
pub use scene::{Scene, Zero};
use shots::Shots;
pub use signal::{Hum, Kind, Signal};

/// As many as `shutter plan` plans.
const MOST_TRIGGERS: u32 = 10_000;

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
    let number = match options.frame {
        Some(number) if number == 0 || number > pulses.frames.len() => {
            return Err(Refusal::NoFrame { number, frames: pulses.frames.len() });
        }
        Some(number) => number - 1,
        None => median(&pulses.frames),
    };
    let frame = &pulses.frames[number];
    let shots_wanted = options.model.is_none() && options.tolerance.is_none();
    let others = if shots_wanted { shots::others(&pulses.frames, number) } else { Vec::new() };
    let steps = 1.0 + others.len() as f64;
    let mut all = Vec::new();
    for (i, frame) in once(frame).chain(others.iter().map(|k| &pulses.frames[*k])).enumerate() {
        let mut progress = |done: f64| progress((i as f64 + done) / steps);
        all.push(FrameFit::new(&pulses, frame, &mut progress));
    }
    progress(1.0);
    let shots = (all.len() >= shots::FEWEST).then(|| Shots::new(&all, n));
    let fitted = &all[0];
    let candidates = candidates(fitted, shots.as_ref(), n);
    let (chosen, reason) = choose(options, &candidates, fitted, shots.as_ref());
    let units = fitted.units;
    let errors::Results { mut exposure, mut efficiency, triggers } =
        errors::results(fitted, chosen, n);
    let seconds =
        |m: Measured| Measured { value: units.seconds(m.value), error: units.pulse() * m.error };
    let peak = peak(options.full, &pulses, &candidates[chosen as usize])?;
    exposure.value *= units.pulse() * peak;
    exposure.error *= units.pulse() * peak;
    efficiency.value *= peak;
    efficiency.error *= peak;
    let range = frame.samples.clone();
    let mut fit = Fit {
        chosen,
        reason,
        exposure,
        efficiency,
        triggers: triggers.into_iter().map(seconds).collect(),
        peak,
        frames: Frames {
            count: pulses.frames.len(),
            fitted: number + 1,
            scatter: scatter(&pulses.frames),
        },
        warnings: pulses.warnings.clone(),
        samples: Trace {
            times: pulses.trace.times[range.clone()].to_vec(),
            values: pulses.trace.values[range].to_vec(),
        },
        inverted: pulses.inverted,
        middle: units.seconds(0.0),
        candidates,
    };
    let doubts = doubts(&fit, fitted, &pulses, frame, options.full.is_some());
    fit.warnings.extend(doubts);
    Ok(fit)
}

/// The frame of median exposure.
fn median(frames: &[Frame]) -> usize {
    let mut order: Vec<usize> = (0..frames.len()).collect();
    order.sort_by(|a, b| frames[*a].exposure.total_cmp(&frames[*b].exposure));
    order[(order.len() - 1) / 2]
}

fn scatter(frames: &[Frame]) -> f64 {
    let n = frames.len() as f64;
    let mean = frames.iter().map(|frame| frame.exposure).sum::<f64>() / n;
    let squares: f64 = frames.iter().map(|frame| (frame.exposure / mean - 1.0).powi(2)).sum();
    if frames.len() > 1 { (squares / (n - 1.0)).sqrt() } else { 0.0 }
}

fn candidates(fit: &FrameFit, shots: Option<&Shots>, n: u32) -> Vec<Candidate> {
    let samples = fit.samples.len() as f64;
    let least = Kind::ALL.into_iter().map(|kind| fit.bic(kind)).fold(f64::INFINITY, f64::min);
    let free = fit.triggers(Kind::Free, n);
    let candidate = |kind: Kind| {
        let fitted = &fit.kinds[kind as usize];
        let signal = &fitted.solution.signal;
        let shifts = fit.triggers(kind, n).into_iter().zip(&free).map(|(a, b)| (a - b).abs());
        Candidate {
            signal: fit.units.outside(signal),
            rms: (fitted.squares / samples).sqrt() / signal.gain,
            delta_bic: fit.bic(kind) - least,
            shift: shifts.fold(0.0, f64::max) * fit.units.pulse(),
            left_out: shots.map(|shots| shots.errors[kind as usize]),
        }
    };
    Kind::ALL.into_iter().map(candidate).collect()
}

fn choose(
    options: &Options,
    candidates: &[Candidate],
    fit: &FrameFit,
    shots: Option<&Shots>,
) -> (Kind, Reason) {
    let simplest = |good: &dyn Fn(&Candidate) -> bool| {
        let found = candidates.iter().find(|candidate| good(candidate));
        found.map_or(Kind::Free, |candidate| candidate.signal.kind)
    };
    if let Some(kind) = options.model {
        return (kind, Reason::Asked);
    }
    if let Some(tolerance) = options.tolerance {
        let most = match tolerance {
            Tolerance::Share(share) => share * fit.area(Kind::Free) * fit.units.pulse(),
            Tolerance::Seconds(seconds) => seconds,
        };
        return (simplest(&|candidate| candidate.shift <= most), Reason::Tolerance(tolerance));
    }
    if let Some(shots) = shots {
        let kind = simplest(&|candidate| {
            candidate.left_out.is_some_and(|error| error <= shots::WITHIN * shots.scatter)
        });
        return (kind, Reason::Shots { shots: shots.count, scatter: shots.scatter });
    }
    let kind = simplest(&|candidate| candidate.delta_bic <= 0.0);
    (kind, Reason::Criterion { effective: fit.effective() })
}

/// The peak as a share of full light.
fn peak(full: Option<f64>, pulses: &Pulses, best: &Candidate) -> Result<f64, Refusal> {
    let Some(given) = full else { return Ok(1.0) };
    let full = if pulses.inverted { -given } else { given };
    let Signal { dark, gain, .. } = best.signal;
    let peak = gain / (full - dark);
    // The noise may have put the peak a little above.
    if !(peak > 0.0 && peak <= 1.0 + best.rms) {
        let seen = dark + gain;
        return Err(Refusal::FullTooLow {
            given,
            seen: if pulses.inverted { -seen } else { seen },
        });
    }
    Ok(peak.min(1.0))
}

/// What is doubtful about a fit.
fn doubts(
    fit: &Fit,
    fitted: &FrameFit,
    pulses: &Pulses,
    frame: &Frame,
    full_is_given: bool,
) -> Vec<Warning> {
    let mut doubts = Vec::new();
    let best = fit.best();
    let Signal { curve, dark, gain, hum, drift, .. } = best.signal;
    let step = fitted.step * fitted.units.pulse();
    if let Some(clipped) = clipped(fit, dark, gain) {
        doubts.push(clipped);
    }
    if let Some(hum) = hum {
        doubts.push(Warning::Hum { hertz: hum.frequency, amplitude: hum.amplitude() / gain });
    }
    if let Some(drift) = drift {
        let times = &fit.samples.times;
        let amount = drift * (times[times.len() - 1] - times[0]) / gain;
        doubts.push(Warning::Drift { amount });
    }
    let noise = best.rms * fitted.correlation.sqrt();
    let [up25, _, up75, down75, _, down25] = frame.crossings;
    let longer = (up75 - up25).max(down25 - down75);
    let on_ramp = (2.0 * longer / step).max(1.0);
    let sharp = curve.opening.min(curve.closing) < 2.0 * step;
    if noise / on_ramp.sqrt() > 0.03 && !sharp {
        doubts.push(Warning::NoiseHidesRamps { noise: best.rms });
    }
    if sharp {
        doubts.push(Warning::SharpEdges { step });
    }
    if curve.plateau < step.max(0.01 * curve.length()) && !full_is_given {
        doubts.push(Warning::NoPlateau);
    }
    let missed = &fitted.kinds[fit.chosen as usize];
    let rms = (missed.squares / fitted.samples.len() as f64).sqrt();
    let noise = pulses.noise / pulses.light();
    // Noise with a colour differs little between neighbours: the second condition keeps quiet about it.
    if rms > 3.0 * noise && best.rms > 0.01 {
        doubts.push(Warning::PoorFit { times: rms / noise });
    }
    doubts
}

/// Many samples at the greatest value, where the dark shows that the noise is more than a step of the values.
fn clipped(fit: &Fit, dark: f64, gain: f64) -> Option<Warning> {
    let values = &fit.samples.values;
    let top = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let light = values.iter().filter(|v| **v > dark + 0.5 * gain).count();
    let at_top = values.iter().filter(|v| **v == top).count();
    let mut low: Vec<f64> = values.iter().copied().filter(|v| *v < dark + 0.1 * gain).collect();
    low.sort_by(f64::total_cmp);
    let same = low.chunk_by(|a, b| a == b).map(<[f64]>::len).max().unwrap_or(0);
    let share = at_top as f64 / light.max(1) as f64;
    let noise_shows = (same as f64) < 0.45 * low.len() as f64;
    (at_top >= 5 && share > 0.05 && noise_shows)
        .then_some(Warning::Clipped { share, at: if fit.inverted { -top } else { top } })
}
