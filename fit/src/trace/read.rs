//! A file's bytes to a trace, with what was read and what is doubtful about it.
//!
//! What oscilloscopes, logic analysers and shutter testers write differs in the delimiter, the decimal mark and what
//! stands above the numbers; all of that is read off the file itself.

use super::asked::Options;
use super::bytes::decode;
use super::layout::{Layout, sound};
use super::numbers::Cell;
use super::reading::{Recording, Told};
use super::select::recording;
use super::table::Table;
use super::times::{Sample, lists_changes, ordered, staying};
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
    let text = decode(bytes)?;
    let table = Table::new(&text)?;
    let layout = Layout::new(&table, options)?;
    let mut warnings = Vec::new();
    if layout.told == Told::Assumed {
        warnings.push(Warning::UnitAssumed);
    }
    let changes = options.rate.is_none() && layout.time.is_some_and(|time| lists_changes(&table, time));
    if changes {
        warnings.push(Warning::Changes);
    }
    table.is_one(layout.time.is_none())?;
    let read = |k: usize| {
        let reading = || layout.reading(&table.heads, k, options).to_string();
        let (mut samples, warning) = column(&table, &layout, k, changes, reading)?;
        samples.retain(|row| options.counts(row.time));
        let samples = if changes { staying(&samples) } else { samples };
        Ok(ordered(samples, changes, warning.into_iter().collect()))
    };
    let all = layout.signals.iter().map(|k| (*k, read(*k))).collect();
    let sync = layout.sync.map(read).transpose()?;
    recording(all, sync, |signal| layout.reading(&table.heads, signal, options), warnings)
}

/// A column's samples, and which rows were left out; of changes, those from which on the level is not known are NaN.
fn column(
    table: &Table,
    layout: &Layout,
    k: usize,
    changes: bool,
    reading: impl Fn() -> String,
) -> Result<(Vec<Sample>, Option<Warning>), Refusal> {
    let (mut samples, mut broken) = (Vec::new(), Vec::new());
    for (row, line) in table.rows.iter().enumerate() {
        let (time, value) = (layout.time_of(table, row, line), sound(table, line, k, "value"));
        match (time, value) {
            // Nothing was recorded then.
            (Ok(_), Err(_)) if line.cell(k) == Cell::Empty => (),
            (Ok(time), Ok(value)) => samples.push(Sample { time, value, line: line.number }),
            (time, value) => {
                let unknown = time.as_ref().ok().filter(|_| changes);
                samples.extend(unknown.map(|time| Sample { time: *time, value: f64::NAN, line: line.number }));
                broken.push((line.number, time.and(value).err().unwrap_or_default()));
            }
        }
    }
    let count = broken.len();
    let Some((line, reason)) = broken.into_iter().next() else { return Ok((samples, None)) };
    let rows = samples.len() + count;
    if count as f64 > BROKEN * rows as f64 {
        return Err(Refusal::BrokenRows { count, rows, line, reason, reading: reading() });
    }
    Ok((samples, Some(Warning::BrokenRows { count, line, reason })))
}

/// The names of the columns in a file's bytes, as far as they have some; none of a WAV's channels.
///
/// # Errors
/// What is no table of numbers.
pub fn columns(bytes: &[u8]) -> Result<Vec<Option<String>>, Refusal> {
    if wav::is_wav(bytes) {
        return Ok(Vec::new());
    }
    let text = decode(bytes)?;
    let heads = Table::new(&text)?.heads;
    Ok((0..heads.width).map(|k| heads.name(k)).collect())
}
