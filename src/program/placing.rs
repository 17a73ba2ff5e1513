//! The moment in which what was written replaces what stands there.

use super::alone::alone;
use super::output::{Staging, VALUES, stands};
use super::own::Own;
use super::signals::{self, Now};
use super::{Failure, folder};
use crate::experiments::{Progress, say};
use crate::report::{Files, sums};
use literate::input::{count, listed, one_line};
use std::collections::BTreeSet;
use std::io;
use std::path::Path;

/// The list of what was last written, as it is when all is in place.
const LAST: &str = "SHA256SUMS.local.last";

/// What people hear of afterwards.
#[derive(Default)]
pub(super) struct Told<'p> {
    /// Written over when forced.
    pub(super) over: Vec<&'p str>,
    /// Removed with the report before.
    pub(super) removed: Vec<&'p str>,
}

impl Told<'_> {
    fn tell(mut self) {
        if !self.removed.is_empty() {
            let number = count(self.removed.len(), "file");
            let names = one_line(&listed(&self.removed), 500);
            say(&format!("impact-paper: removed {number} of the report before: {names}"));
        }
        if !self.over.is_empty() {
            self.over.sort_unstable();
            say(&format!("impact-paper: --force: wrote over {}", self.over.join(", ")));
        }
    }
}

impl Staging<'_> {
    /// Writes `files` to a temporary folder and, when that is complete and nobody has asked to stop,
    /// renames each into its place. With a SHA256SUMS among them they are a whole report: then files
    /// that the list before names, and this one does not, are removed.
    ///
    /// # Errors
    /// Exit code 2 for a file that is not ours to replace, 2 or 4 if something cannot be written, 130
    /// on Ctrl-C.
    pub fn place(self, files: &Files, progress: &Progress) -> Result<(), Failure> {
        let failed = |error: io::Error| self.failed(&error, self.folder);
        // A run that began beside this one and failed has removed the folder if it was empty.
        std::fs::create_dir_all(self.folder).map_err(failed)?;
        let alone = alone(self.folder).map_err(failed)?;
        let changed = |what: &str| {
            let (option, folder) = (self.option, self.folder.display());
            let remedy = "run again, or give another folder";
            Failure::input(format!("{option}: {folder}: {what} before this run; {remedy}"))
        };
        if folder::resolved(self.folder) != self.there {
            return Err(changed("it leads elsewhere than"));
        }
        // It may be of more than what was asked before the run.
        let now = folder::text(self.folder, sums::NAME).ok();
        let same = now.as_deref().map(str::as_bytes) == files.get(sums::NAME).map(Vec::as_slice);
        if !self.force && now != self.found && !same {
            return Err(changed("the report here is another than"));
        }
        let own = &self.own()?.unwrap_or_default();
        let is_report = files.contains_key(sums::NAME);
        let gone = own.report.iter().filter(|path| is_report && !files.contains_key(*path));
        let gone: Vec<&str> = gone.map(String::as_str).collect();
        let all = || files.keys().map(String::as_str).chain(gone.iter().copied());
        all().try_for_each(|path| self.inside(path))?;
        self.no_folder(files.keys())?;
        let stands = |path: &str| stands(&self.folder.join(path));

        let temporary = self.temporary()?;
        signals::temporary(temporary.path());
        let stage = |path: &str, bytes: &[u8]| {
            let above = Path::new(path).parent().filter(|above| *above != Path::new(""));
            // Not the temporary folder itself, which a signal may have removed.
            let made =
                above.map_or(Ok(()), |above| std::fs::create_dir(temporary.path().join(above)));
            made.or_else(|error| match error.kind() {
                io::ErrorKind::AlreadyExists => Ok(()),
                _ => Err(error),
            })?;
            std::fs::write(temporary.path().join(path), bytes)
        };
        for (path, bytes) in files {
            progress.check()?;
            stage(path, bytes).map_err(failed)?;
        }
        // Whoever is killed half-way leaves old and new files: at each moment the lists know both.
        stage(sums::LOCAL, own.local(files, stands, true).as_bytes()).map_err(failed)?;
        let stays = |path: &str| stands(path) && !gone.contains(&path);
        stage(LAST, own.local(files, stays, false).as_bytes()).map_err(failed)?;
        let placing = signals::moment(Now::Placing);
        progress.check()?;
        // Somebody may have changed a file while these were written.
        self.refuse(self.theirs(own, files, all())?)?;
        if self.own()?.unwrap_or_default() != *own {
            return Err(changed("the lists here are others than"));
        }
        let mut told = Told::default();
        let result = self.put(own, files, &gone, now.as_deref(), temporary.path(), &mut told);
        drop(temporary);
        // Whoever is told may not listen.
        drop((alone, placing));
        told.tell();
        result
    }

    /// Renames what is staged into its place, and removes what goes; `told` has what was done, also where that fails.
    pub(super) fn put<'p>(
        &self,
        own: &Own,
        files: &'p Files,
        gone: &[&'p str],
        list: Option<&str>,
        staged: &Path,
        told: &mut Told<'p>,
    ) -> Result<(), Failure> {
        // What takes room comes first: a full disk leaves the old report.
        let above: BTreeSet<_> = files.keys().filter_map(|path| Path::new(path).parent()).collect();
        let mut made = Vec::new();
        for above in above.into_iter().map(|above| self.folder.join(above)) {
            made.push(signals::made(&above));
            std::fs::create_dir_all(&above).map_err(|error| self.failed(&error, &above))?;
        }
        let rename = |from: &str, path: &str| {
            let target = self.folder.join(path);
            std::fs::rename(staged.join(from), &target)
                .map_err(|error| self.failed(&error, &target))
        };
        let put = |path: &str| rename(path, path);
        let both = std::fs::read(staged.join(sums::LOCAL)).ok();
        put(sums::LOCAL)?;
        told.over.extend(own.unusable.then_some(sums::LOCAL));
        // What says of which sample it is goes first: without it the rest would be a report that nobody knows.
        let values = files.keys().filter(|path| *path == VALUES);
        let others = files.keys().filter(|path| ![VALUES, sums::NAME].contains(&path.as_str()));
        for path in values.chain(others) {
            self.inside(path)?;
            let theirs = self.refuse(self.theirs(own, files, [path.as_str()])?)?;
            put(path)?;
            told.over.extend(theirs);
        }
        let stands = |path: &str| stands(&self.folder.join(path));
        for path in gone.iter().copied().filter(|path| stands(path)) {
            self.inside(path)?;
            if self.theirs(own, files, [path])?.is_empty() {
                let target = self.folder.join(path);
                std::fs::remove_file(&target).map_err(|error| self.failed(&error, &target))?;
                told.removed.push(path);
            }
        }
        if files.contains_key(sums::NAME) {
            let mut theirs = self.theirs(own, files, [sums::NAME])?;
            // Of a list only the bytes that were found are known.
            let found = folder::text(self.folder, sums::NAME).ok();
            if theirs.is_empty() && found.is_some() && found.as_deref() != list {
                theirs.push(sums::NAME);
            }
            let theirs = self.refuse(theirs)?;
            put(sums::NAME)?;
            told.over.extend(theirs);
        }
        let found = folder::read(self.folder, sums::LOCAL).ok();
        let changed = (found.is_some() && found != both).then_some(sums::LOCAL);
        let changed = self.refuse(changed.into_iter().collect())?;
        rename(LAST, sums::LOCAL)?;
        told.over.extend(changed);
        Ok(())
    }
}
