//! `impact-paper verify`.

use super::sources::Sources;
use super::{Failure, folder, make, stdout, work};
use clap::ValueEnum;
use impact_paper::digest::sha256;
use impact_paper::experiments::Progress;
use impact_paper::params::Profile;
use impact_paper::report::values::Number;
use impact_paper::report::{compare, sums};
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Says whether a report is what its SHA256SUMS lists, and with --rerun whether it is what this
/// program makes.
///
/// Every digest is computed anew. PDFs and HTML are built beside and not committed: SHA256SUMS.local
/// lists them. Ends with exit code 1 if a file differs, is missing, or stands there without being
/// listed. Writes nothing.
#[derive(clap::Args)]
pub struct Args {
    /// Folder of the report.
    #[arg(value_name = "DIR", default_value = "paper")]
    folder: PathBuf,
    /// Make the report again, without saved results, and compare byte by byte.
    #[arg(long)]
    rerun: bool,
    /// Sample sizes of the rerun [default: those of the report].
    #[arg(long, requires = "rerun")]
    profile: Option<work::ProfileName>,
    /// Take results of long runs from this folder, where they are fresh, and keep them there.
    #[arg(long, value_name = "DIR", requires = "rerun")]
    results: Option<PathBuf>,
    /// Folder of the prose [default: templates of the checkout, or the copy inside the program].
    #[arg(long, value_name = "DIR", requires = "rerun")]
    templates: Option<PathBuf>,
    /// Number of threads; all cores without it. It changes no bit of the result.
    #[arg(long, value_name = "K", allow_hyphen_values = true, requires = "rerun")]
    threads: Option<usize>,
}

/// Runs the verb.
pub fn run(args: Args) -> Result<(), Failure> {
    let progress = work::progress_that_tidies();
    let mut checked = listed(&args.folder, &progress)?;
    checked.tell(&args.folder)?;
    if args.rerun {
        let again = rerun(&args, &progress)?;
        again.tell(&args.folder)?;
        checked.faults.extend(again.faults);
    }
    let them = match checked.faults.len() {
        0 => return Ok(()),
        1 => "1 fault (standard output names it)".to_string(),
        faults => format!("{faults} faults (standard output names them)"),
    };
    let strange =
        |fault: &String| fault.starts_with("unlisted") || fault.starts_with("rerun: not made");
    let remedy = if checked.faults.iter().all(strange) {
        "remove what is not listed, or put it elsewhere"
    } else {
        "`impact-paper paper --force` writes the report anew, `impact-paper diff` compares two of them (but \
         not what is built beside); what is not listed is for you to remove"
    };
    Err(Failure::check(format!("{}: {them}; {remedy}", args.folder.display())))
}

/// What a comparison of all files found.
pub struct Checked {
    /// How many files were compared.
    pub files: usize,
    /// What a file without fault is, after the number of files.
    pub fine: String,
    /// One line for each file with a fault.
    pub faults: Vec<String>,
}

impl Checked {
    fn tell(&self, folder: &Path) -> Result<(), Failure> {
        for fault in &self.faults {
            stdout::print(&format!("{fault}\n"))?;
        }
        if self.faults.is_empty() {
            let folder = folder.display();
            stdout::print(&format!("{folder}: {} files{}\n", self.files, self.fine))?;
        }
        Ok(())
    }
}

/// Compares the folder with its list.
///
/// # Errors
/// Exit code 2 if there is no list that can be read.
pub fn listed(root: &Path, progress: &Progress) -> Result<Checked, Failure> {
    let place = root.join(sums::NAME);
    let unusable = |what: String| {
        let remedy = "make the report anew with `impact-paper paper`";
        Failure::input(format!("{}: {what}; {remedy}", place.display()))
    };
    let found = folder::walk(root)?;
    let text = folder::read(root, sums::NAME).map_err(|e| unusable(e.to_string()))?;
    let text = String::from_utf8(text).map_err(|e| unusable(e.to_string()))?;
    let entries = sums::read(&text).map_err(|e| unusable(e.to_string()))?;
    let mut known: BTreeMap<&str, &str> = BTreeMap::new();
    // Of what was last written, what is built beside: the rest may be of another revision by now.
    let local = folder::read(root, sums::LOCAL).ok().and_then(|text| String::from_utf8(text).ok());
    let local = local.and_then(|text| sums::lines(&text).ok()).unwrap_or_default();
    let beside =
        |entry: &&sums::Entry| folder::is_beside(&entry.path) && found.contains(&entry.path);
    for entry in local.iter().filter(beside).chain(&entries) {
        known.insert(&entry.path, &entry.digest);
    }
    let mut faults = Vec::new();
    let mut fault =
        |what: &str, path: &str, more: &str| faults.push(format!("{what:8} {path}{more}"));
    for (path, digest) in &known {
        progress.check()?;
        match folder::read(root, path) {
            Ok(bytes) if sha256(&bytes) == *digest => (),
            Ok(_) => fault("differs", path, ""),
            Err(error) if error.kind() == ErrorKind::NotFound => fault("missing", path, ""),
            Err(error) => fault("unread", path, &format!(" ({error})")),
        }
    }
    let lists = [sums::NAME, sums::LOCAL];
    let strange =
        |path: &&String| !lists.contains(&path.as_str()) && !known.contains_key(path.as_str());
    for path in found.iter().filter(strange) {
        fault("unlisted", path, "");
    }
    let fine = format!(", all as {} lists them", sums::NAME);
    Ok(Checked { files: known.len(), fine, faults })
}

/// What only a binary with the typesetter makes.
const PDF: &str = "report.pdf";

/// Makes the report again and compares.
fn rerun(args: &Args, progress: &Progress) -> Result<Checked, Failure> {
    let profile = match args.profile {
        Some(name) => Profile::from(name),
        None => own_profile(&args.folder)?,
    };
    // Removed in the end, whatever happens.
    let temporary = tempfile::tempdir().map_err(|e| {
        let remedy = "name one that can be written in TMPDIR";
        Failure::io(&e, format!("a temporary folder: {e}; {remedy}"))
    })?;
    let results = args.results.clone().unwrap_or_else(|| temporary.path().join("results"));
    let pdf = args.folder.join(PDF).symlink_metadata().is_ok();
    let typeset = pdf && cfg!(feature = "pdf");
    let sources = Sources::of(args.threads, args.templates.clone(), results);
    let (made, _) =
        work::on_threads(args.threads, || make::whole(&sources, profile, typeset, progress))?;
    // What is built beside may be missing, but not be another.
    let mut files = made.committed;
    let stands = |path: &String| args.folder.join(path).symlink_metadata().is_ok();
    files.extend(made.beside.into_iter().filter(|(path, _)| stands(path)));
    let mut faults = Vec::new();
    let mut fault = |what: &str, path: &str| faults.push(format!("rerun: {what:8} {path}"));
    for (path, bytes) in &files {
        match folder::read(&args.folder, path) {
            Ok(standing) if standing == *bytes => (),
            Ok(_) => fault("differs", path),
            Err(_) => fault("missing", path),
        }
    }
    for path in folder::walk(&args.folder)? {
        let known = path == sums::LOCAL || (path == PDF && !typeset);
        if !known && !files.contains_key(&path) {
            fault("not made", &path);
        }
    }
    let fine = format!(" made again with the {} profile, the same bytes", profile.name());
    let open =
        if pdf && !typeset { "; report.pdf needs a binary with the feature pdf" } else { "" };
    let fine = fine + open;
    Ok(Checked { files: files.len(), fine, faults })
}

/// The profile that the report's values name.
///
/// # Errors
/// Exit code 2 if they name none.
pub fn own_profile(root: &Path) -> Result<Profile, Failure> {
    let unknown = |what: &str| {
        Failure::input(format!("{}: values.json {what}; give --profile", root.display()))
    };
    let text = folder::read(root, "values.json").map_err(|_| unknown("cannot be read"))?;
    let text = String::from_utf8(text).map_err(|_| unknown("is not text"))?;
    let values = compare::read(&text).map_err(|_| unknown("is not one of a report"))?;
    match values.get("profile").map(|value| &value.number) {
        Some(Number::Text(name)) => work::ProfileName::from_str(name, false)
            .map(Profile::from)
            .map_err(|_| unknown("names a profile that this program does not have")),
        _ => Err(unknown("names no profile")),
    }
}
