//! Pieces of the program's own source for the report, by the path of their item.
//!
//! The text is that of the real files when the program was built, so it travels with the binary
//! and cannot differ from what computed the numbers. The files are laid out by rustfmt, which
//! makes an item end at the first closing bracket that stands as far left as its first line.

/// Module, file and text of the whole source.
pub(super) const SOURCES: &[(&str, &str, &str)] = include!(concat!(env!("OUT_DIR"), "/sources.rs"));

/// What may be quoted: the layers that compute.
const QUOTED: [&str; 3] = ["numerics::", "dynamics::", "circuits::"];

/// An item of the source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Item {
    /// Its file, from the top of the project.
    pub file: &'static str,
    /// Its text with its documentation, moved to the left edge.
    pub text: String,
}

/// The item of a path: `circuits::jump::p_jump`, `dynamics::flight::Motion::kick`.
///
/// # Errors
/// One line that says what is unknown, and names what the module has.
pub fn item(path: &str) -> Result<Item, String> {
    let inside = |module: &str| path.strip_prefix(module)?.strip_prefix("::");
    let longest = SOURCES
        .iter()
        .filter(|_| QUOTED.iter().any(|layer| path.starts_with(layer)))
        .filter_map(|(module, file, text)| Some((inside(module)?, *module, *file, *text)))
        .min_by_key(|(name, ..)| name.len());
    let Some((name, module, file, text)) = longest else {
        return Err(format!(
            "there is no item `{path}`: no such module; name numerics::…, dynamics::… or circuits::…"
        ));
    };
    let found = items(text);
    match found.iter().find(|(own, ..)| own == name) {
        Some((_, _, lines)) => Ok(Item { file, text: text_of(lines) }),
        None => {
            let names: Vec<&str> = found.iter().map(|(name, ..)| name.as_str()).collect();
            Err(format!(
                "there is no item `{path}`: `{name}` was renamed or removed; {module} has {}",
                names.join(", ")
            ))
        }
    }
}

/// Items of a file, functions and types and methods: name, index of the line that declares it, and
/// its lines with their documentation.
pub(super) fn items(text: &str) -> Vec<(String, usize, Vec<&str>)> {
    let lines: Vec<&str> = text.lines().take_while(|line| *line != "#[cfg(test)]").collect();
    let mut found = Vec::new();
    // The type that an `impl` block is about, and where documentation of the next item begins.
    let (mut owner, mut first) = (None, None);
    let mut i = 0;
    while i < lines.len() {
        let (line, code) = (lines[i], lines[i].trim_start());
        let indent = line.len() - code.len();
        if code.starts_with("///") || code.starts_with("#[") {
            first.get_or_insert(i);
        } else if indent == 0 && code.starts_with("impl") {
            owner = (!code.ends_with("{}")).then(|| subject(code));
            first = None;
        } else if line == "}" {
            owner = None;
            first = None;
        } else if let Some(name) =
            declared(code).filter(|_| indent == 4 * usize::from(owner.is_some()))
        {
            let end = end(&lines, i, indent);
            let name = owner.as_ref().map_or(name.clone(), |owner| format!("{owner}::{name}"));
            found.push((name, i, lines[first.unwrap_or(i)..=end].to_vec()));
            first = None;
            i = end;
        } else {
            first = None;
        }
        i += 1;
    }
    found
}

/// The last line of the item that begins at line `first`.
fn end(lines: &[&str], first: usize, indent: usize) -> usize {
    let closes = |line: &str| {
        let code = line.trim_start();
        line.len() - code.len() == indent && code.starts_with(['}', ')', ']'])
    };
    let whole = |line: &str| line.ends_with(['}', ';']);
    if whole(lines[first]) {
        return first;
    }
    // A value that begins on the next line ends there, or where its bracket closes.
    let deeper = |line: &str| line.len() - line.trim_start().len() == indent + 4;
    let below = |line: &str| lines[first].ends_with('=') && deeper(line) && line.ends_with(';');
    // A text over several lines ends with its quotation mark, wherever that stands.
    let of_text = lines[first].contains(": &str = ");
    let text = |line: &str| of_text && (line.ends_with("\";") || line.ends_with("\"#;"));
    // A signature over several lines closes with `) -> T {`, which is no end.
    let last =
        |i: &usize| text(lines[*i]) || below(lines[*i]) || closes(lines[*i]) && whole(lines[*i]);
    (first + 1..lines.len()).find(last).unwrap_or(lines.len() - 1)
}

/// The name that a line declares: of a function, type or constant.
fn declared(code: &str) -> Option<String> {
    let mut words =
        code.split(|c: char| !(c.is_alphanumeric() || c == '_')).filter(|w| !w.is_empty());
    let mut word = words.next()?;
    while matches!(word, "pub" | "crate" | "super" | "const" | "in") {
        let next = words.next()?;
        if word == "const" && next != "fn" {
            return Some(next.to_string());
        }
        word = next;
    }
    let keyword = matches!(word, "fn" | "struct" | "enum" | "trait" | "static" | "type");
    keyword.then(|| words.next().map(str::to_string)).flatten()
}

/// `impl<const M: usize> Trait for Type<M> {` → Type.
fn subject(header: &str) -> String {
    let header = header.strip_prefix("impl").unwrap_or(header);
    let header = header.split(" for ").last().unwrap_or(header);
    let after = match header.strip_prefix('<').and_then(|rest| rest.split_once('>')) {
        Some((_, after)) => after,
        None => header,
    };
    after.trim_start().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
}

/// Lines at the left edge.
fn text_of(lines: &[&str]) -> String {
    let indent = lines.first().map_or(0, |line| line.len() - line.trim_start().len());
    let own = lines.iter().map(|line| line.get(indent..).unwrap_or_default());
    own.collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    /// The text stands in the file as it is on disk, line by line.
    #[test]
    fn the_text_is_that_of_the_file() {
        for (path, file, first, last) in [
            ("circuits::jump::p_jump", "crates/circuits/src/jump.rs", "pub fn p_jump(", "}"),
            ("circuits::jump::Jump", "crates/circuits/src/jump.rs", "pub struct Jump {", "}"),
            ("dynamics::impact::jumps", "crates/impact-chain/src/impact.rs", "pub fn jumps(", "}"),
            (
                "dynamics::flight::Motion::kick",
                "crates/impact-chain/src/flight.rs",
                "pub fn kick(",
                "}",
            ),
            (
                "numerics::first_root::LEVELS",
                "crates/numerics/src/first_root.rs",
                "const LEVELS",
                "= 2;",
            ),
        ] {
            let item = item(path).unwrap();
            assert_eq!(item.file, file);
            let on_disk =
                std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).unwrap();
            assert!(item.text.lines().any(|line| line.starts_with(first)), "{}", item.text);
            assert!(item.text.starts_with("/// ") && item.text.ends_with(last), "{}", item.text);
            let opened = |c| item.text.matches(c).count();
            assert_eq!(opened('{'), opened('}'), "{}", item.text);
            for line in item.text.lines() {
                assert!(on_disk.contains(line), "{line:?} is not in {file}");
            }
        }
    }

    #[test]
    fn every_item_is_whole() {
        let quoted =
            |module: &&str| QUOTED.iter().any(|layer| format!("{module}::").starts_with(layer));
        for (module, _, text) in SOURCES.iter().filter(|(module, ..)| quoted(module)) {
            for (name, _, lines) in items(text) {
                let text = lines.join("\n");
                let count = |c| text.matches(c).count();
                assert_eq!(count('{'), count('}'), "{module}::{name}:\n{text}");
            }
        }
    }

    #[test]
    fn no_item_hides_in_the_one_before() {
        for (module, _, text) in SOURCES {
            let items = items(text);
            let lines = text.lines().take_while(|line| *line != "#[cfg(test)]");
            let outside = |line: &str| !line.starts_with(' ') && declared(line).is_some();
            for (i, line) in lines.enumerate().filter(|(_, line)| outside(line)) {
                assert!(items.iter().any(|(_, at, _)| *at == i), "{module}: {line}");
            }
        }
    }

    #[test]
    fn a_renamed_item_is_refused() {
        let error = item("circuits::jump::p_yump").unwrap_err();
        assert!(error.contains("`p_yump`") && error.contains("p_jump, "), "{error}");
        assert!(item("circuits::yump::p_jump").unwrap_err().contains("there is no item"));
        assert!(item("cli::run").unwrap_err().contains("no such module"));
        assert!(item("dynamics::flight::Phases::kick").is_err());
    }
}
