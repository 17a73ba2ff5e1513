//! `impact-paper diff`.

mod markdown;
mod revision;
mod text;

use super::document::Only;
use super::{Failure, folder, stdout};
pub use impact_paper::numerics::text::count;
use impact_paper::report::compare::{self, Diff, Parts};
use impact_paper::report::{Files, PROGRAM};
use serde_json::json;
use std::path::Path;

/// Says what differs between two reports: verdicts, numbers, sentences, files.
///
/// A sentence in which nothing but numbers moved is counted, not told.
///
/// OLD and NEW are folders of reports, or else revisions of git, whose folder paper/ is meant. A
/// difference is no failure: the exit code is 0 unless --exit-code asks for more.
#[derive(clap::Args)]
pub struct Args {
    /// The earlier report.
    #[arg(value_name = "OLD")]
    old: String,
    /// The later one.
    #[arg(value_name = "NEW")]
    new: String,
    #[command(flatten)]
    only: Only,
    /// For a comment on a pull request: the largest differences, in tables.
    #[arg(long)]
    markdown: bool,
    /// For programs: everything, as JSON.
    #[arg(long, conflicts_with = "markdown")]
    json: bool,
    /// End with exit code 1 if anything differs.
    #[arg(long)]
    exit_code: bool,
}

pub fn run(args: Args) -> Result<(), Failure> {
    let (old, new) = (files(&args.old)?, files(&args.new)?);
    let unusable = |what: String| Failure::input(format!("{what}; is it a report?"));
    let mut before = Parts::of(&args.old, &old).map_err(unusable)?;
    let mut after = Parts::of(&args.new, &new).map_err(unusable)?;
    if let Some(document) = &args.only.document {
        before.only(document).and_then(|()| after.only(document)).map_err(unusable)?;
    }
    let diff = compare::diff(&before, &after, PROGRAM.documents).map_err(unusable)?;
    let told = match (args.markdown, args.json) {
        (true, _) => markdown::markdown,
        (_, true) => json,
        _ => text::text,
    };
    stdout::print(&told(&args.old, &args.new, &diff))?;
    if diff.is_empty() || !args.exit_code {
        return Ok(());
    }
    Err(Failure::check(format!("{} and {} differ", args.old, args.new)))
}

/// `sec7_jump: reproduced -> differs`.
pub fn fate(change: &compare::ClaimChange) -> String {
    format!("{}: {}", change.id, text::fate(change.before.as_deref(), change.after.as_deref()))
}

/// The files of a report by its folder or revision, without what is built beside.
fn files(name: &str) -> Result<Files, Failure> {
    let mut files = if Path::new(name).is_dir() { standing(name)? } else { revision::files(name)? };
    files.retain(|path, _| !folder::is_beside(path));
    Ok(files)
}

/// The files in a folder.
fn standing(name: &str) -> Result<Files, Failure> {
    let root = Path::new(name);
    let mut files = Files::new();
    for path in folder::walk(root)?.into_iter().filter(|path| !folder::is_beside(path)) {
        let bytes = folder::read(root, &path)
            .map_err(|e| Failure::input(format!("{name}: {path}: {e}; is it a report?")))?;
        files.insert(path, bytes);
    }
    Ok(files)
}

fn json(old: &str, new: &str, diff: &Diff) -> String {
    let json = json!({"old": old, "new": new, "same": diff.is_empty(), "diff": diff});
    format!("{json:#}\n")
}

/// A difference with its sign and three digits.
fn signed(value: f64) -> String {
    let text = format!("{value:+.2e}");
    let exponent = text.split('e').nth(1).and_then(|e| e.parse().ok()).unwrap_or(0);
    if value == 0.0 || !(-4..6).contains(&exponent) {
        return if value == 0.0 { "0".into() } else { text };
    }
    let decimals = usize::try_from(2 - exponent).unwrap_or(0);
    let text = format!("{value:+.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

#[cfg(test)]
mod tests {
    use super::signed;

    #[test]
    fn differences_have_three_digits() {
        let texts = [0.0, 3.0, -0.001_642, 12_345.6, 2.5e-9, -1e9, 0.999_9].map(signed);
        let expected = ["0", "+3", "-0.00164", "+12346", "+2.50e-9", "-1.00e9", "+1"];
        assert_eq!(texts, expected);
    }
}
