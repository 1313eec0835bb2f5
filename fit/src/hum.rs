//! The sine that stands out of a signal's residuals.

use crate::bins::Bin;
use crate::signal::{Bounds, Hum, Signal};
use crate::solve::{Cholesky, normal_equations};

/// From so many periods in a record on, it tells any frequency.
pub const FEWEST: f64 = 3.0;
/// The fewest periods of the mains: of fewer, a record shows a drift.
const LEAST: f64 = 0.4;
/// The mains' frequencies and twice them, in hertz, where a record does not tell them apart.
const MAINS: [Bounds; 2] = [(50.0, 60.0), (100.0, 120.0)];
/// The mains keep theirs to this share.
const KEPT: f64 = 0.01;
/// A hum explains so many times as much as sines of so many periods more in the record; one of few periods more still.
const STANDS_OUT: f64 = 30.0;
const SHORT_STANDS_OUT: f64 = 100.0;
const ABOVE: [u8; 5] = [4, 5, 6, 7, 8];
/// The most frequencies that are tried, half a period of the whole trace apart.
const MOST: usize = 600;

fn length(bins: &[Bin]) -> f64 {
    bins.last().map_or(0.0, |last| last.to - bins[0].from)
}

/// How many periods of a hum the bins last.
pub fn periods(bins: &[Bin], hum: &Hum) -> f64 {
    hum.frequency * length(bins)
}

/// Where the frequency of a hum may lie: the mains' alone below [`FEWEST`] periods, or where they are known to have so
/// many `hertz`. A unit of time is `second` seconds.
fn ranges(bins: &[Bin], hertz: Option<f64>, second: f64) -> Vec<Bounds> {
    let length = length(bins);
    let few = FEWEST / length;
    let band = |(low, high): Bounds| (low * second, high * second);
    let Some(hertz) = hertz else {
        let short = MAINS.map(band).into_iter().filter(|band| band.0 < few);
        let short = short.map(|(low, high)| (low.max(LEAST / length), high.min(few)));
        // Up to a quarter of the intervals a period, as far as the tries go.
        let most = (0.25 * bins.len() as f64).min(0.5 * MOST as f64) / length;
        return short.chain([(few, most)]).filter(|(low, high)| low <= high).collect();
    };
    let known = [hertz, 2.0 * hertz].map(|hertz| {
        // In a few periods nobody sees it stray.
        let strays = if hertz * second < few { 0.0 } else { KEPT };
        band((hertz * (1.0 - strays), hertz * (1.0 + strays)))
    });
    known.into_iter().filter(|(low, _)| *low > LEAST / length).collect()
}

/// The sine of each range that explains most of what the signal misses.
pub fn strongest(bins: &[Bin], signal: &Signal, hertz: Option<f64>, second: f64) -> Vec<Hum> {
    let missed = missed(bins, signal);
    let period = length(bins).recip();
    let best_in = |range: Bounds| {
        let (low, high) = range;
        let tries = (2.0 * (high - low) / period).ceil().max(1.0);
        let apart = (high - low) / tries;
        let all = (0..=tries as usize).map(|k| sine(&missed, low + k as f64 * apart, range));
        // The fit moves the frequency between its neighbours.
        all.reduce(|a, b| if b.0 > a.0 { b } else { a }).map(|(_, hum)| hum)
    };
    ranges(bins, hertz, second).into_iter().filter_map(best_in).collect()
}

/// What the signal misses of each bin: when, how much, and of how many samples.
fn missed(bins: &[Bin], signal: &Signal) -> Vec<(f64, f64, f64)> {
    let each = bins.iter().zip(signal.missed(bins));
    each.map(|(bin, missed)| (bin.middle(), missed, bin.samples)).collect()
}

/// Is a signal's hum no part of the shutter or of the noise: as strong in the dark as on the whole, and beyond what
/// sines of higher frequencies would explain of the rest, of which 1/f noise has nearly as much?
pub fn is_one(bins: &[Bin], signal: &Signal) -> bool {
    let Some(hum) = signal.hum else { return false };
    let (start, end) = (signal.curve.start, signal.curve.end());
    let missed = missed(bins, signal);
    let above = ABOVE.map(|k| hum.frequency + f64::from(k) / length(bins));
    let usual = above.map(|frequency| sine(&missed, frequency, hum.range).0).iter().sum::<f64>();
    let mut all: Vec<_> = missed.iter().map(|(t, _, weight)| (*t, hum.at(*t), *weight)).collect();
    let power = sine(&all, hum.frequency, hum.range).0;
    for (sine, (_, miss, _)) in all.iter_mut().zip(&missed) {
        sine.1 += miss;
    }
    all.retain(|(t, ..)| *t < start || *t > end);
    let (_, alone) = sine(&all, hum.frequency, hum.range);
    // The part of it that is in phase.
    let shared = alone.cosine * hum.cosine + alone.sine * hum.sine;
    let share = shared / hum.amplitude().powi(2);
    // The fewer its periods, the more has 1/f noise at its frequency than above.
    let beyond = if periods(bins, &hum) < 2.0 * FEWEST { SHORT_STANDS_OUT } else { STANDS_OUT };
    (0.5..2.0).contains(&share) && power * ABOVE.len() as f64 > beyond * usual
}

/// The best sine of a frequency beside a level, and by how much it lowers the sum of squares.
fn sine(missed: &[(f64, f64, f64)], frequency: f64, range: Bounds) -> (f64, Hum) {
    let rows = missed.iter().map(|(t, miss, weight)| {
        let (sine, cosine) = (std::f64::consts::TAU * frequency * t).sin_cos();
        (*weight, [1.0, cosine, sine], *miss)
    });
    let (normal, right) = normal_equations(rows);
    let by_level = right[0] * right[0] / normal[0][0];
    let best = Cholesky::new(normal).map_or(vec![0.0; 3], |factor| factor.solve(&right));
    let gain = best.iter().zip(right).map(|(x, b)| x * b).sum::<f64>() - by_level;
    // Not a number counts as 0.
    (gain.max(0.0), Hum { frequency, range, cosine: best[1], sine: best[2] })
}
