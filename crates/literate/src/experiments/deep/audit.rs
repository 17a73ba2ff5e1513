//! Committed units, some of which are run again.

use super::super::cutting::Unit;
use super::super::experiment::{Json, Saved};
use super::super::identity::{Identity, Reason, told};
use super::super::store::{Store, written};
use super::super::{Code, Error, Profile, Progress};
use super::Deep;
use impact_numerics::random::generator;
use rand::seq::SliceRandom;
use serde::{Deserialize, Serialize};

/// The file of this code: an audit depends on it.
const FILE: &str = "crates/literate/src/experiments/deep/audit.rs";

/// The seed by which units are drawn: any number.
const SEED: u64 = 2007;

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
pub(super) fn work(profile: Profile) -> u64 {
    match profile {
        Profile::Quick => 200_000,
        Profile::Ci => 1_000_000,
        Profile::Full | Profile::Deep => 2_000_000,
    }
}

/// The places of units drawn by lot, rising, up to so much work; at least the lightest.
pub(super) fn drawn(units: &[Unit], work: u64) -> Vec<usize> {
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

/// The audit of an experiment as an experiment of its own: one unit of work, the result is an
/// [`Audit`].
pub struct Audited<'a, P: 'static, T: 'static, U: 'static>(pub &'a Deep<P, T, U>);

impl<P: Serialize + Sync, T: Json, U: Json> Audited<'_, P, T, U> {
    /// The audit: the saved one if it is fresh, else a new one.
    pub fn get(
        &self,
        profile: Profile,
        store: &Store,
        progress: &Progress,
    ) -> Result<Audit, Error> {
        let identity = self.identity(profile);
        store.get(&identity, profile, progress, || self.run(profile, progress))
    }

    /// The units of the whole, and the places of those that a profile runs again.
    fn drawn(&self, profile: Profile) -> (Vec<Unit>, Vec<usize>) {
        let units = self.0.units(Profile::Deep);
        let drawn = drawn(&units, work(profile));
        (units, drawn)
    }

    fn run(&self, profile: Profile, progress: &Progress) -> Result<Audit, Error> {
        let given = self.0.given()?;
        let (units, drawn) = self.drawn(profile);
        let chosen: Vec<&Unit> = drawn.iter().map(|&place| &units[place]).collect();
        let (words, cutting) = &self.0.cut;
        let parameters = (self.0.parameters)(Profile::Deep);
        let again = cutting.given(&parameters, &chosen, words, progress)?;
        let bytes = |own: &U| written(self.name(), own);
        let mut identical = 0;
        for (&place, own) in drawn.iter().zip(&again) {
            identical += usize::from(bytes(own)? == bytes(&given[place])?);
        }
        let all = identical == again.len();
        let number = again.len();
        let distance = match self.0.distance {
            Some(distance) if !all => {
                let parts: Vec<(&Unit, U)> = chosen.into_iter().zip(again).collect();
                Some(distance(&self.0.joined(given, progress)?, &parts))
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

    fn read(&self, text: &str) -> Result<Audit, Error> {
        serde_json::from_str(text).map_err(|_| Error::NotUnderstood { name: self.name() })
    }

    /// A saved audit that is fresh.
    fn look(&self, profile: Profile, store: &Store) -> Result<Audit, Vec<Reason>> {
        let text = store.look(&self.identity(profile), profile)?;
        self.read(&text).map_err(|_| vec![Reason::Schema])
    }
}

impl<P: Serialize + Sync, T: Json, U: Json> Saved for Audited<'_, P, T, U> {
    fn name(&self) -> &'static str {
        self.0.name
    }

    fn identity(&self, profile: Profile) -> Identity {
        let audit = AuditParams { committed: self.0.digest(), work: work(profile) };
        self.0.made_of().with_code(Identity::new(
            self.name(),
            Code { file: FILE, ..self.0.code },
            &audit,
        ))
    }

    fn parameters(&self, _: Profile) -> serde_json::Value {
        self.0.made_of().parameters
    }

    fn stale(&self, profile: Profile, store: &Store) -> Vec<Reason> {
        match self.look(profile, store) {
            Ok(Audit { verdict: Carriage::Failed, .. }) => vec![Reason::Failed],
            Ok(_) => Vec::new(),
            Err(reasons) => reasons,
        }
    }

    fn audit(&self, profile: Profile, store: &Store, progress: &Progress) -> Result<bool, Error> {
        let stale = |why: Vec<Reason>| Error::Stale { name: self.name(), why: told(&why) };
        Ok(self.look(profile, store).map_err(stale)? == self.run(profile, progress)?)
    }

    fn units(&self, profile: Profile) -> Vec<Unit> {
        let (units, drawn) = self.drawn(profile);
        let weight = drawn.iter().map(|&place| units[place].weight).sum();
        vec![Unit { row: 0, realisations: 0..0, covers: "an audit".into(), weight }]
    }

    fn run_units(
        &self,
        profile: Profile,
        units: &[(&Unit, Identity)],
        store: &Store,
        progress: &Progress,
    ) -> Result<(), Error> {
        units.iter().try_for_each(|(_, identity)| {
            store.put(identity, profile, &self.run(profile, progress)?)
        })
    }

    fn understands(&self, _: Profile, _: &Unit, text: &str) -> bool {
        self.read(text).is_ok()
    }

    fn merge(
        &self,
        profile: Profile,
        texts: &[String],
        store: &Store,
        _: &Progress,
    ) -> Result<(), Error> {
        store.put(&self.identity(profile), profile, &self.read(&texts.concat())?)
    }
}
