//! Committed units, some of which are run again.

use super::super::cutting::Unit;
use super::super::experiment::{How, Json, Params, Run};
use super::super::identity::Identity;
use super::super::store::written;
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

/// Committed units, and the places of those that are run again.
pub struct Audited<'a, P: 'static, T: 'static, U: 'static> {
    deep: &'a Deep<P, T, U>,
    units: Vec<Unit>,
    drawn: Vec<usize>,
}

/// The audit of an experiment, as one unit of work.
pub(super) fn of<P: Params, T: Json, U: Json>(
    deep: &Deep<P, T, U>,
    profile: Profile,
) -> Run<Audited<'_, P, T, U>, Audit, ()> {
    let committed = AuditParams { committed: deep.digest(), work: work(profile) };
    let own = Identity::new(deep.name, Code { file: FILE, ..deep.code }, &committed);
    let units = deep.cut.1.units(&(deep.parameters)(Profile::Deep));
    let drawn = drawn(&units, work(profile));
    Run {
        name: deep.name,
        profile,
        identity: deep.made_of().with_code(own),
        parameters: Audited { deep, units, drawn },
        how: How::Whole {
            run: Audited::get,
            weight: |own| own.chosen().map(|unit| unit.weight).sum(),
        },
        fails: |audit| audit.verdict == Carriage::Failed,
    }
}

impl<P: Params, T: Json, U: Json> Audited<'_, P, T, U> {
    fn chosen(&self) -> impl Iterator<Item = &Unit> {
        self.drawn.iter().map(|&place| &self.units[place])
    }

    /// The audit.
    pub fn get(&self, progress: &Progress) -> Result<Audit, Error> {
        let Audited { deep, units, drawn } = self;
        let given = deep.given()?;
        let chosen: Vec<&Unit> = self.chosen().collect();
        let (words, cutting) = &deep.cut;
        let parameters = (deep.parameters)(Profile::Deep);
        let again = cutting.given(&parameters, &chosen, words, progress)?;
        let bytes = |own: &U| written(deep.name, own);
        let mut identical = 0;
        for (&place, own) in drawn.iter().zip(&again) {
            identical += usize::from(bytes(own)? == bytes(&given[place])?);
        }
        let all = identical == again.len();
        let number = again.len();
        let distance = match deep.distance {
            Some(distance) if !all => {
                let parts: Vec<(&Unit, U)> = chosen.into_iter().zip(again).collect();
                Some(distance(&deep.joined(given, progress)?, &parts))
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
}
