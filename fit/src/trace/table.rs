//! A text as rows of fields: what delimits them, what their decimal mark is, which columns hold numbers, what stands
//! above them.

use super::asked::Column;
use super::names::{has, is_axis, is_time, is_unit, words};
use super::numbers::{THOUSANDS, is_decimal, is_grouped, number, short_of, split};
use super::settings::{Settings, is_setting};
use super::told::Refusal;

/// A longer line is no row of samples.
const LONGEST_LINE: usize = 1 << 16;
/// So many lines tell the delimiter.
const LOOKED_AT: usize = 60;
/// What stands above the numbers is shorter than this, in lines.
const LONGEST_HEADER: usize = 500;
/// So many rows tell what a column holds.
const JUDGED: usize = 300;

fn filled_lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| !line.trim().is_empty())
}

/// What delimits the fields of most lines, and whether their decimal mark is a comma.
fn marks(text: &str) -> Result<(char, bool), Refusal> {
    // From the file's middle, where the numbers are.
    let total = filled_lines(text).count();
    let lines: Vec<&str> =
        filled_lines(text).skip(total / 2).chain(filled_lines(text)).take(LOOKED_AT.min(total)).collect();
    let most = |c: char| 2 * lines.iter().filter(|l| l.trim().contains(c)).count() > lines.len();
    let delimiter = match ['\t', ';', ',', ' '].into_iter().find(|c| most(*c)).unwrap_or(',') {
        ',' if are_decimals(&lines) && !is_pair_above(text) && !counts(text) => ';',
        delimiter => delimiter,
    };
    if delimiter == ',' && lines.iter().filter(|line| is_in_halves(line)).count() > lines.len() / 2 {
        let line = short_of(lines[0]);
        let reason =
            format!("'{line}' has commas between its columns and in its numbers; part the columns by semicolons");
        return Err(Refusal::NotCsv { reason });
    }
    let fields = || lines.iter().flat_map(|line| split(line, delimiter));
    // Without its marks a number is digits, whichever mark is which.
    let is_mark = |c: char| matches!(c, ',' | '.') || THOUSANDS.contains(&c);
    let is_number = |field: &&str| number(&field.replace(is_mark, ""), false).is_some();
    let Some(comma) = fields().find(|field| field.contains(',') && is_number(field)) else {
        return Ok((delimiter, false));
    };
    let refused = |other: &str| Refusal::Thousands { number: short_of(comma), other: short_of(other) };
    // A date has two points.
    let has_point = |field: &&str| field.matches('.').count() == 1 || field.contains(',');
    if let Some(point) = fields().find(|field| field.contains('.') && has_point(field) && is_number(field)) {
        return Err(refused(point));
    }
    // Decimals have a `0,1` or a `1,5` somewhere; whole thousands have neither.
    let all = || filled_lines(text).flat_map(|line| split(line, delimiter));
    let marked = || all().filter(|field| field.contains(',') && is_number(field));
    if marked().all(is_grouped) {
        return Err(refused(comma));
    }
    Ok((delimiter, true))
}

/// Is each line a value alone with a decimal comma? It looks like two columns, but the first one's few numbers tell.
fn are_decimals(lines: &[&str]) -> bool {
    let mut whole: Vec<_> = lines.iter().map(|line| line.trim().split_once(',').map(|(whole, _)| whole)).collect();
    whole.sort();
    whole.dedup();
    whole.len() <= lines.len() / 4 && lines.iter().all(|line| is_decimal(line.trim()))
}

/// Is it a row whose commas part its columns and its decimals alike, as in `0,00001,0,05`? Such a half begins with a 0.
fn is_in_halves(line: &str) -> bool {
    let fields: Vec<&str> = line.trim().split(',').collect();
    let digits = |field: &&str| field.trim_start_matches('-').bytes().all(|b| b.is_ascii_digit());
    let is_half = |field: &&str| field.len() > 1 && field.starts_with('0');
    fields.len() > 2
        && fields.len().is_multiple_of(2)
        && fields.iter().all(digits)
        && fields.iter().skip(1).step_by(2).any(is_half)
}

/// Are two names above the numbers, with a comma between them?
fn is_pair_above(text: &str) -> bool {
    let above: Vec<&str> =
        filled_lines(text).take(LONGEST_HEADER).take_while(|line| !is_decimal(line.trim())).collect();
    let last = above.last().map(|line| line.split(',').filter(|name| !name.trim().is_empty()).count());
    last == Some(2)
}

/// Do the numbers before the comma only rise, as times do and a pulse does not?
fn counts(text: &str) -> bool {
    let whole = filled_lines(text).filter_map(|line| line.trim().split_once(','));
    let whole: Vec<f64> = whole.filter_map(|(whole, _)| whole.parse().ok()).collect();
    let differ = whole.windows(2).filter(|pair| pair[0] != pair[1]).count();
    differ > 2 && whole.windows(2).all(|pair| pair[0] <= pair[1])
}

/// What a field holds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Holds {
    Number,
    Nothing,
    Word,
    Other,
}

/// What stands above the rows: a line, and its fields.
type Above<'a> = (&'a str, Vec<String>);

/// The file as rows of fields, and what stands above them.
pub struct Table<'a> {
    text: &'a str,
    pub delimiter: char,
    pub decimal_comma: bool,
    above: Vec<Above<'a>>,
    /// The last row of names above the numbers, and the row of units below it.
    names: [Vec<String>; 2],
    /// So many fields a row has.
    pub width: usize,
    /// Those columns that hold numbers in most rows.
    pub columns: Vec<usize>,
    /// Each column's numbers, of the first rows and of some from the whole file.
    pub first: Vec<Vec<f64>>,
    pub spread: Vec<Vec<f64>>,
}

impl<'a> Table<'a> {
    pub fn new(text: &'a str) -> Result<Self, Refusal> {
        for (i, line) in text.lines().enumerate() {
            if line.len() > LONGEST_LINE {
                let json = if line.starts_with(['{', '[']) { ", as JSON is" } else { "" };
                let reason = format!("line {} is {} bytes long{json}", i + 1, line.len());
                return Err(Refusal::NotCsv { reason });
            }
        }
        let (delimiter, decimal_comma) = marks(text)?;
        let mut table = Self {
            text,
            delimiter,
            decimal_comma,
            above: Vec::new(),
            names: Default::default(),
            width: 0,
            columns: Vec::new(),
            first: Vec::new(),
            spread: Vec::new(),
        };
        let total = filled_lines(text).count();
        let most = table.judge(total);
        let is_number = |k: &usize| most[*k] == Some(Holds::Number);
        table.columns = (0..most.len()).filter(is_number).collect();
        let lines: Vec<&str> = filled_lines(text).take(LONGEST_HEADER).collect();
        let Some(first) = lines.iter().position(|line| table.is_row(line, &most)) else {
            return Err(table.no_rows(total));
        };
        if table.columns.is_empty() {
            return Err(table.no_rows(total));
        }
        let mut count = table.without_header(&lines, first, &most);
        // Below the names may be how many rows follow.
        let counts = |line: usize| table.counts(lines[line], total - count);
        count += usize::from(count + 1 < lines.len() && counts(count) && !counts(count + 1));
        table.above = lines[..count].iter().map(|line| (*line, table.fields_above(line))).collect();
        table.width = split(lines[first], delimiter).count();
        table.names = table.names();
        table.first = table.numbers(1, JUDGED);
        table.spread = table.numbers((total - count).div_ceil(JUDGED), JUDGED);
        Ok(table)
    }

    /// What most rows of the file's last third hold in each column, if most hold the same.
    fn judge(&self, total: usize) -> Vec<Option<Holds>> {
        let last = total - total.div_ceil(3);
        let lines = filled_lines(self.text).skip(last).step_by(total / 3 / JUDGED + 1);
        let (mut counts, mut rows) = (Vec::<[usize; 4]>::new(), 0);
        for line in lines.filter(|line| !line.starts_with('#')) {
            rows += 1;
            for (k, field) in split(line, self.delimiter).enumerate() {
                if counts.len() == k {
                    counts.push([0; 4]);
                }
                counts[k][self.holds(field) as usize] += 1;
            }
        }
        let most = |count: &[usize; 4]| {
            let is_most = |holds: &Holds| 2 * count[*holds as usize] > rows;
            let is_empty = 2 * (rows - count.iter().sum::<usize>()) > rows;
            let all = [Holds::Number, Holds::Nothing, Holds::Word, Holds::Other];
            all.into_iter().find(is_most).or(is_empty.then_some(Holds::Nothing))
        };
        counts.iter().map(most).collect()
    }

    fn holds(&self, field: &str) -> Holds {
        match field.chars().next() {
            None => Holds::Nothing,
            Some(_) if number(field, self.decimal_comma).is_some() => Holds::Number,
            Some(first) if first.is_alphabetic() => Holds::Word,
            Some(_) => Holds::Other,
        }
    }

    /// Does the line hold in each column what most rows hold there? A number may stand where mostly nothing does.
    fn is_row(&self, line: &str, most: &[Option<Holds>]) -> bool {
        let mut fields = split(line, self.delimiter);
        let is_like = |most: &Option<Holds>| {
            let holds = self.holds(fields.next().unwrap_or_default());
            most.is_none_or(|most| holds == most || (most, holds) == (Holds::Nothing, Holds::Number))
        };
        !line.starts_with('#') && most.iter().all(is_like)
    }

    /// How many lines are above the rows, where this is the first whole one: rows before it may be broken, or have
    /// settings where others have nothing, if their times lead to it.
    fn without_header(&self, lines: &[&str], first: usize, most: &[Option<Holds>]) -> usize {
        let time = |line: usize| {
            let line = lines.get(line).copied().unwrap_or_default();
            split(line, self.delimiter).nth(self.columns[0]).unwrap_or_default()
        };
        let value = |line| number(time(line), self.decimal_comma);
        let leads = |line: usize| {
            let times = (value(line), value(line + 1), value(line + 2));
            let (Some(a), Some(b), Some(c)) = times else { return false };
            (2.0 * b - a - c).abs() < 0.1 * (c - b).abs()
        };
        let is_word = |c: char| c.is_alphabetic() && !matches!(c, 'e' | 'E');
        let is_row = |line: &usize| {
            let held: Vec<Holds> = split(lines[*line], self.delimiter).map(|field| self.holds(field)).collect();
            let is_bare =
                |(held, most): (&Holds, &Option<Holds>)| *most != Some(Holds::Nothing) || *held == Holds::Nothing;
            let time = time(*line);
            !time.is_empty()
                && !time.contains(is_word)
                && self.columns.iter().any(|k| held.get(*k) == Some(&Holds::Number))
                && (held.iter().zip(most).all(is_bare) || leads(*line))
        };
        first - (0..first).rev().take_while(|line| self.columns.len() > 1 && is_row(line)).count()
    }

    /// Is each of its numbers, to a hundredth, how many rows there are?
    fn counts(&self, line: &str, rows: usize) -> bool {
        let mut fields = split(line, self.delimiter);
        let is_count = |x: f64| (x / rows as f64 - 1.0).abs() < 0.01;
        fields.all(|field| number(field, self.decimal_comma).is_none_or(is_count))
    }

    fn no_rows(&self, total: usize) -> Refusal {
        // A line of the middle shows best what the rows are.
        let line = filled_lines(self.text).nth(total / 2).unwrap_or_default();
        let shown = line.chars().map(|c| if c.is_control() { ' ' } else { c }).take(60);
        let shown: String = shown.collect();
        let reason = format!("there is no row of numbers in it; its middle line is '{shown}'");
        Refusal::NotCsv { reason }
    }

    /// The fields of a line above the rows; what makes it a comment is no part of the first. Of names between blanks, a
    /// unit in brackets belongs to the word before it.
    fn fields_above(&self, line: &str) -> Vec<String> {
        let inner = line.trim_start_matches(['#', '%', '/', ';']);
        let inner = if inner.len() < line.len() { inner.trim_start() } else { line };
        let mut fields: Vec<String> = Vec::new();
        for field in split(inner, self.delimiter) {
            match fields.last_mut() {
                Some(last) if self.delimiter == ' ' && field.starts_with(['(', '[']) => {
                    *last += " ";
                    *last += field;
                }
                _ => fields.push(field.into()),
            }
        }
        // Names may be aligned by blanks, or parted by another mark than the rows are.
        let by = |mark: &str| -> Vec<String> {
            let fields = inner.split(mark).map(str::trim).filter(|field| !field.is_empty());
            fields.map(String::from).collect()
        };
        let marks = ["  ", "\t", ";", ","].into_iter().filter(|m| *m != "," || !self.decimal_comma);
        let is_one = fields.len() == 1 && self.columns.len() > 1;
        let mut others = marks.filter(|_| is_one).map(by);
        others.find(|others| others.len() == self.columns.len()).unwrap_or(fields)
    }

    /// The lowest line above the rows that is as wide as these, as names, or as units below names.
    fn names(&self) -> [Vec<String>; 2] {
        let last = self.columns[self.columns.len() - 1];
        let is_wide = |fields: &[String]| {
            let filled = self.columns.iter().filter(|k| fields.get(**k).is_some_and(|f| !f.is_empty()));
            let is_whole = self.delimiter != ' ' || fields.len() == self.width;
            fields.len() > last && 2 * filled.count() > self.columns.len() && is_whole
        };
        let is_units = |fields: &[String]| {
            self.columns.len() > 1 && self.columns.iter().all(|k| fields[*k].is_empty() || is_unit(&fields[*k]))
        };
        // Names that are told to be some.
        let is_told =
            |(_, fields): &&Above| has("tracename channeltitle", &words(&fields[0]).concat()) && is_wide(fields);
        if let Some((_, fields)) = self.above.iter().find(is_told) {
            return [fields.clone(), Vec::new()];
        }
        let has_words = |line: &str| line.contains(char::is_alphabetic);
        let is_it = |(line, fields): &Above| has_words(line) && is_wide(fields);
        let Some(lowest) = self.above.iter().rposition(is_it) else {
            return Default::default();
        };
        let row = |k: usize| self.above[k].1.clone();
        if !is_units(&row(lowest)) {
            let names = row(lowest);
            return [if self.is_setting(&names) { Vec::new() } else { names }, Vec::new()];
        }
        let above = lowest.checked_sub(1).map(row).filter(|names| is_wide(names));
        [above.unwrap_or_default(), row(lowest)]
    }

    /// Is the line a setting with its value, and no row of names? A channel's number may be a name beside a time's.
    fn is_setting(&self, fields: &[String]) -> bool {
        let first = fields[self.columns[0]].as_str();
        let before_brackets = first.split(['(', '[']).next().unwrap_or_default();
        let behind_mark = before_brackets.rsplit_once(['=', ':']).map(|(_, behind)| behind);
        let is_number = |field: &str| number(field, self.decimal_comma).is_some();
        let is_channel = |field: &str| field.len() < 4 && field.bytes().all(|b| b.is_ascii_digit());
        let is_date = |field: &str| field.starts_with(|c: char| c.is_ascii_digit()) && field.contains([':', '/']);
        let is_measure = |field: &str| {
            let number = field.trim_end_matches(|c: char| c.is_alphabetic() || c == '%').trim_end();
            number.len() < field.len() && is_number(number)
        };
        let is_value = |field: &String| {
            let may_be = (is_time(first) || is_axis(first)) && is_channel(field);
            !may_be && (is_number(field) || is_date(field) || is_measure(field))
        };
        let is_setting_before = self.columns[0] > 0 && is_setting(&fields[0]);
        is_setting_before || fields.iter().any(is_value) || behind_mark.is_some_and(|name| !is_time(name))
    }

    /// What the lines above the rows say of the times.
    pub fn settings(&self) -> Settings {
        let whole = |line: &str| vec![line.trim_start_matches(['#', '%', '/', ';']).trim().to_string()];
        let lines = self.above.iter().map(|(line, fields)| match self.delimiter {
            ' ' => (*line, whole(line)),
            _ => (*line, fields.clone()),
        });
        // Settings may stand beside the first rows, where others have nothing.
        let beside = self.rows().take(JUDGED).map(|(_, row)| {
            let fields = split(row, self.delimiter).enumerate();
            let others = fields.filter(|(k, _)| !self.columns.contains(k));
            (row, others.map(|(_, field)| field.into()).collect())
        });
        let has_words = |(_, fields): &Above| fields.iter().any(|field| field.contains(char::is_alphabetic));
        Settings::new(&lines.chain(beside.filter(has_words)).collect::<Vec<_>>(), self.decimal_comma)
    }

    /// Is the line a row of names, though not of these columns?
    pub fn names_others(&self, line: &str) -> bool {
        let fields = self.fields_above(line);
        let is_name = |k: &usize| fields.get(*k).is_some_and(|field| self.holds(field) == Holds::Word);
        self.columns.len() > 1
            && self.columns.iter().all(is_name)
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

    /// The numbers in each column, of so many rows.
    fn numbers(&self, each: usize, most: usize) -> Vec<Vec<f64>> {
        let mut numbers = vec![Vec::new(); self.width.max(self.columns[self.columns.len() - 1] + 1)];
        for (_, row) in self.rows().step_by(each.max(1)).take(most) {
            for (column, field) in numbers.iter_mut().zip(split(row, self.delimiter)) {
                column.extend(number(field, self.decimal_comma));
            }
        }
        numbers
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
        let is_text = |field: &&str| !field.is_empty() && number(field, self.decimal_comma).is_none();
        split(row, self.delimiter).find(is_text).map(short_of)
    }

    /// What names a column, and what stands below that as its unit.
    pub fn labels(&self, column: usize) -> [&str; 2] {
        [0, 1].map(|row| self.names[row].get(column).map_or("", String::as_str))
    }
}
