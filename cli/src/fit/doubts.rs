//! What is doubtful about a fit: each doubt looks at the fit by itself, and is told or not.

use super::frame::FrameFits;
use super::outcome::Fit;
use crate::trace::{Frame, Pulses, Warning};

/// All doubts about the fit of a frame.
pub fn doubts(
    fit: &Fit,
    fits: &FrameFits,
    pulses: &Pulses,
    frame: &Frame,
    full_is_given: bool,
) -> Vec<Warning> {
    // The sampling interval in seconds.
    let step = fits.step * fits.units.pulse();
    let doubts = [
        clipped(fit),
        hum(fit),
        drift(fit),
        lost_ramps(fit, fits.correlation, frame, step),
        if full_is_given { None } else { no_plateau(fit, step) },
        poor_fit(fit, fits, pulses),
    ];
    doubts.into_iter().flatten().collect()
}

/// Many samples at the greatest value, where the dark shows that the noise is more than a step of the values.
fn clipped(fit: &Fit) -> Option<Warning> {
    let (dark, gain) = (fit.best().signal.dark, fit.best().signal.gain);
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
        .then_some(Warning::Clipped { share, at: fit.as_measured(top) })
}

fn hum(fit: &Fit) -> Option<Warning> {
    let signal = fit.best().signal;
    let hum = signal.hum?;
    Some(Warning::Hum { hertz: hum.frequency, amplitude: hum.amplitude() / signal.gain })
}

fn drift(fit: &Fit) -> Option<Warning> {
    let signal = fit.best().signal;
    let times = &fit.samples.times;
    let length = times[times.len() - 1] - times[0];
    Some(Warning::Drift { amount: signal.drift? * length / signal.gain })
}

/// Ramps that are as short as a sample, or else lost in the noise.
fn lost_ramps(fit: &Fit, correlation: f64, frame: &Frame, step: f64) -> Option<Warning> {
    let best = fit.best();
    let curve = best.signal.curve;
    if curve.opening.min(curve.closing) < 2.0 * step {
        return Some(Warning::SharpEdges { step });
    }
    let [up25, _, up75, down75, _, down25] = frame.crossings;
    let longer = (up75 - up25).max(down25 - down75);
    // Half a ramp lies between its quarters.
    let on_ramp = (2.0 * longer / step).max(1.0);
    let noise = best.rms * correlation.sqrt();
    (noise / on_ramp.sqrt() > 0.03).then_some(Warning::NoiseHidesRamps { noise: best.rms })
}

fn no_plateau(fit: &Fit, step: f64) -> Option<Warning> {
    let curve = fit.best().signal.curve;
    (curve.plateau < step.max(0.01 * curve.length())).then_some(Warning::NoPlateau)
}

/// Residuals of more than the noise. Noise with a colour differs little between neighbours, so a small misfit is not told.
fn poor_fit(fit: &Fit, fits: &FrameFits, pulses: &Pulses) -> Option<Warning> {
    let rms = fits.of(fit.chosen).variance().sqrt();
    let noise = pulses.relative_noise();
    (rms > 3.0 * noise && fit.best().rms > 0.01).then_some(Warning::PoorFit { times: rms / noise })
}
