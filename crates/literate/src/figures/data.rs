//! The data behind a figure, as CSV.

use crate::table::Table;

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
