//! The git command, without a shell between.

use super::signals;
use std::io;
use std::process::Command;

/// What git prints, or else the line in which it says why not.
///
/// # Errors
/// If it cannot be started; [`io::ErrorKind::NotFound`] where there is no git.
pub fn git(arguments: &[&str]) -> io::Result<Result<Vec<u8>, String>> {
    let mut command = Command::new("git");
    // Its messages are told to people, and looked at by tests.
    command.env("LC_ALL", "C").args(["--no-pager", "--no-replace-objects"]);
    let output = command.args(arguments).output()?;
    if output.status.code().is_none() {
        // Ctrl-C of a terminal goes to git too: it is to end this program, and git gave no answer.
        signals::await_end();
        return Err(io::Error::other("a signal ended it; try again"));
    }
    if output.status.success() {
        return Ok(Ok(output.stdout));
    }
    let told = String::from_utf8_lossy(&output.stderr);
    let line = told.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
    Ok(Err(line.trim_start_matches("fatal: ").into()))
}
