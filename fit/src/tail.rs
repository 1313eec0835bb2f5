//! A closing ramp that ends more slowly than its cubic: creeping blades, a relaxing crystal, a slow sensor.
//!
//! One pattern stands for all of these, that of a [`lag`](crate::lag). How much of it is in the samples is compared with what the dark's
//! noise would put there (a score test), which finds a tail that no block of samples shows by itself.

use crate::bins::Bin;
use crate::curve::{Exposure, fractions};
use crate::frame::FrameFits;
use crate::lag::{LAG, Movable, Score, lagging};
use crate::missed::{Parts, least_open};
use crate::noise::{LEAST, correlation, fast, normal_of, ratio_of};
use crate::signal::Kind;

/// There is a tail beyond so many standard deviations: a normal number is there once in 1400 times, on this side. That is less than
/// where many blocks are tested, since this is one pattern alone.
pub const BEYOND: f64 = 3.2;
/// A tail matters where the triggers move so much with it, as a share of the exposure.
pub const MATTERS: f64 = 1e-3;
/// After so many time constants nothing is left of a tail that noise would not hide.
const ENDS: f64 = 2.0;
/// In fewer samples of dark the noise is not known.
const LEAST_DARK: usize = 16;

/// The tail that the samples show.
pub struct Tail {
    /// How far that is from chance, in standard deviations; below 0 where light is missing.
    pub sigma: f64,
    /// By how much the triggers move with it, the root of their mean square, as a share of the exposure.
    pub moves: f64,
    /// Less than this, in the same measure, would not be seen.
    pub unseen: f64,
    /// Where it is highest: its share of the light, and when.
    pub share: f64,
    pub at: f64,
}

/// When the tail that the samples show has come to its end, if they show one.
pub fn end(fits: &FrameFits, kind: Kind) -> Option<f64> {
    let curve = fits.of(kind).solution.signal.curve;
    let found = tail(fits, kind).filter(|tail| tail.sigma > BEYOND && tail.moves > MATTERS);
    found.map(|_| curve.end() + ENDS * LAG * curve.closing)
}

/// The tail in what a kind's curve misses; none where that has no ramp to speak of, or too little dark.
pub fn tail(fits: &FrameFits, kind: Kind) -> Option<Tail> {
    let solution = &fits.of(kind).solution;
    let bins = fits.bins();
    let lagging = lagging(solution, bins, fits.step)?;
    let movable = Movable::new(solution, bins, |_| true);
    let rest = movable.rest(&lagging);
    let Score { along, square } = Score::new(&rest, &movable.missed, bins);
    let noise = Noise::new(fits, kind)?;
    let rounding: f64 = bins.iter().zip(&rest).map(|(bin, r)| bin.samples * r.abs()).sum::<f64>()
        * fits.rounding
        * solution.signal.gain;
    let usual = noise.along(&rest, bins, &fits.exposure(kind)).sqrt() + rounding;
    let off = along / usual;
    let amount = along / square;
    let moves = moves(fits, kind, &movable.without_levels(&lagging));
    let least = ratio_of(BEYOND, (1.0, noise.known)).sqrt() * usual / square;
    let (k, highest) =
        lagging.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0));
    Some(Tail {
        sigma: normal_of(off * off, (1.0, noise.known)) * off.signum(),
        moves: amount.abs() * moves,
        unseen: least * moves,
        share: amount * highest / solution.signal.gain,
        at: bins[k].from,
    })
}

/// The noise's power at the slow end, as the dark shows it.
struct Noise {
    power: f64,
    /// So many times as much of it is in full light.
    in_light: f64,
    /// By so many independent samples.
    known: f64,
}

impl Noise {
    fn new(fits: &FrameFits, kind: Kind) -> Option<Self> {
        let parts = Parts::new(fits, kind);
        let residuals = &fits.of(kind).residuals;
        let dark = [&residuals[parts.before], &residuals[parts.after]].concat();
        if dark.len() < LEAST_DARK {
            return None;
        }
        let n = dark.len() as f64;
        let level = dark.iter().sum::<f64>() / n;
        let dark: Vec<f64> = dark.iter().map(|r| r - level).collect();
        let correlation = correlation(&dark);
        let gain = fits.of(kind).solution.signal.gain;
        let least = (LEAST * gain).powi(2);
        let squares = dark.iter().map(|r| r * r).sum::<f64>();
        let power = correlation * (squares / (n - correlation) + least);
        let in_light = (fast(&residuals[parts.pulse]) + least) / (fast(&dark) + least);
        // How well a correlated noise's power is known was worked out for one that goes on from one sample to the next.
        Some(Self { power, in_light: in_light.max(1.0), known: n / (2.0 * correlation - 1.0) })
    }

    /// The variance that it gives a pattern's score.
    fn along(&self, pattern: &[f64], bins: &[Bin], exposure: &Exposure) -> f64 {
        let light =
            |bin: &Bin| 1.0 + (self.in_light - 1.0) * exposure.openness(0.5 * (bin.from + bin.to));
        bins.iter().zip(pattern).map(|(bin, p)| self.power * light(bin) * bin.samples * p * p).sum()
    }
}

/// By how much triggers move with such a change of the light, the root of their mean square, as a share of the exposure.
fn moves(fits: &FrameFits, kind: Kind, light: &[f64]) -> f64 {
    const TRIGGERS: u32 = 16;
    let exposure = fits.exposure(kind);
    let gain = fits.of(kind).solution.signal.gain;
    let mut sum = 0.0;
    let more = |(bin, light): (&Bin, &f64)| {
        sum += light / gain * (bin.to - bin.from);
        (bin.to, sum)
    };
    let sums: Vec<(f64, f64)> = fits.bins().iter().zip(light).map(more).collect();
    let off = |u: f64| {
        let t = exposure.trigger(u).0;
        let here = sums[..sums.partition_point(|(to, _)| *to <= t)].last().map_or(0.0, |x| x.1);
        (u * sum - here) / (least_open(&exposure, t) * exposure.area())
    };
    let squares = fractions(TRIGGERS).map(|u| off(u).powi(2)).sum::<f64>();
    (squares / f64::from(TRIGGERS)).sqrt()
}
