//! Tells what people typed or calculated in the tags of a template from what was computed.

use super::lint::{Declared, find_numbers};
use std::collections::BTreeSet;

pub type Names = BTreeSet<String>;

/// Returns the names that `set` and loops give to what was typed or calculated: `n` in `for n in
/// [13.5]`.
pub fn names(template: &str) -> Names {
    let mut typed: Names = ["raw", "loop", "range"].map(String::from).into();
    for tag in template.split("<%").skip(1).filter_map(|tag| tag.split("%>").next()) {
        let tag = tag.trim_matches(|c: char| c == '-' || c.is_whitespace());
        let (word, rest) = tag.split_once(' ').unwrap_or_default();
        let given = match word {
            "set" | "set_global" => rest.split_once('='),
            "for" => rest.split_once(" in "),
            _ => None,
        };
        if let Some((names, _)) = given.filter(|(_, expression)| is_typed(expression, &typed)) {
            typed.extend(names.split(',').map(|name| name.trim().into()));
        }
    }
    typed
}

/// Returns whether an expression is more than the name of something with filters: it begins with a
/// number, words or a typed name, calculates, or has a number in it. Names of rows may have
/// numbers.
pub fn is_typed(expression: &str, typed: &Names) -> bool {
    let expression = expression.trim_start_matches(['-', ' ', '\n']);
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let name = expression.split(|c| !is_name(c)).next().unwrap_or_default();
    if name == "literal" {
        return false;
    }
    let (mut bare, mut rows) = (String::new(), 0);
    for c in expression.chars() {
        rows -= i32::from(c == ']');
        bare.extend((rows == 0).then_some(c));
        rows += i32::from(c == '[');
    }
    let mut quoted = false;
    let has_numbers = bare.split(['"', '\'', '`']).any(|part| {
        quoted = !quoted;
        let numbers = find_numbers(part, 0..part.len(), &Declared::default());
        // `nth(n=1)` chooses.
        let chooses = |offset: usize| quoted && part[..offset].ends_with(['=', '.']);
        quoted && part.contains(['*', '/', '+', '%'])
            || numbers.iter().any(|(offset, _)| !chooses(*offset))
    });
    !name.starts_with(char::is_alphabetic) || typed.contains(name) || has_numbers
}
