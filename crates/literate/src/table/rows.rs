//! Holds the cells of a table, and finds them by addresses and keys.

use super::missing::{Missing, NO_NUMBER, no_such};
use crate::decimal::Decimal;
use crate::input::source_line;
use crate::value::{Digits, Number, Value};
use impact_numerics::statistics::Estimate;
use std::collections::BTreeMap;
use std::panic::Location;
use std::sync::Arc;

/// Rows that keys name, and columns.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    pub(super) name: &'static str,
    pub(super) columns: Vec<Column>,
    /// How many of the columns are keys; they come first.
    pub(super) keys: usize,
    /// For each row its address within the table (`r=0.8,sigma=0.3`), and its cells.
    pub(super) rows: Vec<(String, Vec<Value>)>,
    pub(super) place: &'static Location<'static>,
    pub(crate) fault: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Column {
    pub(super) name: &'static str,
    /// As data files write it: `d omega^2`, and `1` for a pure number.
    pub(super) unit: &'static str,
}

pub type Tables = BTreeMap<&'static str, Arc<Table>>;

/// Names of keys and their values, which choose rows.
pub type Keys<'a> = &'a [(&'a str, f64)];

impl Table {
    /// Returns its name: `experiment.table`.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Returns where the source makes it: `src/file.rs:12`.
    pub(crate) fn place(&self) -> String {
        source_line(self.place)
    }

    /// Returns the cell with this address, in which `first` and `last` may stand for values of a
    /// key, or `None` if there is no such cell.
    pub fn cell(&self, address: &str) -> Option<&Value> {
        if ["=first", "=last"].iter().any(|end| address.contains(end)) {
            let (row, column) = address.strip_prefix(self.name)?.rsplit_once("].")?;
            return self.rows_by_name().get(row.strip_prefix('[')?)?.get(column).copied();
        }
        self.cells().find(|cell| cell.id == address)
    }

    /// Describes which part of an address does not exist, with the most similar names that do.
    pub(crate) fn describe_missing(&self, address: &str) -> String {
        let rest = address.strip_prefix(self.name).unwrap_or(address);
        let (row, column) = rest.rsplit_once('.').unwrap_or(("", rest));
        let row = row.trim_start_matches('[').trim_end_matches(']');
        if self.rows().any(|name| name == row) {
            no_such("column", column, self.names())
        } else {
            no_such("row", row, self.rows())
        }
    }

    #[track_caller]
    pub(super) fn column(&self, name: &str) -> Result<usize, Missing> {
        match self.names().position(|column| column == name) {
            Some(index) => Ok(index),
            None => Err(Missing::new(self.name, no_such("column", name, self.names()))),
        }
    }

    /// Returns the rows that have these values of keys, whatever those that are left out are.
    #[track_caller]
    fn select(&self, keys: Keys) -> Result<Vec<&[Value]>, Missing> {
        let mut rows: Vec<&[Value]> = self.rows.iter().map(|(_, cells)| &cells[..]).collect();
        for (name, wanted) in keys {
            let index = self.column(name)?;
            rows.retain(|cells| is_number(&cells[index], *wanted));
        }
        if rows.is_empty() && !keys.is_empty() {
            let keys: Vec<String> = keys.iter().map(|(key, x)| format!("{key}={x}")).collect();
            return Err(Missing::new(self.name, no_such("row", &keys.join(","), self.rows())));
        }
        Ok(rows)
    }

    /// Returns the number in the row with these keys.
    #[track_caller]
    pub fn number(&self, keys: Keys, column: &str) -> Result<f64, Missing> {
        let (rows, index) = (self.select(keys)?, self.column(column)?);
        let [row] = rows[..] else {
            let problem = format!("{} rows have these keys; give more of them", rows.len());
            return Err(Missing::new(self.name, problem));
        };
        match row[index].as_f64() {
            Some(number) => Ok(number),
            None => Err(Missing::new(&row[index].id, NO_NUMBER)),
        }
    }

    /// Returns the points (x, y) of two columns, without rows that lack one of the numbers.
    #[track_caller]
    pub fn curve(&self, keys: Keys, x: &str, y: &str) -> Result<Vec<(f64, f64)>, Missing> {
        let series = self.series(keys, x, y)?;
        Ok(series.into_iter().map(|(x, estimate)| (x, estimate.value)).collect())
    }

    /// Returns the points of [`Table::curve`] with their standard errors, zero where there is none.
    #[track_caller]
    pub fn series(&self, keys: Keys, x: &str, y: &str) -> Result<Vec<(f64, Estimate)>, Missing> {
        let (x, y) = (self.column(x)?, self.column(y)?);
        let rows = self.select(keys)?.into_iter();
        Ok(rows.filter_map(|cells| cells[x].as_f64().zip(cells[y].estimate())).collect())
    }

    /// Returns the numbers of a column without repetitions, in the order of the rows.
    #[track_caller]
    pub fn distinct(&self, column: &str) -> Result<Vec<f64>, Missing> {
        let index = self.column(column)?;
        Ok(without_repeats(self.rows.iter().filter_map(|(_, cells)| cells[index].as_f64())))
    }

    /// Returns the values of a key as addresses write them, without repetitions, in their order.
    pub(crate) fn key_values(&self, key: &str) -> Vec<String> {
        let index = self.keys().position(|name| name == key);
        let cells = self.rows.iter().filter_map(|(_, cells)| cells.get(index?));
        without_repeats(cells.map(key_to_text))
    }

    pub(crate) fn cells(&self) -> impl Iterator<Item = &Value> {
        self.rows.iter().flat_map(|(_, cells)| cells)
    }

    /// Returns the table with other numbers in one column, which `change` makes of each number and
    /// its standard error, or `None` if the column is a key or no number changes.
    pub(crate) fn with_column_changed(
        &self,
        column: usize,
        change: impl Fn(f64, f64) -> Option<f64>,
    ) -> Option<Table> {
        let mut table = self.clone();
        for (_, cells) in &mut table.rows {
            let cell = &mut cells[column];
            let Some(value) = cell.as_f64() else { continue };
            cell.number = match (change(value, cell.standard_error()), &cell.number) {
                (None, _) => Number::None,
                (Some(value), &Number::Real { digits, .. }) => Number::Real { value, digits },
                (Some(value), _) => Number::Integer(value as i128),
            };
        }
        (column >= self.keys && table != *self).then_some(table)
    }

    pub(crate) fn names(&self) -> impl Iterator<Item = &'static str> {
        self.columns.iter().map(|column| column.name)
    }

    /// Returns the table as made by the experiment that it is named after, or by the only one.
    pub(crate) fn made_by(mut self, experiments: &[&str]) -> Table {
        let named = experiments.iter().any(|name| self.name.split('.').next() == Some(name));
        let only = if let [only] = experiments { only } else { "" };
        let cells = self.rows.iter_mut().flat_map(|(_, cells)| cells).filter(|_| !named);
        cells.for_each(|cell| cell.experiment = only.into());
        self
    }

    pub(crate) fn keys(&self) -> impl Iterator<Item = &'static str> {
        self.names().take(self.keys)
    }

    pub(crate) fn rows(&self) -> impl Iterator<Item = &str> {
        self.rows.iter().map(|(name, _)| name.as_str())
    }

    /// Returns the rows, as cells by the names of columns, by every name that a template can give
    /// to a row: `key=value` for each key, with `first` and `last`. Without keys the name is empty.
    pub(crate) fn rows_by_name(&self) -> BTreeMap<String, BTreeMap<&'static str, &Value>> {
        let mut rows = BTreeMap::new();
        let keys: Vec<_> = self.keys().map(|key| (key, self.key_values(key))).collect();
        for (_, cells) in &self.rows {
            let mut names = vec![String::new()];
            for ((key, values), cell) in keys.iter().zip(cells) {
                let value = key_to_text(cell);
                let ends =
                    [("first", values.first()), ("last", values.last()), (&value, Some(&value))];
                let shorter = std::mem::take(&mut names);
                for (spelling, _) in ends.into_iter().filter(|(_, end)| *end == Some(&value)) {
                    names.extend(shorter.iter().map(|name| match name.as_str() {
                        "" => format!("{key}={spelling}"),
                        name => format!("{name},{key}={spelling}"),
                    }));
                }
            }
            let row: BTreeMap<_, _> = self.names().zip(cells).collect();
            rows.extend(names.into_iter().map(|name| (name, row.clone())));
        }
        rows
    }
}

/// Returns the table, `experiment.table`, in the address of a cell, or `None` if it is none.
pub fn table_name(address: &str) -> Option<&str> {
    match address.split_once('[') {
        Some((table, rest)) => rest.contains("].").then_some(table),
        None => {
            address.rsplit_once('.').map(|(table, _)| table).filter(|table| table.contains('.'))
        }
    }
}

fn without_repeats<T: PartialEq>(items: impl Iterator<Item = T>) -> Vec<T> {
    let mut distinct = Vec::new();
    for item in items {
        if !distinct.contains(&item) {
            distinct.push(item);
        }
    }
    distinct
}

pub(super) fn key_to_text(key: &Value) -> String {
    match &key.number {
        Number::None => "none".into(),
        Number::Integer(n) => n.to_string(),
        Number::Real { value, digits: Digits::Text(text) }
            if Decimal::read(text).trimmed() != Decimal::shortest(*value).trimmed() =>
        {
            text.to_string()
        }
        // Zero has no sign.
        Number::Real { value, .. } => (value + 0.0).to_string(),
        Number::Text(words) => words.clone(),
    }
}

fn is_number(cell: &Value, wanted: f64) -> bool {
    match cell.number {
        Number::Integer(n) => n as f64 == wanted && wanted as i128 == n,
        _ => cell.as_f64() == Some(wanted),
    }
}

#[cfg(test)]
mod tests {
    use super::super::DataFile;
    use super::*;
    use crate::sample::Sample;
    use crate::value::{Origin, Provenance};

    fn mean(row: &(f64, f64, Vec<f64>)) -> Option<Estimate> {
        let value = row.2.iter().sum::<f64>() / row.2.len() as f64;
        (row.2.len() > 1).then_some(Estimate { value, error: 0.5, interval: [value, value] })
    }

    fn table() -> Table {
        let rows = [
            (0.0, 0.1, vec![1.0, 2.0]),
            (0.0, 0.3, vec![]),
            (0.8, 0.1, vec![3.0, 5.0]),
            (0.8, 0.3, vec![7.0, 8.0]),
        ];
        Table::builder("test.rise", &rows, |row| row.2.len())
            .key("r", "1", |row| row.0)
            .key("sigma", "d omega^2", |row| row.1)
            .estimate("mean", "1", "the mean", mean)
            .count("runs", "how many", |row| row.2.len() as u64)
            .real("inverse", "1/omega", 3, "one over r", |row| (row.0 > 0.0).then(|| 1.0 / row.0))
            .done()
    }

    #[test]
    fn a_cell_has_one_address_with_all_that_is_known_of_it() {
        let table = table();
        let cell_at = |address| table.cell(address).unwrap();
        let cell = cell_at("test.rise[r=0.8,sigma=0.3].mean");
        let sample = Sample::Unknown;
        let kind = Provenance::Ensemble { realisations: 2, standard_error: 0.5, sample };
        assert_eq!(cell.kind, kind);
        assert_eq!(cell.source, "literate::table::rows::tests::mean");
        assert_eq!((cell.experiment.as_str(), cell.note.as_str()), ("test", "the mean"));
        assert_eq!(table_name(&cell.id), Some("test.rise"));
        assert_eq!(table.number(&[("r", 0.8), ("sigma", 0.3)], "mean"), Ok(7.5));
        let source = &cell_at("test.rise[r=0,sigma=0.1].runs").source;
        assert_eq!(source, "literate::table::rows::tests::table");
        assert_eq!(cell_at("test.rise[r=0.8,sigma=0.1].inverse").unit, r"$1/\omega$");
        assert_eq!(cell_at("test.rise[r=0.8,sigma=0.1].sigma").unit, r"$d \omega^2$");
    }

    #[test]
    fn a_column_without_an_origin_has_that_of_its_table() {
        let [of_table, of_x] = ["table", "x"].map(|item| Origin(item.into()));
        let table = Table::builder("test.x", &[2.0], |_| 1).table_computed_by(of_table);
        let table = table.real("x", "1", 1, "", |x| *x).computed_by(of_x, &["x"]);
        let table = table.real("y", "1", 1, "", |x| -x).done();
        assert!(table.cells().map(|cell| cell.source.as_str()).eq(["x", "table"]));
    }

    #[test]
    fn a_table_is_from_the_experiment_that_made_it() {
        for (names, from) in [("one", "one"), ("one test", "test"), ("one two", "")] {
            let names: Vec<&str> = names.split(' ').collect();
            assert!(table().made_by(&names).cells().all(|cell| cell.experiment == from));
        }
    }

    #[test]
    fn what_is_not_there_is_an_error_with_the_place_that_asks_and_the_nearest_names() {
        let table = table();
        let keys = [("r", 0.8), ("sigma", 0.30000000000000004)];
        let missing_row = table.number(&keys, "mean").unwrap_err().to_string();
        assert!(missing_row.contains("in crates/literate/src/table/rows.rs:"), "{missing_row}");
        let nearest = "row r=0.8,sigma=0.30000000000000004; nearest: r=0.8,sigma=0.3, r=0.8,";
        assert!(missing_row.contains(nearest), "{missing_row}");
        // Nothing is drawn of a column, a key or a row that is not there.
        let column = table.series(&[], "sigma", "meen").unwrap_err();
        assert!(column.to_string().contains("test.rise: there is no column meen; nearest: mean"));
        for keys in [[("sigmas", 0.1)], [("r", 0.5)]] {
            assert!(table.curve(&keys, "sigma", "mean").is_err(), "{keys:?}");
        }
        assert!(table.distinct("rr").is_err() && table.number(&[("r", 0.8)], "mean").is_err());
        assert!(table.number(&[("r", 0.0), ("sigma", 0.3)], "mean").is_err());
        assert!(table.number(&[("r", 0.0), ("sigma", 0.1)], "inverse").is_err());
        for no in ["half_height", "v.half_height", "a[b]c"] {
            assert_eq!(table_name(no), None, "{no}");
        }
    }

    #[test]
    fn a_wrong_table_says_what_is_wrong_and_where() {
        let one = |rows: &'static [f64]| {
            Table::builder("test.bad", rows, |_| 1).key("r", "1", |row| *row)
        };
        let twice = one(&[1.0, 1.0]).done();
        let columns = one(&[1.0]).chosen("x", "1", "", |_| 1.0).count("x", "", |_| 2).done();
        let late = one(&[1.0]).chosen("x", "1", "", |_| 1.0).key("s", "1", |row| *row).done();
        let unknown = one(&[1.0]).computed_by(Origin("f".into()), &["x"]).done();
        let nan = one(&[1.0, 0.0]).real("x", "1", 3, "", |row| 1.0 / row).done();
        let [error, negative] = [f64::NAN, -0.5].map(|error| {
            let estimate = Estimate { value: 1.0, error, interval: [0.0; 2] };
            one(&[1.0]).estimate("x", "1", "", |_| Some(estimate)).done()
        });
        for (table, problem) in [
            (twice, "two rows have the keys [r=1]"),
            (columns, "two columns have the name x"),
            (late, "the key s stands after other columns"),
            (unknown, "no column before it has the name x"),
            (nan, "test.bad[r=0].x is inf; "),
            (error, "test.bad[r=1].x is 1(NaN)"),
            (negative, "test.bad[r=1].x is 1(-0.5)"),
        ] {
            let fault = table.fault.unwrap_or_default();
            let place = format!("{}:{}: the table test.bad: ", file!(), table.place.line());
            assert!(fault.starts_with(&place) && fault.contains(problem), "{fault}");
        }
    }

    #[test]
    fn neighbouring_integers_beyond_doubles_are_two_keys() {
        let seeds = [9_007_199_254_740_992_u64, 9_007_199_254_740_993, u64::MAX];
        let table = Table::builder("test.seeds", &seeds, |_| 1).key("seed", "1", |seed| *seed);
        let table = table.chosen("same", "1", "", |seed| *seed).done();
        assert_eq!(table.fault, None);
        let odd = table.cell("test.seeds[seed=9007199254740993].same").unwrap();
        assert_eq!(odd.to_plain_text(), "9007199254740993");
        assert_eq!(DataFile::from_table(&table).rows[2], ["18446744073709551615"; 2]);
        let even = table.select(&[("seed", 9_007_199_254_740_992.0)]).unwrap();
        assert_eq!((even.len(), key_to_text(&even[0][0])), (1, "9007199254740992".into()));
    }
}
