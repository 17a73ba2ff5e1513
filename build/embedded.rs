//! Puts files that the program reads when it runs into a binary that is to travel alone, as (path, text):
//! the feature `embed`. Without it the list is empty, and nothing is compiled when one of them changes.

use super::homes::collect;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

/// Where they lie; fonts, which are beside templates, are always inside.
const FOLDERS: [(&str, &[&str]); 2] = [
    ("templates", &["md", "tex", "bib", "toml", "html", "css", "js", "json"]),
    ("benches", &["json"]),
];

/// Writes `embedded.rs` for `committed`.
pub fn run() -> io::Result<()> {
    let mut files = Vec::new();
    if env::var_os("CARGO_FEATURE_EMBED").is_some() {
        for (folder, endings) in FOLDERS {
            println!("cargo::rerun-if-changed={folder}");
            collect(Path::new(folder), endings, &mut files)?;
        }
    }
    files.sort();
    let mut out = String::from("&[\n");
    for path in files.iter().map(|file| file.to_string_lossy()) {
        let text = format!("include_str!(concat!(env!(\"CARGO_MANIFEST_DIR\"), \"/{path}\"))");
        let _ = writeln!(out, "    ({path:?}, {text}),");
    }
    out.push_str("]\n");
    let folder = env::var_os("OUT_DIR").map(PathBuf::from).unwrap_or_default();
    fs::write(folder.join("embedded.rs"), out)
}
