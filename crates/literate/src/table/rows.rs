//! Holds the cells of a table, and finds them by addresses and keys.

use crate::value::{Kind, Number, Value};
use impact_numerics::statistics::Estimate;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Rows with keys, and columns.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    pub(super) name: &'static str,
    pub(super) columns: Vec<Column>,
    /// How many of the columns are keys; they come first.
    pub(super) keys: usize,
    /// For each row its address within the table (`r=0.8,sigma=0.3`), and its cells.
    pub(super) rows: Vec<(String, Vec<Value>)>,
}

/// What all cells below one another are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Column {
    pub(super) name: &'static str,
    /// As data files write it: `d omega^2`, and `1` for a pure number.
    pub(super) unit: &'static str,
}

/// There is no such cell, or it has no number.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{address}: {what}; run a fuller profile, or mend the address in {place}")]
pub struct Missing {
    address: String,
    /// What is missing, and the nearest names that there are.
    what: String,
    place: String,
}

impl Missing {
    #[track_caller]
    fn new(address: impl Into<String>, what: impl Into<String>) -> Missing {
        let place = std::panic::Location::caller();
        let place = format!("{}:{}", place.file(), place.line());
        Missing { address: address.into(), what: what.into(), place }
    }
}

/// Tables by their names.
pub type Tables = BTreeMap<&'static str, Arc<Table>>;

/// The cell with an address, `cascade.orbits[n=3].delta`.
#[track_caller]
pub fn cell<'a>(tables: &'a Tables, address: &str) -> Result<&'a Value, Missing> {
    let name = table_of(address).unwrap_or(address);
    let Some(table) = tables.get(name) else {
        let names = nearest(name, tables.keys().copied()).join(", ");
        return Err(Missing::new(address, format!("there is no table {name}; nearest: {names}")));
    };
    table.at(address).ok_or_else(|| Missing::new(address, table.nearest(address)))
}

#[track_caller]
pub fn number_at(tables: &Tables, address: &str) -> Result<f64, Missing> {
    number(cell(tables, address)?).ok_or_else(|| Missing::new(address, NO_NUMBER))
}

const NO_NUMBER: &str = "this cell has no number";

/// The three names that are most like one: with the most characters alike at their beginnings and
/// ends.
pub fn nearest<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let begin = |own: &str| own.chars().zip(name.chars()).take_while(|(a, b)| a == b).count();
    let ends =
        |own: &str| own.chars().rev().zip(name.chars().rev()).take_while(|(a, b)| a == b).count();
    let mut names: Vec<&str> = names.collect();
    names.sort_by_key(|own| std::cmp::Reverse(begin(own) + ends(own)));
    names.truncate(3);
    names
}

/// Keys of a row, with their values.
pub type Keys<'a> = &'a [(&'a str, f64)];

/// `experiment.table` of a cell's address; none of what is no address.
pub fn table_of(address: &str) -> Option<&str> {
    match address.split_once('[') {
        Some((table, rest)) => rest.contains("].").then_some(table),
        None => {
            address.rsplit_once('.').map(|(table, _)| table).filter(|table| table.contains('.'))
        }
    }
}

impl Table {
    /// Its name: `experiment.table`.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// The cell with this address; `first` and `last` stand for values of a key.
    pub fn at(&self, address: &str) -> Option<&Value> {
        if ["=first", "=last"].iter().any(|end| address.contains(end)) {
            let (row, column) = address.strip_prefix(self.name)?.rsplit_once("].")?;
            return self.named().get(row.strip_prefix('[')?)?.get(column).copied();
        }
        let mut cells = self.rows.iter().flat_map(|(_, cells)| cells);
        cells.find(|cell| cell.id == address)
    }

    /// What an address has that is not there, with the nearest that is.
    fn nearest(&self, address: &str) -> String {
        let rest = address.strip_prefix(self.name).unwrap_or(address);
        let (row, column) = rest.rsplit_once('.').unwrap_or(("", rest));
        let row = row.trim_start_matches('[').trim_end_matches(']');
        let (kind, nearest) = match self.rows().any(|name| name == row) {
            true => ("column", nearest(column, self.columns.iter().map(|column| column.name))),
            false => ("row", nearest(row, self.rows())),
        };
        format!("there is no such {kind}; nearest: {}", nearest.join(", "))
    }

    pub(super) fn column(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column.name == name)
    }

    /// Rows with these keys, in order: all that agree where keys are left out.
    fn select<'a>(&'a self, keys: Keys<'a>) -> impl Iterator<Item = &'a [Value]> {
        let is = |cells: &[Value], (name, wanted): &(&str, f64)| {
            self.column(name).and_then(|at| number(&cells[at])) == Some(*wanted)
        };
        let rows = self.rows.iter().map(|(_, cells)| cells.as_slice());
        rows.filter(move |cells| keys.iter().all(|key| is(cells, key)))
    }

    /// The number in the row with these keys.
    #[track_caller]
    pub fn number<'a>(&'a self, keys: Keys<'a>, column: &str) -> Result<f64, Missing> {
        let cell = self.column(column).and_then(|at| self.select(keys).next()?.get(at));
        if let Some(number) = cell.and_then(number) {
            return Ok(number);
        }
        let keys: Vec<String> = keys.iter().map(|(name, key)| format!("{name}={key}")).collect();
        let address = format!("{}[{}].{column}", self.name, keys.join(","));
        let what = cell.map_or_else(|| self.nearest(&address), |_| NO_NUMBER.into());
        Err(Missing::new(address, what))
    }

    /// The numbers of a column where there are any, each with that of another column.
    pub fn points(&self, keys: Keys<'_>, x: &str, y: &str) -> Vec<(f64, f64)> {
        self.estimates(keys, x, y).into_iter().map(|(x, own)| (x, own.value)).collect()
    }

    /// The same with standard errors, zero where a number has none; the interval is one error to
    /// each side.
    pub fn estimates(&self, keys: Keys<'_>, x: &str, y: &str) -> Vec<(f64, Estimate)> {
        let Some((x, y)) = self.column(x).zip(self.column(y)) else { return Vec::new() };
        let estimate = |cell: &Value| {
            let (value, error) = (number(cell)?, cell.standard_error());
            Some(Estimate { value, error, interval: [value - error, value + error] })
        };
        let point = |cells: &[Value]| Some((number(&cells[x])?, estimate(&cells[y])?));
        self.select(keys).filter_map(point).collect()
    }

    /// The different values of a column, in order of the rows.
    pub fn values(&self, column: &str) -> Vec<f64> {
        self.different(column, number)
    }

    /// The different values of a key as addresses write them, in order of the rows.
    pub fn called(&self, key: &str) -> Vec<String> {
        self.different(key, |cell| Some(called(cell)))
    }

    fn different<T: PartialEq>(&self, column: &str, of: impl Fn(&Value) -> Option<T>) -> Vec<T> {
        let Some(at) = self.column(column) else { return Vec::new() };
        let mut found = Vec::new();
        for value in self.rows.iter().filter_map(|(_, cells)| of(&cells[at])) {
            if !found.contains(&value) {
                found.push(value);
            }
        }
        found
    }

    /// Names of the keys.
    pub fn keys(&self) -> impl Iterator<Item = &'static str> {
        self.columns[..self.keys].iter().map(|column| column.name)
    }

    /// The names of all rows, in order.
    pub fn rows(&self) -> impl Iterator<Item = &str> {
        self.rows.iter().map(|(name, _)| name.as_str())
    }

    /// Every way in which a template can name a row, with its cells by column: for a key its value,
    /// or `first` and `last` of all its values. One empty name where there are no keys.
    pub fn named(&self) -> BTreeMap<String, BTreeMap<&'static str, &Value>> {
        let mut found = BTreeMap::new();
        let keys: Vec<_> = self.keys().map(|key| (key, self.called(key))).collect();
        for (_, cells) in &self.rows {
            let mut names = vec![String::new()];
            for ((key, all), cell) in keys.iter().zip(cells) {
                let written = called(cell);
                let mut ways = Vec::new();
                if all.first() == Some(&written) {
                    ways.push("first");
                }
                if all.last() == Some(&written) {
                    ways.push("last");
                }
                ways.push(&written);
                let mut longer = Vec::new();
                for name in &names {
                    let separator = if name.is_empty() { "" } else { "," };
                    for way in &ways {
                        longer.push(format!("{name}{separator}{key}={way}"));
                    }
                }
                names = longer;
            }
            let row: BTreeMap<_, _> =
                self.columns.iter().map(|column| column.name).zip(cells).collect();
            found.extend(names.into_iter().map(|name| (name, row.clone())));
        }
        found
    }

    /// Column names with units, and the cells as data files write them: every bit of each number,
    /// and a column of its own for each standard error.
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

/// A key as addresses write it.
pub(super) fn called(cell: &Value) -> String {
    match &cell.number {
        Number::Text(words) => words.clone(),
        _ => number(cell).unwrap_or(f64::NAN).to_string(),
    }
}

/// The number of a cell; none of words.
pub fn number(cell: &Value) -> Option<f64> {
    match cell.number {
        Number::Integer(n) => Some(n as f64),
        Number::Real { value, .. } => Some(value),
        Number::Text(_) => None,
    }
}

fn written(number: &Number) -> String {
    match number {
        Number::Integer(n) => n.to_string(),
        Number::Real { value, .. } => format!("{value:?}"),
        Number::Text(words) if words == "none" => String::new(),
        Number::Text(words) => words.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        Table::of("test.rise", &rows, |row| row.2.len())
            .key("r", "1", |row| row.0)
            .key("sigma", "d omega^2", |row| row.1)
            .estimate("mean", "1", "the mean", mean)
            .count("runs", "how many", |row| row.2.len() as u64)
            .real("inverse", "1/omega", 3, "one over r", |row| 1.0 / row.0)
            .same("inverse", |row| (row.1 == 0.3).then(|| "other".into()))
            .done()
    }

    #[test]
    fn a_cell_has_one_address_with_all_that_is_known_of_it() {
        let table = table();
        let at = |address| table.at(address).unwrap();
        let cell = at("test.rise[r=0.8,sigma=0.3].mean");
        assert_eq!(cell.kind, Kind::Ensemble { realisations: 2, standard_error: 0.5 });
        assert_eq!(cell.source, "literate::table::rows::tests::mean");
        assert_eq!((cell.experiment.as_str(), cell.note.as_str()), ("test", "the mean"));
        assert_eq!(table_of(&cell.id), Some("test.rise"));
        assert_eq!(table.number(&[("r", 0.8), ("sigma", 0.3)], "mean"), Ok(7.5));
        // A closure's item is the function in which it stands.
        assert_eq!(
            at("test.rise[r=0,sigma=0.1].runs").source,
            "literate::table::rows::tests::table"
        );
        assert_eq!(at("test.rise[r=0.8,sigma=0.1].inverse").unit, r"$1/\omega$");
        assert_eq!(at("test.rise[r=0.8,sigma=0.1].sigma").unit, r"$d \omega^2$");
        assert!(
            table.at("test.rise[r=0.8,sigma=0.3].inverse").is_none() && table.at("other").is_some()
        );
    }

    #[test]
    fn what_is_not_there_is_an_error_with_the_place_that_asks() {
        let table = table();
        let keys = [("r", 0.8), ("sigma", 0.30000000000000004)];
        let lost = table.number(&keys, "mean").unwrap_err();
        assert_eq!(lost.address, "test.rise[r=0.8,sigma=0.30000000000000004].mean");
        assert!(lost.place.starts_with("crates/literate/src/table/rows.rs:"), "{}", lost.place);
        assert!(
            lost.what.ends_with("row; nearest: r=0.8,sigma=0.3, r=0.8,sigma=0.1, r=0,sigma=0.1")
        );
        let tables = Tables::from([(table.name(), Arc::new(table.clone()))]);
        let what = |address| cell(&tables, address).unwrap_err().what;
        assert!(what("test.rise[r=0,sigma=0.1].meen").contains("no such column; nearest: mean"));
        assert!(what("test.ris.mean").ends_with("no table test.ris; nearest: test.rise"));
        // There is a cell, and it has no number.
        assert!(table.number(&[("r", 0.0), ("sigma", 0.3)], "mean").is_err());
        assert!(table.number(&[("r", 0.0), ("sigma", 0.1)], "inverse").is_err());
        for no in ["half_height", "v.half_height", "a[b]c"] {
            assert_eq!(table_of(no), None, "{no}");
        }
    }

    #[test]
    fn rows_have_names_for_templates() {
        let table = table();
        let named = table.named();
        for name in ["r=0.8,sigma=0.3", "r=last,sigma=0.3", "r=0.8,sigma=last", "r=last,sigma=last"]
        {
            assert_eq!(named[name]["mean"].id, "test.rise[r=0.8,sigma=0.3].mean", "{name}");
        }
        assert_eq!(named["r=first,sigma=0.1"]["mean"].id, "test.rise[r=0,sigma=0.1].mean");
        assert_eq!(table.values("r"), [0.0, 0.8]);
        let last = table.at("test.rise[r=last,sigma=first].mean");
        assert_eq!(last.unwrap().id, "test.rise[r=0.8,sigma=0.1].mean");
    }

    #[test]
    fn figures_and_data_take_columns() {
        let table = table();
        assert_eq!(table.points(&[("r", 0.0)], "sigma", "mean"), [(0.1, 1.5)]);
        let found = table.estimates(&[("r", 0.8)], "sigma", "mean");
        assert_eq!((found.len(), found[1].0, found[1].1.error), (2, 0.3, 0.5));
        let (header, rows) = table.data();
        assert_eq!(header[1..4], ["sigma (d omega^2)", "mean (1)", "mean_error (1)"]);
        assert_eq!(rows[1], ["0", "0.3", "", "", "0", ""]);
        assert_eq!(rows[3], ["0.8", "0.3", "7.5", "0.5", "2", "1.25"]);
    }

    #[test]
    #[should_panic(expected = "two rows with r=1")]
    fn no_two_rows_have_the_same_keys() {
        Table::of("test.twice", &[1.0, 1.0], |_| 1).key("r", "1", |row| *row).done();
    }
}
