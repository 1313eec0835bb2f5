//! Which columns of a table are the time and the signals, and in which unit or at which rate.

use super::asked::{Column, Options};
use super::names::{Said, said};
use super::numbers::{short_of, time_of_day};
use super::reading::{Clock, Reading, Told};
use super::samples::{LARGEST, median};
use super::settings::Settings;
use super::table::Table;
use super::told::Refusal;
use crate::unit::Unit;

/// Where a row's time and signals are.
#[derive(Clone, Debug)]
pub struct Layout {
    pub time: Time,
    /// The columns that may hold a signal, of which there is one at least.
    pub signals: Vec<usize>,
    /// The column of the camera's sync, which is none of these.
    pub sync: Option<usize>,
    pub told: Told,
}

#[derive(Clone, Copy, Debug)]
pub enum Time {
    /// A column of times, in this unit.
    Column(usize, Unit),
    /// A column of times of day, which count from the first one.
    Day(usize, f64),
    /// A column of numbers that count steps of so many seconds, and what its first one is, or the rows counted; and the
    /// first time, if something tells it.
    Steps { column: Option<(usize, f64)>, start: Option<f64>, step: f64 },
}

impl Time {
    pub fn column(&self) -> Option<usize> {
        match self {
            Self::Column(column, _) | Self::Day(column, _) => Some(*column),
            Self::Steps { column, .. } => column.map(|(column, _)| column),
        }
    }
}

/// Do the numbers count the rows?
fn is_counter(numbers: &[f64]) -> bool {
    numbers.len() > 2 && numbers.windows(2).all(|pair| pair[1] - pair[0] == 1.0)
}

/// Do the numbers go one way, as times do and a pulse does not? They may begin anew with each of some shots.
fn runs(numbers: &[f64]) -> bool {
    let rises = numbers.windows(2).filter(|pair| pair[1] > pair[0]).count();
    let falls = numbers.windows(2).filter(|pair| pair[1] < pair[0]).count();
    rises + falls >= 2.max(numbers.len() / 50) && 10 * rises.min(falls) <= rises + falls
}

/// The unit in which the numbers go on by so many seconds from one to the next.
fn unit_of_steps(numbers: &[f64], step: f64) -> Option<Unit> {
    let steps: Vec<f64> = numbers.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    let usual = if steps.is_empty() { return None } else { median(steps) };
    Unit::ALL.into_iter().find(|unit| (unit.seconds(usual) / step - 1.0).abs() < 0.02)
}

impl Layout {
    pub fn new(table: &Table, options: &Options) -> Result<Self, Refusal> {
        let columns = Columns { table };
        let mut asked = Vec::new();
        for column in &options.columns {
            let k = table.column(column)?;
            if asked.contains(&k) {
                return Err(Refusal::SameColumn { name: columns.name(k) });
            }
            asked.push(k);
        }
        let settings = table.settings();
        let sync = options.sync.as_ref().map(|sync| columns.sync(sync, &asked)).transpose()?;
        if let (Some(number), true) = (table.decimal(), asked.is_empty() && sync.is_none() && !columns.runs(0)) {
            return Err(Refusal::Thousands { number });
        }
        if let Some(rate) = options.rate {
            // The times of the file do not count then, so those that are asked for are signals.
            let signals = columns.signals(&asked, None, sync)?;
            let (start, step) = (settings.start, 1.0 / rate);
            let against = columns.against(step);
            let told = against.map_or(Told::Asked, Told::Against);
            return Ok(Self { time: Time::Steps { column: None, start, step }, signals, sync, told });
        }
        let (time, asked) = match asked.as_slice() {
            [time, signals @ ..] if !signals.is_empty() => (Some(*time), signals),
            asked => (columns.time(&[asked, sync.as_slice()].concat(), &settings, options.unit)?, asked),
        };
        let signals = columns.signals(asked, time, sync)?;
        let (time, told) = columns.clock(time, &settings, options.unit)?;
        if let (Some(time), true) = (time.column(), options.columns.len() < 2) {
            columns.only_times(time)?;
        }
        Ok(Self { time, signals, sync, told })
    }

    /// As a reader is told, where the signal is in this column.
    pub fn reading(&self, table: &Table, signal: usize) -> Reading {
        let named = |column: usize| (column + 1, table.name(column));
        let (clock, first) = match self.time {
            Time::Column(_, unit) => (Clock::Unit(unit), None),
            Time::Day(..) => (Clock::Unit(Unit::Second), Some(0.0)),
            Time::Steps { step, start, .. } => (Clock::Rate(1.0 / step), start),
        };
        Reading {
            columns: table.width,
            time: self.time.column().map(named),
            signal: named(signal),
            sync: self.sync.map(named),
            clock,
            first,
            told: self.told.clone(),
            window: [None; 2],
            segments: 0,
        }
    }
}

/// The number in a field, or what is wrong with it.
pub fn sound(what: &str, field: &str, number: Option<f64>) -> Result<f64, String> {
    match number {
        _ if field.is_empty() => Err(format!("the {what} is missing")),
        None => Err(format!("'{}' is no number", short_of(field))),
        Some(x) if x.is_finite() && x.abs() <= LARGEST => Ok(x),
        Some(x) => Err(format!("the {what} is {x:e}, and no finite number up to {LARGEST:e}")),
    }
}

/// The time of a row in seconds, or what is wrong with it.
pub fn time_of(table: &Table, time: Time, row: usize, fields: &[&str]) -> Result<f64, String> {
    let field = |k: usize| fields.get(k).copied().unwrap_or_default();
    let number = |k: usize| sound("time", field(k), table.form.number(field(k)));
    Ok(match time {
        Time::Column(k, unit) => unit.seconds(number(k)?),
        Time::Day(k, first) => sound("time", field(k), time_of_day(field(k)))? - first,
        Time::Steps { column: Some((k, first)), start, step } => match start {
            Some(start) => start + step * (number(k)? - first),
            None => step * number(k)?,
        },
        Time::Steps { column: None, start, step } => start.unwrap_or(0.0) + step * row as f64,
    })
}

/// What the columns of a table hold, by their names and their numbers.
struct Columns<'a> {
    table: &'a Table<'a>,
}

impl Columns<'_> {
    fn name(&self, k: usize) -> String {
        self.table.name(k).map_or((k + 1).to_string(), |name| format!("{}, \"{name}\"", k + 1))
    }

    fn said(&self, k: usize) -> Said {
        match said(self.table.label(k)) {
            Said::Unit(unit) => Said::Unit(unit),
            _ if self.table.is_clock(k) => Said::Unit(Unit::Second),
            other => other,
        }
    }

    fn counts(&self, k: usize) -> bool {
        let said = self.said(k);
        !matches!(said, Said::Unit(_)) && (is_counter(&self.table.first[k]) || said == Said::Count && self.runs(k))
    }

    fn runs(&self, k: usize) -> bool {
        // Times of day in whole seconds do not rise often.
        let rises = || self.table.spread[k].windows(2).any(|pair| pair[1] > pair[0]);
        runs(&self.table.spread[k]) || self.table.is_clock(k) && rises()
    }

    /// Of the columns of times with a unit, the first.
    fn timed(&self) -> Option<usize> {
        let is_one = |k: &usize| matches!(self.said(*k), Said::Unit(_)) && self.runs(*k);
        self.table.columns.iter().copied().find(is_one)
    }

    /// What a rate that is asked for contradicts: another one that the file's times have.
    fn against(&self, step: f64) -> Option<String> {
        let k = self.timed()?;
        let Said::Unit(unit) = self.said(k) else { return None };
        let steps = self.table.first[k].windows(2).map(|pair| unit.seconds(pair[1] - pair[0]).abs()).collect();
        let usual = median(steps);
        ((usual / step - 1.0).abs() > 0.02)
            .then(|| format!("column {} has steps of {}", self.name(k), Unit::fit(usual).show(usual)))
    }

    /// The sync's column, which is not asked for as another.
    fn sync(&self, column: &Column, asked: &[usize]) -> Result<usize, Refusal> {
        let named = (0..self.table.width).find(|k| self.table.is_named(*k, &column.to_string()));
        let reason = match (self.table.column(column), named) {
            (Err(refusal), _) => {
                format!("{refusal}; a time has a unit, as in 1.5ms, and a file has to be there")
            }
            // A number may be a name as well.
            (Ok(k), Some(named)) if named != k => format!(
                "'{column}' is the number of column {}, and the name of column {}; give the whole name",
                self.name(k),
                self.name(named)
            ),
            (Ok(k), _) if self.runs(k) => format!("column {} holds times", self.name(k)),
            (Ok(k), _) if asked.contains(&k) => format!("column {} is the signal's", self.name(k)),
            (Ok(k), _) => return Ok(k),
        };
        Err(Refusal::NoDelay { reason })
    }

    /// The signals: those that are asked for, or all columns that are neither times nor counts, if there are others.
    fn signals(&self, asked: &[usize], time: Option<usize>, sync: Option<usize>) -> Result<Vec<usize>, Refusal> {
        if !asked.is_empty() {
            return Ok(asked.to_vec());
        }
        let is_other = |k: &usize| Some(*k) != time && Some(*k) != sync && !self.table.is_clock(*k);
        let others: Vec<usize> = self.table.columns.iter().copied().filter(is_other).collect();
        if let (Some(sync), true) = (sync, others.is_empty()) {
            let reason = format!("beside column {} no other holds a signal", self.name(sync));
            return Err(Refusal::NoDelay { reason });
        }
        let is_time = |k: usize| matches!(self.said(k), Said::Time | Said::Unit(_));
        let is_signal = |k: &usize| !(self.counts(*k) || is_time(*k) && self.runs(*k));
        let signals: Vec<usize> = others.iter().copied().filter(is_signal).collect();
        let found = [signals, others].into_iter().find(|found| !found.is_empty());
        Ok(found.unwrap_or_else(|| self.table.columns.clone()))
    }

    /// The time's column, if there is one: by its name, and best with a unit; or the first that runs on, if no rate is
    /// known.
    fn time(&self, asked: &[usize], settings: &Settings, unit: Option<Unit>) -> Result<Option<usize>, Refusal> {
        let columns: Vec<usize> = self.table.columns.iter().copied().filter(|k| !asked.contains(k)).collect();
        if self.table.columns.len() < 2 {
            return Ok(None);
        }
        let find = |is: &dyn Fn(&usize) -> bool| columns.iter().copied().find(|k| self.runs(*k) && is(k));
        let has_unit = |k: &usize| matches!(self.said(*k), Said::Unit(_));
        let named = find(&|k| has_unit(k) && !self.table.is_clock(*k)).or_else(|| find(&has_unit));
        let named = named.or_else(|| find(&|k| self.said(*k) == Said::Time));
        if named.is_some() {
            return Ok(named);
        }
        let first = |k: usize| &self.table.first[k];
        if let Some((_, step)) = settings.step()? {
            let counter = find(&|k| is_counter(first(*k)));
            return Ok(counter.or_else(|| find(&|k| unit_of_steps(first(*k), step).is_some())));
        }
        // Of the first columns one alone can be the time, after those that count.
        let counts = |k: &usize| self.counts(*k) && unit.is_none();
        let time = columns.iter().copied().find(|k| !counts(k)).filter(|k| self.runs(*k));
        Ok(time.or_else(|| find(&counts)))
    }

    /// How a row's time is known, and who tells that.
    fn clock(&self, time: Option<usize>, settings: &Settings, asked: Option<Unit>) -> Result<(Time, Told), Refusal> {
        if let (Some(words), None) = (&settings.no_time, asked) {
            return Err(Refusal::UnclearUnit { name: words.clone() });
        }
        let steps = |column: Option<usize>, words, step| {
            let column = column.map(|k| (k, self.table.first[k][0]));
            Ok((Time::Steps { column, start: settings.start, step }, Told::Header(words)))
        };
        let Some(k) = time else {
            let (words, step) = settings.step()?.ok_or_else(|| self.no_times(settings))?;
            return steps(None, words, step);
        };
        let first = &self.table.first[k];
        if self.table.is_clock(k) {
            return Ok((Time::Day(k, first[0]), Told::Format));
        }
        // What a rate says of the steps of these times.
        let by_rate =
            || settings.step().ok().flatten().and_then(|(words, step)| Some((words, unit_of_steps(first, step)?)));
        match (asked, self.said(k)) {
            (Some(unit), Said::Unit(named)) if named != unit => {
                return Ok((Time::Column(k, unit), Told::Against(format!("its name says {}", named.name()))));
            }
            (Some(unit), _) => return Ok((Time::Column(k, unit), Told::Asked)),
            (None, Said::Unit(unit)) => {
                // A rate that fits the steps in another unit says that one of the two is wrong.
                return match by_rate().filter(|(_, other)| *other != unit) {
                    Some((second, _)) => Err(Refusal::TwoRates { first: self.name(k), second }),
                    None => Ok((Time::Column(k, unit), Told::Name)),
                };
            }
            _ => (),
        }
        if let Some((words, step)) = settings.step()? {
            if self.counts(k) {
                // The numbers of samples that were left out count as well; those of a timer are no samples.
                return steps(is_counter(first).then_some(k), words, step);
            }
            if let Some((words, unit)) = by_rate() {
                return Ok((Time::Column(k, unit), Told::Header(words)));
            }
        }
        // Whole numbers with more than one between them are a timer's, and that hardly counts seconds.
        let is_timer =
            first.iter().all(|t| t.fract() == 0.0) && !first.windows(2).any(|pair| (pair[1] - pair[0]).abs() == 1.0);
        let (label, counts) = (self.table.label(k), self.counts(k) || is_timer);
        if self.said(k) == Said::Other && (!counts || label.contains(['(', '['])) {
            return Err(Refusal::UnclearUnit { name: short_of(label) });
        }
        if counts {
            return Err(Refusal::Counter { name: self.name(k), quoted: settings.unread.clone() });
        }
        if let Some(text) = self.table.number_and_word(k) {
            return Err(Refusal::NoPlainTimes { text });
        }
        match &settings.unit {
            Some((words, Unit::Second)) => Ok((Time::Column(k, Unit::Second), Told::Header(words.clone()))),
            Some((words, _)) => Err(Refusal::UnclearUnit { name: words.clone() }),
            None => Ok((Time::Column(k, Unit::Second), Told::Assumed)),
        }
    }

    fn no_times(&self, settings: &Settings) -> Refusal {
        let text = self.table.text_beside();
        // A number with something else, or a date: a rate would not be what it says.
        if let Some(text) = text.clone().filter(|text| text.contains(|c: char| c.is_ascii_digit())) {
            return Refusal::NoPlainTimes { text };
        }
        let columns = self.table.told(self.table.columns.iter().copied());
        Refusal::NoTimes { columns, text, quoted: settings.unread.clone() }
    }

    /// # Errors
    /// Other times than these, of the same name: a table of several recordings.
    fn only_times(&self, time: usize) -> Result<(), Refusal> {
        let of = |k: usize| (self.table.label(k), &self.table.spread[k]);
        let is_other =
            |k: &usize| *k != time && !of(*k).0.is_empty() && of(*k).0 == of(time).0 && of(*k).1 != of(time).1;
        match self.table.columns.iter().copied().find(is_other).filter(|k| self.runs(*k)) {
            Some(other) => Err(Refusal::TwoTimes { first: self.name(time), second: self.name(other) }),
            None => Ok(()),
        }
    }
}
