//! Puts the source that the report quotes into the program: the layers that compute, as (module,
//! file, text). Which items are quoted is for the templates to say, when the program runs.

use super::homes::{collect, module};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

/// What may be quoted.
const LAYERS: [&str; 3] = ["src/numerics", "src/dynamics", "src/circuits"];

/// Writes `sources.rs` for `report::literate`.
pub fn run() -> io::Result<()> {
    let mut files = Vec::new();
    for layer in LAYERS {
        collect(Path::new(layer), &mut files)?;
    }
    files.sort();
    let mut out = String::from("&[\n");
    for file in files {
        let (module, path) = (module(&file), file.to_string_lossy());
        let text = format!("include_str!(concat!(env!(\"CARGO_MANIFEST_DIR\"), \"/{path}\"))");
        let _ = writeln!(out, "    ({module:?}, {path:?}, {text}),");
    }
    out.push_str("]\n");
    let folder = env::var_os("OUT_DIR").map(PathBuf::from).unwrap_or_default();
    fs::write(folder.join("sources.rs"), out)
}
