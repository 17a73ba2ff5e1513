//! Reads how programs fare in the scenes, from `make measure`: `benches/scenes.json`.

use crate::experiments::accuracy::case::{Outcome, Scene, scenes};
use crate::experiments::accuracy::trials::{Trial, right};
use crate::experiments::measured::{Machine, committed};
use crate::experiments::prelude::*;
use std::collections::BTreeMap;

pub const PROGRAMS: Experiment<(), Vec<Program>> = Experiment {
    name: "programs",
    own: &["src/experiments/programs.rs"],
    reads: &[FILE],
    parameters: |_| (),
    how: Read(|session| complete(committed(session, FILE)?)),
    tables,
};

const FILE: &str = "benches/scenes.json";

/// A script of `benches/peers/scenes` on one day and machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Program {
    pub script: String,
    /// Day of the measurement, YYYY-MM-DD.
    pub date: String,
    pub machine: Machine,
    /// Why it could not be run; empty if it was.
    pub absent: String,
    pub settings: Vec<Run>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Run {
    pub name: String,
    pub version: String,
    pub settings: String,
    /// For each scene the outcomes of its cases.
    pub outcomes: BTreeMap<String, Trial>,
    /// And the processor time that each took, in seconds, that of starting the program included.
    pub seconds: BTreeMap<String, Vec<f64>>,
}

impl Run {
    pub fn trial(&self, scene: &Scene) -> &Trial {
        &self.outcomes[&scene.id]
    }

    /// Returns the smallest difficulty of a scene down to which all cases are right, or `None` if
    /// the easiest case is not.
    fn hardest(&self, scene: &str) -> Option<f64> {
        let scene = scenes().into_iter().find(|other| other.id == scene)?;
        let mut cases: Vec<_> = scene.cases.iter().zip(self.trial(&scene)).collect();
        cases.sort_by(|a, b| b.0.difficulty.total_cmp(&a.0.difficulty));
        let successes = cases.iter().take_while(|(_, outcome)| **outcome == Outcome::Right);
        successes.last().map(|(case, _)| case.difficulty)
    }
}

/// Refuses outcomes of other scenes than those of the report.
fn complete(programs: Vec<Program>) -> Result<Vec<Program>, Error> {
    for run in programs.iter().flat_map(|program| &program.settings) {
        for scene in scenes() {
            let cases = run.outcomes.get(&scene.id).map_or(0, Trial::len);
            if cases != scene.cases.len() {
                let field = format!("scenes.json: {}, scene {}", run.name, scene.id);
                let problem = format!("{cases} outcomes for {} cases", scene.cases.len());
                return Err(Error::input(field, problem, "run make measure again"));
            }
        }
    }
    Ok(programs)
}

fn tables(programs: &Vec<Program>) -> Vec<Table> {
    let mut rows: Vec<(&Program, usize, &Run)> = Vec::new();
    for program in programs {
        rows.extend((1..).zip(&program.settings).map(|(i, run)| (program, i, run)));
    }
    let total =
        |count: fn(&Trial) -> usize, run: &Run| run.outcomes.values().map(count).sum::<usize>();
    let share = |trial: &Trial| right(trial) as f64 / trial.len() as f64;
    let among = |run: &Run, these: &[Outcome]| {
        run.outcomes.values().flatten().filter(|outcome| these.contains(outcome)).count() as u64
    };
    const SHARES: &str = "shares of scenes that are right, added up";
    const GRAZE: &str = "smallest depth down to which all grazes are seen";
    const RECONTACT: &str = "the same of gaps that reopen slowly";
    const WARNED: &str = "cases that were refused or had a message";
    const LATE: &str = "cases in which it passed a bound on work or time";
    let table = Table::builder("programs.all", &rows, |_| 1)
        .table_computed_by(origin(complete))
        .text_key("script", |(program, ..)| program.script.clone())
        .key("setting", "1", |(_, i, _)| *i as f64)
        .words("name", "program", |(.., run)| run.name.clone())
        .words("version", "its version", |(.., run)| run.version.clone())
        .words("settings", "its settings", |(.., run)| run.settings.clone())
        .words("date", "when it was run", |(program, ..)| program.date.clone())
        .count("cases", "cases of all scenes", |(.., run)| total(Trial::len, run) as u64)
        .count("right", "cases with the expected outcome", |(.., run)| total(right, run) as u64)
        .count("scenes", "all scenes", |(.., run)| run.outcomes.len() as u64)
        .real("by_scene", "1", 3, SHARES, |(.., run)| run.outcomes.values().map(share).sum::<f64>())
        .real("graze", "1", 1, GRAZE, |(.., run)| run.hardest("grazing-hits"))
        .real("recontact", "1", 1, RECONTACT, |(.., run)| run.hardest("recontact"))
        .count("warned", WARNED, |(.., run)| among(run, &[Outcome::Refused, Outcome::Warned]))
        .count("late", LATE, |(.., run)| among(run, &[Outcome::GaveUp]))
        .real("seconds", "s", 2, "processor time of all cases", |(.., run)| {
            (!run.seconds.is_empty()).then(|| run.seconds.values().flatten().sum::<f64>())
        })
        .all_measured();
    let scenes = scenes();
    let all_right = |scene: &Scene| {
        rows.iter().filter(|(.., run)| right(run.trial(scene)) == scene.cases.len()).count() as u64
    };
    let by_scene = Table::builder("programs.scenes", &scenes, |scene| scene.cases.len())
        .table_computed_by(origin(complete))
        .text_key("scene", |scene| scene.id.clone())
        .count("cases", "its cases", |scene| scene.cases.len() as u64)
        .count("settings", "programs and settings", |_| rows.len() as u64)
        .count("right", "of them, right in all cases", all_right)
        .all_measured();
    vec![table.done(), by_scene.done()]
}
