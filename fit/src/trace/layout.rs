//! Which columns of a table are the time and the signal, and in which unit or at which rate.

use super::asked::Options;
use super::numbers::{number, short_of, step_in, unit_in};
use super::reading::{Clock, Reading, Told};
use super::samples::LARGEST;
use super::table::Table;
use super::told::Refusal;
use crate::unit::Unit;

/// Where a row's time and signal are.
#[derive(Clone, Debug)]
pub struct Layout {
    pub time: Time,
    /// The column of the signal, and the other ones that may hold one.
    pub signal: usize,
    pub others: Vec<usize>,
    pub told: Told,
}

#[derive(Clone, Debug)]
pub enum Time {
    /// A column of times, in this unit.
    Column(usize, Unit),
    /// A column of numbers that count steps of so many seconds from a start; without a column, the rows count.
    Steps { column: Option<usize>, start: f64, step: f64 },
}

/// Do the numbers count the rows?
fn is_counter(numbers: &[f64]) -> bool {
    numbers.len() > 2 && numbers.windows(2).all(|pair| pair[1] - pair[0] == 1.0)
}

/// Do the numbers rise from row to row, as times do?
fn rises(numbers: &[f64]) -> bool {
    numbers.len() > 2
        && numbers.windows(2).all(|pair| pair[0] <= pair[1])
        && numbers.first() < numbers.last()
}

impl Layout {
    pub fn new(table: &Table, options: &Options) -> Result<Self, Refusal> {
        let (time, signals) = columns(table, options)?;
        let (signal, others) = (signals[0], signals[1..].to_vec());
        let at = |time: Time, told: Told| Ok(Self { time, signal, others: others.clone(), told });
        if let Some(rate) = options.rate {
            return at(Time::Steps { column: None, start: 0.0, step: 1.0 / rate }, Told::Asked);
        }
        if let Some(time) = given_steps(table, time) {
            return at(time, Told::Header("Start, Increment".into()));
        }
        let unit = time.and_then(|time| table.above(time).find_map(unit_in));
        let counter = time.filter(|time| unit.is_none() && is_counter(&table.start(*time)));
        if let (Some(time), Some(unit)) = (time, options.unit) {
            return at(Time::Column(time, unit), Told::Asked);
        }
        match (time, unit) {
            (Some(time), Some(unit)) => return at(Time::Column(time, unit), Told::Name),
            (Some(time), None) if counter.is_none() => {
                return at(Time::Column(time, Unit::Second), Told::Assumed);
            }
            _ => (),
        }
        let mut steps =
            table.lines.iter().filter_map(|line| step_in(line).map(|step| (line, step)));
        if let Some((line, step)) = steps.next() {
            if let Some((other, _)) = steps.find(|(_, other)| (other / step - 1.0).abs() > 1e-3) {
                let [first, second] = [line, other].map(|line| short_of(line));
                return Err(Refusal::TwoRates { first, second });
            }
            let time = Time::Steps { column: counter, start: 0.0, step };
            return at(time, Told::Header(short_of(line.trim())));
        }
        match counter {
            Some(counter) => {
                let name = table.name(counter).unwrap_or_else(|| (counter + 1).to_string());
                Err(Refusal::Counter { name })
            }
            None => Err(Refusal::NoTimes),
        }
    }

    /// As a reader is told, where the signal is in this column.
    pub fn reading(&self, table: &Table, signal: usize) -> Reading {
        let named = |column: usize| (column + 1, table.name(column));
        let (time, clock) = match self.time {
            Time::Column(column, unit) => (Some(named(column)), Clock::Unit(unit)),
            Time::Steps { column, step, .. } => (column.map(named), Clock::Rate(1.0 / step)),
        };
        let columns = table.first.len();
        Reading { columns, time, signal: named(signal), clock, told: self.told.clone() }
    }

    /// A row's time in seconds and the signal in a column, which may be infinite, or what is wrong with them.
    pub fn sample(
        &self,
        row: usize,
        fields: &[&str],
        signal: usize,
        comma: bool,
    ) -> Result<(f64, f64), String> {
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
        let time = match &self.time {
            Time::Column(k, unit) => unit.seconds(get("time", *k)?),
            Time::Steps { column: Some(k), start, step } => start + step * get("time", *k)?,
            Time::Steps { column: None, start, step } => start + step * row as f64,
        };
        Ok((time, value))
    }
}

/// The time's column, if there is one, and those that may hold the signal, of which there is one at least: as asked for, or as
/// the header names them, or in order.
fn columns(table: &Table, options: &Options) -> Result<(Option<usize>, Vec<usize>), Refusal> {
    let asked =
        options.columns.iter().map(|column| table.column(column)).collect::<Result<Vec<_>, _>>()?;
    let filled: Vec<usize> =
        (0..table.first.len()).filter(|k| !table.first[*k].is_empty()).collect();
    Ok(match (asked.as_slice(), filled.as_slice()) {
        ([time, signal, ..], _) => (Some(*time), vec![*signal]),
        ([signal], _) | ([], [signal]) => (None, vec![*signal]),
        ([], _) => {
            let time = time_column(table, &filled);
            // A count beside the time is no signal, unless there is nothing else.
            let may_be = |k: &usize| !is_counter(&table.start(*k));
            let behind = filled.iter().copied().filter(|k| *k > time);
            let before = filled.iter().copied().filter(|k| *k < time);
            let all: Vec<usize> = behind.chain(before).collect();
            let signals: Vec<usize> = all.iter().copied().filter(may_be).collect();
            let signals = if signals.is_empty() { all } else { signals };
            (Some(time), if signals.is_empty() { vec![time] } else { signals })
        }
    })
}

/// Of several columns, the time's: by its name, or else the first, or the next if the first counts rows and that rises.
fn time_column(table: &Table, filled: &[usize]) -> usize {
    let is_time = |k: &usize| {
        table.above(*k).any(|name| {
            let name = name.to_lowercase();
            let parts = ["time", "zeit", "elapsed", "temps", "tiempo", "timestamp"];
            parts.iter().any(|part| name.contains(part)) || name == "t" || name.starts_with("t ")
        })
    };
    let is_x = |k: &usize| table.above(*k).any(|name| name.eq_ignore_ascii_case("x"));
    let has_unit = |k: &usize| table.above(*k).any(|name| unit_in(name).is_some());
    let named = [&is_time as &dyn Fn(&usize) -> bool, &has_unit, &is_x];
    let found = named.iter().find_map(|is| filled.iter().copied().find(|k| is(k)));
    found.unwrap_or_else(|| {
        let counts = is_counter(&table.start(filled[0]));
        match filled.get(1) {
            Some(second) if counts && filled.len() > 2 && rises(&table.start(*second)) => *second,
            _ => filled[0],
        }
    })
}

/// The steps that an instrument writes beside the names, as `Start` and `Increment`.
fn given_steps(table: &Table, time: Option<usize>) -> Option<Time> {
    let start = table.given("start").or_else(|| table.given("t0"))?;
    let increment = table.given("increment");
    let step = increment.or_else(|| table.given("tinc"))?;
    // A column beside `tInc` holds the times themselves, unless it counts.
    let counts = |time: &usize| increment.is_some() || is_counter(&table.start(*time));
    let column = time.filter(counts);
    let is_step = step > 0.0 && step.is_finite() && start.is_finite();
    (is_step && (column.is_some() || time.is_none())).then_some(Time::Steps { column, start, step })
}
