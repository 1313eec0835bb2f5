//! What is doubtful about a fit: each doubt looks at the fit by itself, and is told or not.

use std::ops::Range;

use crate::bins::Bin;
use crate::curve::Exposure;
use crate::frame::FrameFits;
use crate::hum;
use crate::lag;
use crate::missed::Parts;
use crate::noise::mean;
use crate::outcome::{Fit, From, Test};
use crate::patterns::Noise;
use crate::signal::{Kind, Signal};
use crate::structure::UNSEEN;
use crate::trace::{Frame, Warning, least_step};

/// A capacitor that is taken for a drift of this share of the light moves the triggers by a per mille.
const LARGE: f64 = 0.015;
/// A tail has to sink by so many standard deviations, and to have this share of the exposure.
const TAIL: f64 = 8.0;
const LITTLE: f64 = 0.003;
/// A standard error of the exposure or of a trigger beyond this share of the exposure is told.
const WIDE: f64 = 0.02;

pub fn doubts(fit: &Fit, fits: &FrameFits, frame: &Frame, full_is_given: bool) -> Vec<Warning> {
    // The sampling interval in seconds.
    let step = fits.step * fits.units.pulse;
    let is_pulsed = fit.warnings.iter().any(|w| matches!(w, Warning::Pulsed { .. }));
    let doubts = [
        clipped(fit, fits).or_else(|| saturated(fit, fits)),
        hum(fit, fits),
        flicker(fit),
        coupled(fit),
        if frame.is_cut { cut_tail(fit, fits) } else { None },
        slow_tail(fit, fits),
        drift(fit, fits),
        if is_pulsed { None } else { lost_ramps(fit, fits.correlation, frame, step) },
        if full_is_given { None } else { no_plateau(fit) },
        misfit(fit),
        wide_error(fit),
        unseen(fit),
    ];
    doubts.into_iter().flatten().collect()
}

/// Many samples at the greatest value, where the dark shows that the noise is more than a step of the values.
fn clipped(fit: &Fit, fits: &FrameFits) -> Option<Warning> {
    let Signal { dark, gain, .. } = fits.of(fit.chosen).solution.signal;
    let values: &Vec<f64> = &fits.samples.iter().map(|bin| bin.mean).collect();
    let top = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let light = values.iter().filter(|v| **v > dark + 0.5 * gain).count();
    let at_top = values.iter().filter(|v| **v == top).count();
    let mut low: Vec<f64> = values.iter().copied().filter(|v| *v < dark + 0.1 * gain).collect();
    low.sort_by(f64::total_cmp);
    let same = low.chunk_by(|a, b| a == b).map(<[f64]>::len).max().unwrap_or(0);
    // Noise that is not cut off thins out to its top.
    let next = values.iter().copied().filter(|v| *v < top).fold(f64::NEG_INFINITY, f64::max);
    let heaps = at_top > 3 * values.iter().filter(|v| **v == next).count();
    let share = at_top as f64 / light.max(1) as f64;
    let noise_shows = (same as f64) < 0.45 * low.len() as f64;
    (at_top >= 5 && share > 0.05 && noise_shows && heaps)
        .then_some(Warning::Clipped { share, at: fit.as_measured(fits.units.value(top)) })
}

/// Next to no noise in full light, where the dark has some: an amplifier at its end passes none.
fn saturated(fit: &Fit, fits: &FrameFits) -> Option<Warning> {
    let parts = Parts::new(fits, fit.chosen);
    let [_, open, close, _] = fits.exposure(fit.chosen).curve.times();
    let from = fits.samples.partition_point(|bin| bin.from < open);
    let to = fits.samples.partition_point(|bin| bin.to <= close);
    let differ = |range: Range<usize>| -> Vec<f64> {
        let means = fits.samples[range].windows(2);
        means.map(|pair| (pair[1].mean - pair[0].mean).powi(2)).collect()
    };
    let (light, dark) = (differ(from..to.max(from)), differ(parts.before));
    if light.len() < 20 || dark.len() < 20 {
        return None;
    }
    let lit = light.len();
    // But for a tenth: an edge in the dark is no noise.
    let [quiet, usual] = [light, dark].map(|mut differ| {
        differ.sort_by(f64::total_cmp);
        differ.truncate(differ.len() * 9 / 10);
        mean(&differ)
    });
    // Twenty differences and more scatter by a half at most; a level between two steps of the values makes noise of its
    // own.
    let Signal { dark, gain, .. } = fit.best().signal;
    let is_quiet = quiet < 0.25 * usual && usual.sqrt() > least_step(&fit.samples.values) / gain;
    let share = lit as f64 / parts.pulse.len() as f64;
    is_quiet.then(|| Warning::Clipped { share, at: fit.as_measured(dark + gain) })
}

/// A hum; of few periods it is told from the shutter's own shape by the mains' frequency alone.
fn hum(fit: &Fit, fits: &FrameFits) -> Option<Warning> {
    let signal = fit.best().signal;
    let hum = signal.hum?;
    let periods = hum::periods(fits.bins(), &fits.of(fit.chosen).solution.signal.hum?);
    let (hertz, amplitude) = (hum.frequency, hum.amplitude() / signal.gain);
    if periods < hum::FEWEST {
        let is_known = hum.range.0 == hum.range.1;
        return Some(Warning::ShortHum { hertz, amplitude, periods, is_known });
    }
    Some(Warning::Hum { hertz, amplitude })
}

fn flicker(fit: &Fit) -> Option<Warning> {
    let flicker = fit.best().signal.flicker?;
    Some(Warning::Flicker { hertz: flicker.frequency, amplitude: flicker.amplitude() })
}

fn coupled(fit: &Fit) -> Option<Warning> {
    // One that takes for ever is none.
    let of = |rate: Option<f64>| rate.map(|rate| 1.0 / rate).filter(|seconds| seconds.is_finite());
    let [first, second] = fit.best().signal.coupling?.rates.map(of);
    Some(Warning::Coupled { seconds: first.or(second)?, second: first.and(second) })
}

/// A signal that still falls at the end of the trace, where it did not in the dark before.
fn cut_tail(fit: &Fit, fits: &FrameFits) -> Option<Warning> {
    let parts = Parts::new(fits, Kind::Free);
    let gain = fits.of(Kind::Free).solution.signal.gain;
    let levels = |part: &Range<usize>| -> Vec<f64> {
        let few = (part.len() / 2).max(1);
        let level = |bins: &[Bin]| bins.iter().map(|bin| bin.mean).sum::<f64>() / (bins.len() as f64 * gain);
        fits.samples[part.clone()].chunks_exact(few).map(level).collect()
    };
    let [before, after] = [&parts.before, &parts.after].map(levels);
    let dark = mean(&before);
    let ([early, late, ..], [earlier, later, ..]) = (&after[..], &before[..]) else {
        // There is no dark at all behind the curve.
        let (first, last) = (fits.samples.first()?, fits.samples.last()?);
        let is_open = fits.exposure(fit.chosen).curve.end() > last.to;
        return is_open.then_some(Warning::CutTail { left: (last.mean - first.mean) / gain });
    };
    let Noise { walk, .. } = Noise::new(fits, Kind::Free, &parts)?;
    let half = 0.5 * fits.step * parts.after.len() as f64;
    let error = (2.0 * walk / half).sqrt().hypot(fits.rounding);
    // As steep before as after is a drift.
    let same = (later - earlier) * parts.after.len() as f64 / parts.before.len() as f64;
    let falls = early - late > 5.0 * error && early - late > 2.0 * same.abs();
    let left = late - dark;
    (falls && left > 5.0 * error && left > 1e-3).then_some(Warning::CutTail { left })
}

/// Light behind the curve that sinks slowly to what the dark was before: its amount leaves open whose it is.
fn slow_tail(fit: &Fit, fits: &FrameFits) -> Option<Warning> {
    let Parts { before, pulse, after } = Parts::new(fits, fit.chosen);
    let gain = fits.of(fit.chosen).solution.signal.gain;
    let amount = |bin: &Bin| bin.mean * bin.width() / gain;
    let mean = |part: Range<usize>| {
        let bins = &fits.samples[part];
        bins.iter().map(amount).sum::<f64>() / bins.iter().map(Bin::width).sum::<f64>()
    };
    let (few, quarter) = (before.len() / 2, after.len() / 4);
    if few < 8 || quarter < 8 || fit.from == From::Trace {
        return None;
    }
    let dark = mean(before.clone());
    let drift = (mean(before.start..before.start + few) - mean(before.end - few..before.end)).abs();
    let [first, second, third, last] =
        [0, 1, 2, 3].map(|k| mean(after.start + k * quarter..after.start + (k + 1) * quarter) - dark);
    let flat = Parts { before, pulse, after: 0..0 };
    let Noise { walk, .. } = Noise::new(fits, fit.chosen, &flat)?;
    let error = (walk / (fits.step * few.min(quarter) as f64)).sqrt().hypot(fits.rounding);
    let sinks = first > second && second > third && second - last > TAIL * error;
    let beyond = |bin: &Bin| amount(bin) - dark * bin.width();
    let seconds = fits.samples[after].iter().map(beyond).sum::<f64>() * fits.units.pulse;
    let is_told = sinks && first - last > 4.0 * drift && seconds > LITTLE * fit.exposure.value;
    is_told.then_some(Warning::SlowTail { share: first, with: fit.exposure.value + seconds })
}

/// A drift; one that a capacitor explains as well, within two standard deviations, and that moves the triggers, is
/// doubted.
fn drift(fit: &Fit, fits: &FrameFits) -> Option<Warning> {
    let signal = fit.best().signal;
    let times = &fit.samples.times;
    let length = times[times.len() - 1] - times[0];
    let amount = signal.drift? * length / signal.gain;
    let fitted = fits.of(fit.chosen);
    let noise = fitted.variance() * fits.correlation;
    let charge = lag::charge(&fitted.solution, fits.bins());
    let (charge, line) = lag::falls(&fitted.solution, fits.bins(), &charge)?;
    // Slow noise drifts as well.
    let is_large = amount.abs() > LARGE.max(3.0 * fit.best().rms);
    if is_large && charge > line - 4.0 * noise {
        return Some(Warning::DriftOrCapacitor { amount });
    }
    Some(Warning::Drift { amount })
}

/// Ramps that are lost in the noise, or of which one takes two samples at most.
fn lost_ramps(fit: &Fit, correlation: f64, frame: &Frame, step: f64) -> Option<Warning> {
    let best = fit.best();
    let curve = best.signal.curve;
    let [up25, _, up75, down75, _, down25] = frame.crossings;
    let longer = (up75 - up25).max(down25 - down75);
    // Half a ramp lies between its quarters.
    let on_ramp = (2.0 * longer / step).max(1.0);
    let noise = best.rms * correlation.sqrt();
    // What a misfit leaves is no noise, and no average makes it less.
    if fit.test.explained && noise / on_ramp.sqrt() > 0.03 {
        return Some(Warning::NoiseHidesRamps { noise: best.rms });
    }
    // The samples' own quarters lie half a ramp apart, whichever curve was taken.
    let shorter = (up75 - up25).min(down25 - down75);
    let is_sharp = curve.opening.min(curve.closing) < 2.0 * step && shorter < 1.5 * step;
    is_sharp.then_some(Warning::SharpEdges { step, share: step / fit.exposure.value })
}

fn no_plateau(fit: &Fit) -> Option<Warning> {
    Exposure::new(&fit.best().signal.curve).may_be_peak().then_some(Warning::NoPlateau)
}

fn unseen(fit: &Fit) -> Option<Warning> {
    let Test { tested, unseen, .. } = fit.test;
    (tested && fit.from == From::Model && unseen > UNSEEN).then_some(Warning::Unseen { share: unseen.min(1.0) })
}

/// Errors beyond which a result is of no use to most.
fn wide_error(fit: &Fit) -> Option<Warning> {
    let exposure = fit.exposure.value;
    let share = fit.triggers.iter().map(|trigger| trigger.error).fold(fit.exposure.error, f64::max);
    (share > WIDE * exposure).then_some(Warning::WideError { share: share / exposure })
}

/// Structure that the model does not explain, or too little dark to tell.
fn misfit(fit: &Fit) -> Option<Warning> {
    let Test { explained, tested, share, at, .. } = fit.test;
    let after = at - fit.best().signal.curve.start;
    match (explained, tested) {
        (false, _) => Some(Warning::Misfit { share, after, by_trace: fit.from == From::Trace }),
        (true, false) => Some(Warning::Untested),
        _ => None,
    }
}
