//! A file's bytes to a trace, with what was read and what is doubtful about it.
//!
//! What oscilloscopes, logic analysers and shutter testers write differs in the delimiter, the decimal mark and what stands
//! above the numbers; all of that is read off the file itself.

use super::asked::Options;
use super::bytes::decode;
use super::layout::{Layout, Time};
use super::numbers::split;
use super::reading::{Recording, Samples, Told, shown};
use super::samples::Trace;
use super::select::light_among;
use super::table::Table;
use super::told::{Refusal, Warning};
use super::wav;

/// The share of the rows that may be broken.
const BROKEN: f64 = 0.2;

/// The trace in a file's bytes: a table as text, or WAV.
///
/// # Errors
/// What is no table of numbers, a column that is not there, too many broken rows.
pub fn open(bytes: &[u8], options: &Options) -> Result<Recording, Refusal> {
    if wav::is_wav(bytes) {
        return wav::open(bytes, options);
    }
    recording(&decode(bytes)?, options)
}

/// The trace in a file's text, and what is doubtful about it.
///
/// # Errors
/// What is no table of numbers, a column that is not there, too many broken rows.
pub fn read(text: &str, options: &Options) -> Result<(Trace, Vec<Warning>), Refusal> {
    recording(text, options).map(|recording| (recording.trace, recording.warnings))
}

fn recording(text: &str, options: &Options) -> Result<Recording, Refusal> {
    let table = Table::new(text)?;
    let layout = Layout::new(&table, options)?;
    let mut warnings = Vec::new();
    if layout.told == Told::Assumed {
        warnings.push(Warning::UnitAssumed);
    }
    let first = samples(&table, &layout, layout.signal);
    let (signal, samples) = if layout.others.is_empty() {
        (layout.signal, first?)
    } else {
        let others = layout.others.iter().map(|k| (*k, samples(&table, &layout, *k)));
        let all = [(layout.signal, first)].into_iter().chain(others).collect();
        let time = match layout.time {
            Time::Column(column, _) => Some(column),
            Time::Steps { .. } => None,
        };
        light_among(all, |k| shown(&(k + 1, table.name(k))), time, &mut warnings)?
    };
    warnings.extend(samples.warnings);
    Ok(Recording { trace: samples.trace, reading: layout.reading(&table, signal), warnings })
}

fn samples(table: &Table, layout: &Layout, signal: usize) -> Result<Samples, Refusal> {
    let (mut samples, mut fields, mut warnings) = (Vec::new(), Vec::new(), Vec::new());
    let (mut broken, mut first) = (0, None);
    for (k, (line, row)) in table.rows().enumerate() {
        fields.clear();
        fields.extend(split(row, table.delimiter));
        match layout.sample(k, &fields, signal, table.decimal_comma) {
            Ok((time, value)) => samples.push(Sample { time, value, line }),
            Err(reason) => {
                broken += 1;
                first.get_or_insert((line, reason));
            }
        }
    }
    if let Some((line, reason)) = first {
        let rows = samples.len() + broken;
        if broken as f64 > BROKEN * rows as f64 {
            return Err(Refusal::BrokenRows { count: broken, rows, line, reason });
        }
        warnings.push(Warning::BrokenRows { count: broken, line, reason });
    }
    limit(&mut samples, &mut warnings);
    Ok(Samples { trace: ordered(samples, &mut warnings), warnings })
}

struct Sample {
    time: f64,
    value: f64,
    line: u64,
}

/// Puts the greatest or the least finite value in the place of what was too large for the instrument.
fn limit(samples: &mut [Sample], warnings: &mut Vec<Warning>) {
    let finite = || samples.iter().map(|sample| sample.value).filter(|value| value.is_finite());
    let ends = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) = finite().fold(ends, |(low, high), v| (low.min(v), high.max(v)));
    let (low, high) = if low <= high { (low, high) } else { (0.0, 0.0) };
    let mut beyond = samples.iter_mut().filter(|sample| sample.value.is_infinite()).peekable();
    let Some(line) = beyond.peek().map(|sample| sample.line) else { return };
    let mut count = 0;
    for sample in beyond {
        sample.value = if sample.value > 0.0 { high } else { low };
        count += 1;
    }
    warnings.push(Warning::Overload { count, line });
}

/// In order, those of the same time averaged.
fn ordered(mut rows: Vec<Sample>, warnings: &mut Vec<Warning>) -> Trace {
    if let Some(pair) = rows.windows(2).find(|pair| pair[1].time < pair[0].time) {
        warnings.push(Warning::Unsorted { line: pair[1].line });
        rows.sort_by(|a, b| a.time.total_cmp(&b.time));
    }
    let mut trace = Trace::default();
    let (mut same, mut again) = (1.0, None);
    let mut duplicates = 0;
    for row in rows {
        match trace.values.last_mut() {
            Some(value) if trace.times.last() == Some(&row.time) => {
                same += 1.0;
                *value += (row.value - *value) / same;
                duplicates += 1;
                again.get_or_insert(row.line);
            }
            _ => {
                same = 1.0;
                trace.times.push(row.time);
                trace.values.push(row.value);
            }
        }
    }
    if let Some(line) = again {
        warnings.push(Warning::Duplicates { count: duplicates, line });
    }
    trace
}
