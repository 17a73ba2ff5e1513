//! Folders in which files wait until all are complete, and what killed runs leave of them.

use super::signals;
use literate::input::{STAGING, bare, is_settled};
use std::fs::File;
use std::io;
use std::path::Path;

/// The mark of a folder in which files of ours wait.
pub const OURS: &str = ".impact-paper";

/// A folder in which files wait.
#[derive(Debug)]
pub struct Waiting {
    made: tempfile::TempDir,
    /// Its mark, locked as long as this lives.
    mark: Option<File>,
}

impl Waiting {
    /// A new one, with its mark.
    pub fn below(folder: &Path) -> io::Result<Self> {
        let made = tempfile::Builder::new().prefix(STAGING).tempdir_in(folder).map_err(bare)?;
        // Under a umask that allows nobody, `made` itself cannot.
        let undo = |_: &io::Error| drop(std::fs::remove_dir(made.path()));
        let mark = File::create(made.path().join(OURS)).inspect_err(undo)?;
        // Where there are no locks, leftovers stay.
        let _ = mark.try_lock();
        // What a killed run leaves is none of git's.
        std::fs::write(made.path().join(".gitignore"), "*\n")?;
        Ok(Waiting { made, mark: Some(mark) })
    }

    /// A new one among the temporary files of all programs: a signal removes it, and the next run what a killed one left.
    pub fn temporary() -> io::Result<Self> {
        let folder = std::env::temp_dir();
        clear_left(&folder);
        let waiting = Waiting::below(&folder)?;
        signals::temporary(waiting.path());
        Ok(waiting)
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        self.made.path()
    }
}

impl Drop for Waiting {
    fn drop(&mut self) {
        // Where few files may be open, one less.
        self.mark = None;
        clear(self.made.path());
    }
}

/// Removes such a folder, its mark last: whoever is killed meanwhile, or cannot remove all, leaves what the next run
/// knows.
pub fn clear(waiting: &Path) {
    let mut left = false;
    for entry in std::fs::read_dir(waiting).into_iter().flatten().flatten() {
        let (path, name) = (entry.path(), entry.file_name());
        left |= match entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            true => std::fs::remove_dir_all(path),
            false if name == OURS => continue,
            false => std::fs::remove_file(path),
        }
        .is_err();
    }
    if left {
        return;
    }
    let _ = std::fs::remove_file(waiting.join(OURS));
    let _ = std::fs::remove_dir(waiting);
}

/// Removes what killed runs left in a folder: those of which nobody holds the mark. What is younger than a second may be
/// about to be locked.
fn clear_left(folder: &Path) {
    let is_left = |path: &Path| {
        let mark = path.join(OURS);
        // A run that was killed at its very beginning or end left no mark.
        let found = mark.symlink_metadata().or_else(|_| path.symlink_metadata());
        let settled = found.and_then(|found| found.modified()).is_ok_and(is_settled);
        let open = || File::open(&mark).is_ok_and(|mark| mark.try_lock().is_ok());
        settled && (open() || mark.symlink_metadata().is_err())
    };
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let named = entry.file_name().to_str().is_some_and(|name| is_staging(folder, name));
        if named && is_left(&entry.path()) {
            clear(&entry.path());
        }
    }
}

/// Whether a program that lives holds the mark of such a folder.
pub fn is_living(waiting: &Path) -> bool {
    use std::fs::TryLockError::WouldBlock;
    File::open(waiting.join(OURS)).is_ok_and(|mark| matches!(mark.try_lock(), Err(WouldBlock)))
}

/// Is it a folder in which files of ours waited? One with the mark, or an empty one: a run may be killed before it
/// leaves its mark.
pub fn is_staging(folder: &Path, name: &str) -> bool {
    let path = folder.join(name);
    name.starts_with(STAGING)
        && path.symlink_metadata().is_ok_and(|found| found.is_dir())
        && (path.join(OURS).symlink_metadata().is_ok_and(|found| found.is_file())
            || path.read_dir().is_ok_and(|mut files| files.next().is_none()))
}

#[cfg(test)]
mod tests {
    use super::super::git::git;
    use super::*;

    #[test]
    fn what_killed_runs_left_goes_and_what_lives_stays() {
        let folder = tempfile::tempdir().unwrap();
        let [left, theirs] = ["dead00", "site00"].map(|name| {
            let path = folder.path().join(format!("{STAGING}{name}"));
            std::fs::create_dir(&path).unwrap();
            std::fs::write(path.join("half"), "").unwrap();
            path
        });
        let living = Waiting::below(folder.path()).unwrap();
        std::fs::write(left.join(OURS), "").unwrap();
        let empty = folder.path().join(format!("{STAGING}dead11"));
        std::fs::create_dir(&empty).unwrap();
        clear_left(folder.path());
        assert!(left.exists() && empty.exists(), "they may be about to be locked");
        let future = std::time::SystemTime::now() + std::time::Duration::from_secs(1 << 30);
        File::open(&empty).unwrap().set_modified(future).unwrap();
        let old = std::time::SystemTime::now() - std::time::Duration::from_secs(60);
        for path in [&left, living.path()] {
            let mark = File::options().write(true).open(path.join(OURS)).unwrap();
            mark.set_modified(old).unwrap();
        }
        clear_left(folder.path());
        assert!(!left.exists() && !empty.exists() && theirs.exists() && living.path().exists());
    }

    #[test]
    fn git_sees_nothing_of_what_waits() {
        let folder = tempfile::tempdir().unwrap();
        let of = |verb: &[&str]| {
            let folder = folder.path().to_str().unwrap();
            String::from_utf8(git(&[&["-C", folder], verb].concat()).unwrap().unwrap()).unwrap()
        };
        of(&["init", "--quiet"]);
        let waiting = Waiting::below(folder.path()).unwrap();
        std::fs::write(waiting.path().join("report.md"), "half").unwrap();
        assert_eq!(of(&["status", "--porcelain"]), "");
        drop(waiting);
        assert_eq!(folder.path().read_dir().unwrap().count(), 1, "only .git");
    }
}
