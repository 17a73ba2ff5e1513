//! Lists the homes of the numbered equations: every doc comment with `**Eq. (n)**`, as
//! (n, path of the item, what the comment says behind it, file). The report and the crate's first page read
//! this list, so that neither can disagree with the source.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

/// The report, from the first page of `cargo doc`.
const REPORT: &str = "../../../paper/report.html";

/// Crates of this workspace: the name in code, and where the source lies.
const CRATES: [(&str, &str); 4] = [
    ("literate", "crates/literate/src"),
    ("impact_numerics", "crates/numerics/src"),
    ("impact_chain", "crates/impact-chain/src"),
    ("impact_circuits", "crates/circuits/src"),
];

/// The crate that a file belongs to; none if it is of the program itself.
fn of_crate(path: &str) -> Option<(&'static str, &'static str)> {
    CRATES.into_iter().find(|(_, folder)| path.starts_with(folder))
}

/// Writes `homes.rs` for `report::equations`, and `map.md` for the first page of `cargo doc`.
pub fn run() -> io::Result<()> {
    let mut out = String::from("&[\n");
    let mut rows = Vec::new();
    for file in source_files()? {
        for (number, item, note) in homes(&module(&file), &fs::read_to_string(&file)?) {
            let path = file.to_string_lossy();
            let _ = writeln!(out, "    ({number}, {item:?}, {note:?}, {path:?}),");
            let link = format!("[({number})]({REPORT}#eq-{number})");
            // The page of the source: an item may be private, and has no page of its own then.
            let (own, folder) = of_crate(&path).unwrap_or(("impact_paper", "src"));
            let source = format!("../src/{own}{}.html", path.trim_start_matches(folder));
            rows.push((number, format!("| {link} | [`{item}`]({source}) |\n")));
        }
    }
    out.push_str("]\n");
    rows.sort();
    let map: String = rows.into_iter().map(|(_, row)| row).collect();
    let folder = env::var_os("OUT_DIR").map(PathBuf::from).unwrap_or_default();
    fs::write(folder.join("map.md"), format!("| equation | home |\n|---|---|\n{map}"))?;
    fs::write(folder.join("homes.rs"), out)
}

/// The source of the program and of its crates, sorted.
pub fn source_files() -> io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for folder in CRATES.into_iter().map(|(_, folder)| folder).chain(["src"]) {
        println!("cargo::rerun-if-changed={folder}");
        collect(Path::new(folder), &["rs"], &mut files)?;
    }
    files.sort();
    Ok(files)
}

/// All files below a folder with one of these endings.
pub fn collect(folder: &Path, endings: &[&str], into: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            collect(&path, endings, into)?;
        } else if path.extension().is_some_and(|end| endings.iter().any(|own| end == *own)) {
            into.push(path);
        }
    }
    Ok(())
}

/// crates/circuits/src/jump.rs → impact_circuits::jump, crates/circuits/src/lib.rs → circuits.
pub fn module(file: &Path) -> String {
    let path = file.to_string_lossy().replace('\\', "/");
    let (name, folder) = of_crate(&path).map_or((None, "src"), |(name, own)| (Some(name), own));
    let inside = path[folder.len()..].trim_end_matches(".rs").split('/').skip(1);
    let mut parts: Vec<&str> = name.into_iter().chain(inside).collect();
    parts.pop_if(|last| ["mod", "lib"].contains(last));
    parts.join("::")
}

fn homes(module: &str, text: &str) -> Vec<(u32, String, String)> {
    let mut found = Vec::new();
    // Homes whose item has not been reached yet, and the type that an `impl` block is about.
    let mut waiting: Vec<(u32, String)> = Vec::new();
    let mut owner = String::new();
    for line in text.lines() {
        let code = line.trim_start();
        if let Some(header) = line.strip_prefix("impl") {
            owner = subject(header);
        } else if line.starts_with('}') {
            owner.clear();
        }
        if let Some(comment) = code.strip_prefix("///").or_else(|| code.strip_prefix("//!")) {
            if let Some(rest) = comment.trim_start().strip_prefix("**Eq. (")
                && let Some((number, note)) = rest.split_once(")**")
                && let Ok(number) = number.parse()
            {
                let note = note.trim_start_matches(':').trim().to_string();
                if code.starts_with("//!") {
                    found.push((number, module.to_string(), note));
                } else {
                    waiting.push((number, note));
                }
            }
        } else if !waiting.is_empty()
            && let Some(name) = item(code)
        {
            let path = match owner.as_str() {
                "" => format!("{module}::{name}"),
                owner => format!("{module}::{owner}::{name}"),
            };
            found.extend(waiting.drain(..).map(|(number, note)| (number, path.clone(), note)));
        }
    }
    found
}

/// `<'a> Trait for Type<'a> {` → Type.
fn subject(header: &str) -> String {
    let header = header.split(" for ").last().unwrap_or(header);
    let after = match header.strip_prefix('<').and_then(|rest| rest.split_once('>')) {
        Some((_, after)) => after,
        None => header,
    };
    let name = |c: char| c.is_alphanumeric() || c == '_';
    after.trim_start().chars().take_while(|c| name(*c)).collect()
}

/// The name of the item that a line of code declares: a function, type, constant or field.
fn item(code: &str) -> Option<String> {
    if code.is_empty() || code.starts_with("#[") || code.starts_with("//") {
        return None;
    }
    let word = |c: char| !(c.is_alphanumeric() || c == '_');
    let mut words = code.split(word).filter(|w| !w.is_empty());
    let keyword = |w: &&str| {
        matches!(*w, "fn" | "struct" | "enum" | "trait" | "const" | "static" | "type" | "mod")
    };
    let by_keyword = words.clone().position(|w| keyword(&w) && w != "const");
    match by_keyword {
        Some(i) => words.nth(i + 1).map(str::to_string),
        // `pub const NAME`, `pub field: Type`, `Variant`.
        None => words.find(|w| !matches!(*w, "pub" | "crate" | "const")).map(str::to_string),
    }
}
