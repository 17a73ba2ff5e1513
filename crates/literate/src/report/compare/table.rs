//! Two files of data, cell by cell.

use serde::Serialize;
use std::collections::{BTreeSet, HashMap};

/// A CSV file.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Names of the columns.
    pub header: Vec<String>,
    /// Rows, each as long as the header.
    pub rows: Vec<Vec<String>>,
}

/// Where two numbers are farthest apart.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Largest {
    /// The distance, absolute or over the larger of the two.
    pub difference: f64,
    /// Name of the column.
    pub column: String,
    /// The row afterwards, from 1 below the header.
    pub row: usize,
    /// The cell before.
    pub before: String,
    /// The cell now.
    pub after: String,
}

/// A row that differs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Its number afterwards, from 1 below the header; of a lost row the number before.
    pub row: usize,
    /// The row before; None for a new one.
    pub before: Option<String>,
    /// The row now; None for one that is gone.
    pub after: Option<String>,
}

/// One file of data that differs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TableChange {
    /// Its path.
    pub path: String,
    /// Columns that only the later one has.
    pub columns_gained: Vec<String>,
    /// Columns that only the earlier one has.
    pub columns_lost: Vec<String>,
    /// Rows now.
    pub rows: usize,
    /// Rows that only the later one has.
    pub rows_gained: usize,
    /// Rows that only the earlier one has.
    pub rows_lost: usize,
    /// Rows that both have with other cells.
    pub rows_changed: usize,
    /// Cells that differ and are not numbers on both sides.
    pub words_changed: usize,
    /// Columns with numbers that differ.
    pub columns_changed: Vec<String>,
    /// The first row that differs.
    pub first: Option<Row>,
    /// The largest difference of two numbers.
    pub absolute: Option<Largest>,
    /// The largest difference over the larger of the two numbers.
    pub relative: Option<Largest>,
}

impl Table {
    /// Reads CSV with a header.
    ///
    /// # Errors
    /// When it is not that.
    pub fn read(text: &str) -> Result<Self, String> {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let cells = |record: &csv::StringRecord| record.iter().map(String::from).collect();
        let header = cells(reader.headers().map_err(|error| error.to_string())?);
        let row = |record: Result<csv::StringRecord, csv::Error>| record.map(|r| cells(&r));
        let rows = reader.records().map(row).collect::<Result<_, _>>();
        Ok(Table { header, rows: rows.map_err(|error| error.to_string())? })
    }

    /// Pairs of rows, as (before, after). With as many rows on both sides they go by place; else by
    /// their first cell, and among equal ones in order, so that a row put between shifts nothing.
    pub fn pairs(&self, after: &Table) -> Vec<(usize, usize)> {
        if self.rows.len() == after.rows.len() {
            return (0..self.rows.len()).map(|i| (i, i)).collect();
        }
        let mut seen: HashMap<(&str, usize), usize> = HashMap::new();
        for (key, i) in keys(&self.rows) {
            seen.insert(key, i);
        }
        keys(&after.rows).filter_map(|(key, j)| Some((*seen.get(&key)?, j))).collect()
    }
}

/// First cells, each with how often it came before, and the row.
fn keys(rows: &[Vec<String>]) -> impl Iterator<Item = ((&str, usize), usize)> {
    let mut counts: HashMap<&str, usize> = HashMap::new();
    rows.iter().enumerate().map(move |(i, row)| {
        let first = row.first().map_or("", String::as_str);
        let count = counts.entry(first).or_default();
        *count += 1;
        ((first, *count), i)
    })
}

/// A cell as a number.
pub fn number(cell: &str) -> Option<f64> {
    cell.parse().ok().filter(|value: &f64| value.is_finite())
}

impl TableChange {
    /// Compares.
    pub fn between(path: &str, before: &Table, after: &Table) -> Self {
        let only = |one: &Table, other: &Table| -> Vec<String> {
            one.header.iter().filter(|name| !other.header.contains(name)).cloned().collect()
        };
        let pairs = before.pairs(after);
        let mut out = TableChange {
            path: path.into(),
            columns_gained: only(after, before),
            columns_lost: only(before, after),
            rows: after.rows.len(),
            rows_gained: after.rows.len() - pairs.len(),
            rows_lost: before.rows.len() - pairs.len(),
            rows_changed: 0,
            words_changed: 0,
            columns_changed: Vec::new(),
            first: None,
            absolute: None,
            relative: None,
        };
        let columns: Vec<(usize, usize)> = (after.header.iter().enumerate())
            .filter_map(|(j, name)| Some((before.header.iter().position(|n| n == name)?, j)))
            .collect();
        let mut changed_columns = BTreeSet::new();
        let mut changed_rows = Vec::new();
        for &(i, j) in &pairs {
            let (old, new) = (&before.rows[i], &after.rows[j]);
            let differing = columns.iter().filter(|(a, b)| old[*a] != new[*b]);
            let mut any = false;
            for &(a, b) in differing {
                any = true;
                let Some((x, y)) = number(&old[a]).zip(number(&new[b])) else {
                    out.words_changed += 1;
                    continue;
                };
                changed_columns.insert(b);
                let at = |difference| Largest {
                    difference,
                    column: after.header[b].clone(),
                    row: j + 1,
                    before: old[a].clone(),
                    after: new[b].clone(),
                };
                let apart = (x - y).abs();
                raise(&mut out.absolute, apart, at);
                let scale = x.abs().max(y.abs());
                raise(&mut out.relative, if scale > 0.0 { apart / scale } else { 0.0 }, at);
            }
            if any {
                changed_rows.push((i, j));
            }
        }
        out.rows_changed = changed_rows.len();
        out.columns_changed = changed_columns.iter().map(|&b| after.header[b].clone()).collect();
        out.first = first(before, after, &pairs, changed_rows.first().copied());
        out
    }
}

fn raise(largest: &mut Option<Largest>, difference: f64, at: impl Fn(f64) -> Largest) {
    if largest.as_ref().is_none_or(|largest| difference > largest.difference) {
        *largest = Some(at(difference));
    }
}

/// The first row that differs: changed or new, else the first that is gone.
fn first(
    before: &Table,
    after: &Table,
    pairs: &[(usize, usize)],
    changed: Option<(usize, usize)>,
) -> Option<Row> {
    let line = |row: &Vec<String>| Some(row.join(","));
    let (mut old, mut new) = (vec![true; before.rows.len()], vec![true; after.rows.len()]);
    for &(i, j) in pairs {
        (old[i], new[j]) = (false, false);
    }
    let gained = new.iter().position(|gained| *gained);
    if let Some((i, j)) = changed.filter(|(_, j)| gained.is_none_or(|gained| *j < gained)) {
        let (before, after) = (line(&before.rows[i]), line(&after.rows[j]));
        return Some(Row { row: j + 1, before, after });
    }
    if let Some(j) = gained {
        return Some(Row { row: j + 1, before: None, after: line(&after.rows[j]) });
    }
    let lost = old.iter().position(|lost| *lost)?;
    Some(Row { row: lost + 1, before: line(&before.rows[lost]), after: None })
}
