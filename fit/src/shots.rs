//! Several shots in a trace: which of them is fitted, and whether they are of one shutter speed.

use crate::trace::{Frame, Refusal};

/// Shots whose exposures scatter by more than this are not of one shutter speed.
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
