//! Does a curve explain its samples? What it misses is compared with the noise that the dark shows.
//!
//! Means over blocks of neighbours show structure, differences of neighbours the noise alone; the ratio of the two in
//! the pulse is compared with the same ratio in the dark (an F test), so that a noise of any colour and of any size is
//! none. A block in the dark that stands out is structure as well, and so are [`patterns`](crate::patterns) of what
//! shutters do.

use std::ops::Range;

use crate::frame::FrameFits;
use crate::missed::{Parts, missed};
use crate::noise::{blocks, correlation, fast, from_mean, mean_square, normal_of, slow_correlation};
use crate::outcome::Test;
use crate::patterns::{MATTERS, Noise, Pattern, Shape, patterns};
use crate::signal::Kind;

/// So many standard deviations are beyond chance: a normal number is there once in 30 000 times.
const BEYOND: f64 = 4.0;
/// 1/f noise looks like structure: where so many samples of the dark stand for an independent one, on both sides of the
/// pulse, a test has to be so many times further off.
const WANDERS: f64 = 4.0;
const STRICT: f64 = 1.35;
/// Of blocks in the dark, by their own median: that is known less well.
const STANDS_OUT: f64 = 7.0;
/// A test that misses so much of the light has too little power.
pub const UNSEEN: f64 = 0.01;
/// So much of what would be missed is a standard error: nine times in ten it holds a dip of a fifth of the pulse.
const OF_UNSEEN: f64 = 0.3;
/// Real blades are no cubics: by this share of the exposure their triggers are off, on top of all that shows.
const CUBIC: f64 = 5e-5;

/// What a test says.
pub struct Structure {
    /// Its times are in the frame's unit.
    pub test: Test,
    /// So many times as many standard deviations as usual are beyond chance.
    strict: f64,
    /// By how many standard deviations the most telling of the tests may be off.
    beyond: f64,
    /// By how much what is not seen moves the triggers, and the exposure, as shares of the exposure.
    unseen_moves: [f64; 2],
    /// By how much these may be off, though the model explains the trace: it belongs to their errors.
    pub hidden: [f64; 2],
}

pub fn structure(fits: &FrameFits, kind: Kind) -> Structure {
    let light = Light { fits, kind, parts: Parts::new(fits, kind), missed: missed(fits, kind) };
    let parts = &light.parts;
    let tested = Noise::new(fits, kind, parts).is_some();
    let longer = parts.before.len().max(parts.after.len());
    let sides = [&parts.before, &parts.after].into_iter().filter(|it| 3 * it.len() >= longer);
    let wanders = sides.map(|side| slow_correlation(&from_mean(light.of(side))));
    let wander = wanders.fold(f64::INFINITY, f64::min);
    let strict = if wander > WANDERS { STRICT } else { 1.0 };
    let test = Test { explained: true, tested, sigma: 0.0, unseen: 0.0, share: 0.0, at: 0.0 };
    let (unseen_moves, hidden) = ([0.0; 2], [CUBIC; 2]);
    let mut found = Structure { test, strict, beyond: BEYOND, unseen_moves, hidden };
    let mut length = 2;
    while parts.pulse.len() / length >= 6 {
        if let Some(sigma) = light.in_pulse(length) {
            found.take(sigma, BEYOND, light.greatest(length));
        }
        if let Some((ratio, at)) = light.in_dark(length) {
            found.take(ratio * BEYOND / STANDS_OUT, BEYOND, at);
        }
        length *= 2;
    }
    for pattern in patterns(fits, kind, Shape::all()) {
        found.look_at(&pattern);
    }
    let [triggers, exposure] = found.unseen_moves.map(|moves| OF_UNSEEN * moves);
    found.hide(triggers, exposure);
    found
}

impl Structure {
    fn look_at(&mut self, pattern: &Pattern) {
        if pattern.matters() {
            self.take(pattern.sigma, pattern.shape.beyond(), (pattern.share, pattern.at));
        }
        let Pattern { shape, sigma, triggers, exposure, .. } = *pattern;
        // One of many dips is always beyond a standard deviation.
        if sigma > 1.5 && !matches!(shape, Shape::Dip(_)) {
            self.hide(triggers, exposure);
        }
        let (unseen, least) = (self.strict * pattern.unseen(), self.strict * pattern.least);
        self.test.unseen = self.test.unseen.max(unseen);
        if unseen > UNSEEN || self.strict > 1.0 {
            let [of_triggers, of_exposure] = self.unseen_moves;
            self.unseen_moves = [of_triggers.max(least * triggers), of_exposure.max(least * exposure.abs())];
        }
    }

    fn hide(&mut self, triggers: f64, exposure: f64) {
        self.hidden = [self.hidden[0].hypot(triggers), self.hidden[1].hypot(exposure)];
    }

    fn take(&mut self, sigma: f64, beyond: f64, (share, at): (f64, f64)) {
        let sigma = sigma / self.strict;
        self.test.explained &= sigma <= beyond;
        if sigma / beyond > self.test.sigma / self.beyond {
            self.test = Test { sigma, share, at, ..self.test };
            self.beyond = beyond;
        }
    }
}

/// What the tests look at.
struct Light<'a> {
    fits: &'a FrameFits,
    kind: Kind,
    parts: Parts,
    missed: Vec<f64>,
}

impl Light<'_> {
    fn of(&self, part: &Range<usize>) -> &[f64] {
        &self.missed[part.clone()]
    }

    fn dark(&self) -> Vec<f64> {
        [self.of(&self.parts.before), self.of(&self.parts.after)].concat()
    }

    fn in_pulse(&self, length: usize) -> Option<f64> {
        let (pulse, dark) = (self.of(&self.parts.pulse), self.dark());
        let (in_pulse, in_dark) = (blocks(pulse, length), blocks(&dark, length));
        if in_dark.len() < 4 {
            return None;
        }
        // As far as noise does not spread a step's rounding, a whole plateau may be off by it.
        let rounding = self.fits.rounding * self.fits.rounding;
        let slow = (mean_square(&in_pulse) - rounding).max(0.0) / (fast(pulse) + 1e-12);
        let usual = (mean_square(&in_dark) + 1e-12 / length as f64) / (fast(&dark) + 1e-12);
        // Blocks of either sign cancel, but for the root of their number.
        let size = mean_square(&in_pulse).sqrt();
        let amount = size * length as f64 * self.fits.step * (in_pulse.len() as f64).sqrt();
        let alike = correlation(&in_dark);
        let counts = (in_pulse.len() as f64 / alike, in_dark.len() as f64 / alike);
        let matters = amount > MATTERS * self.fits.exposure(self.kind).area();
        matters.then(|| normal_of(slow / usual, counts))
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
}
