//! Writes data files: whole tables and the points of figures as CSV.

use super::rows::{Column, Table};
use crate::value::{Digits, Number, Provenance};
use std::borrow::Cow;

impl DataFile {
    /// Makes the file of a table, with every bit of each number, and a column for each error.
    pub(crate) fn from_table(table: &Table) -> Self {
        let (mut header, mut rows) = (Vec::new(), vec![Vec::new(); table.rows.len()]);
        for (index, Column { name, unit }) in table.columns.iter().enumerate() {
            let mut cells = table.rows.iter().map(|(_, cells)| &cells[index]);
            let error = cells.any(|cell| matches!(cell.kind, Provenance::Ensemble { .. }));
            header.push(format!("{name} ({unit})"));
            header.extend(error.then(|| format!("{name}_error ({unit})")));
            for (row, (_, cells)) in rows.iter_mut().zip(&table.rows) {
                row.push(to_cell(&cells[index].number));
                row.extend(error.then(|| match cells[index].kind {
                    Provenance::Ensemble { standard_error, .. } => format!("{standard_error:?}"),
                    _ => String::new(),
                }));
            }
        }
        DataFile { name: Self::file_name(table.name()), header, rows }
    }

    pub(crate) fn file_name(table: &str) -> String {
        format!("{}.csv", table.replace('.', "-"))
    }

    /// Writes the file: comma separated, one line a row, each ended by a line feed.
    pub fn to_csv(&self) -> String {
        let mut csv = String::new();
        for line in [&self.header].into_iter().chain(&self.rows) {
            for (index, cell) in line.iter().enumerate() {
                csv.push_str(if index > 0 { "," } else { "" });
                csv.push_str(&quoted(cell));
            }
            csv.push('\n');
        }
        csv
    }
}

fn to_cell(number: &Number) -> String {
    match number {
        Number::None => String::new(),
        Number::Integer(n) => n.to_string(),
        Number::Real { digits: Digits::Text(text), .. } => text.to_string(),
        Number::Real { value, .. } => format!("{value:?}"),
        Number::Text(words) => words.clone(),
    }
}

/// A data file, as text.
#[derive(Clone, Debug, PartialEq)]
pub struct DataFile {
    /// File name, such as `fig09a.csv`.
    pub name: String,
    /// Column names with units, such as `sigma (d omega^2)`; 1 stands for a pure number.
    pub header: Vec<String>,
    /// The cells of each row.
    pub rows: Vec<Vec<String>>,
}

fn quoted(cell: &str) -> Cow<'_, str> {
    if cell.bytes().any(|byte| matches!(byte, b',' | b'"' | b'\n')) {
        format!("\"{}\"", cell.replace('"', "\"\"")).into()
    } else {
        cell.into()
    }
}

/// Formats a number for files: the shortest decimal that reads back to the same double.
pub fn shortest(value: f64) -> String {
    let debug = format!("{value:?}");
    debug.strip_suffix(".0").map(String::from).unwrap_or(debug)
}
