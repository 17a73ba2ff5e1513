//! The program that makes the documents, as far as they speak of it: its source, its experiments.
//!
//! The text of the source is that of the real files when the program was built, so it travels with the binary
//! and cannot differ from what computed the numbers. The files are laid out by rustfmt, which
//! makes an item end at the first closing bracket that stands as far left as its first line.

use crate::report::Document;
use serde::Serialize;
use serde_json::Value as Json;

/// What the documents must know of the program that makes them.
#[derive(Clone, Copy)]
pub struct Program {
    /// Module, file (from the top of the project) and text of the whole source.
    pub sources: &'static [(&'static str, &'static str, &'static str)],
    /// How paths of crates, as the compiler writes them (`my_paper::`), begin in the documents; empty for the
    /// program's own.
    pub crates: &'static [(&'static str, &'static str)],
    /// Modules whose items may be quoted, each with its colons.
    pub quoted: &'static [&'static str],
    /// How an experiment of this name is run in a profile of that name.
    pub recipe: fn(&str, &str) -> Option<Recipe>,
    /// Path of the item that judges the statement with this id.
    pub judge: fn(&str) -> String,
    /// Whether there is such a file or folder in the project.
    pub exists: fn(&str) -> bool,
    /// What it writes.
    pub documents: &'static [Document],
    /// What the head of each page says: names of `<meta>` and their content.
    pub about: &'static [(&'static str, &'static str)],
}

/// A program that shows nothing of itself.
pub const PLAIN: Program = Program {
    sources: &[],
    crates: &[],
    quoted: &[],
    recipe: |_, _| None,
    judge: |_| String::new(),
    exists: |_| true,
    documents: &[Document::REPORT],
    about: &[],
};

impl std::fmt::Debug for Program {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Program of {} files", self.sources.len())
    }
}

/// A program for tests.
#[cfg(test)]
pub(crate) const TOY: Program = Program {
    sources: &[(
        "toy::flight",
        "src/flight.rs",
        "//! Free flight.\n\n/// A phase.\npub struct Motion {\n    a: f64,\n}\n\nimpl Motion {\n    \
         /// A jump of the velocity by ω `kick`.\n    pub fn kick<const M: usize>(&mut self, kick: f64, p: &Phases<M>) {\n        \
         self.a -= kick * p.sin;\n        self.b += kick * p.cos;\n    }\n}\n",
    )],
    crates: &[("toy_paper::", "")],
    quoted: &["toy::"],
    exists: |path| path == "src/lib.rs",
    ..PLAIN
};

/// An item of the source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Item {
    /// Its file, from the top of the project.
    pub file: &'static str,
    /// Its text with its documentation, moved to the left edge.
    pub text: String,
}

/// A file and a line in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file, from the top of the project.
    pub file: &'static str,
    /// The line where the item begins, from 1; a module begins at 1.
    pub line: usize,
}

/// How an experiment is run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Recipe {
    /// Its name, as "second_seed".
    pub name: String,
    /// The path of its module.
    pub item: String,
    /// Name and setting of each parameter, the seed among them.
    pub parameters: Vec<(String, String)>,
    /// A committed file that it reads, from the top of the project.
    pub data: Option<&'static str>,
}

impl Recipe {
    /// The recipe of an experiment with these parameters, field by field.
    pub fn of(name: &str, item: String, parameters: &Json) -> Recipe {
        let mut flat = Vec::new();
        flatten("", parameters, &mut flat);
        Recipe { name: name.into(), item, parameters: flat, data: None }
    }
}

impl Program {
    /// A path as the documents show it, from that of the compiler.
    pub fn short(&self, path: &str) -> String {
        let own =
            self.crates.iter().find_map(|(own, shown)| Some((path.strip_prefix(own)?, shown)));
        own.map_or(path.to_string(), |(rest, shown)| format!("{shown}{rest}"))
    }

    /// The item of a path: `jump::p_jump`, `flight::Motion::kick`.
    pub fn item(&self, path: &str) -> Result<Item, String> {
        let longest = self
            .inside(path)
            .filter(|_| self.quoted.iter().any(|layer| path.starts_with(layer)))
            .min_by_key(|(name, ..)| name.len());
        let Some((name, module, file, text)) = longest else {
            let names =
                self.quoted.iter().map(|layer| format!("{layer}…")).collect::<Vec<_>>().join(", ");
            return Err(format!(
                "there is no item `{path}`: no such module; begin with one of {names}"
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

    /// Modules around an item: its name inside, module, file and text.
    fn inside<'a>(
        &self,
        path: &'a str,
    ) -> impl Iterator<Item = (&'a str, &'static str, &'static str, &'static str)> {
        let name = move |module: &str| path.strip_prefix(module)?.strip_prefix("::");
        self.sources
            .iter()
            .filter_map(move |(module, file, text)| Some((name(module)?, *module, *file, *text)))
    }

    /// The place of an item or a module, in the files as `read` gives them, or else as they were when
    /// the program was built. None if there is no such item.
    pub fn place(&self, path: &str, read: impl Fn(&str) -> Option<String>) -> Option<Place> {
        if let Some((_, file, _)) = self.sources.iter().find(|(module, ..)| *module == path) {
            return Some(Place { file, line: 1 });
        }
        let (name, _, file, text) = self.inside(path).min_by_key(|(name, ..)| name.len())?;
        let text = read(file).unwrap_or_else(|| text.to_string());
        let own = items(&text).into_iter().find(|(own, ..)| own == name)?;
        Some(Place { file, line: own.1 + 1 })
    }

    /// The file of an item, as it was when the program was built.
    pub fn file(&self, path: &str) -> Option<&'static str> {
        self.place(path, |_| None).map(|place| place.file)
    }
}

/// Items of a file, functions and types and methods: name, index of the line that declares it, and
/// its lines with their documentation.
pub fn items(text: &str) -> Vec<(String, usize, Vec<&str>)> {
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
pub fn declared(code: &str) -> Option<String> {
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

/// Fields of fields get both names; long lists are told by their ends.
fn flatten(name: &str, value: &Json, into: &mut Vec<(String, String)>) {
    match value {
        Json::Null => {}
        Json::Object(fields) => {
            for (field, value) in fields {
                let field = field.replace('_', " ");
                let whole = if name.is_empty() { field } else { format!("{name} {field}") };
                flatten(&whole, value, into);
            }
        }
        Json::Array(list) => match merged(list) {
            Some(one) => flatten(name, &one, into),
            None => into.push((name.into(), listed(list))),
        },
        scalar => into.push((name.into(), shown(scalar))),
    }
}

/// Several objects as one: a field in which they differ is the list of its values.
fn merged(list: &[Json]) -> Option<Json> {
    let all: Vec<_> = list.iter().map(Json::as_object).collect::<Option<_>>()?;
    let of = |name: &String| {
        let values = all.iter().filter_map(|own| own.get(name)).filter(|own| !own.is_null());
        let values: Vec<Json> = values.cloned().collect();
        let value = match values.as_slice() {
            [] => Json::Null,
            [first, others @ ..] if others.iter().all(|own| own == first) => first.clone(),
            _ => merged(&values).unwrap_or(Json::Array(values)),
        };
        (name.clone(), value)
    };
    Some(Json::Object(all.first()?.keys().map(of).collect()))
}

fn listed(list: &[Json]) -> String {
    let plain = list.iter().all(|one| one.is_number() || one.is_string());
    match list {
        [first, .., last] if plain && list.len() > 8 => {
            format!("{} from {} to {}", list.len(), shown(first), shown(last))
        }
        _ if plain => list.iter().map(shown).collect::<Vec<_>>().join(", "),
        _ => format!("{} of them", list.len()),
    }
}

fn shown(value: &Json) -> String {
    match value {
        Json::String(text) => text.clone(),
        Json::Number(number) => number
            .as_f64()
            .filter(|_| number.is_f64())
            .map_or(number.to_string(), |x| x.to_string()),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_item_is_found_by_its_path() {
        let item = TOY.item("toy::flight::Motion::kick").unwrap();
        assert_eq!(item.file, "src/flight.rs");
        assert!(
            item.text.starts_with("/// A jump") && item.text.ends_with("p.cos;\n}"),
            "{}",
            item.text
        );
        let error = TOY.item("toy::flight::kik").unwrap_err();
        assert!(error.contains("`kik`") && error.contains("Motion, Motion::kick"), "{error}");
        assert!(TOY.item("toy::fly::kick").unwrap_err().contains("there is no item"));
        assert!(TOY.item("other::kick").unwrap_err().contains("begin with one of toy::"));
    }

    #[test]
    fn items_and_modules_have_a_place() {
        let place = |path, read: fn(&str) -> Option<String>| TOY.place(path, read);
        assert_eq!(place("toy::flight", |_| None).unwrap().line, 1);
        assert_eq!(place("toy::flight::Motion", |_| None).unwrap().line, 4);
        // In the working copy the lines have moved.
        let moved = |_: &str| Some("//! a\n//! b\n\n\n\n\npub struct Motion;\n".to_string());
        assert_eq!(place("toy::flight::Motion", moved).unwrap().line, 7);
        assert_eq!(place("toy::flight::Motor", |_| None), None);
    }

    #[test]
    fn parameters_of_parameters_have_both_names() {
        let parameters = serde_json::json!({"seed": 7, "chain": {"masses": 3}, "r": [0.5, 0.25]});
        let recipe = Recipe::of("run", "run".into(), &parameters);
        let told: Vec<String> = recipe.parameters.iter().map(|(k, v)| format!("{k}={v}")).collect();
        assert_eq!(told, ["chain masses=3", "r=0.5, 0.25", "seed=7"]);
    }
}
