//! Every `f32`: the inverse at all of them in [0, 1], and the cdf and the openness at all in a curve's interval, held
//! against a second formulation in doubles. A billion of them take a minute or two a curve.

use std::time::Instant;

use crate::support::cases::{CASES, DIM};
use crate::support::curves::{Kind, named};
use crate::support::oracle::Curve;
use crate::sweep::Sweep;
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
    "handles cross by 15/16",
    DIM,
    "a vertical step",
    "ramps of 1e-6 beside a plateau of 1",
    "times from -1 to 1",
];
/// For the cdf and the openness; the last is of the class on which it stepped back.
const IN_TIME: [&str; 4] = ["rman_soft", "handles cross by 15/16", DIM, "a join before time 0"];

/// Those with these names: of the reference data, then of the hard cases.
fn curves(names: &[&str]) -> Vec<Named> {
    let kind = |kind| if kind == Kind::Typical { "typical" } else { "hard" };
    let data = named().into_iter().map(|named| (named.name, kind(named.kind), named.curve));
    let cases = CASES.iter().map(|case| (case.name, "hard", case.curve()));
    data.chain(cases).filter(|(name, ..)| names.contains(name)).collect()
}

/// The inverse on ten curves, then the cdf and the openness on four. `found` hears of all sweeps so far.
pub fn every_f32(found: impl Fn(&[Sweep]) -> Result) -> Result {
    let mut all = Vec::new();
    for (curve, kind, points) in curves(&IN_U) {
        let since = Instant::now();
        let sweep = sweep_u::sweep(&points);
        all.push(Sweep { curve, kind, seconds: since.elapsed().as_secs_f64(), ..sweep });
        found(&all)?;
    }
    for (curve, kind, points) in curves(&IN_TIME) {
        let since = Instant::now();
        let both = sweep_t::sweep(&points);
        // Half of the time that both took together.
        let seconds = 0.5 * since.elapsed().as_secs_f64();
        all.extend(both.map(|sweep| Sweep { curve, kind, seconds, ..sweep }));
        found(&all)?;
    }
    Ok(())
}
