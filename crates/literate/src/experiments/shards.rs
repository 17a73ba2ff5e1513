//! The work of a profile as a list of units, shared out to machines and joined again.

use super::cutting::Unit;
use super::identity::{Identity, Reason, told};
use super::store::Store;
use super::{Error, Need, Profile, Progress, Saved};
use crate::input::{count, listed, regular};
use std::cell::LazyCell;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Into so many shards a profile may be divided; more would have nothing to do.
pub const MOST: usize = 100_000;

/// All units of work of a profile.
pub struct Plan {
    profile: Profile,
    /// The experiments that a profile saves.
    of: fn(Profile) -> Vec<Need>,
    /// In the order of the list, and of each experiment.
    pub tasks: Vec<Task>,
    /// The experiments that are meant; none if all are.
    only: Vec<String>,
    /// Units of the others: their files are passed over.
    others: BTreeSet<String>,
}

/// One unit of work of one experiment.
pub struct Task {
    /// The experiment.
    pub experiment: Arc<dyn Saved>,
    /// The unit.
    pub unit: Unit,
    /// What it is made of.
    identity: Identity,
    /// Its name, that of its file without the ending.
    pub name: String,
}

/// What [`Plan::run`] did.
pub struct Ran {
    /// Units that were run.
    pub run: usize,
    /// Units that were there before.
    pub fresh: usize,
}

impl Plan {
    /// The plan of a profile, of the experiments that each profile saves.
    pub fn new(of: fn(Profile) -> Vec<Need>, profile: Profile) -> Self {
        let tasks = of(profile).into_iter().flat_map(|experiment| {
            let experiment = experiment.at(profile);
            experiment.units().into_iter().enumerate().map(move |(number, unit)| {
                let identity = experiment.identity().of_unit(number, &unit);
                let name = identity.file_stem(profile);
                Task { experiment: experiment.clone(), unit, identity, name }
            })
        });
        Plan { profile, of, tasks: tasks.collect(), only: Vec::new(), others: BTreeSet::new() }
    }

    /// The same for the experiments of these names alone.
    pub fn only(mut self, names: &[String]) -> Self {
        let meant = |task: &Task| names.iter().any(|name| name == task.experiment.name());
        let (tasks, others): (Vec<_>, Vec<_>) = self.tasks.into_iter().partition(meant);
        self.others.extend(others.into_iter().map(|task| task.name));
        Plan { tasks, only: names.to_vec(), ..self }
    }

    /// The shard of each unit, from 1: the heaviest unit first, always to the shard with the least
    /// work so far, of several to the first.
    pub fn shards(&self, of: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.tasks.len()).collect();
        order.sort_by_key(|&task| Reverse(self.tasks[task].unit.weight));
        let mut loads: BinaryHeap<_> = (1..=of).map(|shard| Reverse((0_u64, shard))).collect();
        let mut shards = vec![1; self.tasks.len()];
        for task in order {
            if let Some(Reverse((load, shard))) = loads.pop() {
                shards[task] = shard;
                // A unit without weight takes its turn too.
                let weight = self.tasks[task].unit.weight.max(1);
                loads.push(Reverse((load.saturating_add(weight), shard)));
            }
        }
        shards
    }

    /// What a store has of a unit, or why there is nothing to be used.
    fn look(&self, task: &Task, store: &Store) -> Result<String, Vec<Reason>> {
        let text = store.look(&task.identity, self.profile)?;
        if task.experiment.understands(&task.unit, &text) {
            Ok(text)
        } else {
            Err(vec![Reason::Schema])
        }
    }

    /// Whether each unit is missing in all of these stores.
    pub fn left(&self, stores: &[Store]) -> Vec<bool> {
        let left = |task: &Task| stores.iter().all(|store| self.look(task, store).is_err());
        self.tasks.iter().map(left).collect()
    }

    /// Runs the units of one shard that are not yet fresh in the store.
    pub fn run(
        &self,
        (shard, of): (usize, usize),
        store: &Store,
        progress: &Progress,
    ) -> Result<Ran, Error> {
        let own: Vec<&Task> = self
            .tasks
            .iter()
            .zip(self.shards(of))
            .filter(|(_, other)| *other == shard)
            .map(|(task, _)| task)
            .collect();
        own.iter().try_for_each(|task| store.refuse_foreign(&task.identity, self.profile))?;
        store.prepare()?;
        let (mut open, mut fresh) = (Vec::new(), 0);
        for &task in &own {
            match self.look(task, store) {
                Ok(_) => fresh += 1,
                Err(reasons) => {
                    if reasons != [Reason::Missing] {
                        progress.say(&format!("{}: run ({})", task.name, told(&reasons)));
                    }
                    open.push(task);
                }
            }
        }
        let (run, units) = (open.len(), count(open.len(), "unit"));
        progress.say(&format!("shard {shard}/{of}: {units} to run, {fresh} fresh"));
        for experiment in open.chunk_by(|a, b| a.experiment.name() == b.experiment.name()) {
            progress.check()?;
            let units: Vec<(&Unit, &Identity)> =
                experiment.iter().map(|task| (&task.unit, &task.identity)).collect();
            experiment[0].experiment.run_units(&units, store, progress)?;
        }
        Ok(Ran { run, fresh })
    }

    /// Joins the units in folders to results in a store.
    pub fn merge(
        &self,
        folders: &[PathBuf],
        results: &Store,
        progress: &Progress,
    ) -> Result<(), Error> {
        let found = self.found(folders)?;
        let stores: Vec<Store> =
            folders.iter().map(|folder| Store::open(folder)).collect::<Result<_, _>>()?;
        let (mut texts, mut bad, mut missing) = (Vec::new(), Vec::new(), Vec::new());
        let mut foreign = false;
        for task in &self.tasks {
            progress.check()?;
            match found.get(&task.name) {
                None => missing.push(task.name.clone()),
                Some(&place) => match self.look(task, &stores[place]) {
                    Ok(text) => texts.push(text),
                    Err(reasons) => {
                        let path = path(&folders[place], &task.name);
                        bad.push(format!("{}: {}", path.display(), told(&reasons)));
                        match stores[place].refuse_foreign(&task.identity, self.profile) {
                            // Nobody can say what it is.
                            Err(error @ Error::Store { .. }) => return Err(error),
                            unit => foreign |= unit.is_err(),
                        }
                    }
                },
            }
        }
        let profile = self.profile.name();
        if !bad.is_empty() {
            let remedy = match foreign {
                true => "move away what is none, and run its shard again, into the same folder",
                false => "run its shard again with this program, into the same folder",
            };
            return Err(Error::Units { what: listed(&bad), remedy: remedy.into() });
        }
        if !missing.is_empty() {
            let only = match self.only.as_slice() {
                [] => String::new(),
                names => format!(" --experiment {}", names.join(",")),
            };
            let remedy = format!(
                "`impact-paper plan --profile {profile}{only} --shards N --left DIR…` names the shards \
                 to run again"
            );
            let what = format!("missing units of work: {}", listed(&missing));
            return Err(Error::Units { what, remedy });
        }
        results.prepare()?;
        // All or none.
        self.tasks.iter().try_for_each(|task| {
            results.refuse_foreign(task.experiment.identity(), self.profile)
        })?;
        let mut texts = texts.into_iter();
        for tasks in self.tasks.chunk_by(|a, b| a.experiment.name() == b.experiment.name()) {
            let own: Vec<String> = texts.by_ref().take(tasks.len()).collect();
            let experiment = &tasks[0].experiment;
            experiment.merge(&own, results, progress)?;
            let (name, units) = (experiment.name(), count(own.len(), "unit"));
            progress.say(&format!("{name}: joined from {units} of work"));
        }
        Ok(())
    }

    /// In which folder each unit lies, by name.
    fn found(&self, folders: &[PathBuf]) -> Result<BTreeMap<String, usize>, Error> {
        let mut found: BTreeMap<String, usize> = BTreeMap::new();
        let known: BTreeMap<&str, ()> =
            self.tasks.iter().map(|task| (task.name.as_str(), ())).collect();
        let elsewhere = LazyCell::new(|| self.elsewhere());
        let (mut strange, mut twice) = (Vec::new(), Vec::new());
        for (place, folder) in folders.iter().enumerate() {
            for name in names(folder)? {
                if self.others.contains(&name) {
                    continue;
                }
                if !known.contains_key(name.as_str()) {
                    strange.push(self.stranger(folder, &name, elsewhere.get(&name)));
                } else if let Some(first) = found.insert(name.clone(), place) {
                    let [a, b] = [first, place].map(|place| path(&folders[place], &name));
                    let same = match (regular(&a), regular(&b)) {
                        (Ok(one), Ok(other)) => one == other,
                        // What the system cannot read is told later.
                        (Err(error), _) | (_, Err(error)) => error.raw_os_error().is_some(),
                    };
                    if !same {
                        let (a, b) = (a.display(), b.display());
                        twice.push(format!("{name} is in {a} and, otherwise, in {b}"));
                    }
                }
            }
        }
        let refused =
            |what: &[String], remedy: &str| Err(Error::input("merge", listed(what), remedy));
        if !strange.is_empty() {
            return refused(
                &strange,
                "give folders that `impact-paper run` wrote, and their profile",
            );
        }
        if !twice.is_empty() {
            return refused(&twice, "leave out the folder that has the wrong one");
        }
        Ok(found)
    }

    /// The units of all other profiles, by name.
    fn elsewhere(&self) -> BTreeMap<String, Profile> {
        let units = |profile| {
            Plan::new(self.of, profile).tasks.into_iter().map(move |task| (task.name, profile))
        };
        Profile::ALL.into_iter().filter(|other| *other != self.profile).flat_map(units).collect()
    }

    /// What is said of a file that is no unit of this plan, but of another profile or of none.
    fn stranger(&self, folder: &Path, name: &str, of: Option<&Profile>) -> String {
        let path = path(folder, name);
        match of {
            Some(profile) => format!("{} is of profile {}", path.display(), profile.name()),
            None => {
                let profile = self.profile.name();
                format!("{} is no unit of work of profile {profile}", path.display())
            }
        }
    }
}

fn path(folder: &Path, name: &str) -> PathBuf {
    folder.join(format!("{name}.json"))
}

/// Names of the JSON files in a folder, sorted; others, like logs, are nobody's concern.
fn names(folder: &Path) -> Result<Vec<String>, Error> {
    let remedy = "give folders that `impact-paper run` wrote";
    let failed = |error: std::io::Error| {
        Error::input(folder.display().to_string(), error.to_string(), remedy)
    };
    let mut names = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let name = entry.map_err(failed)?.file_name().to_string_lossy().into_owned();
        names.extend(name.strip_suffix(".json").map(String::from));
    }
    names.sort();
    Ok(names)
}
