//! Runs a command in another language as an experiment.
//!
//! It runs in a temporary folder, with copies of the files that it names and nothing else, so that
//! a file which it reads but does not name is missing at once. Links would not do: Python looks for
//! modules where a link leads. [`crate::manual`] has the form of what it reads and prints.

use super::printed::{PrintedTable, tables_by_name};
use super::store::{Identity, Store};
use super::{AnyExperiment, AnyResult, Error, Profile, Session, process, progress};
use crate::input::{self, sha256};
use crate::project::Project;
use crate::table::Table;
use serde::{Deserialize, Serialize};
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;
use std::io;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::Command as Process;
use std::sync::{Arc, Mutex, PoisonError};

/// Hashes of what commands that tell versions printed, by their lines and variables.
static VERSIONS: Mutex<BTreeMap<String, String>> = Mutex::new(BTreeMap::new());

/// A program in any language that is run as an experiment.
#[derive(Clone, Copy, Debug)]
pub struct Command {
    /// Its name, with which the names of its tables begin.
    pub name: &'static str,
    /// The program and its arguments, with blanks between, and quotes as in a shell. A program is
    /// found in `PATH` unless it has a slash. Its bytes identify a result, as do arguments that are
    /// files or folders of the project, alone or behind `=`; they are copied to where it runs.
    pub line: &'static str,
    /// Its parameters in a profile: an object.
    pub parameters: fn(Profile) -> Json,
    /// Files and folders besides those, which are copied to where it runs.
    pub reads: &'static [&'static str],
    /// Files that it writes where it runs, such as pictures; they are saved with its tables.
    pub writes: &'static [&'static str],
    /// Variables of the environment that it gets besides `PATH`, `HOME`, `LANG` and `TMPDIR`; their
    /// values are part of what identifies a saved result.
    pub env: &'static [&'static str],
    /// Commands that print the versions of what it uses, which are part of what identifies a saved
    /// result: `python3 -m pip freeze`. They run in the project.
    pub versions: &'static [&'static str],
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Output {
    tables: BTreeMap<String, PrintedTable>,
    files: BTreeMap<String, Vec<u8>>,
    /// What it wrote to standard error; no table depends on it.
    said: String,
}

impl Command {
    /// Makes a command of this line that has no parameters and reads and writes nothing else.
    pub const fn new(name: &'static str, line: &'static str) -> Self {
        let (parameters, none): (fn(Profile) -> Json, _) = (|_| Json::Null, &[]);
        Command { name, line, parameters, reads: none, writes: none, env: none, versions: none }
    }

    /// Returns what a command wrote to standard error when it last ran, or `None` if it did not.
    pub(crate) fn said(name: &str, profile: Profile, store: &Store) -> Option<String> {
        Some(store.load_last::<Output>(name, profile)?.said)
    }

    fn fault(&self, remedy: String) -> Error {
        Error::input(self.name, format!("`{}`", self.line), remedy)
    }

    /// Lists the files and folders that it names, from the folder `top`.
    fn inputs(&self, top: &Path) -> Result<Vec<String>, String> {
        let mut inputs = Vec::new();
        for (number, word) in words(self.line)?.iter().enumerate() {
            let path = word.split_once('=').map_or(word.as_str(), |(_, path)| path);
            let is_option = path.starts_with('-') || path.contains("://");
            let is_program_of_path = number == 0 && !word.contains('/');
            let is_written = self.writes.contains(&path);
            if is_option || is_program_of_path || is_written || ["", "."].contains(&path) {
                continue;
            }
            if top.join(path).exists() || looks_like_a_file(path) {
                inputs.push(path.to_string());
            }
        }
        inputs.extend(self.reads.iter().map(ToString::to_string));
        for input in &mut inputs {
            *input = input.trim_start_matches("./").trim_end_matches('/').into();
            if input.split('/').any(|part| part == "..") {
                return Err(format!("{input} lies outside the project; copy it into the project"));
            }
            input::list_files(top, input).map_err(|error| {
                format!("{error}; restore it, or list it in `writes` if the command makes it")
            })?;
        }
        Ok(inputs)
    }

    /// Returns name and hash of all on which its result depends, but for its parameters.
    fn hashes(&self, top: &Path) -> Result<BTreeMap<String, String>, String> {
        let mut hashes = BTreeMap::new();
        for input in self.inputs(top)? {
            hashes.extend(input::hash_files(top, &input).map_err(|error| error.to_string())?);
        }
        let program = &words(self.line)?[0];
        if !program.contains('/') {
            let path = in_path(program)?;
            let bytes = std::fs::read(&path).map_err(|e| format!("{}: {e}", path.display()))?;
            hashes.insert(format!("{program} in PATH"), sha256(bytes));
        }
        for name in self.env {
            let hash = std::env::var_os(name).map(|value| sha256(value.as_encoded_bytes()));
            hashes.insert(format!("{name} in the environment"), hash.unwrap_or_default());
        }
        // Held, so that each of them runs once.
        let mut versions = VERSIONS.lock().unwrap_or_else(PoisonError::into_inner);
        for line in self.versions {
            let key = format!("{line} {:?}", self.env);
            if !versions.contains_key(&key) {
                let failed = |problem| format!("`{line}`, which `versions` lists: {problem}");
                let process = self.process(line, top, top);
                let output = process.and_then(|mut it| process::run(&mut it, "".into(), |_| true));
                versions.insert(key.clone(), sha256(output.map_err(failed)?.0));
            }
            hashes.insert(format!("the output of `{line}`"), versions[&key].clone());
        }
        Ok(hashes)
    }

    fn copy_to(&self, folder: &Path, top: &Path) -> io::Result<()> {
        for input in self.inputs(top).map_err(io::Error::other)? {
            if top.join(&input).is_dir() {
                std::fs::create_dir_all(folder.join(&input))?;
            }
            for path in input::list_files(top, &input)? {
                let copy = folder.join(&path);
                // Absolute paths, and those that two inputs have, are already there.
                if !copy.exists() {
                    std::fs::create_dir_all(copy.parent().unwrap_or(folder))?;
                    std::fs::copy(top.join(path), copy)?;
                }
            }
        }
        Ok(())
    }

    /// Prepares a process that runs a line in a folder, with few variables in its environment.
    fn process(&self, line: &str, folder: &Path, top: &Path) -> Result<Process, String> {
        let words = words(line)?;
        let program = match words[0].as_str() {
            name if !name.contains('/') => in_path(name)?,
            // Python in a virtual environment finds its modules by the place of its link.
            link if top.join(link).is_symlink() => top.join(link),
            copied => folder.join(copied),
        };
        let program = std::path::absolute(program).map_err(|error| error.to_string())?;
        let names = ["PATH", "HOME", "LANG", "TMPDIR"].iter().chain(self.env);
        let variables = names.filter_map(|name| Some((name, std::env::var_os(name)?)));
        let mut process = Process::new(program);
        process.args(&words[1..]).current_dir(folder).env_clear().envs(variables);
        Ok(process)
    }

    fn run(&self, top: &Path, session: &Session<'_>) -> Result<Output, String> {
        let folder = folder_in(&std::env::temp_dir())?;
        self.copy_to(folder.path(), top).map_err(|error| error.to_string())?;
        let mut process = self.process(self.line, folder.path(), top)?;
        let parameters = (self.parameters)(session.profile);
        let input = json!({"profile": session.profile, "parameters": parameters});
        let stage = session.progress.stage(self.name, progress::PARTS);
        let on_error_line = |line: &str| {
            let share = progress::share_in(line);
            match share {
                Some(share) => stage.reach(share),
                None => session.progress.say(&format!("{}: {line}", self.name)),
            }
            share.is_none()
        };
        let (printed, errors) = process::run(&mut process, format!("{input}\n"), on_error_line)?;
        let (tables, mut files) = (self.tables_in(&printed)?, BTreeMap::new());
        for path in self.writes {
            let bytes = std::fs::read(folder.path().join(path)).map_err(|error| {
                format!("did not write {path}, which its `writes` lists: {error}")
            })?;
            files.insert(path.to_string(), bytes);
        }
        Ok(Output { tables, files, said: errors })
    }

    pub(super) fn file(&self, result: &AnyResult, path: &str) -> Option<Vec<u8>> {
        result.downcast_ref::<Output>()?.files.get(path).cloned()
    }

    /// Reads the tables that it printed; a command that writes files need not print any.
    fn tables_in(&self, printed: &[u8]) -> Result<BTreeMap<String, PrintedTable>, String> {
        if printed.trim_ascii().is_empty() && !self.writes.is_empty() {
            return Ok(BTreeMap::new());
        }
        let form = "the manual of literate, *A new paper*, has the form";
        let mut reader = serde_json::Deserializer::from_slice(printed);
        let tables = tables_by_name(&mut reader).and_then(|tables| reader.end().map(|()| tables));
        let tables = tables.map_err(|error| {
            if error.is_data() {
                return format!("printed tables that cannot be read: {error}; {form}");
            }
            let printed = String::from_utf8_lossy(printed);
            let first_lines: Vec<&str> = printed.lines().take(5).collect();
            let problem = format!("printed no tables in JSON, which has null for NaN: {error}");
            format!("{problem}; {form}; it printed:\n{}", first_lines.join("\n"))
        })?;
        for (name, table) in &tables {
            if let Some(fault) = table.fault(self.name, name, self.line) {
                return Err(format!("printed {name}: {fault}; {form}"));
            }
        }
        Ok(tables)
    }
}

fn folder_in(temporary: &Path) -> Result<tempfile::TempDir, String> {
    let failed = |error| format!("TMPDIR is {}: {error}; make that folder", temporary.display());
    tempfile::tempdir_in(temporary).map_err(failed)
}

/// Splits a line into words as a shell does, of which there is at least one.
fn words(line: &str) -> Result<Vec<String>, String> {
    match shell_words::split(line) {
        Ok(words) if words.is_empty() => Err("there is no program; name one".into()),
        words => words.map_err(|error| format!("{error}; close it")),
    }
}

fn in_path(name: &str) -> Result<PathBuf, String> {
    let is_program = |path: &PathBuf| {
        path.metadata().is_ok_and(|file| file.is_file() && file.permissions().mode() & 0o111 != 0)
    };
    let folders = std::env::var_os("PATH").unwrap_or_default();
    let program = std::env::split_paths(&folders).map(|folder| folder.join(name)).find(is_program);
    program.ok_or_else(|| format!("PATH has no {name}; install it, or correct the command"))
}

/// Returns whether a word looks like the name of a file: it has a slash, or an ending of letters.
fn looks_like_a_file(word: &str) -> bool {
    let Some((name, ending)) = word.rsplit_once('.') else { return word.contains('/') };
    let is_ending = ending.starts_with(char::is_alphabetic)
        && ending.len() < 6
        && ending.chars().all(char::is_alphanumeric);
    word.contains('/') || is_ending && !name.is_empty() && word.parse::<f64>().is_err()
}

impl AnyExperiment for Command {
    fn name(&self) -> &'static str {
        self.name
    }

    fn check_files(&self, project: &Project) -> Result<(), Error> {
        self.inputs(&project.folder()).map(drop).map_err(|problem| self.fault(problem))
    }

    fn made_of(&self, session: &Session<'_>) -> Result<BTreeMap<String, String>, Error> {
        let hashes = self.hashes(&session.project.folder());
        session.progress.check()?;
        hashes.map_err(|problem| self.fault(problem))
    }

    fn parameters(&self, profile: Profile) -> Result<Json, Error> {
        let mut json = json!({"command": self.line, "parameters": (self.parameters)(profile)});
        if !self.writes.is_empty() {
            json["writes"] = json!(self.writes);
        }
        Ok(json)
    }

    fn item(&self) -> String {
        self.line.into()
    }

    fn load_saved(&self, identity: &Identity, session: &Session<'_>) -> Result<AnyResult, String> {
        Ok(Arc::new(session.store.load::<Output>(identity)?))
    }

    fn read_or_run(&self, identity: &Identity, session: &Session<'_>) -> Result<AnyResult, Error> {
        let unchanged = || match identity.differences(&self.identity(session)?).as_str() {
            "" => Ok(()),
            problem => Err(self.fault(format!("{problem} since this run began; run it again"))),
        };
        unchanged()?;
        let output = self.run(&session.project.folder(), session);
        session.progress.check()?;
        let failed = |problem| io::Error::other(format!("`{}`: {problem}", self.line));
        let output = output.map_err(|problem| Error::failed(self.name, failed(problem)))?;
        unchanged()?;
        session.store.save(identity, &output)?;
        Ok(Arc::new(output))
    }

    fn tables(&self, result: &AnyResult) -> Vec<Table> {
        let Some(output) = result.downcast_ref::<Output>() else { return Vec::new() };
        let tables = output.tables.iter();
        tables.map(|(name, table)| table.table(self.name, name, self.line)).collect()
    }
}

#[cfg(test)]
mod tests;
