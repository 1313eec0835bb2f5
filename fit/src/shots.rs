//! Several shots in a trace: which of them is fitted, whether they are of one shutter speed, and samples that are
//! missing inside one: told, and refused where a ramp is lost with them.

use crate::trace::{Frame, Pulses, Refusal, Warning, median, sampling_interval};

/// Shots whose exposures differ by more than this share of the shortest are not of one setting.
pub const ALIKE: f64 = 0.1;
/// Nor is that the noise, where it is so many times what the noise makes of them.
const BEYOND_NOISE: f64 = 4.0;
/// A step between two samples that is so many times as long as the usual one and those beside it is a gap.
const LONG: f64 = 3.5;
/// A gap over which the light changes by more than this share of itself has swallowed a ramp.
const RAMP: f64 = 0.2;
/// What is so many pulses away does not matter.
const AROUND: f64 = 0.5;

/// By how much exposures differ, as a share of the shortest.
pub fn apart(exposures: impl Iterator<Item = f64>) -> f64 {
    let (low, high) = exposures.fold((f64::INFINITY, 0.0), |(low, high), x| (x.min(low), x.max(high)));
    high / low - 1.0
}

/// Do the exposures differ by more than those of one setting do, and more than the noise makes of them?
pub fn differ(frames: &[Frame], noise: f64) -> bool {
    let samples = frames.iter().map(|frame| frame.samples.len()).min().unwrap_or(1) as f64;
    // A fifth of the samples at least are the pulse's; each adds its noise.
    let usual = noise * 2.0 * (5.0 / samples).sqrt();
    apart(frames.iter().map(|frame| frame.exposure)) > ALIKE.max(BEYOND_NOISE * usual)
}

/// The place of the frame that is asked for by its number, from 1; without one, of the frame of median exposure.
pub fn asked(frames: &[Frame], number: Option<usize>) -> Result<usize, Refusal> {
    match number {
        Some(number) if (1..=frames.len()).contains(&number) => Ok(number - 1),
        Some(number) => Err(Refusal::NoFrame { number, frames: frames.len() }),
        None => {
            let mut order: Vec<usize> = (0..frames.len()).collect();
            order.sort_by(|a, b| frames[*a].exposure.total_cmp(&frames[*b].exposure));
            Ok(order[(order.len() - 1) / 2])
        }
    }
}

/// The gaps of a frame.
///
/// # Errors
/// A ramp is lost.
pub fn gaps(pulses: &Pulses, frame: &Frame) -> Result<Option<Warning>, Refusal> {
    let trace = pulses.trace.part(&frame.samples);
    let (times, n) = (&trace.times, trace.times.len());
    let usual = sampling_interval(times);
    let step = |k: usize| times.get(k + 1).map_or(usual, |next| next - times[k]);
    let is_gap = |k: &usize| step(*k) > LONG * usual.max(step(k.saturating_sub(1)).min(step(k + 1)));
    // Far from the pulse, a recorder may have waited for the next one.
    let near = AROUND * (frame.crossings[5] - frame.crossings[0]);
    let is_near = |k: &usize| times[k + 1] > frame.crossings[0] - near && times[*k] < frame.crossings[5] + near;
    let gaps: Vec<usize> = (1..n.saturating_sub(2)).filter(|k| is_near(k) && is_gap(k)).collect();
    // By few samples' median on either side, against the noise.
    let level = |few: &[f64]| median(few.to_vec());
    for &k in &gaps {
        let (before, after) = (&trace.values[k.saturating_sub(4)..=k], &trace.values[k + 1..n.min(k + 6)]);
        if (level(after) - level(before)).abs() > (RAMP * pulses.light()).max(4.0 * pulses.noise) {
            return Err(Refusal::LostRamp { from: times[k], to: times[k + 1] });
        }
    }
    let longest = gaps.iter().copied().max_by(|a, b| step(*a).total_cmp(&step(*b)));
    Ok(longest.map(|k| Warning::Gap { count: gaps.len(), from: times[k], to: times[k + 1] }))
}
