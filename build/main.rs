//! What the program must know of its own source: its commit, the hashes by which saved results are known, and, with the
//! feature `embed`, the files that it reads when it runs.

use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs, io};

/// All files below a folder with one of these endings, sorted.
fn collect(folder: &str, endings: &[&str]) -> io::Result<Vec<String>> {
    println!("cargo::rerun-if-changed={folder}");
    let (mut files, mut open) = (Vec::new(), vec![PathBuf::from(folder)]);
    while let Some(at) = open.pop() {
        for entry in fs::read_dir(at)? {
            let path = entry?.path();
            let ending = path.extension().and_then(|end| end.to_str()).unwrap_or_default();
            if path.is_dir() {
                open.push(path);
            } else if endings.contains(&ending) {
                files.push(path.to_string_lossy().replace('\\', "/"));
            }
        }
    }
    files.sort();
    Ok(files)
}

/// ` (1a2b3c4d5e6f)`, with a plus sign where the checkout has changes that are not committed; nothing outside a checkout.
fn commit() -> Option<String> {
    let describe = ["describe", "--always", "--exclude=*", "--abbrev=12", "--dirty=+"];
    let told = Command::new("git").args(describe).output().ok()?;
    let known = told.status.success() && Path::new(".git").exists();
    known.then(|| format!(" ({})", String::from_utf8_lossy(&told.stdout).trim()))
}

fn main() -> io::Result<()> {
    let put = |name: &str, text: String| {
        fs::write(PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default()).join(name), text)
    };
    put("commit.txt", commit().unwrap_or_default())?;
    println!("cargo::rerun-if-changed=Cargo.lock");
    let source = [vec!["Cargo.lock".into()], collect("src", &["rs"])?, collect("crates", &["rs"])?];
    let hashed = source.concat().into_iter().map(|path| {
        // The first 64 bits are enough.
        let hash = Sha256::digest(fs::read(&path)?);
        let hash: String = hash.iter().take(8).map(|byte| format!("{byte:02x}")).collect();
        Ok(format!("({path:?}, {hash:?}),\n"))
    });
    put("fingerprint.rs", format!("&[{}]", hashed.collect::<io::Result<String>>()?))?;
    let mut rows = String::new();
    if env::var_os("CARGO_FEATURE_EMBED").is_some() {
        let endings = ["md", "tex", "bib", "toml", "html", "css", "js", "json"];
        for path in [collect("templates", &endings)?, collect("benches", &["json"])?].concat() {
            rows += &format!("({path:?}, include_str!({:?})),\n", fs::canonicalize(&path)?);
        }
    }
    put("embedded.rs", format!("&[{rows}]"))
}
