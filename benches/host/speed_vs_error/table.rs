//! The tables of the report, and those that longer runs have left in `docs`.

use std::collections::HashMap;

use crate::Result;

/// A figure as one reads it.
pub fn number(x: f64) -> String {
    match x.abs() {
        _ if !x.is_finite() => "∞".into(),
        0.0 => "0".into(),
        ..0.01 | 1e6.. => {
            let text = format!("{x:.1e}");
            let (digits, exponent) = text.split_once('e').expect("an exponent");
            format!("{digits}·10<sup>{exponent}</sup>")
        }
        ..0.1 => format!("{x:.3}"),
        ..10.0 => format!("{x:.2}"),
        ..100.0 => format!("{x:.1}"),
        _ => format!("{x:.0}"),
    }
}

/// A table in Markdown, its columns' names between bars: so many columns of text, the others of figures.
pub fn table(header: &str, texts: usize, rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let header = format!("| {header} |");
    let figures = header.matches('|').count() - 1 - texts;
    let ruled = format!("|{}{}", "---|".repeat(texts), "---:|".repeat(figures));
    let rows = rows.into_iter().map(|row| format!("\n| {} |", row.join(" | ")));
    format!("{header}\n{ruled}{}", rows.collect::<String>())
}

/// A row of a table that another run left, by the columns' names.
pub type Row = HashMap<String, String>;

pub fn read(path: &str) -> Result<Vec<Row>> {
    Ok(csv::Reader::from_path(path)?.into_deserialize().collect::<Result<_, _>>()?)
}

/// These columns of it as one reads them: whole numbers and text as they are, and a dash for nothing.
pub fn shown(row: &Row, columns: &str) -> Vec<String> {
    let columns = columns.split(' ').map(|column| match row[column].as_str() {
        "" => "-".into(),
        text if text.parse::<u64>().is_ok() => text.into(),
        text => text.parse().map_or_else(|_| text.into(), number),
    });
    columns.collect()
}
