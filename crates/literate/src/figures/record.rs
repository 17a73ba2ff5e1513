//! Records what a panel draws as the rows of its data file, so that authors write no data files.

use super::markup::spelled;
use crate::table::{DataFile, shortest};
use impact_numerics::statistics::Estimate;

/// A point of a series: x and, where known, the value, its standard error and both ends of a bar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DataPoint {
    x: f64,
    known: [Option<f64>; 4],
}

/// Their columns in data files; that of the value has the name of the axis.
const KNOWN: [&str; 4] = ["", "standard_error", "low", "high"];

impl From<(f64, f64)> for DataPoint {
    fn from((x, y): (f64, f64)) -> Self {
        DataPoint { x, known: [Some(y), None, None, None] }
    }
}

impl From<(f64, f64, f64)> for DataPoint {
    /// A bar between two heights.
    fn from((x, low, high): (f64, f64, f64)) -> Self {
        DataPoint { x, known: [None, None, Some(low), Some(high)] }
    }
}

impl From<(f64, Estimate)> for DataPoint {
    fn from((x, y): (f64, Estimate)) -> Self {
        DataPoint { x, known: [Some(y.value), Some(y.error), None, None] }
    }
}

impl DataPoint {
    /// Merges a row of the same x unless a number that both know differs; returns whether it did.
    fn merge(&mut self, new: &DataPoint) -> bool {
        let mut pairs = self.known.iter().zip(&new.known);
        let agree = pairs.all(|(a, b)| a.is_none() || b.is_none() || a == b) && self.x == new.x;
        if agree {
            self.known = std::array::from_fn(|i| self.known[i].or(new.known[i]));
        }
        agree
    }
}

/// The series of a panel, each with its rows.
#[derive(Clone, Debug, Default)]
pub(super) struct Record {
    /// The end of the file's name, after the figure's id: the panel's letter, or nothing.
    pub suffix: String,
    /// Names of the columns, with their units.
    pub x: String,
    pub y: String,
    pub series: Vec<(String, Vec<DataPoint>)>,
}

impl Record {
    /// Adds rows to a series: bars, symbols and curves of one name are one set, by rising x.
    pub(super) fn add(&mut self, name: &str, rows: impl IntoIterator<Item = DataPoint>) {
        let name = spelled(name);
        let Some((_, known)) = self.series.iter_mut().find(|series| series.0 == name) else {
            let mut rows: Vec<DataPoint> = rows.into_iter().collect();
            rows.dedup();
            return self.series.push((name, rows));
        };
        for row in rows {
            if !known.iter_mut().any(|known| known.merge(&row)) {
                known.push(row);
                known.sort_by(|a, b| a.x.total_cmp(&b.x));
            }
        }
    }

    /// Returns the panel's data file; none if it has no data.
    pub(super) fn file(&self) -> Option<DataFile> {
        let mut points = Vec::new();
        for (name, rows) in &self.series {
            points.extend(rows.iter().map(|row| (name, row)));
        }
        if points.is_empty() {
            return None;
        }
        let is_known = |i: usize| points.iter().any(|(_, row)| row.known[i].is_some());
        let columns: Vec<usize> = (0..KNOWN.len()).filter(|&i| i == 0 || is_known(i)).collect();
        let mut header = vec!["series (text)".to_string(), self.x.clone(), self.y.clone()];
        let unit = self.y.rfind(" (").map_or("", |at| &self.y[at..]);
        header.extend(columns.iter().skip(1).map(|&i| format!("{}{unit}", KNOWN[i])));
        let cells = |(name, point): &(&String, &DataPoint)| {
            let known = columns.iter().map(|&i| point.known[i].map_or(String::new(), shortest));
            [name.to_string(), shortest(point.x)].into_iter().chain(known).collect()
        };
        let rows = points.iter().map(cells).collect();
        Some(DataFile { name: format!("{}.csv", self.suffix), header, rows })
    }
}
