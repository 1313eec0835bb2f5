//! A frame's samples in the pulse and in the dark, and what a kind's curve misses of them; and by how much trigger
//! times move with light that comes beside a curve.

use std::ops::Range;

use crate::bins::Bin;
use crate::curve::{Exposure, fractions};
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
        let [curve, freest] = [kind, Kind::Free].map(|kind| fits.of(kind).solution.signal.curve);
        let room = (0.01 * curve.length()).max(1.5 * fits.step);
        // The ramps that a simple curve leaves out are no dark, by which it could be judged.
        let (start, end) = (curve.start.min(freest.start), curve.end().max(freest.end()));
        let from = fits.samples.partition_point(|bin| bin.to < start - room);
        let to = fits.samples.partition_point(|bin| bin.from <= end + room);
        Self { before: 0..from, pulse: from..to.max(from), after: to.max(from)..fits.samples.len() }
    }
}

/// What a kind's curve misses of each sample; at its corners nothing, since a sample that shows a moment and one that
/// gathers differ there.
pub fn missed(fits: &FrameFits, kind: Kind) -> Vec<f64> {
    let fitted = fits.of(kind);
    let signal = fitted.solution.signal;
    let corners = signal.curve.times();
    let near = |t: f64| corners.iter().any(|corner| (t - corner).abs() < 1.5 * fits.step);
    let each = fits.samples.iter().zip(&fitted.residuals);
    each.map(|(bin, r)| if near(bin.middle()) { 0.0 } else { r / signal.gain }).collect()
}

/// Light that comes beside a curve, added up along the pulse.
pub struct Beside {
    curve: Exposure,
    /// What has come up to each time, in full light by time.
    sums: Vec<(f64, f64)>,
}

impl Beside {
    /// By the mean of it in each bin, as a share of full light.
    pub fn new(curve: Exposure, bins: &[Bin], light: impl Iterator<Item = f64>) -> Self {
        let mut sum = 0.0;
        let more = |(bin, light): (&Bin, f64)| {
            sum += light * bin.width();
            (bin.to, sum)
        };
        Self { curve, sums: bins.iter().zip(light).map(more).collect() }
    }

    /// By how much later the curve has collected `u` with this light: `u` of all of it has to come as well, and what
    /// there is of it up to then has come.
    fn later(&self, u: f64) -> f64 {
        let t = self.curve.trigger(u).0;
        let until = &self.sums[..self.sums.partition_point(|(to, _)| *to <= t)];
        let here = until.last().map_or(0.0, |(_, sum)| *sum);
        (u * self.whole() - here) / least_open(&self.curve, t)
    }

    /// By how much triggers move with it, the root of their mean square, as a share of the exposure.
    pub fn triggers(&self) -> f64 {
        const TRIGGERS: u32 = 16;
        let squares = fractions(TRIGGERS).map(|u| self.later(u).powi(2)).sum::<f64>();
        (squares / f64::from(TRIGGERS)).sqrt() / self.curve.area()
    }

    /// By how much the exposure changes with it, as a share.
    pub fn exposure(&self) -> f64 {
        self.whole() / self.curve.area()
    }

    fn whole(&self) -> f64 {
        self.sums.last().map_or(0.0, |(_, sum)| *sum)
    }
}

/// The openness at a time, not too near to 0.
pub fn least_open(exposure: &Exposure, t: f64) -> f64 {
    exposure.openness(t).max(LEAST_OPENNESS)
}
