//! A text as rows of fields: in which form they are, which columns hold numbers, what stands above them.

use super::asked::Column;
use super::names::{Means, Said, is_unit, said, setting};
use super::numbers::{Form, counted_on, is_grouped, short_of};
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

fn filled_lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| !line.trim().is_empty())
}

fn refused(reason: impl Into<String>) -> Refusal {
    Refusal::NotCsv { reason: reason.into() }
}

/// The form in which the largest share of the fields in the file's second half are numbers.
///
/// # Errors
/// Numbers whose marks part decimals or thousands, as one likes.
fn form(text: &str, total: usize) -> Result<Form, Refusal> {
    let half = total - total.div_ceil(2);
    let lines: Vec<&str> = filled_lines(text).skip(half).step_by(total / 2 / LOOKED_AT + 1).collect();
    let (mut form, mut best) = (Form { delimiter: ',', comma: false }, 0.0);
    for other in Form::all() {
        let share = other.fits(&lines);
        if share > best {
            (form, best) = (other, share);
        }
    }
    let fields = || filled_lines(text).skip(half).flat_map(|line| form.split(line)).filter(|field| field.contains(','));
    let is_none = |field: &&str| form.number(field).is_none() && form.number(&field.replace([',', '.'], "")).is_some();
    if let Some(number) = fields().find(is_none) {
        return Err(Refusal::Thousands { number: short_of(number) });
    }
    // Decimals have a `0,1` or a `1,5` somewhere; whole thousands have neither.
    let mut decimals = filled_lines(text).flat_map(|line| form.split(line)).filter(|field| field.contains(','));
    let first = decimals.find(|field| form.number(field).is_some()).filter(|_| form.comma);
    match first {
        Some(number)
            if is_grouped(number, ',') && decimals.all(|it| form.number(it).is_none() || is_grouped(it, ',')) =>
        {
            Err(Refusal::Thousands { number: short_of(number) })
        }
        _ => Ok(form),
    }
}

/// What stands above the rows: a line, and its fields.
type Above<'a> = (&'a str, Vec<String>);

/// The file as rows of fields, and what stands above them.
#[derive(Default)]
pub struct Table<'a> {
    text: &'a str,
    pub form: Form,
    above: Vec<Above<'a>>,
    /// The row of names right above the numbers, and the row of units below it.
    names: [Vec<String>; 2],
    /// So many fields a row has.
    pub width: usize,
    /// Those columns that hold numbers or times of day.
    pub columns: Vec<usize>,
    /// Those of them that hold times of day.
    clocks: Vec<usize>,
    /// Each column's numbers, of the first rows and of some from the whole file.
    pub first: Vec<Vec<f64>>,
    pub spread: Vec<Vec<f64>>,
}

impl<'a> Table<'a> {
    pub fn new(text: &'a str) -> Result<Self, Refusal> {
        if let Some((i, line)) = text.lines().enumerate().find(|(_, line)| line.len() > LONGEST_LINE) {
            let long = format!("line {} is {} bytes long", i + 1, line.len());
            return Err(refused(format!("{long}; each sample needs a line of its own")));
        }
        let total = filled_lines(text).count();
        let form = form(text, total)?;
        let mut table = Self { text, form, ..Self::default() };
        let filled = table.judge(total);
        let lines: Vec<&str> = filled_lines(text).take(LONGEST_HEADER).collect();
        let first = lines.iter().position(|line| table.is_row(line, &filled));
        let Some(first) = first.filter(|_| !table.columns.is_empty()) else { return Err(table.no_rows(total)) };
        let count = first - (0..first).rev().take_while(|line| table.leads(&lines, *line, &filled)).count();
        if table.columns.len() >= LONG_ROW && total - count < LONG_ROW {
            return Err(refused("all values stand in one line; each sample needs a line of its own"));
        }
        table.width = form.split(lines[first]).count();
        table.above = lines[..count].iter().map(|line| (*line, table.fields_above(line))).collect();
        table.names = table.names();
        table.first = table.numbers(1);
        table.spread = table.numbers((total - count).div_ceil(JUDGED));
        Ok(table)
    }

    /// Finds the columns of numbers, and tells for each column whether something stands in most rows. Words count in
    /// the last third alone, which is no header. Empty fields say nothing of a column: it may have been recorded for a
    /// part of the times.
    fn judge(&mut self, total: usize) -> Vec<bool> {
        #[derive(Clone, Default)]
        struct Count {
            numbers: usize,
            clocks: usize,
            words: usize,
            filled: usize,
        }
        let (mut counts, mut rows, mut last) = (Vec::<Count>::new(), 0, 0);
        let lines = filled_lines(self.text).enumerate().step_by(total / JUDGED + 1);
        for (i, line) in lines.filter(|(_, line)| !line.starts_with('#')) {
            let is_last = usize::from(3 * i >= 2 * total);
            (rows, last) = (rows + 1, last + is_last);
            for (k, field) in self.form.split(line).enumerate().filter(|(_, field)| !field.is_empty()) {
                counts.resize(counts.len().max(k + 1), Count::default());
                let count = &mut counts[k];
                count.filled += is_last;
                match self.form.cell(field) {
                    Some(_) => count.numbers += 1,
                    None => count.words += is_last,
                }
                count.clocks += usize::from(self.form.number(field).is_none() && self.form.cell(field).is_some());
            }
        }
        let is_often = |n: usize| 5 * n >= rows || n >= FEW && 20 * n >= rows;
        let holds_numbers = |k: &usize| counts[*k].numbers > counts[*k].words && is_often(counts[*k].numbers);
        self.columns = (0..counts.len()).filter(holds_numbers).collect();
        self.clocks = self.columns.iter().copied().filter(|k| 2 * counts[*k].clocks > counts[*k].numbers).collect();
        counts.iter().map(|count| 2 * count.filled > last).collect()
    }

    /// Does a line have something in no column where most rows have nothing?
    fn is_bare(&self, line: &str, filled: &[bool]) -> bool {
        let is_like =
            |(k, field): (usize, &str)| field.is_empty() || filled.get(k) == Some(&true) || self.columns.contains(&k);
        self.form.split(line).enumerate().all(is_like)
    }

    /// Does a line hold what most rows hold?
    fn is_row(&self, line: &str, filled: &[bool]) -> bool {
        let fields: Vec<&str> = self.form.split(line).collect();
        let field = |k: &usize| fields.get(*k).copied().unwrap_or_default();
        let is_number = |k: &usize| self.form.cell(field(k)).is_some();
        // What stands above the numbers may have some in places, but hardly where the times are.
        let has_first = self.columns.first().is_some_and(is_number);
        let has_others = self.columns.iter().all(|k| is_number(k) || field(k).is_empty());
        !line.starts_with('#') && has_first && has_others && self.is_bare(line, filled)
    }

    /// Does a line above such a row belong to the rows? It may be broken, or have settings where others have nothing,
    /// if its time leads to theirs.
    fn leads(&self, lines: &[&str], line: usize, filled: &[bool]) -> bool {
        let time = |line: usize| self.form.cell(self.form.split(lines.get(line)?).nth(self.columns[0])?);
        let is_step = || {
            let (a, b, c) = (time(line)?, time(line + 1)?, time(line + 2)?);
            Some((2.0 * b - a - c).abs() < 0.1 * (c - b).abs())
        };
        let is_timed = self.columns.len() > 1 && time(line).is_some() && !lines[line].starts_with('#');
        is_timed && (self.is_bare(lines[line], filled) || is_step() == Some(true))
    }

    fn no_rows(&self, total: usize) -> Refusal {
        // A line of the middle shows best what the rows are.
        let line = filled_lines(self.text).nth(total / 2).unwrap_or_default();
        let shown = line.chars().map(|c| if c.is_control() { ' ' } else { c }).take(60);
        let is_labelled = |field: &str| {
            let label = field.split_once([':', '=']).filter(|(label, _)| label.starts_with(char::is_alphabetic));
            label.is_some_and(|(_, number)| self.form.number(number.trim()).is_some())
        };
        let mut fields = line.split([',', ';', '\t', ' ']).filter(|field| !field.is_empty()).peekable();
        let hint = match fields.peek().is_some() && fields.all(is_labelled) {
            true => " (a label before each number: put the labels into a first line instead)",
            false => "",
        };
        refused(format!("there is no row of numbers in it; its middle line is '{}'{hint}", shown.collect::<String>()))
    }

    /// The fields of a line above the rows; what makes it a comment is no part of the first. Of names between blanks, a
    /// unit in brackets belongs to the word before it.
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
        // Names may stand between other marks than the rows; settings are no words between blanks.
        let by = |mark: char| -> Vec<String> { inner.split(mark).map(|field| field.trim().into()).collect() };
        let mut others = [',', ';', '\t'].map(by).into_iter();
        let are_words = self.form.delimiter == ' ' && fields.len() != self.width;
        match others.find(|other| other.len() == self.width && self.columns.len() > 1) {
            Some(other) if are_words || fields.len() == 1 => other,
            None if are_words => by(','),
            _ => fields,
        }
    }

    /// The last line with letters above the rows, if it is as wide as these, as names, or as units below names.
    fn names(&self) -> [Vec<String>; 2] {
        let last = self.columns[self.columns.len() - 1];
        let is_wide = |fields: &[String]| {
            let cells = || self.columns.iter().filter_map(|k| fields.get(*k)).filter(|field| !field.is_empty());
            // Beside a time's name, a channel's may be a number.
            let is_channel = |field: &str| field.len() < 4 && field.bytes().all(|b| b.is_ascii_digit());
            let is_time = cells().next().is_some_and(|first| said(first) == Said::Time);
            let is_name = |field: &String| self.form.cell(field).is_none() || is_time && is_channel(field);
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
        let above = self.above.iter().cloned();
        let beside = self.rows().take(JUDGED).map(|(_, row)| {
            let fields = self.form.split(row).enumerate().filter(|(k, _)| !self.columns.contains(k));
            (row, fields.map(|(_, field)| field.into()).collect::<Vec<String>>())
        });
        let beside = beside.filter(|(_, fields)| fields.iter().any(|field| field.contains(char::is_alphabetic)));
        Settings::new(&above.chain(beside).collect::<Vec<_>>(), self.form)
    }

    /// Is the line a row of names, though not of these columns?
    pub fn names_others(&self, line: &str) -> bool {
        let fields = self.fields_above(line);
        let is_name = |k: &usize| fields.get(*k).is_some_and(|field| field.starts_with(char::is_alphabetic));
        self.columns.len() > 1
            && self.columns.iter().all(|k| is_name(k) && self.form.number(&fields[*k]).is_none())
            && self.columns.iter().any(|k| self.names[0].get(*k) != fields.get(*k))
            && !self.above.iter().any(|(above, _)| *above == line)
    }

    /// The lines from the first row on, each with its number.
    pub fn lines(&self) -> impl Iterator<Item = (u64, &'a str)> {
        let lines = (1..).zip(self.text.lines());
        lines.filter(|(_, line)| !line.trim().is_empty()).skip(self.above.len())
    }

    /// The same without comments.
    pub fn rows(&self) -> impl Iterator<Item = (u64, &'a str)> {
        self.lines().filter(|(_, line)| !line.starts_with('#'))
    }

    /// The numbers in each column, of some rows.
    fn numbers(&self, each: usize) -> Vec<Vec<f64>> {
        let mut numbers = vec![Vec::new(); self.width.max(self.columns[self.columns.len() - 1] + 1)];
        for (_, row) in self.rows().step_by(each.max(1)).take(JUDGED) {
            for (k, (column, field)) in numbers.iter_mut().zip(self.form.split(row)).enumerate() {
                let last = column.last().copied().filter(|_| self.is_clock(k));
                column.extend(self.form.cell(field).map(|x| last.map_or(x, |last| counted_on(x, last))));
            }
        }
        numbers
    }

    /// Does a column hold times of day?
    pub fn is_clock(&self, column: usize) -> bool {
        self.clocks.contains(&column)
    }

    /// A column by its number, from 0, or by its name.
    pub fn column(&self, column: &Column) -> Result<usize, Refusal> {
        let found = match column {
            Column::Number(number) => number.checked_sub(1),
            Column::Name(name) => {
                let wanted = name.to_lowercase();
                let has = |k: &usize| self.name(*k).is_some_and(|n| n.to_lowercase().contains(&wanted));
                let exact = self.names[0].iter().position(|n| n.to_lowercase() == wanted);
                exact.or_else(|| (0..self.width).find(has))
            }
        };
        found
            .filter(|k| *k < self.width)
            .ok_or_else(|| Refusal::NoColumn { name: column.to_string(), there: self.told(0..self.width) })
    }

    /// So many columns, and their names: `2: time_s, v`.
    pub fn told(&self, columns: impl Iterator<Item = usize>) -> String {
        let columns: Vec<usize> = columns.collect();
        let names: Vec<String> = columns.iter().take(12).filter_map(|k| self.name(*k)).collect();
        let more = if columns.len() > 12 { ", …" } else { "" };
        match names.is_empty() {
            true => columns.len().to_string(),
            false => format!("{}: {}{more}", columns.len(), names.join(", ")),
        }
    }

    /// A column's name with its unit, as far as a message can hold it.
    pub fn name(&self, column: usize) -> Option<String> {
        let parts = self.names.iter().filter_map(|row| row.get(column));
        let parts: Vec<&str> = parts.map(String::as_str).filter(|part| !part.is_empty()).collect();
        (!parts.is_empty()).then(|| short_of(&parts.join(" ")))
    }

    /// The first field that is no number in the first row, as a reader of a refusal may need it.
    pub fn text_beside(&self) -> Option<String> {
        let (_, row) = self.rows().next()?;
        let mut fields = self.form.split(row);
        fields.find(|field| !field.is_empty() && self.form.cell(field).is_none()).map(short_of)
    }

    /// A row that may be a value alone with a decimal comma, if all are like that and few whole numbers come before it.
    pub fn decimal(&self) -> Option<String> {
        let alone = Form { delimiter: ';', comma: true };
        let rows: Vec<&str> = self.rows().map(|(_, row)| row).take(JUDGED).collect();
        let mut whole = self.first[0].clone();
        whole.sort_by(f64::total_cmp);
        whole.dedup();
        let is_pair = self.form == Form { delimiter: ',', comma: false } && self.columns == [0, 1];
        let is_one = is_pair && self.names[0].is_empty() && 4 * whole.len() <= rows.len() && alone.fits(&rows) == 1.0;
        is_one.then(|| short_of(rows[0]))
    }

    /// A column's number with the word that stands behind it in a row between blanks, which may be its unit.
    pub fn number_and_word(&self, column: usize) -> Option<String> {
        let mut fields = self.form.split(self.rows().next()?.1).skip(column);
        let (number, word) = (fields.next()?, fields.next()?);
        let is_one = self.form.delimiter == ' ' && word.starts_with(char::is_alphabetic);
        (is_one && self.form.cell(word).is_none()).then(|| short_of(&format!("{number} {word}")))
    }

    pub fn is_named(&self, column: usize, name: &str) -> bool {
        self.names[0].get(column).is_some_and(|it| it == name)
    }

    /// What names a column: its unit, where a row of units has one, or else its name.
    pub fn label(&self, column: usize) -> &str {
        let [name, unit] = [0, 1].map(|row: usize| self.names[row].get(column).map_or("", String::as_str));
        if unit.is_empty() { name } else { unit }
    }
}
