//! Several shots in a trace: which of them are fitted, and how well a kind that is fitted to one meets the others, which it
//! has not seen.

use crate::bins::Bin;
use crate::curve::fractions;
use crate::frame::FrameFits;
use crate::missed::Beside;
use crate::signal::Kind;
use crate::trace::{Frame, Refusal};

/// Fewer shots tell too little of their scatter.
const FEWEST: usize = 3;
/// The most shots that are fitted.
const MOST: usize = 7;
/// Shots whose exposures scatter by more than this are not of one shutter speed, and tell nothing of its model.
const ALIKE: f64 = 0.01;
/// Nor is that the noise, where it is so many times what the noise makes of them.
const BEYOND_NOISE: f64 = 4.0;

/// By how much the exposures scatter, as a share of their mean, where that is more than one shutter speed and the noise explain.
pub fn differ(frames: &[Frame], scatter: f64, noise: f64) -> bool {
    let samples = frames.iter().map(|frame| frame.samples.len()).min().unwrap_or(1) as f64;
    // A fifth of the samples at least are the pulse's; each adds its noise.
    let usual = noise * 2.0 * (5.0 / samples).sqrt();
    frames.len() > 1 && scatter > ALIKE.max(BEYOND_NOISE * usual)
}

/// The place of the frame that is asked for by its number, from 1; without one, of the frame of median exposure.
pub fn asked(frames: &[Frame], number: Option<usize>) -> Result<usize, Refusal> {
    match number {
        Some(number) if (1..=frames.len()).contains(&number) => Ok(number - 1),
        Some(number) => Err(Refusal::NoFrame { number, frames: frames.len() }),
        None => {
            let mut order: Vec<usize> = (0..frames.len()).collect();
            order.sort_by(|a, b| frames[*a].exposure.total_cmp(&frames[*b].exposure));
            Ok(order[(order.len() - 1) / 2])
        }
    }
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

/// How shots differ from each other, and each kind from shots left out, as shares of the exposure.
pub struct Shots {
    /// So many shots.
    pub count: usize,
    /// By how much the trigger times of two shots differ.
    pub scatter: f64,
    /// By how much a kind's trigger times differ from those of other shots.
    pub errors: [f64; Kind::ALL.len()],
}

impl Shots {
    /// The shots by their frames' fits, if these are enough; the first one's exposure counts.
    pub fn new(frames: &[FrameFits], n: u32) -> Option<Self> {
        if frames.len() < FEWEST {
            return None;
        }
        let exposure = frames[0].exposure(Kind::Free).area() * frames[0].units.pulse();
        // Counted from their mean: when a shot starts says nothing.
        let centred = |fits: &FrameFits, times: Vec<f64>| -> Vec<f64> {
            let mean = times.iter().sum::<f64>() / times.len() as f64;
            times.iter().map(|t| (t - mean) * fits.units.pulse() / exposure).collect()
        };
        let seen: Vec<_> =
            frames.iter().map(|fits| centred(fits, measured_triggers(fits, n))).collect();
        let errors = Kind::ALL.map(|kind| {
            let told: Vec<_> =
                frames.iter().map(|fits| centred(fits, fits.triggers(kind, n))).collect();
            apart(&told, &seen)
        });
        Some(Self { count: frames.len(), scatter: apart(&seen, &seen), errors })
    }
}

/// The trigger times as the samples have them: those of the freest kind, put right by what it misses.
fn measured_triggers(fits: &FrameFits, n: u32) -> Vec<f64> {
    let free = fits.of(Kind::Free);
    let curve = fits.exposure(Kind::Free);
    let [start, _, _, end] = curve.curve.times();
    let is_inside = |bin: &Bin| bin.to > start && bin.from < end;
    let missed = fits.samples.iter().zip(&free.residuals);
    let missed =
        missed.map(|(bin, r)| if is_inside(bin) { r / free.solution.signal.gain } else { 0.0 });
    let beside = Beside::new(curve, &fits.samples, missed);
    fractions(n).map(|u| beside.trigger(u)).map(|(t, later)| t + later).collect()
}

/// The root of the mean square of what the times of one shot differ by from those of each other one.
fn apart(told: &[Vec<f64>], seen: &[Vec<f64>]) -> f64 {
    let (mut squares, mut count) = (0.0, 0.0);
    for (i, told) in told.iter().enumerate() {
        for (_, seen) in seen.iter().enumerate().filter(|(j, _)| *j != i) {
            squares += told.iter().zip(seen).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
            count += told.len() as f64;
        }
    }
    f64::sqrt(squares / f64::max(count, 1.0))
}
