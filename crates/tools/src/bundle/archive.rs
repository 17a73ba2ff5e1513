//! A ZIP file that appears whole or not at all, with the digest of each file in it.

use impact_paper::digest::sha256;
use impact_paper::input::{new_beside, remove_leftovers};
use impact_paper::program::{Failure, signals};
use impact_paper::report::sums;
use std::collections::BTreeMap;
use std::io::{self, Cursor, Read, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

/// An archive that is being written. The same files give the same bytes: no clock, no owner.
pub struct Archive {
    path: PathBuf,
    /// The folder that all files are in.
    top: String,
    /// In memory: some tens of megabytes, and a disk that fills up is met once, at the end.
    zip: ZipWriter<Cursor<Vec<u8>>>,
    /// Where it will be written.
    file: NamedTempFile,
    /// Digest and size by path.
    files: BTreeMap<String, (String, usize)>,
}

impl Archive {
    /// An empty archive, which will be at `path` once it is complete.
    ///
    /// # Errors
    /// Exit code 2 or 4 if nothing can be written there.
    pub fn at(path: &Path, top: &str) -> Result<Self, Failure> {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new("."));
        // A device would be replaced, and no file.
        if !folder.is_dir() || path.exists() && !path.is_file() {
            let what = "its folder is not there, or it is a folder or device itself";
            return Err(failed(path, io::Error::new(io::ErrorKind::NotADirectory, what)));
        }
        remove_leftovers(folder, is_archive);
        let file = new_beside(path).map_err(|error| failed(path, error))?;
        signals::temporary(file.path());
        let (path, top) = (path.to_path_buf(), top.to_string());
        let zip = ZipWriter::new(Cursor::new(Vec::new()));
        Ok(Archive { path, top, zip, file, files: BTreeMap::new() })
    }

    /// Adds a file.
    ///
    /// # Errors
    /// Exit code 2 or 4 if it cannot be written, 2 if there is one under this path.
    pub fn add(&mut self, path: &str, bytes: &[u8], is_program: bool) -> Result<(), Failure> {
        if self.files.contains_key(path) {
            let what =
                format!("bundle: {path} would be there twice; rename that file of the source");
            return Err(Failure::input(what));
        }
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .last_modified_time(DateTime::default())
            .unix_permissions(if is_program { 0o755 } else { 0o644 });
        self.zip
            .start_file(format!("{}/{path}", self.top), options)
            .map_err(|error| failed(&self.path, error.into()))?;
        self.zip.write_all(bytes).map_err(|error| failed(&self.path, error))?;
        self.files.insert(path.into(), (sha256(bytes), bytes.len()));
        Ok(())
    }

    /// Digest and size of a file.
    pub fn get(&self, path: &str) -> Option<&(String, usize)> {
        self.files.get(path)
    }

    /// Paths of all files, sorted.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        self.files.keys().map(String::as_str)
    }

    /// Adds SHA256SUMS, moves the archive to its place, over a file there only if forced, and returns how many files it has and its
    /// size in bytes.
    ///
    /// # Errors
    /// Exit code 2 or 4 if it cannot be written.
    pub fn finish(mut self, force: bool) -> Result<(usize, u64), Failure> {
        let line = |(path, (digest, _)): (&String, &(String, usize))| format!("{digest}  {path}\n");
        let list: String = self.files.iter().map(line).collect();
        self.add(sums::NAME, list.as_bytes(), false)?;
        let path = self.path;
        let failed = |error: io::Error| failed(&path, error);
        let bytes = self.zip.finish().map_err(|error| failed(error.into()))?.into_inner();
        // Not by the temporary file itself, whose errors have its name.
        let file = self.file;
        let mut disk = file.as_file();
        disk.write_all(&bytes).and_then(|()| disk.sync_all()).map_err(failed)?;
        let placed = if force { file.persist(&path) } else { file.persist_noclobber(&path) };
        placed.map_err(|error| failed(error.error))?;
        Ok((self.files.len(), bytes.len() as u64))
    }
}

/// Is it a ZIP file, or nothing yet?
fn is_archive(path: &Path) -> io::Result<bool> {
    let mut first = Vec::new();
    std::fs::File::open(path)?.take(2).read_to_end(&mut first)?;
    Ok(b"PK".starts_with(&first))
}

fn failed(path: &Path, error: io::Error) -> Failure {
    let path = path.display();
    Failure::io(&error, path, "give an archive that can be written")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_came_meanwhile_stays() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out.zip");
        let [late, forced] = [(); 2].map(|()| Archive::at(&path, "top").unwrap());
        std::fs::write(&path, "theirs").unwrap();
        let failure = late.finish(false).unwrap_err();
        assert!(failure.code == 2 && failure.message.contains("in the way"), "{failure:?}");
        assert_eq!(std::fs::read(&path).unwrap(), b"theirs");
        assert_eq!(forced.finish(true).unwrap().1, path.metadata().unwrap().len());
    }
}
