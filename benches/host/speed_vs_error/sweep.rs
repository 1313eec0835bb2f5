//! A sweep: what was found at all numbers from one to another, in parts side by side.

use rayon::prelude::*;

/// The numbers that one thread takes at a time.
pub const CHUNK: i64 = 1 << 22;
/// Every so many answers are judged by the double-double oracle too.
pub const SAMPLED: i64 = 1 << 18;

/// What a sweep of one function found, as a line of `docs/internals/every-f32.csv`; the parts of one add up. What a
/// function has no figure for stays empty.
#[derive(Clone, Copy, Default, serde::Serialize)]
pub struct Sweep {
    pub function: &'static str,
    pub curve: &'static str,
    pub kind: &'static str,
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
pub fn in_parts<const N: usize>(first: i64, last: i64, part: impl Fn(i64, i64) -> [Sweep; N] + Sync) -> [Sweep; N] {
    let parts = (0..=(last - first) / CHUNK).into_par_iter().map(|i| first + i * CHUNK);
    let parts = parts.map(|from| part(from, (from + CHUNK - 1).min(last)));
    let both = |a: [Sweep; N], b: [Sweep; N]| std::array::from_fn(|i| a[i].and(b[i]));
    parts.reduce_with(both).expect("a part")
}
