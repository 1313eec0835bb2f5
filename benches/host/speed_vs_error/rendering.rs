//! What the crate is for: a bright bar that moves while the shutter is open, exposed in pulses of light.

use shutter_curve::ShutterCurve;

use crate::support::curves::Rng;
use crate::support::oracle::{Curve, Dd, Exact};

pub const PIXELS: usize = 660;
/// Where the bar's rear edge starts and ends, and its width, in widths of the picture.
const FROM: f64 = 0.05;
const TO: f64 = 0.75;
const WIDTH: f64 = 0.2;

/// How pulses are placed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pulses {
    /// This crate's triggers: equal shares of the exposure, equal pulses.
    Triggers,
    /// Equally spaced, each as bright as the shutter is open.
    Weighted,
    /// Equal pulses at random, as the shutter curve has it.
    Random,
}

pub const PULSES: [Pulses; 3] = [Pulses::Triggers, Pulses::Weighted, Pulses::Random];

/// The brightness of each pixel's middle, 1 for a thing that stands still.
pub struct Picture {
    exact: Vec<f64>,
    windows: Vec<[f64; 2]>,
    curve: Curve,
    ours: ShutterCurve,
}

impl Picture {
    pub fn new(curve: &Curve) -> Self {
        let oracle = Exact::new(curve);
        let (start, end) = (f64::from(curve.open_start()), f64::from(curve.close_end()));
        // The bar covers x from when its front arrives until its rear leaves.
        let when = |x: f64| start + (end - start) * ((x - FROM) / (TO - FROM)).clamp(0.0, 1.0);
        let windows: Vec<_> = (0..PIXELS)
            .map(|i| (i as f64 + 0.5) / PIXELS as f64)
            .map(|x| [when(x - WIDTH), when(x)])
            .collect();
        let exact = windows
            .iter()
            .map(|window| window.map(|t| oracle.cdf(Dd::from(t))))
            .map(|[from, to]| (to - from).hi)
            .collect();
        Self { exact, windows, curve: *curve, ours: crate::support::cases::shutter(curve) }
    }

    /// The exact integral over the exposure.
    pub fn exact(&self) -> &[f64] {
        &self.exact
    }

    /// The same by `n` pulses.
    pub fn exposed(&self, pulses: Pulses, n: u32, seed: u64) -> Vec<f64> {
        let (start, end) = (self.curve.open_start(), self.curve.close_end());
        let mut rng = Rng::new(seed, u64::from(n));
        // Time and brightness of each.
        let mut flashes: Vec<(f32, f32)> = match pulses {
            Pulses::Triggers => (0..n)
                .map(|i| (self.ours.inverse_cdf((2 * i + 1) as f32 / (2 * n) as f32), 1.0))
                .collect(),
            Pulses::Random => {
                (0..n).map(|_| (self.ours.inverse_cdf(rng.unit() as f32), 1.0)).collect()
            }
            Pulses::Weighted => (0..n)
                .map(|i| start + (end - start) * ((i as f32 + 0.5) / n as f32))
                .map(|t| (t, self.ours.openness(t)))
                .collect(),
        };
        flashes.sort_by(|a, b| a.0.total_cmp(&b.0));
        // The light up to each flash.
        let mut light = vec![0.0];
        for (_, brightness) in &flashes {
            light.push(light[light.len() - 1] + f64::from(*brightness));
        }
        let all = light[light.len() - 1];
        let before = |t: f64| light[flashes.partition_point(|flash| f64::from(flash.0) < t)];
        self.windows.iter().map(|[from, to]| (before(*to) - before(*from)) / all).collect()
    }

    /// The greatest error over the pixels.
    pub fn error(&self, exposed: &[f64]) -> f64 {
        let errors = self.exact.iter().zip(exposed).map(|(exact, got)| (got - exact).abs());
        errors.fold(0.0, f64::max)
    }
}
