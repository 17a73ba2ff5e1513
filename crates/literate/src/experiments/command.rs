//! Runs a command in another language as an experiment.
//!
//! It runs in a temporary folder, with copies of the files that it names and nothing else, so that
//! a file which it reads but does not name is missing at once. Links would not do: Python looks for
//! modules where a link leads. [`crate::manual`] has the form of what it reads and prints.

use super::printed::{PrintedTable, tables_by_name};
use super::store::{Identity, Store};
use super::{AnyExperiment, Error, Found, Profile, Session, process};
use crate::input;
use crate::project::Project;
use crate::table::Table;
use serde::{Deserialize, Serialize};
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[derive(Clone, Copy, Debug)]
pub struct Command {
    pub name: &'static str,
    /// The program and its arguments, with blanks between. A program is found in `PATH` unless it
    /// has a slash. Arguments that are files or folders of the project, alone or behind `=`, are
    /// copied to where the command runs, and are part of what identifies a saved result.
    pub line: &'static str,
    /// Its parameters in a profile: an object.
    pub parameters: fn(Profile) -> Json,
    pub reads: &'static [&'static str],
    /// Files that it writes where it runs, such as pictures; they are saved with its tables.
    pub writes: &'static [&'static str],
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Output {
    tables: BTreeMap<String, PrintedTable>,
    files: BTreeMap<String, Vec<u8>>,
}

impl Command {
    pub const fn new(name: &'static str, line: &'static str) -> Self {
        Command { name, line, parameters: |_| Json::Null, reads: &[], writes: &[] }
    }

    /// Lists the files and folders that it names, from the folder `top`.
    fn inputs(&self, top: &Path) -> Result<Vec<&'static str>, String> {
        let mut inputs = Vec::new();
        for (at, word) in self.line.split_whitespace().enumerate() {
            let value = word.split_once('=').map_or(word, |(_, value)| value);
            let is_option = value.starts_with('-') || value.contains("://");
            let is_program_of_path = at == 0 && !word.contains('/');
            let is_written = self.writes.contains(&value);
            if is_option || is_program_of_path || is_written || ["", "."].contains(&value) {
                continue;
            }
            if top.join(value).exists() || looks_like_a_file(value) {
                inputs.push(value);
            }
        }
        inputs.extend(self.reads);
        for input in &mut inputs {
            *input = input.trim_start_matches("./").trim_end_matches('/');
            if input.split('/').any(|part| part == "..") {
                return Err(format!("{input} lies outside the project; copy it into the project"));
            }
            input::files_in(top, input).map_err(|error| {
                format!("{error}; restore it, or list it in `writes` if the command makes it")
            })?;
        }
        Ok(inputs)
    }

    fn hashes(&self, top: &Path) -> BTreeMap<String, String> {
        let inputs = self.inputs(top).unwrap_or_default().into_iter();
        inputs.filter_map(|input| input::hashes(top, input).ok()).flatten().collect()
    }

    /// Copies its inputs into a folder, and returns the path of the program.
    fn prepare(&self, top: &Path, folder: &Path) -> io::Result<PathBuf> {
        for input in self.inputs(top).map_err(io::Error::other)? {
            if top.join(input).is_dir() {
                std::fs::create_dir_all(folder.join(input))?;
            }
            for path in input::files_in(top, input)? {
                let copy = folder.join(&path);
                // Absolute paths, and those that two inputs have, are already there.
                if !copy.exists() {
                    std::fs::create_dir_all(copy.parent().unwrap_or(folder))?;
                    std::fs::copy(top.join(path), copy)?;
                }
            }
        }
        let program = self.line.split_whitespace().next().unwrap_or_default();
        if !program.contains('/') {
            return Ok(program.into());
        }
        // Python in a virtual environment finds its modules by the place of its link.
        let is_link = top.join(program).is_symlink();
        if is_link { std::path::absolute(top.join(program)) } else { Ok(folder.join(program)) }
    }

    fn run(&self, top: &Path, session: &Session<'_>) -> Result<Output, Error> {
        let fail = |what: String| {
            let source = format!("`{}` {what}", self.line).into();
            Error::Failed { experiment: self.name, source }
        };
        let cannot = |error: io::Error| {
            fail(format!("cannot be started: {error}; install it, or correct the command"))
        };
        let _stage = session.progress.stage(self.name, 1);
        let folder = tempfile::tempdir().map_err(cannot)?;
        let program = self.prepare(top, folder.path()).map_err(cannot)?;
        let mut command = std::process::Command::new(program);
        command.args(self.line.split_whitespace().skip(1)).current_dir(folder.path());
        let parameters = (self.parameters)(session.profile);
        let given = json!({"profile": session.profile, "parameters": parameters});
        let output = process::run(&mut command, format!("{given}\n")).map_err(cannot)?;
        session.progress.check()?;
        if !output.status.success() {
            let said = String::from_utf8_lossy(&output.stderr);
            let said = if said.trim().is_empty() { "nothing" } else { said.trim_end() };
            return Err(fail(format!("ended with {}; it said:\n{said}", output.status)));
        }
        let tables = self.tables_in(&output.stdout).map_err(fail)?;
        let mut files = BTreeMap::new();
        for path in self.writes {
            let bytes = std::fs::read(folder.path().join(path)).map_err(|error| {
                fail(format!("did not write {path}, which its `writes` lists: {error}"))
            })?;
            files.insert(path.to_string(), bytes);
        }
        Ok(Output { tables, files })
    }

    pub(super) fn file(&self, found: &Found, path: &str) -> Option<Vec<u8>> {
        found.downcast_ref::<Output>()?.files.get(path).cloned()
    }

    /// Reads the tables that it printed; a command that writes files need not print any.
    fn tables_in(&self, printed: &[u8]) -> Result<BTreeMap<String, PrintedTable>, String> {
        if printed.trim_ascii().is_empty() && !self.writes.is_empty() {
            return Ok(BTreeMap::new());
        }
        let form = "the manual of literate, *A new paper*, has the form";
        let mut reader = serde_json::Deserializer::from_slice(printed);
        let tables = tables_by_name(&mut reader).and_then(|found| reader.end().map(|()| found));
        let tables = tables.map_err(|error| {
            let printed = String::from_utf8_lossy(printed);
            let first: Vec<&str> = printed.lines().take(5).collect();
            let problem = format!("printed no tables in JSON, which has null for NaN: {error}");
            format!("{problem}; {form}; it printed:\n{}", first.join("\n"))
        })?;
        for (name, table) in &tables {
            if let Some(fault) = table.fault(self.name, name, self.line) {
                return Err(format!("printed {name}: {fault}; {form}"));
            }
        }
        Ok(tables)
    }
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

    fn check(&self, project: &Project) -> Result<(), Error> {
        let error = |what: String| Error::input(self.name, format!("`{}`", self.line), what);
        self.inputs(&project.folder()).map(drop).map_err(error)
    }

    fn made_of(&self, session: &Session<'_>) -> Result<BTreeMap<String, String>, Error> {
        Ok(self.hashes(&session.project.folder()))
    }

    fn parameters(&self, profile: Profile) -> Result<Json, Error> {
        let mut all = json!({"command": self.line, "parameters": (self.parameters)(profile)});
        if !self.writes.is_empty() {
            all["writes"] = json!(self.writes);
        }
        Ok(all)
    }

    fn item(&self) -> String {
        self.line.into()
    }

    fn saved(&self, identity: &Identity, store: &Store) -> Result<Found, String> {
        Ok(Arc::new(store.look::<Output>(identity)?))
    }

    fn found(&self, identity: &Identity, session: &Session<'_>) -> Result<Found, Error> {
        let output = self.run(&session.project.folder(), session)?;
        session.store.put(identity, &output)?;
        Ok(Arc::new(output))
    }

    fn tables(&self, found: &Found) -> Vec<Table> {
        let Some(output) = found.downcast_ref::<Output>() else { return Vec::new() };
        let tables = output.tables.iter();
        tables.map(|(name, table)| table.table(self.name, name, self.line)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Progress, Results, Store};
    use super::*;

    const SCRIPT: &str = r#"read given
case $given in *quick*) n=100 ;; *) n=1000 ;; esac
echo '{"throws": {"keys": ["needles"], "columns": ["pi", "pi_error", "by", "seed", "ratio"],'
echo '"digits": {"ratio": 3}, "units": {"pi": "m"}, "meanings": {"ratio": "of areas"}, "rows": '
echo "[[$n, 3.125, 0.04, \"sh\", 7, 0.12345], [2, null, 0.1, null, null, null]]}}"
"#;

    /// Runs a command in the project of a folder, with a script in its file `toy.sh`.
    fn run(top: &Path, script: &str, command: Command) -> Result<Output, Error> {
        std::fs::write(top.join("toy.sh"), script).unwrap();
        command.run(top, &Session::toy(Store::nowhere(), Progress::silent()))
    }

    #[test]
    fn its_tables_are_those_of_any_experiment() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("toy.sh");
        let session = Session::toy(Store::open(&folder.path().join("saved")), Progress::silent());
        let line = Box::leak(format!("sh {}", path.display()).into_boxed_str());
        let command: &'static Command = Box::leak(Box::new(Command::new("toy", line)));
        std::fs::write(&path, SCRIPT).unwrap();
        let results = Results::run(&[command], &[], &session).unwrap();
        assert_eq!(results.number("toy.throws[needles=100].pi").unwrap(), 3.125);
        let throws = results.table("toy.throws").unwrap();
        for (column, shown, unit, meaning) in [
            ("pi", "3.12(4)", "$m$", ""),
            ("by", "sh", "", ""),
            ("seed", "7", "", ""),
            ("ratio", "0.123", "", "of areas"),
        ] {
            let cell = throws.at(&format!("toy.throws[needles=100].{column}")).unwrap();
            let found = (cell.plain(), cell.unit.as_str(), cell.note.as_str());
            assert_eq!(found, (shown.into(), unit, meaning));
            let cell = throws.at(&format!("toy.throws[needles=2].{column}")).unwrap();
            assert_eq!(cell.plain(), "–");
        }
        assert!(throws.at("toy.throws[needles=100].pi_error").is_none());
        // The result depends on the bytes of the script, which need not be text.
        assert_eq!(command.stale(&session).unwrap(), None);
        std::fs::write(&path, [SCRIPT.as_bytes(), b"# \xff"].concat()).unwrap();
        assert!(command.stale(&session).unwrap().unwrap().contains("toy.sh changed"));
    }

    #[test]
    fn it_sees_the_files_that_it_names_and_no_others() {
        let folder = tempfile::tempdir().unwrap();
        let top = folder.path();
        std::fs::create_dir_all(top.join("data/deep")).unwrap();
        for file in ["data/deep/a.bin", "b.csv", "c.csv", "hidden.csv"] {
            std::fs::write(top.join(file), [0xff, 0]).unwrap();
        }
        let command = Command::new("toy", "sh toy.sh data/ --table=./b.csv 0.5 -x n=3");
        let command = Command { reads: &["c.csv"], writes: &["plot.png"], ..command };
        let script =
            "touch plot.png; find . -type f | sort | tr -d '\\n' > plot.png; rm data/deep/a.bin";
        let output: Found = Arc::new(run(top, script, command).unwrap());
        let written = String::from_utf8(command.file(&output, "plot.png").unwrap()).unwrap();
        assert_eq!(written, "./b.csv./c.csv./data/deep/a.bin./plot.png./toy.sh");
        let before = command.hashes(top);
        assert_eq!(before.len(), 4, "{before:?}");
        std::fs::write(top.join("data/deep/a.bin"), [0xfe, 0]).unwrap();
        assert_ne!(command.hashes(top), before);
    }

    #[test]
    fn a_file_that_is_missing_is_refused_before_it_runs() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a.py"), "").unwrap();
        for (line, fault) in [
            ("python3 a.py table.npz", "table.npz: No such file"),
            ("python3 a.py --in=data/x", "data/x: No such file"),
            ("./prog a.py", "prog: No such file"),
            ("python3 a.py ../b.csv", "../b.csv lies outside"),
            ("true", "x: No such file"),
        ] {
            let command = Command { reads: &["x"], ..Command::new("toy", line) };
            let error = command.inputs(folder.path()).unwrap_err();
            assert!(error.starts_with(fault), "{line}: {error}");
        }
    }

    #[test]
    fn what_goes_wrong_is_shown() {
        let folder = tempfile::tempdir().unwrap();
        let table = |fields: &str| format!("echo '{{\"a\": {{\"columns\": [\"b\"], {fields}}}}}'");
        let fields = "\"columns\": [], \"rows\": []";
        for (script, shown) in [
            ("echo a >&2; echo b >&2; exit 3", "exit status: 3; it said:\na\nb"),
            ("echo Hello; echo '{}]'", "it printed:\nHello\n{}]"),
            (&table("\"rows\": [[1, 2]]"), "a: row 1 has 2 cells for 1 names"),
            (&table("\"rows\": [[[]]]"), "row 1 has more than a number"),
            (&table("\"rows\": [[1], [2]]"), "printed a: two rows have the keys []; add a key"),
            (&table("\"rows\": [], \"units\": {\"B\": \"m\"}"), "units: there is no column B;"),
            (&format!("echo '{{\"a\": {{{fields}}}, \"a\": {{{fields}}}}}'"), "two tables a"),
            ("", "did not write a.png"),
        ] {
            let command = Command { writes: &["a.png"], ..Command::new("toy", "sh toy.sh") };
            let error = run(folder.path(), script, command).unwrap_err().to_string();
            assert!(error.contains(shown), "{error}");
        }
        let error = run(folder.path(), "", Command::new("toy", "no-such-program")).unwrap_err();
        assert!(error.to_string().contains("cannot be started: "), "{error}");
    }
}
