//! A file's bytes to a trace, with what was read and what is doubtful about it.
//!
//! What oscilloscopes, logic analysers and shutter testers write differs in the delimiter, the decimal mark and what stands
//! above the numbers; all of that is read off the file itself.

use super::asked::Options;
use super::bytes::decode;
use super::layout::{Layout, Time};
use super::numbers::{number, short_of, split};
use super::reading::{Recording, Samples, Told, shown};
use super::samples::{Trace, range};
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
    let text = decode(bytes)?;
    let table = Table::new(&text)?;
    let layout = Layout::new(&table, options)?;
    let mut warnings = Vec::new();
    if layout.told == Told::Assumed {
        warnings.push(Warning::UnitAssumed);
    }
    let mut read = samples(&table, &layout)?;
    // It was read last.
    let sync = layout.sync.and_then(|_| read.pop()).transpose()?;
    let (signal, samples) = match <[_; 1]>::try_from(read) {
        Ok([only]) => (layout.signals[0], only?),
        Err(all) => {
            let all = layout.signals.iter().copied().zip(all).collect();
            let time = match layout.time {
                Time::Column(column, _) => Some(column),
                Time::Steps { .. } => None,
            };
            light_among(all, |k| shown(&(k + 1, table.name(k))), time, &mut warnings)?
        }
    };
    warnings.extend(samples.warnings);
    let (trace, sync) = (samples.trace, sync.map(|sync| sync.trace));
    Ok(Recording { trace, sync, reading: layout.reading(&table, signal), warnings })
}

/// The samples of each signal, and of the sync. Each line is read once, since there may be thousands of columns.
fn samples(table: &Table, layout: &Layout) -> Result<Vec<Result<Samples, Refusal>>, Refusal> {
    let signals: Vec<usize> = layout.signals.iter().copied().chain(layout.sync).collect();
    let mut columns: Vec<Column> = signals.iter().map(|_| Column::default()).collect();
    let by_rows = matches!(layout.time, Time::Steps { column: None, .. });
    let (mut fields, mut rows) = (Vec::new(), 0);
    let mut between: Option<(u64, &str)> = None;
    for (line, row) in table.lines() {
        fields.clear();
        fields.extend(split(row, table.delimiter));
        let is_remark = row.starts_with('#');
        let is_word = row.starts_with(char::is_alphabetic)
            && number(fields[0], table.decimal_comma).is_none();
        let mut is_read = false;
        for (signal, column) in signals.iter().zip(&mut columns).filter(|_| !is_remark) {
            match layout.sample(rows, &fields, *signal, table.decimal_comma) {
                Ok((time, value)) => {
                    is_read = true;
                    column.samples.push(Sample { time, value, line });
                }
                Err(reason) => {
                    column.broken += 1;
                    column.first.get_or_insert((line, reason));
                }
            }
        }
        // Where the rows count, what parts them parts recordings.
        match &between {
            Some((line, text)) if is_read => {
                return Err(Refusal::Blocks { line: *line, text: short_of(text) });
            }
            None if by_rows && rows > 0 && (is_remark || is_word) => between = Some((line, row)),
            _ => (),
        }
        rows += usize::from(!is_remark);
    }
    let read = |(signal, column): (&usize, Column)| {
        column.read(|| layout.reading(table, *signal).to_string())
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
}

impl Column {
    fn read(mut self, reading: impl Fn() -> String) -> Result<Samples, Refusal> {
        let mut warnings = Vec::new();
        if let Some((line, reason)) = self.first {
            let (count, rows) = (self.broken, self.samples.len() + self.broken);
            if count as f64 > BROKEN * rows as f64 {
                let reading = reading();
                return Err(Refusal::BrokenRows { count, rows, line, reason, reading });
            }
            warnings.push(Warning::BrokenRows { count, line, reason });
        }
        limit(&mut self.samples, &mut warnings);
        Ok(Samples { trace: ordered(self.samples, &mut warnings), warnings })
    }
}

struct Sample {
    time: f64,
    value: f64,
    line: u64,
}

/// Puts the greatest or the least finite value in the place of what was too large for the instrument.
fn limit(samples: &mut [Sample], warnings: &mut Vec<Warning>) {
    let finite = samples.iter().map(|sample| sample.value).filter(|value| value.is_finite());
    let (low, high) = range(finite);
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
