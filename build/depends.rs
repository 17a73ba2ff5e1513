//! Which files of the source a module is made of: itself, and what it names, and what those name.
//!
//! A path `crate::a::B` leads to the file of `a`, or to that from which `a` takes its `B`. Between
//! the layers below the experiments no such distinction is made: who names one of their items
//! depends on all their files, for methods may be defined beside a type as well as with it. Within
//! experiments and parameters, a file with methods of a type that is used is used too.

use std::collections::{BTreeMap, BTreeSet};

/// A crate of this workspace.
pub struct Crate {
    /// Its name in code.
    pub name: &'static str,
    /// Where its source lies.
    pub folder: &'static str,
    /// The module that it is in the program.
    pub module: &'static str,
}

/// The crates below the program.
pub const CRATES: [Crate; 4] = [
    Crate { name: "literate", folder: "crates/literate/src", module: "literate" },
    Crate { name: "impact_numerics", folder: "crates/numerics/src", module: "impact_numerics" },
    Crate { name: "impact_chain", folder: "crates/impact-chain/src", module: "impact_chain" },
    Crate { name: "impact_circuits", folder: "crates/circuits/src", module: "impact_circuits" },
];

/// Layers that count as one.
const WHOLE: [&str; 3] =
    ["crates/numerics/src/", "crates/impact-chain/src/", "crates/circuits/src/"];

/// What changes no result: words for people, and what tables are made of.
const SILENT: [&str; 4] = [
    "crates/literate/src/experiments/progress.rs",
    "crates/literate/src/experiments/error.rs",
    "crates/literate/src/table.rs",
    "crates/literate/src/value.rs",
];

/// Whether a file changes no result. Tables are made of results anew each time.
fn silent(path: &str) -> bool {
    SILENT.contains(&path) || path.ends_with("tables.rs")
}

/// Files by path, with their text: the source.
pub type Source = BTreeMap<String, String>;

/// Paths of all files that the module in `root` is made of.
pub fn files(source: &Source, root: &str) -> BTreeSet<String> {
    let code: BTreeMap<&str, String> =
        source.iter().map(|(path, text)| (path.as_str(), code(text))).collect();
    let mut found = BTreeSet::new();
    let mut open = vec![root.to_string()];
    loop {
        while let Some(path) = open.pop() {
            if silent(&path) || !found.insert(path.clone()) {
                continue;
            }
            if let Some(layer) = WHOLE.iter().find(|layer| path.starts_with(**layer)) {
                open.extend(source.keys().filter(|path| path.starts_with(*layer)).cloned());
            }
            let module = module(&path);
            for named in paths(&code[path.as_str()], &module) {
                open.extend(resolve(source, &code, &named));
            }
            for child in children(&code[path.as_str()]) {
                if code[path.as_str()].contains(&format!("{child}::")) {
                    open.extend(resolve(source, &code, &[module.clone(), vec![child]].concat()));
                }
            }
        }
        let types: BTreeSet<&str> =
            found.iter().flat_map(|path| defined(&code[path.as_str()])).collect();
        for (path, text) in &code {
            let layer = path.starts_with("src/experiments/") || path.starts_with("src/params/");
            // A file with a type of its own by that name means its own.
            let foreign = |name: &str| types.contains(name) && defined(text).all(|own| own != name);
            if layer && !found.contains(*path) && methods(text).any(foreign) {
                open.push(path.to_string());
            }
        }
        open.retain(|path| !silent(path));
        if open.is_empty() {
            return found;
        }
    }
}

/// Text without lines of comment and without unit tests.
fn code(text: &str) -> String {
    text.lines()
        .take_while(|line| *line != "#[cfg(test)]")
        .filter(|line| !line.trim_start().starts_with("//"))
        .flat_map(|line| [line, "\n"])
        .collect()
}

/// The crate that a file belongs to; none if it is of the program itself.
pub fn of_crate(path: &str) -> Option<&'static Crate> {
    CRATES.iter().find(|own| path.starts_with(own.folder))
}

/// `src/a/b.rs` and `src/a/b/mod.rs` are [a, b]; a crate is one of the program's modules.
pub fn module(path: &str) -> Vec<String> {
    let own = of_crate(path);
    let path = path.trim_start_matches(own.map_or("src", |own| own.folder)).trim_end_matches(".rs");
    let mut parts: Vec<&str> = own.map(|own| own.module).into_iter().collect();
    parts.extend(path.split('/').skip(1));
    parts.pop_if(|last| ["mod", "lib"].contains(last));
    parts.into_iter().map(String::from).collect()
}

fn word(text: &str) -> &str {
    let end = text.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(text.len());
    &text[..end]
}

/// All paths from the top that code names by `crate::`, by `super::` and by the name of a crate; a last "*" is a
/// whole module.
fn paths(code: &str, module: &[String]) -> Vec<Vec<String>> {
    let mut out = Vec::new();
    let mut top = |name: &str, prefix: Vec<String>| {
        for (i, _) in code.match_indices(&format!("{name}::")) {
            tree(&code[i + name.len() + 2..], prefix.clone(), &mut out);
        }
    };
    let own = module.first().filter(|first| CRATES.iter().any(|own| own.module == *first));
    top("crate", own.into_iter().cloned().collect());
    for other in &CRATES {
        top(other.name, vec![other.module.into()]);
    }
    for (i, _) in code.match_indices("super::") {
        if code[..i].ends_with("super::") {
            continue;
        }
        let (mut rest, mut base) = (&code[i..], module.to_vec());
        while let Some(after) = rest.strip_prefix("super::") {
            (rest, _) = (after, base.pop());
        }
        tree(rest, base, &mut out);
    }
    out
}

/// Reads `a::{b, c::d as e}` behind a prefix, and returns what follows it.
fn tree<'a>(text: &'a str, prefix: Vec<String>, out: &mut Vec<Vec<String>>) -> &'a str {
    let text = text.trim_start();
    if let Some(mut rest) = text.strip_prefix('{') {
        loop {
            rest = rest.trim_start();
            if let Some(after) = rest.strip_prefix('}') {
                return after;
            }
            let Some(after) = rest.strip_prefix(',') else {
                let before = rest.len();
                rest = tree(rest, prefix.clone(), out);
                if rest.len() == before {
                    return rest;
                }
                continue;
            };
            rest = after;
        }
    }
    if let Some(rest) = text.strip_prefix('*') {
        out.push([prefix, vec!["*".into()]].concat());
        return rest;
    }
    let name = word(text);
    let rest = &text[name.len()..];
    if name.is_empty() {
        return rest;
    }
    let path = if name == "self" {
        [prefix, vec!["*".into()]].concat()
    } else {
        [prefix, vec![name.to_string()]].concat()
    };
    if let Some(rest) = rest.strip_prefix("::")
        && (rest.starts_with('{') || rest.starts_with('*') || !word(rest).is_empty())
    {
        return tree(rest, path, out);
    }
    out.push(path);
    // `as name`, where there is one, is a word of no path.
    match rest.trim_start().strip_prefix("as ") {
        Some(alias) => &alias[word(alias).len()..],
        None => rest,
    }
}

/// Child modules that a file declares.
fn children(code: &str) -> Vec<String> {
    let declared = |line: &str| {
        let line = line.trim_start_matches("pub ").trim_start_matches("pub(crate) ");
        let name = line.strip_prefix("mod ")?.strip_suffix(';')?;
        Some(name.to_string())
    };
    code.lines().filter_map(declared).collect()
}

/// The files that a path leads to.
fn resolve(source: &Source, code: &BTreeMap<&str, String>, path: &[String]) -> Vec<String> {
    let own = CRATES.iter().find(|own| path.first().is_some_and(|first| first == own.module));
    let mut at = own.map_or("src", |own| own.folder).to_string();
    let mut file = own.map(|own| format!("{}/lib.rs", own.folder));
    let path = &path[usize::from(own.is_some())..];
    for (i, name) in path.iter().enumerate() {
        let [flat, folder] = [format!("{at}/{name}.rs"), format!("{at}/{name}/mod.rs")];
        let next = [flat, folder].into_iter().find(|path| source.contains_key(path));
        let Some(next) = next else {
            return match file {
                Some(file) if name == "*" => whole(source, &file, &at),
                Some(file) => home(source, code, &file, &at, &path[i..]),
                None => taken(code, "src/lib.rs", &path[i..])
                    .map_or_else(Vec::new, |path| resolve(source, code, &path)),
            };
        };
        at = format!("{at}/{name}");
        file = Some(next);
    }
    file.map(|file| whole(source, &file, &at)).unwrap_or_default()
}

/// A module and all below it.
fn whole(source: &Source, file: &str, at: &str) -> Vec<String> {
    let below = format!("{at}/");
    let inside = source.keys().filter(|path| path.starts_with(&below)).cloned();
    std::iter::once(file.to_string()).chain(inside).collect()
}

/// The path from the top of an item that a file takes from another crate.
fn taken(code: &BTreeMap<&str, String>, file: &str, item: &[String]) -> Option<Vec<String>> {
    let text = code[file].as_str();
    CRATES.iter().find_map(|own| {
        let taken = format!("pub use {}::", own.name);
        text.match_indices(&taken).find_map(|(i, _)| {
            let mut named = Vec::new();
            tree(&text[i + taken.len()..], Vec::new(), &mut named);
            let path = named.into_iter().find(|path| path.last() == item.first())?;
            Some([&[own.module.to_string()], path.as_slice(), &item[1..]].concat())
        })
    })
}

/// Where a module has an item from: a child or a crate that it takes it from, or itself.
fn home(
    source: &Source,
    code: &BTreeMap<&str, String>,
    file: &str,
    at: &str,
    item: &[String],
) -> Vec<String> {
    if let Some(path) = taken(code, file, item) {
        return resolve(source, code, &path);
    }
    let text = code[file].as_str();
    let child = |child: String| {
        let files = [format!("{at}/{child}.rs"), format!("{at}/{child}/mod.rs")];
        Some((child, files.into_iter().find(|path| source.contains_key(path))?))
    };
    for (child, child_file) in children(text).into_iter().filter_map(child) {
        let taken = format!("pub use {child}::");
        for (i, _) in text.match_indices(&taken) {
            let mut named = Vec::new();
            tree(&text[i + taken.len()..], Vec::new(), &mut named);
            let name = |path: &Vec<String>| path.last() == item.first();
            let all = named.iter().any(|path| path.last().is_some_and(|last| last == "*"));
            if named.iter().any(name) || all && defines(&code[child_file.as_str()], &item[0]) {
                return vec![child_file];
            }
        }
    }
    vec![file.to_string()]
}

const KINDS: [&str; 8] =
    ["struct ", "enum ", "const ", "fn ", "type ", "static ", "trait ", "macro_rules! "];

fn defines(code: &str, name: &str) -> bool {
    KINDS
        .iter()
        .any(|kind| code.match_indices(kind).any(|(i, _)| word(&code[i + kind.len()..]) == name))
}

/// Types that code defines.
fn defined(code: &str) -> impl Iterator<Item = &str> {
    ["struct ", "enum "].into_iter().flat_map(move |kind| {
        code.match_indices(kind).map(move |(i, _)| word(&code[i + kind.len()..]))
    })
}

/// Names in the first lines of `impl` blocks: types that get methods or traits there, and more.
fn methods(code: &str) -> impl Iterator<Item = &str> {
    code.lines()
        .filter(|line| line.starts_with("impl"))
        .flat_map(|line| line.split(|c: char| !(c.is_alphanumeric() || c == '_')))
}
