//! What may be added to a shutter's signal where the samples show it: a drift, a hum, the lamp's flicker.

use crate::bins::Bin;
use crate::frame::{FrameFits, KindFit};
use crate::hum;
use crate::lag::{falls, lagging};
use crate::noise::correlation;
use crate::signal::{Flicker, Kind, Signal};
use crate::trace::{Frame, Pulses};

/// A column is kept if the criterion falls by more than this.
const WORTH: f64 = 10.0;
/// So many standard errors between the drift and the dark before are no chance.
const UNLIKE: f64 = 4.0;
/// How often a lamp on the mains flickers, in hertz.
const MAINS: [f64; 2] = [100.0, 120.0];
/// Less than so many periods of it in a pulse cannot be told from the shutter's own shape.
const FEWEST: f64 = 2.0;

/// The fits of a frame with the columns that it asks for; `progress` is told the share that is done.
pub fn fits(pulses: &Pulses, frame: &Frame, mains: Option<f64>, progress: &mut dyn FnMut(f64)) -> FrameFits {
    // If a column turns out to be worth it, the search comes twice, half of the way each.
    let mut fits = FrameFits::new(pulses, frame, &mut |done| progress(0.5 * done));
    if let Some(free) = with_columns(&fits, mains) {
        fits.search_with(free, &mut |done| progress(0.5 + 0.5 * done));
    }
    fits
}

/// The freest fit with a drift and a hum, if they are worth it and a tail does not explain as much; none where neither
/// is.
fn with_columns(fits: &FrameFits, mains: Option<f64>) -> Option<KindFit> {
    let plain = fits.of(Kind::Free);
    let is_tail = |KindFit { solution, .. }: &KindFit| {
        let falls = |lagging: Vec<f64>| falls(solution, fits.bins(), &lagging);
        let falls = lagging(solution, fits.bins(), fits.step).and_then(falls);
        falls.is_some_and(|(by_tail, by_columns)| by_tail >= by_columns)
    };
    let start = Signal { drift: Some(0.0), ..plain.solution.signal };
    let drifting = if_worth_it(fits, &start, plain);
    let drifting = drifting.filter(|it| drifts_before(it, &fits.samples) && !is_tail(it));
    let humming = |without| humming(fits, without, mains).filter(|found| !is_tail(found));
    let alone = humming(plain);
    let Some(drifting) = drifting else { return alone };
    let both = humming(&drifting);
    // A hum of few periods may be all of the drift.
    let best = alone.filter(|alone| is_better(alone, &drifting, 0.0)).unwrap_or(drifting);
    Some(both.filter(|both| is_better(both, &best, WORTH)).unwrap_or(best))
}

/// Is the drift in the dark before the pulse as well, as far as that shows? What is in the dark after alone is a tail.
fn drifts_before(found: &KindFit, samples: &[Bin]) -> bool {
    let curve = found.solution.signal.curve;
    let before = samples.partition_point(|bin| bin.to < curve.start);
    let times = samples[..before].iter().map(|bin| bin.middle());
    let left: Vec<(f64, f64)> = times.zip(found.residuals.iter().copied()).collect();
    let n = left.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| left.iter().map(of).sum::<f64>() / n;
    let (time, level) = (mean(|x| x.0), mean(|x| x.1));
    let squares: f64 = left.iter().map(|(t, _)| (t - time).powi(2)).sum();
    let slope = left.iter().map(|(t, r)| (t - time) * (r - level)).sum::<f64>() / squares;
    let variance = found.variance() * correlation(&found.residuals);
    // Of two samples there is no slope to speak of.
    left.len() < 8 || slope.abs() <= UNLIKE * (variance / squares).sqrt()
}

/// With the strongest hum, if that is in the dark as well: what is in the pulse alone is the shutter's own.
fn humming(fits: &FrameFits, without: &KindFit, mains: Option<f64>) -> Option<KindFit> {
    let (signal, bins) = (without.solution.signal, fits.bins());
    let with = |hum| if_worth_it(fits, &Signal { hum: Some(hum), ..signal }, without);
    let all = hum::strongest(bins, &signal, mains, fits.units.pulse).into_iter().filter_map(with);
    let found = all.min_by(|a, b| a.squares.total_cmp(&b.squares))?;
    hum::is_one(bins, &found.solution.signal).then_some(found)
}

/// The same fits with the flicker of a lamp on the mains, if that is worth it.
pub fn flickering(fits: &FrameFits) -> Option<FrameFits> {
    let without = fits.of(Kind::Free);
    let frequencies = MAINS.into_iter().map(|hertz| hertz * fits.units.pulse);
    let found = frequencies.filter(|frequency| *frequency > FEWEST).filter_map(|frequency| {
        let flicker = Some(Flicker { frequency, terms: [0.0; 4] });
        if_worth_it(fits, &Signal { flicker, ..without.solution.signal }, without)
    });
    let found = found.min_by(|a, b| a.squares.total_cmp(&b.squares))?;
    let mut others = fits.clone();
    others.search_with(found, &mut |_| ());
    Some(others)
}

/// The best signal near `start`, which has more columns than `without`, if that is worth it.
fn if_worth_it(fits: &FrameFits, start: &Signal, without: &KindFit) -> Option<KindFit> {
    let with = KindFit::new(fits.problem.minimise(start), &fits.samples);
    is_better(&with, without, WORTH).then_some(with)
}

/// Is the criterion of one fit lower by so much? What it explains must not count as correlated noise.
fn is_better(with: &KindFit, without: &KindFit, by: f64) -> bool {
    let correlation = correlation(&with.residuals);
    with.bic(correlation) < without.bic(correlation) - by
}
