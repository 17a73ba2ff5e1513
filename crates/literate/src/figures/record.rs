//! Records what a panel draws as the rows of its data file, so that authors write no data files.

use super::markup::spelled;
use crate::table::{DataFile, shortest};
use impact_numerics::statistics::Estimate;

/// A point of a series: x, and those known of value, standard error and both ends of a bar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DataPoint {
    x: f64,
    known: [Option<f64>; 4],
}

/// The columns of these in data files; the value has the name of the axis.
const KNOWN: [&str; 4] = ["", "standard_error", "low", "high"];

impl From<(f64, f64)> for DataPoint {
    fn from((x, y): (f64, f64)) -> Self {
        DataPoint { x, known: [Some(y), None, None, None] }
    }
}

impl From<(f64, f64, f64)> for DataPoint {
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
        let agree = self.x == new.x && pairs.all(|(a, b)| a.is_none() || b.is_none() || a == b);
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

    /// Returns the panel's data file, or `None` if it has no data.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_series_is_one_set_of_rows_whatever_it_is_drawn_with() {
        let (x, y) = ("sigma (d omega^2)".into(), "t, or so (1/omega)".into());
        let mut record = Record { suffix: "a".into(), x, y, ..Record::default() };
        assert_eq!(record.file(), None);
        record.add("*σ* = 3", [(0.3, 0.1, 0.9).into()]);
        let twice = [(0.5, 0.5), (0.5, 0.5), (0.5, 0.6), (0.1, 0.2)];
        record.add("other", twice.map(DataPoint::from));
        record.add("*σ* = 3", [(0.1, 0.2).into(), (0.3, 0.25).into()]);
        let error = Estimate { value: 0.2, error: 0.01, interval: [0.2; 2] };
        record.add("*σ* = 3", [(0.1, error).into()]);
        let lines = [
            "series (text),sigma (d omega^2),\"t, or so (1/omega)\",standard_error (1/omega),low (1/omega),high (1/omega)",
            "sigma = 3,0.1,0.2,0.01,,",
            "sigma = 3,0.3,0.25,,0.1,0.9",
            "other,0.5,0.5,,,",
            "other,0.5,0.6,,,",
            "other,0.1,0.2,,,",
        ];
        let file = record.file().unwrap();
        assert_eq!((file.name.as_str(), file.to_csv()), ("a.csv", lines.join("\n") + "\n"));
    }
}
