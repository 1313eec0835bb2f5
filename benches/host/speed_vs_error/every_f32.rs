//! Every `f32`: the inverse at all of them in [0, 1], and the cdf and the openness at all in a curve's interval, held against
//! a second formulation in doubles. A billion of them take a minute or two a curve.

use std::time::Instant;

use crate::support::cases::CASES;
use crate::support::curves::{Kind, named};
use crate::support::oracle::Curve;
use crate::sweep::Sweep;
use crate::{Result, sweep_t, sweep_u};

/// A sweep as a line of `docs/every-f32.csv`. What a function has no figure for stays empty.
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
pub struct Row {
    pub function: String,
    pub curve: String,
    pub kind: String,
    pub cells: usize,
    pub count: u64,
    pub out_of_range: u64,
    pub steps_back: Option<u64>,
    pub error: f64,
    pub judged: f64,
    pub forward: Option<f64>,
    pub without_floor: Option<f64>,
    pub evaluations: Option<u32>,
    pub seconds: f64,
}

pub const INVERSE: &str = "inverse_cdf";
pub const CDF: &str = "cdf";
pub const OPENING: &str = "opening";

impl Row {
    fn new(function: &str, named: &Named, cells: usize, sweep: Sweep, seconds: f64) -> Self {
        let is = |name| function == name;
        Self {
            function: function.into(),
            curve: named.0.into(),
            kind: named.1.into(),
            cells,
            count: sweep.count,
            out_of_range: sweep.out_of_range,
            // The openness may fall.
            steps_back: (!is(OPENING)).then_some(sweep.steps_back),
            error: sweep.error,
            judged: sweep.judged,
            forward: is(INVERSE).then_some(sweep.forward),
            without_floor: is(CDF).then_some(sweep.without_floor),
            evaluations: is(INVERSE).then_some(sweep.evaluations),
            seconds,
        }
    }
}

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

/// Those with these names: of the reference data, then of the hard cases.
fn curves(names: &[&str]) -> Vec<Named> {
    let kind = |kind| if kind == Kind::Typical { "typical" } else { "hard" };
    let data = named().into_iter().map(|named| (named.name, kind(named.kind), named.curve));
    let cases = CASES.iter().map(|case| (case.name, "hard", case.curve()));
    data.chain(cases).filter(|(name, ..)| names.contains(name)).collect()
}

/// The cdf and the openness on four curves, then the inverse on ten: 8 octaves on every `f32`, and other counts where
/// octaves serve. `found` hears of all rows so far.
pub fn every_f32(found: impl Fn(&[Row]) -> Result) -> Result {
    let mut rows = Vec::new();
    for named in curves(&IN_TIME) {
        let since = Instant::now();
        let [cdf, opening] = sweep_t::sweep(&named.2);
        // Half of the time that both took together.
        let seconds = 0.5 * since.elapsed().as_secs_f64();
        rows.push(Row::new(CDF, &named, 8, cdf, seconds));
        rows.push(Row::new(OPENING, &named, 8, opening, seconds));
        found(&rows)?;
    }
    for cells in [8, 0, 4, 16] {
        for named in curves(&IN_U) {
            let since = Instant::now();
            let sweep = match cells {
                8 => sweep_u::sweep::<8>(&named.2, 0.0),
                0 => sweep_u::sweep::<0>(&named.2, LOWEST_OCTAVE),
                4 => sweep_u::sweep::<4>(&named.2, LOWEST_OCTAVE),
                _ => sweep_u::sweep::<16>(&named.2, LOWEST_OCTAVE),
            };
            rows.push(Row::new(INVERSE, &named, cells, sweep, since.elapsed().as_secs_f64()));
            found(&rows)?;
        }
    }
    Ok(())
}
