//! Results of long runs, saved and reused.
//!
//! A saved result is found by its key: the SHA-256 of the experiment's name, its parameters and
//! the fingerprint of the simulating code. The file has three lines of text: a checksum of the
//! other two, what the key is made of, and the result. Whatever is not whole is run again.

use super::{Error, Progress};
use serde::Serialize;
use serde::de::DeserializeOwned;
use sha2::{Digest, Sha256};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Fingerprint of the code that simulates (see `build/fingerprint.rs`).
pub const CODE: &str = env!("CODE_FINGERPRINT");

/// Where results are saved.
#[derive(Clone, Debug)]
pub struct Store {
    folder: Option<PathBuf>,
}

impl Store {
    /// A store in a folder, which is made if it is missing.
    ///
    /// # Errors
    /// [`Error::Store`] if the folder cannot be made or written: better now than after the run.
    pub fn open(folder: &Path) -> Result<Self, Error> {
        let failed = |source| Error::Store { path: folder.into(), source };
        std::fs::create_dir_all(folder).map_err(failed)?;
        tempfile::NamedTempFile::new_in(folder).map_err(failed)?;
        Ok(Store { folder: Some(folder.into()) })
    }

    /// A store that keeps nothing.
    pub fn nowhere() -> Self {
        Store { folder: None }
    }

    /// The saved result of an experiment, or else that of `run`, which is then saved.
    ///
    /// # Errors
    /// What `run` returns; [`Error::NotFinite`] for a result with a number that is not finite;
    /// [`Error::Store`] if it cannot be saved.
    pub fn get<P, T>(
        &self,
        experiment: &'static str,
        parameters: &P,
        progress: &Progress,
        run: impl FnOnce() -> Result<T, Error>,
    ) -> Result<T, Error>
    where
        P: Serialize,
        T: Serialize + DeserializeOwned + PartialEq,
    {
        let Some(folder) = &self.folder else { return run() };
        let identity = serde_json::json!({
            "experiment": experiment, "code": CODE, "parameters": parameters,
        })
        .to_string();
        let path = folder.join(format!("{experiment}-{}.json", &digest(&[&identity])[..16]));
        match load(&path, &identity) {
            Ok(Some(result)) => return Ok(result),
            Ok(None) => (),
            Err(problem) => {
                progress.say(&format!("{}: {problem}; running it again", path.display()));
            }
        }
        let result = run()?;
        save(&path, &identity, experiment, &result)?;
        Ok(result)
    }
}

/// Reads and checks a file. None if there is none; an error says why it is not to be trusted.
fn load<T: DeserializeOwned>(path: &Path, identity: &str) -> Result<Option<T>, String> {
    let text = match std::fs::read_to_string(path) {
        Ok(text) => text,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(format!("cannot be read ({error})")),
    };
    let mut lines = text.split('\n');
    let (Some(checksum), Some(found), Some(body), Some(""), None) =
        (lines.next(), lines.next(), lines.next(), lines.next(), lines.next())
    else {
        return Err("the saved result is cut short or has lines too many".into());
    };
    if checksum != digest(&[found, body]) {
        return Err("the saved result was damaged or edited: its checksum is wrong".into());
    }
    if found != identity {
        return Err("the saved result belongs to other parameters".into());
    }
    serde_json::from_str(body).map(Some).map_err(|error| format!("cannot be understood ({error})"))
}

/// Writes a temporary file and renames it: at no time is there half a result under the name.
fn save<T>(path: &Path, identity: &str, experiment: &'static str, result: &T) -> Result<(), Error>
where
    T: Serialize + DeserializeOwned + PartialEq,
{
    // JSON has no NaN and no infinity: serde_json writes null. Reading back tells all such losses.
    let not_finite = || Error::NotFinite { experiment };
    let body = serde_json::to_string(result).map_err(|_| not_finite())?;
    match serde_json::from_str::<T>(&body) {
        Ok(read) if read == *result => (),
        _ => return Err(not_finite()),
    }
    let failed = |source| Error::Store { path: path.into(), source };
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut file = tempfile::NamedTempFile::new_in(folder).map_err(failed)?;
    write!(file, "{}\n{identity}\n{body}\n", digest(&[identity, &body])).map_err(failed)?;
    file.as_file().sync_all().map_err(failed)?;
    file.persist(path).map_err(|error| failed(error.error))?;
    Ok(())
}

/// SHA-256 of lines, in hexadecimal.
fn digest(lines: &[&str]) -> String {
    let mut hash = Sha256::new();
    for line in lines {
        hash.update(line.as_bytes());
        hash.update(b"\n");
    }
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    /// Asks for the result of an experiment and says whether it was run.
    fn ask(folder: &Path, parameter: f64, result: &[Option<f64>]) -> (Vec<Option<f64>>, bool) {
        let ran = Cell::new(false);
        let found = Store::open(folder)
            .unwrap()
            .get("test", &parameter, &Progress::silent(), || {
                ran.set(true);
                Ok(result.to_vec())
            })
            .unwrap();
        (found, ran.get())
    }

    fn only_file(folder: &Path) -> PathBuf {
        let files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|f| f.unwrap().path()).collect();
        assert_eq!(files.len(), 1, "{files:?}");
        files[0].clone()
    }

    #[test]
    fn saved_results_come_back_to_the_bit() {
        let folder = tempfile::tempdir().unwrap();
        let mut normals = crate::numerics::random::NormalPairs::new("test-store", 1, 0);
        let mut result: Vec<_> = (0..500).flat_map(|_| normals.pair()).map(Some).collect();
        result.extend([None, Some(-0.0), Some(f64::MIN_POSITIVE / 4.0), Some(f64::MAX)]);
        let first = ask(folder.path(), 1.5, &result);
        assert!(first.1);
        let (again, ran) = ask(folder.path(), 1.5, &[]);
        assert!(!ran);
        let bits =
            |v: &[Option<f64>]| -> Vec<_> { v.iter().map(|x| x.map(f64::to_bits)).collect() };
        assert_eq!(bits(&again), bits(&result));
    }

    #[test]
    fn other_parameters_are_another_result() {
        let folder = tempfile::tempdir().unwrap();
        assert!(ask(folder.path(), 1.0, &[Some(1.0)]).1);
        assert_eq!(ask(folder.path(), 2.0, &[Some(2.0)]), (vec![Some(2.0)], true));
        assert_eq!(ask(folder.path(), 1.0, &[]), (vec![Some(1.0)], false));
    }

    #[test]
    fn damaged_edited_and_truncated_files_are_run_again() {
        let folder = tempfile::tempdir().unwrap();
        let whole = vec![Some(0.125), Some(7.0)];
        ask(folder.path(), 1.0, &whole);
        let path = only_file(folder.path());
        let text = std::fs::read_to_string(&path).unwrap();
        let broken = [
            text.replace("0.125", "0.126"),
            text[..text.len() / 2].to_string(),
            text[..text.len() - 1].to_string(),
            String::new(),
            text.replacen("parameters\":1.0", "parameters\":3.0", 1),
            format!("{text}more\n"),
        ];
        for broken in broken {
            assert_ne!(broken, text);
            std::fs::write(&path, &broken).unwrap();
            assert_eq!(ask(folder.path(), 1.0, &whole), (whole.clone(), true), "{broken}");
            assert_eq!(std::fs::read_to_string(&path).unwrap(), text, "saved anew");
        }
        std::fs::write(&path, [0xff, 0xfe]).unwrap();
        assert!(ask(folder.path(), 1.0, &whole).1);
    }

    #[test]
    fn what_is_not_finite_is_not_saved() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        for bad in [f64::NAN, f64::INFINITY] {
            let saved = store.get("test", &1, &Progress::silent(), || Ok(vec![Some(bad)]));
            assert!(matches!(saved, Err(Error::NotFinite { experiment: "test" })));
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn an_interrupted_run_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let run = || Err::<f64, _>(Error::Interrupted);
        assert!(store.get("test", &1, &Progress::silent(), run).is_err());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_folder_that_cannot_be_is_an_error() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let error = Store::open(&file.path().join("below")).unwrap_err().to_string();
        assert!(error.contains("--results"), "{error}");
    }
}
