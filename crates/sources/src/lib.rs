//! Macros that put the text of files into a program, which is built again when one of them changes:
//! [`sources!`] for the source that it was made of, [`texts!`] for prose.

use proc_macro::TokenStream;
use std::path::{Path, PathBuf};

/// The source of a program, as `literate::Sources`: `sources!("src")` has every Rust file below
/// `src`, Cargo.toml and Cargo.lock, those of a workspace too, and how the compiler is called.
/// Folders are given from that of the crate's Cargo.toml; the first has the program.
#[proc_macro]
pub fn sources(folders: TokenStream) -> TokenStream {
    let folders: Vec<String> = quoted_words(folders);
    let program = folders.first().cloned().unwrap_or_default();
    let files = files_below(folders, &["rs"]).map(|files| [files, manifests()].concat());
    let compiled = compiled();
    code(files, |list| {
        format!(
            "::literate::Sources {{ name: env!(\"CARGO_PKG_NAME\"), version: env!(\"CARGO_PKG_VERSION\"), \
             files: &[{list}], crates: &[(\"\", {program:?})], compiled: &{compiled:?} }}"
        )
    })
}

/// Returns the paths of Cargo.toml and Cargo.lock of the package and of its workspace.
fn manifests() -> Vec<String> {
    let (top, mut files) = (top(), Vec::new());
    let (mut passed, mut way) = (Vec::new(), String::new());
    for folder in Path::new(&top).ancestors() {
        let manifest = std::fs::read_to_string(folder.join("Cargo.toml")).unwrap_or_default();
        let is_there = |name: &&str| folder.join(name).is_file();
        let names = ["Cargo.lock", "Cargo.toml"].into_iter().filter(is_there);
        passed.extend(names.map(|name| format!("{way}{name}")));
        if way.is_empty() || manifest.contains("[workspace]") {
            files.clone_from(&passed);
        }
        if manifest.contains("[workspace]") {
            break;
        }
        way += "../";
    }
    files
}

/// Lists what changes the meaning of code: compiler, features, conditions, options.
fn compiled() -> Vec<(String, String)> {
    const OPTIONS: [&str; 5] =
        ["opt-level", "debug-assertions", "overflow-checks", "target-cpu", "target-feature"];
    let mut compiled = vec![("the compiler".to_string(), env!("COMPILER").to_string())];
    // A macro runs within the compiler.
    let arguments: Vec<String> = std::env::args().collect();
    for pair in arguments.windows(2) {
        let (name, value) = pair[1].split_once('=').unwrap_or((&pair[1], "yes"));
        match pair[0].as_str() {
            "--cfg" if name == "feature" => {
                compiled.push((format!("feature {}", value.trim_matches('"')), "yes".into()));
            }
            "--cfg" => compiled.push((format!("condition {}", pair[1]), "yes".into())),
            "-C" if OPTIONS.contains(&name) => {
                compiled.push((format!("option {name}"), value.into()))
            }
            _ => (),
        }
    }
    compiled
}

/// Paths and texts of files, and of every text below folders, as `&[(&str, &str)]`.
#[proc_macro]
pub fn texts(places: TokenStream) -> TokenStream {
    let endings = ["md", "tex", "bib", "toml", "html", "css", "js", "json"];
    code(files_below(quoted_words(places), &endings), |list| format!("&[{list}]"))
}

fn top() -> String {
    std::env::var("CARGO_MANIFEST_DIR").unwrap_or_default()
}

/// Returns the code that a list of files expands to, or an error of compilation.
fn code(files: Result<Vec<String>, String>, whole: impl Fn(&str) -> String) -> TokenStream {
    let entry =
        |path: &String| format!("({path:?}, include_str!({:?})),", Path::new(&top()).join(path));
    let tokens = match files {
        Ok(files) => whole(&files.iter().map(entry).collect::<String>()),
        Err(error) => format!("compile_error!({error:?})"),
    };
    tokens.parse().unwrap_or_default()
}

fn quoted_words(tokens: TokenStream) -> Vec<String> {
    tokens.to_string().split('"').skip(1).step_by(2).map(String::from).collect()
}

/// Returns the sorted paths of all files with one of these endings below some places.
fn files_below(places: Vec<String>, endings: &[&str]) -> Result<Vec<String>, String> {
    let (mut files, mut open) = (Vec::new(), places);
    while let Some(place) = open.pop() {
        let path: PathBuf = Path::new(&top()).join(&place);
        if path.is_file() {
            files.push(place);
            continue;
        }
        for entry in std::fs::read_dir(&path).map_err(|error| format!("{place}: {error}"))? {
            let path = entry.map_err(|error| format!("{place}: {error}"))?.path();
            let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
            let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
            if path.is_dir() && name != "target" || endings.contains(&ending) {
                open.push(format!("{place}/{name}"));
            }
        }
    }
    files.sort();
    Ok(files)
}
