//! The first lines of a file as a table, so that whoever reads it can say which column is which.

use serde::Serialize;

use super::bytes::decode;
use super::table::Table;
use super::told::Refusal;
use super::wav;

/// What a file begins with.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Preview {
    /// The columns' names, as far as they have some; there are as many as columns.
    pub names: Vec<Option<String>>,
    /// The first rows of numbers as they are written, each with its line.
    pub rows: Vec<(u64, Vec<String>)>,
}

/// The first rows of the table in a file's bytes, so many of them; none of a WAV, which has no lines.
///
/// # Errors
/// What is no table of numbers.
pub fn preview(bytes: &[u8], rows: usize) -> Result<Preview, Refusal> {
    if wav::is_wav(bytes) {
        return Ok(Preview { names: Vec::new(), rows: Vec::new() });
    }
    let text = decode(bytes)?;
    let table = Table::new(&text)?;
    let names: Vec<_> = (0..table.width).map(|column| table.name(column)).collect();
    // Of a field, what a narrow column can show.
    let field = |field: &str| field.chars().take(24).collect();
    let row = |(line, row)| (line, table.form.split(row).take(names.len()).map(field).collect());
    let rows = table.rows().take(rows).map(row).collect();
    Ok(Preview { names, rows })
}
