//! Of several columns, the one that holds a pulse of light.

use super::pulse::{Light, pulses};
use super::reading::{Reading, Recording, shown};
use super::samples::{Trace, range};
use super::times::Samples;
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
    match has_ramps(&samples.trace, noise) {
        _ if found.bent => Holds::Faint,
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

/// The recording of the column that holds a pulse of light; of several, the first, and the others are told, with the
/// columns that choose them.
pub fn recording(
    mut all: Vec<(usize, Result<Samples, Refusal>)>,
    sync: Option<Samples>,
    reading: impl Fn(usize) -> Reading,
    mut warnings: Vec<Warning>,
) -> Result<Recording, Refusal> {
    let only = all.len() == 1;
    let held: Vec<Holds> = all.iter().map(|(_, samples)| if only { Holds::Light } else { holds(samples) }).collect();
    let best = held.iter().copied().max().unwrap_or(Holds::NoNumbers);
    let taken = held.iter().position(|held| *held == best).unwrap_or(0);
    if let Some(other) = (0..all.len()).find(|k| *k != taken && held[*k] >= Holds::Faint) {
        let [taken, other] = [taken, other].map(|k| reading(all[k].0));
        let choice = other.time.as_ref().map_or(String::new(), |(time, _)| format!("{time},"));
        warnings.push(Warning::SecondSignal {
            taken: shown(&taken.signal, None),
            other: shown(&other.signal, None),
            columns: format!("{choice}{}", other.signal.0),
        });
    }
    let (column, samples) = all.swap_remove(taken);
    let Samples { trace, timing, warnings: doubts } = samples?;
    warnings.extend(doubts);
    Warning::add(&mut warnings, sync.iter().flat_map(|sync| sync.warnings.clone()));
    let mut reading = reading(column);
    reading.segments = timing.segments.len();
    Ok(Recording { trace, timing, sync: sync.map(|sync| sync.trace), reading, warnings })
}
