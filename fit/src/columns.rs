//! What may be added to a shutter's signal where the samples show it: a drift, a hum, the lamp's flicker.

use std::ops::Range;

use crate::bins::Bin;
use crate::frame::{FrameFits, KindFit};
use crate::hum;
use crate::lag::{falls, lagging};
use crate::noise::{blocks, correlation, mean, mean_square};
use crate::signal::{Coupling, Flicker, Kind, Signal};
use crate::structure::structure;
use crate::trace::{Frame, Pulses};

/// A column is kept if the criterion falls by more than this.
const WORTH: f64 = 10.0;
/// So many standard errors between the drift and the dark before are no chance.
const UNLIKE: f64 = 4.0;
/// How often a lamp on the mains flickers, in hertz.
const MAINS: [f64; 2] = [100.0, 120.0];
/// Where the rates of capacitors are looked for, by pulses.
const RATES: [f64; 3] = [0.02, 0.2, 1.0];
/// So much counts a sample in the pulse where the dark is to tell of it.
const LIT: f64 = 1e-4;
/// The dark is looked at in so many parts on either side, without the tails of a pulse.
const PARTS: usize = 16;
const ROOM: f64 = 0.15;
/// What is missed of it has to fall so far with a capacitor, that chance does not do that: by five standard deviations.
const FALLS: f64 = 3.0;
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

/// The freest fit with a capacitor, or a drift and a hum, if they are worth it and a tail does not explain as much;
/// none where nothing is.
fn with_columns(fits: &FrameFits, mains: Option<f64>) -> Option<KindFit> {
    let plain = fits.of(Kind::Free);
    let is_tail = |KindFit { solution, .. }: &KindFit| {
        let falls = |lagging: Vec<f64>| falls(solution, fits.bins(), &lagging);
        let falls = lagging(solution, fits.bins(), fits.step).and_then(falls);
        falls.is_some_and(|(by_tail, by_columns)| by_tail >= by_columns)
    };
    let humming = |without| humming(fits, without, mains).filter(|found| !is_tail(found));
    let explains = |found: &KindFit| structure(&fits.with(found.clone()), Kind::Free).test.explained;
    let alone = humming(plain);
    let line = fit(fits, &Signal { drift: Some(0.0), ..plain.solution.signal });
    // Behind a capacitor the dark is lower after the pulse than before; a curve that takes all the dark hides that.
    let dark = dark(&fits.samples, plain).map(|part| &plain.residuals[part]);
    let is_lower = dark.iter().any(|part| part.is_empty()) || mean(dark[1]) < mean(dark[0]);
    let may_be_coupled = is_lower && plain.solution.signal.coupling.is_none();
    let coupled = may_be_coupled.then(|| coupled(fits)).flatten();
    if let Some(coupled) = &coupled {
        let [by_line, by_dark] = [&line, coupled].map(|found| by_dark(fits, found));
        let by_hum = alone.as_ref().map_or(f64::INFINITY, |hum| in_dark(fits, hum));
        if in_dark(fits, &by_line).min(FALLS * by_hum) > FALLS * in_dark(fits, &by_dark) {
            // What the shutter does that no curve has tells nothing of a capacitor.
            let agrees = in_dark(fits, coupled) < FALLS * in_dark(fits, &by_dark) && explains(coupled);
            let coupled = if agrees { coupled.clone() } else { by_dark };
            return Some(humming(&coupled).unwrap_or(coupled));
        }
    }
    let is_one = is_better(&line, plain, WORTH) && drifts_before(&line, &fits.samples) && !is_tail(&line);
    let beside = if is_one {
        let both = humming(&line);
        // A hum of few periods may be all of the drift.
        let best = alone.filter(|alone| is_better(alone, &line, 0.0)).unwrap_or(line);
        Some(both.filter(|both| is_better(both, &best, WORTH)).unwrap_or(best))
    } else {
        alone
    };
    let is_best = |coupled: &KindFit| is_better(coupled, beside.as_ref().unwrap_or(plain), 3.0 * WORTH);
    coupled.filter(|coupled| is_best(coupled) && explains(coupled)).or(beside)
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

/// With the strongest hum, if that stands out.
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

/// The freest fit with a capacitor before the recorder, or with a second one.
fn coupled(fits: &FrameFits) -> Option<KindFit> {
    let signal = fits.of(Kind::Free).solution.signal;
    let with = |rate: f64| {
        let coupling = match signal.coupling {
            None => Coupling { charge: 0.0, rates: [Some(rate), None], held: false },
            Some(Coupling { rates: [first, None], held: false, charge }) => {
                Coupling { rates: [first, Some(rate)], held: false, charge }
            }
            Some(_) => return None,
        };
        Some(fit(fits, &Signal { coupling: Some(coupling), ..signal }))
    };
    RATES.into_iter().filter_map(with).min_by(|a, b| a.squares.total_cmp(&b.squares))
}

/// The same fits with a second capacitor behind the first, if that is worth it.
pub fn coupled_twice(fits: &FrameFits) -> Option<FrameFits> {
    fits.of(Kind::Free).solution.signal.coupling?;
    let mut others = fits.clone();
    let twice = coupled(fits).filter(|twice| is_better(twice, fits.of(Kind::Free), WORTH))?;
    others.search_with(twice, &mut |_| ());
    Some(others)
}

/// The samples before a curve and behind it, without what may be its tails.
fn dark(bins: &[Bin], found: &KindFit) -> [Range<usize>; 2] {
    let curve = found.solution.signal.curve;
    let room = ROOM * curve.length();
    let before = bins.partition_point(|bin| bin.to < curve.start - room);
    let after = bins.partition_point(|bin| bin.from <= curve.end() + room);
    [0..before, after.max(before)..bins.len()]
}

/// The same with a drift or a capacitor as the dark alone has it; a capacitor keeps that.
fn by_dark(fits: &FrameFits, found: &KindFit) -> KindFit {
    let mut problem = fits.problem.clone();
    let [before, after] = dark(&problem.bins, found);
    problem.bins[before.end..after.start].iter_mut().for_each(|bin| bin.samples *= LIT);
    let mut signal = problem.minimise(&found.solution.signal).signal;
    signal.coupling.iter_mut().for_each(|coupling| coupling.held = true);
    KindFit::new(fits.problem.at(&signal), &fits.samples)
}

/// What a fit misses of the dark, in parts.
fn in_dark(fits: &FrameFits, found: &KindFit) -> f64 {
    let parts = dark(&fits.samples, found).map(|part| &found.residuals[part]);
    parts.into_iter().map(|part| mean_square(&blocks(part, (part.len() / PARTS).max(1)))).sum()
}

/// The best signal near `start`.
fn fit(fits: &FrameFits, start: &Signal) -> KindFit {
    KindFit::new(fits.problem.minimise(start), &fits.samples)
}

/// The best signal near `start`, which has more columns than `without`, if that is worth it.
fn if_worth_it(fits: &FrameFits, start: &Signal, without: &KindFit) -> Option<KindFit> {
    let with = fit(fits, start);
    is_better(&with, without, WORTH).then_some(with)
}

/// Is the criterion of one fit lower by so much? What it explains must not count as correlated noise.
fn is_better(with: &KindFit, without: &KindFit, by: f64) -> bool {
    let correlation = correlation(&with.residuals);
    with.bic(correlation) < without.bic(correlation) - by
}
