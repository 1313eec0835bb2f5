//! A text as rows of fields: what delimits them, what their decimal mark is, what stands above the numbers.

use super::asked::Column;
use super::numbers::{is_decimal, is_grouped, number, short_of, split, step_in};
use super::told::Refusal;

/// A longer line is no row of samples.
const LONGEST_LINE: usize = 1 << 16;
/// So many lines tell the delimiter.
const LOOKED_AT: usize = 60;
/// What stands above the numbers is shorter than this, in lines.
const LONGEST_HEADER: usize = 500;

fn filled_lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| !line.trim().is_empty())
}

/// What delimits the fields of most lines, and whether their decimal mark is a comma.
fn marks(text: &str) -> Result<(char, bool), Refusal> {
    // From the file's middle, where the numbers are.
    let total = filled_lines(text).count();
    let lines: Vec<&str> = filled_lines(text)
        .skip(total / 2)
        .chain(filled_lines(text))
        .take(LOOKED_AT.min(total))
        .collect();
    let most = |c: char| 2 * lines.iter().filter(|l| l.trim().contains(c)).count() > lines.len();
    let delimiter = match ['\t', ';', ',', ' '].into_iter().find(|c| most(*c)).unwrap_or(',') {
        ',' if are_decimals(&lines) && !is_pair_above(text) && !counts(text) => ';',
        delimiter => delimiter,
    };
    let fields = || lines.iter().flat_map(|line| split(line, delimiter));
    // Without its marks a number is digits, whichever mark is which.
    let is_number = |field: &&str| number(&field.replace([',', '.'], ""), false).is_some();
    let Some(comma) = fields().find(|field| field.contains(',') && is_number(field)) else {
        return Ok((delimiter, false));
    };
    let refused =
        |other: &str| Refusal::Thousands { number: short_of(comma), other: short_of(other) };
    if let Some(point) = fields().find(|field| field.contains('.') && is_number(field)) {
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
    let mut whole: Vec<_> =
        lines.iter().map(|line| line.trim().split_once(',').map(|(whole, _)| whole)).collect();
    whole.sort();
    whole.dedup();
    whole.len() <= lines.len() / 4 && lines.iter().all(|line| is_decimal(line.trim()))
}

/// Are two names above the numbers, with a comma between them?
fn is_pair_above(text: &str) -> bool {
    let above: Vec<&str> = filled_lines(text)
        .take(LONGEST_HEADER)
        .take_while(|line| !is_decimal(line.trim()))
        .collect();
    let last =
        above.last().map(|line| line.split(',').filter(|name| !name.trim().is_empty()).count());
    last == Some(2)
}

/// Do the numbers before the comma only rise, as times do and a pulse does not?
fn counts(text: &str) -> bool {
    let whole = filled_lines(text).filter_map(|line| line.trim().split_once(','));
    let whole: Vec<f64> = whole.filter_map(|(whole, _)| whole.parse().ok()).collect();
    let differ = whole.windows(2).filter(|pair| pair[0] != pair[1]).count();
    differ > 2 && whole.windows(2).all(|pair| pair[0] <= pair[1])
}

/// The file as rows of fields, those before the numbers apart.
pub struct Table<'a> {
    text: &'a str,
    pub delimiter: char,
    pub decimal_comma: bool,
    /// What stands above the numbers.
    header: Vec<Vec<String>>,
    /// The same, line by line.
    pub lines: Vec<&'a str>,
    /// The first row of numbers.
    pub first: Vec<String>,
}

impl<'a> Table<'a> {
    pub fn new(text: &'a str) -> Result<Self, Refusal> {
        for (i, line) in text.lines().enumerate() {
            if line.len() > LONGEST_LINE {
                let reason = format!("line {} is {} bytes long", i + 1, line.len());
                return Err(Refusal::NotCsv { reason });
            }
        }
        let (delimiter, decimal_comma) = marks(text)?;
        let (header, lines) = (Vec::new(), Vec::new());
        let mut table = Self { text, delimiter, decimal_comma, header, lines, first: Vec::new() };
        for line in filled_lines(text).take(LONGEST_HEADER) {
            // What makes a line a comment is no part of its first field.
            let inner = line.trim_start_matches(['#', '%', '/', ';']);
            let inner = if inner.len() < line.len() { inner.trim_start() } else { line };
            let fields: Vec<String> = split(inner, delimiter).map(String::from).collect();
            let is_number = |field: &String| number(field, decimal_comma).is_some();
            let filled = || fields.iter().filter(|field| !field.is_empty());
            if !line.starts_with('#') && filled().count() > 0 && filled().all(is_number) {
                table.first = fields;
                return Ok(table);
            }
            table.header.push(fields);
            table.lines.push(line);
        }
        // A line of the middle shows best what the rows are.
        let count = filled_lines(text).count();
        let shown =
            filled_lines(text).nth(count / 2).map(|line| line.chars().take(60).collect::<String>());
        let shown = shown.unwrap_or_default().replace(|c: char| c.is_control(), " ");
        let reason = format!("there is no row of numbers in it; its middle line is '{shown}'");
        Err(Refusal::NotCsv { reason })
    }

    /// The rows of numbers, each with its line.
    pub fn rows(&self) -> impl Iterator<Item = (u64, &'a str)> {
        let lines = (1..).zip(self.text.lines());
        let lines = lines.filter(|(_, line)| !line.trim().is_empty()).skip(self.lines.len());
        lines.filter(|(_, line)| !line.starts_with('#'))
    }

    /// The first numbers of a column, as many as tell what it holds.
    pub fn start(&self, column: usize) -> Vec<f64> {
        let field = |(_, row): (u64, &'a str)| split(row, self.delimiter).nth(column);
        let numbers = self.rows().take(300).filter_map(field);
        numbers.filter_map(|field| number(field, self.decimal_comma)).collect()
    }

    /// A column by its number, from 0, or by its name.
    pub fn column(&self, column: &Column) -> Result<usize, Refusal> {
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

    /// What stands above a column, the lowest first: in the rows that are as wide as the numbers, since a sentence names no
    /// column. The last two may be wider: some instruments write further settings into them.
    pub fn above(&self, column: usize) -> impl Iterator<Item = &str> {
        let filled = |row: &[String]| row.iter().rposition(|f| !f.is_empty()).map_or(0, |k| k + 1);
        let width = filled(&self.first);
        let is_blank = self.delimiter == ' ';
        let rows = self.header.iter().rev().enumerate();
        let names = rows.filter(move |(k, row)| {
            let there = filled(row);
            there == width || (there > width && *k < 2 && !is_blank)
        });
        names.filter_map(move |(_, row)| row.get(column)).map(String::as_str)
    }

    /// A column's name, as far as a message can hold it; its number otherwise.
    pub fn name(&self, column: usize) -> Option<String> {
        let mut names: Vec<&str> = self
            .above(column)
            .take(2)
            .filter(|name| !name.is_empty() && step_in(name).is_none() && !self.is_value(name))
            .collect();
        names.reverse();
        (!names.is_empty()).then(|| short_of(&names.join(" ")))
    }

    /// Does a field above the numbers hold a setting, a time of day or a sample, and no name? A whole number may be a channel's.
    fn is_value(&self, field: &str) -> bool {
        let last = field.rsplit([':', '=']).next().unwrap_or(field);
        let is_whole = field.chars().all(|c| c.is_ascii_digit());
        !is_whole && number(last.trim(), self.decimal_comma).is_some()
    }

    /// A number that the header gives by a name: in the row below it, or after `=` in the same field.
    pub fn given(&self, name: &str) -> Option<f64> {
        let value = |text: &str| {
            let text = text.trim().trim_end_matches(|c: char| c.is_alphabetic());
            number(text, self.decimal_comma)
        };
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
