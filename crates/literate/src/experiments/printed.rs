//! Reads the tables that a command printed.

use crate::decimal::Decimal;
use crate::table::{Building, Table, no_such};
use crate::value::{Digits, Number, Origin};
use impact_numerics::estimates::with_error;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Value as Json;
use serde_json::value::RawValue;
use std::collections::BTreeMap;
use std::fmt;

/// A table as a command prints it. The manual ([`crate::manual`]) explains the fields.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PrintedTable {
    #[serde(default)]
    keys: Vec<String>,
    columns: Vec<String>,
    #[serde(default)]
    units: BTreeMap<String, String>,
    #[serde(default)]
    digits: BTreeMap<String, usize>,
    #[serde(default)]
    meanings: BTreeMap<String, String>,
    rows: Vec<Vec<Cell>>,
}

/// A cell, and as what it was printed: a double may have fewer digits.
#[derive(Clone, Debug, PartialEq)]
struct Cell {
    json: Json,
    text: String,
}

impl<'de> Deserialize<'de> for Cell {
    fn deserialize<D: Deserializer<'de>>(reader: D) -> Result<Self, D::Error> {
        let text = Box::<RawValue>::deserialize(reader)?.get().to_string();
        let beyond = |_| format!("{text} is beyond double precision (print it in another unit)");
        let json = serde_json::from_str(&text).map_err(beyond).map_err(D::Error::custom)?;
        Ok(Cell { json, text })
    }
}

impl Serialize for Cell {
    fn serialize<S: Serializer>(&self, writer: S) -> Result<S::Ok, S::Error> {
        let text = RawValue::from_string(self.text.clone());
        text.map_err(serde::ser::Error::custom)?.serialize(writer)
    }
}

/// Reads the tables of a command by their names, each of which may stand only once.
pub(super) fn tables_by_name<'de, D: Deserializer<'de>>(
    reader: D,
) -> Result<BTreeMap<String, PrintedTable>, D::Error> {
    struct ByName;
    impl<'de> Visitor<'de> for ByName {
        type Value = BTreeMap<String, PrintedTable>;

        fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
            formatter.write_str("an object of tables by their names")
        }

        fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
            let mut tables = BTreeMap::new();
            while let Some((name, table)) = map.next_entry::<String, PrintedTable>()? {
                if tables.insert(name.clone(), table).is_some() {
                    let problem = format!("two tables have the name {name} (rename one)");
                    return Err(A::Error::custom(problem));
                }
            }
            Ok(tables)
        }
    }
    reader.deserialize_map(ByName)
}

impl PrintedTable {
    fn names(&self) -> impl Iterator<Item = &str> {
        self.keys.iter().chain(&self.columns).map(String::as_str)
    }

    fn place(&self, name: &str) -> Option<usize> {
        self.names().position(|other| other == name)
    }

    fn error_of(&self, name: &str) -> Option<usize> {
        self.place(&format!("{name}_error"))
    }

    /// What is wrong with it, if anything: a name, a field for a column that is not there, a row.
    pub(super) fn fault(&self, experiment: &str, name: &str, line: &'static str) -> Option<String> {
        let is_name = |name: &str| name.chars().all(|c| c.is_alphanumeric() || c == '_');
        if let Some(name) = self.names().find(|name| name.is_empty() || !is_name(name)) {
            return Some(format!("{name:?} is not a name of letters, digits and `_`"));
        }
        for (field, columns) in [
            ("units", self.units.keys().collect::<Vec<_>>()),
            ("digits", self.digits.keys().collect()),
            ("meanings", self.meanings.keys().collect()),
        ] {
            if let Some(lost) = columns.into_iter().find(|name| self.place(name).is_none()) {
                return Some(format!("{field}: {}", no_such("column", lost, self.names())));
            }
        }
        for (name, digits) in &self.digits {
            if self.error_of(name).is_some() || !(1..=17).contains(digits) {
                let remedy = "1 to 17, or an error, which decides them";
                return Some(format!("digits: give {name} {remedy}"));
            }
        }
        for (row, at) in self.rows.iter().zip(1..) {
            if let Some(fault) = self.fault_in(row) {
                return Some(format!("row {at} {fault}"));
            }
        }
        let table = self.table(experiment, name, line);
        // Behind a place in our source and the name of the table.
        table.fault.as_ref()?.splitn(3, ": ").nth(2).map(String::from)
    }

    fn fault_in(&self, row: &[Cell]) -> Option<String> {
        let all = self.names().count();
        if row.len() != all {
            return Some(format!("has {} of {all} cells; null is none", row.len()));
        }
        for (at, (name, Cell { json: cell, .. })) in self.names().zip(row).enumerate() {
            if cell.is_array() || cell.is_object() {
                return Some(format!("has more than a number or a word as {name}"));
            }
            if cell.is_null() && at < self.keys.len() {
                return Some(format!("has no {name}, which is a key"));
            }
            if let Some(error) = self.error_of(name).filter(|_| !cell.is_null()) {
                let valid = row[error].json.as_f64().is_some_and(|error| error >= 0.0);
                if cell.as_f64().is_none() || !valid {
                    let names = format!("{name} and {name}_error, or null as {name}");
                    return Some(format!("needs numbers as {names}"));
                }
            }
        }
        None
    }

    /// The table `experiment.name` that it is, once it has no fault.
    pub(super) fn table(&self, experiment: &str, name: &str, line: &'static str) -> Table {
        let name = leaked(&format!("{experiment}.{name}"));
        let mut table = Table::builder(name, &self.rows, |_| 0);
        for (at, name) in self.names().enumerate() {
            let estimate = name.strip_suffix("_error").and_then(|other| self.place(other));
            if estimate.is_none() {
                table = self.add(table, at, leaked(name));
                table = table.computed_by(Origin(line.into()), &[name]);
            }
        }
        table.done()
    }

    fn add<'a>(
        &'a self,
        table: Building<'a, Vec<Cell>>,
        at: usize,
        name: &'static str,
    ) -> Building<'a, Vec<Cell>> {
        let is_key = at < self.keys.len();
        let unit = self.units.get(name).map_or("1", |unit| leaked(unit));
        let meaning = self.meanings.get(name).map_or("", String::as_str);
        let number = move |row: &Vec<Cell>| row[at].json.as_f64();
        let exact = move |row: &Vec<Cell>| row[at].exact();
        if self.rows.iter().any(|row| row[at].json.is_string() || row[at].json.is_boolean()) {
            let words = move |row: &Vec<Cell>| {
                let Cell { json, text } = &row[at];
                json.as_str().unwrap_or(text).to_string()
            };
            let cell = move |row: &Vec<Cell>| (!row[at].json.is_null()).then(|| words(row));
            return if is_key {
                table.text_key(name, words)
            } else {
                table.words(name, meaning, cell)
            };
        }
        if is_key {
            return table.key(name, unit, exact);
        }
        if let Some(error) = self.error_of(name) {
            return table.estimate(name, unit, meaning, move |row| {
                Some(with_error(number(row)?, row[error].json.as_f64()?))
            });
        }
        match self.digits.get(name) {
            Some(&digits) => table.real(name, unit, digits, meaning, number),
            None => table.chosen(name, unit, meaning, exact),
        }
    }
}

impl Cell {
    /// Returns it with all its digits, or no number for null.
    fn exact(&self) -> Number {
        let Json::Number(number) = &self.json else { return Number::None };
        let value = number.as_f64().unwrap_or(f64::NAN);
        let (number, full) = match number.as_i128() {
            Some(n) => (Number::Integer(n), Decimal::integer(n)),
            None => (value.into(), Decimal::shortest(value)),
        };
        // A double says nothing of digits that it lacks, and of zeros at the end.
        if Decimal::read(&self.text) == full {
            return number;
        }
        Number::Real { value, digits: Digits::Text(leaked(&self.text)) }
    }
}

/// Keeps names and digits of tables as long as the program runs.
fn leaked(text: &str) -> &'static str {
    text.to_string().leak()
}
