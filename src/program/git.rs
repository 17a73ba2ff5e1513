//! The git command, without a shell between.

use std::io;
use std::process::Command;

/// What git prints, or else the line in which it says why not.
///
/// # Errors
/// If it cannot be started; [`io::ErrorKind::NotFound`] where there is no git.
pub fn git(arguments: &[&str]) -> io::Result<Result<Vec<u8>, String>> {
    let output = Command::new("git").arg("--no-pager").args(arguments).output()?;
    let told = String::from_utf8_lossy(&output.stderr);
    let line = told.lines().next().unwrap_or_default().trim_start_matches("fatal: ");
    Ok(if output.status.success() { Ok(output.stdout) } else { Err(line.into()) })
}
