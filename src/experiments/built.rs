//! What this program was built of, by which saved results are known.

use crate::committed;
use literate::experiments::{Built, Code};

/// Each file of an experiment, with path and hash of every file that it depends on.
type Modules = &'static [(&'static str, &'static [(&'static str, &'static str)])];

/// Hash of Cargo.lock, and the modules (see `build/fingerprint.rs`).
const DEPENDENCIES: (&str, Modules) = include!(concat!(env!("OUT_DIR"), "/dependencies.rs"));

static BUILT: Built = Built { lock: DEPENDENCIES.0, files, committed: committed::text };

fn files(module: &str) -> Vec<(String, String)> {
    let own = DEPENDENCIES.1.iter().find(|(path, _)| *path == module);
    let files = own.map(|(_, files)| *files).unwrap_or_default();
    files.iter().map(|(path, hash)| ((*path).into(), (*hash).into())).collect()
}

/// The code of an experiment of this program, in this file.
pub const fn code(file: &'static str) -> Code {
    Code { built: &BUILT, file }
}
