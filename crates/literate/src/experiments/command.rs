//! An experiment that is a command in another language.
//!
//! It is started in the folder of the project. The manual ([`crate::manual`]) has the form of what
//! it reads and prints.

use super::store::Identity;
use super::{AnyExperiment, Error, Found, Profile, Session};
use crate::input::sha256;
use crate::project::Project;
use crate::table::Table;
use crate::value::Origin;
use impact_numerics::estimates::with_error;
use serde::{Deserialize, Serialize};
use serde_json::{Value as Json, json};
use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;
use std::process::Stdio;
use std::sync::Arc;

/// A command as an experiment.
#[derive(Clone, Copy, Debug)]
pub struct Command {
    pub name: &'static str,
    /// The program and its arguments, with blanks between. Those that are files belong to what a
    /// saved result is known by.
    pub line: &'static str,
    /// Its parameters in a profile: an object.
    pub parameters: fn(Profile) -> Json,
}

/// The tables that a command printed, by name.
type Printed = BTreeMap<String, Rows>;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Rows {
    #[serde(default)]
    keys: Vec<String>,
    columns: Vec<String>,
    #[serde(default)]
    units: BTreeMap<String, String>,
    rows: Vec<Vec<Json>>,
}

impl Rows {
    fn names(&self) -> impl Iterator<Item = &String> {
        self.keys.iter().chain(&self.columns)
    }

    fn fault(&self) -> Option<String> {
        let names = self.names().count();
        let mut seen = BTreeSet::new();
        self.rows.iter().zip(1..).find_map(|(row, at)| {
            if row.len() != names {
                return Some(format!("row {at} has {} cells for {names} names", row.len()));
            }
            let called = |key: &Json| key.as_f64().map_or(key.to_string(), |x| x.to_string());
            let keys: Vec<String> = row[..self.keys.len()].iter().map(called).collect();
            (!seen.insert(keys)).then(|| format!("row {at} has the keys of one before"))
        })
    }

    fn table(&self, name: &str, command: &Command) -> Table {
        let number = |at: usize| move |row: &Vec<Json>| row[at].as_f64();
        let words = |at: usize| {
            move |row: &Vec<Json>| row[at].as_str().map_or(row[at].to_string(), String::from)
        };
        let place = |name: String| self.names().position(|own| *own == name);
        let name = leaked(&format!("{}.{name}", command.name));
        let mut table = Table::of(name, &self.rows, |_| 0).computed_by(Origin::of(command.line));
        for (at, name) in self.names().enumerate() {
            let unit = self.units.get(name).map_or("1", |unit| leaked(unit));
            let is_words = self.rows.iter().any(|row| row[at].is_string());
            let name = leaked(name);
            table = match place(format!("{name}_error")) {
                _ if name.strip_suffix("_error").is_some_and(|of| place(of.into()).is_some()) => {
                    table
                }
                _ if is_words && at < self.keys.len() => table.text_key(name, words(at)),
                _ if is_words => table.words(name, "", words(at)),
                _ if at < self.keys.len() => {
                    table.key(name, unit, move |row| number(at)(row).unwrap_or(f64::NAN))
                }
                Some(error) => table.estimate(name, unit, "", move |row| {
                    Some(with_error(number(at)(row)?, number(error)(row)?))
                }),
                None => table.chosen(name, unit, "", number(at)),
            };
        }
        table.done()
    }
}

/// Names of tables live as long as the program.
fn leaked(text: &str) -> &'static str {
    Box::leak(text.to_string().into_boxed_str())
}

impl Command {
    /// A command without parameters.
    pub const fn new(name: &'static str, line: &'static str) -> Self {
        Command { name, line, parameters: |_| Json::Null }
    }

    fn identity(&self, session: &Session<'_>) -> Identity {
        let code = self.code(session.project);
        let parameters = AnyExperiment::parameters(self, session.profile);
        Identity::new(self.name, session.profile, code, &parameters)
    }

    /// Runs it. Ctrl-C in a terminal ends it too.
    fn run(&self, session: &Session<'_>) -> Result<Printed, Error> {
        let fail = |what: String| {
            let source = format!("`{}` {what}", self.line).into();
            Error::Failed { experiment: self.name, source }
        };
        let _stage = session.progress.stage(self.name, 1);
        let mut words = self.line.split_whitespace();
        let mut command = std::process::Command::new(words.next().unwrap_or_default());
        command.args(words).current_dir(session.project.folder());
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let missing =
            |error| fail(format!("cannot be started: {error}; install it, or mend the command"));
        let mut child = command.spawn().map_err(missing)?;
        let parameters = (self.parameters)(session.profile);
        if let Some(mut input) = child.stdin.take() {
            let given = json!({"profile": session.profile, "parameters": parameters});
            // A command that reads nothing has closed it.
            let _ = writeln!(input, "{given}");
        }
        let output = child.wait_with_output().map_err(|error| fail(error.to_string()))?;
        session.progress.check()?;
        if !output.status.success() {
            let told = String::from_utf8_lossy(&output.stderr);
            let last = told.lines().last().unwrap_or("it said nothing");
            return Err(fail(format!("ended with {}: {last}", output.status)));
        }
        let wrong = |what| {
            let form = "the manual of literate, *A new paper*, has the form";
            fail(format!("printed {what}; {form}"))
        };
        let no_json = |error| wrong(format!("no tables in JSON, which has null for NaN: {error}"));
        let printed: Printed = serde_json::from_slice(&output.stdout).map_err(no_json)?;
        let fault = |(name, rows): (&String, &Rows)| Some(format!("{name}: {}", rows.fault()?));
        printed.iter().find_map(fault).map_or(Ok(()), |fault| Err(wrong(fault)))?;
        Ok(printed)
    }
}

impl AnyExperiment for Command {
    fn name(&self) -> &'static str {
        self.name
    }

    fn code(&self, project: &Project) -> BTreeMap<String, String> {
        let top = project.folder();
        let hash = |file: &str| Some(sha256(std::fs::read_to_string(top.join(file)).ok()?));
        let files = self.line.split_whitespace();
        files.filter_map(|file| Some((file.to_string(), hash(file)?))).collect()
    }

    fn parameters(&self, profile: Profile) -> Json {
        json!({"command": self.line, "parameters": (self.parameters)(profile)})
    }

    fn item(&self) -> String {
        self.line.into()
    }

    fn stale(&self, session: &Session<'_>) -> Option<String> {
        let why = session.store.look::<Printed>(&self.identity(session)).err()?;
        Some(format!("{}: {why}", self.name))
    }

    fn found(&self, session: &Session<'_>) -> Result<Found, Error> {
        Ok(Arc::new(session.saved(&self.identity(session), || self.run(session))?))
    }

    fn tables(&self, found: &Found) -> Vec<Table> {
        let printed = found.downcast_ref::<Printed>().into_iter().flatten();
        printed.map(|(name, rows)| rows.table(name, self)).collect()
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::super::{Progress, Results, Store};
    use super::*;
    use crate::prose::Templates;
    use crate::source::toy;
    use std::path::Path;

    const SCRIPT: &str = r#"read given
case $given in *quick*) n=100 ;; *) n=1000 ;; esac
echo '{"throws": {"keys": ["needles"], "columns": ["pi", "pi_error", "by", "seed"], "rows": '
echo "[[$n, 3.125, 0.04, \"sh\", 7], [2, null, 0.1, \"sh\", null]]}}"
"#;

    fn with<T>(
        script: &str,
        look: impl Fn(&dyn Fn(&str) -> Result<Results, Error>, &Path) -> T,
    ) -> T {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("toy.sh");
        std::fs::write(&path, script).unwrap();
        let store = Store::open(&folder.path().join("results"));
        let run = |program: &str| {
            let line = leaked(&format!("{program} {}", path.display()));
            let project = Project::new(toy());
            let command: &'static Command = Box::leak(Box::new(Command::new("toy", line)));
            let (templates, progress) = (Templates::of([]), Progress::silent());
            let (profile, store) = (Profile::Quick, store.clone());
            let session = Session { project: &project, templates, profile, store, progress };
            let found = Results::run(&[command], &[], &session);
            assert_eq!(found.is_ok(), command.stale(&session).is_none());
            found
        };
        look(&run, &path)
    }

    #[test]
    fn its_tables_are_those_of_any_experiment() {
        with(SCRIPT, |run, path| {
            let results = run("sh").unwrap();
            assert_eq!(results.number("toy.throws[needles=100].pi").unwrap(), 3.125);
            let throws = results.table("toy.throws").unwrap();
            let shown = |address: &str| throws.at(address).unwrap().plain();
            assert_eq!(shown("toy.throws[needles=100].pi"), "3.12(4)");
            assert_eq!(shown("toy.throws[needles=100].by"), "sh");
            assert_eq!(shown("toy.throws[needles=100].seed"), "7");
            assert_eq!(shown("toy.throws[needles=2].pi"), "none");
            assert!(throws.at("toy.throws[needles=100].pi_error").is_none());
            // The script is part of what a result is known by.
            std::fs::write(path, SCRIPT.replace("3.125", "3.25")).unwrap();
            let results = run("sh").unwrap();
            assert_eq!(results.number("toy.throws[needles=100].pi").unwrap(), 3.25);
        });
    }

    #[test]
    fn what_goes_wrong_is_told_in_one_line() {
        for (script, program, told) in [
            (
                "echo a >&2; echo no needle >&2; exit 3",
                "sh",
                "ended with exit status: 3: no needle",
            ),
            ("echo '{\"a\": NaN}'", "sh", "printed no tables in JSON"),
            (
                "echo '{\"a\": {\"columns\": [\"b\"], \"rows\": [[1, 2]]}}'",
                "sh",
                "row 1 has 2 cells",
            ),
            ("", "no-such-program", "cannot be started: "),
        ] {
            let error = with(script, |run, _| run(program).unwrap_err().to_string());
            assert!(
                error.starts_with(&format!("toy: `{program} ")) && error.contains(told),
                "{error}"
            );
            assert!(!error.contains('\n'), "{error}");
        }
    }
}
