//! Writing to standard output, which may be closed or full.

use super::Failure;
use super::signals::{self, Now};
use std::io::{self, ErrorKind, Write};

/// What became of writing to standard output: who closed the pipe has read enough.
///
/// # Errors
/// Exit code 2 or 4 if it cannot be written.
pub fn written(result: io::Result<()>) -> Result<(), Failure> {
    match result {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            let remedy = "direct it to a file that can be written";
            Err(Failure::io(&error, "standard output", remedy))
        }
        _ => Ok(()),
    }
}

/// Prints text.
pub fn print(text: &str) -> Result<(), Failure> {
    let _idle = signals::moment(Now::Idle);
    let mut out = io::stdout().lock();
    written(out.write_all(text.as_bytes()).and_then(|()| out.flush()))
}
