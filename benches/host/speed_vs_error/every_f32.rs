//! Every `f32`: the inverse at all of them in [0, 1], and the cdf and the openness at all in a curve's interval, held against
//! a second formulation in doubles. A billion of them take a minute or two a curve.

use std::time::Instant;

use rayon::prelude::*;

use crate::support::cases::CASES;
use crate::support::curves::{Kind, named};
use crate::support::oracle::Curve;
use crate::{Result, sweep_t, sweep_u};

/// A curve with its name and its kind.
type Named = (&'static str, &'static str, Curve);

/// For the inverse.
const IN_U: [&str; 10] = [
    "rman_soft",
    "triangle",
    "fast_open_slow_close",
    "pedestal_.2",
    "ends of order p^6",
    "time stands still inside",
    "openness touches 0 inside",
    "a vertical step",
    "ramps of 1e-6 beside a plateau of 1",
    "times from -1 to 1",
];
/// For the cdf and the openness; the opening ramp of the last runs across time 0.
const IN_TIME: [&str; 4] =
    ["rman_soft", "time stands still inside", "openness touches 0 inside", "cross_zero"];

/// Below this, no octave serves, whatever their number.
const LOWEST_OCTAVE: f32 = 1.0 / (1 << 20) as f32;

/// The numbers that one thread takes at a time.
pub const CHUNK: i64 = 1 << 22;
/// Every so many answers are judged by the double-double oracle too.
pub const SAMPLED: i64 = 1 << 18;

/// Those with these names: of the reference data, then of the hard cases.
fn curves(names: &[&str]) -> Vec<Named> {
    let kind = |kind| if kind == Kind::Typical { "typical" } else { "hard" };
    let data = named().into_iter().map(|named| (named.name, kind(named.kind), named.curve));
    let cases = CASES.iter().map(|case| (case.name, "hard", case.curve()));
    data.chain(cases).filter(|(name, ..)| names.contains(name)).collect()
}

/// The cdf and the openness on four curves, then the inverse on ten: 8 octaves on every `f32`, and other counts where
/// octaves serve. `found` hears of all sweeps so far.
pub fn every_f32(found: impl Fn(&[Sweep]) -> Result) -> Result {
    let mut all = Vec::new();
    for (curve, kind, points) in curves(&IN_TIME) {
        let since = Instant::now();
        let both = sweep_t::sweep(&points);
        // Half of the time that both took together.
        let seconds = 0.5 * since.elapsed().as_secs_f64();
        all.extend(both.map(|sweep| Sweep { curve, kind, seconds, ..sweep }));
        found(&all)?;
    }
    let sweeps: [fn(&Curve) -> Sweep; 4] = [
        |curve| sweep_u::sweep::<8>(curve, 0.0),
        |curve| sweep_u::sweep::<0>(curve, LOWEST_OCTAVE),
        |curve| sweep_u::sweep::<4>(curve, LOWEST_OCTAVE),
        |curve| sweep_u::sweep::<16>(curve, LOWEST_OCTAVE),
    ];
    for sweep in sweeps {
        for (curve, kind, points) in curves(&IN_U) {
            let since = Instant::now();
            let sweep = sweep(&points);
            all.push(Sweep { curve, kind, seconds: since.elapsed().as_secs_f64(), ..sweep });
            found(&all)?;
        }
    }
    Ok(())
}

/// What a sweep of one function found, as a line of `docs/every-f32.csv`; the parts of one add up. What a function has no figure
/// for stays empty.
#[derive(Clone, Copy, Default, serde::Serialize)]
pub struct Sweep {
    pub function: &'static str,
    pub curve: &'static str,
    pub kind: &'static str,
    pub cells: usize,
    pub count: u64,
    pub out_of_range: u64,
    /// Not of the openness, which may fall.
    pub steps_back: Option<u64>,
    /// The greatest error of the kind that is promised: of the inverse in ulp(u) once half an ulp(t) is forgiven, of a
    /// value in its own ulp at some time within an ulp(t).
    pub error: f64,
    /// The same by the oracle, where the greatest of each part were found and on samples.
    pub judged: f64,
    /// Of the inverse: the greatest |t - exact| in ulp(t).
    pub forward: Option<f64>,
    /// Of the cdf: the error in ulp of however small a value.
    pub without_floor: Option<f64>,
    pub evaluations: Option<u32>,
    pub seconds: f64,
}

impl Sweep {
    fn and(self, other: Self) -> Self {
        let most = |a: Option<f64>, b: Option<f64>| a.zip(b).map(|(a, b)| a.max(b));
        Self {
            count: self.count + other.count,
            out_of_range: self.out_of_range + other.out_of_range,
            steps_back: self.steps_back.zip(other.steps_back).map(|(a, b)| a + b),
            error: self.error.max(other.error),
            judged: self.judged.max(other.judged),
            forward: most(self.forward, other.forward),
            without_floor: most(self.without_floor, other.without_floor),
            evaluations: self.evaluations.max(other.evaluations),
            ..self
        }
    }

    /// Takes in what the oracle says of one answer.
    pub fn judge(&mut self, error: f64) {
        self.judged = self.judged.max(error);
    }
}

/// Sweeps the numbers from `first` to `last` in parts, side by side; each sweeps so many functions at once.
pub fn in_parts<const N: usize>(
    first: i64,
    last: i64,
    part: impl Fn(i64, i64) -> [Sweep; N] + Sync,
) -> [Sweep; N] {
    let parts = (0..=(last - first) / CHUNK).into_par_iter().map(|i| first + i * CHUNK);
    let parts = parts.map(|from| part(from, (from + CHUNK - 1).min(last)));
    let both = |a: [Sweep; N], b: [Sweep; N]| std::array::from_fn(|i| a[i].and(b[i]));
    parts.reduce_with(both).expect("a part")
}
