//! One program at a time puts files into a folder.

#[cfg(unix)]
use crate::experiments::alive;
use std::fs::File;
use std::io;
use std::path::Path;
#[cfg(unix)]
use std::time::Duration;

/// A lock on the folder itself, which ends with whoever holds it and leaves no file. It is held for
/// moments; file systems without locks go without.
#[cfg(unix)]
pub(super) fn alone(folder: &Path) -> io::Result<Option<File>> {
    let file = File::open(folder)?;
    let mut _told = None;
    for _ in 0..500 {
        match file.try_lock() {
            Ok(()) => return Ok(Some(file)),
            Err(std::fs::TryLockError::WouldBlock) => {
                let waits = "waiting for another program that writes into the folder";
                _told.get_or_insert_with(|| alive(move || Some(waits.into())));
                std::thread::sleep(Duration::from_millis(20));
            }
            Err(std::fs::TryLockError::Error(error)) if has_no_locks(&error) => return Ok(None),
            Err(std::fs::TryLockError::Error(error)) => return Err(error),
        }
    }
    Err(io::Error::other("another program has been writing there for ten seconds"))
}

/// Whether the system says so of a file system: ENOSYS, EOPNOTSUPP, or ENOLCK, which has no kind of its own.
#[cfg(unix)]
fn has_no_locks(error: &io::Error) -> bool {
    let no_locks = if cfg!(target_os = "linux") { 37 } else { 77 };
    error.kind() == io::ErrorKind::Unsupported || error.raw_os_error() == Some(no_locks)
}

/// Folders are not locked here.
#[cfg(not(unix))]
pub(super) fn alone(_: &Path) -> io::Result<Option<File>> {
    Ok(None)
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    /// Some network file systems have no daemon for locks.
    #[test]
    fn file_systems_without_locks_go_without() {
        for (code, without) in [(37, true), (38, true), (95, true), (13, false), (11, false)] {
            assert_eq!(has_no_locks(&io::Error::from_raw_os_error(code)), without, "{code}");
        }
    }
}
