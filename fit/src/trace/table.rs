//! A text as rows of cells: in which form they are, which columns hold numbers, what stands above them.

use super::heads::Heads;
use super::names::{Means, is_unit, said, setting};
use super::numbers::{Cell, Form, counted_on, is_grouped, short_of};
use super::settings::Settings;
use super::told::Refusal;

/// So many lines tell the form, and so many rows what a column holds.
const LOOKED_AT: usize = 40;
pub const JUDGED: usize = 300;
/// A column of numbers has so many at least, or has them in most rows.
const FEW: usize = 8;
/// Of fewer lines than this one that is longer than so many bytes is no row of samples.
const LONG_ROW: (usize, usize) = (100, 4096);

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
    pub cells: Vec<Cell>,
}

impl Line<'_> {
    fn is_remark(&self) -> bool {
        self.text.starts_with('#')
    }

    /// What stands in a column.
    pub fn cell(&self, column: usize) -> Cell {
        self.cells.get(column).copied().unwrap_or(Cell::Empty)
    }
}

/// The file as rows of cells, and what stands above them.
#[derive(Default)]
pub struct Table<'a> {
    pub form: Form,
    pub heads: Heads,
    above: Vec<(&'a str, Vec<String>)>,
    /// The lines from the first row to the last, and the remarks between them.
    pub rows: Vec<Line<'a>>,
    remarks: Vec<Line<'a>>,
    /// Those columns that hold numbers or times of day.
    pub columns: Vec<usize>,
    /// Those of them that hold times of day: they count in seconds from the first one.
    pub clocks: Vec<usize>,
}

impl<'a> Table<'a> {
    pub fn new(text: &'a str) -> Result<Self, Refusal> {
        let filled = || (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty());
        let lines: Vec<&str> = filled().map(|(_, line)| line).collect();
        if lines.len() < LONG_ROW.0 && lines.iter().any(|line| line.len() > LONG_ROW.1) {
            return Err(refused("all values stand in one line; each sample needs a line of its own"));
        }
        let form = form(&lines)?;
        let cells = |line| form.split(line).map(|field| form.cell(field)).collect();
        let rows = filled().map(|(number, text)| Line { number, text, cells: cells(text) }).collect();
        let mut table = Self { form, rows, ..Self::default() };
        let usual = table.judge();
        let first = table.rows.iter().position(|line| table.is_row(line, &usual));
        let first = first.ok_or_else(|| table.no_rows())?;
        let above = first - (0..first).rev().take_while(|line| table.leads(*line, &usual) == Some(true)).count();
        table.heads.width = table.rows[first].cells.len();
        let above = table.rows.drain(..above).map(|line| line.text);
        table.above = above.collect::<Vec<_>>().into_iter().map(|text| (text, table.fields_above(text))).collect();
        table.heads.names = table.names();
        let is_row = |line: &Line| line.cell(table.columns[0]).number().is_some();
        table.rows.truncate(table.rows.iter().rposition(is_row).map_or(0, |last| last + 1));
        (table.remarks, table.rows) = table.rows.into_iter().partition(Line::is_remark);
        table.count_days();
        Ok(table)
    }

    /// What stands in a column, as it is written.
    pub fn field(&self, line: &Line<'a>, column: usize) -> &'a str {
        self.form.split(line.text).nth(column).unwrap_or_default()
    }

    /// Finds the columns of numbers, and tells for each column whether something stands in most rows. Words count in
    /// the last third alone, which is no header. Empty fields say nothing of a column: it may have been recorded for a
    /// part of the times.
    fn judge(&mut self) -> Vec<bool> {
        // Of each column the numbers, the times of day among them, the last third's words, and all of that third.
        let mut counts = Vec::<[usize; 4]>::new();
        let lines = self.rows.iter().filter(|line| !line.is_remark()).count();
        for (i, line) in self.rows.iter().filter(|line| !line.is_remark()).enumerate() {
            counts.resize(counts.len().max(line.cells.len()), [0; 4]);
            for (count, cell) in counts.iter_mut().zip(&line.cells) {
                let (is_last, is_clock) = (3 * i >= 2 * lines, matches!(cell, Cell::Clock(_)));
                let is_number = cell.number().is_some();
                let is = [is_number, is_clock, is_last && *cell == Cell::Word, is_last && *cell != Cell::Empty];
                (0..4).for_each(|k| count[k] += usize::from(is[k]));
            }
        }
        let is_often = |n: usize| 5 * n >= lines || n >= FEW && 20 * n >= lines;
        let holds_numbers = |k: &usize| counts[*k][0] > counts[*k][2] && is_often(counts[*k][0]);
        self.columns = (0..counts.len()).filter(holds_numbers).collect();
        self.clocks = self.columns.iter().copied().filter(|k| 2 * counts[*k][1] > counts[*k][0]).collect();
        counts.iter().map(|count| 6 * count[3] > lines).collect()
    }

    /// Does a line hold something in no column where most rows have nothing?
    fn is_bare(&self, line: &Line, usual: &[bool]) -> bool {
        let is_usual = |k: usize| usual[k] || self.columns.binary_search(&k).is_ok();
        !line.is_remark() && (0..line.cells.len()).all(|k| line.cells[k] == Cell::Empty || is_usual(k))
    }

    /// Does a line hold what most rows hold? What stands above them may have some numbers in places, but hardly where
    /// the times are.
    fn is_row(&self, line: &Line, usual: &[bool]) -> bool {
        let is_number = |k: &usize| line.cell(*k).number().is_some();
        let has_others = self.columns.iter().all(|k| is_number(k) || line.cell(*k) == Cell::Empty);
        self.is_bare(line, usual) && self.columns.first().is_some_and(is_number) && has_others
    }

    /// Does a line above such a row belong to the rows? It may be broken, or have settings where others have nothing,
    /// if its time leads to theirs.
    fn leads(&self, line: usize, usual: &[bool]) -> Option<bool> {
        let time = |line: usize| self.rows.get(line)?.cell(self.columns[0]).number();
        let (a, b, c) = (time(line)?, time(line + 1)?, time(line + 2)?);
        let is_step = (2.0 * b - a - c).abs() < 0.1 * (c - b).abs();
        Some(self.columns.len() > 1 && (is_step || self.is_bare(&self.rows[line], usual)))
    }

    fn no_rows(&self) -> Refusal {
        // A line of the middle shows best what the rows are.
        let line = self.rows.get(self.rows.len() / 2).map_or("", |line| line.text);
        let shown: String = line.chars().map(|c| if c.is_control() { ' ' } else { c }).take(60).collect();
        refused(format!(
            "there is no row of numbers in it, without a label or a unit beside each; its middle line is '{shown}'"
        ))
    }

    /// Times of day become seconds since the first one.
    fn count_days(&mut self) {
        for k in &self.clocks {
            let (mut first, mut last) = (None, 0.0);
            for cell in self.rows.iter_mut().filter_map(|row| row.cells.get_mut(*k)) {
                *cell = match *cell {
                    Cell::Clock(x) => {
                        last = counted_on(x - *first.get_or_insert(x), last);
                        Cell::Number(last)
                    }
                    Cell::Number(_) => Cell::Word,
                    other => other,
                };
            }
        }
    }

    /// The fields of a line above the rows; what makes it a comment is no part of the first. Of names between blanks, a
    /// unit in brackets belongs to the word before it; settings are no words between blanks.
    fn fields_above(&self, line: &str) -> Vec<String> {
        const REMARK: [char; 4] = ['#', '%', '/', ';'];
        let inner = line.strip_prefix(REMARK).map_or(line, |rest| rest.trim_start_matches(REMARK).trim_start());
        if self.form.delimiter != ' ' {
            return self.form.split(inner).map(String::from).collect();
        }
        let joined = inner.replace(" (", "\u{a0}(").replace(" [", "\u{a0}[");
        let names: Vec<String> = self.form.split(&joined).map(|name| name.replace('\u{a0}', " ")).collect();
        match names.len() == self.heads.width {
            true => names,
            false => inner.split(',').map(|field| field.trim().into()).collect(),
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
        let last_lines = self.above.iter().rev().filter(|(line, _)| line.contains(char::is_alphabetic));
        let mut lines = told.into_iter().chain(last_lines);
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
        let beside = self.rows.iter().take(JUDGED).map(|row| {
            let fields = self.form.split(row.text).enumerate().filter(|(k, _)| !self.columns.contains(k));
            (row.text, fields.map(|(_, field)| field.into()).collect::<Vec<String>>())
        });
        let beside = beside.filter(|(_, fields)| fields.iter().any(|field| field.contains(char::is_alphabetic)));
        Settings::new(&self.above.iter().cloned().chain(beside).collect::<Vec<_>>(), self.form)
    }

    /// # Errors
    /// Words between the rows, where another recording may begin: those that are not above the rows as well, and all
    /// where rows are counted. There an empty line is a word as well, if not all rows are so far apart.
    pub fn is_one(&self, are_counted: bool) -> Result<(), Refusal> {
        let has_number = |line: &Line, k: &usize| line.cell(*k).number().is_some();
        let is_above = |line: &Line| self.above.iter().any(|(above, _)| *above == line.text);
        let begins = |line: &&Line| match are_counted {
            true => !has_number(line, &self.columns[0]),
            false => !self.columns.iter().any(|k| has_number(line, k)) && !is_above(line),
        };
        // A mark or a quote may stand before a word.
        let words = |line: &Line<'a>| line.text.trim_start_matches(|c: char| !c.is_alphanumeric());
        let is_text = |line: &&Line<'a>| line.is_remark() || words(line).starts_with(char::is_alphabetic);
        if let Some(line) = self.remarks.iter().chain(&self.rows).filter(is_text).find(begins) {
            return Err(Refusal::Blocks { line: line.number, text: short_of(line.text) });
        }
        let mut steps = self.rows.windows(2).map(|pair| (pair[0].number, pair[1].number - pair[0].number));
        let usual = steps.clone().next().map(|(_, step)| step);
        match steps.find(|(_, step)| are_counted && Some(*step) != usual) {
            Some((row, _)) => Err(Refusal::Blocks { line: row + 1, text: String::new() }),
            None => Ok(()),
        }
    }

    fn numbers(&self, column: usize, each: usize) -> Vec<f64> {
        let rows = self.rows.iter().step_by(each.max(1)).take(JUDGED);
        rows.filter_map(|row| row.cell(column).number()).collect()
    }

    /// A column's numbers in the first rows.
    pub fn first(&self, column: usize) -> Vec<f64> {
        self.numbers(column, 1)
    }

    /// A column's numbers in some rows of the whole file.
    pub fn spread(&self, column: usize) -> Vec<f64> {
        self.numbers(column, self.rows.len().div_ceil(JUDGED))
    }

    /// The first word in the first row, as a reader of a refusal may need it.
    pub fn text_beside(&self) -> Option<&'a str> {
        let row = self.rows.first()?;
        let k = row.cells.iter().position(|cell| *cell == Cell::Word)?;
        Some(self.field(row, k))
    }

    /// A whole number, and behind its comma what may be its fraction.
    pub fn cut(&self, column: usize) -> Option<String> {
        let may_be = |row: &Line<'a>| {
            let next = self.field(row, column + 1);
            next.starts_with(|c: char| c.is_ascii_digit()) && !next.contains('.') && !row.text.contains(", ")
        };
        let is_whole = self.form.delimiter == ',' && self.first(column).iter().all(|x| x.fract() == 0.0);
        let first = self.rows.first().filter(|_| is_whole && self.rows.iter().take(JUDGED).all(may_be));
        first.map(|row| short_of(row.text))
    }
}
