//! Results of long runs, saved and reused.
//!
//! A saved result has a file of its own, named by experiment and profile. It has three lines of
//! text: a checksum of the other two, what the result was made of, and the result. It is reused if
//! all of that is as it would be made of now; whatever is not whole or not known is run again, and
//! the reason is said.

use super::identity::{Identity, Reason, told};
use super::{Error, Profile, Progress};
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
    fn path(&self, identity: &Identity, profile: Profile) -> Option<PathBuf> {
        let name = format!("{}.json", identity.file_stem(profile));
        self.folder.as_ref().map(|folder| folder.join(name))
    }

    /// The saved result as text, or why there is none to be used.
    pub fn look(&self, identity: &Identity, profile: Profile) -> Result<String, Vec<Reason>> {
        let path = self.path(identity, profile).ok_or_else(|| vec![Reason::Missing])?;
        read(&path, identity)
    }

    /// The saved result of an experiment, or else that of `run`, which is then saved.
    ///
    /// # Errors
    /// What `run` returns; [`Error::NotFinite`] for a result with a number that is not finite;
    /// [`Error::Store`] if it cannot be saved: better before the run than after it.
    pub fn get<T>(
        &self,
        identity: &Identity,
        profile: Profile,
        progress: &Progress,
        run: impl FnOnce() -> Result<T, Error>,
    ) -> Result<T, Error>
    where
        T: Serialize + DeserializeOwned + PartialEq,
    {
        let Some(path) = self.path(identity, profile) else { return run() };
        let name = &identity.experiment;
        let understood =
            |text: String| serde_json::from_str(&text).map_err(|_| vec![Reason::Schema]);
        match read(&path, identity).and_then(understood) {
            Ok(result) => {
                progress.say(&format!("{name}: fresh"));
                return Ok(result);
            }
            Err(reasons) => progress.say(&format!("{name}: run ({})", told(&reasons))),
        }
        self.prepare()?;
        refuse_foreign(&path)?;
        let result = run()?;
        self.put(identity, profile, &result)?;
        Ok(result)
    }

    /// Makes the folder, and tries whether something can be saved there.
    pub fn prepare(&self) -> Result<(), Error> {
        let Some(folder) = &self.folder else { return Ok(()) };
        let tried = std::fs::create_dir_all(folder)
            .and_then(|()| new_beside(&folder.join("result")).map(drop));
        self.tidy();
        tried.map_err(|source| Error::Store { path: folder.clone(), source })
    }

    /// Removes what killed runs left there.
    pub fn tidy(&self) {
        self.folder.iter().for_each(|folder| remove_leftovers(folder, begins_with_digest));
    }

    /// Whether a result can be saved without replacing what was never one.
    pub fn refuse_foreign(&self, identity: &Identity, profile: Profile) -> Result<(), Error> {
        self.path(identity, profile).map_or(Ok(()), |path| refuse_foreign(&path))
    }

    /// Saves a result.
    pub fn put<T>(&self, identity: &Identity, profile: Profile, result: &T) -> Result<(), Error>
    where
        T: Serialize + DeserializeOwned + PartialEq,
    {
        let Some(path) = self.path(identity, profile) else { return Ok(()) };
        refuse_foreign(&path)?;
        let body = written(&identity.experiment, result)?;
        save(&path, identity, &body).map_err(|source| Error::Store { path, source })
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
pub fn written<T>(experiment: &str, result: &T) -> Result<String, Error>
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

/// Writes a temporary file and renames it: at no time is there half a result under the name.
fn save(path: &Path, identity: &Identity, body: &str) -> std::io::Result<()> {
    let identity = serde_json::to_string(identity)?;
    let mut file = new_beside(path)?;
    write!(file.as_file_mut(), "{}\n{identity}\n{body}\n", digest(&[&identity, body]))?;
    file.as_file().sync_all()?;
    file.persist(path)?;
    Ok(())
}

/// SHA-256 of lines, in hexadecimal.
fn digest(lines: &[&str]) -> String {
    sha256(lines.iter().flat_map(|line| [*line, "\n"]).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::super::identity::TOY;
    use super::*;

    fn identity(parameter: f64) -> Identity {
        Identity::new("test", TOY, &parameter)
    }

    #[test]
    fn saved_results_come_back_to_the_bit() {
        let folder = tempfile::tempdir().unwrap();
        let mut normals = impact_numerics::random::NormalPairs::new("test-store", 1, 0);
        let mut result: Vec<_> = (0..500).flat_map(|_| normals.pair()).map(Some).collect();
        result.extend([None, Some(-0.0), Some(f64::MIN_POSITIVE / 4.0), Some(f64::MAX)]);
        let store = Store::open(folder.path()).unwrap();
        let get = |run: &dyn Fn() -> Result<Vec<Option<f64>>, Error>| {
            store.get(&identity(1.5), Profile::Quick, &Progress::silent(), run).unwrap()
        };
        get(&|| Ok(result.clone()));
        let again = get(&|| panic!("it is saved"));
        let bits =
            |v: &[Option<f64>]| -> Vec<_> { v.iter().map(|x| x.map(f64::to_bits)).collect() };
        assert_eq!(bits(&again), bits(&result));
    }

    #[test]
    fn what_is_not_finite_is_not_saved() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        for bad in [f64::NAN, f64::INFINITY] {
            let run = || Ok(vec![Some(bad)]);
            let saved = store.get(&identity(1.0), Profile::Quick, &Progress::silent(), run);
            assert!(matches!(saved, Err(Error::NotFinite { .. })));
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
