//! Puts the fingerprint of the simulating code into the program, as `CODE_FINGERPRINT`.
//!
//! Saved results are reused only by the code that would compute them again to the same bits. So
//! the fingerprint covers what a simulation is made of and the versions of all crates; a change of
//! prose, of a figure or of the theory leaves it as it is.

use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};

/// What a simulation is made of.
const SOURCES: [&str; 6] = [
    "Cargo.lock",
    "src/params.rs",
    "src/params",
    "src/numerics",
    "src/dynamics",
    "src/experiments",
];

/// What lies among it and changes no saved result.
const EXCEPT: [&str; 3] =
    ["src/experiments/theory", "src/experiments/progress.rs", "src/experiments/measured.rs"];

/// Prints the fingerprint for the compiler.
pub fn run() -> std::io::Result<()> {
    let mut files = Vec::new();
    for source in SOURCES {
        println!("cargo::rerun-if-changed={source}");
        walk(Path::new(source), &mut files)?;
    }
    files.sort();
    let mut hash = Sha256::new();
    for file in files {
        let text = std::fs::read(&file)?;
        hash.update(file.to_string_lossy().as_bytes());
        hash.update((text.len() as u64).to_le_bytes());
        hash.update(&text);
    }
    let digest: String = hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
    println!("cargo::rustc-env=CODE_FINGERPRINT={digest}");
    Ok(())
}

fn walk(path: &Path, files: &mut Vec<PathBuf>) -> std::io::Result<()> {
    if EXCEPT.iter().any(|except| path == Path::new(except)) {
        return Ok(());
    }
    if !path.is_dir() {
        files.push(path.into());
        return Ok(());
    }
    for entry in std::fs::read_dir(path)? {
        walk(&entry?.path(), files)?;
    }
    Ok(())
}
