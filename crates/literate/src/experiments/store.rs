//! Results of long runs, saved and reused.
//!
//! A saved result has a file of its own, named by experiment and profile, and so has a unit of one that is not yet
//! joined, named by its number too. It has three lines of text: a checksum of the other two, what the result was made of, and the result. It is reused if
//! all of that is as it would be made of now; whatever is not whole or not known is run again, and
//! the reason is said.

use super::Error;
use super::identity::{Identity, Reason};
use crate::digest::sha256;
use crate::input::{new_beside, regular_text, remove_leftovers};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

/// Where results are saved.
#[derive(Clone, Debug)]
pub struct Store {
    folder: Option<PathBuf>,
}

impl Store {
    /// A store in a folder, which is made when something has to be saved.
    pub fn open(folder: &Path) -> Result<Self, Error> {
        match std::fs::metadata(folder) {
            Ok(found) if !found.is_dir() => {
                let source = std::io::Error::from(ErrorKind::NotADirectory);
                Err(Error::Store { path: folder.into(), source })
            }
            Err(source) if source.kind() != ErrorKind::NotFound => {
                Err(Error::Store { path: folder.into(), source })
            }
            _ => Ok(Store { folder: Some(folder.into()) }),
        }
    }

    /// A store that keeps nothing.
    pub fn nowhere() -> Self {
        Store { folder: None }
    }

    /// Where a result is saved.
    fn path(&self, identity: &Identity) -> Option<PathBuf> {
        let name = format!("{}.json", identity.file_stem());
        self.folder.as_ref().map(|folder| folder.join(name))
    }

    /// The saved result, or why there is none to be used.
    pub fn look<T: DeserializeOwned>(&self, identity: &Identity) -> Result<T, Vec<Reason>> {
        let path = self.path(identity).ok_or_else(|| vec![Reason::Missing])?;
        let text = read(&path, identity)?;
        serde_json::from_str(&text).map_err(|_| vec![Reason::Schema])
    }

    /// Makes the folder, and tries whether this result can be saved there without replacing what was never one.
    pub fn prepare(&self, identity: &Identity) -> Result<(), Error> {
        let Some((folder, path)) = self.folder.as_ref().zip(self.path(identity)) else {
            return Ok(());
        };
        let tried = std::fs::create_dir_all(folder).and_then(|()| new_beside(&path).map(drop));
        self.tidy();
        tried.map_err(|source| Error::Store { path: folder.clone(), source })?;
        refuse_foreign(&path)
    }

    /// Removes what killed runs left there.
    pub fn tidy(&self) {
        self.folder.iter().for_each(|folder| remove_leftovers(folder, begins_with_digest));
    }

    /// Saves a result.
    pub fn put<T>(&self, identity: &Identity, result: &T) -> Result<(), Error>
    where
        T: Serialize + DeserializeOwned + PartialEq,
    {
        let Some(path) = self.path(identity) else { return Ok(()) };
        refuse_foreign(&path)?;
        let body = written(&identity.experiment, result)?;
        save(&path, identity, &body).map_err(|source| Error::Store { path, source })
    }

    /// Removes the files of the units of a result, which is joined.
    pub fn remove_units(&self, identity: &Identity) {
        let stem = format!("{}-", identity.file_stem());
        let unit = |path: &PathBuf| {
            let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
            let number = name.strip_prefix(&stem).and_then(|rest| rest.strip_suffix(".json"));
            number.is_some_and(|number| number.bytes().all(|b| b.is_ascii_digit()))
                && begins_with_digest(path).unwrap_or(false)
        };
        let all = self.folder.iter().filter_map(|folder| std::fs::read_dir(folder).ok()).flatten();
        for path in all.flatten().map(|entry| entry.path()).filter(unit) {
            // One that stays is no fault: the joined result is looked for first.
            let _ = std::fs::remove_file(path);
        }
    }
}

/// Reads and checks a file: its result as text, or why it is not to be used.
fn read(path: &Path, identity: &Identity) -> Result<String, Vec<Reason>> {
    let damaged = |what: &str| vec![Reason::Damaged(what.into())];
    let text = match regular_text(path) {
        Ok(text) => text,
        Err(error) if error.kind() == ErrorKind::NotFound => return Err(vec![Reason::Missing]),
        Err(_) if is_foreign(path).unwrap_or(false) => return Err(damaged(FOREIGN)),
        Err(error) => return Err(damaged(&format!("the saved result cannot be read: {error}"))),
    };
    let whole = parsed(&text);
    let (saved, body) = whole.map_err(|why| match is_foreign(path) {
        Ok(true) => damaged(FOREIGN),
        _ => why,
    })?;
    match identity.reasons(&saved) {
        reasons if reasons.is_empty() => Ok(body.into()),
        reasons => Err(reasons),
    }
}

/// Bytes at most of what a result was made of: ours have some thousand.
const IDENTITY: usize = 1 << 20;

/// What a saved result was made of, and the result, as text.
pub fn parsed(text: &str) -> Result<(Identity, &str), Vec<Reason>> {
    let damaged = |what: &str| vec![Reason::Damaged(what.into())];
    let mut lines = text.split('\n');
    let (Some(checksum), Some(found), Some(body), Some(""), None) =
        (lines.next(), lines.next(), lines.next(), lines.next(), lines.next())
    else {
        return Err(damaged("the saved result is cut short or has lines too many"));
    };
    if checksum != digest(&[found, body]) {
        return Err(damaged("the saved result was damaged or edited: its checksum is wrong"));
    }
    if found.len() > IDENTITY {
        return Err(vec![Reason::Schema]);
    }
    let saved = serde_json::from_str(found).map_err(|_| vec![Reason::Schema])?;
    Ok((saved, body))
}

/// A result as text that reads back to the same bits.
///
/// # Errors
/// [`Error::NotFinite`]: JSON has no NaN and no infinity, and serde_json writes null. Reading back
/// tells all such losses.
fn written<T>(experiment: &str, result: &T) -> Result<String, Error>
where
    T: Serialize + DeserializeOwned + PartialEq,
{
    let not_finite = || Error::NotFinite { experiment: experiment.into() };
    let body = serde_json::to_string(result).map_err(|_| not_finite())?;
    match serde_json::from_str::<T>(&body) {
        Ok(read) if read == *result => Ok(body),
        _ => Err(not_finite()),
    }
}

/// What is said of a file that stands where a result belongs.
const FOREIGN: &str = "this is no saved result";

/// Was this never a result, damaged or not? One is a file whose first line is a digest.
fn is_foreign(path: &Path) -> std::io::Result<bool> {
    match std::fs::symlink_metadata(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
        Err(error) => Err(error),
        Ok(found) if !found.is_file() => Ok(true),
        Ok(found) => Ok(found.len() > 0 && !begins_with_digest(path)?),
    }
}

/// Refuses to replace what was never a result.
fn refuse_foreign(path: &Path) -> Result<(), Error> {
    match is_foreign(path) {
        Ok(false) => Ok(()),
        Ok(true) => Err(Error::Foreign { path: path.into() }),
        // Nobody knows whose it is.
        Err(source) => Err(Error::Store { path: path.into(), source }),
    }
}

/// Whether the first line has the form of a digest, but for a few characters: files are cut short, and letters change.
fn begins_with_digest(path: &Path) -> std::io::Result<bool> {
    let mut first = Vec::new();
    std::fs::File::open(path)?.take(65).read_to_end(&mut first)?;
    let Some((digest, end)) = first.split_at_checked(64) else { return Ok(first.is_empty()) };
    let hexadecimal = digest.iter().filter(|b| matches!(b, b'0'..=b'9' | b'a'..=b'f')).count();
    Ok(hexadecimal >= 60 && end.iter().all(|end| matches!(end, b'\n' | b'\r')))
}

/// Writes a temporary file and renames it: at no time is there half a result under the name. A unit that a lost machine
/// had not yet on its disk is found damaged, and run again.
fn save(path: &Path, identity: &Identity, body: &str) -> std::io::Result<()> {
    let made_of = serde_json::to_string(identity)?;
    let mut file = new_beside(path)?;
    write!(file.as_file_mut(), "{}\n{made_of}\n{body}\n", digest(&[&made_of, body]))?;
    if identity.is_whole() {
        file.as_file().sync_all()?;
    }
    file.persist(path)?;
    Ok(())
}

/// SHA-256 of lines, in hexadecimal.
fn digest(lines: &[&str]) -> String {
    sha256(lines.iter().flat_map(|line| [*line, "\n"]).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::super::Profile;
    use super::super::identity::TOY;
    use super::*;

    fn identity() -> Identity {
        Identity::new("test", Profile::Quick, TOY, &1.5)
    }

    #[test]
    fn saved_results_come_back_to_the_bit() {
        let folder = tempfile::tempdir().unwrap();
        let mut normals = impact_numerics::random::NormalPairs::new("test-store", 1, 0);
        let mut result: Vec<_> = (0..500).flat_map(|_| normals.pair()).map(Some).collect();
        result.extend([None, Some(-0.0), Some(f64::MIN_POSITIVE / 4.0), Some(f64::MAX)]);
        let store = Store::open(folder.path()).unwrap();
        store.put(&identity(), &result).unwrap();
        let again: Vec<Option<f64>> = store.look(&identity()).unwrap();
        let bits =
            |v: &[Option<f64>]| -> Vec<_> { v.iter().map(|x| x.map(f64::to_bits)).collect() };
        assert_eq!(bits(&again), bits(&result));
    }

    #[test]
    fn what_is_not_finite_is_not_saved() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        for bad in [f64::NAN, f64::INFINITY] {
            let saved = store.put(&identity(), &vec![Some(bad)]);
            assert!(matches!(saved, Err(Error::NotFinite { .. })));
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
