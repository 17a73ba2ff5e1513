//! Puts path and hash of Cargo.lock and of every source file into the program, as `fingerprint.rs`: of some of them each
//! experiment is made (`experiments::built`).

use super::homes::source_files;
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::path::PathBuf;
use std::{env, fs, io};

/// Writes `fingerprint.rs`, sorted by path.
pub fn run() -> io::Result<()> {
    println!("cargo::rerun-if-changed=Cargo.lock");
    let mut out = String::from("&[\n");
    for file in std::iter::once("Cargo.lock".into()).chain(source_files()?) {
        // The first 64 bits are enough.
        let hash = Sha256::digest(fs::read(&file)?);
        let hash: String = hash.iter().take(8).map(|byte| format!("{byte:02x}")).collect();
        let path = file.to_string_lossy().replace('\\', "/");
        let _ = writeln!(out, "    ({path:?}, {hash:?}),");
    }
    out.push_str("]\n");
    let folder = env::var_os("OUT_DIR").map(PathBuf::from).unwrap_or_default();
    fs::write(folder.join("fingerprint.rs"), out)
}
