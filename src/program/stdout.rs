//! Writing to standard output, which may be closed or full.

use super::Failure;
use std::io::{self, ErrorKind, Write};

/// What became of writing to standard output: who closed the pipe has read enough.
pub fn written(result: io::Result<()>) -> Result<(), Failure> {
    match result {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::io(&error, "standard output", "direct it to a file that can be written"))
        }
        _ => Ok(()),
    }
}

/// Prints text.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    written(out.write_all(text.as_bytes()).and_then(|()| out.flush()))
}
