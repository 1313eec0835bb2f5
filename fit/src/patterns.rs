//! What a curve may leave out of its samples, by patterns: a tail behind the closing ramp (creeping blades, a relaxing
//! crystal, a slow sensor), full light that sinks or rises, and a dip or a bump for a fifth of the pulse, wherever that
//! lies.
//!
//! How much of a pattern is in the samples, less what the signal's own parameters could make up for, is compared with
//! what the dark's noise would put there (a score test). That finds what no block of samples shows by itself.

use std::iter::once;

use crate::bins::Bin;
use crate::curve::Exposure;
use crate::frame::FrameFits;
use crate::lag::{LAG, Movable, lagging, score};
use crate::missed::{Beside, Parts};
use crate::noise::{self, LEAST, from_mean, normal_of, ratio_of, slow_correlation};
use crate::signal::Kind;

/// Dips are looked for in stretches of so many pulses, which lie half of that apart, and so far around the pulse.
const FIFTH: f64 = 0.2;
const AROUND: f64 = 0.3;
/// Of a dip so near to the pulse's middle the test says how small it may be.
const MIDDLE: f64 = 0.15;
/// A plateau that is shorter than this share of the whole has no slope.
const PLATEAU: f64 = 0.1;
/// What is found nine times in ten is so many standard deviations larger than what is found half of the time.
const SURELY: f64 = 1.3;
/// Half a step is so many of its standard deviations, or less.
const ROUNDING: f64 = 2.0;
/// After so many time constants nothing is left of a tail that noise would not hide.
const TAIL_ENDS: f64 = 2.0;
/// In fewer samples of dark the noise is not known.
const LEAST_DARK: usize = 16;

/// What is missed matters from this share of the exposure on; below, cubic ramps are taken for what they stand for.
pub const MATTERS: f64 = 4e-4;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A tail, by the pattern of a [`lag`](crate::lag).
    Tail,
    /// Full light that sinks or rises.
    Slope,
    /// A dip or a bump around a time.
    Dip(f64),
}

impl Shape {
    pub fn all() -> impl Iterator<Item = Self> {
        let most = ((0.5 + AROUND) / (0.5 * FIFTH)).round() as i32;
        let dips = (-most..=most).map(|k| Self::Dip(0.5 * FIFTH * f64::from(k)));
        [Self::Tail, Self::Slope].into_iter().chain(dips)
    }

    /// Beyond so many standard deviations it is no chance: one pattern alone is tested by less than many are.
    pub fn beyond(self) -> f64 {
        match self {
            Self::Tail => 3.2,
            Self::Slope => 3.5,
            Self::Dip(_) => 4.0,
        }
    }

    /// It matters where the triggers move so much with it, as a share of the exposure.
    pub fn matters(self) -> f64 {
        match self {
            Self::Tail => 1e-3,
            // That is 0.5 % of the exposure.
            Self::Slope => 8e-4,
            Self::Dip(_) => MATTERS,
        }
    }

    /// So much of it in each bin, in the signal's unit.
    fn light(self, fits: &FrameFits, kind: Kind) -> Option<Vec<f64>> {
        let solution = &fits.of(kind).solution;
        let (gain, bins) = (solution.signal.gain, fits.bins());
        let exposure = fits.exposure(kind);
        let each = |of: &dyn Fn(&Bin) -> f64| Some(bins.iter().map(of).collect());
        match self {
            Self::Tail => lagging(solution, bins, fits.step),
            Self::Slope if exposure.curve.plateau < PLATEAU * exposure.curve.length() => None,
            Self::Slope => each(&|bin| {
                let since = bin.middle() - exposure.curve.open_end();
                -gain * exposure.mean(bin.from, bin.to) * since.max(0.0)
            }),
            Self::Dip(at) => {
                let (from, to) = (at - 0.5 * FIFTH, at + 0.5 * FIFTH);
                each(&|bin| {
                    let inside = (bin.to.min(to) - bin.from.max(from)).max(0.0);
                    -gain * inside / bin.width()
                })
            }
        }
    }
}

/// How much of a pattern the samples show. All but `sigma` as shares of the light, or of the exposure.
pub struct Pattern {
    pub shape: Shape,
    /// How far that is from chance, in standard deviations.
    pub sigma: f64,
    /// By how much the triggers move with it, the root of their mean square, and by how much the exposure.
    pub triggers: f64,
    pub exposure: f64,
    /// Its highest place, and when.
    pub share: f64,
    pub at: f64,
    /// What would be found nine times in ten is so many times as much.
    pub least: f64,
}

impl Pattern {
    pub fn matters(&self) -> bool {
        self.triggers > self.shape.matters()
    }

    /// Would less of it than this share of the light be missed, in the middle of the pulse?
    pub fn unseen(&self) -> f64 {
        match self.shape {
            Shape::Dip(at) if at.abs() > MIDDLE => 0.0,
            _ => self.least * self.share.abs(),
        }
    }
}

/// Patterns of these shapes in what a kind's curve misses; none where there is too little dark.
pub fn patterns(fits: &FrameFits, kind: Kind, shapes: impl Iterator<Item = Shape>) -> Vec<Pattern> {
    let Some(noise) = Noise::new(fits, kind, &Parts::new(fits, kind)) else { return Vec::new() };
    let (solution, bins) = (&fits.of(kind).solution, fits.bins());
    let (gain, exposure) = (solution.signal.gain, fits.exposure(kind));
    let movable = Movable::new(solution, bins, |_| true);
    let found = |shape: Shape| {
        let light = shape.light(fits, kind)?;
        let rest = movable.rest(&light);
        let (along, square) = score(&rest, &movable.missed, bins);
        let usual = noise.along(&rest, bins, &exposure).sqrt();
        // A step of the values puts no more than this into it, which is no matter of chance.
        let each = bins.iter().zip(&rest).map(|(bin, r)| bin.samples * r.abs());
        let rounding = ROUNDING * fits.rounding * gain * each.sum::<f64>();
        let (off, amount) = ((along.abs() - rounding).max(0.0) / usual, along / square);
        let known = (1.0, noise.known);
        let sigma = normal_of(off * off, known);
        let surely = ratio_of(shape.beyond(), known).sqrt() + SURELY;
        let of = |light: &[f64]| {
            let amounts = light.iter().map(|light| amount * light / gain);
            Beside::new(exposure, bins, amounts)
        };
        let raw = of(&light);
        let (k, highest) = light.iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        Some(Pattern {
            shape,
            // Light that is missing behind a ramp is no tail.
            sigma: if shape == Shape::Tail && along < 0.0 { -sigma } else { sigma },
            // The curve may make up for some of it, but not for more than all.
            triggers: raw.triggers().min(of(&movable.without_levels(&light)).triggers()),
            exposure: raw.exposure(),
            share: amount * highest / gain,
            at: bins[k].from,
            least: (surely * usual + rounding) / along.abs().max(1e-9 * usual),
        })
    };
    shapes.filter_map(found).collect()
}

/// When the tail that the samples show has come to its end, if they show one.
pub fn tail_end(fits: &FrameFits, kind: Kind) -> Option<f64> {
    let curve = fits.of(kind).solution.signal.curve;
    let end = curve.end() + TAIL_ENDS * LAG * curve.closing;
    let tail = patterns(fits, kind, once(Shape::Tail)).pop()?;
    (tail.matters() && tail.sigma > tail.shape.beyond()).then_some(end)
}

/// The noise's power at the slow end, as the dark shows it.
pub struct Noise {
    /// Of a sample, in the signal's unit.
    power: f64,
    /// How fast its sums wander: their variance over a unit of time, as openness.
    pub walk: f64,
    /// So many times as much of it is in full light.
    in_light: f64,
    /// By so many independent samples.
    known: f64,
}

impl Noise {
    /// By these parts of what a kind's curve misses; none where there is too little dark.
    pub fn new(fits: &FrameFits, kind: Kind, Parts { before, pulse, after }: &Parts) -> Option<Self> {
        let residuals = &fits.of(kind).residuals;
        // Each from its own level: what is behind the pulse may be a tail.
        let dark = [before, after].map(|part| from_mean(&residuals[part.clone()])).concat();
        if dark.len() < LEAST_DARK {
            return None;
        }
        let n = dark.len() as f64;
        let correlation = slow_correlation(&dark);
        let gain = fits.of(kind).solution.signal.gain;
        let least = (LEAST * gain).powi(2);
        let squares = dark.iter().map(|r| r * r).sum::<f64>();
        let power = correlation * (squares / (n - correlation) + least);
        let in_light = (noise::fast(&residuals[pulse.clone()]) + least) / (noise::fast(&dark) + least);
        // How well a correlated noise's power is known was worked out for one that goes on from one sample to the next.
        let known = n / (2.0 * correlation - 1.0);
        Some(Self { power, walk: power / (gain * gain) * fits.step, in_light: in_light.max(1.0), known })
    }

    /// The variance that it gives a pattern's score.
    fn along(&self, pattern: &[f64], bins: &[Bin], exposure: &Exposure) -> f64 {
        let light = |bin: &Bin| 1.0 + (self.in_light - 1.0) * exposure.openness(bin.middle());
        bins.iter().zip(pattern).map(|(bin, p)| self.power * light(bin) * bin.samples * p * p).sum()
    }
}
