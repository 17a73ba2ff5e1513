//! `impact-paper diff`.

mod markdown;
mod revision;
mod text;

use super::{Failure, folder, shown, stdout};
pub use impact_numerics::text::count;
use impact_paper::experiments::alive;
use impact_paper::report::Files;
use impact_paper::report::compare::{self, Change, Diff, Parts};
use literate::input::{self, FOUND};
use serde_json::json;
use std::path::Path;

/// Says what differs between two reports: verdicts, numbers, files.
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
    let _alive = alive(|| Some("diff: at work".into()));
    let (old, new) = (files(&args.old)?, files(&args.new)?);
    let unusable = |what: String| Failure::input(format!("{what}; is it a report?"));
    let before = Parts::of(&args.old, old).map_err(unusable)?;
    let after = Parts::of(&args.new, new).map_err(unusable)?;
    let diff = compare::diff(&before, &after);
    let told = match (args.markdown, args.json) {
        (true, _) => markdown::markdown,
        (_, true) => json,
        _ => text::text,
    };
    let [old, new] = [&args.old, &args.new].map(|name| shown(Path::new(name)));
    stdout::print(&told(&old, &new, &diff))?;
    if diff.is_empty() || !args.exit_code {
        return Ok(());
    }
    Err(Failure::check(format!("{} and {} differ", args.old, args.new)))
}

/// `sec7_jump: reproduced -> differs`.
pub fn fate(change: &compare::ClaimChange) -> String {
    format!("{}: {}", change.id, text::fate(change.before.as_deref(), change.after.as_deref()))
}

/// All files of a report may have so many MiB; ours has twenty.
const MOST: u64 = 64;

/// The files of a report by its folder or revision, without what is built beside.
fn files(name: &str) -> Result<Files, Failure> {
    if Path::new(name).is_dir() { standing(name) } else { revision::files(name) }
}

/// The files in a folder.
fn standing(name: &str) -> Result<Files, Failure> {
    let root = Path::new(name);
    let mut paths = folder::walk(root)?;
    paths.retain(|path| !folder::is_beside(path));
    let length = |path: &String| root.join(path).symlink_metadata().map_or(0, |file| file.len());
    bounded(name, paths.iter().map(|path| (path.as_str(), length(path))))?;
    let read = |path: String| {
        let place = || format!("{name}: {path}");
        let bytes = folder::read(root, &path)
            .map_err(|error| Failure::io(&error, place(), "is it a report?"))?;
        Ok((path, bytes))
    };
    paths.into_iter().map(read).collect()
}

/// Refuses files that are longer than those of any report, before they are read: paths and lengths.
fn bounded<'a>(name: &str, files: impl Iterator<Item = (&'a str, u64)>) -> Result<(), Failure> {
    let mut all = 0;
    for (path, length) in files {
        if length > FOUND << 20 {
            let what = format!("{name}: {path}: {}", input::too_long(FOUND));
            return Err(Failure::input(format!("{what}; is it a report?")));
        }
        all += length;
    }
    if all > MOST << 20 {
        let what = format!("{name}: its files are longer than {MOST} MiB together");
        return Err(Failure::input(format!("{what}; is it a report?")));
    }
    Ok(())
}

/// The numbers that both reports have, what a reader must see first at the front, and those that one has.
fn by_weight(changes: &[Change]) -> (Vec<&Change>, Vec<&Change>) {
    let both = |change: &&Change| change.before.is_some() && change.after.is_some();
    let (mut numbers, other): (Vec<&Change>, Vec<&Change>) = changes.iter().partition(both);
    numbers.sort_by(|a, b| weight(b).total_cmp(&weight(a)));
    (numbers, other)
}

/// What is of another kind weighs most, and then by errors; what differs in nothing but its sample, or has no error, least.
fn weight(change: &Change) -> f64 {
    match (change.sigmas, change.difference) {
        (Some(sigmas), _) => sigmas.abs(),
        (None, Some(difference)) if change.kind.is_none() || difference == 0.0 => 0.0,
        _ => f64::INFINITY,
    }
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
    use super::{Change, by_weight, signed};

    #[test]
    fn differences_have_three_digits() {
        let texts = [0.0, 3.0, -0.001_642, 12_345.6, 2.5e-9, -1e9, 0.999_9].map(signed);
        let expected = ["0", "+3", "-0.00164", "+12346", "+2.50e-9", "-1.00e9", "+1"];
        assert_eq!(texts, expected);
    }

    #[test]
    fn numbers_come_by_their_weight() {
        let change = |id: &str, difference, sigmas, kind: bool| Change {
            id: id.into(),
            before: Some("1".into()),
            after: Some("2".into()),
            difference,
            sigmas,
            kind: kind.then(|| ["a".into(), "b".into()]),
        };
        let gone = Change { after: None, ..change("gone", None, None, false) };
        let changes = [
            gone,
            change("sample", Some(0.0), None, true),
            change("less", Some(9.0), Some(0.1), true),
            change("more", Some(-1.0), Some(-7.0), false),
            change("kind", Some(1.0), None, true),
            change("words", None, None, false),
        ];
        let ids = |changes: Vec<&Change>| -> Vec<String> {
            changes.iter().map(|change| change.id.clone()).collect()
        };
        let (numbers, other) = by_weight(&changes);
        assert_eq!(ids(numbers), ["kind", "words", "more", "less", "sample"]);
        assert_eq!(ids(other), ["gone"]);
    }
}
