//! Writes the cells of a table as data files have them.

use super::rows::{Column, Table};
use crate::value::{Kind, Number};

impl Table {
    /// Returns names of columns with units, and the cells as data files write them: every bit of
    /// each number, and a further column for each standard error.
    pub fn data(&self) -> (Vec<String>, Vec<Vec<String>>) {
        let (mut header, mut rows) = (Vec::new(), vec![Vec::new(); self.rows.len()]);
        for (at, Column { name, unit }) in self.columns.iter().enumerate() {
            let mut cells = self.rows.iter().map(|(_, cells)| &cells[at]);
            let error = cells.any(|cell| matches!(cell.kind, Kind::Ensemble { .. }));
            header.push(format!("{name} ({unit})"));
            header.extend(error.then(|| format!("{name}_error ({unit})")));
            for (row, (_, cells)) in rows.iter_mut().zip(&self.rows) {
                row.push(written(&cells[at].number));
                row.extend(error.then(|| match cells[at].kind {
                    Kind::Ensemble { standard_error, .. } => format!("{standard_error:?}"),
                    _ => String::new(),
                }));
            }
        }
        (header, rows)
    }
}

/// Writes a number as data files have it.
fn written(number: &Number) -> String {
    match number {
        Number::None => String::new(),
        Number::Integer(n) => n.to_string(),
        Number::Real { value, .. } => format!("{value:?}"),
        Number::Text(words) => words.clone(),
    }
}
