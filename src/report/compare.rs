//! Which values changed against a committed values.json.

use super::Error;
use super::values::{Registry, Value};
use std::collections::BTreeSet;

/// One difference between two sets of values.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Id of the value.
    pub id: String,
    /// How it was printed; None for a new value.
    pub before: Option<String>,
    /// How it is printed now; None for a value that is gone.
    pub after: Option<String>,
}

impl std::fmt::Display for Change {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (&self.before, &self.after) {
            (Some(before), Some(after)) => write!(f, "{}: {before} -> {after}", self.id),
            (None, Some(after)) => write!(f, "{}: new, {after}", self.id),
            (Some(before), None) => write!(f, "{}: gone, was {before}", self.id),
            (None, None) => write!(f, "{}", self.id),
        }
    }
}

/// Reads a values.json.
///
/// # Errors
/// When it is not one.
pub fn read(text: &str) -> Result<Registry, Error> {
    serde_json::from_str(text).map_err(|e| Error::Template(format!("values.json: {e}")))
}

/// All changes of numbers, sorted by id; other fields (notes, sources) do not count.
pub fn changes(before: &Registry, after: &Registry) -> Vec<Change> {
    let ids: BTreeSet<&str> = before.iter().chain(after.iter()).map(|v| v.id.as_str()).collect();
    let differs = |id: &&str| {
        let number = |values: &Registry| values.get(id).map(|value| value.number.clone());
        number(before) != number(after)
    };
    let full = |value: Option<&Value>| value.map(|value| full_if_same(value, before, after));
    ids.into_iter()
        .filter(differs)
        .map(|id| Change {
            id: id.to_string(),
            before: full(before.get(id)),
            after: full(after.get(id)),
        })
        .collect()
}

/// The value in its own digits, or in full where those do not show the difference.
fn full_if_same(value: &Value, before: &Registry, after: &Registry) -> String {
    use super::print::{Asked, Style, print};
    let printed = |values: &Registry| values.get(&value.id).map(Value::plain);
    if printed(before) == printed(after) {
        let style = Style { digits: Some(Asked::Full), ..Style::default() };
        return print(&value.number, style).plain();
    }
    value.plain()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_found_and_shown() {
        let registry = |values: Vec<Value>| {
            let mut registry = Registry::new();
            registry.extend(values).unwrap();
            registry
        };
        let before = registry(vec![
            Value::real("a", 0.1, 2),
            Value::integer("b", 3),
            Value::integer("gone", 1),
            Value::integer("same", 1),
        ]);
        let after = registry(vec![
            Value::real("a", 0.1 + 1e-9, 2),
            Value::integer("b", 4),
            Value::integer("new", 1),
            Value::integer("same", 1).note("other words"),
        ]);
        let text = serde_json::to_string(&before).unwrap();
        assert_eq!(read(&text).unwrap(), before);
        let shown: Vec<String> = changes(&before, &after).iter().map(Change::to_string).collect();
        assert_eq!(
            shown,
            ["a: 0.1 -> 0.100000001", "b: 3 -> 4", "gone: gone, was 1", "new: new, 1"]
        );
        assert_eq!(changes(&after, &after), []);
    }
}
