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
    /// A file without rows yet.
    pub fn new(name: &str, header: &[&str]) -> Self {
        let header = header.iter().map(|h| (*h).to_string()).collect();
        DataFile { name: name.into(), header, rows: Vec::new() }
    }

    /// A table of an experiment, whole.
    pub fn of(table: &Table) -> Self {
        let (header, rows) = table.data();
        DataFile { name: Self::name_of(table), header, rows }
    }

    /// What the file of a table is called.
    pub fn name_of(table: &Table) -> String {
        format!("{}.csv", table.name().replace('.', "-"))
    }

    /// Columns over k = 1, 2, …, all for one p if there is one.
    pub fn over_k(name: &str, p: Option<f64>, columns: &[(&str, &[f64])]) -> Self {
        let names = columns.iter().map(|(name, _)| *name);
        let header: Vec<&str> =
            p.map(|_| "p (1)").into_iter().chain(["k (1)"]).chain(names).collect();
        let mut file = DataFile::new(name, &header);
        let longest = columns.iter().map(|(_, values)| values.len()).max().unwrap_or(0);
        for at in 0..longest {
            let mut row: Vec<Cell> = p.map(Cell::from).into_iter().collect();
            row.push(Cell::from(at + 1));
            row.extend(columns.iter().map(|(_, values)| Cell::from(values.get(at).copied())));
            file.rows.push(row.into_iter().map(|cell| cell.0).collect());
        }
        file
    }

    /// Adds a row.
    pub fn row<const K: usize>(&mut self, cells: [Cell; K]) {
        self.rows.push(cells.into_iter().map(|c| c.0).collect());
    }

    /// The file's content: comma separated, one line a row, line feed at the end of each.
    pub fn csv(&self) -> String {
        let mut out = String::new();
        for line in std::iter::once(&self.header).chain(&self.rows) {
            let cells: Vec<String> = line.iter().map(|cell| quoted(cell)).collect();
            out.push_str(&cells.join(","));
            out.push('\n');
        }
        out
    }
}

fn quoted(cell: &str) -> String {
    if cell.contains([',', '"', '\n']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.to_string()
    }
}

/// A value as it stands in a CSV file.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell(String);

impl From<f64> for Cell {
    /// The shortest decimal that reads back to the same double.
    fn from(value: f64) -> Self {
        Cell(format!("{value:?}"))
    }
}

impl From<usize> for Cell {
    fn from(value: usize) -> Self {
        Cell(value.to_string())
    }
}

impl From<u64> for Cell {
    fn from(value: u64) -> Self {
        Cell(value.to_string())
    }
}

impl From<&str> for Cell {
    fn from(value: &str) -> Self {
        Cell(value.into())
    }
}

impl<T: Into<Cell>> From<Option<T>> for Cell {
    /// Nothing is an empty cell.
    fn from(value: Option<T>) -> Self {
        value.map_or(Cell(String::new()), Into::into)
    }
}

/// A row of cells: `cells![sigma, kept, mean]`.
#[macro_export]
macro_rules! cells {
    ($($value:expr),* $(,)?) => { [$($crate::figures::data::Cell::from($value)),*] };
}
pub use cells;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv_quotes_and_keeps_every_bit() {
        let mut file = DataFile::new("a.csv", &["sigma (d omega^2)", "a, b"]);
        file.row(cells![0.1, Some(3usize)]);
        file.row(cells![1e-300, None::<usize>]);
        assert_eq!(file.csv(), "sigma (d omega^2),\"a, b\"\n0.1,3\n1e-300,\n");
    }
}
