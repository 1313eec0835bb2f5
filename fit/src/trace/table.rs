//! A text as rows of cells: in which form they are, which columns hold numbers, what stands above them.

use std::ops::Range;

use super::heads::Heads;
use super::names::{Means, is_unit, said, setting, unit_of};
use super::numbers::{Cell, Form, counted_on, is_grouped, short_of};
use super::settings::Settings;
use super::told::Refusal;

/// A longer line is no row of samples.
const LONGEST_LINE: usize = 1 << 16;
/// So many lines tell the form, and so many rows what a column holds.
const LOOKED_AT: usize = 40;
pub const JUDGED: usize = 300;
/// A column of numbers has so many at least, or has them in most rows.
const FEW: usize = 8;
/// What stands above the numbers is shorter than this, in lines.
const LONGEST_HEADER: usize = 500;
/// With so many numbers in a line, and fewer lines than this, the lines are columns.
const LONG_ROW: usize = 16;

fn refused(reason: impl Into<String>) -> Refusal {
    Refusal::NotCsv { reason: reason.into() }
}

/// The form in which the largest share of the fields in the file's second half are numbers.
///
/// # Errors
/// Numbers whose marks part decimals or thousands, as one likes.
fn form<'a>(lines: &[&'a str]) -> Result<Form, Refusal> {
    let half = &lines[lines.len() / 2..];
    let few = || half.iter().copied().step_by(lines.len() / 2 / LOOKED_AT + 1);
    let scored = Form::all().map(|form| (form.fits(few()), form));
    let best = scored.reduce(|best, other| if other.0 > best.0 { other } else { best });
    let form = best.map_or(Form::default(), |(_, form)| form);

    let marked = |lines: &[&'a str]| -> Vec<&'a str> {
        lines.iter().flat_map(|line| form.split(line)).filter(|field| field.contains(',')).collect()
    };
    let is_unread =
        |field: &&&str| form.number(field).is_none() && form.number(&field.replace([',', '.'], "")).is_some();
    // Decimals have a `0,1` or a `1,5` somewhere; whole thousands have neither.
    let mut decimals = marked(lines);
    decimals.retain(|field| form.number(field).is_some());
    let grouped = decimals.first().filter(|_| decimals.iter().all(|field| is_grouped(field, ',')));
    match marked(half).iter().find(is_unread).or(grouped) {
        Some(number) => Err(Refusal::Thousands { number: short_of(number) }),
        None => Ok(form),
    }
}

/// A line that is not empty.
pub struct Line<'a> {
    pub number: u64,
    pub text: &'a str,
    cells: Range<usize>,
}

impl Line<'_> {
    pub fn is_remark(&self) -> bool {
        self.text.starts_with('#')
    }
}

/// The file as rows of cells, and what stands above them.
#[derive(Default)]
pub struct Table<'a> {
    pub form: Form,
    pub heads: Heads,
    above: Vec<(&'a str, Vec<String>)>,
    /// The lines from the first row on.
    pub lines: Vec<Line<'a>>,
    cells: Vec<Cell>,
    /// Those columns that hold numbers or times of day.
    pub columns: Vec<usize>,
    /// Those of them that hold times of day: they count in seconds from the first one.
    clocks: Vec<usize>,
}

impl<'a> Table<'a> {
    pub fn new(text: &'a str) -> Result<Self, Refusal> {
        let filled = || (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty());
        if let Some((number, line)) = filled().find(|(_, line)| line.len() > LONGEST_LINE) {
            let long = format!("line {number} is {} bytes long", line.len());
            return Err(refused(format!("{long}; each sample needs a line of its own")));
        }
        let form = form(&filled().map(|(_, line)| line).collect::<Vec<_>>())?;
        let mut table = Self { form, ..Self::default() };
        for (number, text) in filled() {
            let start = table.cells.len();
            table.cells.extend(form.split(text).map(|field| form.cell(field)));
            table.lines.push(Line { number, text, cells: start..table.cells.len() });
        }
        let usual = table.judge();
        let total = table.lines.len();
        let first = (0..total.min(LONGEST_HEADER)).find(|line| table.is_row(*line, &usual));
        let Some(first) = first else { return Err(table.no_rows()) };
        let above = first - (0..first).rev().take_while(|line| table.leads(*line, &usual)).count();
        if table.columns.len() >= LONG_ROW && total - above < LONG_ROW {
            return Err(refused("all values stand in one line; each sample needs a line of its own"));
        }
        table.heads.width = table.lines[first].cells.len();
        let above: Vec<Line> = table.lines.drain(..above).collect();
        table.above = above.iter().map(|line| (line.text, table.fields_above(line.text))).collect();
        table.heads.names = table.names();
        table.count_days();
        Ok(table)
    }

    fn cells(&self, line: &Line) -> &[Cell] {
        &self.cells[line.cells.clone()]
    }

    /// What a line has in a column.
    pub fn cell(&self, line: &Line, column: usize) -> Cell {
        self.cells(line).get(column).copied().unwrap_or(Cell::Empty)
    }

    /// The same as it is written.
    pub fn field(&self, line: &Line<'a>, column: usize) -> &'a str {
        self.form.split(line.text).nth(column).unwrap_or_default()
    }

    /// Finds the columns of numbers, and tells for each column whether something stands in most rows. Words count in
    /// the last third alone, which is no header. Empty fields say nothing of a column: it may have been recorded for a
    /// part of the times.
    fn judge(&mut self) -> Vec<bool> {
        // Of each column the numbers, the times of day among them, the last third's words, and all of that third.
        let (mut counts, mut rows, mut last) = (Vec::<[usize; 4]>::new(), 0, 0);
        for (i, line) in self.lines.iter().enumerate().filter(|(_, line)| !line.is_remark()) {
            let is_last = usize::from(3 * i >= 2 * self.lines.len());
            (rows, last) = (rows + 1, last + is_last);
            counts.resize(counts.len().max(line.cells.len()), [0; 4]);
            for (count, cell) in counts.iter_mut().zip(self.cells(line)) {
                let more = match cell {
                    Cell::Number(_) => [1, 0, 0, is_last],
                    Cell::Clock(_) => [1, 1, 0, is_last],
                    Cell::Word => [0, 0, is_last, is_last],
                    Cell::Empty => continue,
                };
                (0..4).for_each(|k| count[k] += more[k]);
            }
        }
        let is_often = |n: usize| 5 * n >= rows || n >= FEW && 20 * n >= rows;
        let holds_numbers = |k: &usize| counts[*k][0] > counts[*k][2] && is_often(counts[*k][0]);
        self.columns = (0..counts.len()).filter(holds_numbers).collect();
        self.clocks = self.columns.iter().copied().filter(|k| 2 * counts[*k][1] > counts[*k][0]).collect();
        counts.iter().map(|count| 2 * count[3] > last).collect()
    }

    /// Does a line have something in no column where most rows have nothing?
    fn is_bare(&self, line: usize, usual: &[bool]) -> bool {
        let mut cells = self.cells(&self.lines[line]).iter().enumerate();
        cells.all(|(k, cell)| *cell == Cell::Empty || usual[k] || self.columns.contains(&k))
    }

    /// Does a line hold what most rows hold?
    fn is_row(&self, line: usize, usual: &[bool]) -> bool {
        let row = &self.lines[line];
        let is_number = |k: &usize| self.cell(row, *k).number().is_some();
        // What stands above the numbers may have some in places, but hardly where the times are.
        let has_first = self.columns.first().is_some_and(is_number);
        let has_others = self.columns.iter().all(|k| is_number(k) || self.cell(row, *k) == Cell::Empty);
        !row.is_remark() && has_first && has_others && self.is_bare(line, usual)
    }

    /// Does a line above such a row belong to the rows? It may be broken, or have settings where others have nothing,
    /// if its time leads to theirs.
    fn leads(&self, line: usize, usual: &[bool]) -> bool {
        let time = |line: usize| self.cell(self.lines.get(line)?, self.columns[0]).number();
        let is_step = || {
            let (a, b, c) = (time(line)?, time(line + 1)?, time(line + 2)?);
            Some((2.0 * b - a - c).abs() < 0.1 * (c - b).abs())
        };
        let is_timed = self.columns.len() > 1 && time(line).is_some() && !self.lines[line].is_remark();
        is_timed && (self.is_bare(line, usual) || is_step() == Some(true))
    }

    fn no_rows(&self) -> Refusal {
        // A line of the middle shows best what the rows are.
        let line = self.lines.get(self.lines.len() / 2).map_or("", |line| line.text);
        let shown: String = line.chars().map(|c| if c.is_control() { ' ' } else { c }).take(60).collect();
        refused(format!(
            "there is no row of numbers in it, without a label or a unit beside each; its middle line is '{shown}'"
        ))
    }

    /// Times of day become seconds since the first one; in other columns they are words.
    fn count_days(&mut self) {
        let mut since: Vec<Option<(f64, f64)>> = vec![None; self.clocks.len()];
        for line in self.lines.iter().filter(|line| !line.is_remark()) {
            for (k, cell) in self.cells[line.cells.clone()].iter_mut().enumerate() {
                let clock = self.clocks.iter().position(|clock| *clock == k);
                *cell = match (*cell, clock) {
                    (Cell::Clock(x), Some(clock)) => {
                        let (first, last) = since[clock].unwrap_or((x, 0.0));
                        let time = counted_on(x - first, last);
                        since[clock] = Some((first, time));
                        Cell::Number(time)
                    }
                    (Cell::Clock(_), None) | (Cell::Number(_), Some(_)) => Cell::Word,
                    (other, _) => other,
                };
            }
        }
    }

    /// The fields of a line above the rows; what makes it a comment is no part of the first. Of names between blanks, a
    /// unit in brackets belongs to the word before it; settings are no words between blanks.
    fn fields_above(&self, line: &str) -> Vec<String> {
        let inner = line.trim_start_matches(['#', '%', '/', ';']).trim_start();
        let inner = if inner.len() < line.len() { inner } else { line };
        let mut fields: Vec<String> = Vec::new();
        for field in self.form.split(inner) {
            match fields.last_mut() {
                Some(last) if self.form.delimiter == ' ' && field.starts_with(['(', '[']) => {
                    *last += &format!(" {field}")
                }
                _ => fields.push(field.into()),
            }
        }
        match self.form.delimiter == ' ' && fields.len() != self.heads.width {
            true => inner.split(',').map(|field| field.trim().into()).collect(),
            false => fields,
        }
    }

    /// The last line with letters above the rows, if it is as wide as these, as names, or as units below names.
    fn names(&self) -> [Vec<String>; 2] {
        let last = self.columns[self.columns.len() - 1];
        let is_wide = |fields: &[String]| {
            let cells = || self.columns.iter().filter_map(|k| fields.get(*k)).filter(|field| !field.is_empty());
            // Beside a time's name, a channel's may be a number.
            let is_channel = |field: &str| field.len() < 4 && field.bytes().all(|b| b.is_ascii_digit());
            let is_time = cells().next().is_some_and(|first| said(first) == Some(Means::Time));
            let is_name = |field: &String| self.form.cell(field) == Cell::Word || is_time && is_channel(field);
            let is_setting = setting(&fields[0]).is_some_and(|means| means != Means::Names);
            fields.len() > last && 2 * cells().count() > self.columns.len() && cells().all(is_name) && !is_setting
        };
        let told = self.above.iter().find(|(_, fields)| setting(&fields[0]) == Some(Means::Names));
        if let Some((_, fields)) = told.filter(|(_, fields)| is_wide(fields)) {
            return [fields.clone(), Vec::new()];
        }
        let mut lines = self.above.iter().rev().filter(|(line, _)| line.contains(char::is_alphabetic));
        let mut next = || lines.next().map(|(_, fields)| fields.clone()).filter(|fields| is_wide(fields));
        let Some(lowest) = next() else { return Default::default() };
        let is_units = |fields: &[String]| self.columns.iter().all(|k| fields[*k].is_empty() || is_unit(&fields[*k]));
        match is_units(&lowest) && self.columns.len() > 1 {
            true => [next().unwrap_or_default(), lowest],
            false => [lowest, Vec::new()],
        }
    }

    /// What the lines above the rows say of the times, and what stands beside the first rows where others have nothing.
    pub fn settings(&self) -> Settings {
        let beside = self.rows().take(JUDGED).map(|row| {
            let fields = self.form.split(row.text).enumerate().filter(|(k, _)| !self.columns.contains(k));
            (row.text, fields.map(|(_, field)| field.into()).collect::<Vec<String>>())
        });
        let beside = beside.filter(|(_, fields)| fields.iter().any(|field| field.contains(char::is_alphabetic)));
        Settings::new(&self.above.iter().cloned().chain(beside).collect::<Vec<_>>(), self.form)
    }

    /// # Errors
    /// Another recording begins between the rows: with a remark or a word where they are counted, and elsewhere with
    /// names of other columns.
    pub fn is_one(&self, are_counted: bool) -> Result<(), Refusal> {
        let is_row = |line: &Line| self.cell(line, self.columns[0]).number().is_some();
        let begins = |line: &&Line| {
            let is_word = line.text.starts_with(char::is_alphabetic) && self.cell(line, 0) == Cell::Word;
            let fields = || self.fields_above(line.text);
            let is_name = |field: &String| field.starts_with(char::is_alphabetic) && self.form.number(field).is_none();
            let names_others = |fields: Vec<String>| {
                self.columns.iter().all(|k| fields.get(*k).is_some_and(is_name))
                    && self.columns.iter().any(|k| self.heads.names[0].get(*k) != fields.get(*k))
                    && !self.above.iter().any(|(above, _)| *above == line.text)
            };
            !is_row(line)
                && (are_counted && (line.is_remark() || is_word) || self.columns.len() > 1 && names_others(fields()))
        };
        let last = self.lines.iter().rposition(is_row).unwrap_or(0);
        match self.lines[..last].iter().skip(1).find(begins) {
            Some(line) => Err(Refusal::Blocks { line: line.number, text: short_of(line.text) }),
            None => Ok(()),
        }
    }

    /// The lines that are no comments.
    pub fn rows(&self) -> impl Iterator<Item = &Line<'a>> {
        self.lines.iter().filter(|line| !line.is_remark())
    }

    fn numbers(&self, column: usize, each: usize) -> Vec<f64> {
        let rows = self.rows().step_by(each.max(1)).take(JUDGED);
        rows.filter_map(|row| self.cell(row, column).number()).collect()
    }

    /// A column's numbers in the first rows.
    pub fn first(&self, column: usize) -> Vec<f64> {
        self.numbers(column, 1)
    }

    /// A column's numbers in some rows of the whole file.
    pub fn spread(&self, column: usize) -> Vec<f64> {
        self.numbers(column, self.lines.len().div_ceil(JUDGED))
    }

    /// Does a column hold times of day?
    pub fn is_clock(&self, column: usize) -> bool {
        self.clocks.contains(&column)
    }

    /// The first word in the first row, as a reader of a refusal may need it.
    pub fn text_beside(&self) -> Option<&'a str> {
        let row = self.rows().next()?;
        let k = self.cells(row).iter().position(|cell| *cell == Cell::Word)?;
        Some(self.field(row, k))
    }

    /// A row that may be a value alone with a decimal comma, if all are like that and few whole numbers come before it.
    pub fn decimal(&self) -> Option<String> {
        let alone = Form { delimiter: ';', comma: true };
        let is_pair = self.form == Form { delimiter: ',', comma: false } && self.columns == [0, 1];
        let mut whole = self.first(0);
        let count = whole.len();
        whole.sort_by(f64::total_cmp);
        whole.dedup();
        let texts = || self.rows().map(|row| row.text).take(JUDGED);
        let is_one =
            is_pair && self.heads.names[0].is_empty() && 4 * whole.len() <= count && alone.fits(texts()) == 1.0;
        texts().next().filter(|_| is_one).map(short_of)
    }

    /// A time of day in whole seconds, and behind its comma what may be their fraction: as many digits in each row.
    pub fn cut_second(&self, column: usize) -> Option<String> {
        let of = |row: &Line<'a>| {
            let [clock, next] = [0, 1].map(|k| self.field(row, column + k));
            let end = next.find(|c: char| !c.is_ascii_digit()).unwrap_or(next.len());
            let has_point = clock.find(':').is_some_and(|at| clock[at..].contains('.'));
            let is_cut = self.form.delimiter == ',' && end > 2 && !has_point && !next[end..].starts_with('.');
            is_cut.then(|| (end, format!("{clock},{next}")))
        };
        let (digits, first) = of(self.rows().next()?)?;
        let is_same = |row| of(row).is_some_and(|(end, _)| end == digits);
        self.rows().take(JUDGED).all(is_same).then(|| short_of(&first))
    }

    /// A column's number with the unit that stands behind it.
    pub fn number_and_unit(&self, column: usize) -> Option<String> {
        let row = self.rows().next()?;
        let [number, word] = [0, 1].map(|k| self.field(row, column + k));
        unit_of(word).map(|_| short_of(&format!("{number} {word}")))
    }
}
