//! Finds the code of a program: all files that cargo built it from, and how they were compiled.
//!
//! Cargo writes a list beside each program, `NAME.d`, which has its files, those of all packages of
//! the same machine that it needs, what build scripts read, and what `include_str!` takes. A
//! program without its list, such as a copy, is known by its own bytes.

use crate::input::{self, sha256};
use crate::project::{Project, is_in};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::DirEntry;
use std::io;
use std::path::{Component, Path, PathBuf};
use std::time::SystemTime;

/// What results are made of, besides parameters and files that experiments read.
#[derive(Clone, Debug, Default)]
pub struct Code {
    /// Hashes of files, by their paths from the top of the project, and values of what else counts.
    hashes: BTreeMap<String, String>,
    /// Code of single experiments.
    own: Vec<&'static str>,
}

impl Code {
    /// Reads the code of the program that runs; `own` is what experiments list as their own.
    /// Fails if a file cannot be read, or has changed since the program was built.
    pub fn of_program(
        project: &Project,
        prose: &str,
        own: Vec<&'static str>,
    ) -> Result<Code, String> {
        let program = &std::env::current_exe().map_err(|error| format!("the program: {error}"))?;
        if let Some(path) = project.changed() {
            return Err(older_than(path));
        }
        let unread = |path: &Path, error: io::Error| {
            format!("{}: {error}; restore it, and run `cargo build`", path.display())
        };
        let hash = |path: &PathBuf| {
            Ok::<_, String>(sha256(std::fs::read(path).map_err(|error| unread(path, error))?))
        };
        let Some((top, files)) = listed(program, project) else {
            return Ok(Code { hashes: [("the program".into(), hash(program)?)].into(), own });
        };
        // The first 64 bits are enough.
        let named_hash = |path: &PathBuf| Ok((name(path, &top), hash(path)?[..16].to_string()));
        let time = |path: &Path| path.metadata()?.modified();
        let built: SystemTime = time(program).map_err(|error| unread(program, error))?;
        let mut manifests = BTreeSet::new();
        for path in &files {
            let name = name(path, &top);
            let changed = time(path).map_or(true, |changed| changed > built);
            // The program reads its prose, and what it has a copy of, each time.
            let is_read = is_in(&name, prose) || project.copied(&name).is_some();
            if changed && !is_read {
                return Err(older_than(&name));
            }
            let package = path.ancestors().find(|folder| folder.join("Cargo.toml").is_file());
            manifests.extend(package.map(|folder| folder.join("Cargo.toml")));
        }
        let mut hashes: BTreeMap<String, String> =
            files.iter().map(named_hash).collect::<Result<_, String>>()?;
        let mut code = hashes.clone();
        code.retain(|path, _| !is_in(path, prose));
        if let Some(path) = differs_from_first_run(program, built, &code) {
            let problem = "is not what this program was built from, although its time is older";
            return Err(format!("{path} {problem}; touch it, and run `cargo build`"));
        }
        for path in &manifests {
            hashes.extend([named_hash(path)?]);
        }
        hashes.extend(variables(program, &files));
        let compiled = project.sources.compiled.iter();
        hashes.extend(compiled.map(|(name, value)| (name.to_string(), value.to_string())));
        let profile = program.parent().and_then(Path::file_name).unwrap_or_default();
        hashes.insert("the profile".into(), profile.to_string_lossy().into());
        Ok(Code { hashes, own })
    }

    /// Returns what the result of an experiment with some code of its own is made of.
    pub fn counted(&self, project: &Project, own: &[&str]) -> BTreeMap<String, String> {
        let mut hashes = self.hashes.clone();
        hashes.retain(|path, _| project.counts(path, own, &self.own));
        hashes
    }
}

/// Returns a file whose hash differs from that at the first run, or `None`: by its time cargo does
/// not notice an older file that is put back. The first run notes all beside the program.
fn differs_from_first_run(
    program: &Path,
    built: SystemTime,
    code: &BTreeMap<String, String>,
) -> Option<String> {
    let place = program.with_extension("built");
    let since = built.duration_since(SystemTime::UNIX_EPOCH).ok()?.as_nanos().to_string();
    let record = input::read_text(&place).unwrap_or_default();
    let (before, first_hashes) = record.split_once('\n').unwrap_or_default();
    if before == since {
        let first_hashes: BTreeMap<String, String> = serde_json::from_str(first_hashes).ok()?;
        let differs = |(path, hash): &(&String, &String)| code.get(*path) != Some(hash);
        return first_hashes.iter().find(differs).map(|(path, _)| path.clone());
    }
    let waiting = program.with_extension(format!("built.{}", std::process::id()));
    let record = format!("{since}\n{}", serde_json::to_string(code).ok()?);
    std::fs::write(&waiting, record).and_then(|()| std::fs::rename(&waiting, place)).ok();
    None
}

/// Returns the environment variables that code of the program took when it was compiled, and their
/// values: the compiler lists them for each package, in the file that is the newest.
fn variables(program: &Path, files: &[PathBuf]) -> BTreeMap<String, String> {
    let folders = program.ancestors().skip(1).take(2).map(|folder| folder.join("deps"));
    let lists = folders.filter_map(|folder| folder.read_dir().ok()).flatten().flatten();
    let lists = lists.filter(|entry| entry.path().extension().is_some_and(|end| end == "d"));
    let dated = |entry: DirEntry| Some((entry.metadata().ok()?.modified().ok()?, entry.path()));
    let mut packages = BTreeMap::new();
    for (_, list) in lists.filter_map(dated).collect::<BTreeSet<_>>() {
        let list = input::read_text(&list).unwrap_or_default();
        let line = list.lines().next().unwrap_or_default();
        let first = line.split_inclusive(".rs").next().unwrap_or_default();
        let Some(root) = paths(first).into_iter().next() else { continue };
        if files.iter().any(|file| file.ends_with(&root)) {
            packages.insert(root, list);
        }
    }
    let mut variables = BTreeMap::new();
    for line in packages.values().flat_map(|list| list.lines()) {
        let Some(pair) = line.strip_prefix("# env-dep:") else { continue };
        let (name, value) = pair.split_once('=').unwrap_or((pair, ""));
        let is_of_cargo = name.starts_with("CARGO") || name.starts_with("CLIPPY");
        if !is_of_cargo && !["OUT_DIR", "COMPILER"].contains(&name) {
            variables.insert(format!("{name} when compiled"), sha256(value)[..16].into());
        }
    }
    variables
}

fn older_than(path: &str) -> String {
    format!("{path} has changed since this program was built; run `cargo build`")
}

/// Returns the folder of the package and the files of the list beside the program, if it has one.
fn listed(program: &Path, project: &Project) -> Option<(PathBuf, Vec<PathBuf>)> {
    // Beside a test is a list of the compiler, without other packages.
    if program.parent()?.file_name()? == "deps" {
        return None;
    }
    let list = input::read_text(&program.with_extension("d")).ok()?;
    let files = paths(&list);
    let own = || project.sources.files.iter().map(|(path, _)| *path);
    let first = own().find(|path| !path.starts_with("..") && path.contains('/'))?;
    let is_top = |top: &PathBuf| own().all(|path| files.contains(&real(&top.join(path))));
    let mut tops = files.iter().filter(|path| path.ends_with(first)).filter_map(|path| {
        Some(path.ancestors().nth(Path::new(first).components().count())?.to_path_buf())
    });
    let top = tops.find(is_top)?;
    files.iter().any(|path| path.exists()).then_some((top, files))
}

/// Reads a list of cargo, `TARGET: FILE FILE`; a backslash stands before a blank of a name.
fn paths(list: &str) -> Vec<PathBuf> {
    let (_, list) = list.split_once(": ").unwrap_or_default();
    let (mut files, mut path) = (Vec::new(), String::new());
    for part in list.trim_end().split(' ') {
        match part.strip_suffix('\\') {
            Some(part) => path += &format!("{part} "),
            None => files.push(real(Path::new(&(std::mem::take(&mut path) + part)))),
        }
    }
    files
}

/// Returns a path in which `..` is resolved by its words alone.
fn real(path: &Path) -> PathBuf {
    let mut real = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => drop(real.pop()),
            part => real.push(part),
        }
    }
    real
}

/// Returns the path of a file from a folder; what build scripts made lies in one with another name
/// on each machine.
fn name(path: &Path, top: &Path) -> String {
    let path_text = path.to_string_lossy();
    if let Some((folder, made)) = path_text.rsplit_once("/out/")
        && folder.contains("/build/")
    {
        return format!("made by a build script: {made}");
    }
    let common = path.components().zip(top.components()).take_while(|(a, b)| a == b).count();
    let up = top.components().skip(common).map(|_| "..");
    let down = path.components().skip(common).map(|part| part.as_os_str().to_str().unwrap_or("?"));
    up.chain(down).collect::<Vec<_>>().join("/")
}
