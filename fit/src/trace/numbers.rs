//! Fields, and the numbers and times of day that stand in them.

use std::iter::once;

/// What a field holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell {
    Number(f64),
    /// A time of day, in seconds.
    Clock(f64),
    Word,
    Empty,
}

impl Cell {
    pub fn number(self) -> Option<f64> {
        match self {
            Self::Number(x) | Self::Clock(x) => Some(x),
            _ => None,
        }
    }
}

/// What parts a line's fields, and is the decimal mark a comma?
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Form {
    pub delimiter: char,
    pub comma: bool,
}

impl Form {
    /// All, the usual ones first.
    pub fn all() -> impl Iterator<Item = Self> {
        [',', ';', '\t', ' '].into_iter().flat_map(|delimiter| [false, true].map(|comma| Self { delimiter, comma }))
    }

    /// The fields of a line, without blanks and quotes around them. A comma in quotes is none, if they come in pairs:
    /// one that is never closed must not swallow the rest.
    pub fn split(self, line: &str) -> impl Iterator<Item = &str> {
        let Self { delimiter, .. } = self;
        let has_pairs = delimiter == ',' && line.matches('"').count().is_multiple_of(2);
        let mut is_inside = false;
        let fields = line.split(move |c| {
            is_inside ^= c == '"' && has_pairs;
            c == delimiter && !is_inside
        });
        let fields = fields.map(|field| field.trim().trim_matches('"').trim());
        fields.filter(move |field| !(delimiter == ' ' && field.is_empty()))
    }

    /// A number with this decimal mark and no other; NaN and infinities are numbers here.
    pub fn number(self, field: &str) -> Option<f64> {
        match self.comma {
            false => field.parse().ok(),
            true => field.replacen(',', ".", 1).parse().ok().filter(|_| !field.contains('.')),
        }
    }

    pub fn cell(self, field: &str) -> Cell {
        match self.number(field) {
            Some(x) => Cell::Number(x),
            None if field.is_empty() => Cell::Empty,
            None => time_of_day(field).map_or(Cell::Word, Cell::Clock),
        }
    }

    /// The share of the fields in these lines that are numbers or times of day. Few instruments begin a number with
    /// `05`, so that is the half of a decimal.
    pub fn fits<'a>(self, lines: impl Iterator<Item = &'a str>) -> f64 {
        let is_half = |field: &str| field.len() > 1 && field.starts_with('0') && field.as_bytes()[1].is_ascii_digit();
        let is_number = |field: &&&str| match self.cell(field) {
            Cell::Number(_) => !is_half(field),
            cell => matches!(cell, Cell::Clock(_)),
        };
        let fields: Vec<&str> = lines.flat_map(|line| self.split(line)).filter(|field| !field.is_empty()).collect();
        fields.iter().filter(is_number).count() as f64 / fields.len().max(1) as f64
    }
}

/// The seconds since midnight in UTC of a time of day, as `14:06:09.25` or `2026-01-30T14:06:09.25+01:00`. Which day
/// it is does not count: so far from 0, `f64` would not hold a nanosecond.
pub fn time_of_day(field: &str) -> Option<f64> {
    let field = field.trim_matches(['[', ']']);
    let is_date = |text: &str| text.starts_with(|c: char| c.is_ascii_digit()) && !text.contains([':', ' ']);
    let clock = match field.rsplit_once(['T', ' ']) {
        Some((date, clock)) => Some(clock).filter(|_| is_date(date))?,
        None => field,
    };
    let (clock, zone) = clock.split_at(clock.find(['+', '-', 'Z']).unwrap_or(clock.len()));
    // Its clocks are ahead by so many hours and minutes: `+01:00`, `-0530`, `+01`, or none.
    let zone = zone.replace([':', 'Z'], "");
    let ahead: i16 = if zone.is_empty() { 0 } else { format!("{zone:0<5}").parse().ok()? };
    let ahead = f64::from(60 * (ahead / 100) + ahead % 100);
    let mut parts = clock.split(':');
    let mut whole = |end: u8| parts.next()?.parse().ok().filter(|part: &u8| *part < end);
    let (hours, minutes) = (whole(24)?, whole(60)?);
    let seconds = parts.next().filter(|text| text.starts_with(|c: char| c.is_ascii_digit()))?;
    let seconds: f64 = seconds.replacen(',', ".", 1).parse().ok().filter(|seconds| *seconds < 61.0)?;
    parts.next().is_none().then(|| 60.0 * (60.0 * f64::from(hours) + f64::from(minutes) - ahead) + seconds)
}

/// A time of day counted on from the last one: if it runs back by half a day, it is the next day's.
pub fn counted_on(time: f64, last: f64) -> f64 {
    const DAY: f64 = 86_400.0;
    time + DAY * ((last - time) / DAY).max(0.0).round()
}

/// Is it a number whose marks may part its thousands: `1,234` or `12,345,678`?
pub fn is_grouped(field: &str, mark: char) -> bool {
    let mut groups = field.trim_start_matches(['-', '+']).split(mark);
    let first = groups.next().unwrap_or_default();
    let is_first = (1..=3).contains(&first.len()) && !first.starts_with('0');
    let is_group = |group: &str| group.len() == 3 && group.bytes().all(|b| b.is_ascii_digit());
    field.contains(mark) && is_first && first.bytes().all(|b| b.is_ascii_digit()) && groups.all(is_group)
}

/// As much of a field as a message can hold.
pub fn short_of(field: &str) -> String {
    let mut chars = field.chars().map(|c| if c.is_control() { '?' } else { c });
    let start: String = chars.by_ref().take(24).collect();
    start.chars().chain(once(chars.next().map(|_| '…')).flatten()).collect()
}
