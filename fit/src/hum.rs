//! The sine that stands out of a signal's residuals.

use crate::bins::Bin;
use crate::signal::{Hum, Signal};

/// The fewest periods in a trace: fewer cannot be told from a drift or from the shutter's own shape.
const FEWEST: f64 = 1.5;
/// The most frequencies that are tried, half a period of the whole trace apart.
const MOST: usize = 600;

/// The sine that explains most of what the signal misses, or none where the trace is too short for any.
pub fn strongest(bins: &[Bin], signal: &Signal) -> Option<Hum> {
    let missed = missed(bins, signal);
    let length = bins.last()?.to - bins.first()?.from;
    let spacing = 0.5 / length;
    // Up to a quarter of the intervals a period, as far as the tries go.
    let most = ((bins.len() as f64 / 4.0 / length / spacing) as usize).min(MOST);
    let first = (FEWEST / length / spacing).ceil() as usize;
    let tries = (first..=most).map(|k| sine(&missed, k as f64 * spacing));
    let (_, best) = tries.max_by(|a, b| a.0.total_cmp(&b.0))?;
    // Between its neighbours, by golden section.
    let (mut low, mut high) = (best.frequency - spacing, best.frequency + spacing);
    for _ in 0..20 {
        let (a, b) = (high - 0.618 * (high - low), low + 0.618 * (high - low));
        if sine(&missed, a).0 > sine(&missed, b).0 { high = b } else { low = a }
    }
    Some(sine(&missed, 0.5 * (low + high)).1)
}

/// What the signal misses of each bin: when, how much, and of how many samples.
fn missed(bins: &[Bin], signal: &Signal) -> Vec<(f64, f64, f64)> {
    let mut moves = vec![0.0; signal.len()];
    let mut means = signal.means();
    let miss = |bin: &Bin| {
        let miss = bin.mean - means.over(bin.from, bin.to, &mut moves);
        (0.5 * (bin.from + bin.to), miss, bin.samples)
    };
    bins.iter().map(miss).collect()
}

/// Is the hum as strong outside the curve as on the whole? `signal` is what was fitted without it.
pub fn is_in_the_dark(bins: &[Bin], signal: &Signal, hum: &Hum) -> bool {
    let (start, end) = (signal.curve.start, signal.curve.end());
    let mut dark = missed(bins, signal);
    dark.retain(|(t, ..)| *t < start || *t > end);
    let (_, alone) = sine(&dark, hum.frequency);
    // The part of it that is in phase.
    let shared = alone.cosine * hum.cosine + alone.sine * hum.sine;
    (0.5..2.0).contains(&(shared / hum.amplitude().powi(2)))
}

/// The best sine of a frequency, and by how much it lowers the sum of squares.
fn sine(missed: &[(f64, f64, f64)], frequency: f64) -> (f64, Hum) {
    let [mut cc, mut cs, mut ss, mut c, mut s] = [0.0; 5];
    for (t, miss, weight) in missed {
        let (sine, cosine) = (std::f64::consts::TAU * frequency * t).sin_cos();
        cc += weight * cosine * cosine;
        cs += weight * cosine * sine;
        ss += weight * sine * sine;
        c += weight * cosine * miss;
        s += weight * sine * miss;
    }
    let determinant = cc * ss - cs * cs;
    let (cosine, sine) = ((c * ss - s * cs) / determinant, (s * cc - c * cs) / determinant);
    let gain = cosine * c + sine * s;
    let gain = if gain.is_finite() { gain } else { 0.0 };
    (gain, Hum { frequency, cosine, sine })
}
