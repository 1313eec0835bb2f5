//! Does a curve explain its samples? What it misses is compared with the noise that the dark shows.
//!
//! Means over blocks of neighbours show structure, differences of neighbours the noise alone; the ratio of the two in the pulse
//! is compared with the same ratio in the dark (an F test), so that a noise of any colour and of any size is none. A block in the
//! dark that stands out is structure as well, and so are trigger times that the samples put elsewhere.

use std::ops::Range;

use crate::curve::fractions;
use crate::frame::FrameFits;
use crate::missed::{Missed, Parts, least_open, missed};
use crate::noise::{correlation, fast, mean_square, normal_of, ratio_of};
use crate::signal::Kind;
use crate::tail::{self, Tail};

/// So many standard deviations are beyond chance: a normal number is there once in 30 000 times. With some ten tests, a
/// curve that explains the samples fails once in 3000 times.
const BEYOND: f64 = 4.0;
/// Light that a curve leaves out lies so near to it, in pulses.
const AROUND: f64 = 0.3;
/// Of blocks in the dark, by their own median: that is known less well.
const STANDS_OUT: f64 = 7.0;
/// A test that misses so much of the exposure has too little power.
pub const UNSEEN: f64 = 0.0035;
/// Of the light for a fifth of the pulse, that is as much.
pub const FIFTH: f64 = 0.2;
/// What is missed matters from this share of the exposure on; below, cubic ramps are taken for what they stand for.
const MATTERS: f64 = 4e-4;
/// Real blades are no cubics: by this share of the exposure their triggers are off, on top of all that shows.
const CUBIC: f64 = 5e-5;

/// What a test says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Structure {
    /// Does the model explain the trace?
    pub explained: bool,
    /// Was there enough dark to know the noise by?
    pub tested: bool,
    /// By how many standard deviations the most telling of the tests is off.
    pub sigma: f64,
    /// And by how many that test may be.
    beyond: f64,
    /// Structure that moves the triggers by less than this share of the exposure would not be seen.
    pub unseen: f64,
    /// The triggers move by this share of the exposure with the tail that shows, though it may be chance.
    tail: f64,
    /// The greatest structure, as a share of the light, and when, in the frame's unit.
    pub share: f64,
    pub at: f64,
}

/// Means of `length` neighbours.
fn blocks(values: &[f64], length: usize) -> Vec<f64> {
    values.chunks_exact(length).map(|few| few.iter().sum::<f64>() / length as f64).collect()
}

/// The test.
pub fn structure(fits: &FrameFits, kind: Kind) -> Structure {
    let parts = Parts::new(fits, kind);
    let missed = missed(fits, kind);
    let light = Light { fits, kind, parts: &parts, missed: &missed };
    let tested = Walk::new(light.missed, &parts, fits.step).is_some();
    let mut found = Structure {
        explained: true,
        tested,
        sigma: 0.0,
        beyond: BEYOND,
        unseen: light.unseen(),
        tail: 0.0,
        share: 0.0,
        at: 0.0,
    };
    let mut length = 2;
    while parts.pulse.len() / length >= 6 {
        for sigma in [light.in_pulse(length), light.after(length)].into_iter().flatten() {
            found.take(sigma, BEYOND, light.greatest(length));
        }
        if let Some((ratio, at)) = light.in_dark(length) {
            found.take(ratio * BEYOND / STANDS_OUT, BEYOND, at);
        }
        length *= 2;
    }
    for part in [&parts.before, &parts.after] {
        if let Some((sigma, at)) = light.trend(part) {
            found.take(sigma, BEYOND, at);
        }
    }
    for room in [0.0, AROUND] {
        if let Some((sigma, t, share)) = light.of_triggers(room) {
            found.take(sigma, BEYOND, (share, t));
        }
    }
    if let Some(Tail { sigma, moves, unseen, share, at }) = tail::tail(fits, kind) {
        found.unseen = found.unseen.max(unseen);
        found.tail = if sigma > 1.0 { moves } else { 0.0 };
        if moves > tail::MATTERS {
            found.take(sigma, tail::BEYOND, (share, at));
        }
    }
    found
}

impl Structure {
    /// What a trace that is explained may hide nevertheless, as a share of the exposure: it belongs to the errors.
    pub fn hidden(&self) -> f64 {
        let unseen = if self.unseen > UNSEEN { 0.5 * self.unseen } else { 0.0 };
        CUBIC.hypot(self.tail).hypot(unseen)
    }

    fn take(&mut self, sigma: f64, beyond: f64, (share, at): (f64, f64)) {
        self.explained &= sigma <= beyond;
        if sigma / beyond > self.sigma / self.beyond {
            (self.sigma, self.beyond, self.share, self.at) = (sigma, beyond, share, at);
        }
    }
}

/// How fast sums of the noise wander, as the dark shows it.
pub struct Walk {
    /// The variance of a sum over a unit of time.
    pub power: f64,
    /// By so many blocks.
    pub blocks: usize,
}

impl Walk {
    /// By what blocks in the dark differ by from the next, so that a drift does not count; none where there is too little dark.
    pub fn new(missed: &[f64], parts: &Parts, step: f64) -> Option<Self> {
        let dark = [&missed[parts.before.clone()], &missed[parts.after.clone()]];
        let length = (dark[0].len() + dark[1].len()) / 14;
        if length == 0 {
            return None;
        }
        let pairs = |part: &[f64]| {
            let means = blocks(part, length);
            means.windows(2).map(|pair| pair[1] - pair[0]).collect::<Vec<_>>()
        };
        let differ = dark.map(pairs).concat();
        let power = 0.5 * mean_square(&differ) * length as f64 * step + 1e-10 * step;
        (differ.len() >= 6).then_some(Self { power, blocks: differ.len() })
    }
}

/// What the tests look at.
struct Light<'a> {
    fits: &'a FrameFits,
    kind: Kind,
    parts: &'a Parts,
    missed: &'a [f64],
}

impl Light<'_> {
    fn of(&self, part: &Range<usize>) -> &[f64] {
        &self.missed[part.clone()]
    }

    fn dark(&self) -> Vec<f64> {
        [self.of(&self.parts.before), self.of(&self.parts.after)].concat()
    }

    /// The square of a step's rounding, as far as noise does not spread it: a whole plateau may be off by as much.
    fn rounding(&self) -> f64 {
        self.fits.rounding * self.fits.rounding
    }

    fn in_pulse(&self, length: usize) -> Option<f64> {
        let (pulse, dark) = (self.of(&self.parts.pulse), self.dark());
        let (in_pulse, in_dark) = (blocks(pulse, length), blocks(&dark, length));
        if in_dark.len() < 4 {
            return None;
        }
        let rounding = self.rounding();
        let slow = (mean_square(&in_pulse) - rounding).max(0.0) / (fast(pulse) + 1e-12);
        let usual = (mean_square(&in_dark) + 1e-12 / length as f64) / (fast(&dark) + 1e-12);
        let matters = self.worth(mean_square(&in_pulse).sqrt(), in_pulse.len(), length);
        let alike = correlation(&in_dark);
        let counts = (in_pulse.len() as f64 / alike, in_dark.len() as f64 / alike);
        matters.then(|| normal_of(slow / usual, counts))
    }

    /// The dark after against the dark before.
    fn after(&self, length: usize) -> Option<f64> {
        let (before, after) = (self.of(&self.parts.before), self.of(&self.parts.after));
        let [early, late] = [before, after].map(|part| blocks(part, length));
        if early.len() < 4 || late.len() < 2 {
            return None;
        }
        let usual = mean_square(&early) + self.rounding() + 1e-12;
        let matters = self.worth(mean_square(&late).sqrt(), late.len(), length);
        let alike = correlation(&early);
        let counts = (late.len() as f64 / alike, early.len() as f64 / alike);
        matters.then(|| normal_of(mean_square(&late) / usual, counts))
    }

    /// Does the dark before, or after, run off by itself, in standard deviations?
    fn trend(&self, part: &Range<usize>) -> Option<(f64, (f64, f64))> {
        let Walk { power, blocks: known } = Walk::new(self.missed, self.parts, self.fits.step)?;
        let halves = blocks(self.of(part), part.len() / 2 + usize::from(part.len() < 2));
        let [early, late, ..] = halves[..] else { return None };
        let by = late - early;
        let usual =
            (4.0 * power / (part.len() as f64 * self.fits.step)).sqrt() + self.fits.rounding;
        // A drift that the dark has not changes the pulse by as much as half of it.
        let matters = by.abs() > 0.5 * MATTERS * self.fits.exposure(self.kind).area();
        let at = self.fits.samples[part.start].from;
        matters.then(|| (normal_of((by / usual).powi(2), (1.0, known as f64)), (by, at)))
    }

    /// Is light of this size over so many blocks enough to matter?
    fn worth(&self, size: f64, blocks: usize, length: usize) -> bool {
        // Blocks of either sign cancel, but for the root of their number.
        let amount = size * length as f64 * self.fits.step * (blocks as f64).sqrt();
        amount > MATTERS * self.fits.exposure(self.kind).area()
    }

    /// The block in the dark that stands out most: by how many of the usual ones, its size, and when.
    fn in_dark(&self, length: usize) -> Option<(f64, (f64, f64))> {
        let of = |part: &Range<usize>| {
            let start = part.start;
            let means = blocks(self.of(part), length).into_iter().enumerate();
            means.map(move |(k, mean)| (mean, start + k * length)).collect::<Vec<_>>()
        };
        let all = [of(&self.parts.before), of(&self.parts.after)].concat();
        if all.len() < 12 {
            return None;
        }
        let mut sizes: Vec<f64> = all.iter().map(|(mean, _)| mean.abs()).collect();
        sizes.sort_by(f64::total_cmp);
        let usual = sizes[sizes.len() / 2] / 0.6745 + self.fits.rounding + 1e-6;
        let (mean, k) = all.into_iter().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
        let middle = self.fits.samples[k + length / 2].from;
        let matters = mean.abs() * length as f64 * self.fits.step > 0.5 * MATTERS;
        matters.then_some((mean.abs() / usual, (mean, middle)))
    }

    /// The greatest block mean in the pulse or behind it, and when.
    fn greatest(&self, length: usize) -> (f64, f64) {
        let from = self.parts.pulse.start;
        let means = blocks(&self.missed[from..], length).into_iter().enumerate();
        let (k, mean) = means.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).unwrap_or((0, 0.0));
        (mean, self.fits.samples[(from + k * length + length / 2).min(self.missed.len() - 1)].from)
    }

    /// Structure that moves the triggers by less, the root of their mean square, as a share of the exposure, passes.
    fn unseen(&self) -> f64 {
        let Some(walk) = Walk::new(self.missed, self.parts, self.fits.step) else { return 0.0 };
        let missed = Missed::new(self.fits, self.kind);
        let [start, _, _, end] = missed.exposure.curve.times();
        let area = missed.exposure.area();
        let squares = fractions(16).map(|u| {
            let t = missed.exposure.trigger(u).0;
            let spread =
                walk.power * (u * u * (end - t) + (1.0 - u) * (1.0 - u) * (t - start)).max(0.0);
            spread / (least_open(&missed.exposure, t) * area).powi(2)
        });
        (squares.sum::<f64>() / 16.0 * ratio_of(BEYOND, (1.0, walk.blocks as f64))).sqrt()
    }

    /// By how many standard deviations the samples put a trigger elsewhere, the greatest; when, and by which share of the
    /// exposure.
    fn of_triggers(&self, room: f64) -> Option<(f64, f64, f64)> {
        let Walk { power: walk, blocks } = Walk::new(self.missed, self.parts, self.fits.step)?;
        let missed = Missed::around(self.fits, self.kind, room);
        let [start, _, _, end] = missed.exposure.curve.times();
        let (start, end) = (start - room, end + room);
        let area = missed.exposure.area();
        let each = fractions(16).map(|u| {
            let t = missed.exposure.trigger(u).0;
            let off = missed.off(u, t);
            let spread = walk * (u * u * (end - t) + (1.0 - u) * (1.0 - u) * (t - start)).max(0.0);
            let usual =
                (spread.sqrt() + self.fits.rounding * area) / least_open(&missed.exposure, t);
            (off.abs() / usual, t, off / area)
        });
        let each = each.filter(|(_, _, share)| share.abs() > MATTERS);
        let (ratio, t, share) = each.max_by(|a, b| a.0.total_cmp(&b.0))?;
        // The walk's own size is known from the blocks in the dark.
        Some((normal_of(ratio * ratio, (1.0, blocks as f64)), t, share))
    }
}
