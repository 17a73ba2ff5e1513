//! Checks names, of which files, addresses and anchors are made.

use std::collections::BTreeMap;

/// Names that no file may have on some systems.
const RESERVED: [&str; 4] = ["con", "prn", "aux", "nul"];

/// Returns what is wrong with a name, or `None`: it has letters, digits, `-`, `_` and `.` only.
pub fn fault(name: &str) -> Option<String> {
    let is_sign = |c: char| c.is_alphanumeric() || "-_.".contains(c);
    let stem = name.split('.').next().unwrap_or_default().to_lowercase();
    let problem = match name.chars().find(|c| !is_sign(*c)) {
        Some(sign) => format!("has {sign:?} in it"),
        None if name.is_empty() => "is empty".into(),
        None if name.starts_with('.') || name.ends_with('.') => "has a point at an end".into(),
        None if RESERVED.contains(&stem.as_str()) => "is that of a device on some systems".into(),
        None => return None,
    };
    Some(format!("the name {name:?} {problem}; use letters, digits, -, _ and ."))
}

/// Names of things of one kind, of which no two may give one file or anchor.
#[derive(Debug, Default)]
pub struct Names(BTreeMap<String, (String, String)>);

impl Names {
    /// Adds the name of a thing at a place in the source. Fails if an earlier name is the same, or
    /// differs only in the case of letters or in `.`, `:` and `-`.
    pub fn add(&mut self, name: &str, place: &str) -> Result<(), String> {
        let file_name = name.to_lowercase().replace(['.', ':'], "-");
        let earlier = self.0.insert(file_name, (name.into(), place.into()));
        let Some((other, earlier_place)) = earlier else { return Ok(()) };
        let reason = "which differ in case or in . and - only, so that they have one file";
        let both = format!("{earlier_place} and {place}; rename one");
        if other == name {
            return Err(format!("the name {name}: {both}"));
        }
        Err(format!("the names {other} and {name}, {reason}: {both}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_make_files_of_their_own() {
        for name in ["", "a b", "a/b", "../a", ".a", "a.", "con", "Aux.x", "a\nb"] {
            assert!(fault(name).is_some(), "{name}");
        }
        for name in ["fig03", "sweep.rows", "d-t", "σ_half", "conic"] {
            assert_eq!(fault(name), None);
        }
        let mut names = Names::default();
        assert_eq!(names.add("a.b", "x:1"), Ok(()));
        assert_eq!(names.add("ab", "x:2"), Ok(()));
        let same = names.add("a.b", "x:3").unwrap_err();
        assert_eq!(same, "the name a.b: x:1 and x:3; rename one");
        for name in ["a-b", "A.b", "a:b"] {
            assert!(names.add(name, "x:4").unwrap_err().contains("so that they have one file"));
        }
    }
}
