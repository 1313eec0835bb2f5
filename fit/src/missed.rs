//! A frame's samples in the pulse and in the dark, and what a kind's curve misses of them; added up along the pulse, its trigger times
//! are off by that.

use std::ops::Range;

use crate::curve::Exposure;
use crate::frame::FrameFits;
use crate::signal::Kind;

/// The least openness that a time is divided by: where the shutter hardly lets light in, a time would have no limit.
const LEAST_OPENNESS: f64 = 1e-3;

/// A frame's samples apart: those in the pulse, and those in the dark before and after it.
pub struct Parts {
    pub before: Range<usize>,
    pub pulse: Range<usize>,
    pub after: Range<usize>,
}

impl Parts {
    pub fn new(fits: &FrameFits, kind: Kind) -> Self {
        let curve = fits.of(kind).solution.signal.curve;
        let room = (0.01 * curve.length()).max(1.5 * fits.step);
        let from = fits.samples.partition_point(|bin| bin.to < curve.start - room);
        let to = fits.samples.partition_point(|bin| bin.from <= curve.end() + room);
        Self { before: 0..from, pulse: from..to.max(from), after: to.max(from)..fits.samples.len() }
    }
}

/// What a kind's curve misses of each sample; at its corners nothing, since a sample that shows a moment and one that gathers
/// differ there.
pub fn missed(fits: &FrameFits, kind: Kind) -> Vec<f64> {
    let fitted = fits.of(kind);
    let signal = fitted.solution.signal;
    let corners = signal.curve.times();
    let near = |t: f64| corners.iter().any(|corner| (t - corner).abs() < 1.5 * fits.step);
    let each = fits.samples.iter().zip(&fitted.residuals);
    each.map(|(bin, r)| if near(0.5 * (bin.from + bin.to)) { 0.0 } else { r / signal.gain })
        .collect()
}

/// The light that a kind's curve misses.
pub struct Missed {
    pub exposure: Exposure,
    gain: f64,
    /// Up to each time, in the signal's unit by the time's.
    sums: Vec<(f64, f64)>,
}

impl Missed {
    pub fn new(fits: &FrameFits, kind: Kind) -> Self {
        Self::around(fits, kind, 0.0)
    }

    /// With what is missed so long before and after the curve.
    pub fn around(fits: &FrameFits, kind: Kind, room: f64) -> Self {
        let fitted = fits.of(kind);
        let signal = fitted.solution.signal;
        let [start, _, _, end] = signal.curve.times();
        let inside = fits.samples.iter().zip(&fitted.residuals);
        let inside = inside.filter(|(bin, _)| bin.to > start - room && bin.from < end + room);
        let mut sum = 0.0;
        let sums = inside
            .map(|(bin, residual)| {
                sum += residual * (bin.to - bin.from);
                (bin.to, sum)
            })
            .collect();
        Self { exposure: Exposure::new(&signal.curve), gain: signal.gain, sums }
    }

    /// The openness times the light at a time, not too near to 0.
    pub fn slope(&self, t: f64) -> f64 {
        least_open(&self.exposure, t) * self.gain
    }

    /// By how much later than the curve, which says `t`, the samples put the time at which `u` is collected: `u` of all that is
    /// missed has to come as well, and what is missed up to `t` has come.
    pub fn off(&self, u: f64, t: f64) -> f64 {
        let until = &self.sums[..self.sums.partition_point(|(to, _)| *to <= t)];
        let here = until.last().map_or(0.0, |(_, sum)| *sum);
        let whole = self.sums.last().map_or(0.0, |(_, sum)| *sum);
        (u * whole - here) / self.slope(t)
    }
}

/// The openness at a time, not too near to 0.
pub fn least_open(exposure: &Exposure, t: f64) -> f64 {
    exposure.openness(t).max(LEAST_OPENNESS)
}
