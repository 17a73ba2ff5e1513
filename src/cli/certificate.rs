//! A certificate that a check was made: what the program can say, and places for a person's hand.

use super::output::{self, Force};
use super::verify::Checked;
use super::{Failure, folder};
use impact_paper::digest::sha256;
use impact_paper::input;
use impact_paper::report::values::Number;
use impact_paper::report::{Registry, compare, sums};
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

/// What a report says of itself.
pub struct Facts {
    values: Registry,
    files: usize,
    sums: String,
}

impl Facts {
    /// Reads values.json and SHA256SUMS of a report's folder.
    ///
    /// # Errors
    /// Exit code 2 if one of them cannot be read.
    pub fn of(root: &Path) -> Result<Self, Failure> {
        let fault = |path: &str, what: String| {
            let remedy = "make the report anew with `impact-paper paper`";
            Failure::input(format!("{}: {what}; {remedy}", root.join(path).display()))
        };
        let text = |path: &str| {
            let bytes = folder::read(root, path).map_err(|e| fault(path, e.to_string()))?;
            String::from_utf8(bytes).map_err(|e| fault(path, e.to_string()))
        };
        let values = compare::read(&text("values.json")?);
        let values = values.map_err(|e| fault("values.json", e.to_string()))?;
        let list = text(sums::NAME)?;
        let files = sums::read(&list).map_err(|e| fault(sums::NAME, e.to_string()))?.len();
        Ok(Facts { values, files, sums: sha256(list.as_bytes()) })
    }

    /// A value as text, or a dash.
    pub fn value(&self, id: &str) -> String {
        match self.values.get(id).map(|value| &value.number) {
            Some(Number::Text(text)) => text.clone(),
            Some(Number::Integer(n)) => n.to_string(),
            _ => "–".into(),
        }
    }
}

/// The certificate, with what a rerun found if there was one.
pub fn text(facts: &Facts, found: Option<(&Checked, &Checked)>) -> String {
    let score = |id: &str| facts.value(&format!("score.{id}"));
    let mut out = String::from("# Certificate of a check\n\n");
    out +=
        "A report counts as reproduced when a program built from the archived source makes every\n";
    out += "file of it again, byte for byte. `verify --rerun --certificate` fills in the second part;\n";
    out += "the third is for the person who ran it.\n\n";
    out += "## 1. What is checked\n\n| | |\n|---|---|\n";
    let mut row = |name: &str, what: &str| {
        let _ = writeln!(out, "| {name} | {what} |");
    };
    row("Work", &format!("impact-paper {}", facts.value("version")));
    row(
        "Reproduces",
        "M. Homer and S. J. Hogan (2007), Impact Dynamics of Large Dimensional Systems",
    );
    row(
        "Sample sizes",
        &format!("profile {}, seed {}", facts.value("profile"), facts.value("seed")),
    );
    row("Files of the report", &facts.files.to_string());
    row("SHA-256 of SHA256SUMS", &format!("`{}`", facts.sums));
    row("SHA-256 of the printed numbers", &format!("`{}`", facts.value("published_digest")));
    row(
        "Claims of the paper",
        &format!(
            "{}: {} reproduced, {} differ and are explained, {} differ, {} cannot be judged",
            score("total"),
            score("reproduced"),
            score("differs_and_explained"),
            score("differs"),
            score("cannot_be_judged")
        ),
    );
    out += "\n## 2. What the rerun found\n\n";
    match found {
        None => out += "Not run yet.\n",
        Some((listed, again)) => {
            let machine = std::env::consts::ARCH;
            let cores = std::thread::available_parallelism().map_or(1, usize::from);
            let _ = writeln!(out, "| | |\n|---|---|");
            let _ = writeln!(out, "| Program | impact-paper {} |", env!("CARGO_PKG_VERSION"));
            let _ =
                writeln!(out, "| Machine | {}, {machine}, {cores} cores |", std::env::consts::OS);
            let verdict = |checked: &Checked| match checked.faults.len() {
                0 => format!("{} files{}", checked.files, checked.fine),
                1 => "**1 fault**".into(),
                faults => format!("**{faults} faults**"),
            };
            let _ = writeln!(out, "| Files against their list | {} |", verdict(listed));
            let _ = writeln!(out, "| Files made again | {} |", verdict(again));
            let faults: Vec<&String> = listed.faults.iter().chain(&again.faults).collect();
            if !faults.is_empty() {
                out += "\n```text\n";
                faults.iter().for_each(|fault| out += &format!("{fault}\n"));
                out += "```\n";
            }
        }
    }
    out += "\n## 3. Who checked it\n\n| | |\n|---|---|\n";
    for place in ["Name", "ORCID", "Date", "What was looked at besides", "Signature"] {
        let _ = writeln!(out, "| {place} | |");
    }
    out
}

/// Refuses, before a long rerun, to write over a file that is no draft: a person may have signed it.
///
/// # Errors
/// Exit code 2 with its name, or if the report cannot be read.
pub fn free(path: &Path, root: &Path, force: Force) -> Result<(), Failure> {
    let above = path.parent().filter(|above| !above.as_os_str().is_empty());
    let above = above.unwrap_or(Path::new("."));
    if above
        .canonicalize()
        .is_ok_and(|above| root.canonicalize().is_ok_and(|root| above.starts_with(root)))
    {
        let (path, root) = (path.display(), root.display());
        let message = format!(
            "--certificate: {path} lies in {root}, whose files are all listed; put it elsewhere"
        );
        return Err(Failure::input(message));
    }
    // Whether it can be written is asked before a long rerun.
    input::new_beside(path).map_err(|error| failed(path, &error))?;
    let draft = || Ok::<_, Failure>(text(&Facts::of(root)?, None));
    match input::read(path) {
        Ok(standing) if standing == draft()? => Ok(()),
        _ => output::free("--certificate", path, force),
    }
}

/// Writes the certificate of a rerun.
///
/// # Errors
/// Exit code 2 or 4 if the file cannot be written.
pub fn write(path: &Path, root: &Path, found: (&Checked, &Checked)) -> Result<(), Failure> {
    let text = text(&Facts::of(root)?, Some(found));
    let mut file = input::new_beside(path).map_err(|error| failed(path, &error))?;
    file.write_all(text.as_bytes()).map_err(|error| failed(path, &error))?;
    file.persist(path).map_err(|error| failed(path, &error.error))?;
    Ok(())
}

fn failed(path: &Path, error: &std::io::Error) -> Failure {
    let (path, remedy) = (path.display(), "give a file that can be written");
    Failure::io(error, format!("--certificate: {path}: {error}; {remedy}"))
}
