//! The git command, without a shell between.

use std::process::Command;

/// What git prints.
///
/// # Errors
/// Why it does not, in its words.
pub fn git(arguments: &[&str]) -> Result<Vec<u8>, String> {
    let output = Command::new("git").arg("--no-pager").args(arguments).output();
    let output = output.map_err(|error| format!("git: {error}"))?;
    let told = String::from_utf8_lossy(&output.stderr);
    if output.status.success() { Ok(output.stdout) } else { Err(told.into_owned()) }
}
