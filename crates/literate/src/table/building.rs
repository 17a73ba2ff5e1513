//! Makes a table: each call adds a column, keys first.

use super::rows::{Column, Table, key_to_text};
use crate::sample::Sampled;
use crate::value::{Digits, Number, Origin, Provenance, Value, origin_of};
use std::collections::BTreeSet;
use std::panic::Location;
use std::rc::Rc;

/// A name or unit of a column.
type Name = &'static str;

/// A table that is being made, of rows R.
pub struct Building<'a, R> {
    rows: &'a [R],
    number: Rc<dyn Fn(&R) -> usize + 'a>,
    /// What computed the numbers, if that is not the code of their columns.
    origin: Option<Origin>,
    table: Table,
}

impl Table {
    /// Begins a table `experiment.what` with one row for each of `rows`, of `number` realisations.
    #[track_caller]
    pub fn builder<'a, R>(
        name: Name,
        rows: &'a [R],
        number: impl Fn(&R) -> usize + 'a,
    ) -> Building<'a, R> {
        let empty = rows.iter().map(|_| (String::new(), Vec::new())).collect();
        let place = Location::caller();
        let table = Table { name, columns: Vec::new(), keys: 0, rows: empty, place, fault: None };
        Building { rows, number: Rc::new(number), origin: None, table }
    }
}

impl<'a, R> Building<'a, R> {
    /// Adds a column, whose cells `cell` makes of what the author's code, `get`, returns.
    fn put<T, F: Fn(&R) -> T>(
        mut self,
        (name, unit): (Name, Name),
        meaning: &str,
        item: Option<Origin>,
        get: F,
        cell: impl Fn(&R, T) -> (Number, Provenance),
    ) -> Self {
        let item = item.unwrap_or_else(origin_of::<F>);
        let experiment = self.table.name.split('.').next().unwrap_or_default();
        let markdown = match unit {
            "1" | "text" => String::new(),
            _ => format!("${}$", unit.replace("omega", r"\omega ").replace(" ^", "^").trim_end()),
        };
        self.table.columns.push(Column { name, unit });
        for (row, (_, cells)) in self.rows.iter().zip(&mut self.table.rows) {
            let (number, kind) = cell(row, get(row));
            let value = Value::new("", number, kind).source(item.clone());
            let (unit, note, experiment) = (markdown.clone(), meaning.into(), experiment.into());
            cells.push(Value { unit, note, experiment, ..value });
        }
        self
    }

    /// Sets how many realisations the columns that follow are computed from.
    pub fn next_columns_over(mut self, number: impl Fn(&R) -> usize + 'a) -> Self {
        self.number = Rc::new(number);
        self
    }

    /// Sets what computed its estimates, reals and counts, but for [`Building::computed_by`].
    pub fn table_computed_by(mut self, item: Origin) -> Self {
        if !self.table.columns.is_empty() {
            self.fault("table_computed_by stands after columns; put it first".into());
        }
        self.origin = Some(item);
        self
    }

    /// Sets the item that computed the columns of these names, which stand before it.
    pub fn computed_by(self, item: Origin, names: &[&str]) -> Self {
        self.change(names, |cell| cell.source.clone_from(&item.0))
    }

    /// Marks the columns of these names, which stand before it, as measured.
    pub fn measured(self, names: &[&str]) -> Self {
        self.change(names, |cell| cell.kind = Provenance::Measured)
    }

    /// Marks all columns so far as measured, which makes them an input of the paper.
    pub fn all_measured(self) -> Self {
        let names: Vec<Name> = self.table.names().collect();
        self.measured(&names)
    }

    fn change(mut self, names: &[&str], change: impl Fn(&mut Value)) -> Self {
        for name in names {
            let place = self.table.names().position(|column| column == *name);
            if place.is_none() {
                self.fault(format!("no column before it has the name {name}"));
            }
            for (_, cells) in &mut self.table.rows {
                place.into_iter().for_each(|place| change(&mut cells[place]));
            }
        }
        self
    }

    fn count_key(&mut self, name: &str) {
        if self.table.keys < self.table.columns.len() {
            self.fault(format!("the key {name} stands after other columns; put keys first"));
        }
        self.table.keys += 1;
    }

    /// Notes what is wrong with the table; only the first fault is kept.
    fn fault(&mut self, problem: String) {
        let problem = format!("{}: the table {}: {problem}", self.table.place(), self.table.name);
        self.table.fault.get_or_insert(problem);
    }

    /// Adds a key: a parameter by which rows are found.
    pub fn key<K: Into<Number>, F: Fn(&R) -> K>(mut self, name: Name, unit: Name, get: F) -> Self {
        self.count_key(name);
        self.chosen(name, unit, "", get)
    }

    /// Adds a key of words.
    pub fn text_key<F: Fn(&R) -> String>(mut self, name: Name, get: F) -> Self {
        self.count_key(name);
        self.words(name, "", get)
    }

    /// Adds an estimate with its standard error; a cell has no number where `get` returns `None`.
    pub fn estimate<E: Into<Sampled>, F: Fn(&R) -> Option<E>>(
        self,
        name: Name,
        unit: Name,
        meaning: &str,
        get: F,
    ) -> Self {
        let (number, item) = (self.number.clone(), self.origin.clone());
        self.put((name, unit), meaning, item, get, |row, estimate| match estimate.map(E::into) {
            Some(Sampled { estimate, sample }) => {
                let (realisations, standard_error) = (number(row) as u64, estimate.error);
                (estimate.into(), Provenance::Ensemble { realisations, standard_error, sample })
            }
            None => (Number::None, Provenance::Exact),
        })
    }

    /// Adds a number that was computed without chance, with so many significant `digits`; a cell
    /// has no number where `get` returns `None`.
    pub fn real<V: Into<Option<f64>>, F: Fn(&R) -> V>(
        self,
        name: Name,
        unit: Name,
        digits: usize,
        meaning: &str,
        get: F,
    ) -> Self {
        let (digits, item) = (Digits::Significant(digits), self.origin.clone());
        self.put((name, unit), meaning, item, get, |_, value| match value.into() {
            Some(value) => (Number::Real { value, digits }, Provenance::Deterministic),
            None => (Number::None, Provenance::Exact),
        })
    }

    /// Adds a column of words.
    pub fn words<W: Into<Number>, F: Fn(&R) -> W>(self, name: Name, meaning: &str, get: F) -> Self {
        self.put((name, "text"), meaning, None, get, |_, words| (words.into(), Provenance::Exact))
    }

    /// Adds a parameter that was chosen, with all its digits; a cell may have no number.
    pub fn chosen<K: Into<Number>, F: Fn(&R) -> K>(
        self,
        name: Name,
        unit: Name,
        meaning: &str,
        get: F,
    ) -> Self {
        self.put((name, unit), meaning, None, get, |_, x| (x.into(), Provenance::Deterministic))
    }

    /// Adds a count, shown as an integer up to a million and with its leading digits beyond.
    pub fn count<F: Fn(&R) -> u64>(self, name: Name, meaning: &str, get: F) -> Self {
        let item = self.origin.clone();
        self.put((name, "1"), meaning, item, get, |_, n| match n {
            ..1_000_000 => (n.into(), Provenance::Exact),
            _ => (Number::from(n).significant(2), Provenance::Deterministic),
        })
    }

    /// Names the rows by their keys. What is wrong with it is an error when the table is asked for.
    pub fn done(mut self) -> Table {
        let columns = self.table.columns.clone();
        for (index, column) in columns.iter().enumerate() {
            if columns[..index].iter().any(|before| before.name == column.name) {
                self.fault(format!("two columns have the name {}; rename one", column.name));
            }
        }
        let (name, keys) = (self.table.name, self.table.keys);
        let (mut seen, mut faults) = (BTreeSet::new(), Vec::new());
        for (row, cells) in &mut self.table.rows {
            let keyed = columns.iter().zip(&*cells).take(keys);
            let keyed = keyed.map(|(key, cell)| format!("{}={}", key.name, key_to_text(cell)));
            *row = keyed.collect::<Vec<_>>().join(",");
            if !seen.insert(row.clone()) {
                faults.push(format!("two rows have the keys [{row}]; add a key that differs"));
            }
            let brackets = if row.is_empty() { String::new() } else { format!("[{row}]") };
            for (column, cell) in columns.iter().zip(cells) {
                cell.id = format!("{name}{brackets}.{}", column.name);
                if !cell.number.is_finite() {
                    let remedy = "correct it, or return None where there is no number";
                    faults.push(format!("{} is {}; {remedy}", cell.id, cell.to_plain_text()));
                }
            }
        }
        faults.into_iter().for_each(|fault| self.fault(fault));
        self.table
    }
}
