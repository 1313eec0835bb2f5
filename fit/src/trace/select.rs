//! Of several columns, the one that holds a pulse of light.

use super::pulse::{Light, pulses};
use super::reading::Samples;
use super::samples::{Trace, range};
use super::told::{Refusal, Warning};

/// What a column may be, the likeliest signal of light last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Holds {
    NoNumbers,
    NoPulse,
    /// A pulse hardly above the noise, or on both sides of the dark, as cross-talk of another column is.
    Faint,
    /// High or low and nothing in between: a trigger, a flash contact's or a shutter's drive.
    Gate,
    Light,
}

/// With a noise of more than this share of the light, the ramps of a pulse may be noise.
const FAINT: f64 = 1.0 / 30.0;

fn holds(samples: &Result<Samples, Refusal>) -> Holds {
    let Ok(samples) = samples else { return Holds::NoNumbers };
    let Ok(found) = pulses(&samples.trace, Light::Auto) else { return Holds::NoPulse };
    let noise = found.relative_noise();
    let is_odd = found.bent;
    match has_ramps(&samples.trace, noise) {
        _ if is_odd => Holds::Faint,
        true => Holds::Light,
        false if noise > FAINT => Holds::Faint,
        false => Holds::Gate,
    }
}

/// Are there more samples between the highest and the lowest than one at each edge, beyond a tenth and the noise?
fn has_ramps(trace: &Trace, noise: f64) -> bool {
    let (low, high) = range(&trace.values);
    let room = 0.1 + 5.0 * noise;
    let is_between = |v: &f64| (room..=1.0 - room).contains(&((v - low) / (high - low)));
    let is_high = |v: &f64| *v > 0.5 * (low + high);
    let edges = trace.values.windows(2).filter(|pair| is_high(&pair[0]) != is_high(&pair[1])).count();
    trace.values.iter().filter(|v| is_between(v)).count() > edges
}

/// The column that holds a pulse of light, by its place, and its samples; of several, the first. The others are told,
/// as `name` has them, with the columns that choose them.
pub fn light_among(
    mut all: Vec<(usize, Result<Samples, Refusal>)>,
    name: impl Fn(usize) -> String,
    time: Option<usize>,
    warnings: &mut Vec<Warning>,
) -> Result<(usize, Samples), Refusal> {
    let held: Vec<Holds> = all.iter().map(|(_, samples)| holds(samples)).collect();
    let best = held.iter().copied().max().unwrap_or(Holds::NoNumbers);
    let taken = held.iter().position(|held| *held == best).unwrap_or(0);
    let is_rival = |k: &usize| *k != taken && held[*k] >= Holds::Faint;
    if let Some(other) = (0..all.len()).find(is_rival) {
        let choice = time.map_or(String::new(), |time| format!("{},", time + 1));
        warnings.push(Warning::SecondSignal {
            taken: name(all[taken].0),
            other: name(all[other].0),
            columns: format!("{choice}{}", all[other].0 + 1),
        });
    }
    let (column, samples) = all.swap_remove(taken);
    samples.map(|samples| (column, samples))
}
