//! The program that makes the documents, as far as they speak of it: its source, its experiments.

use crate::report::Document;
use serde::Serialize;
use serde_json::Value as Json;

/// What the documents must know of the program that makes them.
#[derive(Clone, Copy)]
pub struct Program {
    /// Its source: path of each file from the top of the project, and a hash.
    pub files: &'static [(&'static str, &'static str)],
    /// Crates as paths of items name them, and the folders of their source; an empty name for the program.
    pub crates: &'static [(&'static str, &'static str)],
    /// How the compiler begins the paths of this program's items; documents leave it out.
    pub name: &'static str,
    /// What the documents quote.
    pub listings: &'static [Listing],
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
    files: &[],
    crates: &[],
    name: "",
    listings: &[],
    recipe: |_, _| None,
    judge: |_| String::new(),
    exists: |_| true,
    documents: &[Document::REPORT],
    about: &[],
};

impl std::fmt::Debug for Program {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Program of {} files", self.files.len())
    }
}

/// A program for tests.
#[cfg(test)]
pub(crate) const TOY: Program = Program {
    files: &[("src/flight.rs", ""), ("src/flight/drag/mod.rs", ""), ("src/lib.rs", "")],
    crates: &[("toy", "src")],
    name: "toy_paper::",
    listings: &[Listing {
        item: "toy::flight::Motion::kick",
        file: "src/flight.rs",
        text: "//! Free flight.\n\nimpl Motion {\n    // listing: kick\n    /// A jump of the velocity by ω `kick`.\n    \
               pub fn kick<const M: usize>(&mut self, kick: f64, p: &Phases<M>) {\n        self.a -= kick * p.sin;\n        \
               self.b += kick * p.cos;\n    }\n    // end\n}\n",
    }],
    exists: |path| path == "src/lib.rs",
    ..PLAIN
};

/// An item of the source that documents quote: in its file it stands between the lines `// listing: NAME`, with the last
/// name of its path, and `// end`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Listing {
    /// Its path, as `impact_circuits::jump::p_jump`.
    pub item: &'static str,
    /// Its file, from the top of the project.
    pub file: &'static str,
    /// The text of that file, by `include_str!`: it travels with the program, and is what computed the numbers.
    pub text: &'static str,
}

impl Listing {
    /// Its lines, moved to the left edge; empty if it is not marked.
    pub fn lines(&self) -> String {
        let name = self.item.rsplit("::").next().unwrap_or_default();
        let mark = format!("// listing: {name}");
        let inside = self.text.lines().skip_while(|line| line.trim() != mark).skip(1);
        let lines: Vec<&str> = inside.take_while(|line| line.trim() != "// end").collect();
        let indent = lines.first().map_or(0, |line| line.len() - line.trim_start().len());
        let lines = lines.iter().map(|line| line.get(indent..).unwrap_or_default());
        lines.collect::<Vec<_>>().join("\n")
    }
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
    pub fn short<'a>(&self, path: &'a str) -> &'a str {
        path.strip_prefix(self.name).unwrap_or(path)
    }

    /// The listing of an item.
    pub fn listing(&self, item: &str) -> Result<&'static Listing, String> {
        let found = self.listings.iter().find(|listing| listing.item == item);
        found.filter(|listing| !listing.lines().is_empty()).ok_or_else(|| {
            let known: Vec<&str> = self.listings.iter().map(|listing| listing.item).collect();
            let marks = "the lines `// listing: NAME` and `// end` in its file";
            let known = known.join(", ");
            format!("there is no listing `{item}`; it needs {marks}, and a place among {known}")
        })
    }

    /// The file of an item or a module, by its path: `impact_circuits::jump::p_jump` is in
    /// `crates/circuits/src/jump.rs`. None if the program has no such file.
    pub fn file(&self, item: &str) -> Option<&'static str> {
        let inside =
            |(name, folder): &(&str, &'static str)| Some((*folder, item.strip_prefix(name)?));
        let (folder, rest) = self.crates.iter().find_map(inside)?;
        let mut parts: Vec<&str> = rest.split("::").filter(|part| !part.is_empty()).collect();
        loop {
            let module = format!("{folder}/{}", parts.join("/"));
            let is = |path: &str| match path.strip_prefix(&module) {
                Some(".rs" | "/mod.rs") => true,
                Some("lib.rs") => parts.is_empty(),
                _ => false,
            };
            if let Some((path, _)) = self.files.iter().find(|(path, _)| is(path)) {
                return Some(path);
            }
            parts.pop()?;
        }
    }
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
    fn a_listing_is_what_stands_between_its_marks() {
        let kick = TOY.listing("toy::flight::Motion::kick").unwrap().lines();
        assert!(kick.starts_with("/// A jump") && kick.ends_with("p.cos;\n}"), "{kick}");
        let error = TOY.listing("toy::flight::kik").unwrap_err();
        assert!(error.contains("`toy::flight::kik`") && error.contains("Motion::kick"), "{error}");
    }

    #[test]
    fn an_item_has_the_file_of_its_module() {
        for (item, file) in [
            ("toy::flight::Motion::kick", Some("src/flight.rs")),
            ("toy::flight::drag::of", Some("src/flight/drag/mod.rs")),
            ("toy::Chain", Some("src/lib.rs")),
            ("other::kick", None),
        ] {
            assert_eq!(TOY.file(item), file, "{item}");
        }
    }

    #[test]
    fn parameters_of_parameters_have_both_names() {
        let parameters = serde_json::json!({"seed": 7, "chain": {"masses": 3}, "r": [0.5, 0.25]});
        let recipe = Recipe::of("run", "run".into(), &parameters);
        let told: Vec<String> = recipe.parameters.iter().map(|(k, v)| format!("{k}={v}")).collect();
        assert_eq!(told, ["chain masses=3", "r=0.5, 0.25", "seed=7"]);
    }
}
