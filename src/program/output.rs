//! What the program writes for people: whole or not at all, and over nothing but its own.
//!
//! The rule has its home here. A file that stands there may be replaced if the program wrote it and
//! nobody changed it since: two lists say so, SHA256SUMS of a report and SHA256SUMS.local of whatever
//! was last written into the folder. Everything else is refused by name, unless --force.

use super::alone::alone;
use super::own::Own;
use super::places::{lies_in_report, refuse_dangling};
use super::signals;
use super::waiting::{Waiting, clear, is_living, is_staging};
use super::{Failure, folder};
use crate::report::{Document, Files, PROGRAM, sums};
use literate::input::{bare, is_absent, listed, one_line};
use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};

/// What says of which sample a report is.
pub const VALUES: &str = "values.json";

/// Folders that a report has.
pub(super) const FOLDERS: [&str; 2] = ["data", "figures"];

/// What all verbs call the option.
#[derive(Clone, Copy, clap::Args)]
pub struct Force {
    /// Write over files that this program did not make, or that were changed since; says which.
    #[arg(long)]
    pub force: bool,
}

/// The last steps of writing into a folder.
///
/// A folder that was made here, and into which nothing came, is gone in the end.
#[derive(Debug)]
pub struct Staging<'a> {
    pub(super) folder: &'a Path,
    /// The option that names the folder, for messages.
    pub(super) option: &'static str,
    pub(super) force: bool,
    /// Where it leads, and the list of the report that stood there, at first.
    pub(super) there: PathBuf,
    pub(super) found: Option<String>,
    _made: signals::Made,
}

impl<'a> Staging<'a> {
    /// Prepares to write below `folder`: before a long run, not after it, one wants to hear that
    /// this is impossible. Removes what killed runs left there.
    ///
    /// # Errors
    /// Exit code 2 if the folder has content and none of our lists, exit code 2 or 4 if it cannot be
    /// made or written.
    pub fn below(
        folder: &'a Path,
        option: &'static str,
        Force { force }: Force,
    ) -> Result<Self, Failure> {
        refuse_dangling(option, folder)?;
        if folder.exists() && !folder.is_dir() {
            let what = "it is a file; give a folder";
            return Err(Failure::input(format!("{option}: {}: {what}", folder.display())));
        }
        if lies_in_report(&folder::resolved(folder)) {
            let what = "it lies in a report, which has no other files; give another folder";
            return Err(Failure::input(format!("{option}: {}: {what}", folder.display())));
        }
        let found = folder::text(folder, sums::NAME).ok();
        let there = folder::resolved(folder);
        let staging = Staging { folder, option, force, there, found, _made: signals::made(folder) };
        let failed = |error: io::Error| staging.failed(&error, folder);
        std::fs::create_dir_all(folder).map_err(failed)?;
        // Another run may be putting its files in place: half of them would look like a stranger's.
        let _alone = alone(folder).map_err(failed)?;
        staging.no_folder([sums::LOCAL].iter())?;
        let own = staging.own()?;
        let strange = |name: &String| !is_staging(folder, name) && !is_begun(folder, name);
        let strange = names(folder).map_err(failed)?.into_iter().find(strange);
        if let (Some(name), None, false) = (strange, &own, force) {
            return Err(Failure::input(format!(
                "{option}: {} has files that this program did not make ({}); give a new or empty folder, or \
                 --force to write among them",
                folder.display(),
                one_line(&name, 100)
            )));
        }
        for name in names(folder).map_err(failed)?.iter().filter(|name| is_staging(folder, name)) {
            // Whoever writes here holds the lock, but temporary files of other runs may be here too.
            if !is_living(&folder.join(name)) {
                clear(&folder.join(name));
            }
        }
        staging.temporary()?;
        for below in FOLDERS.map(|below| folder.join(below)) {
            staging.is_folder(&below)?;
            if below.is_dir() {
                let remedy = "allow to write there, or give another folder";
                let place = || format!("{option}: {}", below.display());
                let refused = |error: io::Error| Failure::io(&bare(error), place(), remedy);
                tempfile::tempfile_in(&below).map_err(refused)?;
            }
        }
        Ok(staging)
    }

    /// Refuses, before a long run, a report of which a file was changed.
    ///
    /// # Errors
    /// Exit code 2 with the names.
    pub fn refuse_changed(&self) -> Result<(), Failure> {
        let _alone = alone(self.folder).map_err(|error| self.failed(&error, self.folder))?;
        let own = self.own()?.unwrap_or_default();
        // A document may stand without a list of it; and a list may be somebody else's.
        let documents = PROGRAM.documents.iter().flat_map(Document::paths);
        let others: Vec<String> = documents.chain([sums::NAME.into()]).collect();
        let all = || own.digests.keys().chain(&others);
        all().try_for_each(|path| self.inside(path))?;
        self.no_folder(all())?;
        let all: BTreeSet<&str> = all().map(String::as_str).collect();
        self.refuse(self.theirs(&own, &Files::new(), all)?).map(drop)
    }

    /// What the lists say; a list that cannot be read would make files of ours look like a stranger's.
    pub(super) fn own(&self) -> Result<Option<Own>, Failure> {
        Own::read(self.folder, self.force).map_err(|failure| failure.of(self.option))
    }

    /// Those of the paths where something stands that neither was written here nor is about to be.
    pub(super) fn theirs<'p>(
        &self,
        own: &Own,
        files: &Files,
        paths: impl IntoIterator<Item = &'p str>,
    ) -> Result<Vec<&'p str>, Failure> {
        let mut theirs = Vec::new();
        for path in paths.into_iter().filter(|path| stands(&self.folder.join(path))) {
            match folder::read(self.folder, path) {
                Ok(bytes) if own.wrote(path, &bytes) || files.get(path) == Some(&bytes) => (),
                Ok(_) => theirs.push(path),
                Err(error) => {
                    let place = self.folder.join(path);
                    let what = format!("{}: {}", self.option, place.display());
                    Failure::of_the_system(&error, what)?;
                    // Whoever removed it meanwhile did so for good.
                    theirs.extend((!is_absent(&error)).then_some(path));
                }
            }
        }
        Ok(theirs)
    }

    /// A folder in which files wait until all are complete.
    pub(super) fn temporary(&self) -> Result<Waiting, Failure> {
        Waiting::below(self.folder).map_err(|error| self.failed(&error, self.folder))
    }

    /// Refuses a folder in the place of a file.
    pub(super) fn no_folder(
        &self,
        files: impl Iterator<Item = impl AsRef<str>>,
    ) -> Result<(), Failure> {
        match files.map(|path| self.folder.join(path.as_ref())).find(|path| path.is_dir()) {
            None => Ok(()),
            Some(folder) => {
                let what = "is a folder where a file belongs; move it away";
                Err(Failure::input(format!("{}: {} {what}", self.option, folder.display())))
            }
        }
    }

    /// Refuses to touch what is not ours, unless forced: then it is told later.
    pub(super) fn refuse<'p>(&self, theirs: Vec<&'p str>) -> Result<Vec<&'p str>, Failure> {
        if theirs.is_empty() || self.force {
            return Ok(theirs);
        }
        let (option, folder) = (self.option, self.folder.display());
        let what = "not as this program last wrote it";
        let remedy = "move it away, or write over it with --force";
        Err(Failure::input(format!("{option}: {folder}: {what}: {}; {remedy}", listed(&theirs))))
    }

    pub(super) fn failed(&self, error: &io::Error, place: &Path) -> Failure {
        let what = format!("{}: {}", self.option, place.display());
        Failure::io(error, what, "give a folder that can be written")
    }

    /// Refuses a path that would leave the folder: one with `..` or from the root, and one through a
    /// symbolic link to a folder. (The folder itself may be a link; a file that is one is replaced, not
    /// followed.)
    pub(super) fn inside(&self, path: &str) -> Result<(), Failure> {
        let option = self.option;
        if !sums::is_inside(path) {
            let path = one_line(path, 200);
            return Err(Failure::input(format!("{option}: {path:?} is no path inside the folder")));
        }
        let above = Path::new(path).ancestors().skip(1).filter(|above| *above != Path::new(""));
        above.map(|above| self.folder.join(above)).try_for_each(|above| self.is_folder(&above))
    }

    /// Refuses what stands in the place of a folder of the report.
    fn is_folder(&self, path: &Path) -> Result<(), Failure> {
        let what = match path.symlink_metadata() {
            Ok(found) if found.is_symlink() => "is a symbolic link out of the folder",
            Ok(found) if !found.is_dir() => "is a file where a folder of the report belongs",
            _ => return Ok(()),
        };
        let (option, path) = (self.option, path.display());
        let remedy = "remove it, or give another folder";
        Err(Failure::input(format!("{option}: {path} {what}; {remedy}")))
    }
}

/// Is it an empty folder of ours? A run that was killed before its first file leaves such.
fn is_begun(folder: &Path, name: &str) -> bool {
    FOLDERS.contains(&name)
        && folder.join(name).read_dir().is_ok_and(|mut files| files.next().is_none())
}

/// Whether something is there, as far as anybody can tell: what cannot be looked at is.
pub(super) fn stands(path: &Path) -> bool {
    path.symlink_metadata().err().is_none_or(|error| !is_absent(&error))
}

/// Names of what is in a folder.
pub(super) fn names(folder: &Path) -> io::Result<Vec<String>> {
    let name = |entry: io::Result<std::fs::DirEntry>| {
        entry.map(|entry| entry.file_name().to_string_lossy().into_owned())
    };
    std::fs::read_dir(folder)?.map(name).collect()
}

#[cfg(test)]
mod tests {
    use super::super::placing::Told;
    use super::super::waiting::OURS;
    use super::*;
    use crate::experiments::Progress;
    use literate::input::STAGING;
    use std::time::Duration;

    const ASK: Force = Force { force: false };

    fn files(names: &[&str]) -> Files {
        names.iter().map(|name| (name.to_string(), name.as_bytes().to_vec())).collect()
    }

    /// With a list and a ledger, so that they are a report.
    fn report(names: &[&str]) -> Files {
        let mut files = files(&[names, &["values.json"]].concat());
        files.insert("ledger.json".into(), b"{\"claims\":[]}".into());
        files.insert(sums::NAME.into(), sums::write(&files).into_bytes());
        files
    }

    fn place(folder: &Path, files: &Files) -> Result<(), Failure> {
        Staging::below(folder, "--out", ASK)?.place(files, &Progress::silent())
    }

    fn sorted(folder: &Path) -> Vec<String> {
        let mut names = names(folder).unwrap();
        names.sort();
        names
    }

    #[test]
    fn own_files_are_replaced_and_removed_and_strangers_left() {
        let out = tempfile::tempdir().unwrap();
        let folder = out.path().join("paper");
        place(&folder, &report(&["data/old.csv", "data/kept.csv"])).unwrap();
        std::fs::write(folder.join("notes.txt"), "a stranger").unwrap();
        place(&folder, &report(&["data/kept.csv", "report.md"])).unwrap();
        let own = ["SHA256SUMS", "SHA256SUMS.local", "data", "ledger.json", "notes.txt"];
        assert_eq!(sorted(&folder), [&own[..], &["report.md", "values.json"]].concat());
        assert_eq!(sorted(&folder.join("data")), ["kept.csv"]);
        // What only one list knows: a checkout has no local one.
        std::fs::remove_file(folder.join(sums::LOCAL)).unwrap();
        place(&folder, &report(&["report.md"])).unwrap();
        assert!(!folder.join("data/kept.csv").exists());
        // Another revision is checked out: files and list agree, and the local list is of this one.
        let local = std::fs::read(folder.join(sums::LOCAL)).unwrap();
        place(&folder, &report(&["other.md", "report.md"])).unwrap();
        let mut other = report(&["other.md"]);
        other.insert("report.md".into(), b"of another revision".to_vec());
        other.insert(sums::NAME.into(), Vec::new());
        let listed = sums::write(
            &other
                .iter()
                .filter(|(path, _)| *path != sums::NAME)
                .map(|(path, bytes)| (path.clone(), bytes.clone()))
                .collect(),
        );
        other.insert(sums::NAME.into(), listed.into_bytes());
        for (path, bytes) in &other {
            std::fs::write(folder.join(path), bytes).unwrap();
        }
        std::fs::write(folder.join(sums::LOCAL), local).unwrap();
        Staging::below(&folder, "--out", ASK).unwrap().refuse_changed().unwrap();
        place(&folder, &report(&["report.md"])).unwrap();
        assert!(!folder.join("other.md").exists());
        // A few files into a folder of their own, twice.
        let few = out.path().join("few");
        for name in ["a.md", "b.md"] {
            place(&few, &files(&[name])).unwrap();
        }
        assert_eq!(sorted(&few), ["SHA256SUMS.local", "a.md", "b.md"]);
    }

    #[test]
    fn what_others_wrote_is_refused_by_name_and_nothing_changes() {
        let out = tempfile::tempdir().unwrap();
        let folder = out.path();
        std::fs::write(folder.join("report.md"), "by hand").unwrap();
        let refused = |files: &Files, name: &str| {
            let before = sorted(folder);
            let failure = place(folder, files).unwrap_err();
            assert_eq!(failure.code, 2);
            assert!(failure.message.contains(name), "{}", failure.message);
            assert!(failure.message.contains("--force"), "{}", failure.message);
            assert_eq!(sorted(folder), before);
        };
        refused(&report(&["report.md"]), "(report.md)");
        // A list of somebody else makes nothing ours.
        let theirs = sums::write(&[("report.md".to_string(), b"by hand".to_vec())].into());
        std::fs::write(folder.join(sums::NAME), theirs).unwrap();
        refused(&report(&["new.md"]), "did not make");
        let force = Staging::below(folder, "--out", Force { force: true }).unwrap();
        force.place(&report(&["report.md", "old.md"]), &Progress::silent()).unwrap();
        assert_eq!(std::fs::read_to_string(folder.join("report.md")).unwrap(), "report.md");
        // Changed since, by hand or by a merge: one that would be replaced, one that would go, and the list.
        for name in ["report.md", "old.md", sums::NAME] {
            let before = std::fs::read(folder.join(name)).unwrap();
            std::fs::write(folder.join(name), "<<<<<<<").unwrap();
            refused(&report(&["report.md", "more.md"]), name);
            let staging = Staging::below(folder, "--out", ASK).unwrap();
            assert!(staging.refuse_changed().unwrap_err().message.contains(name));
            std::fs::write(folder.join(name), before).unwrap();
        }
        // The same bytes cost nobody anything.
        std::fs::write(folder.join("more.md"), "more.md").unwrap();
        place(folder, &report(&["report.md", "more.md"])).unwrap();
        // A document that no list has.
        std::fs::write(folder.join("beyond.md"), "by hand").unwrap();
        let staging = Staging::below(folder, "--out", ASK).unwrap();
        assert!(staging.refuse_changed().unwrap_err().message.contains("beyond.md"));
    }

    /// Somebody saves a file, and a new one, while ours are being written beside.
    #[test]
    fn what_is_saved_meanwhile_stays() {
        let out = tempfile::tempdir().unwrap();
        let folder = out.path();
        place(folder, &report(&["report.md"])).unwrap();
        let mut files = report(&["beyond.md", "report.md"]);
        files.insert("report.md".into(), b"another".to_vec());
        files.extend((0..200).map(|i| (format!("data/{i}.csv"), vec![0; 200_000])));
        let staged = |name: &String| folder.join(name).join("data").exists();
        std::thread::scope(|scope| {
            scope.spawn(|| {
                while !names(folder).unwrap().iter().any(staged) {}
                for name in ["report.md", "beyond.md"] {
                    let saved = folder.join(format!("{name}.swp"));
                    std::fs::write(&saved, "by hand").unwrap();
                    std::fs::rename(saved, folder.join(name)).unwrap();
                }
            });
            // On a busy machine they may be saved when all is over.
            assert_eq!(place(folder, &files).map_or_else(|failure| failure.code, |()| 2), 2);
        });
        for name in ["report.md", "beyond.md"] {
            assert_eq!(std::fs::read_to_string(folder.join(name)).unwrap(), "by hand");
        }
    }

    /// What was written over is known also where a later file cannot be put in place, and temporary files of a program
    /// that lives stay.
    #[test]
    fn what_was_done_is_known_and_what_lives_stays() {
        let out = tempfile::tempdir().unwrap();
        let (folder, staged) = (out.path().join("out"), out.path().join("staged"));
        for path in [&folder, &staged] {
            std::fs::create_dir(path).unwrap();
        }
        let living = Waiting::below(&folder).unwrap();
        std::fs::write(folder.join("a.md"), "by hand").unwrap();
        let files = files(&["a.md", "b.md"]);
        // The second is not there.
        for name in [sums::LOCAL, "a.md"] {
            std::fs::write(staged.join(name), name).unwrap();
        }
        let staging = Staging::below(&folder, "--out", Force { force: true }).unwrap();
        let mut told = Told::default();
        let failure = staging.put(&Own::default(), &files, &[], None, &staged, &mut told);
        assert!(failure.unwrap_err().message.contains("b.md"));
        assert_eq!(told.over, ["a.md"]);
        assert!(living.path().exists());
    }

    /// Killed before its first file was put in place.
    #[test]
    fn a_run_that_made_folders_alone_is_gone_on_with() {
        let out = tempfile::tempdir().unwrap();
        std::fs::create_dir(out.path().join("data")).unwrap();
        place(out.path(), &report(&["data/a.csv"])).unwrap();
        std::fs::create_dir(out.path().join("other")).unwrap();
        std::fs::remove_file(out.path().join(sums::NAME)).unwrap();
        std::fs::remove_file(out.path().join(sums::LOCAL)).unwrap();
        assert_eq!(place(out.path(), &report(&[])).unwrap_err().code, 2);
    }

    /// A report that came during the run may be a fuller one.
    #[test]
    fn a_report_that_came_meanwhile_stays() {
        let out = tempfile::tempdir().unwrap();
        let folder = out.path();
        let begun = || Staging::below(folder, "--out", ASK).unwrap();
        let [late, again, forced] = [begun(), begun(), begun()];
        let full = report(&["report.md", "more.md"]);
        place(folder, &full).unwrap();
        let lesser = report(&["report.md"]);
        let failure = late.place(&lesser, &Progress::silent()).unwrap_err();
        assert!(failure.code == 2 && failure.message.contains("before this run"));
        assert!(folder.join("more.md").exists());
        again.place(&full, &Progress::silent()).unwrap();
        Staging { force: true, ..forced }.place(&lesser, &Progress::silent()).unwrap();
        assert!(!folder.join("more.md").exists());
    }

    /// At each moment at which a run may be killed, the next one knows its files.
    #[test]
    fn a_run_that_was_killed_between_two_files_is_gone_on_with() {
        let with = |word: &str| {
            let mut files = report(&["data/a.csv", "report.md"]);
            for path in ["data/a.csv", "report.md", "values.json"] {
                files.insert(path.into(), word.into());
            }
            files.remove(sums::NAME);
            files.insert(sums::NAME.into(), sums::write(&files).into_bytes());
            // Beside the report: no list but the local one has it.
            files.insert("report.html".into(), word.into());
            files
        };
        let (old, new) = (with("old"), with("new"));
        let order: Vec<&String> = old.keys().filter(|path| *path != sums::NAME).collect();
        for replaced in 0..=order.len() {
            let out = tempfile::tempdir().unwrap();
            place(out.path(), &old).unwrap();
            let own = Own::read(out.path(), false).unwrap().unwrap();
            std::fs::write(out.path().join(sums::LOCAL), own.local(&new, |_| true, true)).unwrap();
            for path in &order[..replaced] {
                std::fs::write(out.path().join(path), &new[*path]).unwrap();
            }
            Staging::below(out.path(), "--out", ASK).unwrap().refuse_changed().unwrap();
            place(out.path(), &with("newer")).unwrap();
            let local = std::fs::read_to_string(out.path().join(sums::LOCAL)).unwrap();
            assert_eq!(sums::read(&local).unwrap().len(), old.len() - 1);
        }
    }

    /// Leftovers of the killed go, those of the living stay.
    #[test]
    fn leftovers_go_when_nobody_writes() {
        let out = tempfile::tempdir().unwrap();
        let left = out.path().join(format!("{STAGING}abc"));
        std::fs::create_dir_all(left.join("data")).unwrap();
        std::fs::write(left.join("data/a.csv"), "half").unwrap();
        std::fs::write(left.join(OURS), "").unwrap();
        let living = alone(out.path()).unwrap();
        let waiting = std::thread::scope(|scope| {
            let other = scope.spawn(|| Staging::below(out.path(), "--out", ASK).map(|_| ()));
            std::thread::sleep(Duration::from_millis(200));
            let waits = left.exists() && !other.is_finished();
            drop(living);
            other.join().unwrap().unwrap();
            waits
        });
        assert!(waiting && !left.exists());
    }

    #[test]
    fn what_only_looks_like_leftovers_is_a_stranger() {
        let out = tempfile::tempdir().unwrap();
        for name in [".staging-site".into(), format!("{STAGING}site")] {
            let theirs = out.path().join(&name);
            std::fs::create_dir(&theirs).unwrap();
            std::fs::write(theirs.join("index.md"), "theirs").unwrap();
            let failure = place(out.path(), &files(&["a"])).unwrap_err();
            assert!(failure.message.contains(&format!("({name})")), "{}", failure.message);
            assert!(theirs.join("index.md").exists());
            let _ = std::fs::remove_dir_all(out.path().join("site"));
            std::fs::rename(&theirs, out.path().join("site")).unwrap();
        }
        let file = out.path().join(format!("{STAGING}notes.md"));
        std::fs::write(&file, "theirs").unwrap();
        let force = Staging::below(out.path(), "--out", Force { force: true }).unwrap();
        force.place(&files(&["a"]), &Progress::silent()).unwrap();
        assert!(file.exists() && out.path().join("site/index.md").exists());
    }

    /// A run that begins while another puts its files in place sees all of them or none.
    #[test]
    fn who_begins_while_another_writes_is_not_misled() {
        let names: Vec<String> = (0..60).map(|k| format!("file-{k}.md")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).chain(["index.md"]).collect();
        let whole = report(&names);
        for _ in 0..6 {
            let out = tempfile::tempdir().unwrap();
            let folder = out.path();
            std::thread::scope(|scope| {
                let place = || {
                    let staging = Staging::below(folder, "--out", ASK).unwrap();
                    staging.place(&whole, &Progress::silent())
                };
                let writer = scope.spawn(place);
                while !writer.is_finished() {
                    Staging::below(folder, "--out", ASK).unwrap().refuse_changed().unwrap();
                }
                writer.join().unwrap().unwrap();
            });
        }
    }
}
