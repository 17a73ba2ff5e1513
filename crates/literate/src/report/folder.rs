//! Writes a report into a folder, unless somebody edited what is there, and compares the two.
//!
//! Two lists in the format of `sha256sum` name every file: SHA256SUMS those that are committed, and
//! SHA256SUMS.built those that are only built and may be absent, such as pages and figures
//! for LaTeX. The second is built too: it says what was last written here.

use crate::input::{self, STAGING, WRITING, is_absent, remedy, sha256};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io;
use std::path::Path;

pub const SUMS: &str = "SHA256SUMS";

pub const BUILT: &str = "SHA256SUMS.built";

/// The ends of files right in the folder: three kinds that are committed, and three that are built.
const ENDS: [&str; 6] = [".md", ".tex", ".json", ".html", ".css", ".js"];

/// A report in memory: paths relative to its folder, and bytes.
pub type Files = BTreeMap<String, Vec<u8>>;

#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error(
        "{0}: it has files and no {SUMS} of a report; give a new or empty folder, or --force to write among them"
    )]
    NotOurs(String),
    #[error("{}: not as this program last wrote it: {}; move it away, or write over it with --force", .0, .1.join(", "))]
    Edited(String, Vec<String>),
    #[error("{0}: there is no {SUMS}; give the folder of a report")]
    NoList(String),
    #[error(
        "{place}: {source}; {}",
        remedy(source, "see that it can be read and written, or give another folder")
    )]
    Io { place: String, source: io::Error },
}

type Digests = BTreeMap<String, String>;

fn failed(place: &Path) -> impl Fn(io::Error) -> Error {
    let place = place.display().to_string();
    move |source| Error::Io { place: place.clone(), source }
}

fn digest_files(files: &Files) -> Digests {
    files.iter().map(|(path, bytes)| (path.clone(), sha256(bytes))).collect()
}

/// Returns the lines that `sha256sum --check` reads, sorted by path.
fn to_list(digests: &Digests) -> String {
    digests.iter().map(|(path, digest)| format!("{digest}  {path}\n")).collect()
}

pub fn add_lists(files: &mut Files) {
    let (built, committed): (Digests, Digests) =
        digest_files(files).into_iter().partition(|(path, _)| is_generated(path));
    for (name, digests) in [(SUMS, committed), (BUILT, built)] {
        files.insert(name.into(), to_list(&digests).into_bytes());
    }
}

/// Reads paths and digests from a list. Returns `None` if there is no line, or if a line names
/// anything but a file of a report, so that no list can lead out of the folder.
pub fn read_sums(text: &str) -> Option<Digests> {
    let entry = |line: &str| {
        let (digest, path) = line.split_once("  ")?;
        let of_report = match path.split_once('/') {
            None => ENDS.iter().any(|end| path.ends_with(end)),
            Some((folder, name)) => {
                ["data", "figures", "fonts"].contains(&folder) && !name.contains('/')
            }
        };
        (of_report && digest.len() == 64).then(|| (path.to_string(), digest.to_string()))
    };
    text.lines().map(entry).collect::<Option<Digests>>().filter(|list| !list.is_empty())
}

fn entry_names(folder: &Path) -> Result<Vec<String>, Error> {
    let name = |entry: io::Result<std::fs::DirEntry>| {
        entry.map(|entry| entry.file_name().to_string_lossy().into_owned())
    };
    match std::fs::read_dir(folder) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Vec::new()),
        entries => entries.and_then(|entries| entries.map(name).collect()).map_err(failed(folder)),
    }
}

/// Returns the paths of all files below a folder, sorted; links are listed and not followed.
pub fn walk(folder: &Path) -> Result<Vec<String>, Error> {
    let mut paths = Vec::new();
    let mut open = vec![String::new()];
    while let Some(prefix) = open.pop() {
        for name in entry_names(&folder.join(&prefix))? {
            let path = format!("{prefix}{name}");
            let place = folder.join(&path);
            if place.symlink_metadata().map_err(failed(&place))?.is_dir() {
                open.extend((!path.starts_with(STAGING)).then(|| format!("{path}/")));
            } else {
                paths.push(path);
            }
        }
    }
    paths.sort();
    Ok(paths)
}

/// Returns whether a file is built and never committed: .gitignore names the same files.
pub fn is_generated(path: &str) -> bool {
    match path.split_once('/') {
        Some((folder, name)) => match folder {
            "figures" => name.ends_with(".pdf"),
            "data" => name == "index.html",
            _ => folder == "fonts",
        },
        None => path == BUILT || ENDS[3..].iter().any(|end| path.ends_with(end)),
    }
}

/// Reads a list of a folder, or returns `None` if there is no such list.
fn read_list(folder: &Path, name: &str) -> Option<Digests> {
    read_sums(&input::read_text(&folder.join(name)).ok()?)
}

/// Returns the digests in the list of a folder, or `None` if it has other files and no list.
fn listed_digests(folder: &Path) -> Result<Option<Digests>, Error> {
    let is_empty = entry_names(folder)?.iter().all(|name| name.starts_with(STAGING));
    Ok(read_list(folder, SUMS).or_else(|| is_empty.then(Digests::new)))
}

/// Waits until no other run writes into a folder, and keeps others out until the result is dropped.
/// Returns `None` if the folder is absent or its file system has no locks.
fn lock(folder: &Path) -> Option<File> {
    File::open(folder).ok().filter(|folder| folder.lock().is_ok())
}

/// Refuses a folder that has no report, and names files that were edited: neither as listed, nor as
/// `files` has them. For a whole report all listed files are checked.
pub fn refuse(folder: &Path, files: &Files, is_whole: bool) -> Result<(), Error> {
    let _alone = lock(folder);
    refuse_locked(folder, files, is_whole)
}

fn refuse_locked(folder: &Path, files: &Files, is_whole: bool) -> Result<(), Error> {
    let place = || folder.display().to_string();
    let mut ours = listed_digests(folder)?.ok_or_else(|| Error::NotOurs(place()))?;
    ours.extend(read_list(folder, BUILT).unwrap_or_default());
    let paths = ours.keys().filter(|_| is_whole).chain(files.keys());
    let paths = paths.filter(|path| ![SUMS, BUILT].contains(&path.as_str()));
    let is_edited = |path: &&String| match input::read_file(&folder.join(path)) {
        Ok(bytes) => files.get(*path) != Some(&bytes) && ours.get(*path) != Some(&sha256(&bytes)),
        Err(error) => !is_absent(&error),
    };
    let edited: BTreeSet<&String> = paths.filter(is_edited).collect();
    let edited: Vec<String> = edited.into_iter().cloned().collect();
    if edited.is_empty() { Ok(()) } else { Err(Error::Edited(place(), edited)) }
}

/// Writes files: first all into a temporary folder, then each is renamed into its place, the lists
/// last. If the lists are among them they are a whole report, and files that only the old lists
/// name are removed; else their lines are added to the old list. Unless forced, it refuses first.
pub fn write(folder: &Path, files: &Files, force: bool) -> Result<(), Error> {
    let is_whole = files.contains_key(SUMS);
    std::fs::create_dir_all(folder).map_err(failed(folder))?;
    let _alone = lock(folder);
    if !force {
        refuse_locked(folder, files, is_whole)?;
    }
    let (mut listed, built) =
        (listed_digests(folder)?.unwrap_or_default(), read_list(folder, BUILT));
    let gone =
        |path: &&String| is_whole && !files.contains_key(*path) && folder.join(path).exists();
    let old = listed.keys().chain(built.iter().flat_map(BTreeMap::keys));
    let gone: Vec<String> = old.filter(gone).cloned().collect();

    let _moment = WRITING.read();
    let leftovers: Vec<String> =
        entry_names(folder)?.into_iter().filter(|name| name.starts_with(STAGING)).collect();
    let staged = tempfile::Builder::new().prefix(STAGING).tempdir_in(folder);
    let staged = staged.map_err(failed(folder))?;
    let put = |root: &Path, path: &str, action: &dyn Fn(&Path) -> io::Result<()>| {
        let place = root.join(path);
        let above = place.parent().map_or(Ok(()), std::fs::create_dir_all);
        above.and_then(|()| action(&place)).map_err(failed(&folder.join(path)))
    };
    let mut to_write = files.clone();
    if !is_whole {
        listed.extend(digest_files(files));
        to_write.insert(SUMS.into(), to_list(&listed).into_bytes());
    }
    let mut to_write: Vec<(&String, &Vec<u8>)> = to_write.iter().collect();
    to_write
        .retain(|(path, bytes)| input::read_file(&folder.join(path)).ok().as_ref() != Some(bytes));
    to_write.sort_by_key(|(path, _)| [BUILT, SUMS].iter().position(|list| list == path));
    for (path, bytes) in &to_write {
        put(staged.path(), path, &|place| std::fs::write(place, bytes))?;
    }
    for path in &gone {
        put(folder, path, &|place| std::fs::remove_file(place))?;
    }
    for (path, _) in &to_write {
        put(folder, path, &|place| std::fs::rename(staged.path().join(path), place))?;
    }
    for name in leftovers {
        let _ = std::fs::remove_dir_all(folder.join(name));
    }
    Ok(())
}

/// Returns how many files are expected, and a line for each fault; what is built may be missing.
fn find_faults(folder: &Path, mut expected: Digests) -> Result<(usize, Vec<String>), Error> {
    expected.retain(|path, _| !is_generated(path) || folder.join(path).exists());
    let fault = |(path, digest): (&String, &String)| match input::read_file(&folder.join(path)) {
        Ok(bytes) if sha256(&bytes) == *digest => None,
        Ok(_) => Some(format!("differs  {path}")),
        Err(error) if is_absent(&error) => Some(format!("missing  {path}")),
        Err(error) => Some(format!("unread   {path} ({error})")),
    };
    let is_listed = |path: &String| expected.contains_key(path) || [SUMS, BUILT].contains(&&**path);
    let unlisted = walk(folder)?.into_iter().filter(|path| !is_listed(path));
    let unlisted = unlisted.map(|path| format!("unlisted {path}"));
    Ok((expected.len(), expected.iter().filter_map(fault).chain(unlisted).collect()))
}

pub fn verify(folder: &Path) -> Result<(usize, Vec<String>), Error> {
    let place = folder.join(SUMS);
    let sums = input::read_text(&place).map_err(failed(&place))?;
    let mut digests =
        read_sums(&sums).ok_or_else(|| Error::NoList(folder.display().to_string()))?;
    digests.extend(read_list(folder, BUILT).unwrap_or_default());
    find_faults(folder, digests)
}

pub fn compare(folder: &Path, files: &Files) -> Result<(usize, Vec<String>), Error> {
    find_faults(folder, digest_files(files))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn files(pairs: &[(&str, &str)]) -> Files {
        pairs.iter().map(|(path, text)| (path.to_string(), text.as_bytes().to_vec())).collect()
    }

    fn report(pairs: &[(&str, &str)]) -> Files {
        let mut report = files(pairs);
        report.insert("report.html".into(), b"page".to_vec());
        add_lists(&mut report);
        report
    }

    fn standing(folder: &Path) -> Files {
        let one = |path: String| (path.clone(), input::read_file(&folder.join(path)).unwrap());
        walk(folder).unwrap().into_iter().map(one).collect()
    }

    #[test]
    fn a_report_is_replaced_and_what_others_put_there_is_left() {
        let temporary = tempfile::tempdir().unwrap();
        let folder = &temporary.path().join("new/paper");
        let old = report(&[("data/old.csv", "1"), ("report.md", "a")]);
        write(folder, &old, false).unwrap();
        assert_eq!(standing(folder), old);
        fs::write(folder.join("notes.txt"), "by hand").unwrap();
        let new = report(&[("data/new.csv", "1"), ("report.md", "b")]);
        write(folder, &new, false).unwrap();
        assert_eq!(verify(folder).unwrap(), (3, vec!["unlisted notes.txt".into()]));
        // A figure alone: the list has it from then on.
        let figure = files(&[("figures/fig01.svg", "drawn")]);
        write(folder, &figure, false).unwrap();
        write(folder, &files(&[("figures/fig01.svg", "again")]), false).unwrap();
        fs::remove_file(folder.join("notes.txt")).unwrap();
        assert_eq!(verify(folder).unwrap(), (4, Vec::new()));
        // A page is listed too; in a clone it is absent.
        fs::write(folder.join("report.html"), "edited").unwrap();
        assert_eq!(verify(folder).unwrap().1, ["differs  report.html"]);
        assert!(matches!(write(folder, &new, false), Err(Error::Edited(..))));
        for lost in ["report.html", BUILT] {
            fs::remove_file(folder.join(lost)).unwrap();
            assert_eq!(verify(folder).unwrap(), (3, Vec::new()), "{lost}");
        }
        fs::write(folder.join("report.html"), "by hand").unwrap();
        assert!(matches!(write(folder, &new, false), Err(Error::Edited(..))));
        write(folder, &new, true).unwrap();
        assert_eq!(standing(folder), new);
    }

    #[test]
    fn runs_that_write_one_folder_at_once_wait_for_each_other() {
        let temporary = tempfile::tempdir().unwrap();
        let folder = &temporary.path().join("paper");
        let names: Vec<String> = (0..100).map(|k| format!("figures/fig{k:02}.svg")).collect();
        let pairs: Vec<(&str, &str)> = names.iter().map(|name| (name.as_str(), "drawn")).collect();
        let figures = files(&pairs);
        std::thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    refuse(folder, &Files::new(), false).unwrap();
                    write(folder, &figures, false).unwrap();
                });
            }
        });
        assert_eq!(verify(folder).unwrap(), (100, Vec::new()));
    }

    #[test]
    fn a_list_that_leads_out_is_none_of_a_report() {
        for path in ["foo.tar.gz", "../out.md", "data/../out", ".git/config"] {
            assert_eq!(read_sums(&format!("{}  {path}\n", sha256(""))), None, "{path}");
        }
    }
}
