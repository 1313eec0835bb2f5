//! A file's bytes to a trace, with what was read and what is doubtful about it.
//!
//! What oscilloscopes, logic analysers and shutter testers write differs in the delimiter, the decimal mark and what
//! stands above the numbers; all of that is read off the file itself.

use std::mem::take;

use super::asked::Options;
use super::bytes::decode;
use super::layout::{Layout, Time, sound, time_of};
use super::numbers::{counted_on, short_of};
use super::reading::{Reading, Recording, Samples, Told};
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
    let time = layout.time.column();
    let changes = time.is_some_and(|time| options.rate.is_none() && lists_changes(&table, time));
    if changes {
        warnings.push(Warning::Changes);
    }
    let is_asked = |t: f64| options.from.is_none_or(|from| t >= from) && options.to.is_none_or(|to| t <= to);
    let mut read = samples(&table, &layout, changes, |rows| {
        rows.retain(|row| is_asked(row.time));
        if changes {
            *rows = staying(rows);
        }
    })?;
    // It was read last.
    let sync = layout.sync.and_then(|_| read.pop()).transpose()?;
    let reading = |signal| Reading { window: [options.from, options.to], ..layout.reading(&table, signal) };
    recording(layout.signals.iter().copied().zip(read).collect(), sync, reading, warnings)
}

/// The samples of each signal, and of the sync, of rows as they are `taken`. Each line is read once, since there may be
/// thousands of columns.
fn samples(
    table: &Table,
    layout: &Layout,
    changes: bool,
    taken: impl Fn(&mut Vec<Sample>),
) -> Result<Vec<Result<Samples, Refusal>>, Refusal> {
    let signals: Vec<usize> = layout.signals.iter().copied().chain(layout.sync).collect();
    let mut columns: Vec<Column> = signals.iter().map(|_| Column::default()).collect();
    let by_rows = matches!(layout.time, Time::Steps { column: None, .. });
    let (mut fields, mut rows) = (Vec::new(), 0);
    let mut last = f64::NEG_INFINITY;
    let mut between: Option<(u64, &str)> = None;
    for (line, row) in table.lines() {
        fields.clear();
        fields.extend(table.form.split(row));
        let is_remark = row.starts_with('#');
        let is_word = row.starts_with(char::is_alphabetic) && table.form.number(fields[0]).is_none();
        let mut is_read = false;
        if !is_remark {
            let mut time = time_of(table, layout.time, rows, &fields);
            if let (Time::Day(..), Ok(time)) = (layout.time, &mut time) {
                *time = counted_on(*time, last);
                last = *time;
            }
            for (signal, column) in signals.iter().zip(&mut columns) {
                let field = fields.get(*signal).copied().unwrap_or_default();
                let value = time.clone().and_then(|time| Ok((time, sound("value", field, table.form.number(field))?)));
                is_read |= value.is_ok();
                match &time {
                    // From here on the level is not known.
                    Ok(time) if changes && value.is_err() && !field.is_empty() => {
                        column.samples.push(Sample { time: *time, value: f64::NAN, line });
                    }
                    _ => (),
                }
                column.add(line, field, value);
            }
        }
        // Where the rows count, what parts them parts recordings; elsewhere other names do.
        match &between {
            Some((line, text)) if is_read => {
                return Err(Refusal::Blocks { line: *line, text: short_of(text) });
            }
            None if rows > 0 && (by_rows && (is_remark || is_word) || table.names_others(row)) => {
                between = Some((line, row));
            }
            _ => (),
        }
        rows += usize::from(!is_remark);
    }
    let read = |(signal, column): (&usize, Column)| {
        column.read(changes, &taken, || layout.reading(table, *signal).to_string())
    };
    Ok(signals.iter().zip(columns).map(read).collect())
}

/// What was read of a column.
#[derive(Default)]
struct Column {
    samples: Vec<Sample>,
    broken: usize,
    /// The first broken row, and what is wrong with it.
    first: Option<(u64, String)>,
    /// Empty fields since the last sample, and the first one's line: at an end of the column they are no broken rows.
    empty: (usize, u64),
}

impl Column {
    /// Takes a row's time and value, or what is wrong with them.
    fn add(&mut self, line: u64, field: &str, row: Result<(f64, f64), String>) {
        match row {
            Ok((time, value)) => {
                if let (count @ 1.., first) = take(&mut self.empty) {
                    self.broken += count;
                    self.first.get_or_insert((first, "the value is missing".into()));
                }
                self.samples.push(Sample { time, value, line });
            }
            Err(_) if field.is_empty() => {
                let is_inside = !self.samples.is_empty();
                self.empty =
                    (self.empty.0 + usize::from(is_inside), if self.empty.0 == 0 { line } else { self.empty.1 });
            }
            Err(reason) => {
                self.broken += 1;
                self.first.get_or_insert((line, reason));
            }
        }
    }

    fn read(
        mut self,
        changes: bool,
        taken: impl Fn(&mut Vec<Sample>),
        reading: impl Fn() -> String,
    ) -> Result<Samples, Refusal> {
        let mut warnings = Vec::new();
        if let Some((line, reason)) = self.first {
            let (count, rows) = (self.broken, self.samples.len() + self.broken);
            if count as f64 > BROKEN * rows as f64 {
                return Err(Refusal::BrokenRows { count, rows, line, reason, reading: reading() });
            }
            warnings.push(Warning::BrokenRows { count, line, reason });
        }
        taken(&mut self.samples);
        let (trace, timing) = ordered(self.samples, changes, &mut warnings);
        Ok(Samples { trace, timing, warnings })
    }
}
