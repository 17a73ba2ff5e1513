//! Folders in which files wait until all are complete, and what killed runs leave of them.

use crate::input::{STAGING, bare};
use std::io;
use std::path::Path;

/// The mark of a folder in which files of ours wait.
pub const OURS: &str = ".impact-paper";

/// A folder in which files wait.
#[derive(Debug)]
pub struct Waiting(tempfile::TempDir);

impl Waiting {
    /// A new one, with its mark.
    pub fn below(folder: &Path) -> io::Result<Self> {
        let made = tempfile::Builder::new().prefix(STAGING).tempdir_in(folder).map_err(bare)?;
        std::fs::write(made.path().join(OURS), "")?;
        // What a killed run leaves is none of git's.
        std::fs::write(made.path().join(".gitignore"), "*\n")?;
        Ok(Waiting(made))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        self.0.path()
    }
}

impl Drop for Waiting {
    fn drop(&mut self) {
        clear(self.0.path());
    }
}

/// Removes such a folder, its mark last: whoever is killed meanwhile leaves what the next run knows.
pub fn clear(waiting: &Path) {
    for entry in std::fs::read_dir(waiting).into_iter().flatten().flatten() {
        let (path, name) = (entry.path(), entry.file_name());
        // What cannot be removed is in nobody's way.
        let _ = match entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            true => std::fs::remove_dir_all(path),
            false if name == OURS => continue,
            false => std::fs::remove_file(path),
        };
    }
    let _ = std::fs::remove_file(waiting.join(OURS));
    let _ = std::fs::remove_dir(waiting);
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
