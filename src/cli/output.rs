//! Files that appear whole or not at all.

use super::Failure;
use impact_paper::experiments::Progress;
use impact_paper::input::one_line;
use impact_paper::report::{Files, sums};
use std::io;
use std::path::Path;
use tempfile::TempDir;

/// A folder with a temporary one in it, into which everything goes first.
///
/// The temporary folder is gone in the end, whatever happens; and so is the folder itself if it
/// was made here and nothing came into it.
#[derive(Debug)]
pub struct Staging<'a> {
    folder: &'a Path,
    /// The option that names the folder, for messages.
    option: &'static str,
    made: bool,
    /// Inside the folder, so on its file system: there a rename is one step.
    temporary: Option<TempDir>,
}

impl<'a> Staging<'a> {
    /// Prepares to write below `folder`: before a long run, not after it, one wants to hear that
    /// this is impossible.
    ///
    /// # Errors
    /// Exit code 2 if the folder cannot be made or written.
    pub fn below(folder: &'a Path, option: &'static str) -> Result<Self, Failure> {
        let failed = |error: io::Error| unwritable(option, folder, &error);
        let made = !folder.exists();
        std::fs::create_dir_all(folder).map_err(failed)?;
        let mut staging = Staging { folder, option, made, temporary: None };
        let temporary = tempfile::Builder::new().prefix(".staging-").tempdir_in(folder);
        staging.temporary = Some(temporary.map_err(failed)?);
        Ok(staging)
    }

    /// Writes `files` to the temporary folder and, when that is complete and nobody has asked to
    /// stop, renames each into its place.
    ///
    /// # Errors
    /// Exit code 2 if something cannot be written, 130 on Ctrl-C.
    pub fn place(mut self, files: &Files, progress: &Progress) -> Result<(), Failure> {
        let failed = |error: io::Error| unwritable(self.option, self.folder, &error);
        let Some(temporary) = &self.temporary else { return Ok(()) };
        for (path, bytes) in files {
            inside(self.folder, path)?;
            let staged = temporary.path().join(path);
            std::fs::create_dir_all(staged.parent().unwrap_or(self.folder)).map_err(failed)?;
            std::fs::write(&staged, bytes).map_err(failed)?;
        }
        progress.check()?;
        for path in files.keys() {
            inside(self.folder, path)?;
        }
        for path in files.keys() {
            let target = self.folder.join(path);
            std::fs::create_dir_all(target.parent().unwrap_or(self.folder)).map_err(failed)?;
            std::fs::rename(temporary.path().join(path), &target).map_err(failed)?;
        }
        self.made = false;
        Ok(())
    }
}

impl Drop for Staging<'_> {
    fn drop(&mut self) {
        drop(self.temporary.take());
        if self.made {
            // Fails, as it should, if the folder is not empty.
            let _ = std::fs::remove_dir(self.folder);
        }
    }
}

fn unwritable(option: &str, folder: &Path, error: &io::Error) -> Failure {
    let folder = folder.display();
    Failure::input(format!("{option}: {folder}: {error}; give a folder that can be written"))
}

/// Refuses a path that would leave `folder`: one with `..` or from the root, and one through a
/// symbolic link to a folder. (The folder itself may be a link; a file that is one is replaced, not
/// followed.)
fn inside(folder: &Path, path: &str) -> Result<(), Failure> {
    if !sums::is_inside(path) {
        let path = one_line(path, 200);
        return Err(Failure::input(format!("--out: {path:?} is no path inside the folder")));
    }
    for above in Path::new(path).ancestors().skip(1).filter(|above| !above.as_os_str().is_empty()) {
        let above = folder.join(above);
        if above.is_symlink() {
            return Err(Failure::input(format!(
                "--out: {} is a symbolic link out of the folder; remove it, or give another folder",
                above.display()
            )));
        }
    }
    Ok(())
}

/// Removes what the SHA256SUMS of an earlier run lists and this one no longer writes. Files that
/// no run wrote are left alone.
///
/// # Errors
/// Exit code 2 if a file cannot be removed.
pub fn remove_stale(folder: &Path, sums_before: &str, files: &Files) -> Result<(), Failure> {
    for (_, path) in sums_before.lines().filter_map(|line| line.split_once("  ")) {
        if inside(folder, path).is_err() || files.contains_key(path) {
            continue;
        }
        match std::fs::remove_file(folder.join(path)) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                let path = folder.join(path);
                return Err(Failure::input(format!(
                    "--out: {}: {error}; remove this file, it is of an earlier version",
                    path.display()
                )));
            }
            _ => (),
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;

    fn files(names: &[&str]) -> Files {
        names.iter().map(|name| (name.to_string(), name.as_bytes().to_vec())).collect()
    }

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn files_replace_older_ones_and_leave_strangers() {
        let out = tempfile::tempdir().unwrap();
        let folder = out.path().join("paper");
        std::fs::create_dir_all(folder.join("data")).unwrap();
        for stranger in ["data/old.csv", "notes.txt", "data/kept.csv"] {
            std::fs::write(folder.join(stranger), "before").unwrap();
        }
        let files = files(&["report.md", "data/kept.csv"]);
        Staging::below(&folder, "--out").unwrap().place(&files, &Progress::silent()).unwrap();
        let sums = "00  data/old.csv\n00  data/kept.csv\n00  ../outside\n00  never-there\n";
        std::fs::write(out.path().join("outside"), "").unwrap();
        remove_stale(&folder, sums, &files).unwrap();
        assert_eq!(names(&folder), ["data", "notes.txt", "report.md"]);
        assert_eq!(names(&folder.join("data")), ["kept.csv"]);
        assert_eq!(std::fs::read_to_string(folder.join("data/kept.csv")).unwrap(), "data/kept.csv");
        assert!(out.path().join("outside").exists());
    }

    #[test]
    fn an_interruption_before_the_end_changes_nothing() {
        let out = tempfile::tempdir().unwrap();
        let stopped = Progress::on_stderr(Arc::new(AtomicBool::new(true)));
        std::fs::write(out.path().join("report.md"), "before").unwrap();
        let staging = Staging::below(out.path(), "--out").unwrap();
        let failure = staging.place(&files(&["report.md"]), &stopped).unwrap_err();
        assert_eq!(failure.code, 130);
        assert_eq!(names(out.path()), ["report.md"]);
        assert_eq!(std::fs::read_to_string(out.path().join("report.md")).unwrap(), "before");
        let new = out.path().join("new");
        assert!(Staging::below(&new, "--out").unwrap().place(&files(&["x"]), &stopped).is_err());
        assert!(!new.exists());
    }

    #[test]
    fn what_cannot_be_written_is_named() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let failure = Staging::below(file.path(), "--out").unwrap_err();
        assert_eq!(failure.code, 2);
        assert!(failure.message.starts_with("--out: "), "{}", failure.message);
    }
}
