//! Puts into the program what each experiment is made of, as `dependencies.rs`: the hash of every
//! file that it depends on, and that of Cargo.lock.
//!
//! Saved results are reused only by the code that would compute them again to the same bits; a
//! change of prose, of a figure, of the theory or of another experiment leaves them as they are.

use super::depends::{self, Source};
use super::homes::source_files;
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::path::PathBuf;
use std::{env, fs, io};

/// Writes `dependencies.rs` for `experiments::identity`.
pub fn run() -> io::Result<()> {
    println!("cargo::rerun-if-changed=Cargo.lock");
    let mut source = Source::new();
    for file in source_files()? {
        source.insert(file.to_string_lossy().replace('\\', "/"), fs::read_to_string(&file)?);
    }
    let mut out = format!("({:?}, &[\n", hash(&fs::read("Cargo.lock")?));
    let saved = |path: &&String| path.starts_with("src/experiments/");
    for path in source.keys().filter(saved) {
        let _ = writeln!(out, "    ({path:?}, &[");
        for file in depends::files(&source, path) {
            let _ = writeln!(out, "        ({file:?}, {:?}),", hash(source[&file].as_bytes()));
        }
        out.push_str("    ]),\n");
    }
    out.push_str("])\n");
    let folder = env::var_os("OUT_DIR").map(PathBuf::from).unwrap_or_default();
    fs::write(folder.join("dependencies.rs"), out)
}

/// The first 64 bits of SHA-256, in hexadecimal.
fn hash(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().take(8).map(|byte| format!("{byte:02x}")).collect()
}
