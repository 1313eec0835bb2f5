//! Which columns of a table are the time and the signals, and in which unit or at which rate.

use super::asked::Options;
use super::heads::Heads;
use super::names::{Means, said, unit_of};
use super::numbers::{Cell, short_of};
use super::reading::{Clock, Reading, Told};
use super::samples::{LARGEST, median};
use super::settings::Settings;
use super::table::{Line, Table};
use super::told::Refusal;
use crate::unit::Unit;

/// Where a row's time and signals are.
#[derive(Clone, Debug)]
pub struct Layout {
    /// The column of the times, or of a count of the rows; rows are counted without.
    pub time: Option<usize>,
    /// How a time is known of the number in this column, or of the row's.
    pub clock: Clock,
    /// The number of the first sample, and its time, if something tells it.
    pub from: f64,
    pub first: Option<f64>,
    pub told: Told,
    /// The columns that may hold a signal, of which there is one at least.
    pub signals: Vec<usize>,
    /// The column of the camera's sync, which is none of these.
    pub sync: Option<usize>,
}

/// The step by which numbers go on, 1 where they count the rows. Some may be lost, or a count begin anew.
fn even_step(numbers: &[f64]) -> Option<f64> {
    let usual = usual_step(numbers)?;
    let next = numbers.windows(2).filter(|pair| ((pair[1] - pair[0]) / usual - 1.0).abs() < 1e-3).count();
    (numbers.len() > 2 && 10 * next >= 9 * (numbers.len() - 1)).then_some(usual)
}

/// The usual step of some numbers, if there are two.
fn usual_step(numbers: &[f64]) -> Option<f64> {
    let steps: Vec<f64> = numbers.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    if steps.is_empty() { None } else { Some(median(steps)) }
}

impl Layout {
    pub fn new(table: &Table, options: &Options) -> Result<Self, Refusal> {
        let settings = &table.settings();
        let columns = Columns { table, settings, unit: options.unit };
        let (asked, sync) = table.heads.asked(options)?;
        if let Some(k) = sync.filter(|k| columns.runs(*k)) {
            return Err(Refusal::NoDelay { reason: format!("column {} holds times", table.heads.quoted(k)) });
        }
        // Lines of two whole numbers may be decimals, of one column without a name.
        let is_pair = table.columns.len() == 2 && table.heads.width == 2 && table.heads.names[0].is_empty();
        if let (Some(number), true) = (table.cut(0), is_pair && asked.is_empty() && sync.is_none() && !columns.runs(0))
        {
            return Err(Refusal::Thousands { number });
        }
        let (time, signals) = match (options.rate, asked.as_slice()) {
            // The times of the file do not count then, so those that are asked for are signals.
            (Some(_), asked) => (None, asked),
            (None, [time, signals @ ..]) if !signals.is_empty() => (Some(*time), signals),
            (None, asked) => (columns.time(&[asked, sync.as_slice()].concat())?, asked),
        };
        let signals = columns.signals(signals, time, sync)?;
        let (time, clock, told) = match options.rate {
            Some(rate) => (None, Clock::Rate(rate), columns.against(rate).map_or(Told::Asked, Told::Against)),
            None => columns.clock(time)?,
        };
        if let (Some(time), true) = (time, options.columns.len() < 2) {
            columns.only_times(time)?;
        }
        let first = settings.start.filter(|_| matches!(clock, Clock::Rate(_)));
        let from = time.and_then(|k| table.first(k).first().copied()).unwrap_or(0.0);
        Ok(Self { time, clock, from, first, told, signals, sync })
    }

    /// As a reader is told, where the signal is in this column.
    pub fn reading(&self, heads: &Heads, signal: usize, options: &Options) -> Reading {
        let named = |column: usize| (column + 1, heads.name(column));
        Reading {
            columns: heads.width,
            time: self.time.map(named),
            signal: named(signal),
            sync: self.sync.map(named),
            clock: self.clock,
            first: self.first,
            told: self.told.clone(),
            window: [options.from, options.to],
            segments: 0,
        }
    }

    /// The time of a row in seconds, or what is wrong with it.
    pub fn time_of(&self, table: &Table, row: usize, line: &Line) -> Result<f64, String> {
        let number = self.time.map_or(Ok(row as f64), |k| sound(table, line, k, "time"))?;
        Ok(match self.clock {
            Clock::Unit(unit) => unit.seconds(number),
            Clock::Rate(rate) => self.first.unwrap_or(0.0) + (number - self.from) / rate,
        })
    }
}

/// The number in a column, or what is wrong with it.
pub fn sound(table: &Table, line: &Line, column: usize, what: &str) -> Result<f64, String> {
    match line.cell(column) {
        Cell::Number(x) if x.is_finite() && x.abs() <= LARGEST => Ok(x),
        Cell::Number(x) => Err(format!("the {what} is {x:e}, and no finite number up to {LARGEST:e}")),
        Cell::Empty => Err(format!("the {what} is missing")),
        _ => Err(format!("'{}' is no number", short_of(table.field(line, column)))),
    }
}

/// What the columns of a table hold, by their names, their numbers and the settings above them.
struct Columns<'a> {
    table: &'a Table<'a>,
    settings: &'a Settings,
    /// The unit that is asked for.
    unit: Option<Unit>,
}

impl Columns<'_> {
    fn said(&self, k: usize) -> Option<Means> {
        match said(self.table.heads.label(k)) {
            Some(Means::In(unit)) => Some(Means::In(unit)),
            _ if self.table.clocks.contains(&k) => Some(Means::In(Unit::Second)),
            other => other,
        }
    }

    fn counts(&self, k: usize) -> bool {
        let said = self.said(k);
        !matches!(said, Some(Means::In(_)))
            && (even_step(&self.table.first(k)) == Some(1.0) || said == Some(Means::Count) && self.runs(k))
    }

    /// Do the numbers go one way, as times do and a pulse does not? They may begin anew with each of some shots.
    fn runs(&self, k: usize) -> bool {
        let numbers = self.table.spread(k);
        let rises = numbers.windows(2).filter(|pair| pair[1] > pair[0]).count();
        let falls = numbers.windows(2).filter(|pair| pair[1] < pair[0]).count();
        // Times of day in whole seconds do not rise often.
        self.table.clocks.contains(&k) && rises > 0
            || rises + falls >= 2.max(numbers.len() / 50) && 10 * rises.min(falls) <= rises + falls
    }

    /// What a rate that is asked for contradicts: another one that the file's times have.
    fn against(&self, rate: f64) -> Option<String> {
        let mut columns = self.table.columns.iter().copied();
        let (k, unit) = columns.find_map(|k| match self.said(k) {
            Some(Means::In(unit)) if self.runs(k) => Some((k, unit)),
            _ => None,
        })?;
        let usual = unit.seconds(usual_step(&self.table.first(k))?);
        ((usual * rate - 1.0).abs() > 0.02)
            .then(|| format!("column {} has steps of {}", self.table.heads.quoted(k), Unit::fit(usual).show(usual)))
    }

    /// The signals: those that are asked for, or all columns that are neither times nor counts, if there are others.
    fn signals(&self, asked: &[usize], time: Option<usize>, sync: Option<usize>) -> Result<Vec<usize>, Refusal> {
        if !asked.is_empty() {
            return Ok(asked.to_vec());
        }
        let is_other = |k: &usize| ![time, sync].contains(&Some(*k));
        let others: Vec<usize> = self.table.columns.iter().copied().filter(is_other).collect();
        if let (Some(sync), true) = (sync, others.is_empty()) {
            let reason = format!("beside column {} no other holds a signal", self.table.heads.quoted(sync));
            return Err(Refusal::NoDelay { reason });
        }
        let is_time = |k: usize| matches!(self.said(k), Some(Means::Time | Means::In(_)));
        let is_signal = |k: &usize| !(self.counts(*k) || is_time(*k) && self.runs(*k));
        let signals: Vec<usize> = others.iter().copied().filter(is_signal).collect();
        let found = [signals, others].into_iter().find(|found| !found.is_empty());
        Ok(found.unwrap_or_else(|| self.table.columns.clone()))
    }

    /// The time's column, if there is one: by its name, and best with a unit; or the first that runs on, if no rate is
    /// known.
    fn time(&self, asked: &[usize]) -> Result<Option<usize>, Refusal> {
        if self.table.columns.len() < 2 {
            return Ok(None);
        }
        let columns = || self.table.columns.iter().copied().filter(|k| !asked.contains(k));
        let running: Vec<usize> = columns().filter(|k| self.runs(*k)).collect();
        let find = |is: &dyn Fn(usize) -> bool| running.iter().copied().find(|k| is(*k));
        let has_unit = |k: usize| matches!(self.said(k), Some(Means::In(_)));
        let named = find(&|k| has_unit(k) && !self.table.clocks.contains(&k)).or_else(|| find(&has_unit));
        let named = named.or_else(|| find(&|k| self.said(k) == Some(Means::Time)));
        if named.is_some() {
            return Ok(named);
        }
        if let Some((_, step)) = self.settings.step()? {
            let counter = find(&|k| even_step(&self.table.first(k)) == Some(1.0));
            let fits = || find(&|k| self.unit_of_steps(k, step).is_some());
            let other = || find(&|k| self.counts(k) || even_step(&self.table.first(k)).is_some());
            return Ok(counter.or_else(fits).or_else(other));
        }
        // Of the first columns one alone can be the time, after those that count.
        let counts = |k: usize| self.counts(k) && self.unit.is_none();
        let first = columns().find(|k| !counts(*k));
        Ok(first.filter(|k| running.contains(k)).or_else(|| find(&counts)))
    }

    /// The unit in which a column's numbers go on by so many seconds from one to the next.
    fn unit_of_steps(&self, k: usize, step: f64) -> Option<Unit> {
        let usual = usual_step(&self.table.first(k))?;
        Unit::ALL.into_iter().find(|unit| (unit.seconds(usual) / step - 1.0).abs() < 0.02)
    }

    /// How a row's time is known, and who tells that.
    fn clock(&self, time: Option<usize>) -> Result<(Option<usize>, Clock, Told), Refusal> {
        let Self { table, settings, unit } = *self;
        if let (Some(words), None) = (&settings.no_time, unit) {
            return Err(Refusal::UnclearUnit { name: words.clone() });
        }
        let step = settings.step();
        let Some(k) = time else {
            let (words, step) = step?.ok_or_else(|| self.no_times())?;
            return Ok((None, Clock::Rate(1.0 / step), Told::Header(words)));
        };
        let in_unit = |unit: Unit, told: Told| Ok((time, Clock::Unit(unit), told));
        if table.clocks.contains(&k) {
            return match table.cut(k) {
                Some(number) => Err(Refusal::Thousands { number }),
                None => in_unit(Unit::Second, Told::Format),
            };
        }
        // What a rate says of the steps of these times.
        let by_rate = step.as_ref().ok().and_then(|step| step.as_ref());
        let by_rate = by_rate.and_then(|(words, step)| Some((words.clone(), self.unit_of_steps(k, *step)?)));
        let (first, counts) = (table.first(k), self.counts(k));
        match (unit, self.said(k), by_rate) {
            (Some(unit), Some(Means::In(named)), _) if named != unit => {
                return in_unit(unit, Told::Against(format!("its name says {}", named.name())));
            }
            (Some(unit), ..) => return in_unit(unit, Told::Asked),
            // A rate that fits the steps in another unit says that one of the two is wrong.
            (None, Some(Means::In(unit)), Some((second, other))) if other != unit => {
                return Err(Refusal::TwoRates { first: table.heads.quoted(k), second });
            }
            (None, Some(Means::In(unit)), _) => return in_unit(unit, Told::Name),
            (None, _, Some((words, unit))) if !counts => return in_unit(unit, Told::Header(words)),
            _ => (),
        }
        // By another step than 1 the rate may be the count's or the rows'.
        if let (Some((words, step)), true) = (step?, counts || even_step(&first).is_some()) {
            let other = Refusal::TwoRates { first: table.heads.quoted(k), second: words.clone() };
            let clock = (time, Clock::Rate(1.0 / step), Told::Header(words));
            return if even_step(&first) == Some(1.0) { Ok(clock) } else { Err(other) };
        }
        // Whole numbers with more than one between them are a timer's, and that hardly counts seconds.
        let is_timer =
            first.iter().all(|t| t.fract() == 0.0) && !first.windows(2).any(|pair| (pair[1] - pair[0]).abs() == 1.0);
        let (label, counts) = (table.heads.label(k), counts || is_timer);
        let is_other = self.said(k).is_none() && !label.is_empty();
        if is_other && (!counts || label.contains(['(', '['])) {
            return Err(Refusal::UnclearUnit { name: short_of(label) });
        }
        if counts {
            return Err(Refusal::Counter { name: table.heads.quoted(k), quoted: settings.unread.clone() });
        }
        if table.text_beside().is_some_and(|text| unit_of(text).is_some()) {
            return Err(Refusal::NoPlainTimes { text: short_of(table.rows[0].text) });
        }
        match &settings.unit {
            Some((words, Unit::Second)) => in_unit(Unit::Second, Told::Header(words.clone())),
            Some((words, _)) => Err(Refusal::UnclearUnit { name: words.clone() }),
            None => in_unit(Unit::Second, Told::Assumed),
        }
    }

    fn no_times(&self) -> Refusal {
        match self.table.text_beside().map(short_of) {
            // A number with something else, or a date: a rate would not be what it says.
            Some(text) if text.contains(|c: char| c.is_ascii_digit()) => Refusal::NoPlainTimes { text },
            text => {
                let columns = self.table.heads.told(&self.table.columns);
                Refusal::NoTimes { columns, text, quoted: self.settings.unread.clone() }
            }
        }
    }

    /// # Errors
    /// Other times than these, of the same name: a table of several recordings.
    fn only_times(&self, time: usize) -> Result<(), Refusal> {
        let Table { heads, columns, .. } = self.table;
        let has_others = |k: usize| k != time && self.runs(k) && self.table.spread(k) != self.table.spread(time);
        let is_other = |k: &&usize| heads.label(**k) == heads.label(time) && has_others(**k);
        match columns.iter().find(is_other).filter(|_| !heads.label(time).is_empty()) {
            Some(other) => Err(Refusal::TwoTimes { first: heads.quoted(time), second: heads.quoted(*other) }),
            None => Ok(()),
        }
    }
}
