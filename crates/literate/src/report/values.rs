//! Collects all values of a report: those with a name, and the cells of tables by their addresses.

use super::error::Error;
use crate::experiments::Profile;
use crate::input::{is_control, one_line};
use crate::source::Sources;
use crate::table::{Table, Tables};
pub(crate) use crate::value::{Digits, Number, Provenance, Value, origin};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ValueRegistry {
    values: BTreeMap<String, Value>,
    #[serde(skip)]
    tables: Tables,
}

impl ValueRegistry {
    pub(crate) fn add(&mut self, value: Value) -> Result<(), Error> {
        check_showable(&value)?;
        if let Some(before) = self.values.get(&value.id) {
            return Err(Error::twice(&value.id, &before.source, &value.source));
        }
        self.values.insert(value.id.clone(), value);
        Ok(())
    }

    pub(crate) fn add_tables(&mut self, tables: &Tables) -> Result<(), Error> {
        for table in tables.values() {
            if let Some(value) = self.values.get(table.name()) {
                return Err(Error::twice(&value.id, &value.source, &table.place()));
            }
            table.cells().try_for_each(check_showable)?;
        }
        self.tables = tables.clone();
        Ok(())
    }

    pub(crate) fn tables(&self) -> impl Iterator<Item = &Table> {
        self.tables.values().map(AsRef::as_ref)
    }

    /// Lists the cells that documents show, and shortens the paths of items to what they show.
    pub(crate) fn list(&mut self, shown: impl Iterator<Item = String>, sources: &Sources) {
        for address in shown {
            if let Some(cell) = self.cell(&address).cloned() {
                self.values.insert(address, cell);
            }
        }
        for value in self.values.values_mut() {
            value.source = sources.shorten(&value.source).to_string();
        }
    }

    fn cell(&self, address: &str) -> Option<&Value> {
        self.tables.get(crate::table::table_name(address)?)?.cell(address)
    }

    pub(crate) fn extend(&mut self, values: impl IntoIterator<Item = Value>) -> Result<(), Error> {
        values.into_iter().try_for_each(|value| self.add(value))
    }

    pub(crate) fn get(&self, id: &str) -> Option<&Value> {
        self.values.get(id).or_else(|| self.cell(id))
    }

    pub(crate) fn profile(&self) -> Option<Profile> {
        match &self.get("profile")?.number {
            Number::Text(name) => clap::ValueEnum::from_str(name, false).ok(),
            _ => None,
        }
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &Value> {
        self.values.values()
    }
}

/// Refuses a number that is not finite, and words with a character that no format can show.
fn check_showable(value: &Value) -> Result<(), Error> {
    let words = if let Number::Text(words) = &value.number { words } else { "" };
    // Characters for private use frame values in filled prose.
    let hidden = |c: &char| match c {
        '\n' | '\r' | '\t' => false,
        '\u{e000}'..='\u{f8ff}' | '\u{fffe}' | '\u{ffff}' => true,
        c => is_control(*c),
    };
    match value.id.chars().chain(words.chars()).find(hidden) {
        Some(c) => Err(Error::Message(format!(
            "value {}: its words have the character U+{:04X}, which no format can show; leave it out where they come from",
            one_line(&value.id, 200),
            u32::from(c)
        ))),
        None if !value.number.is_finite() => {
            let remedy = "leave it out or say why there is none in words";
            Err(Error::Message(format!("value {}: not a finite number; {remedy}", value.id)))
        }
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_has_one_owner_and_a_number_is_finite() {
        let mut registry = ValueRegistry::default();
        registry.add(Value::integer("edges", 16)).unwrap();
        for wrong in [Value::integer("edges", 17), Value::real("x", f64::NAN, 2)] {
            registry.add(wrong).unwrap_err();
        }
    }
}
