//! Finds the modules that a file of Rust names, so that no input of a saved result is forgotten.
//!
//! Paths are read, not the language: a module may be found that is not used, but none is missed
//! that a path from `crate`, `super`, `self` or a crate's name leads to, or that `mod` declares.

use crate::source::Sources;
use std::collections::BTreeSet;

impl Sources {
    /// Returns the other files of the source whose modules a file names outside its tests.
    pub fn named_in(&self, path: &str, text: &str) -> BTreeSet<&'static str> {
        let inside = |(_, folder): &&(&str, &str)| path.starts_with(&format!("{folder}/"));
        let Some((name, folder)) = self.crates.iter().find(inside) else { return BTreeSet::new() };
        let module = path[folder.len() + 1..].trim_end_matches(".rs");
        let mut module: Vec<&str> = module.split('/').collect();
        if let ["mod" | "lib" | "main"] = module[module.len() - 1..] {
            module.pop();
        }
        let program = self.name.replace('-', "_");
        let has_library = self.file("").is_some_and(|file| file.ends_with("/lib.rs"));
        let mut found = BTreeSet::new();
        for named in paths(&code(text)) {
            let (head, mut rest) = (named[0], &named[1..]);
            let (name, mut parts) = match head {
                "crate" => (*name, Vec::new()),
                "self" => (*name, module.clone()),
                "super" => (*name, module[..module.len().saturating_sub(1)].to_vec()),
                _ if head == program && has_library => ("", Vec::new()),
                _ if self.crates.iter().any(|(other, _)| *other == head) => (head, Vec::new()),
                _ => continue,
            };
            while let ["super", more @ ..] = rest {
                parts.pop();
                rest = more;
            }
            let item = format!("{name}::{}", [parts.as_slice(), rest].concat().join("::"));
            found.extend(self.file(&item).filter(|file| *file != path));
        }
        found
    }
}

/// A file without comments and without its module of tests; `mod name;` is the path `self::name`.
fn code(text: &str) -> String {
    let mut code = String::new();
    // Clippy refuses code after such a module.
    let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    for line in text.lines().filter(|line| !line.trim_start().starts_with("//")) {
        let line = line.split(" //").next().unwrap_or_default();
        match line.rsplit_once("mod ") {
            Some((_, name)) if name.ends_with(';') => code += &format!("self::{name}\n"),
            _ => code += &format!("{line}\n"),
        }
    }
    code
}

/// All paths of more than one name, with those in the braces of imports written out.
fn paths(code: &str) -> Vec<Vec<&str>> {
    let mut found = Vec::new();
    for (at, _) in code.match_indices("::") {
        let head = code[..at].rsplit(|c| !is_word(c)).next().unwrap_or_default();
        let before = code[..at - head.len()].trim_end_matches("::");
        let is_inside = before.len() + head.len() < at && before.ends_with(is_word);
        if !head.is_empty() && !is_inside {
            read_path(&code[at + 2..], vec![head], &mut found);
        }
    }
    found
}

/// Reads the paths that begin with some names and `::`, and returns the text after them.
fn read_path<'a>(text: &'a str, mut names: Vec<&'a str>, found: &mut Vec<Vec<&'a str>>) -> &'a str {
    let mut text = text.trim_start();
    if let Some(group) = text.strip_prefix('{') {
        text = group.trim_start();
        while !text.is_empty() && !text.starts_with('}') {
            text = read_path(text, names.clone(), found);
            text = text.trim_start_matches(|c| c != ',' && c != '}');
            text = text.trim_start_matches(',').trim_start();
        }
        return text.get(1..).unwrap_or_default();
    }
    let (word, rest) = text.split_at(text.find(|c| !is_word(c)).unwrap_or(text.len()));
    if !word.is_empty() && word != "self" {
        names.push(word);
    }
    match rest.trim_start().strip_prefix("::") {
        Some(rest) if !word.is_empty() => read_path(rest, names, found),
        _ => {
            found.push(names);
            rest
        }
    }
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

#[cfg(test)]
mod tests {
    use crate::source::{Sources, toy};

    #[test]
    fn modules_are_found_wherever_a_path_names_them() {
        let [lib, physics, engine] = ["src/lib.rs", "src/physics.rs", "engine/lib.rs"];
        let [runs, walk, jump] = ["src/runs/mod.rs", "src/runs/walk.rs", "src/runs/jump.rs"];
        let files = [lib, physics, runs, walk, jump, engine].map(|path| (path, ""));
        let crates = &[("engine", "engine"), ("", "src")];
        let sources = Sources { name: "toy-paper", files: files.to_vec().leak(), crates, ..toy() };
        for (text, names) in [
            ("use crate::physics::gravity;", "physics.rs"),
            ("let g = crate::physics::gravity();", "physics.rs"),
            ("use crate::{physics as p, runs::{jump::{self, far}}};", "physics.rs runs/jump.rs"),
            ("use crate::{\n    physics,\n};", "physics.rs"),
            ("use super::jump;", "runs/jump.rs"),
            ("use super::super::physics::*;", "physics.rs"),
            ("use super::Walk;", "runs/mod.rs"),
            ("use toy_paper::physics::g;", "physics.rs"),
            ("use crate::START;", "lib.rs"),
            ("use engine::Engine;", "engine/lib.rs"),
            ("::engine::run(x)", "engine/lib.rs"),
            ("a::b::engine::run(x)", ""),
            ("// crate::physics\nlet x = 1; // super::jump\nstd::crate::physics();", ""),
            ("super::jump;\n#[cfg(test)]\nmod tests {\n use crate::physics;\n}", "runs/jump.rs"),
            ("use crate::runs::walk::itself;", ""),
        ] {
            let found = sources.named_in("src/runs/walk.rs", text);
            let found: Vec<_> = found.iter().map(|path| path.trim_start_matches("src/")).collect();
            assert_eq!(found.join(" "), names, "{text}");
        }
        let found = sources.named_in("src/runs/mod.rs", "pub(crate) mod walk;\nmod other { }");
        assert_eq!(found.into_iter().collect::<Vec<_>>(), ["src/runs/walk.rs"]);
    }
}
