//! Experiments that take too long for every report.
//!
//! They are run now and then as the profile `deep`, and what each unit of work gave is committed. The
//! report joins the units to a result, by the program as it is, and carries them over changes of the
//! source as long as an audit allows: some units, drawn by lot, are run again, and what they give is
//! compared, byte by byte, with what was committed.

use super::cutting::Unit;
use super::experiment::{Experiment, Json, Saved};
use super::store::{self, Identity, Reason, Store, told, written};
use super::{Error, Need, Progress};
use crate::digest::sha256;
use crate::numerics::random::generator;
use crate::params::{Profile, SEED};
use rand::seq::SliceRandom;
use serde::{Deserialize, Serialize};

/// The file of this code: an audit depends on it.
const MODULE: &str = "src/experiments/deep.rs";

/// What to do about a result that is stale.
pub const REMEDY: &str = "run `make deep` and build again";

/// An experiment of which the units of work are committed.
pub struct Deep<P: 'static, T: 'static, U: 'static> {
    /// The experiment.
    pub experiment: Experiment<P, T, U>,
    /// The committed units, as they were saved.
    pub(super) committed: &'static str,
    /// This profile and the larger ones carry them over; smaller ones run the experiment at
    /// a size of their own.
    pub(super) from: Profile,
    /// How far what units give is from the result, where an error of it is known.
    pub(super) distance: Option<Away<T, U>>,
}

/// Measures how far what units give is from a result.
type Away<T, U> = fn(&T, &[(&Unit, U)]) -> Distance;

/// How far means are from those of a result, in standard errors.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Distance {
    /// The largest.
    pub largest: f64,
    /// What chance lets expect at most.
    pub allowed: f64,
}

/// What an audit found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Carriage {
    /// Every unit gave what was committed.
    Identical,
    /// Units gave something else, and their means are no further from the result than chance lets
    /// expect.
    WithinError,
    /// Units gave something else: what is committed is stale.
    Failed,
}

/// Committed units, run again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Audit {
    /// What follows from the rest.
    pub verdict: Carriage,
    /// Units of work of the whole.
    pub units: usize,
    /// Units that were run again.
    pub again: usize,
    /// Of these, units that gave the same to the byte.
    pub identical: usize,
    /// How far those are that were run again, if not all are identical and it can be said.
    pub distance: Option<Distance>,
}

/// What is audited: a change of it makes a saved audit stale.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct AuditParams {
    /// SHA-256 of the committed file.
    committed: String,
    /// Units are drawn up to so much work, in impacts.
    work: u64,
}

/// How much work a profile has time for, in impacts.
fn work(profile: Profile) -> u64 {
    match profile {
        Profile::Quick => 200_000,
        Profile::Ci => 1_000_000,
        Profile::Full | Profile::Deep => 2_000_000,
    }
}

/// The places of units drawn by lot, rising, up to so much work; at least the lightest.
fn drawn(units: &[Unit], work: u64) -> Vec<usize> {
    let mut order: Vec<usize> = (0..units.len()).collect();
    order.shuffle(&mut generator("audit-units", SEED, 0));
    let mut left = work;
    order.retain(|&place| match left.checked_sub(units[place].weight) {
        Some(rest) => {
            left = rest;
            true
        }
        None => false,
    });
    if order.is_empty() {
        order.extend((0..units.len()).min_by_key(|&place| units[place].weight));
    }
    order.sort_unstable();
    order
}

/// What only the committed file decides, beside the code.
#[derive(Serialize)]
struct JoinedParams {
    /// SHA-256 of the committed file.
    committed: String,
}

impl<P, T, U> Deep<P, T, U> {
    /// What takes too long for the full profile.
    pub(super) const fn new(experiment: Experiment<P, T, U>, committed: &'static str) -> Self {
        Deep { experiment, committed, from: Profile::Full, distance: None }
    }
}

impl<P: Serialize + Sync, T: Json, U: Json> Deep<P, T, U> {
    /// Whether a profile has the committed result, and not one of its own.
    fn carries(&self, profile: Profile) -> bool {
        (self.from..Profile::Deep).contains(&profile)
    }

    fn name(&self) -> &'static str {
        self.experiment.need.name()
    }

    /// Where the committed result lies, seen from the top of the project.
    fn file(&self) -> String {
        format!("benches/deep/{}-deep.json", self.name())
    }

    /// The result, with the audit of one that is carried over.
    ///
    /// # Errors
    /// As [`Experiment::get`]; [`Error::Input`] if the committed file cannot be read, or was run
    /// with other parameters than those of this program.
    pub fn get(
        &self,
        profile: Profile,
        store: &Store,
        progress: &Progress,
    ) -> Result<(T, Option<Audit>), Error> {
        if !self.carries(profile) {
            return Ok((self.experiment.get(profile, store, progress)?, None));
        }
        let audit = store
            .get(&self.identity(profile), profile, progress, || self.rerun(profile, progress))?;
        let joined = format!("{} joined", self.name());
        let params = JoinedParams { committed: sha256(self.committed) };
        let identity = self.with_own_code(Identity::new(&joined, MODULE, &params));
        let join = || self.join(self.units_given()?, progress);
        // What is said of the audit is enough.
        let quiet = Progress::silent();
        let result = match store.derived().get(&identity, profile, &quiet, join) {
            // A folder that cannot be written is no reason to fail.
            Err(Error::Store { .. }) => join()?,
            found => found?,
        };
        Ok((result, Some(audit)))
    }

    /// An identity that depends on the code of the experiment too.
    fn with_own_code(&self, identity: Identity) -> Identity {
        self.experiment.identity(Profile::Deep).with_code(identity)
    }

    /// What each unit gave that is committed.
    fn units_given(&self) -> Result<Vec<U>, Error> {
        let unread = |what: String| Error::input(self.file(), what, REMEDY);
        let (made_of, body) =
            store::parsed(self.committed).map_err(|reasons| unread(told(&reasons)))?;
        let reasons = self.experiment.identity(Profile::Deep).reasons(&made_of);
        if !reasons.iter().all(Reason::is_of_source) {
            return Err(unread(told(&reasons)));
        }
        let given: Vec<U> = serde_json::from_str(body).map_err(|e| unread(e.to_string()))?;
        match given.len() == self.experiment.units(Profile::Deep).len() {
            true => Ok(given),
            false => Err(unread("units of work are missing, or there are too many".into())),
        }
    }

    fn join(&self, given: Vec<U>, progress: &Progress) -> Result<T, Error> {
        self.experiment.joined(Profile::Deep, given, progress)
    }

    /// Runs units again that are drawn for a profile.
    fn rerun(&self, profile: Profile, progress: &Progress) -> Result<Audit, Error> {
        let given = self.units_given()?;
        let units = self.experiment.units(Profile::Deep);
        let drawn = drawn(&units, work(profile));
        let chosen: Vec<&Unit> = drawn.iter().map(|&place| &units[place]).collect();
        let again = self.experiment.given(Profile::Deep, &chosen, progress)?;
        let bytes = |own: &U| written(self.name(), own);
        let mut identical = 0;
        for (&place, own) in drawn.iter().zip(&again) {
            identical += usize::from(bytes(own)? == bytes(&given[place])?);
        }
        let all = identical == again.len();
        let number = again.len();
        let distance = match self.distance {
            Some(distance) if !all => {
                let parts: Vec<(&Unit, U)> = chosen.into_iter().zip(again).collect();
                Some(distance(&self.join(given, progress)?, &parts))
            }
            _ => None,
        };
        let verdict = match distance {
            _ if all => Carriage::Identical,
            Some(Distance { largest, allowed }) if largest <= allowed => Carriage::WithinError,
            _ => Carriage::Failed,
        };
        Ok(Audit { verdict, units: units.len(), again: number, identical, distance })
    }

    /// What texts say that units gave.
    fn read(&self, texts: &[String]) -> Result<Vec<U>, Error> {
        let unread = |_| Error::NotUnderstood { name: self.name() };
        texts.iter().map(|text| serde_json::from_str(text).map_err(unread)).collect()
    }

    /// A saved audit or a saved run that is fresh.
    fn look<R: Json>(&self, profile: Profile, store: &Store) -> Result<R, Vec<Reason>> {
        let text = store.look(&self.identity(profile), profile)?;
        serde_json::from_str(&text).map_err(|_| vec![Reason::Schema])
    }
}

impl<P: Serialize + Sync, T: Json, U: Json> Saved for Deep<P, T, U> {
    fn need(&self) -> Need {
        self.experiment.need
    }

    fn identity(&self, profile: Profile) -> Identity {
        if !self.carries(profile) {
            return self.experiment.identity(profile);
        }
        let audit = AuditParams { committed: sha256(self.committed), work: work(profile) };
        self.with_own_code(Identity::new(self.name(), MODULE, &audit))
    }

    fn parameters(&self, profile: Profile) -> serde_json::Value {
        let profile = if self.carries(profile) { Profile::Deep } else { profile };
        self.experiment.identity(profile).parameters
    }

    fn stale(&self, profile: Profile, store: &Store) -> Vec<Reason> {
        if profile == Profile::Deep {
            return self.look::<Vec<U>>(profile, store).err().unwrap_or_default();
        }
        if !self.carries(profile) {
            return self.experiment.stale(profile, store);
        }
        match self.look::<Audit>(profile, store) {
            Ok(Audit { verdict: Carriage::Failed, .. }) => vec![Reason::Failed],
            Ok(_) => Vec::new(),
            Err(reasons) => reasons,
        }
    }

    fn audit(&self, profile: Profile, store: &Store, progress: &Progress) -> Result<bool, Error> {
        let stale = |why: Vec<Reason>| Error::Stale { name: self.name(), why: told(&why) };
        if profile == Profile::Deep {
            let saved: Vec<U> = self.look(profile, store).map_err(stale)?;
            let units = self.units(profile);
            let all: Vec<&Unit> = units.iter().collect();
            return Ok(self.experiment.given(profile, &all, progress)? == saved);
        }
        if !self.carries(profile) {
            return self.experiment.audit(profile, store, progress);
        }
        let saved: Audit = self.look(profile, store).map_err(stale)?;
        Ok(self.rerun(profile, progress)? == saved)
    }

    fn units(&self, profile: Profile) -> Vec<Unit> {
        if !self.carries(profile) {
            return self.experiment.units(profile);
        }
        let units = self.experiment.units(Profile::Deep);
        let weight = drawn(&units, work(profile)).iter().map(|&place| units[place].weight).sum();
        vec![Unit { row: 0, realisations: 0..0, covers: "an audit".into(), weight }]
    }

    fn run_units(
        &self,
        profile: Profile,
        units: &[(&Unit, Identity)],
        store: &Store,
        progress: &Progress,
    ) -> Result<(), Error> {
        if !self.carries(profile) {
            return self.experiment.run_units(profile, units, store, progress);
        }
        units.iter().try_for_each(|(_, identity)| {
            store.put(identity, profile, &self.rerun(profile, progress)?)
        })
    }

    fn understands(&self, profile: Profile, unit: &Unit, text: &str) -> bool {
        if !self.carries(profile) {
            return self.experiment.understands(profile, unit, text);
        }
        serde_json::from_str::<Audit>(text).is_ok()
    }

    fn merge(
        &self,
        profile: Profile,
        texts: &[String],
        store: &Store,
        progress: &Progress,
    ) -> Result<(), Error> {
        let identity = self.identity(profile);
        if profile == Profile::Deep {
            return store.put(&identity, profile, &self.read(texts)?);
        }
        if !self.carries(profile) {
            return self.experiment.merge(profile, texts, store, progress);
        }
        let unread = |_| Error::NotUnderstood { name: self.name() };
        let audit: Audit = serde_json::from_str(&texts.concat()).map_err(unread)?;
        store.put(&identity, profile, &audit)
    }
}

#[cfg(test)]
mod tests {
    use super::super::cutting::{Cutting, Row};
    use super::super::experiment::How::Cut;
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// What a unit gives: its row and its realisations.
    type Given = Vec<usize>;
    type Small = Deep<u64, usize, Given>;

    const CUTTING: Cutting<u64, Given, usize> = Cutting {
        rows: |&rows| {
            let row =
                |i| Row { covers: format!("row {i}"), realisations: 2, weight: 50_000 * (i + 1) };
            (0..rows).map(row).collect()
        },
        part: |_, unit, _, _| Ok(unit.realisations.clone().map(|i| 10 * unit.row + i).collect()),
        fits: |_, _, _| true,
        join: |_, rows, _| Ok(rows.into_iter().flatten().flatten().sum()),
    };

    fn experiment(cutting: Cutting<u64, Given, usize>) -> Experiment<u64, usize, Given> {
        Experiment {
            need: Need::TwoMasses,
            module: "src/experiments/rise.rs",
            parameters: |profile| if profile == Profile::Deep { 12 } else { 2 },
            how: Cut("test", cutting),
        }
    }

    fn small(committed: &str) -> Small {
        Deep::new(experiment(CUTTING), String::from(committed).leak())
    }

    /// The file that a run of the deep profile leaves.
    fn committed() -> String {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let (deep, quiet) = (small(""), Progress::silent());
        let units = deep.units(Profile::Deep);
        assert_eq!(units.len(), 14, "two rows are too heavy for one unit");
        let all: Vec<&Unit> = units.iter().collect();
        let given = deep.experiment.given(Profile::Deep, &all, &quiet).unwrap();
        let texts: Vec<String> = given.iter().map(|own| written("test", own).unwrap()).collect();
        deep.merge(Profile::Deep, &texts, &store, &quiet).unwrap();
        assert_eq!(deep.stale(Profile::Deep, &store), []);
        assert!(deep.audit(Profile::Deep, &store, &quiet).unwrap());
        std::fs::read_to_string(folder.path().join("two_masses-deep.json")).unwrap()
    }

    fn found(deep: &Small, profile: Profile) -> Result<(usize, Option<Audit>), Error> {
        deep.get(profile, &Store::nowhere(), &Progress::silent())
    }

    #[test]
    fn what_is_committed_is_carried_over_and_small_profiles_run_their_own() {
        let deep = small(&committed());
        let (result, audit) = found(&deep, Profile::Full).unwrap();
        assert_eq!(result, 1332, "the sum of 20 i + 1 for i = 0 to 11");
        let Audit { verdict, units, again, identical, distance } = audit.unwrap();
        assert_eq!((verdict, units, distance), (Carriage::Identical, 14, None));
        assert!(again == identical && (2..10).contains(&again), "{again}");
        assert_eq!(found(&deep, Profile::Quick).unwrap(), (22, None));
    }

    #[test]
    fn a_program_that_gives_something_else_is_noticed() {
        /// The row that another program gives otherwise.
        static ROW: AtomicUsize = AtomicUsize::new(0);
        let other = Cutting {
            part: |_, unit, _, _| {
                let off = usize::from(unit.row == ROW.load(Ordering::Relaxed));
                Ok(unit.realisations.clone().map(|i| 10 * unit.row + i + off).collect())
            },
            ..CUTTING
        };
        let mut deep: Small = Deep::new(experiment(other), committed().leak());
        let units = deep.experiment.units(Profile::Deep);
        let first = drawn(&units, work(Profile::Full))[0];
        ROW.store(units[first].row, Ordering::Relaxed);
        let audit = found(&deep, Profile::Full).unwrap().1.unwrap();
        assert_eq!(audit.verdict, Carriage::Failed);
        assert!(0 < audit.identical && audit.identical < audit.again, "{audit:?}");

        deep.distance = Some(|&sum, parts| {
            assert_eq!(sum, 1332);
            assert!(parts.iter().all(|(unit, given)| given[0] / 10 == unit.row));
            Distance { largest: 1.0, allowed: 2.0 }
        });
        let audit = found(&deep, Profile::Full).unwrap().1.unwrap();
        assert_eq!(audit.verdict, Carriage::WithinError);
        deep.distance = Some(|_, _| Distance { largest: 2.5, allowed: 2.0 });
        let audit = found(&deep, Profile::Full).unwrap().1.unwrap();
        assert_eq!(audit.verdict, Carriage::Failed);
    }

    #[test]
    fn a_failed_audit_is_stale_and_what_cannot_be_read_is_refused() {
        let text = committed();
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let (deep, quiet) = (small(&text), Progress::silent());
        assert_eq!(deep.stale(Profile::Full, &store), [Reason::Missing]);
        let audit = deep.get(Profile::Full, &store, &quiet).unwrap().1.unwrap();
        assert_eq!(deep.stale(Profile::Full, &store), []);
        assert!(deep.audit(Profile::Full, &store, &quiet).unwrap());
        let failed = Audit { verdict: Carriage::Failed, ..audit };
        store.put(&deep.identity(Profile::Full), Profile::Full, &failed).unwrap();
        assert_eq!(deep.stale(Profile::Full, &store), [Reason::Failed]);
        assert!(!deep.audit(Profile::Full, &store, &quiet).unwrap());

        // Another file is another audit.
        let edited = text.replacen("[[", "[[5,", 1);
        assert_eq!(small(&edited).stale(Profile::Full, &store), [Reason::Parameters]);
        let lines: Vec<&str> = text.lines().collect();
        let fewer = lines[2].replacen("[0,1],", "", 1);
        assert_ne!(fewer, lines[2]);
        let signed = |body: &str| {
            let digest = sha256(format!("{}\n{body}\n", lines[1]));
            format!("{digest}\n{}\n{body}\n", lines[1])
        };
        assert_eq!(signed(lines[2]), text);
        for broken in [edited, signed(&fewer), text[..text.len() / 2].into(), String::new()] {
            let error = found(&small(&broken), Profile::Full).unwrap_err().to_string();
            assert!(error.starts_with("benches/deep/two_masses-deep.json: "), "{error}");
            assert!(error.ends_with(REMEDY), "{error}");
        }
        let mut other = small(&text);
        other.experiment.parameters = |_| 11;
        let error = found(&other, Profile::Full).unwrap_err().to_string();
        assert!(error.contains("other parameters"), "{error}");
    }

    #[test]
    fn units_are_drawn_within_their_bound() {
        let units = experiment(CUTTING).units(Profile::Deep);
        let weight =
            |places: &[usize]| places.iter().map(|&place| units[place].weight).sum::<u64>();
        for bound in [150_000, 1_000_000, 3_000_000] {
            let places = drawn(&units, bound);
            assert!(weight(&places) <= bound && places.is_sorted(), "{places:?}");
            let smallest = units.iter().enumerate().filter(|(i, _)| !places.contains(i));
            let smallest = smallest.map(|(_, unit)| unit.weight).min().unwrap();
            assert!(weight(&places) + smallest > bound, "{places:?} leave room");
        }
        assert_eq!(drawn(&units, 10), [0], "the lightest");
        assert_eq!(drawn(&units, u64::MAX).len(), units.len());
    }
}
