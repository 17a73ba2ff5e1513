//! Makes a table: each call adds a column, keys first.

use super::rows::{Column, Table, called};
use crate::value::{Kind, Number, Origin, Value, origin_of};
use impact_numerics::statistics::Estimate;
use std::collections::BTreeSet;
use std::panic::Location;
use std::rc::Rc;

/// A table that is being made, of rows R.
pub struct Building<'a, R> {
    rows: &'a [R],
    experiment: &'static str,
    /// Returns the realisations behind a row.
    number: Rc<dyn Fn(&R) -> usize + 'a>,
    /// What computed the cells, if that is not the code of their column.
    origin: Option<Origin>,
    table: Table,
}

impl Table {
    /// Begins a table `experiment.what` with one row for each of `rows`, of so many realisations.
    #[track_caller]
    pub fn of<'a, R>(
        name: &'static str,
        rows: &'a [R],
        number: impl Fn(&R) -> usize + 'a,
    ) -> Building<'a, R> {
        let experiment = name.split('.').next().unwrap_or_default();
        let empty = rows.iter().map(|_| (String::new(), Vec::new())).collect();
        let place = Location::caller();
        let table = Table { name, columns: Vec::new(), keys: 0, rows: empty, place, fault: None };
        Building { rows, experiment, number: Rc::new(number), origin: None, table }
    }
}

/// Writes a unit as Markdown.
fn markdown(unit: &str) -> String {
    match unit {
        "1" | "text" => String::new(),
        unit => format!("${}$", unit.replace("omega", r"\omega ").replace(" ^", "^").trim_end()),
    }
}

/// Makes a cell of what was chosen or counted, or without a number.
fn as_chosen(number: impl Into<Number>) -> Value {
    Value { number: number.into(), ..Value::real("", 0.0, 1) }
}

/// Makes a cell of words, or without a number.
fn as_text(words: impl Into<Number>) -> Value {
    Value { number: words.into(), ..Value::text("", "") }
}

/// Adds a column of cells, each finished in the same way.
fn add(table: &mut Table, column: Column, cells: Vec<Value>, finish: &dyn Fn(Value) -> Value) {
    table.columns.push(column);
    for (cell, (_, row)) in cells.into_iter().zip(&mut table.rows) {
        row.push(finish(cell));
    }
}

impl<'a, R> Building<'a, R> {
    fn put(
        mut self,
        (name, unit): (&'static str, &'static str),
        meaning: &str,
        item: Origin,
        cell: impl Fn(&R) -> Value,
    ) -> Self {
        let cells = self.rows.iter().map(cell).collect();
        let item = self.origin.as_ref().unwrap_or(&item);
        add(&mut self.table, Column { name, unit }, cells, &|cell: Value| {
            cell.unit(markdown(unit)).note(meaning).source(item.clone(), self.experiment)
        });
        self
    }

    /// Sets the number of realisations behind the columns that follow.
    pub fn over(mut self, number: impl Fn(&R) -> usize + 'a) -> Self {
        self.number = Rc::new(number);
        self
    }

    /// Sets the item that computed the columns that follow.
    pub fn computed_by(mut self, item: Origin) -> Self {
        self.origin = Some(item);
        self
    }

    fn count_key(&mut self, name: &str) {
        if self.table.keys < self.table.columns.len() {
            self.fault(format!("the key {name} stands after other columns; put keys first"));
        }
        self.table.keys += 1;
    }

    /// Notes what is wrong with the table, unless something was noted before.
    fn fault(&mut self, what: String) {
        let what = format!("{}: the table {}: {what}", self.table.place(), self.table.name);
        self.table.fault.get_or_insert(what);
    }

    /// Adds a key: a parameter by which rows are found.
    pub fn key<K: Into<Number>, F: Fn(&R) -> K>(
        mut self,
        name: &'static str,
        unit: &'static str,
        get: F,
    ) -> Self {
        self.count_key(name);
        self.put((name, unit), "", origin_of::<F>(), |row: &R| as_chosen(get(row)))
    }

    /// Adds a key that is a name.
    pub fn text_key<F: Fn(&R) -> String>(mut self, name: &'static str, get: F) -> Self {
        self.count_key(name);
        self.put((name, "text"), "", origin_of::<F>(), |row: &R| Value::text("", get(row)))
    }

    /// Adds a number from chance with its standard error; none where the sample decides nothing.
    pub fn estimate<F: Fn(&R) -> Option<Estimate>>(
        self,
        name: &'static str,
        unit: &'static str,
        meaning: &str,
        get: F,
    ) -> Self {
        let number = self.number.clone();
        let cell = |row: &R| match get(row) {
            Some(Estimate { value, error, .. }) => {
                Value::ensemble("", value, error, number(row) as u64)
            }
            None => as_text(Number::None),
        };
        self.put((name, unit), meaning, origin_of::<F>(), cell)
    }

    /// Adds a number that was computed without chance, with so many significant digits, or none.
    pub fn real<V: Into<Option<f64>>, F: Fn(&R) -> V>(
        self,
        name: &'static str,
        unit: &'static str,
        digits: usize,
        meaning: &str,
        get: F,
    ) -> Self {
        let cell = |row: &R| match get(row).into() {
            Some(value) => Value::real("", value, digits),
            None => as_text(Number::None),
        };
        self.put((name, unit), meaning, origin_of::<F>(), cell)
    }

    /// Adds words that were computed, or none.
    pub fn words<W: Into<Number>, F: Fn(&R) -> W>(
        self,
        name: &'static str,
        meaning: &str,
        get: F,
    ) -> Self {
        self.put((name, "text"), meaning, origin_of::<F>(), |row: &R| as_text(get(row)))
    }

    /// Marks all cells so far as measured: they are an input.
    pub fn measured(mut self) -> Self {
        for cell in self.table.rows.iter_mut().flat_map(|(_, cells)| cells) {
            cell.kind = Kind::Measured;
        }
        self
    }

    /// Adds a parameter, with all its digits, or none.
    pub fn chosen<K: Into<Number>, F: Fn(&R) -> K>(
        self,
        name: &'static str,
        unit: &'static str,
        meaning: &str,
        get: F,
    ) -> Self {
        self.put((name, unit), meaning, origin_of::<F>(), |row: &R| as_chosen(get(row)))
    }

    /// Adds a count, shown as an integer up to a million and with its leading digits beyond.
    pub fn count<F: Fn(&R) -> u64>(self, name: &'static str, meaning: &str, get: F) -> Self {
        let cell = |row: &R| match get(row) {
            n if n < 1_000_000 => Value::integer("", n),
            n => Value::real("", n as f64, 2),
        };
        self.put((name, "1"), meaning, origin_of::<F>(), cell)
    }

    /// Gives cells of a column the id of the number that they are: one that another table or a
    /// value has already.
    pub fn same(mut self, column: &str, get: impl Fn(&R) -> Option<String>) -> Self {
        match self.table.column(column) {
            Ok(at) => {
                for (row, (_, cells)) in self.rows.iter().zip(&mut self.table.rows) {
                    cells[at].id = get(row).unwrap_or_default();
                }
            }
            Err(missing) => self.fault(missing.to_string()),
        }
        self
    }

    /// Names the rows by their keys, and notes what is wrong: [`Results::tables`] refuses the
    /// table for two columns or rows of one name, and for numbers that are not finite.
    ///
    /// [`Results::tables`]: crate::experiments::Results::tables
    pub fn done(mut self) -> Table {
        let columns = self.table.columns.clone();
        for (at, column) in columns.iter().enumerate() {
            if columns[..at].iter().any(|before| before.name == column.name) {
                self.fault(format!("two columns have the name {}; rename one", column.name));
            }
        }
        let (name, keys) = (self.table.name, self.table.keys);
        let (mut seen, mut faults) = (BTreeSet::new(), Vec::new());
        for (row, cells) in &mut self.table.rows {
            let named = columns.iter().zip(&*cells).take(keys);
            let named: Vec<String> =
                named.map(|(key, cell)| format!("{}={}", key.name, called(&cell.number))).collect();
            *row = named.join(",");
            if !seen.insert(row.clone()) {
                faults.push(format!("two rows have the keys [{row}]; add a key that differs"));
            }
            let brackets = if row.is_empty() { String::new() } else { format!("[{row}]") };
            for (column, cell) in columns.iter().zip(cells) {
                let address = format!("{name}{brackets}.{}", column.name);
                if !cell.number.is_finite() {
                    let remedy = "correct it, or return None where there is no number";
                    faults.push(format!("{address} is {}; {remedy}", cell.plain()));
                }
                if cell.id.is_empty() {
                    cell.id = address;
                }
            }
        }
        faults.into_iter().for_each(|fault| self.fault(fault));
        self.table
    }
}
