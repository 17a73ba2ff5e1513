//! Reads all imports, and refuses those that DESIGN.md does not allow, and circles.

use super::*;
use proc_macro2::{TokenStream, TokenTree};
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

/// The name or sign at a place; empty for groups, literals, and behind the end.
fn word(trees: &[TokenTree], place: usize) -> String {
    match trees.get(place) {
        Some(tree @ (TokenTree::Ident(_) | TokenTree::Punct(_))) => tree.to_string(),
        _ => String::new(),
    }
}

/// A path of modules or to an item; `*` at its end stands for all that is there.
type Place = Vec<String>;

/// What a module has: names of items, imports with the names that they give, and all paths.
#[derive(Default)]
struct Module {
    file: String,
    items: BTreeSet<String>,
    imports: Vec<(String, Place)>,
    paths: Vec<Place>,
}

impl Module {
    /// Reads what an import names, of which a part was read before.
    fn import(&mut self, trees: &[TokenTree], before: &[String]) {
        for trees in trees.split(|tree| tree.to_string() == ",") {
            if let Some((TokenTree::Group(group), first)) = trees.split_last() {
                let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                self.import(&inner, &[before, &names(first)].concat());
                continue;
            }
            let alias = trees.iter().position(|tree| tree.to_string() == "as");
            let mut path = [before, &names(&trees[..alias.unwrap_or(trees.len())])].concat();
            path.pop_if(|last| last == "self");
            let name = alias.map(|place| word(trees, place + 1)).or(path.last().cloned());
            self.imports.extend(name.map(|name| (name, path.clone())));
            self.paths.push(path);
        }
    }
}

/// The parts of a path.
fn names(trees: &[TokenTree]) -> Place {
    trees.iter().map(TokenTree::to_string).filter(|part| part != ":").collect()
}

/// All modules, by their paths, of which the first part is the name of the crate; and the files of
/// macros, which have their places at the top of the crate if they are exported.
#[derive(Default)]
struct Modules {
    all: BTreeMap<Place, Module>,
    macros: BTreeMap<Place, String>,
}

impl Modules {
    fn read(&mut self, path: &[String], file: &str, tokens: TokenStream) {
        let mut module = Module { file: file.into(), ..Module::default() };
        self.collect(path, tokens, true, &mut module);
        self.all.insert(path.to_vec(), module);
    }

    /// Reads the tokens of a module, or, not at its top, those between brackets.
    fn collect(&mut self, path: &[String], tokens: TokenStream, top: bool, module: &mut Module) {
        let trees: Vec<TokenTree> = tokens.into_iter().collect();
        let (mut i, sign) = (0, |place: usize| word(&trees, place));
        while let Some(tree) = trees.get(i) {
            match (sign(i).as_str(), tree, trees.get(i + 2)) {
                ("use", ..) if sign(i + 1) != "<" => {
                    let end = (i..trees.len()).find(|&place| sign(place) == ";").unwrap();
                    module.import(&trees[i + 1..end], &[]);
                    i = end;
                }
                ("mod", _, Some(TokenTree::Group(items))) if top => {
                    self.read(&[path, &[sign(i + 1)]].concat(), &module.file, items.stream());
                    i += 2;
                }
                (
                    "fn" | "struct" | "enum" | "const" | "static" | "type" | "trait" | "union",
                    ..,
                ) if top => {
                    module.items.insert(sign(i + 1));
                }
                ("macro_rules", ..) => {
                    module.items.insert(sign(i + 2));
                    self.macros.insert(vec![path[0].clone(), sign(i + 2)], module.file.clone());
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
            "self" | "*" => from.to_vec(),
            "super" => from[..from.len() - 1].to_vec(),
            _ => match self.find(from, name, steps.checked_sub(1)?)? {
                Found::Module(inside) => inside,
                item => return Some(item),
            },
        };
        self.resolve(&inside, rest, steps)
    }

    /// Finds what a name stands for in a module: a module, an item, what is imported under the
    /// name or with all of another module, or a crate.
    fn find(&self, from: &[String], name: &String, steps: usize) -> Option<Found> {
        let module = self.all.get(from)?;
        let child = [from, std::slice::from_ref(name)].concat();
        if self.all.contains_key(&child) {
            return Some(Found::Module(child));
        }
        let file = module.items.contains(name).then_some(&module.file);
        if let Some(file) = file.or(self.macros.get(&child)) {
            return Some(Found::Item(file.clone()));
        }
        let is_named = |(own, path): &&(String, Place)| own == name && path[..] != [name.clone()];
        if let Some((_, path)) = module.imports.iter().rfind(is_named) {
            return self.resolve(from, path, steps);
        }
        let by_glob = |(_, path): &(String, Place)| match self.resolve(from, path, steps)? {
            Found::Module(inside) => self.find(&inside, name, steps.checked_sub(1)?),
            Found::Item(_) => None,
        };
        let is_crate = CRATES.iter().any(|(known, _)| known == name);
        let by_crate = || is_crate.then(|| Found::Module(vec![name.clone()]));
        let mut globs = module.imports.iter().filter(|(own, _)| own == "*");
        globs.find_map(by_glob).or_else(by_crate)
    }
}

/// What a path names: an item of a file, or a module.
enum Found {
    Item(String),
    Module(Place),
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
        for used in &module.paths {
            let imported = match modules.resolve(path, used, 9) {
                Some(Found::Item(file)) => file,
                Some(Found::Module(imported)) if used.ends_with(&["*".into()]) => {
                    modules.all[&imported].file.clone()
                }
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
        layers.iter().filter(|(name, _)| is_in(name)).max_by_key(|(name, _)| name.len())
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
