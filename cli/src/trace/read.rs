//! The text of a trace's file: which bytes, which columns, which unit, which rows.
//!
//! What oscilloscopes, logic analysers and shutter testers write differs in the delimiter, the decimal mark and what stands
//! above the numbers; all of that is read off the file itself.

use std::iter::once;

use super::samples::{LARGEST, Trace};
use super::told::{Refusal, Warning};
use crate::unit::Unit;

/// A longer line is no row of samples.
const LONGEST_LINE: usize = 1 << 16;
/// So many lines tell the delimiter.
const LOOKED_AT: usize = 60;
/// What stands above the numbers is shorter than this, in lines.
const LONGEST_HEADER: usize = 500;
/// The share of the rows that may be broken.
const BROKEN: f64 = 0.2;

/// A column of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Column {
    /// By its place, from 1.
    Number(usize),
    /// By its name in the header, or a part of that.
    Name(String),
}

impl Column {
    /// A column as it is written in an argument.
    pub fn parse(text: &str) -> Self {
        match text.trim().parse() {
            Ok(number) => Self::Number(number),
            Err(_) => Self::Name(text.trim().into()),
        }
    }
}

/// What the file does not say itself, or not rightly.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Of the times; the header's, or seconds, without.
    pub unit: Option<Unit>,
    /// The time's and the signal's column, or the signal's alone.
    pub columns: Vec<Column>,
    /// The samples in a second, where the file holds no times.
    pub rate: Option<f64>,
}

/// The text of a file's bytes: UTF-8, UTF-16 with its mark, or a single-byte encoding whose letters do not matter.
///
/// # Errors
/// What is empty or binary.
pub fn decode(bytes: &[u8]) -> Result<String, Refusal> {
    let no_csv = |reason: &str| Err(Refusal::NotCsv { reason: reason.into() });
    let wide = |pair: fn([u8; 2]) -> u16| -> String {
        let units = bytes[2..].chunks_exact(2).map(|unit| pair([unit[0], unit[1]]));
        char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
    };
    let text = match bytes {
        [0xff, 0xfe, ..] => wide(u16::from_le_bytes),
        [0xfe, 0xff, ..] => wide(u16::from_be_bytes),
        _ => String::from_utf8_lossy(bytes).into_owned(),
    };
    let text = match text.strip_prefix('\u{feff}') {
        Some(rest) => rest.into(),
        None => text,
    };
    if text.trim().is_empty() {
        return no_csv("it is empty");
    }
    if text.contains('\0') {
        return no_csv("it holds bytes of 0, so it is binary");
    }
    Ok(text)
}

/// The trace in a file's text, and what is doubtful about it.
///
/// # Errors
/// What is no table of numbers, a column that is not there, too many broken rows.
pub fn read(text: &str, options: &Options) -> Result<(Trace, Vec<Warning>), Refusal> {
    let table = Table::new(text)?;
    let layout = Layout::new(&table, options)?;
    let mut warnings = Vec::new();
    if layout.unit_assumed {
        warnings.push(Warning::UnitAssumed);
    }
    let (mut samples, mut fields) = (Vec::new(), Vec::new());
    let (mut broken, mut first) = (0, None);
    for (k, (line, row)) in table.rows().enumerate() {
        fields.clear();
        fields.extend(split(row, table.delimiter));
        match layout.sample(k, &fields, table.decimal_comma) {
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
    Ok((ordered(samples, &mut warnings), warnings))
}

struct Sample {
    time: f64,
    value: f64,
    line: u64,
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

fn filled_lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| !line.trim().is_empty())
}

/// What delimits the fields of most lines, and whether their decimal mark is a comma.
fn marks(text: &str) -> (char, bool) {
    // From the file's middle, where the numbers are.
    let total = filled_lines(text).count();
    let lines: Vec<&str> = filled_lines(text)
        .skip(total / 2)
        .chain(filled_lines(text))
        .take(LOOKED_AT.min(total))
        .collect();
    let most = |c: char| 2 * lines.iter().filter(|l| l.trim().contains(c)).count() > lines.len();
    let delimiter = match ['\t', ';', ',', ' '].into_iter().find(|c| most(*c)).unwrap_or(',') {
        ',' if are_decimals(&lines) => ';',
        delimiter => delimiter,
    };
    let has_decimal = |line: &&str| split(line, delimiter).any(is_decimal);
    (delimiter, delimiter != ',' && lines.iter().any(has_decimal))
}

/// Is each line a value alone with a decimal comma? It looks like two columns, but the first one's few numbers tell.
fn are_decimals(lines: &[&str]) -> bool {
    let mut whole: Vec<_> =
        lines.iter().map(|line| line.trim().split_once(',').map(|(whole, _)| whole)).collect();
    whole.sort();
    whole.dedup();
    whole.len() <= lines.len() / 4 && lines.iter().all(|line| is_decimal(line.trim()))
}

/// Is it a number with a decimal comma?
fn is_decimal(field: &str) -> bool {
    field.contains(',') && !field.contains('.') && number(field, true).is_some()
}

/// The file as rows of fields, those before the numbers apart.
struct Table<'a> {
    text: &'a str,
    delimiter: char,
    decimal_comma: bool,
    /// What stands above the numbers.
    header: Vec<Vec<String>>,
    /// The first row of numbers, and how many rows of the file come before it.
    first: Vec<String>,
    before: usize,
}

impl<'a> Table<'a> {
    fn new(text: &'a str) -> Result<Self, Refusal> {
        for (i, line) in text.lines().enumerate() {
            if line.len() > LONGEST_LINE {
                let reason = format!("line {} is {} bytes long", i + 1, line.len());
                return Err(Refusal::NotCsv { reason });
            }
        }
        let (delimiter, decimal_comma) = marks(text);
        let mut table = Self {
            text,
            delimiter,
            decimal_comma,
            header: Vec::new(),
            first: Vec::new(),
            before: 0,
        };
        for line in filled_lines(text).take(LONGEST_HEADER) {
            let fields: Vec<String> = split(line, delimiter).map(String::from).collect();
            let is_number = |field: &String| number(field, decimal_comma).is_some();
            let filled = || fields.iter().filter(|field| !field.is_empty());
            if !line.starts_with('#') && filled().count() > 0 && filled().all(is_number) {
                table.first = fields;
                return Ok(table);
            }
            table.header.push(fields);
            table.before += 1;
        }
        Err(Refusal::NotCsv { reason: "there is no row of numbers in it".into() })
    }

    /// The rows of numbers, each with its line.
    fn rows(&self) -> impl Iterator<Item = (u64, &'a str)> {
        let lines = (1..).zip(self.text.lines());
        let lines = lines.filter(|(_, line)| !line.trim().is_empty()).skip(self.before);
        lines.filter(|(_, line)| !line.starts_with('#'))
    }

    /// A column by its number, from 0, or by its name.
    fn column(&self, column: &Column) -> Result<usize, Refusal> {
        let columns = self.first.len();
        let names = || self.header.iter().rev();
        let found = match column {
            Column::Number(number) => number.checked_sub(1).filter(|k| *k < columns),
            Column::Name(name) => {
                let wanted = name.to_lowercase();
                let exact = |field: &String| field.to_lowercase() == wanted;
                let part = |field: &String| field.to_lowercase().contains(&wanted);
                names()
                    .find_map(|row| row.iter().position(exact))
                    .or_else(|| names().find_map(|row| row.iter().position(part)))
                    .filter(|k| *k < columns)
            }
        };
        found.ok_or_else(|| {
            let name = match column {
                Column::Number(number) => number.to_string(),
                Column::Name(name) => name.clone(),
            };
            let row = names().find(|row| row.len() > 1 || columns == 1);
            let names = row.map(|row| row.iter().take(columns).cloned().collect::<Vec<_>>());
            let there = match names {
                Some(names) if !names.is_empty() => format!("{columns}: {}", names.join(", ")),
                _ => columns.to_string(),
            };
            Refusal::NoColumn { name, there }
        })
    }

    /// What stands above a column, the lowest first.
    fn above(&self, column: usize) -> impl Iterator<Item = &str> {
        self.header.iter().rev().filter_map(move |row| row.get(column)).map(String::as_str)
    }

    /// A number that the header gives by a name: in the row below it, or after `=` in the same field.
    fn given(&self, name: &str) -> Option<f64> {
        let value = |text: &str| number(text.trim(), self.decimal_comma);
        for (r, row) in self.header.iter().enumerate() {
            for (c, field) in row.iter().enumerate() {
                let field = field.to_lowercase();
                if let Some((left, right)) = field.split_once('=') {
                    if left.trim() == name {
                        return value(right);
                    }
                } else if field == name {
                    return value(self.header.get(r + 1)?.get(c)?);
                }
            }
        }
        None
    }
}

/// Where a row's time and signal are.
struct Layout {
    time: Time,
    signal: usize,
    unit_assumed: bool,
}

enum Time {
    /// A column of times, in this unit.
    Column(usize, Unit),
    /// A column of numbers that count steps of so many seconds from a start; without a column, the rows count.
    Steps { column: Option<usize>, start: f64, step: f64 },
}

impl Layout {
    fn new(table: &Table, options: &Options) -> Result<Self, Refusal> {
        let (time, signal) = columns(table, options)?;
        if let Some(time) = steps(table, options.rate, time) {
            return Ok(Self { time, signal, unit_assumed: false });
        }
        let time = time.ok_or(Refusal::NoTimes)?;
        let unit = options.unit.or_else(|| table.above(time).find_map(unit_in));
        let time = Time::Column(time, unit.unwrap_or(Unit::Second));
        Ok(Self { time, signal, unit_assumed: unit.is_none() })
    }

    /// A row's time in seconds and its signal, or what is wrong with it.
    fn sample(&self, row: usize, fields: &[&str], comma: bool) -> Result<(f64, f64), String> {
        let get = |what: &str, k: usize| {
            let field = fields.get(k).copied().unwrap_or_default();
            match number(field, comma) {
                _ if field.is_empty() => Err(format!("the {what} is missing")),
                None => Err(format!("'{}' is no number", short_of(field))),
                Some(x) if x.is_nan() => Err(format!("the {what} is NaN")),
                Some(x) if x.abs() > LARGEST => {
                    Err(format!("the {what} is {x:e}, which is beyond {LARGEST:e}"))
                }
                Some(x) => Ok(x),
            }
        };
        let value = get("value", self.signal)?;
        let time = match &self.time {
            Time::Column(k, unit) => unit.seconds(get("time", *k)?),
            Time::Steps { column: Some(k), start, step } => start + step * get("time", *k)?,
            Time::Steps { column: None, start, step } => start + step * row as f64,
        };
        Ok((time, value))
    }
}

/// The time's column, if there is one, and the signal's: as asked for, or as the header names them, or the first two.
fn columns(table: &Table, options: &Options) -> Result<(Option<usize>, usize), Refusal> {
    let asked =
        options.columns.iter().map(|column| table.column(column)).collect::<Result<Vec<_>, _>>()?;
    let filled: Vec<usize> =
        (0..table.first.len()).filter(|k| !table.first[*k].is_empty()).collect();
    let is_time = |k: &usize| {
        table.above(*k).any(|name| {
            let name = name.to_lowercase();
            name.contains("time") || name.contains("zeit") || name == "t" || name == "x"
        })
    };
    Ok(match (asked.as_slice(), filled.as_slice()) {
        ([time, signal, ..], _) => (Some(*time), *signal),
        ([signal], _) | ([], [signal]) => (None, *signal),
        ([], _) => {
            let time = filled.iter().copied().find(is_time).unwrap_or(filled[0]);
            let signal = filled.iter().copied().find(|k| *k > time);
            let signal = signal.or_else(|| filled.iter().copied().find(|k| *k != time));
            (Some(time), signal.unwrap_or(time))
        }
    })
}

/// The times as steps: of the rate that is given, or Rigol's own, a sequence with its start and its increment.
fn steps(table: &Table, rate: Option<f64>, time: Option<usize>) -> Option<Time> {
    if let Some(rate) = rate {
        return Some(Time::Steps { column: None, start: 0.0, step: 1.0 / rate });
    }
    let start = table.given("start").or_else(|| table.given("t0"))?;
    let increment = table.given("increment");
    let step = increment.or_else(|| table.given("tinc"))?;
    // A column beside `tInc` holds the times themselves.
    let column = time.filter(|_| increment.is_some());
    (column.is_some() || time.is_none()).then_some(Time::Steps { column, start, step })
}

/// The fields of a line, without blanks and quotes around them. No number holds a delimiter, and a quote that is never
/// closed must not swallow the rest of the file: so a line is cut at each.
fn split(line: &str, delimiter: char) -> impl Iterator<Item = &str> {
    let blank = delimiter == ' ';
    let parts = line.trim_end_matches(['\r', '\n']).split(delimiter);
    let parts = parts.map(|field| field.trim().trim_matches('"').trim());
    parts.filter(move |field| !(blank && field.is_empty()))
}

/// A number with a decimal point, or a decimal comma where that is said; NaN and infinities are numbers here.
fn number(field: &str, comma: bool) -> Option<f64> {
    if comma && field.contains(',') {
        return field.replacen(',', ".", 1).parse().ok();
    }
    field.parse().ok()
}

/// The unit that a column's name holds, as in `Time [ms]`, `time_us` or `Second`.
fn unit_in(name: &str) -> Option<Unit> {
    let name = name.to_lowercase();
    let words = name.split(|c: char| !(c.is_alphanumeric() || c == char::REPLACEMENT_CHARACTER));
    words.rev().find_map(|word| match word {
        "s" | "sec" | "second" | "seconds" | "secs" => Some(Unit::Second),
        "ms" | "msec" | "millisecond" | "milliseconds" => Some(Unit::Millisecond),
        "us" | "µs" | "μs" | "\u{fffd}s" | "usec" | "microsecond" | "microseconds" => {
            Some(Unit::Microsecond)
        }
        "ns" | "nsec" | "nanosecond" | "nanoseconds" => Some(Unit::Nanosecond),
        _ => None,
    })
}

/// As much of a field as a message can hold.
fn short_of(field: &str) -> String {
    let mut chars = field.chars().map(|c| if c.is_control() { '?' } else { c });
    let start: String = chars.by_ref().take(24).collect();
    let more = chars.next().map(|_| '…');
    start.chars().chain(once(more).flatten()).collect()
}
