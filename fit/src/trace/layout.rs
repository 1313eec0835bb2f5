//! Which columns of a table are the time and the signals, and in which unit or at which rate.

use super::asked::{Column, Options};
use super::names::{Said, is_axis, is_count, is_time, unit_in};
use super::numbers::{number, short_of};
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
    /// Other columns of times by their name, where a table is put together from several.
    times: Vec<usize>,
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
    /// A column of numbers that count steps of so many seconds, and what its first one is, or the rows counted; and the
    /// first time, if something tells it.
    Steps { column: Option<(usize, f64)>, start: Option<f64>, step: f64 },
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
        if let Some(rate) = options.rate {
            // The times of the file do not count then, so those that are asked for are signals.
            let signals = columns.signals(&asked, None, sync)?;
            let step = 1.0 / rate;
            let time = Time::Steps { column: None, start: settings.start(step), step };
            return Ok(Self { time, times: Vec::new(), signals, sync, told: Told::Asked });
        }
        let (time, asked) = match asked.as_slice() {
            [time, signals @ ..] if !signals.is_empty() => (Some(*time), signals),
            asked => {
                let others = [asked, sync.as_slice()].concat();
                (columns.time(&others, &settings, options.unit)?, asked)
            }
        };
        let signals = columns.signals(asked, time, sync)?;
        let (time, told) = columns.clock(time, &settings, options.unit)?;
        let times = match time {
            Time::Column(column, _) if options.columns.len() < 2 => columns.named_alike(column),
            _ => Vec::new(),
        };
        Ok(Self { time, times, signals, sync, told })
    }

    /// Where the times of a signal are: of several columns of times, the next one to its left.
    fn time_of(&self, signal: usize) -> Time {
        match (self.time, self.times.iter().rev().find(|k| **k < signal)) {
            (Time::Column(_, unit), Some(column)) => Time::Column(*column, unit),
            (time, _) => time,
        }
    }

    /// As a reader is told, where the signal is in this column.
    pub fn reading(&self, table: &Table, signal: usize) -> Reading {
        let named = |column: usize| (column + 1, table.name(column));
        let (time, clock, first) = match self.time_of(signal) {
            Time::Column(column, unit) => (Some(named(column)), Clock::Unit(unit), None),
            Time::Steps { column, step, start } => {
                (column.map(|(column, _)| named(column)), Clock::Rate(1.0 / step), start)
            }
        };
        Reading {
            columns: table.width,
            time,
            signal: named(signal),
            sync: self.sync.map(named),
            clock,
            first,
            told: self.told.clone(),
            window: [None; 2],
            segments: 0,
        }
    }

    /// A row's time in seconds and the signal in a column, which may be infinite, or what is wrong with them.
    pub fn sample(&self, row: usize, fields: &[&str], signal: usize, comma: bool) -> Result<(f64, f64), String> {
        let get = |what: &str, k: usize| {
            let field = fields.get(k).copied().unwrap_or_default();
            match number(field, comma) {
                _ if field.is_empty() => Err(format!("the {what} is missing")),
                None => Err(format!("'{}' is no number", short_of(field))),
                Some(x) if x.is_nan() => Err(format!("the {what} is NaN")),
                Some(x) if x.abs() > LARGEST && !(x.is_infinite() && k == signal) => {
                    Err(format!("the {what} is {x:e}, which is beyond {LARGEST:e}"))
                }
                Some(x) => Ok(x),
            }
        };
        let value = get("value", signal)?;
        let time = match self.time_of(signal) {
            Time::Column(k, unit) => unit.seconds(get("time", k)?),
            Time::Steps { column: Some((k, first)), start, step } => match start {
                Some(start) => start + step * (get("time", k)? - first),
                None => step * get("time", k)?,
            },
            Time::Steps { column: None, start, step } => start.unwrap_or(0.0) + step * row as f64,
        };
        Ok((time, value))
    }
}

/// What the columns of a table hold, by their names and their numbers.
struct Columns<'a> {
    table: &'a Table<'a>,
}

impl Columns<'_> {
    fn name(&self, k: usize) -> String {
        self.table.name(k).map_or((k + 1).to_string(), |name| format!("{}, \"{name}\"", k + 1))
    }

    fn unit(&self, k: usize) -> Said {
        let [name, below] = self.table.labels(k).map(unit_in);
        if below == Said::Nothing { name } else { below }
    }

    fn is_time(&self, k: usize) -> bool {
        is_time(self.table.labels(k)[0])
    }

    fn counts(&self, k: usize) -> bool {
        let is_named = self.table.labels(k).iter().any(|label| is_count(label));
        let has_unit = matches!(self.unit(k), Said::Unit(_));
        !has_unit && (is_counter(&self.table.first[k]) || is_named && runs(&self.table.spread[k]))
    }

    fn runs(&self, k: usize) -> bool {
        runs(&self.table.spread[k])
    }

    /// The sync's column, which is not asked for as another.
    fn sync(&self, column: &Column, asked: &[usize]) -> Result<usize, Refusal> {
        let named = (0..self.table.width).find(|k| self.table.labels(*k)[0] == column.to_string());
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
        let columns = &self.table.columns;
        let is_other = |k: &usize| Some(*k) != time && Some(*k) != sync;
        let others: Vec<usize> = columns.iter().copied().filter(is_other).collect();
        if let (Some(sync), true) = (sync, others.is_empty()) {
            let reason = format!("beside column {} no other holds a signal", self.name(sync));
            return Err(Refusal::NoDelay { reason });
        }
        let is_time = |k: usize| self.is_time(k) || matches!(self.unit(k), Said::Unit(_));
        let is_signal = |k: &usize| !(self.counts(*k) || is_time(*k) && self.runs(*k));
        let signals: Vec<usize> = others.iter().copied().filter(is_signal).collect();
        let found = [signals, others].into_iter().find(|found| !found.is_empty());
        Ok(found.unwrap_or_else(|| columns.clone()))
    }

    /// The time's column, if there is one: by its name, and best with a unit; or the first that runs on, if no rate is
    /// known.
    fn time(&self, asked: &[usize], settings: &Settings, unit: Option<Unit>) -> Result<Option<usize>, Refusal> {
        if self.table.columns.len() < 2 {
            return Ok(None);
        }
        let columns: Vec<usize> = self.table.columns.iter().copied().filter(|k| !asked.contains(k)).collect();
        let running: Vec<usize> = columns.iter().copied().filter(|k| self.runs(*k)).collect();
        let find = |is: &dyn Fn(&usize) -> bool| running.iter().copied().find(is);
        let has_unit = |k: &usize| matches!(self.unit(*k), Said::Unit(_));
        let rules: [&dyn Fn(&usize) -> bool; 5] = [
            &|k| self.is_time(*k) && has_unit(k),
            &|k| self.is_time(*k),
            &has_unit,
            &|k| self.unit(*k) == Said::Unclear,
            &|k| is_axis(self.table.labels(*k)[0]),
        ];
        if let Some(time) = rules.iter().find_map(|is| find(is)) {
            return Ok(Some(time));
        }
        let first = |k: usize| &self.table.first[k];
        if let Some((_, step)) = settings.step()? {
            let counter = find(&|k| is_counter(first(*k)));
            return Ok(counter.or_else(|| find(&|k| unit_of_steps(first(*k), step).is_some())));
        }
        // Of the first columns one alone can be the time, after those that count.
        let counts = |k: &usize| self.counts(*k) && unit.is_none();
        let time = columns.iter().copied().find(|k| !counts(k)).filter(|k| running.contains(k));
        Ok(time.or_else(|| find(&counts)))
    }

    /// How a row's time is known, and who tells that.
    fn clock(&self, time: Option<usize>, settings: &Settings, asked: Option<Unit>) -> Result<(Time, Told), Refusal> {
        let steps = |column: Option<usize>, words, step| {
            let column = column.map(|k| (k, self.table.first[k][0]));
            // What counts from below 0 tells its zero.
            let counted = column.map(|(_, first)| first * step).filter(|first| *first < 0.0);
            let start = settings.start(step).or(counted);
            Ok((Time::Steps { column, start, step }, Told::Header(words)))
        };
        let Some(k) = time else {
            let (words, step) = settings.step()?.ok_or_else(|| self.no_times(settings))?;
            return steps(None, words, step);
        };
        match (asked, self.unit(k)) {
            (Some(unit), Said::Unit(named)) if named != unit => {
                return Ok((Time::Column(k, unit), Told::Against(named)));
            }
            (Some(unit), _) => return Ok((Time::Column(k, unit), Told::Asked)),
            (None, Said::Unit(unit)) => {
                // A rate that fits the steps in another unit says that one of the two is wrong.
                let against =
                    settings.step().ok().flatten().filter(|(_, step)| {
                        unit_of_steps(&self.table.first[k], *step).is_some_and(|other| other != unit)
                    });
                return match against {
                    Some((second, _)) => Err(Refusal::TwoRates { first: self.name(k), second }),
                    None => Ok((Time::Column(k, unit), Told::Name)),
                };
            }
            (None, Said::Unclear) => {
                let [name, below] = self.table.labels(k);
                let name = if unit_in(name) == Said::Unclear { name } else { below };
                return Err(Refusal::UnclearUnit { name: short_of(name) });
            }
            (None, Said::Nothing) => (),
        }
        if let Some((words, step)) = settings.step()? {
            if self.counts(k) {
                // The numbers of samples that were left out count as well; those of a timer are no samples.
                let counter = is_counter(&self.table.first[k]).then_some(k);
                return steps(counter, words, step);
            }
            if let Some(unit) = unit_of_steps(&self.table.first[k], step) {
                return match settings.unit.clone().filter(|(_, other)| *other != unit) {
                    Some((first, _)) => Err(Refusal::TwoRates { first, second: words }),
                    None => Ok((Time::Column(k, unit), Told::Header(words))),
                };
            }
        }
        if let (Some((words, unit)), false) = (settings.unit.clone(), self.counts(k)) {
            return Ok((Time::Column(k, unit), Told::Header(words)));
        }
        // Whole numbers with more than one between them are a timer's, and that hardly counts seconds.
        let first = &self.table.first[k];
        let is_timer =
            first.iter().all(|t| t.fract() == 0.0) && !first.windows(2).any(|pair| (pair[1] - pair[0]).abs() == 1.0);
        if self.counts(k) || is_timer {
            let quoted = settings.unread.clone();
            return Err(Refusal::Counter { name: self.name(k), quoted });
        }
        Ok((Time::Column(k, Unit::Second), Told::Assumed))
    }

    fn no_times(&self, settings: &Settings) -> Refusal {
        let columns = self.table.told(self.table.columns.iter().copied());
        let (text, quoted) = (self.table.text_beside(), settings.unread.clone());
        Refusal::NoTimes { columns, text, quoted }
    }

    /// The columns of times of the same name.
    fn named_alike(&self, time: usize) -> Vec<usize> {
        let label = self.table.labels(time);
        let is_alike = |k: &usize| self.is_time(*k) && self.table.labels(*k) == label;
        self.table.columns.iter().copied().filter(is_alike).collect()
    }
}
