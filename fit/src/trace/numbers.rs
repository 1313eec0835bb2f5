//! Fields, and the numbers that stand in them.

use std::iter::once;

/// The fields of a line, without blanks and quotes around them. A quote that is never closed must not swallow the rest
/// of the file: so quotes count only where a line has them in pairs.
pub fn split(line: &str, delimiter: char) -> impl Iterator<Item = &str> {
    let quotes = if delimiter == ',' { line.matches('"').count() } else { 0 };
    let is_quoted = quotes > 0 && quotes.is_multiple_of(2);
    let mut rest = Some(line.trim_end_matches(['\r', '\n']));
    let fields = std::iter::from_fn(move || {
        let line = rest?;
        let from = match line.trim_start().strip_prefix('"').filter(|_| is_quoted) {
            Some(inside) => line.len() - inside.len() + inside.find('"').unwrap_or(0),
            None => 0,
        };
        let end = line[from..].find(delimiter).map(|k| from + k);
        rest = end.map(|k| &line[k + delimiter.len_utf8()..]);
        Some(&line[..end.unwrap_or(line.len())])
    });
    let blank = delimiter == ' ';
    let fields = fields.map(|field| field.trim().trim_matches('"').trim());
    fields.filter(move |field| !(blank && field.is_empty()))
}

/// What parts thousands and nothing else: blanks that do not break (the last as another encoding's), and apostrophes.
pub const THOUSANDS: [char; 5] = ['\u{a0}', '\u{202f}', char::REPLACEMENT_CHARACTER, '\'', '’'];

/// A number with a decimal point, or a decimal comma where that is said; NaN and infinities are numbers here. Below
/// zero with either minus, or in an accountant's brackets; a sign may stand apart.
pub fn number(field: &str, comma: bool) -> Option<f64> {
    let with_point = (comma && field.contains(',')).then(|| field.replacen(',', ".", 1));
    let field = with_point.as_deref().unwrap_or(field);
    let other = || {
        let brackets = field.strip_prefix('(').and_then(|rest| rest.strip_suffix(')'));
        let below = brackets.or_else(|| field.strip_prefix(['-', '\u{2212}', '\u{2013}']));
        let size = below.unwrap_or(field.strip_prefix('+').unwrap_or(field)).trim_start();
        let size = size.starts_with(|c: char| c.is_ascii_digit() || c == '.').then_some(size)?;
        let is_parted = is_grouped(&size.replace(THOUSANDS, ","));
        let joined = if is_parted { size.replace(THOUSANDS, "") } else { size.into() };
        let size: f64 = joined.parse().ok()?;
        Some(if below.is_some() { -size } else { size })
    };
    field.parse().ok().or_else(other).or_else(|| overload(field))
}

/// The signs by which an instrument says that a signal is too large for it.
fn overload(field: &str) -> Option<f64> {
    let (sign, size) = match field.strip_prefix('-') {
        Some(size) => (-1.0, size),
        None => (1.0, field.strip_prefix('+').unwrap_or(field)),
    };
    let is_sign =
        ["∞", "1.#inf", "1.#inf00", "ol", "ovl", "overload", "overflow"].contains(&size.to_lowercase().as_str());
    is_sign.then_some(sign * f64::INFINITY)
}

/// Is it a number with a decimal comma?
pub fn is_decimal(field: &str) -> bool {
    let is_part = |(_, part): (&str, &str)| part.starts_with(|c: char| c.is_ascii_digit());
    field.split_once(',').is_some_and(is_part) && !field.contains('.') && number(field, true).is_some()
}

/// Is it a number whose commas may part its thousands: `1,234` or `12,345,678.9`?
pub fn is_grouped(field: &str) -> bool {
    let whole = field.trim_start_matches(['-', '+']);
    let whole = whole.split_once('.').map_or(whole, |(whole, _)| whole);
    let mut groups = whole.split(',');
    let digits = |group: &str| group.bytes().all(|b| b.is_ascii_digit());
    let first = groups.next().unwrap_or_default();
    let mut more = groups.peekable();
    (1..=3).contains(&first.len())
        && digits(first)
        && !first.starts_with('0')
        && more.peek().is_some()
        && more.all(|group| group.len() == 3 && digits(group))
}

/// As much of a field as a message can hold.
pub fn short_of(field: &str) -> String {
    let mut chars = field.chars().map(|c| if c.is_control() { '?' } else { c });
    let start: String = chars.by_ref().take(24).collect();
    let more = chars.next().map(|_| '…');
    start.chars().chain(once(more).flatten()).collect()
}
