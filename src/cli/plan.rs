//! `impact-paper plan`.

use super::{Failure, shard, stdout, work};
use impact_numerics::text::count;
use impact_paper::experiments::Store;
use impact_paper::params::Profile;
use literate::experiments::shards::Task;
use serde::Serialize;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Lists the units of work of a profile: what may run on several machines. Runs nothing.
///
/// An ensemble is cut at every sigma, and further into realisations where one sigma is much work; other
/// experiments are one unit each. The cuts follow from the parameters alone. A unit's weight is its
/// estimated number of impacts (half a microsecond each).
///
/// On three machines:  impact-paper run --shard 1/3 --out DIR   (and 2/3, 3/3, into other folders),
/// then on one:        impact-paper merge DIR DIR DIR && impact-paper paper
#[derive(clap::Args)]
#[command(verbatim_doc_comment)]
pub struct Args {
    /// Sample sizes.
    #[arg(long, default_value = "full", value_parser = work::profiles())]
    profile: Profile,
    #[command(flatten)]
    only: work::Only,
    /// Say to which of N shards each unit belongs.
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    shards: Option<usize>,
    /// List only what is not yet fresh in any of these folders; they need not be there.
    #[arg(long, value_name = "DIR", num_args = 1..)]
    left: Vec<PathBuf>,
    /// As JSON.
    #[arg(long)]
    json: bool,
    /// Only the shards that have units left, as job arrays are told: 1-3,7. Nothing if there are none.
    #[arg(long, requires = "shards", conflicts_with = "json")]
    array: bool,
}

/// What is said of one unit.
#[derive(Serialize)]
struct Line<'a> {
    unit: &'a str,
    experiment: &'static str,
    covers: &'a str,
    /// The first and the last realisation, from 0; none for what is not cut.
    realisations: Option<[usize; 2]>,
    weight: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    shard: Option<usize>,
}

impl<'a> Line<'a> {
    fn of(task: &'a Task, shard: Option<usize>) -> Self {
        let range = &task.unit.realisations;
        Line {
            unit: &task.name,
            experiment: task.experiment.name(),
            covers: &task.unit.covers,
            realisations: range.end.checked_sub(1).map(|last| [range.start, last]),
            weight: task.unit.weight,
            shard,
        }
    }
}

pub fn run(args: Args) -> Result<(), Failure> {
    let profile = args.profile;
    if let Some(of) = args.shards {
        shard::number("--shards", of)?;
    }
    args.left.iter().try_for_each(|folder| shard::refuse_above(folder))?;
    let stores =
        args.left.iter().map(|folder| Store::open(folder).map_err(shard::given_by("--left")));
    let stores: Vec<Store> = stores.collect::<Result<_, _>>()?;
    let plan = args.only.plan(profile)?;
    let left = plan.left(&stores);
    let shards = args.shards.map(|of| plan.shards(of));
    let shard = |place: usize| shards.as_ref().map(|shards| shards[place]);
    let lines: Vec<Line> = (plan.tasks.iter().enumerate().zip(left))
        .filter(|(_, left)| *left)
        .map(|((place, task), _)| Line::of(task, shard(place)))
        .collect();
    let text = if args.array {
        let mut shards: Vec<usize> = lines.iter().filter_map(|line| line.shard).collect();
        shards.sort_unstable();
        shards.dedup();
        if shards.is_empty() { String::new() } else { format!("{}\n", ranges(&shards)) }
    } else if args.json {
        let weight: u64 = lines.iter().map(|line| line.weight).sum();
        let json = serde_json::json!({
            "profile": profile.name(), "shards": args.shards, "weight": weight, "units": lines,
        });
        format!("{json:#}\n")
    } else {
        table(&lines)
    };
    stdout::print(&text)
}

fn table(lines: &[Line]) -> String {
    let shard = lines.iter().any(|line| line.shard.is_some());
    let shard = if shard { "  shard" } else { "" };
    let mut out = format!("{:22}{shard} {:>10}  covers\n", "unit", "weight");
    for Line { unit, covers, realisations, weight, shard, .. } in lines {
        let realisations =
            realisations.map_or(String::new(), |[first, last]| format!(", {first} to {last}"));
        let shard = shard.map_or(String::new(), |shard| format!(" {shard:>6}"));
        let _ = writeln!(out, "{unit:22}{shard} {weight:>10}  {covers}{realisations}");
    }
    let weight: u64 = lines.iter().map(|line| line.weight).sum();
    let _ = writeln!(out, "{}, about {weight} impacts", count(lines.len(), "unit"));
    out
}

/// `1-3,7` for rising numbers.
fn ranges(numbers: &[usize]) -> String {
    let text = |run: &[usize]| match run {
        [first, .., last] => format!("{first}-{last}"),
        [one] => one.to_string(),
        [] => String::new(),
    };
    numbers.chunk_by(|a, b| a + 1 == *b).map(text).collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_as_slurm_reads_them() {
        assert_eq!(ranges(&[1, 2, 3, 7, 9, 10]), "1-3,7,9-10");
        assert_eq!(ranges(&[4]), "4");
    }
}
