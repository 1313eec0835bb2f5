//! Exposure and triggers from the samples themselves, by a running sum: where no model explains them, and beside the
//! model's.

use std::f64::consts::PI;
use std::ops::Range;

use crate::curve::fractions;
use crate::errors::{Measured, Results};
use crate::frame::FrameFits;
use crate::missed::{Parts, least_open, missed};
use crate::noise::{mean, mean_square};
use crate::patterns::{Noise, tail_end};
use crate::signal::Kind;
use crate::trace::median;

/// Full light is looked for in a stretch of so many pulses, cut into parts.
const FLAT: f64 = 0.2;
const MOST_PARTS: usize = 8;
/// Stretches that scatter so many times as much as the flattest, or as the noise does, are flat as well.
const ALIKE: f64 = 2.0;
/// The noise is known by a dozen of blocks: a standard error from it is so much larger than from all of it.
const KNOWN: f64 = 1.2;
/// A block in the dark that is so many times as large as the usual ones is light.
const IS_LIGHT: f64 = 5.0;

/// The samples as openness, the light among them, and what is known of their noise.
struct Running {
    /// Where each sample ends, and the openness times the time up to there.
    sums: Vec<(f64, f64)>,
    start: f64,
    /// Where there is light before the curve: from when.
    early: Option<f64>,
    /// The level of full light, and its standard error.
    level: Measured,
    /// The variance of a sum over a unit of time, that of the dark's level, and of what that wanders by beside the
    /// noise.
    walk: f64,
    dark: f64,
    wanders: f64,
}

/// The results of the samples, or none where there is too little dark beside them. What they do not tell is as in the
/// `model` of this kind.
pub fn results(fits: &FrameFits, kind: Kind, model: &Results, n: u32) -> Option<Results> {
    let running = Running::new(fits, kind)?;
    let integral = fits.exposure(kind);
    let (end, area) = *running.sums.last()?;
    let length = end - running.start;
    let baseline = running.dark + running.wanders;
    let noise = KNOWN * (running.walk * length + baseline * length * length).sqrt();
    let Measured { value: level, error: spread } = running.level;
    let value = area / level;
    let exposure = Measured { value, error: (noise / level).hypot(value * spread / level) };
    let of_length = fits.of(kind).solution.signal.curve.length();
    let value = exposure.value / of_length;
    let error = (exposure.error / of_length).hypot(model.efficiency.error);
    // No shutter lets more light in than one that is open all the time.
    let value = if value - 2.0 * error < 1.0 { value.min(1.0) } else { value };
    let efficiency = Measured { value, error };
    let trigger = |u: f64| {
        let value = running.reaches(u * area);
        let (early, late) = (value - running.start, end - value);
        let walk = running.walk * (u * u * late + (1.0 - u) * (1.0 - u) * early).max(0.0);
        // A level that is off, and one that goes from below to above.
        let tilt = baseline * (early - u * length).powi(2);
        let turns = running.wanders * (early * late / length).powi(2);
        let amount = KNOWN * (walk + tilt + turns).sqrt();
        Measured { value, error: amount / least_open(&integral, value) }
    };
    let triggers: Vec<Measured> = fractions(n).map(trigger).collect();
    // No trace shows where a ramp's foot starts, so that is the model's, as well as it meets the middle of the
    // exposure; but nothing is triggered before the shutter opens.
    let apart = integral.trigger(0.5).0 - running.reaches(0.5 * area);
    let earliest = triggers.first().map_or(f64::INFINITY, |first| first.value);
    let value = model.start.value.min(earliest).min(running.early.unwrap_or(f64::INFINITY));
    let error = model.start.error.hypot(apart).hypot(model.start.value - value);
    let start = Measured { value, error };
    let parts = model.parts;
    Some(Results { exposure, efficiency, start, parts, triggers }.widened(fits, kind))
}

impl Running {
    fn new(fits: &FrameFits, kind: Kind) -> Option<Self> {
        let parts = Parts::new(fits, kind);
        let missed = missed(fits, kind);
        let dark = [&missed[parts.before.clone()], &missed[parts.after.clone()]].concat();
        let Noise { walk, .. } = Noise::new(fits, kind, &parts)?;
        let length = (dark.len() / 12).max(1);
        let blocks: Vec<f64> = dark.chunks(length).map(mean).collect();
        let usual = median(blocks.iter().map(|b| b.abs()).collect()) / 0.6745 + 1e-6;
        let base = median(blocks.clone());
        let lit = |k: usize| {
            let few = &missed[k..(k + length).min(missed.len())];
            (mean(few) - base).abs() > IS_LIGHT * usual
        };
        let Range { start: from, end: to } = parts.pulse;
        let first = parts.before.clone().step_by(length).find(|k| lit(*k));
        let from = first.map_or(from, |k| k.min(from));
        let last = parts.after.clone().step_by(length).rfind(|k| lit(*k));
        let to = last.map_or(to, |k| (k + length).min(missed.len()).max(to));
        // A tail is light as well, though none of its blocks stands out.
        let tail = tail_end(fits, kind);
        let to = tail.map_or(to, |end| fits.samples.partition_point(|bin| bin.from <= end).max(to));
        // The noise is known by what is dark now.
        let dark_now = Parts { before: 0..from, pulse: from..to, after: to..missed.len() };
        let walk = Noise::new(fits, kind, &dark_now).map_or(walk, |noise| noise.walk);

        let opened = fits.opened(kind);
        let (mut sum, mut sums) = (0.0, Vec::new());
        let lit = fits.samples.get(from..to)?;
        let mut begins = lit.first()?.from;
        for (k, bin) in lit.iter().enumerate() {
            // Each half of a gap is as the sample beside it.
            let ends = lit.get(k + 1).map_or(bin.to, |next| 0.5 * (bin.to + next.from));
            sum += (opened[from + k] - base) * (ends - begins);
            sums.push((ends, sum));
            begins = ends;
        }
        let level = Self::level(fits, &opened, base, walk)?;
        // A median is known less well than a mean; and a level that wanders more than the noise, as a drift or a hum
        // makes it, does so in the pulse as well.
        let unlit = blocks.iter().map(|b| b - base).filter(|b| b.abs() <= IS_LIGHT * usual);
        let wanders = mean_square(&unlit.collect::<Vec<_>>()) - walk / (length as f64 * fits.step);
        let dark = 0.5 * PI * walk / (dark.len() as f64 * fits.step);
        let start = lit[0].from;
        let early = (from < parts.pulse.start).then_some(start);
        Some(Self { sums, start, early, level, walk, dark, wanders: wanders.max(0.0) })
    }

    /// Full light, by the stretch of the pulse that is flattest: what a shutter does before it rests does not count.
    fn level(fits: &FrameFits, opened: &[f64], base: f64, walk: f64) -> Option<Measured> {
        let between = |from: f64, to: f64| -> Option<f64> {
            let first = fits.samples.partition_point(|bin| bin.from + bin.to < 2.0 * from);
            let end = fits.samples.partition_point(|bin| bin.from + bin.to < 2.0 * to);
            let values = opened.get(first..end).filter(|values| !values.is_empty())?;
            Some(mean(values) - base)
        };
        // In pulses from the middle; each stretch in parts, whose scatter tells how flat it is.
        let parts = ((FLAT / fits.step / 1.5) as usize).clamp(2, MOST_PARTS);
        let part = FLAT / parts as f64;
        let stretch = |k: usize| -> Option<(f64, f64)> {
            let from = -0.5 + 0.5 * part * k as f64;
            let nth = |i: usize| between(from + part * i as f64, from + part * (i + 1) as f64);
            let means: Vec<f64> = (0..parts).map(nth).collect::<Option<_>>()?;
            let level = mean(&means);
            let scatter = means.iter().map(|m| (m - level).powi(2)).sum::<f64>();
            // A stretch of a ramp or of the dark is flat as well.
            (level > 0.6).then_some((scatter, level))
        };
        let count = ((1.0 - FLAT) / (0.5 * part)) as usize;
        let stretches: Vec<(f64, f64)> = (0..=count).filter_map(stretch).collect();
        let least = stretches.iter().map(|(scatter, _)| *scatter).fold(f64::INFINITY, f64::min);
        // Which of those that are nearly as flat, or as flat as the noise lets them be, is the flattest is chance:
        // their mean counts, and is known no better than they agree. Of the flattest one chance makes a quarter of the
        // usual at least.
        let usual = walk / part * (parts - 1) as f64;
        let alike = stretches.iter().filter(|s| s.0 <= ALIKE * usual.clamp(least, 4.0 * least));
        let alike: Vec<f64> = alike.map(|(_, level)| *level).collect();
        let middle = between(-0.25, 0.25)?;
        // A peak counts as full light, as it does where the model is right; the flatter it is, the better it is known.
        if fits.exposure(Kind::Free).is_peak() {
            let error = (walk / FLAT).sqrt().hypot(0.1 * (1.0 - middle));
            return Some(Measured { value: 1.0, error });
        }
        let (scatter, value) = if alike.is_empty() { (0.0, middle) } else { (least, mean(&alike)) };
        let apart = alike.iter().map(|level| (level - value).abs()).fold(0.0, f64::max);
        // Where even that is not flat, it is no rest.
        let uneven = ((scatter - usual).max(0.0) / parts as f64).sqrt();
        let noise = (walk / FLAT).sqrt().hypot(fits.rounding);
        let error = noise.hypot(uneven).hypot(apart).hypot(0.2 * (value - middle));
        (value > 0.0).then_some(Measured { value, error })
    }

    /// When the sum first reaches an amount.
    fn reaches(&self, amount: f64) -> f64 {
        let mut before = (self.start, 0.0);
        for &(t, sum) in &self.sums {
            if sum >= amount {
                let part = (amount - before.1) / (sum - before.1);
                let part = if part.is_finite() { part.clamp(0.0, 1.0) } else { 0.5 };
                return before.0 + (t - before.0) * part;
            }
            before = (t, sum);
        }
        before.0
    }
}
