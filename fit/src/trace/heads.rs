//! The columns of a table, or the channels of a sound: their names, and which are asked for.

use super::asked::Options;
use super::numbers::short_of;
use super::told::Refusal;

#[derive(Default)]
pub struct Heads {
    pub width: usize,
    /// A row of names, and a row of units below it.
    pub names: [Vec<String>; 2],
}

impl Heads {
    /// A column's name with its unit, as far as a message can hold it.
    pub fn name(&self, column: usize) -> Option<String> {
        let parts = self.names.iter().filter_map(|row| row.get(column));
        let parts: Vec<&str> = parts.map(String::as_str).filter(|part| !part.is_empty()).collect();
        (!parts.is_empty()).then(|| short_of(&parts.join(" ")))
    }

    /// What names a column: its unit, where a row of units has one, or else its name.
    pub fn label(&self, column: usize) -> &str {
        let mut parts = self.names.iter().rev().filter_map(|row| row.get(column));
        parts.find(|part| !part.is_empty()).map_or("", String::as_str)
    }

    /// Its number, from 1, and its name: `2, "CH1"`.
    pub fn quoted(&self, k: usize) -> String {
        self.name(k).map_or((k + 1).to_string(), |name| format!("{}, \"{name}\"", k + 1))
    }

    /// So many columns, and their names: `2: time_s, v`.
    pub fn told(&self, columns: &[usize]) -> String {
        let names: Vec<String> = columns.iter().take(12).filter_map(|k| self.name(*k)).collect();
        let more = if columns.len() > 12 { ", …" } else { "" };
        match names.is_empty() {
            true => columns.len().to_string(),
            false => format!("{}: {}{more}", columns.len(), names.join(", ")),
        }
    }

    /// A column by its number, or by its name.
    fn column(&self, column: &str) -> Result<usize, Refusal> {
        let wanted = column.trim().to_ascii_lowercase();
        let found = match wanted.parse::<usize>() {
            Ok(number) => number.checked_sub(1),
            Err(_) => {
                let has = |k: &usize| self.name(*k).is_some_and(|n| n.to_ascii_lowercase().contains(&wanted));
                let exact = self.names[0].iter().position(|n| n.to_ascii_lowercase() == wanted);
                exact.or_else(|| (0..self.width).find(has))
            }
        };
        let there = || self.told(&(0..self.width).collect::<Vec<_>>());
        let found = found.filter(|k| *k < self.width);
        found.ok_or_else(|| Refusal::NoColumn { name: column.into(), there: there() })
    }

    /// The columns that are asked for, and the sync's, which is none of these.
    pub fn asked(&self, options: &Options) -> Result<(Vec<usize>, Option<usize>), Refusal> {
        let asked = options.columns.iter().map(|column| self.column(column)).collect::<Result<Vec<_>, _>>()?;
        let Some(column) = &options.sync else { return Ok((asked, None)) };
        let named = self.names[0].iter().position(|name| name == column);
        let reason = match (self.column(column), named) {
            (Err(refusal), _) => format!("{refusal}; a time has a unit, as in 1.5ms, and a file has to be there"),
            // A number may be a name as well.
            (Ok(k), Some(named)) if named != k => format!(
                "'{column}' is the number of column {}, and the name of column {}; give the whole name",
                self.quoted(k),
                self.quoted(named)
            ),
            (Ok(k), _) if asked.contains(&k) => format!("column {} is the signal's", self.quoted(k)),
            (Ok(k), _) => return Ok((asked, Some(k))),
        };
        Err(Refusal::NoDelay { reason })
    }
}
