//! Puts the source into the program, as (module, file, text): the report quotes items of it, and
//! `explain` finds them. Which items are quoted is for the templates to say, when the program runs.

use super::homes::{module, source_files};
use std::fmt::Write as _;
use std::path::PathBuf;
use std::{env, fs, io};

/// Writes `sources.rs` for `report::literate`.
pub fn run() -> io::Result<()> {
    let mut out = String::from("&[\n");
    for file in source_files()? {
        let (module, path) = (module(&file), file.to_string_lossy());
        let text = format!("include_str!(concat!(env!(\"CARGO_MANIFEST_DIR\"), \"/{path}\"))");
        let _ = writeln!(out, "    ({module:?}, {path:?}, {text}),");
    }
    out.push_str("]\n");
    let folder = env::var_os("OUT_DIR").map(PathBuf::from).unwrap_or_default();
    fs::write(folder.join("sources.rs"), out)
}
