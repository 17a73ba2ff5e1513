//! `impact-paper-tools bundle`: an archive that needs nothing but itself.

use serde_json::Value;
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::RwLock;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// The checkout.
const SOURCE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
/// The program.
const PROGRAM: &str = env!("CARGO_BIN_EXE_impact-paper-tools");
/// The folder that everything is in.
const TOP: &str = concat!("impact-paper-", env!("CARGO_PKG_VERSION"), "/");

/// Written by the test that measures a time: no other runs the program meanwhile.
static ALONE: RwLock<()> = RwLock::new(());

/// The program in a folder, with arguments between which a blank stands.
fn program(folder: &Path, arguments: &str) -> Command {
    let mut command = Command::new(PROGRAM);
    command.current_dir(folder).args(arguments.split(' '));
    command
}

/// Exit code, stdout and stderr; −1 for a program that a signal ended.
fn outcome(command: &mut Command) -> (i32, String, String) {
    let _others = ALONE.read().unwrap();
    let output = command.output().unwrap();
    let text = |bytes: &Vec<u8>| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap_or(-1), text(&output.stdout), text(&output.stderr))
}

/// SHA-256 in hexadecimal digits.
fn digest(bytes: impl AsRef<[u8]>) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

fn git(folder: &Path, arguments: &str) {
    let mut command = Command::new("git");
    let who = ["-c", "user.name=test", "-c", "user.email=test@example.org"];
    let arguments = arguments.split(' ');
    let output = command.current_dir(folder).args(who).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// A clone with a small report, a program among its files, and the list of authors.
fn clone() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let at = |path: &str| folder.path().join(path);
    fs::create_dir_all(at("paper/figures")).unwrap();
    for name in ["CITATION.cff", "src/main.rs", "templates/front.md"] {
        fs::create_dir_all(at(name).parent().unwrap()).unwrap();
        fs::copy(Path::new(SOURCE).join(name), at(name)).unwrap();
    }
    let mut sums = String::new();
    for name in ["figures/fig03.svg", "values.json"] {
        fs::copy(Path::new(SOURCE).join("paper").join(name), at("paper").join(name)).unwrap();
        sums += &format!("{}  {name}\n", digest(fs::read(at("paper").join(name)).unwrap()));
    }
    fs::write(at("paper/SHA256SUMS"), sums).unwrap();
    fs::create_dir(at(".ci")).unwrap();
    fs::write(at(".ci/run"), "#!/bin/sh\n").unwrap();
    git(folder.path(), "init -q");
    git(folder.path(), "add -A");
    git(folder.path(), "update-index --chmod=+x .ci/run");
    #[cfg(unix)]
    fs::set_permissions(at(".ci/run"), std::os::unix::fs::PermissionsExt::from_mode(0o755))
        .unwrap();
    git(folder.path(), "commit -q -m one");
    folder
}

/// Exit code and stderr.
fn bundle(folder: &Path, arguments: &str) -> (i32, String) {
    let (code, _, note) = outcome(&mut program(folder, &format!("bundle {arguments}")));
    (code, note)
}

/// Bytes and mode of every file of an archive, by its path below the top folder.
fn unpacked(path: &Path) -> BTreeMap<String, (Vec<u8>, u32)> {
    let mut archive = zip::ZipArchive::new(File::open(path).unwrap()).unwrap();
    (0..archive.len())
        .map(|i| {
            let mut file = archive.by_index(i).unwrap();
            let mut bytes = Vec::new();
            file.read_to_end(&mut bytes).unwrap();
            let name =
                file.name().unwrap().strip_prefix(TOP).expect("all in one folder").to_string();
            (name, (bytes, file.unix_mode().unwrap() & 0o777))
        })
        .collect()
}

const SMALL: &str = "--without crates --without results";

#[test]
fn everything_is_listed_described_and_the_same_twice() {
    let clone = clone();
    let out = tempfile::tempdir().unwrap();
    let pack = |name: &str| {
        let path = out.path().join(name);
        let (code, said) = bundle(clone.path(), &format!("{} {SMALL}", path.display()));
        assert_eq!((code, said.as_str()), (0, ""));
        path
    };
    let (one, two) = (pack("one.zip"), pack("two.zip"));
    assert_eq!(fs::read(&one).unwrap(), fs::read(two).unwrap());
    let files = unpacked(&one);
    assert_eq!(files[".ci/run"].1, 0o755);
    assert_eq!(files["CITATION.cff"].1, 0o644);

    // sha256sum's list has every file but itself.
    let text = |path: &str| String::from_utf8(files[path].0.clone()).unwrap();
    let sums = text("SHA256SUMS");
    let listed: BTreeMap<&str, &str> = sums
        .lines()
        .map(|line| line.split_once("  ").unwrap())
        .map(|(sum, path)| (path, sum))
        .collect();
    for (path, (bytes, _)) in files.iter().filter(|(path, _)| *path != "SHA256SUMS") {
        assert_eq!(listed.get(path.as_str()), Some(&digest(bytes).as_str()), "{path}");
    }
    assert_eq!(listed.len() + 1, files.len());

    // The metadata name what is there, and nothing else; each reference leads to an entity.
    let metadata: Value = serde_json::from_str(&text("ro-crate-metadata.json")).unwrap();
    let graph = metadata["@graph"].as_array().unwrap();
    let by_id: BTreeMap<&str, &Value> =
        graph.iter().map(|entity| (entity["@id"].as_str().unwrap(), entity)).collect();
    assert_eq!(by_id.len(), graph.len());
    let mut wanted = BTreeSet::new();
    graph.iter().for_each(|entity| references(entity, true, &mut wanted));
    let outside = |id: &&String| id.starts_with("https://w3id.org/");
    for id in wanted.iter().filter(|id| !outside(id)) {
        assert!(by_id.contains_key(id.as_str()), "{id}");
    }
    let is_file = |entity: &&&Value| entity["@type"].to_string().contains("File");
    for entity in by_id.values().filter(is_file) {
        let path = entity["@id"].as_str().unwrap();
        assert_eq!(entity["contentSize"], files[path].0.len().to_string(), "{path}");
        if path != "SHA256SUMS" {
            assert_eq!(entity["sha256"], listed[path], "{path}");
        }
    }
    let head = Command::new("git").current_dir(clone.path()).args(["rev-parse", "HEAD"]).output();
    let head = String::from_utf8(head.unwrap().stdout).unwrap();
    assert_eq!(by_id["#revision"]["value"], head.trim());
    assert_eq!(by_id["./"]["datePublished"].as_str().unwrap().len(), 10);
}

/// Collects what entities refer to.
fn references(value: &Value, is_entity: bool, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(fields) => {
            if let (false, Some(Value::String(id))) = (is_entity, fields.get("@id")) {
                found.insert(id.clone());
            }
            fields.values().for_each(|field| references(field, false, found));
        }
        Value::Array(all) => all.iter().for_each(|one| references(one, false, found)),
        _ => (),
    }
}

#[test]
fn what_cannot_be_packed_is_said_in_one_line() {
    let refused = |folder: &Path, arguments: &str, code: i32, what: &str| {
        let (found, said) = bundle(folder, arguments);
        assert_eq!(found, code, "{said}");
        assert!(said.contains(what) && said.trim_end().lines().count() == 1, "{said}");
        let left = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
        let left: Vec<_> = left.filter(|name| name.to_string_lossy().contains("zip")).collect();
        assert!(left.is_empty(), "{left:?}");
    };
    let clone = clone();
    let folder = clone.path();
    let small = format!("out.zip {SMALL}");
    refused(folder, "nowhere/out.zip", 2, "its folder is not there");
    #[cfg(unix)]
    {
        let _socket = std::os::unix::net::UnixListener::bind(folder.join("socket")).unwrap();
        refused(folder, "socket --force", 2, "a folder or device itself");
        fs::remove_file(folder.join("socket")).unwrap();
    }
    refused(folder, "paper", 2, "is there already");
    refused(
        folder,
        "CITATION.cff",
        2,
        "CITATION.cff is there already; give another file, or --force",
    );
    refused(&folder.join("paper"), &small, 2, "inside a clone");
    refused(folder, "out.zip --without crates", 3, "sweep");
    fs::write(folder.join("note.txt"), "").unwrap();
    refused(folder, &small, 2, "note.txt is not committed");
    fs::remove_file(folder.join("note.txt")).unwrap();
    fs::write(folder.join("paper/figures/fig03.svg"), "<svg/>").unwrap();
    git(folder, "commit -q -a -m two");
    refused(folder, &small, 1, "differs  figures/fig03.svg");
    let elsewhere = tempfile::tempdir().unwrap();
    refused(elsewhere.path(), &small, 2, "no clone");
}

/// A full disk is told in words, and Ctrl-C is obeyed while another program collects crates.
#[test]
fn a_full_disk_and_ctrl_c_end_it() {
    let clone = clone();
    let out = tempfile::tempdir().unwrap();
    let at = |name: &str| out.path().join(name);
    let full = format!(
        "trap '' XFSZ; ulimit -f 1; exec \"$0\" bundle {} {SMALL}",
        at("full.zip").display()
    );
    let mut command = Command::new("bash");
    command.current_dir(clone.path()).args(["-c", &full, PROGRAM]);
    let (code, _, said) = outcome(&mut command);
    assert_eq!(code, 4, "{said}");
    assert!(said.contains("(os error 27); allow larger files"), "{said}");
    let mut command =
        program(clone.path(), &format!("bundle {} --without results", at("no.zip").display()));
    let (code, _, said) = outcome(command.env("TMPDIR", at("nowhere")));
    assert_eq!(code, 4, "{said}");
    assert!(said.contains("(os error 2); ") && said.contains("TMPDIR"), "{said}");

    fs::write(at("cargo"), "#!/bin/sh\nsleep 60\n").unwrap();
    #[cfg(unix)]
    fs::set_permissions(at("cargo"), std::os::unix::fs::PermissionsExt::from_mode(0o755)).unwrap();
    let bundle = format!("bundle {} --without results", at("out.zip").display());
    let mut command = program(clone.path(), &bundle);
    command.env("CARGO", at("cargo")).stderr(Stdio::null());
    let alone = ALONE.write().unwrap();
    let mut child = command.spawn().unwrap();
    std::thread::sleep(Duration::from_secs(1));
    assert!(child.try_wait().unwrap().is_none(), "it must still be running");
    let asked = Instant::now();
    let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let took = asked.elapsed();
    drop(alone);
    assert!(took < Duration::from_secs(1), "{took:?}");
    let left = fs::read_dir(out.path()).unwrap().map(|entry| entry.unwrap().file_name());
    assert_eq!(left.collect::<Vec<_>>(), ["cargo"]);
}

/// Builds without a network and makes the report again: minutes.
#[test]
#[ignore = "builds the program from an archive of the last commit"]
fn the_archive_alone_is_enough() {
    let status = Command::new(Path::new(SOURCE).join(".ci/bundle")).arg("--build").status();
    assert!(status.unwrap().success());
}
