//! What a panel draws, kept as rows of its data file: a figure's author writes no data.

use super::axis::Axis;
use super::markup::spelled;
use crate::table::Table;
use impact_numerics::statistics::Estimate;

/// A place of a series, and what is known there: value, standard error, and both ends of a bar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DataPoint {
    x: f64,
    known: [Option<f64>; 4],
}

/// What data files call these, but for the value.
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
    fn from((x, own): (f64, Estimate)) -> Self {
        DataPoint { x, known: [Some(own.value), Some(own.error), None, None] }
    }
}

impl DataPoint {
    /// Joins another row of the same place if no number of both differs; whether it did.
    fn joins(&mut self, new: &DataPoint) -> bool {
        let mut both = self.known.iter().zip(&new.known);
        let same = self.x == new.x && both.all(|(a, b)| a.is_none() || b.is_none() || a == b);
        if same {
            let join = |i: usize| self.known[i].or(new.known[i]);
            self.known = [0, 1, 2, 3].map(join);
        }
        same
    }
}

/// The series of a panel, each with its rows.
#[derive(Clone, Debug)]
pub(super) struct Record {
    /// Behind the figure's id in the file's name: the panel's letter, or nothing.
    pub(super) suffix: String,
    x: (String, String),
    y: (String, String),
    series: Vec<(String, Vec<DataPoint>)>,
}

impl Record {
    pub(super) fn new(x: &Axis, y: &Axis) -> Self {
        Record { suffix: String::new(), x: x.named(), y: y.named(), series: Vec::new() }
    }

    /// Adds rows to a series: bars, marks and curves of one name are one set of rows, by rising x.
    pub(super) fn add(&mut self, name: &str, rows: impl IntoIterator<Item = DataPoint>) {
        let name = spelled(name);
        let Some((_, known)) = self.series.iter_mut().find(|(own, _)| *own == name) else {
            let mut rows: Vec<DataPoint> = rows.into_iter().collect();
            rows.dedup();
            return self.series.push((name, rows));
        };
        for row in rows {
            if !known.iter_mut().any(|own| own.joins(&row)) {
                known.push(row);
                known.sort_by(|a, b| a.x.total_cmp(&b.x));
            }
        }
    }

    /// The panel's file; none if it has no data.
    pub(super) fn file(&self) -> Option<DataFile> {
        let rows =
            || self.series.iter().flat_map(|(name, rows)| rows.iter().map(move |r| (name, r)));
        rows().next()?;
        let has = |i: &usize| *i == 0 || rows().any(|(_, row)| row.known[*i].is_some());
        let columns: Vec<usize> = (0..KNOWN.len()).filter(has).collect();
        let unit = &self.y.1;
        let mut header = vec!["series (text)".to_string()];
        header.extend([&self.x, &self.y].map(|(name, unit)| format!("{name} ({unit})")));
        header.extend(columns.iter().skip(1).map(|i| format!("{} ({unit})", KNOWN[*i])));
        let cells = |(name, row): (&String, &DataPoint)| {
            let known = columns.iter().map(|i| row.known[*i].map_or(String::new(), shortest));
            [name.clone(), shortest(row.x)].into_iter().chain(known).collect()
        };
        let rows = rows().map(cells).collect();
        Some(DataFile { name: format!("{}.csv", self.suffix), header, rows })
    }
}

/// One CSV file with a header that names each column and its unit.
#[derive(Clone, Debug, PartialEq)]
pub struct DataFile {
    /// File name, such as `fig09a.csv`.
    pub name: String,
    /// Column names with units, such as `sigma (d omega^2)`; 1 stands for a pure number.
    pub header: Vec<String>,
    /// The rows, each as long as the header.
    pub rows: Vec<Vec<String>>,
}

impl DataFile {
    /// A table of an experiment, whole.
    pub fn of(table: &Table) -> Self {
        let (header, rows) = table.data();
        DataFile { name: Self::name_of(table.name()), header, rows }
    }

    /// What the file of a table `experiment.table` is called.
    pub fn name_of(table: &str) -> String {
        format!("{}.csv", table.replace('.', "-"))
    }

    /// The file's content: comma separated, one line a row, line feed at the end of each.
    pub fn csv(&self) -> String {
        let mut out = String::new();
        for line in std::iter::once(&self.header).chain(&self.rows) {
            let quoted = |cell: &String| match cell.contains([',', '"', '\n']) {
                true => format!("\"{}\"", cell.replace('"', "\"\"")),
                false => cell.clone(),
            };
            out += &(line.iter().map(quoted).collect::<Vec<_>>().join(",") + "\n");
        }
        out
    }
}

/// A number as files have it: the shortest decimal that reads back to the same double.
pub fn shortest(value: f64) -> String {
    let shown = format!("{value:?}");
    shown.strip_suffix(".0").map_or(shown.clone(), String::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_series_is_one_set_of_rows_whatever_it_is_drawn_with() {
        let x = Axis::linear(0.0, 1.0, 0.5, 1, "*σ*").column("sigma (d omega^2)");
        let y = Axis::linear(0.0, 1.0, 0.5, 1, "*t*, or so (1/*ω*)");
        let mut record = Record::new(&x, &y);
        record.suffix = "a".into();
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
        assert_eq!((file.name.as_str(), file.csv()), ("a.csv", lines.join("\n") + "\n"));
    }
}
