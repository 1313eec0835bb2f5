//! Where the pulses of a trace are: its levels in the dark and in the light, its noise, its frames.

use super::samples::{LARGEST, Trace};
use super::told::{Refusal, Warning};

/// A sample so many standard deviations of the noise outside what its neighbours span is a spike.
const SPIKE: f64 = 6.0;
/// The least contrast, in standard deviations of the (smoothed) noise.
const CONTRAST: f64 = 8.0;
/// The fewest samples of a trace, of a pulse, and in the dark on either side of it.
const FEWEST: (usize, usize, usize) = (16, 8, 3);
/// The beginning and the end of a trace that differ by this share of the light are not both dark.
const CUT: f64 = 0.3;
/// Between these shares of the light the state stays what it was.
const SWITCH: (f64, f64) = (0.4, 0.6);

/// Which way light moves the signal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Light {
    /// As the trace looks: it begins and ends in the dark.
    #[default]
    Auto,
    /// Light raises it.
    Up,
    /// Light lowers it.
    Down,
}

/// The samples of one opening of the shutter, from the dark before to the dark after.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Which samples of the trace.
    pub samples: std::ops::Range<usize>,
    /// When a quarter, half and three quarters of the light are reached, and left again: six times in order.
    pub crossings: [f64; 6],
    /// The integral over the light's level above the dark, in seconds; as the samples have it.
    pub exposure: f64,
}

/// What is known of a trace before a model is fitted.
#[derive(Clone, Debug)]
pub struct Pulses {
    /// The trace without its spikes; what light lowers is turned round.
    pub trace: Trace,
    /// Does light lower the signal as it was measured?
    pub inverted: bool,
    /// The level in the dark, and how much the light adds.
    pub levels: (f64, f64),
    /// The standard deviation of what differs from one sample to the next.
    pub noise: f64,
    /// In order.
    pub frames: Vec<Frame>,
    /// What is doubtful.
    pub warnings: Vec<Warning>,
}

impl Pulses {
    /// How much the light adds to the dark.
    pub fn light(&self) -> f64 {
        self.levels.1
    }
}

/// Finds the pulses.
///
/// # Errors
/// No pulse, an incomplete one, too few samples.
pub fn pulses(trace: &Trace, light: Light) -> Result<Pulses, Refusal> {
    if trace.times.len() < FEWEST.0 {
        return Err(Refusal::TooFewSamples { samples: trace.times.len(), required: FEWEST.0 });
    }
    let is_sound = trace.times.len() == trace.values.len()
        && trace.times.iter().chain(&trace.values).all(|x| x.abs() <= LARGEST)
        && trace.times.windows(2).all(|pair| pair[0] < pair[1]);
    if !is_sound {
        return Err(Refusal::Unsound);
    }
    let mut warnings = Vec::new();
    let noise = noise(&trace.values);
    let mut trace = trace.clone();
    let spikes = drop_spikes(&mut trace, noise);
    if let Some(first) = spikes.first() {
        warnings.push(Warning::Spikes { count: spikes.len(), first: *first });
    }
    let (low, high) = range(&trace.values);
    if high <= low {
        return Err(Refusal::NoPulse { contrast: 0.0 });
    }
    // Noise of a twentieth of the light after smoothing switches no state.
    let n = trace.times.len();
    let window = (noise / (0.05 * (high - low))).powi(2).ceil() as usize;
    let window = window.clamp(1, n / 50 + 1);
    let smooth = smoothed(&trace.values, window);
    let dark = dark(&smooth);
    let (low, high) = range(&smooth);
    let (first, last) = ends(&smooth);
    // One end in the light: which one, nothing tells but that light mostly raises a signal.
    let is_cut = (first - last).abs() > CUT * (high - low);
    let inverted = match light {
        Light::Up => false,
        Light::Down => true,
        Light::Auto => !is_cut && dark - low > high - dark,
    };
    let turned = |v: f64| if inverted { -v } else { v };
    trace.values.iter_mut().for_each(|v| *v = turned(*v));
    let smooth: Vec<f64> = smooth.into_iter().map(turned).collect();
    let dark = turned(dark);
    let height = range(&smooth).1 - dark;
    let contrast = height / (noise / (window as f64).sqrt()).max(f64::MIN_POSITIVE);
    if contrast < CONTRAST {
        return Err(Refusal::NoPulse { contrast });
    }
    let height = full(&smooth, dark, height) - dark;
    check_ends(&smooth, dark, height)?;

    let share: Vec<f64> = smooth.iter().map(|v| (v - dark) / height).collect();
    let mut runs = runs(&share);
    if runs.is_empty() {
        return Err(Refusal::NoPulse { contrast });
    }
    let area = |run: &std::ops::Range<usize>| run.clone().map(|i| share[i]).sum::<f64>();
    let largest = runs.iter().map(area).fold(0.0, f64::max);
    let before = runs.len();
    runs.retain(|run| area(run) > 0.2 * largest);
    if runs.len() < before {
        warnings.push(Warning::Glitches { count: before - runs.len() });
    }
    let longest = runs.iter().map(|run| run.len()).max().unwrap_or(0);
    if longest < FEWEST.1 {
        return Err(Refusal::ShortPulse { samples: longest, required: FEWEST.1 });
    }
    let mut frames = Vec::new();
    for (k, run) in runs.iter().enumerate() {
        let from = if k > 0 { (runs[k - 1].end + run.start) / 2 } else { 0 };
        let to = runs.get(k + 1).map_or(n, |next| (run.end + next.start) / 2);
        if run.start - from < FEWEST.2 || to - run.end < FEWEST.2 {
            if runs.len() == 1 {
                return Err(if run.start - from < FEWEST.2 {
                    Refusal::BeginsInPulse
                } else {
                    Refusal::EndsInPulse
                });
            }
            warnings.push(Warning::PartialFrame { number: k + 1 });
            continue;
        }
        frames.push(frame(&trace, &share, run, from..to, (dark, height)));
    }
    if frames.is_empty() {
        return Err(Refusal::BeginsInPulse);
    }
    if inverted && light == Light::Auto {
        warnings.push(Warning::Inverted);
    }
    Ok(Pulses { trace, inverted, levels: (dark, height), noise, frames, warnings })
}

/// The noise, by the median of what neighbours differ by: edges and hum hardly count in it. At least what rounding to
/// the least step of the values makes.
fn noise(values: &[f64]) -> f64 {
    let mut steps: Vec<f64> = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    let least = steps.iter().copied().filter(|s| *s > 0.0).fold(f64::INFINITY, f64::min);
    let rounding = if least.is_finite() { least / 12f64.sqrt() } else { 0.0 };
    let middle = steps.len() / 2;
    let median = *steps.select_nth_unstable_by(middle, f64::total_cmp).1;
    (median / 0.6745 / 2f64.sqrt()).max(rounding)
}

fn range(values: &[f64]) -> (f64, f64) {
    let ends = (f64::INFINITY, f64::NEG_INFINITY);
    values.iter().fold(ends, |(low, high), v| (low.min(*v), high.max(*v)))
}

fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// Drops the samples that lie outside what their neighbours span by [`SPIKE`] and by more than that span. The
/// immediate neighbours are not asked: a spike may be two samples wide. Tells the times.
fn drop_spikes(trace: &mut Trace, noise: f64) -> Vec<f64> {
    let Trace { times, values } = trace;
    let n = values.len();
    let is_spike = |i: usize| {
        let near = (i.saturating_sub(4)..i.saturating_sub(1)).chain((i + 2).min(n)..(i + 5).min(n));
        let (low, high) = near.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), k| {
            (low.min(values[k]), high.max(values[k]))
        });
        let outside = (values[i] - high).max(low - values[i]);
        outside > (SPIKE * noise).max(1.5 * (high - low))
    };
    // Not at the ends: there an edge would be one.
    let spikes: Vec<usize> = (4..n.saturating_sub(4)).filter(|i| is_spike(*i)).collect();
    // What is so frequent is no accident: a pattern that belongs to the signal.
    if spikes.is_empty() || spikes.len() > n / 50 {
        return Vec::new();
    }
    let told = spikes.iter().map(|i| times[*i]).collect();
    let mut kept = vec![true; n];
    spikes.iter().for_each(|i| kept[*i] = false);
    let mut keep = kept.iter();
    times.retain(|_| *keep.next().unwrap_or(&true));
    let mut keep = kept.iter();
    values.retain(|_| *keep.next().unwrap_or(&true));
    told
}

/// Means over `window` neighbours, fewer at the ends.
fn smoothed(values: &[f64], window: usize) -> Vec<f64> {
    if window < 2 {
        return values.to_vec();
    }
    let n = values.len();
    let mut sums = vec![0.0; n + 1];
    for i in 0..n {
        sums[i + 1] = sums[i] + values[i];
    }
    let (before, after) = (window / 2, window - window / 2);
    (0..n)
        .map(|i| {
            let (from, to) = (i.saturating_sub(before), (i + after).min(n));
            (sums[to] - sums[from]) / (to - from) as f64
        })
        .collect()
}

/// The level at the beginning and the end of a trace, which are dark.
fn dark(smooth: &[f64]) -> f64 {
    let (first, last) = ends(smooth);
    0.5 * (first + last)
}

/// The medians of the first and the last samples.
fn ends(values: &[f64]) -> (f64, f64) {
    let n = values.len();
    let few = (n / 50).max(3);
    (median(values[..few].to_vec()), median(values[n - few..].to_vec()))
}

/// The level in the light: the median of what is above half, or the peak where that is far above.
fn full(smooth: &[f64], dark: f64, height: f64) -> f64 {
    let above: Vec<f64> = smooth.iter().copied().filter(|v| *v > dark + 0.5 * height).collect();
    let middle = median(above);
    let top = smooth.iter().copied().filter(|v| *v > middle).collect::<Vec<_>>();
    if top.is_empty() { middle } else { median(top) }
}

fn check_ends(smooth: &[f64], dark: f64, height: f64) -> Result<(), Refusal> {
    let (first, last) = ends(smooth);
    // Both are as far from their mean, `dark`: the greater one is the light's, if one is.
    if (first - last).abs() > CUT * height {
        return Err(if first > last { Refusal::BeginsInPulse } else { Refusal::EndsInPulse });
    }
    if first > dark + SWITCH.0 * height {
        return Err(Refusal::BeginsInPulse);
    }
    Ok(())
}

/// Where the light is on, with a switch that has two thresholds.
fn runs(share: &[f64]) -> Vec<std::ops::Range<usize>> {
    let (mut runs, mut start) = (Vec::new(), None);
    for (i, share) in share.iter().enumerate() {
        match start {
            None if *share > SWITCH.1 => start = Some(i),
            Some(from) if *share < SWITCH.0 => {
                runs.push(from..i);
                start = None;
            }
            _ => (),
        }
    }
    runs.extend(start.map(|from| from..share.len()));
    runs
}

fn frame(
    trace: &Trace,
    share: &[f64],
    run: &std::ops::Range<usize>,
    samples: std::ops::Range<usize>,
    (dark, height): (f64, f64),
) -> Frame {
    let t = &trace.times;
    // Seen from the inside: the first sample below, and the time in between.
    let rise = |level: f64| {
        let inside = run.clone().find(|i| share[*i] >= level).unwrap_or(run.start);
        match (samples.start..inside).rev().find(|i| share[*i] < level) {
            Some(i) if i < inside => between(t, share, i, level),
            _ => t[inside],
        }
    };
    let fall = |level: f64| {
        let inside = run.clone().rev().find(|i| share[*i] >= level).unwrap_or(run.end - 1);
        match (inside + 1..samples.end).find(|i| share[*i] < level) {
            Some(i) => between(t, share, i - 1, level),
            None => t[inside],
        }
    };
    let mut crossings = [rise(0.25), rise(0.5), rise(0.75), fall(0.75), fall(0.5), fall(0.25)];
    for k in 1..6 {
        crossings[k] = crossings[k].max(crossings[k - 1]);
    }
    // Half a pulse of dark on either side: more would only add noise.
    let (from, to) = window(t, &samples, crossings, 0.5);
    let exposure = (from..to)
        .map(|i| {
            let before = t[i] - t[i.saturating_sub(1).max(samples.start)];
            let after = t[(i + 1).min(samples.end - 1)] - t[i];
            0.5 * (before + after) * (trace.values[i] - dark) / height
        })
        .sum();
    // Beyond two pulses of dark, whatever else happens matters more than what more dark samples would tell.
    let (from, to) = window(t, &samples, crossings, 2.0);
    Frame { samples: from..to, crossings, exposure }
}

/// The samples from so many pulses before a pulse to so many after it, some in any case.
fn window(
    times: &[f64],
    samples: &std::ops::Range<usize>,
    crossings: [f64; 6],
    pulses: f64,
) -> (usize, usize) {
    let around = pulses * (crossings[5] - crossings[0]);
    let from = times.partition_point(|t| *t < crossings[0] - around);
    let to = times.partition_point(|t| *t <= crossings[5] + around);
    let few = 8;
    (from.saturating_sub(few).max(samples.start), (to + few).min(samples.end))
}

/// The time between a sample and the next one at which the light is at a level.
fn between(times: &[f64], share: &[f64], i: usize, level: f64) -> f64 {
    let part = (level - share[i]) / (share[i + 1] - share[i]);
    times[i] + (times[i + 1] - times[i]) * if part.is_finite() { part.clamp(0.0, 1.0) } else { 0.5 }
}
