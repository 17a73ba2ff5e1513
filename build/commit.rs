//! The commit of the checkout that the program is built from, for `--version`.

use std::path::PathBuf;
use std::process::Command;
use std::{env, fs, io};

/// Writes `commit.txt`: ` (1a2b3c4d5e6f)`, with a plus sign where the source has changes that are not
/// committed; nothing outside a checkout. It is looked at when the source changes, and not with every
/// commit, which would compile the program again each time.
pub fn run() -> io::Result<()> {
    let git = |arguments: &[&str]| -> Option<String> {
        let output = Command::new("git").args(arguments).output().ok()?;
        let text = String::from_utf8(output.stdout).ok()?;
        output.status.success().then(|| text.trim().to_string())
    };
    let top = git(&["rev-parse", "--show-prefix"]).filter(|prefix| prefix.is_empty());
    let commit = top.and_then(|_| git(&["rev-parse", "--short=12", "HEAD"]));
    let own = ["status", "--porcelain", "--", "src", "crates", "build", "Cargo.toml", "Cargo.lock"];
    let changed = git(&own).is_some_and(|list| !list.is_empty());
    let plus = if changed { "+" } else { "" };
    let text = commit.map(|commit| format!(" ({commit}{plus})")).unwrap_or_default();
    let folder = env::var_os("OUT_DIR").map(PathBuf::from).unwrap_or_default();
    fs::write(folder.join("commit.txt"), text)
}
