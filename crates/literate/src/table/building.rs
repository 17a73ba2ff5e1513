//! A table that is being made: each call adds a column, keys first.

use super::rows::{Column, Table, called};
use crate::value::{Digits, Kind, Number, Origin, Value, origin_of};
use impact_numerics::statistics::Estimate;
use std::rc::Rc;

/// A table that is being made, of rows R.
pub struct Building<'a, R> {
    rows: &'a [R],
    experiment: &'static str,
    /// Realisations of a row.
    number: Rc<dyn Fn(&R) -> usize + 'a>,
    /// What computed the cells, if that is not the code of their column.
    origin: Option<Origin>,
    table: Table,
}

impl Table {
    /// Begins a table `experiment.what` with one row for each of `rows`, of so many realisations.
    pub fn of<'a, R>(
        name: &'static str,
        rows: &'a [R],
        number: impl Fn(&R) -> usize + 'a,
    ) -> Building<'a, R> {
        let experiment = name.split('.').next().unwrap_or_default();
        let empty = rows.iter().map(|_| (String::new(), Vec::new())).collect();
        let table = Table { name, columns: Vec::new(), keys: 0, rows: empty };
        Building { rows, experiment, number: Rc::new(number), origin: None, table }
    }
}

/// A unit as Markdown.
fn markdown(unit: &str) -> String {
    match unit {
        "1" | "text" => String::new(),
        unit => format!("${}$", unit.replace("omega", r"\omega ").replace(" ^", "^").trim_end()),
    }
}

/// A number that was chosen, with all its digits: an integer where it is one.
fn as_chosen(value: f64) -> Value {
    let whole = value.fract() == 0.0 && value.abs() < 1e15;
    let number = match whole {
        true => Number::Integer(value as i64),
        false => Number::Real { value, digits: Digits::of(value) },
    };
    Value { number, ..Value::real("", value, 1) }
}

fn none() -> Value {
    Value::text("", "none")
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

    /// Columns from here on are of so many realisations.
    pub fn over(mut self, number: impl Fn(&R) -> usize + 'a) -> Self {
        self.number = Rc::new(number);
        self
    }

    /// Columns from here on show what this item computed.
    pub fn computed_by(mut self, item: Origin) -> Self {
        self.origin = Some(item);
        self
    }

    fn one_key_more(&mut self, name: &str) {
        assert_eq!(self.table.keys, self.table.columns.len(), "{name}: keys come first");
        self.table.keys += 1;
    }

    /// A key: a parameter by which rows are found.
    pub fn key<F: Fn(&R) -> f64>(mut self, name: &'static str, unit: &'static str, of: F) -> Self {
        self.one_key_more(name);
        self.put((name, unit), "", origin_of::<F>(), |row: &R| as_chosen(of(row)))
    }

    /// A key that is a name.
    pub fn text_key<F: Fn(&R) -> String>(mut self, name: &'static str, of: F) -> Self {
        self.one_key_more(name);
        self.put((name, "text"), "", origin_of::<F>(), |row: &R| Value::text("", of(row)))
    }

    /// A number from chance with its standard error, or the word *none* where the sample decides
    /// nothing.
    pub fn estimate<F: Fn(&R) -> Option<Estimate>>(
        self,
        name: &'static str,
        unit: &'static str,
        meaning: &str,
        of: F,
    ) -> Self {
        let number = self.number.clone();
        let value =
            |row: &R, own: Estimate| Value::ensemble("", own.value, own.error, number(row) as u64);
        let cell = |row: &R| of(row).map_or_else(none, |own| value(row, own));
        self.put((name, unit), meaning, origin_of::<F>(), cell)
    }

    /// A number that no chance has part in, with so many significant digits; *none* if it is not
    /// finite.
    pub fn real<F: Fn(&R) -> f64>(
        self,
        name: &'static str,
        unit: &'static str,
        digits: usize,
        meaning: &str,
        of: F,
    ) -> Self {
        let real = |value: f64| value.is_finite().then(|| Value::real("", value, digits));
        let cell = |row: &R| real(of(row)).unwrap_or_else(none);
        self.put((name, unit), meaning, origin_of::<F>(), cell)
    }

    /// Words that were computed.
    pub fn words<F: Fn(&R) -> String>(self, name: &'static str, meaning: &str, of: F) -> Self {
        self.put((name, "text"), meaning, origin_of::<F>(), |row: &R| Value::text("", of(row)))
    }

    /// All cells so far were measured, and are an input.
    pub fn measured(mut self) -> Self {
        for cell in self.table.rows.iter_mut().flat_map(|(_, cells)| cells) {
            cell.kind = Kind::Measured;
        }
        self
    }

    /// A parameter, with all its digits, or *none*.
    pub fn chosen<F: Fn(&R) -> Option<f64>>(
        self,
        name: &'static str,
        unit: &'static str,
        meaning: &str,
        of: F,
    ) -> Self {
        let cell = |row: &R| of(row).map_or_else(none, as_chosen);
        self.put((name, unit), meaning, origin_of::<F>(), cell)
    }

    /// A count, shown as an integer up to a million and with its leading digits beyond.
    pub fn count<F: Fn(&R) -> u64>(self, name: &'static str, meaning: &str, of: F) -> Self {
        let cell = |row: &R| match of(row) {
            n if n < 1_000_000 => Value::integer("", n),
            n => Value::real("", n as f64, 2),
        };
        self.put((name, "1"), meaning, origin_of::<F>(), cell)
    }

    /// Gives cells of a column the id of the number that they are: one that another table or a
    /// value has already.
    pub fn same(mut self, column: &str, of: impl Fn(&R) -> Option<String>) -> Self {
        if let Some(at) = self.table.column(column) {
            for (row, (_, cells)) in self.rows.iter().zip(&mut self.table.rows) {
                cells[at].id = of(row).unwrap_or_default();
            }
        }
        self
    }

    /// The table.
    ///
    /// # Panics
    /// If two rows have the same keys.
    pub fn done(self) -> Table {
        let mut table = self.table;
        let columns = table.columns.clone();
        let mut seen = std::collections::BTreeSet::new();
        for (name, cells) in &mut table.rows {
            let keys = columns.iter().zip(&*cells).take(table.keys);
            let keys: Vec<String> =
                keys.map(|(key, cell)| format!("{}={}", key.name, called(cell))).collect();
            *name = keys.join(",");
            assert!(seen.insert(name.clone()), "{}: two rows with {name}", table.name);
            let row = if name.is_empty() { String::new() } else { format!("[{name}]") };
            for (column, cell) in columns.iter().zip(cells) {
                if cell.id.is_empty() {
                    cell.id = format!("{}{row}.{}", table.name, column.name);
                }
            }
        }
        table
    }
}
