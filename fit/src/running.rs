//! Exposure and triggers from the samples themselves, by a running sum: where no model explains them, and beside the model's.

use crate::curve::fractions;
use crate::errors::{Measured, Results};
use crate::frame::FrameFits;
use crate::missed::{Parts, least_open, missed};
use crate::signal::Kind;
use crate::structure::Walk;
use crate::tail;
use crate::trace::median;

/// Full light is looked for in a stretch of so many pulses, cut into parts.
const FLAT: f64 = 0.2;
const PARTS: usize = 8;
/// Stretches that scatter so many times as much as the flattest are flat as well.
const ALIKE: f64 = 2.0;
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
    /// The variance of a sum over a unit of time, and for how long the dark was seen.
    walk: f64,
    dark: f64,
}

/// The results of the samples, or none where there is too little dark beside them.
pub fn results(fits: &FrameFits, kind: Kind, n: u32) -> Option<Results> {
    let running = Running::new(fits, kind)?;
    let integral = fits.exposure(kind);
    let (end, area) = *running.sums.last()?;
    let length = end - running.start;
    let baseline = running.walk / running.dark;
    let rounding = fits.rounding * integral.area();
    let noise = (running.walk * length + baseline * length * length).sqrt().hypot(rounding);
    let Measured { value: level, error: spread } = running.level;
    let value = area / level;
    let exposure = Measured { value, error: (noise / level).hypot(value * spread / level) };
    let of_length = fits.of(kind).solution.signal.curve.length();
    let model = crate::errors::results(fits, kind, 1);
    let efficiency = Measured {
        value: exposure.value / of_length,
        error: (exposure.error / of_length).hypot(model.efficiency.error),
    };
    let trigger = |u: f64| {
        let value = running.reaches(u * area);
        let (early, late) = (value - running.start, end - value);
        let walk = running.walk * (u * u * late + (1.0 - u) * (1.0 - u) * early).max(0.0);
        let tilt = baseline * (early - u * length).powi(2);
        let amount = (walk + tilt).sqrt().hypot(rounding);
        Measured { value, error: amount / least_open(&integral, value) }
    };
    let triggers: Vec<Measured> = fractions(n).map(trigger).collect();
    // No trace shows where a ramp's foot starts, so that is the model's, as well as it meets the middle of the exposure; but
    // nothing is triggered before the shutter opens.
    let apart = model.triggers.first().map_or(0.0, |m| m.value - running.reaches(0.5 * area));
    let earliest = triggers.first().map_or(f64::INFINITY, |first| first.value);
    let value = model.start.value.min(earliest).min(running.early.unwrap_or(f64::INFINITY));
    let error = model.start.error.hypot(apart).hypot(model.start.value - value);
    let start = Measured { value, error };
    Some(Results { exposure, efficiency, start, triggers })
}

impl Running {
    fn new(fits: &FrameFits, kind: Kind) -> Option<Self> {
        let parts = Parts::new(fits, kind);
        let missed = missed(fits, kind);
        let dark = [&missed[parts.before.clone()], &missed[parts.after.clone()]].concat();
        let walk = Walk::new(&missed, &parts, fits.step)?;
        let length = (dark.len() / 12).max(1);
        let blocks: Vec<f64> =
            dark.chunks(length).map(|few| few.iter().sum::<f64>() / few.len() as f64).collect();
        let usual = median(blocks.iter().map(|b| b.abs()).collect()) / 0.6745 + 1e-6;
        let base = median(blocks);
        let lit = |k: usize| {
            let few = &missed[k..(k + length).min(missed.len())];
            (few.iter().sum::<f64>() / few.len() as f64 - base).abs() > IS_LIGHT * usual
        };
        let (mut from, mut to) = (parts.pulse.start, parts.pulse.end);
        let starts = |range: std::ops::Range<usize>| range.step_by(length);
        from = starts(parts.before).find(|k| lit(*k)).map_or(from, |k| k.min(from));
        let last = starts(parts.after.clone()).rfind(|k| lit(*k));
        to = last.map_or(to, |k| (k + length).min(missed.len()).max(to));
        // A tail is light as well, though none of its blocks stands out.
        let tail = tail::end(fits, kind);
        to = tail.map_or(to, |end| fits.samples.partition_point(|bin| bin.from <= end).max(to));

        let opened = fits.opened(kind);
        let mut sum = 0.0;
        let sums: Vec<(f64, f64)> = (from..to)
            .map(|k| {
                let bin = &fits.samples[k];
                sum += (opened[k] - base) * (bin.to - bin.from);
                (bin.to, sum)
            })
            .collect();
        let level = Self::level(fits, &opened, base, walk.power)?;
        let dark = dark.len() as f64 * fits.step;
        let start = fits.samples.get(from)?.from;
        let early = (from < parts.pulse.start).then_some(start);
        Some(Self { sums, start, early, level, walk: walk.power, dark })
    }

    /// Full light, by the stretch of the pulse that is flattest: what a shutter does before it rests does not count.
    fn level(fits: &FrameFits, opened: &[f64], base: f64, walk: f64) -> Option<Measured> {
        let mean = |from: f64, to: f64| -> Option<f64> {
            let first = fits.samples.partition_point(|bin| bin.from < from);
            let end = fits.samples.partition_point(|bin| bin.to <= to);
            let values = opened.get(first..end).filter(|values| !values.is_empty())?;
            Some(values.iter().sum::<f64>() / values.len() as f64 - base)
        };
        // In pulses from the middle; each stretch in parts, whose scatter tells how flat it is.
        let part = FLAT / PARTS as f64;
        let stretch = |k: usize| -> Option<(f64, f64)> {
            let from = -0.5 + 0.5 * part * k as f64;
            let means: Option<Vec<f64>> = (0..PARTS)
                .map(|i| mean(from + part * i as f64, from + part * (i + 1) as f64))
                .collect();
            let means = means?;
            let level = means.iter().sum::<f64>() / PARTS as f64;
            let scatter = means.iter().map(|m| (m - level).powi(2)).sum::<f64>();
            // A stretch of a ramp or of the dark is flat as well.
            (level > 0.6).then_some((scatter, level))
        };
        let count = ((1.0 - FLAT) / (0.5 * part)) as usize;
        let stretches: Vec<(f64, f64)> = (0..=count).filter_map(stretch).collect();
        let least = stretches.iter().map(|(scatter, _)| *scatter).fold(f64::INFINITY, f64::min);
        // Which of those that are nearly as flat is the flattest is chance: their mean counts, and is known no better than they
        // agree.
        let alike: Vec<f64> =
            stretches.iter().filter(|s| s.0 <= ALIKE * least).map(|(_, level)| *level).collect();
        let middle = mean(-0.25, 0.25)?;
        let (scatter, value) = match alike.len() {
            0 => (0.0, middle),
            n => (least, alike.iter().sum::<f64>() / n as f64),
        };
        let apart = alike.iter().map(|level| (level - value).abs()).fold(0.0, f64::max);
        let usual = walk / part * (PARTS - 1) as f64;
        // Where even that is not flat, it is no rest.
        let uneven = ((scatter - usual).max(0.0) / PARTS as f64).sqrt();
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
                return before.0
                    + (t - before.0) * if part.is_finite() { part.clamp(0.0, 1.0) } else { 0.5 };
            }
            before = (t, sum);
        }
        before.0
    }
}
