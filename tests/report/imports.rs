//! Reads all imports, and refuses those that DESIGN.md does not allow, and circles.

use super::QUICK;
use proc_macro2::{TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

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

/// The name or sign at a place; empty for groups, literals, and behind the end.
fn word(trees: &[TokenTree], place: usize) -> String {
    match trees.get(place) {
        Some(tree @ (TokenTree::Ident(_) | TokenTree::Punct(_))) => tree.to_string(),
        _ => String::new(),
    }
}

/// A path of modules.
type Place = Vec<String>;

/// What a module has: names of items and of imports with what they name, and all paths.
#[derive(Default)]
struct Module {
    file: String,
    items: BTreeSet<String>,
    imports: BTreeMap<String, Place>,
    globs: Vec<Place>,
    paths: Vec<Place>,
}

/// All modules, by their paths, of which the first part is the name of the crate.
#[derive(Default)]
struct Modules {
    all: BTreeMap<Place, Module>,
}

impl Modules {
    fn read(&mut self, path: &[String], file: &str, tokens: TokenStream) {
        let mut module = Module { file: file.into(), ..Module::default() };
        self.collect(path, tokens, true, &mut module);
        let known = self.all.entry(path.to_vec()).or_default();
        module.imports.append(&mut known.imports);
        *known = module;
    }

    /// Reads the tokens of a module, or, not at its top, those between brackets.
    fn collect(&mut self, path: &[String], tokens: TokenStream, top: bool, module: &mut Module) {
        let trees: Vec<TokenTree> = tokens.into_iter().collect();
        let (mut i, sign) = (0, |place: usize| word(&trees, place));
        while let Some(tree) = trees.get(i) {
            match (sign(i).as_str(), tree, trees.get(i + 2)) {
                ("use", ..) if sign(i + 1) != "<" => i = import(&trees, i + 1, &[], module),
                ("mod", _, Some(TokenTree::Group(items))) if top => {
                    let child = [path, &[sign(i + 1)]].concat();
                    self.read(&child, &module.file, items.stream());
                    i += 2;
                }
                (
                    "fn" | "struct" | "enum" | "const" | "static" | "type" | "trait" | "union",
                    ..,
                ) if top => {
                    module.items.insert(sign(i + 1));
                }
                ("macro_rules", ..) => {
                    // A macro that is exported has its place at the top of the crate.
                    let name = sign(i + 2);
                    let mut inside = [&["crate".to_string()], &path[1..]].concat();
                    inside.push(name.clone());
                    let whole_crate = self.all.entry(path[..1].to_vec()).or_default();
                    whole_crate.imports.insert(name.clone(), inside);
                    module.items.insert(name);
                }
                (_, TokenTree::Group(group), _) => {
                    self.collect(path, group.stream(), false, module);
                }
                (name, TokenTree::Ident(_), _) => {
                    let mut whole = vec![name.to_string()];
                    while sign(i + 1) + &sign(i + 2) == "::"
                        && matches!(trees.get(i + 3), Some(TokenTree::Ident(_)))
                    {
                        whole.push(sign(i + 3));
                        i += 3;
                    }
                    module.paths.push(whole);
                }
                _ => (),
            }
            i += 1;
        }
    }

    /// Finds what a path names; circles of imports end after some steps.
    fn resolve(&self, from: &[String], path: &[String], steps: usize) -> Option<Found> {
        let Some((name, rest)) = path.split_first() else {
            return Some(Found::Module(from.to_vec()));
        };
        let inside = match name.as_str() {
            "crate" => from[..1].to_vec(),
            "self" => from.to_vec(),
            "super" => from[..from.len() - 1].to_vec(),
            _ => match self.named(from, name, steps.checked_sub(1)?)? {
                Found::Module(inside) => inside,
                item => return Some(item),
            },
        };
        self.resolve(&inside, rest, steps)
    }

    fn named(&self, from: &[String], name: &String, steps: usize) -> Option<Found> {
        let module = self.all.get(from)?;
        let child = [from, std::slice::from_ref(name)].concat();
        if self.all.contains_key(&child) {
            return Some(Found::Module(child));
        }
        if module.items.contains(name) {
            return Some(Found::Item(module.file.clone()));
        }
        if let Some(path) = module.imports.get(name).filter(|path| path[..] != [name.clone()]) {
            return self.resolve(from, path, steps);
        }
        let by_glob = |glob: &Place| match self.resolve(from, glob, steps.checked_sub(1)?)? {
            Found::Module(inside) => self.named(&inside, name, steps - 1),
            Found::Item(_) => None,
        };
        let is_crate = CRATES.iter().any(|(known, _)| known == name);
        let by_crate = || is_crate.then(|| Found::Module(vec![name.clone()]));
        module.globs.iter().find_map(by_glob).or_else(by_crate)
    }
}

/// What a path names: an item of a file, or a module.
#[derive(Clone)]
enum Found {
    Item(String),
    Module(Place),
}

/// Reads what an import names, of which a part was read before, and returns the place behind it.
fn import(trees: &[TokenTree], mut i: usize, before: &[String], module: &mut Module) -> usize {
    let mut path = before.to_vec();
    loop {
        match (word(trees, i).as_str(), trees.get(i)) {
            (_, Some(TokenTree::Group(group))) => {
                let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                let mut place = 0;
                while place < inner.len() {
                    place = import(&inner, place, &path, module) + 1;
                }
                return i + 1;
            }
            ("*", _) => {
                module.globs.push(path);
                return i + 1;
            }
            ("as", _) => {
                module.imports.insert(word(trees, i + 1), path.clone());
                module.paths.push(path);
                return i + 2;
            }
            ("" | "," | ";", _) => break,
            (":", _) => (),
            (name, _) => path.push(name.into()),
        }
        i += 1;
    }
    path.pop_if(|last| last == "self");
    if let Some(last) = path.last() {
        module.imports.insert(last.clone(), path.clone());
        module.paths.push(path);
    }
    i
}

/// Which files each file imports, by the item that a name resolves to.
fn arrows() -> BTreeMap<String, BTreeSet<String>> {
    let mut modules = Modules::default();
    for (library, folder) in CRATES.iter().filter(|(library, _)| *library != "main") {
        let sources = crate::tree(Path::new(folder)).into_iter();
        for (name, bytes) in sources.filter(|(name, _)| name.ends_with(".rs")) {
            let (file, inside) = (format!("{folder}/{name}"), name.trim_end_matches(".rs"));
            let source = String::from_utf8(bytes).unwrap();
            let is_program = *folder == "src" && (inside == "main" || inside.starts_with("cli"));
            let mut path = vec![if is_program { "main" } else { library }.to_string()];
            path.extend(inside.split('/').map(String::from));
            if ["lib", "main", "mod"].contains(&path.last().unwrap().as_str()) {
                path.pop();
            }
            if !path.contains(&"tests".to_string()) {
                // Clippy refuses code behind such a module.
                let code = source.split("#[cfg(test)]\nmod tests").next().unwrap();
                modules.read(&path, &file, code.parse().unwrap());
            }
        }
    }
    let mut arrows: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (path, module) in &modules.all {
        let globs = module.globs.iter().map(|glob| (glob, true));
        for (used, is_glob) in module.paths.iter().map(|path| (path, false)).chain(globs) {
            let imported = match modules.resolve(path, used, 9) {
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
    let design = fs::read_to_string("DESIGN.md").unwrap();
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

/// Code that is apart, or another experiment's own, must not change a saved result.
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
