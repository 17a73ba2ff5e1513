//! Reads all imports, and refuses those that DESIGN.md does not allow, and circles.

use super::QUICK;
use super::structure::{files, root};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;

/// Crates by the names of their libraries, and the folders of their source.
const CRATES: [(&str, &str); 8] = [
    ("impact_numerics", "crates/numerics/src"),
    ("impact_chain", "crates/impact-chain/src"),
    ("impact_circuits", "crates/circuits/src"),
    ("impact_page", "crates/page/src"),
    ("literate_sources", "crates/sources/src"),
    ("literate", "crates/literate/src"),
    ("impact_paper", "src"),
    // The program and its library are two crates in one folder.
    ("main", "src/main"),
];

fn is_name(word: &str) -> bool {
    word.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// Splits Rust into words, signs and `::`, without comments, texts and characters.
fn tokens(text: &str) -> Vec<String> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let (mut tokens, mut rest) = (Vec::new(), text);
    while let Some(c) = rest.chars().next() {
        let behind = |begin: usize, end: &str| {
            rest[begin..].find(end).map_or(rest.len(), |offset| begin + offset + end.len())
        };
        let after: Vec<char> = rest.chars().skip(1).take(2).collect();
        let (length, is_token) = match (c, &after[..]) {
            ('/', ['/', ..]) => (behind(2, "\n"), false),
            ('r', ['"', ..]) => (behind(2, "\""), false),
            ('r', ['#', '"']) => (behind(3, "\"#"), false),
            ('"', _) => {
                let mut signs = rest.char_indices().skip(1);
                let end = loop {
                    match signs.next() {
                        Some((_, '\\')) => drop(signs.next()),
                        Some((offset, '"')) => break offset + 1,
                        Some(_) => (),
                        None => break rest.len(),
                    }
                };
                (end, false)
            }
            ('\'', ['\\', _]) => (behind(3, "'"), false),
            ('\'', [one, '\'']) => (2 + one.len_utf8(), false),
            (':', [':', ..]) => (2, true),
            (c, _) if is_word(c) => (rest.find(|c| !is_word(c)).unwrap_or(rest.len()), true),
            (c, _) => (c.len_utf8(), !c.is_whitespace()),
        };
        tokens.extend(is_token.then(|| rest[..length].to_string()));
        rest = &rest[length..];
    }
    tokens
}

/// The place behind the item that begins here: behind its `;`, or behind its braces.
fn behind_item(tokens: &[String], begin: usize) -> usize {
    let ends_in_brace = tokens[begin..].iter().take(4).all(|token| token != "use");
    let mut depth = 0;
    for (i, token) in tokens.iter().enumerate().skip(begin) {
        match token.as_str() {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" => depth -= 1,
            "}" => {
                depth -= 1;
                if depth == 0 && ends_in_brace {
                    return i + 1;
                }
            }
            ";" if depth == 0 => return i + 1,
            _ => (),
        }
    }
    tokens.len()
}

type Path = Vec<String>;

/// What a module has: names of items and of imports with what they name, and all paths.
#[derive(Default)]
struct Module {
    file: String,
    items: BTreeSet<String>,
    imports: BTreeMap<String, Path>,
    globs: Vec<Path>,
    paths: Vec<Path>,
}

/// All modules, by their paths, of which the first part is the name of the crate.
#[derive(Default)]
struct Modules {
    all: BTreeMap<Path, Module>,
    /// What names mean that were looked up before, or are being looked up.
    known: RefCell<BTreeMap<Path, Option<Found>>>,
}

impl Modules {
    fn read(&mut self, path: Path, file: &str, tokens: &[String]) {
        let mut module = Module { file: file.into(), ..Module::default() };
        let (mut i, mut depth) = (0, 0);
        while i < tokens.len() {
            let next = |n: usize| tokens.get(i + n).map_or("", String::as_str);
            match next(0) {
                "{" => depth += 1,
                "}" => depth -= 1,
                "use" if next(1) != "<" => i = import(tokens, i + 1, &mut Vec::new(), &mut module),
                "mod" if depth == 0 && next(2) == "{" => {
                    let end = behind_item(tokens, i);
                    let child = [path.clone(), vec![next(1).into()]].concat();
                    self.read(child, file, &tokens[i + 3..end - 1]);
                    i = end - 1;
                }
                "fn" | "struct" | "enum" | "const" | "static" | "type" | "trait" | "union"
                    if depth == 0 =>
                {
                    module.items.insert(next(1).into());
                }
                "macro_rules" => {
                    // A macro that is exported has its place at the top of the crate.
                    let inside = [&["crate".to_string()], &path[1..], &[next(2).into()]].concat();
                    let top = self.all.entry(path[..1].to_vec()).or_default();
                    top.imports.insert(next(2).into(), inside);
                    module.items.insert(next(2).into());
                }
                word if is_name(word) => {
                    let follows = i > 0 && ["::", "."].contains(&tokens[i - 1].as_str());
                    let mut whole = vec![word.to_string()];
                    while tokens.get(i + 1).is_some_and(|token| token == "::")
                        && tokens.get(i + 2).is_some_and(|token| is_name(token))
                    {
                        whole.push(tokens[i + 2].clone());
                        i += 2;
                    }
                    let calls = tokens.get(i + 1).is_some_and(|token| token == "(");
                    let is_variable = whole.len() == 1 && word.starts_with(char::is_lowercase);
                    if !follows && (calls || !is_variable) {
                        module.paths.push(whole);
                    }
                }
                _ => (),
            }
            i += 1;
        }
        let known = self.all.entry(path).or_default();
        module.imports.append(&mut known.imports);
        *known = module;
    }

    fn resolve(&self, from: &[String], path: &[String]) -> Option<Found> {
        let Some((first, rest)) = path.split_first() else {
            return Some(Found::Module(from.to_vec()));
        };
        match first.as_str() {
            "crate" => self.resolve(&from[..1], rest),
            "self" => self.resolve(from, rest),
            "super" => self.resolve(&from[..from.len() - 1], rest),
            name => match self.named(from, name)? {
                Found::Module(inside) => self.resolve(&inside, rest),
                item => Some(item),
            },
        }
    }

    fn named(&self, from: &[String], name: &str) -> Option<Found> {
        let child = [from, &[name.to_string()]].concat();
        if let Some(meaning) = self.known.borrow().get(&child) {
            return meaning.clone();
        }
        self.known.borrow_mut().insert(child.clone(), None);
        let meaning = self.look_up(from, name, &child);
        self.known.borrow_mut().insert(child, meaning.clone());
        meaning
    }

    fn look_up(&self, from: &[String], name: &str, child: &[String]) -> Option<Found> {
        let module = self.all.get(from)?;
        if self.all.contains_key(child) {
            return Some(Found::Module(child.to_vec()));
        }
        if module.items.contains(name) {
            return Some(Found::Item(module.file.clone()));
        }
        let imported = module.imports.get(name).filter(|path| path[..] != [name.to_string()]);
        if let Some(path) = imported {
            return self.resolve(from, path);
        }
        for glob in &module.globs {
            if let Some(Found::Module(inside)) = self.resolve(from, glob)
                && let Some(found) = self.resolve(&inside, &[name.to_string()])
            {
                return Some(found);
            }
        }
        let is_crate = CRATES.iter().any(|(known, _)| *known == name);
        is_crate.then(|| Found::Module(vec![name.to_string()]))
    }
}

/// What a path names: an item of a file, or a module.
#[derive(Clone)]
enum Found {
    Item(String),
    Module(Path),
}

/// Reads what an import names, from behind `use`, and returns the place of its end.
fn import(tokens: &[String], begin: usize, before: &mut Path, module: &mut Module) -> usize {
    let (mut i, depth) = (begin, before.len());
    loop {
        match tokens[i].as_str() {
            "{" => {
                i += 1;
                while tokens[i] != "}" {
                    i = import(tokens, i, &mut before.clone(), module);
                    i += usize::from(tokens[i] == ",");
                }
                i += 1;
                before.truncate(depth);
                return i;
            }
            "*" => {
                module.globs.push(before.clone());
                return i + 1;
            }
            "::" => i += 1,
            ";" | "," | "}" => break,
            "as" => {
                module.imports.insert(tokens[i + 1].clone(), before.clone());
                module.paths.push(before.clone());
                return i + 2;
            }
            word => {
                before.push(word.to_string());
                i += 1;
            }
        }
    }
    if before.last().is_some_and(|last| last == "self") {
        before.pop();
    }
    if let Some(last) = before.last() {
        module.imports.insert(last.clone(), before.clone());
        module.paths.push(before.clone());
    }
    i
}

/// Which files each file imports, by the item that a name resolves to.
fn arrows() -> BTreeMap<String, BTreeSet<String>> {
    let mut modules = Modules::default();
    for (name, folder) in CRATES.iter().filter(|(name, _)| *name != "main") {
        for (file, text) in files(folder, &[".rs"]) {
            let inside = file[folder.len() + 1..].trim_end_matches(".rs");
            let is_program = *folder == "src" && (inside == "main" || inside.starts_with("cli"));
            let mut path = vec![if is_program { "main" } else { name }.to_string()];
            path.extend(inside.split('/').map(String::from));
            if ["lib", "main", "mod"].contains(&path.last().unwrap().as_str()) {
                path.pop();
            }
            if !path.contains(&"tests".to_string()) {
                // Clippy refuses code behind such a module.
                let code = text.split("#[cfg(test)]\nmod tests").next().unwrap();
                modules.read(path, &file, &tokens(code));
            }
        }
    }
    let mut arrows: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (path, module) in &modules.all {
        let globs = module.globs.iter().map(|glob| (glob, true));
        for (used, is_glob) in module.paths.iter().map(|path| (path, false)).chain(globs) {
            let imported = match modules.resolve(path, used) {
                Some(Found::Item(file)) => file,
                Some(Found::Module(imported)) if is_glob => modules.all[&imported].file.clone(),
                _ => continue,
            };
            if imported != module.file {
                arrows.entry(module.file.clone()).or_default().insert(imported);
            }
        }
    }
    arrows
}

/// Files that import nothing, or only such that were taken away, are taken away until none is left.
#[test]
fn no_file_imports_itself_through_others() {
    let mut left = arrows();
    assert!(left.len() > 150, "{} files import others", left.len());
    loop {
        let before = left.len();
        let open: BTreeSet<String> = left.keys().cloned().collect();
        left.retain(|_, imported| !imported.is_disjoint(&open));
        if left.len() == before {
            break;
        }
    }
    assert!(left.is_empty(), "these files are in circles, or import those: {:#?}", left.keys());
}

/// The layers of DESIGN.md: how the paths of their files begin, and what they may import.
fn layers() -> Vec<(String, Vec<String>)> {
    let design = fs::read_to_string(root().join("DESIGN.md")).unwrap();
    let mut layers = Vec::new();
    for line in design.lines().filter(|line| line.starts_with("    ")) {
        let Some((names, used)) = line.split_once('←') else { continue };
        let used: Vec<String> = used.split_whitespace().map(String::from).collect();
        layers.extend(names.split_whitespace().map(|name| (name.to_string(), used.clone())));
    }
    layers
}

#[test]
fn imports_are_those_of_the_drawing() {
    let layers = layers();
    assert!(layers.len() > 15, "DESIGN.md has the layers, a line each, as `LAYER ← LAYERS`");
    let layer_of = |file: &str| {
        let inside = file.replace("/src/", "/").trim_start_matches("crates/").to_string();
        let is_in = |name: &str| {
            let rest = inside.strip_prefix(name);
            rest.is_some_and(|rest| rest.starts_with('/') || rest.starts_with(".rs"))
        };
        let matching = layers.iter().filter(|(name, _)| is_in(name));
        matching.max_by_key(|(name, _)| name.len())
    };
    let mut wrong = Vec::new();
    for (from, to) in arrows() {
        let Some((layer, used)) = layer_of(&from) else {
            wrong.push(format!("{from} is in no layer"));
            continue;
        };
        for file in to {
            let other = layer_of(&file).map_or("none", |(name, _)| name);
            if other != layer && !used.iter().any(|name| name == other) {
                wrong.push(format!("{from} ({layer}) imports {file} ({other})"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What is apart, and the code of one experiment, changes no other result: nothing that counts for
/// a saved result imports it.
#[test]
fn nothing_that_counts_for_a_result_imports_what_does_not() {
    let (project, experiments) = (&QUICK.paper.project, &QUICK.paper.experiments);
    let owned: Vec<&str> = experiments.iter().flat_map(|one| one.own()).copied().collect();
    let mut wrong = BTreeSet::new();
    let arrows = arrows();
    for experiment in experiments.iter().filter(|experiment| experiment.is_saved()) {
        let counts = |path: &str| project.counts(path, experiment.own(), &owned);
        for (from, to) in arrows.iter().filter(|(from, _)| counts(from)) {
            // Tables are named where their experiment is defined.
            let is_definition = from.ends_with("/mod.rs");
            let is_known = |file: &str| {
                file.starts_with("crates/literate/")
                    || file.ends_with("/prelude.rs")
                    || is_definition && file.ends_with("/tables.rs")
            };
            let others = to.iter().filter(|file| !counts(file) && !is_known(file));
            wrong.extend(others.map(|file| format!("{from} imports {file}")));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
