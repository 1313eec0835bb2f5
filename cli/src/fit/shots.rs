//! Several shots in a trace: how well a kind that is fitted to one meets the others, which it has not seen.

use super::frame::FrameFit;
use super::signal::Kind;
use crate::trace::Frame;

/// Fewer shots tell too little of their scatter.
pub const FEWEST: usize = 3;
/// A kind is good enough where its error on shots left out is at most so many times the shots' own scatter.
pub const WITHIN: f64 = 1.1;
/// The most shots that are fitted.
const MOST: usize = 7;

/// The kinds' errors on shots left out.
pub struct Shots {
    /// So many shots.
    pub count: usize,
    /// By how much the trigger times of two shots differ, as a share of the exposure.
    pub scatter: f64,
    /// By how much a kind's trigger times differ from those of other shots.
    pub errors: [f64; 4],
}

/// Which frames to fit beside `fitted`: those whose exposures are nearest to its.
pub fn others(frames: &[Frame], fitted: usize) -> Vec<usize> {
    if frames.len() < FEWEST {
        return Vec::new();
    }
    let far = |k: &usize| (frames[*k].exposure - frames[fitted].exposure).abs();
    let mut order: Vec<usize> = (0..frames.len()).filter(|k| *k != fitted).collect();
    order.sort_by(|a, b| far(a).total_cmp(&far(b)));
    order.truncate(MOST - 1);
    order
}

impl Shots {
    pub fn new(fits: &[FrameFit], n: u32) -> Self {
        let exposure = fits[0].area(Kind::Free) * fits[0].units.pulse();
        // Counted from their mean: when a shot starts says nothing.
        let centred = |fit: &FrameFit, times: Vec<f64>| -> Vec<f64> {
            let mean = times.iter().sum::<f64>() / times.len() as f64;
            times.iter().map(|t| (t - mean) * fit.units.pulse() / exposure).collect()
        };
        let seen: Vec<Vec<f64>> =
            fits.iter().map(|fit| centred(fit, fit.measured_triggers(n))).collect();
        let rms = |pairs: &mut dyn Iterator<Item = (&Vec<f64>, &Vec<f64>)>| {
            let (mut squares, mut count) = (0.0, 0.0);
            for (a, b) in pairs {
                squares += a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
                count += a.len() as f64;
            }
            f64::sqrt(squares / f64::max(count, 1.0))
        };
        let pairs = || {
            let k = seen.len();
            (0..k).flat_map(move |i| (0..k).filter(move |j| *j != i).map(move |j| (i, j)))
        };
        let scatter = rms(&mut pairs().map(|(i, j)| (&seen[i], &seen[j])));
        let errors = Kind::ALL.map(|kind| {
            let told: Vec<Vec<f64>> =
                fits.iter().map(|fit| centred(fit, fit.triggers(kind, n))).collect();
            rms(&mut pairs().map(|(i, j)| (&told[i], &seen[j])))
        });
        Self { count: fits.len(), scatter, errors }
    }
}
