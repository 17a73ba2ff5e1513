//! `impact-paper verify`.

use impact_paper::experiments::Progress;
use impact_paper::program::listed::{Checked, listed, own_profile};
use impact_paper::program::sources::Sources;
use impact_paper::program::waiting::Waiting;
use impact_paper::program::{Failure, folder, make, signals, threads, work};
use impact_paper::report::sums;
use std::io::ErrorKind;
use std::path::PathBuf;

/// Says whether a report is what its SHA256SUMS lists; with --rerun, what is made here.
///
/// With --rerun the report is made again and compared. Every digest is computed anew. HTML is built beside and not committed: SHA256SUMS.local
/// lists them. Ends with exit code 1 if a file differs, is missing, or stands there without being
/// listed. Writes nothing. What a release on GitHub holds is attested besides: `gh attestation verify FILE
/// --repo OWNER/REPO` says whether that repository built the file, and from which commit.
#[derive(clap::Args)]
pub struct Args {
    /// Folder of the report.
    #[arg(value_name = "DIR", default_value = "paper")]
    folder: PathBuf,
    /// Make the report again, with the profile that it has and without saved results, and compare byte by byte.
    #[arg(long)]
    rerun: bool,
    /// Take results of long runs from this folder, where they are fresh, and keep them there.
    #[arg(long, value_name = "DIR", requires = "rerun", value_parser = work::folder())]
    results: Option<PathBuf>,
    /// Folder of the prose [default: templates of the checkout, or the copy inside the program].
    #[arg(long, value_name = "DIR", requires = "rerun")]
    templates: Option<PathBuf>,
    /// Number of threads; all cores without it. It changes no bit of the result.
    #[arg(long, value_name = "K", allow_hyphen_values = true, requires = "rerun", value_parser = threads::read)]
    threads: Option<usize>,
}

pub fn run(args: Args) -> Result<(), Failure> {
    let progress = signals::progress();
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
        let lost = args.folder.join(sums::LOCAL).symlink_metadata().is_err();
        let lost = lost.then(|| {
            let (local, anew) = (sums::LOCAL, folder::anew(&args.folder));
            format!(
                "; {local}, which lists what is built beside, is not there: {anew} writes it anew"
            )
        });
        format!("remove what is not listed, or put it elsewhere{}", lost.unwrap_or_default())
    } else {
        format!(
            "{} writes the report anew, `impact-paper diff` compares two of them (but not what is built beside); \
             what is not listed is for you to remove",
            folder::anew(&args.folder)
        )
    };
    Err(Failure::check(format!("{}: {them}; {remedy}", args.folder.display())))
}

/// Makes the report again and compares.
fn rerun(args: &Args, progress: &Progress) -> Result<Checked, Failure> {
    let profile = own_profile(&args.folder)?;
    // Removed in the end, whatever happens.
    let temporary = Waiting::temporary().map_err(|e| {
        let what = format!("a temporary folder in TMPDIR ({})", std::env::temp_dir().display());
        Failure::io(&e, what, "name one that can be written in TMPDIR")
    })?;
    let results = args.results.clone().unwrap_or_else(|| temporary.path().join("results"));
    let sources = Sources::of(args.threads, args.templates.clone(), results);
    let named = |failure: Failure| match args.results {
        Some(_) => failure,
        None => Failure { message: failure.message.replacen("--results", "TMPDIR", 1), ..failure },
    };
    let (made, _) =
        threads::run(args.threads, || make::whole(&sources, profile, progress)).map_err(named)?;
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
            Err(error) if error.kind() == ErrorKind::NotFound => fault("missing", path),
            Err(error) => {
                Failure::of_the_system(&error, args.folder.join(path).display())?;
                fault("unread", path);
            }
        }
    }
    for path in folder::walk(&args.folder, progress)? {
        if path != sums::LOCAL && !files.contains_key(&path) {
            fault("not made", &path);
        }
    }
    let fine = format!(" made again with the {} profile, the same bytes", profile.name());
    Ok(Checked { files: files.len(), fine, faults })
}
