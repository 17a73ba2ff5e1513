//! The git command, without a shell between.

use std::io;
use std::process::Command;

/// What git prints; None if it fails.
///
/// # Errors
/// If it cannot be started; [`io::ErrorKind::NotFound`] where there is no git.
pub fn git(arguments: &[&str]) -> io::Result<Option<Vec<u8>>> {
    let mut command = Command::new("git");
    let output = command.args(["--no-pager", "--no-replace-objects"]).args(arguments).output()?;
    Ok(output.status.success().then_some(output.stdout))
}
