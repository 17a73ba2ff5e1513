//! Where an item of the source stands, looked up when it is shown: paths of items stay true when
//! lines move, so the report stores those.

use super::literate::{SOURCES, items};

/// A file and a line in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file, from the top of the project.
    pub file: &'static str,
    /// The line where the item begins, from 1; a module begins at 1.
    pub line: usize,
}

/// The place of an item or a module, in the files as `read` gives them, or else as they were when
/// the program was built. None if there is no such item.
pub fn place(path: &str, read: impl Fn(&str) -> Option<String>) -> Option<Place> {
    if let Some((_, file, _)) = SOURCES.iter().find(|(module, ..)| *module == path) {
        return Some(Place { file, line: 1 });
    }
    let inside = |module: &str| path.strip_prefix(module)?.strip_prefix("::");
    let found =
        SOURCES.iter().filter_map(|(module, file, text)| Some((inside(module)?, file, text)));
    let (name, file, text) = found.min_by_key(|(name, ..)| name.len())?;
    let text = read(file).unwrap_or_else(|| text.to_string());
    let own = items(&text).into_iter().find(|(own, ..)| own == name)?;
    Some(Place { file, line: own.1 + 1 })
}

/// The file of an item, as it was when the program was built.
pub fn file(path: &str) -> Option<&'static str> {
    place(path, |_| None).map(|place| place.file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_and_modules_have_a_place() {
        let jump = place("circuits::jump::p_jump", |_| None).unwrap();
        assert_eq!(jump.file, "crates/circuits/src/jump.rs");
        let text = std::fs::read_to_string(jump.file).unwrap();
        assert!(text.lines().nth(jump.line - 1).unwrap().contains("fn p_jump"));
        // Two lines more at the top of the working copy.
        let moved = place("circuits::jump::p_jump", |_| Some(format!("//! a\n//! b\n{text}")));
        assert_eq!(moved.unwrap().line, jump.line + 2);
        assert_eq!(place("claims::sec8", |_| None).unwrap().line, 1);
        assert_eq!(place("circuits::jump::p_yump", |_| None), None);
    }
}
