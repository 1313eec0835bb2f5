//! What the times of a file's rows are beside numbers: segments that begin anew, values that were rounded, changes of a
//! level that stays in between.

use super::numbers::Cell;
use super::samples::{Trace, median, range};
use super::table::{JUDGED, Table};
use super::told::Warning;

/// A row's sample.
#[derive(Clone, Copy)]
pub struct Sample {
    pub time: f64,
    pub value: f64,
    pub line: u64,
}

/// What is known of a trace's times beside them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Timing {
    /// Of segments one after the other, from when on each is, and how much later that is than it was recorded.
    pub segments: Vec<(f64, f64)>,
    /// The standard error of all times alike, in seconds.
    pub error: f64,
    /// That of every length, as a share of it.
    pub pace: f64,
    /// That of each time, whatever the others'.
    pub each: f64,
}

impl Timing {
    /// By how much later than it was recorded the trace has what is at this time.
    pub(crate) fn later(&self, time: f64) -> f64 {
        self.segments.iter().rev().find(|(from, _)| *from <= time).map_or(0.0, |(_, later)| *later)
    }
}

/// The samples of one column.
pub struct Samples {
    pub trace: Trace,
    pub timing: Timing,
    pub warnings: Vec<Warning>,
}

/// A segment has so many rows at least.
const FEWEST: usize = 16;
/// So many times their length are segments put apart: too far to be each other's dark.
const APART: f64 = 4.0;
/// More than one in so many rows at the time of another is no accident.
const OFTEN: usize = 20;
/// A list of changes becomes so many samples at each end of a level that stays, and so many in the usual one.
const STAYS: usize = 4000;
const USUAL: f64 = 1000.0;

/// Puts segments whose times begin anew one after the other, and tells where they are.
fn apart(rows: &mut [Sample]) -> Vec<(f64, f64)> {
    let (mut starts, mut longest) = (vec![0], 0.0);
    for k in 1..rows.len() {
        let start = starts[starts.len() - 1];
        let length = rows[k - 1].time - rows[start].time;
        longest = f64::max(longest, length);
        let begins =
            rows[k].time < rows[k - 1].time && (-1.0..0.1).contains(&((rows[k].time - rows[start].time) / length));
        if begins && length > 0.0 && k - start >= FEWEST {
            starts.push(k);
        }
    }
    if starts.len() < 2 {
        return Vec::new();
    }
    let (mut segments, n) = (Vec::new(), rows.len());
    let mut end = rows[0].time - APART * longest;
    for (i, start) in starts.iter().enumerate() {
        let part = &mut rows[*start..starts.get(i + 1).copied().unwrap_or(n)];
        let later = if i == 0 { 0.0 } else { end + APART * longest - part[0].time };
        part.iter_mut().for_each(|row| row.time += later);
        segments.push((part[0].time - 0.5 * APART * longest, later));
        end = part.iter().map(|row| row.time).fold(end, f64::max);
    }
    segments
}

/// Spreads the times of a steady clock that were rounded: to which step, with what is left unknown.
fn spread(rows: &mut [Sample]) -> Option<(f64, Timing)> {
    let n = rows.len();
    let steps = || rows.windows(2).map(|pair| pair[1].time - pair[0].time);
    let again = || rows.windows(2).filter(|pair| pair[1].time == pair[0].time);
    let differ = again().filter(|pair| pair[1].value != pair[0].value).count();
    // Without repeated times there are two steps that differ by one of the rounding.
    let (least, most) = range(steps());
    let rounding = most - least;
    let near = |to: f64| steps().filter(|step| (step - to).abs() < 0.1 * rounding).count() * OFTEN;
    let is_two = near(least) > n && near(most) > n && near(least) + near(most) + OFTEN >= (n - 1) * OFTEN;
    let is_repeated = again().count() * OFTEN > n && differ * OFTEN > again().count();
    if n < FEWEST || !(is_repeated || least > 0.0 && is_two && rounding > 1e-3 * most) {
        return None;
    }
    // The step of the rounding around each row: digits may become fewer on the way.
    let mut around = vec![0.0; n];
    let changes: Vec<usize> = (1..n).filter(|k| rows[*k].time > rows[k - 1].time).collect();
    for (i, k) in changes.iter().enumerate() {
        let step = if least > 0.0 { rounding } else { rows[*k].time - rows[k - 1].time };
        let from = if i > 0 { changes[i - 1] } else { 0 };
        let to = changes.get(i + 1).copied().unwrap_or(n);
        around[from..to].iter_mut().for_each(|around| *around = f64::max(*around, step));
    }
    // The line through the times, by weights.
    let weighted = |of: &dyn Fn(usize) -> f64| (0..n).map(|k| of(k) / around[k].powi(2)).sum::<f64>();
    let all = weighted(&|_| 1.0);
    let (middle, time) = (weighted(&|k| k as f64) / all, weighted(&|k| rows[k].time) / all);
    let off = |k: usize| k as f64 - middle;
    let squares = weighted(&|k| off(k).powi(2));
    let step = weighted(&|k| off(k) * (rows[k].time - time)) / squares;
    let at = |k: usize| time + step * off(k);
    let is_line = (0..n).all(|k| (rows[k].time - at(k)).abs() <= 0.8 * around[k]);
    if !is_line || step.is_nan() || step <= 0.0 {
        return None;
    }
    let usual = median(around.clone());
    let groups = (changes.len() + 1) as f64;
    let pace = usual / (step * n as f64 * groups.sqrt());
    (0..n).for_each(|k| rows[k].time = at(k));
    Some((usual, Timing { error: usual / 12f64.sqrt(), pace, ..Timing::default() }))
}

/// Do rows come in blocks of evenly spaced samples with uneven pauses between them, as where a clock stamps each block?
/// So many rows are a block, and the pauses tell the clock's standard error.
fn stamped(rows: &[Sample]) -> Option<(usize, f64)> {
    let steps: Vec<f64> = rows.windows(2).map(|pair| pair[1].time - pair[0].time).collect();
    let usual = if steps.len() > FEWEST { median(steps.clone()) } else { return None };
    let breaks: Vec<usize> = (0..steps.len()).filter(|k| (steps[*k] / usual - 1.0).abs() > 0.1).collect();
    let lengths: Vec<usize> = breaks.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let pauses = breaks.iter().map(|k| steps[*k]);
    let n = breaks.len() as f64;
    let mean = pauses.clone().sum::<f64>() / n;
    let scatter = (pauses.map(|pause| (pause - mean).powi(2)).sum::<f64>() / n).sqrt();
    let length = *lengths.first()?;
    let alike = lengths.iter().filter(|other| **other == length).count();
    let is_one = lengths.len() >= 4 && length >= 4 && 10 * alike >= 8 * lengths.len() && scatter > 0.1 * usual;
    is_one.then_some((length, scatter / 2f64.sqrt()))
}

/// The samples in order, those of the same time averaged, and what is known of the times, which may be those of
/// changes.
pub fn ordered(mut rows: Vec<Sample>, are_changes: bool, mut warnings: Vec<Warning>) -> Samples {
    let mut timing = Timing { segments: apart(&mut rows), ..Timing::default() };
    if let Some(pair) = rows.windows(2).find(|pair| pair[1].time < pair[0].time) {
        warnings.push(Warning::Unsorted { line: pair[1].line });
        rows.sort_by(|a, b| a.time.total_cmp(&b.time));
    } else if let (Some((to, spread)), true) = (spread(&mut rows), timing.segments.is_empty()) {
        warnings.push(Warning::RoundedTimes { to });
        timing = spread;
    } else if let Some((rows, error)) = stamped(&rows).filter(|_| !are_changes) {
        warnings.push(Warning::StampedBlocks { rows, error });
        timing.each = error;
    }
    let again = || rows.windows(2).filter(|pair| pair[0].time == pair[1].time);
    if let Some(pair) = again().next() {
        warnings.push(Warning::Duplicates { count: again().count(), line: pair[1].line });
    }
    let mean = |same: &[Sample]| same.iter().map(|row| row.value).sum::<f64>() / same.len() as f64;
    let same = rows.chunk_by(|a, b| a.time == b.time);
    let (times, values) = same.map(|same| (same[0].time, mean(same))).unzip();
    let trace = Trace { times, values };
    Samples { trace, timing, warnings }
}

/// Does nearly every row tell a change of columns that have two values, at uneven times? A value may be unknown, and
/// the last row cut.
pub fn lists_changes(table: &Table, time: usize) -> bool {
    let others: Vec<usize> = table.columns.iter().copied().filter(|k| *k != time).collect();
    let levels = table.rows.iter().map(|row| others.iter().map(|k| row.cell(*k)).collect::<Vec<Cell>>());
    let rows = levels.take(JUDGED).filter(|row| row.iter().any(|cell| *cell != Cell::Empty)).collect::<Vec<_>>();
    let is_switch = |k: usize| {
        let levels = || rows.iter().filter_map(|row| row[k].number());
        let (low, high) = range(levels());
        levels().all(|level| level == low || level == high)
    };
    let n = rows.len();
    let times = table.first(time);
    let (least, most) = range(times[..n.min(times.len())].windows(2).map(|pair| pair[1] - pair[0]));
    let changes = rows.windows(2).filter(|pair| pair[0] != pair[1]).count() + 1;
    n > 2
        && !others.is_empty()
        && (0..others.len()).all(is_switch)
        && least > 0.0
        && most > 1.5 * least
        && 10 * changes >= 9 * n
}

/// A list of changes as samples of levels that stay in between, unless they are NaN: where they stay for long, at both
/// ends alone.
pub fn staying(changes: &[Sample]) -> Vec<Sample> {
    let lengths: Vec<f64> = changes.windows(2).map(|pair| pair[1].time - pair[0].time).collect();
    if lengths.is_empty() {
        return Vec::new();
    }
    let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min);
    let step = (2.0 * shortest / USUAL).max(median(lengths.clone()) / USUAL);
    let stays = STAYS.min(100_000 / lengths.len() + 20);
    let last = stays as f64 * step;
    let mut samples = Vec::new();
    let known = changes.iter().zip(lengths.iter().copied().chain([last])).filter(|(change, _)| !change.value.is_nan());
    for (change, length) in known {
        let mut add = |since: f64| samples.push(Sample { time: change.time + since, ..*change });
        let count = (length / step).round().max(1.0);
        if count <= 2.0 * stays as f64 {
            (0..count as usize).for_each(|k| add((k as f64 + 0.5) * length / count));
        } else {
            (0..stays).for_each(|k| add((k as f64 + 0.5) * step));
            (0..stays).rev().for_each(|k| add(length - (k as f64 + 0.5) * step));
        }
    }
    samples
}
