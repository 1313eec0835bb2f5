//! Where the pulses of a trace are: its levels in the dark and in the light, its noise, its frames.

use std::f64::consts::PI;
use std::ops::Range;

use serde::Deserialize;

use super::coupling::Rates;
use super::samples::{CONTRAST, LARGEST, Trace, least_step, median, noise, range, sampling_interval};
use super::told::{Refusal, Warning};

/// A sample so many standard deviations of the noise outside what its neighbours span is a spike.
const SPIKE: f64 = 6.0;
/// One in so many samples is few: so many are a trace's end, are smoothed together at most, or may be spikes.
const FEW_OF: usize = 50;
/// The fewest samples of a trace.
const FEWEST: usize = 16;
/// The fewest samples of a pulse.
const FEWEST_LIT: usize = 8;
/// The fewest samples in the dark on either side of a pulse.
const FEWEST_DARK: usize = 3;
/// So many samples more are looked at on either side than a pulse's length asks for. Only measured: behind a capacitor
/// of 50 Hz, 1 of 108 records has no right result, and 2 to 4 with 0, 1, 2, 4, 6, 12, 16 or 32.
const MORE: f64 = 8.0;
/// The shares of the light at which a pulse's ramps are timed.
pub const QUARTERS: [f64; 3] = [0.25, 0.5, 0.75];
/// The beginning and the end of a trace that differ by this share of the light are not both dark.
const CUT: f64 = 0.3;
/// A tail that falls by this share of the light is one.
const TAIL: f64 = 0.001;
/// Between these shares of the light the state stays what it was.
const SWITCH: (f64, f64) = (0.4, 0.6);
/// A pulse with less than this share of the largest one's light is a glitch: a fifth, as its warning says.
const GLITCH: f64 = 0.2;

/// No camera fires again so soon, in seconds, but a lamp behind a switch does.
const FASTEST: f64 = 1.0 / 150.0;
/// And a lamp on the mains flashes so often, in hertz, to a fiftieth.
const MAINS: [f64; 2] = [100.0, 120.0];

/// So far below the dark, as a share of the light, neither drift nor hum take a signal.
const UNDERSHOOT: f64 = 0.1;

/// The least of many samples strays so many standard deviations of the noise from their mean.
const STRAY: f64 = 5.0;

/// Which way light moves the signal.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum Light {
    /// The trace begins and ends in the dark.
    #[default]
    Auto,
    /// Light raises the signal.
    Up,
    /// Light lowers the signal.
    Down,
}

/// When a quarter, half and three quarters of the light are reached, and left again: six times in order.
pub type Crossings = [f64; 6];

/// The samples of one opening of the shutter, from the dark before to the dark after.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Which samples of the trace.
    pub samples: Range<usize>,
    /// Is nothing recorded of the dark behind them?
    pub is_cut: bool,
    /// In seconds.
    pub crossings: Crossings,
    /// The integral over the light's level above the dark, in seconds; as the samples have it.
    pub exposure: f64,
}

/// What is known of a trace before a model is fitted.
#[derive(Clone, Debug)]
pub struct Pulses {
    /// The trace without its spikes; what light lowers is turned round; what a capacitor takes is back.
    pub trace: Trace,
    /// The same as it was recorded, where capacitors take much of it, and roughly their rates.
    pub(crate) coupled: Option<(Trace, Rates)>,
    /// Is it on both sides of the dark, as behind a capacitor?
    pub(crate) bent: bool,
    /// Does light lower the signal as it was measured?
    pub inverted: bool,
    /// The level in the dark, and how much the light adds.
    pub levels: (f64, f64),
    /// The standard deviation of what differs from one sample to the next.
    pub noise: f64,
    /// The standard deviation of what rounding adds to all samples of a level alike.
    pub rounding: f64,
    /// In order.
    pub frames: Vec<Frame>,
    /// What is doubtful.
    pub warnings: Vec<Warning>,
}

impl Pulses {
    /// Moves all times.
    pub(crate) fn shift(&mut self, by: f64) {
        self.trace.shift(by);
        if let Some((recorded, _)) = &mut self.coupled {
            recorded.shift(by);
        }
        self.frames.iter_mut().for_each(|frame| frame.crossings.iter_mut().for_each(|t| *t += by));
    }

    /// The same, as the recorder shows it.
    pub(crate) fn recorded(&self) -> &Trace {
        self.coupled.as_ref().map_or(&self.trace, |(recorded, _)| recorded)
    }

    /// How much the light adds to the dark.
    pub fn light(&self) -> f64 {
        self.levels.1
    }

    /// The noise as a share of the light.
    pub(crate) fn relative_noise(&self) -> f64 {
        self.noise / self.light()
    }

    /// A value as it was measured from one with light upwards, or the other way round.
    pub(crate) fn turned(&self, value: f64) -> f64 {
        if self.inverted { -value } else { value }
    }
}

/// Finds the pulses.
///
/// # Errors
/// No pulse, an incomplete one, too few samples.
pub fn pulses(trace: &Trace, light: Light) -> Result<Pulses, Refusal> {
    check(trace)?;
    let mut trace = trace.clone();
    let mut warnings = Vec::new();
    let (noise, rounding) = (noise(&trace.values), common_rounding(&trace.values));
    let spikes = drop_spikes(&mut trace, noise);
    if let Some(first) = spikes.first() {
        warnings.push(Warning::Spikes { count: spikes.len(), first: *first });
    }

    let mut smooth = Smooth::new(&trace.values, noise)?;
    let inverted = match light {
        Light::Up => false,
        Light::Down => true,
        Light::Auto => smooth.seems_inverted()?,
    };
    if inverted {
        trace.values.iter_mut().for_each(|v| *v = -*v);
        smooth.turn();
    }
    smooth.dark = smooth.dark();
    let contrast = smooth.contrast();
    if contrast < CONTRAST {
        return Err(Refusal::NoPulse { contrast });
    }
    let levels = (smooth.dark, smooth.light());
    let bent = smooth.undershoots(levels.1);

    let share: Vec<f64> = smooth.values.iter().map(|v| (v - levels.0) / levels.1).collect();
    let mut runs = runs(&share);
    if runs.is_empty() {
        return Err(Refusal::NoPulse { contrast });
    }
    warnings.extend(pulsed(&trace.times, &runs));
    let glitches = drop_glitches(&mut runs, &share);
    if glitches > 0 {
        warnings.push(Warning::Glitches { count: glitches });
    }
    let longest = runs.iter().map(|run| run.len()).max().unwrap_or(0);
    if (bent || longest < FEWEST_LIT) && smooth.is_on_ramps() {
        return Err(Refusal::CutPulse { begins: true, ends: true });
    }
    if longest < FEWEST_LIT {
        return Err(Refusal::ShortPulse { samples: longest, required: FEWEST_LIT, pulses: runs.len() });
    }
    let frames = frames(&trace, &share, &runs, levels, &mut warnings)?;
    if inverted && light == Light::Auto {
        warnings.push(Warning::Inverted);
    }
    Ok(Pulses { trace, coupled: None, bent, inverted, levels, noise, rounding, frames, warnings })
}

/// What no arithmetic would survive.
fn check(trace: &Trace) -> Result<(), Refusal> {
    let Trace { times, values } = trace;
    if times.len() < FEWEST {
        return Err(Refusal::TooFewSamples { samples: times.len(), required: FEWEST });
    }
    let is_sound = times.len() == values.len()
        && times.iter().chain(values).all(|x| x.abs() <= LARGEST)
        && times.windows(2).all(|pair| pair[0] < pair[1]);
    if is_sound { Ok(()) } else { Err(Refusal::Unsound) }
}

/// What rounding to steps adds to every sample of a level alike: a noise of half a step spreads it, and then nothing is
/// left.
fn common_rounding(values: &[f64]) -> f64 {
    let differ: Vec<f64> = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    let repeated = differ.iter().filter(|d| **d == 0.0).count();
    let least = least_step(values);
    if repeated * FEW_OF < values.len() || least == 0.0 {
        return 0.0;
    }
    // Of many short parts the middle one is flat.
    let part = |few: &[f64]| 0.5 * few.iter().map(|d| d * d).sum::<f64>() / few.len() as f64;
    let rounding = least * least / 12.0;
    let noise = (median(differ.chunks(24).map(part).collect()) - rounding).max(0.0);
    (rounding * (-4.0 * (PI / least).powi(2) * noise).exp()).sqrt()
}

/// Drops the samples that lie outside what their neighbours span by [`SPIKE`] and by more than that span. The
/// immediate neighbours are not asked: a spike may be two samples wide. Tells the times.
fn drop_spikes(trace: &mut Trace, noise: f64) -> Vec<f64> {
    let Trace { times, values } = trace;
    let n = values.len();
    let least = least_step(values);
    let is_spike = |i: usize| {
        let near = (i.saturating_sub(4)..i.saturating_sub(1)).chain((i + 2).min(n)..(i + 5).min(n));
        let (low, high) = range(near.map(|k| values[k]));
        let outside = (values[i] - high).max(low - values[i]);
        // A step of the values more is no spike.
        if outside <= (SPIKE * noise).max(1.5 * (high - low)) + least {
            return false;
        }
        // Light has noise of its own, by which neighbours differ.
        let differ = |part: Range<usize>| part.map(|k| (values[k + 1] - values[k]).abs());
        let (from, to) = (i.saturating_sub(14), (i + 14).min(n - 1));
        let around = differ(from..i.saturating_sub(2)).chain(differ((i + 2).min(to)..to));
        outside > SPIKE * median(around.collect()) / 0.954
    };
    // Not at the ends: there an edge would be one.
    let spikes: Vec<usize> = (4..n.saturating_sub(4)).filter(|i| is_spike(*i)).collect();
    // What is so frequent is no accident: a pattern that belongs to the signal. Without noise nothing tells one from
    // that.
    if noise == 0.0 || spikes.is_empty() || spikes.len() > n / FEW_OF {
        return Vec::new();
    }
    let told = spikes.iter().map(|i| times[*i]).collect();
    for column in [times, values] {
        let mut places = 0..n;
        column.retain(|_| places.next().is_some_and(|k| spikes.binary_search(&k).is_err()));
    }
    told
}

/// A trace's values, smoothed so far that the noise switches no state.
struct Smooth {
    values: Vec<f64>,
    /// What is left of the noise.
    noise: f64,
    /// The level of the dark.
    dark: f64,
}

impl Smooth {
    fn new(values: &[f64], noise: f64) -> Result<Self, Refusal> {
        let (low, high) = range(values);
        if high <= low {
            return Err(Refusal::NoPulse { contrast: 0.0 });
        }
        // A twentieth of the light is too little to switch.
        let window = (noise / (0.05 * (high - low))).powi(2).ceil() as usize;
        let window = window.clamp(1, values.len() / FEW_OF + 1);
        let values = means(values, window);
        Ok(Self { values, noise: noise / (window as f64).sqrt(), dark: 0.0 })
    }

    /// The level of the ends, as far as these are dark, or else of the lower samples.
    fn dark(&self) -> f64 {
        let (low, high) = range(&self.values);
        let (first, last) = ends(&self.values);
        let middle = 0.5 * (low + high);
        if first > middle && last > middle {
            return median(self.values.iter().copied().filter(|v| *v <= middle).collect());
        }
        let is_cut = (first - last).abs() > CUT * (high - low);
        if is_cut { first.min(last) } else { 0.5 * (first + last) }
    }

    /// Does light lower the signal? A trace mostly begins and ends in the dark; but where its ends are shorter than
    /// what they are taken for elsewhere, pulses may be cut there, and a gap between pulses is none.
    fn seems_inverted(&self) -> Result<bool, Refusal> {
        let (low, high) = range(&self.values);
        let share: Vec<f64> = self.values.iter().map(|v| (v - low) / (high - low)).collect();
        let (n, highs) = (share.len(), runs(&share));
        let begins = highs.first().is_some_and(|run| run.start == 0);
        let ends_so = highs.last().is_some_and(|run| run.end == n);
        if !begins && !ends_so {
            let (first, last) = ends(&self.values);
            let is_cut = (first - last).abs() > CUT * (high - low);
            return Ok(!is_cut && first + last - low > high);
        }
        let whole = &highs[usize::from(begins)..highs.len() - usize::from(ends_so)];
        let lows = highs.windows(2).map(|pair| pair[1].start - pair[0].end);
        if begins && ends_so && highs.len() > 1 {
            let at_ends = [&highs[0], &highs[highs.len() - 1]].map(|run| run.len());
            let longest = whole.iter().map(|run| run.len()).max().unwrap_or(0);
            let are_dark =
                at_ends[0].max(at_ends[1]) >= longest && lows.clone().all(|low| at_ends[0] + at_ends[1] >= low);
            if are_dark {
                return Ok(true);
            }
        }
        // Light mostly raises a signal, and does not last; and noise has no way.
        let lit: usize = highs.iter().map(|run| run.len()).sum();
        let is_open = lows.len() > 0 && (whole.is_empty() || 2 * lit > n);
        if is_open && high - low > 2.0 * CONTRAST * self.noise {
            return Err(Refusal::WhichWay);
        }
        Ok(false)
    }

    fn turn(&mut self) {
        self.values.iter_mut().for_each(|v| *v = -*v);
    }

    /// The peak above the dark.
    fn height(&self) -> f64 {
        range(&self.values).1 - self.dark
    }

    /// The height in standard deviations of the noise.
    fn contrast(&self) -> f64 {
        self.height() / self.noise.max(f64::MIN_POSITIVE)
    }

    /// How much the light adds to the dark: up to the median of what is above half, or to the peak where that is far
    /// above.
    fn light(&self) -> f64 {
        let half = self.dark + 0.5 * self.height();
        let above = |level: f64| self.values.iter().copied().filter(|v| *v > level).collect();
        let middle = median(above(half));
        let top: Vec<f64> = above(middle);
        let full = if top.is_empty() { middle } else { median(top) };
        full - self.dark
    }

    /// Do the first and the last samples leave the ends' levels the same way, as on the ramps of a pulse that is cut?
    fn is_on_ramps(&self) -> bool {
        let (values, (first, last)) = (&self.values, ends(&self.values));
        let off = |few: &[f64], end: f64| median(few.to_vec()) - end;
        let (begins, ends) = (off(&values[..3], first), off(&values[values.len() - 3..], last));
        begins * ends > 0.0 && begins.abs().min(ends.abs()) > STRAY * self.noise
    }

    /// Light moves a signal one way only, unless a capacitor takes the mean away.
    fn undershoots(&self, light: f64) -> bool {
        let below = self.dark - range(&self.values).0;
        below - STRAY * self.noise > UNDERSHOOT * light
    }
}

/// Means over `window` neighbours, fewer at the ends.
fn means(values: &[f64], window: usize) -> Vec<f64> {
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

/// The medians of the first and the last samples.
fn ends(values: &[f64]) -> (f64, f64) {
    let n = values.len();
    let few = (n / FEW_OF).max(3);
    (median(values[..few].to_vec()), median(values[n - few..].to_vec()))
}

/// Where the light is on, with a switch that has two thresholds.
fn runs(share: &[f64]) -> Vec<Range<usize>> {
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

/// Pulses that follow each other faster than any camera fires.
fn pulsed(times: &[f64], runs: &[Range<usize>]) -> Option<Warning> {
    let gaps: Vec<f64> = runs.windows(2).map(|pair| times[pair[1].start] - times[pair[0].start]).collect();
    let period = if gaps.is_empty() { return None } else { median(gaps) };
    let is_mains = MAINS.into_iter().any(|hertz| (hertz * period - 1.0).abs() < 0.02);
    (period < FASTEST || is_mains).then_some(Warning::Pulsed { hertz: 1.0 / period })
}

/// Drops the runs with too little light to be pulses, and tells how many.
fn drop_glitches(runs: &mut Vec<Range<usize>>, share: &[f64]) -> usize {
    let light = |run: &Range<usize>| share[run.clone()].iter().sum::<f64>();
    let largest = runs.iter().map(light).fold(0.0, f64::max);
    let before = runs.len();
    runs.retain(|run| light(run) > GLITCH * largest);
    before - runs.len()
}

/// The frames of the pulses, each up to halfway to the next; those that have not some dark on both sides are left out.
fn frames(
    trace: &Trace,
    share: &[f64],
    runs: &[Range<usize>],
    levels: (f64, f64),
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Frame>, Refusal> {
    let (mut frames, mut cut) = (Vec::new(), [false; 2]);
    let is_dark = |i: &usize| share[*i] < QUARTERS[0];
    for (k, run) in runs.iter().enumerate() {
        let from = if k > 0 { (runs[k - 1].end + run.start) / 2 } else { 0 };
        let to = runs.get(k + 1).map_or(share.len(), |next| (run.end + next.start) / 2);
        // What the trace begins or ends with may be the rest of a pulse.
        let first = (from..run.start).find(is_dark).unwrap_or(run.start);
        let last = (run.end..to).rfind(is_dark).map_or(run.end, |i| i + 1);
        let few = [run.start - first, last - run.end].map(|dark| dark < FEWEST_DARK);
        if few == [false; 2] {
            let from = if first > from { (first + run.start) / 2 } else { from };
            let to = if last < to { (run.end + last).div_ceil(2) } else { to };
            frames.push(frame(trace, share, run, from..to, levels));
        } else {
            cut = [cut[0] || few[0], cut[1] || few[1]];
            warnings.push(Warning::PartialFrame { number: k + 1 });
        }
    }
    if frames.is_empty() { Err(Refusal::CutPulse { begins: cut[0], ends: cut[1] }) } else { Ok(frames) }
}

/// The frame of the pulse whose light is on in `run`, and which owns `samples`.
fn frame(trace: &Trace, share: &[f64], run: &Range<usize>, samples: Range<usize>, (dark, light): (f64, f64)) -> Frame {
    let t = &trace.times;
    let crossings = crossings(t, share, run, &samples);
    // Half a pulse of dark on either side: more would only add noise.
    let (from, to) = window(t, &samples, crossings, 0.5);
    let usual = sampling_interval(&t[samples.clone()]);
    // Across a gap no sample stands for more than the usual time: nothing is known of the rest.
    let exposure = (from + 1..to).map(|i| {
        let step = t[i] - t[i - 1];
        let level = 0.5 * (trace.values[i - 1] + trace.values[i]) - dark;
        level / light * if step > 4.0 * usual { usual } else { step }
    });
    let exposure = exposure.sum();
    // Beyond two pulses of dark, whatever else happens matters more than what more dark samples would tell; but a tail
    // does not end there.
    let (from, mut to) = window(t, &samples, crossings, 2.0);
    let rise = t.partition_point(|t| *t < crossings[0]).max(from);
    let mut pulses = 2.0;
    while to < samples.end && still_falls(&trace.values, from..rise, to, samples.end, light) {
        pulses *= 2.0;
        let further = window(t, &samples, crossings, pulses).1;
        if further == to {
            break;
        }
        to = further;
    }
    let is_cut = to == samples.end || t[to] - t[to - 1] > 4.0 * usual;
    Frame { samples: from..to, is_cut, crossings, exposure }
}

/// Is the level before a sample higher than behind it, by more than noise and a drift as in the dark before make it?
fn still_falls(values: &[f64], before: Range<usize>, at: usize, end: usize, light: f64) -> bool {
    let few = (end - at).min(before.len()) / 2;
    if few < FEWEST_LIT {
        return false;
    }
    let mean = |from: usize| values[from..from + few].iter().sum::<f64>() / few as f64;
    let (early, late) = (mean(at - few), mean(end - few));
    let drift = (mean(before.start) - mean(before.start + few)).abs();
    // By what neighbours differ by in the dark before, a mean's standard deviation.
    let differ = values[before].windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum::<f64>();
    let error = 0.5 * differ.sqrt() / few as f64;
    early - late > (TAIL * light).max(STRAY * error) + 2.0 * (drift - STRAY * error).max(0.0)
}

/// When the pulse reaches each quarter of the light and leaves it, seen from its inside.
fn crossings(t: &[f64], share: &[f64], run: &Range<usize>, samples: &Range<usize>) -> Crossings {
    // The first sample below, and the time in between.
    let rise = |level: f64| {
        let inside = run.clone().find(|i| share[*i] >= level).unwrap_or(run.start);
        match (samples.start..inside).rev().find(|i| share[*i] < level) {
            Some(i) => between(t, share, i, level),
            None => t[inside],
        }
    };
    let fall = |level: f64| {
        let inside = run.clone().rev().find(|i| share[*i] >= level).unwrap_or(run.end - 1);
        match (inside + 1..samples.end).find(|i| share[*i] < level) {
            Some(i) => between(t, share, i - 1, level),
            None => t[inside],
        }
    };
    let [a, b, c] = QUARTERS;
    let mut crossings = [rise(a), rise(b), rise(c), fall(c), fall(b), fall(a)];
    for k in 1..crossings.len() {
        crossings[k] = crossings[k].max(crossings[k - 1]);
    }
    crossings
}

/// The samples from so many pulses before a pulse to so many after it, and [`MORE`].
fn window(times: &[f64], samples: &Range<usize>, crossings: Crossings, pulses: f64) -> (usize, usize) {
    let usual = sampling_interval(&times[samples.clone()]);
    let around = pulses * (crossings[5] - crossings[0]) + MORE * usual;
    let from = times.partition_point(|t| *t < crossings[0] - around);
    let to = times.partition_point(|t| *t <= crossings[5] + around);
    (from.max(samples.start), to.min(samples.end))
}

/// The time between a sample and the next one at which the light is at a level.
fn between(times: &[f64], share: &[f64], i: usize, level: f64) -> f64 {
    let part = (level - share[i]) / (share[i + 1] - share[i]);
    times[i] + (times[i + 1] - times[i]) * if part.is_finite() { part.clamp(0.0, 1.0) } else { 0.5 }
}
