//! What a kind's curve misses of the samples, added up along the pulse: by that its trigger times are off.

use super::curve::Exposure;
use super::frame::FrameFits;
use super::signal::Kind;

/// The least openness that a time is divided by: where the shutter hardly lets light in, a time would have no limit.
const LEAST_OPENNESS: f64 = 1e-3;

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
