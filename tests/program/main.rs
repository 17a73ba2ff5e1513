//! The program as its users run it.

mod bad_input;
mod bench;
mod bundle;
mod check;
mod cluster;
mod diff;
mod explain;
mod mutate;
mod paper;
mod saved;
mod shards;
mod sweep;
mod verify;

use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, Output};

/// The program.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_impact-paper");

/// The project's templates.
pub const TEMPLATES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/templates");

/// Number of the experiments that are saved in every profile but the deep one.
pub const EXPERIMENTS: usize = 23;

/// The program in a folder, with arguments between which a blank stands.
pub fn program(folder: &Path, arguments: &str) -> Command {
    let mut command = Command::new(PROGRAM);
    command.current_dir(folder).args(arguments.split(' '));
    command
}

/// Exit code, stdout and stderr; −1 for a program that a signal ended.
pub fn told(output: &Output) -> (i32, String, String) {
    let text = |bytes: &Vec<u8>| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap_or(-1), text(&output.stdout), text(&output.stderr))
}

/// The same of a run in a folder.
pub fn run(folder: &Path, arguments: &str) -> (i32, String, String) {
    told(&program(folder, arguments).output().unwrap())
}

/// Files by name.
pub type Files = BTreeMap<String, Vec<u8>>;

/// The JSON files of a folder by name; none if it is not there. Temporary files that a killed program
/// left are not among them.
pub fn files(folder: &Path) -> Files {
    let Ok(entries) = std::fs::read_dir(folder) else { return Files::new() };
    entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|end| end == "json"))
        .map(|path| {
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            (name, std::fs::read(&path).unwrap())
        })
        .collect()
}
