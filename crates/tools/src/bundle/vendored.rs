//! The source of every crate, as `cargo vendor` collects it.

use super::archive::Archive;
use super::read;
use impact_paper::experiments::Progress;
use impact_paper::program::waiting::Waiting;
use impact_paper::program::{Failure, folder};
use std::fs::File;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

/// Where cargo looks for it; a setting in the source would be in the way of this one.
const SETTINGS: &str = ".cargo/config.toml";

/// Lets cargo build from the folder vendor/, and from nothing else.
const CONFIG: &str = "\
# All crates are in vendor/: nothing is fetched.
[source.crates-io]
replace-with = \"vendored-sources\"

[source.vendored-sources]
directory = \"vendor\"

[net]
offline = true
";

/// Adds vendor/ and the settings.
///
/// # Errors
/// Exit code 4 if cargo cannot collect it, 130 on Ctrl-C.
pub fn add(archive: &mut Archive, progress: &Progress) -> Result<(), Failure> {
    let remedy = "see that cargo and its registry can be reached and TMPDIR has room, or leave them out with --without crates";
    let failed = |what: &str| Failure::run(format!("cargo vendor: {what}; {remedy}"));
    // Removed in the end, whatever happens.
    let temporary = Waiting::temporary().map_err(|e| failed(&e.to_string()))?;
    let vendor = temporary.path().join("vendor");
    progress.say("collecting the source of all crates");
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    // Into a file: a pipe that nobody reads could fill up and stop it.
    let log = temporary.path().join("log");
    let log_file = File::create(&log).map_err(|e| failed(&e.to_string()))?;
    let mut child = Command::new(cargo)
        .args(["vendor", "--locked", "--versioned-dirs", "--quiet"])
        .arg(&vendor)
        .stdout(Stdio::null())
        .stderr(log_file)
        .spawn()
        .map_err(|e| failed(&e.to_string()))?;
    let status = loop {
        if let Some(status) = child.try_wait().map_err(|e| failed(&e.to_string()))? {
            break status;
        }
        if progress.stopped() {
            // It may have ended by itself, of the same Ctrl-C.
            let _ = child.kill();
            let _ = child.wait();
        }
        progress.check()?;
        std::thread::sleep(Duration::from_millis(50));
    };
    progress.check()?;
    if !status.success() {
        let told = std::fs::read_to_string(&log).unwrap_or_default();
        let line = told.lines().find(|line| line.starts_with("error")).unwrap_or("it failed");
        return Err(failed(line));
    }
    archive.add(SETTINGS, CONFIG.as_bytes(), false)?;
    let paths = folder::walk(&vendor, progress)?;
    let stage = progress.stage("packing", paths.len() as u64);
    for path in paths {
        progress.check()?;
        archive.add(
            &format!("vendor/{path}"),
            &read(&vendor, &path)?,
            runs(&vendor.join(&path)),
        )?;
        stage.advance(1);
    }
    Ok(())
}

/// May it be run as a program?
#[cfg(unix)]
fn runs(path: &Path) -> bool {
    use std::os::unix::fs::PermissionsExt;
    path.metadata().is_ok_and(|data| data.permissions().mode() & 0o111 != 0)
}

/// Files are not marked as programs here.
#[cfg(not(unix))]
fn runs(_: &Path) -> bool {
    false
}
