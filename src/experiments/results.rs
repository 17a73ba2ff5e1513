//! All results together.

use super::accuracy::{analytic, bias, race, scale, trials};
use super::{Error, Measured, Need};
use super::{
    chains, deep, heat, history, horizon, identities, independence, laws, long, nucleation, orbits,
    protocol, protocols, restitution, seeds, segments, spacetime, starts, sweep, theory,
    two_masses,
};
use crate::params::{Profile, VERTICES};
use crate::table::Table;
use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock, OnceLock};

/// What is computed when it is first looked at.
pub type Looked<T> = LazyLock<T, Box<dyn FnOnce() -> T + Send>>;

/// All results: what is `None` was not asked for.
#[derive(Debug)]
pub struct Results {
    /// The sample sizes.
    pub profile: Profile,
    /// Secs. 3 to 9, computed when first looked at: `&results.theory.curve` is all it takes.
    pub theory: Looked<theory::Theory>,
    /// Exact statements of Secs. 3 to 9 against a second route, computed when first looked at.
    pub identities: Looked<identities::Identities>,
    /// The main sweep of Sec. 2.
    pub sweep: Option<sweep::Sweep>,
    /// The rise again, with another seed.
    pub second_seed: Option<sweep::Sweep>,
    /// Half height against transient and window.
    pub protocol: Option<protocol::ProtocolMap>,
    /// The same for other starts and ends.
    pub protocols: Option<protocols::Protocols>,
    /// Other starts, boundaries, restitutions and frequencies.
    pub starts: Option<starts::Starts>,
    /// Three-way impacts and sticking.
    pub laws: Option<laws::Laws>,
    /// Chaos and its horizon.
    pub horizon: Option<horizon::Horizon>,
    /// Two masses under a low force.
    pub two_masses: Option<two_masses::TwoMasses>,
    /// The motions of Figs. 5(b) and 6(b).
    pub segments: Option<segments::Segments>,
    /// One long run.
    pub spacetime: Option<spacetime::SpaceTime>,
    /// Every method against the true motion.
    pub race: Option<race::Race>,
    /// What methods do to the mean count.
    pub biases: Option<bias::Biases>,
    /// Every method in the scenes where methods fail.
    pub trials: Option<trials::Trials>,
    /// Counted work against the number of masses.
    pub scale: Option<scale::Scale>,
    /// Ways to compute Eqs. (9) and (25).
    pub analytic: Option<analytic::Analytic>,
    /// Times that were measured once.
    pub measured: Option<Measured>,
    /// How hot running chains are.
    pub heat: Option<heat::Heat>,
    /// First impacts of chains from rest.
    pub nucleation: Option<nucleation::Nucleation>,
    /// What one gap that closes by itself sets off.
    pub seeds: Option<seeds::Seeds>,
    /// Counts after a larger force.
    pub history: Option<history::History>,
    /// Whether impacts are independent.
    pub independence: Option<independence::Independence>,
    /// Periodic orbits of a short chain.
    pub orbits: Option<orbits::Orbits>,
    /// Chains of several restitutions.
    pub restitution: Option<restitution::Restitution>,
    /// Long chains, damping and other forces.
    pub chains: Option<chains::Chains>,
    /// The long end of the map.
    pub long_protocol: Option<long::LongMap>,
    /// Chains of several lengths after several transients.
    pub sizes: Option<chains::Chains>,
    /// Tables of the results, made when first looked at.
    pub tables: OnceLock<BTreeMap<&'static str, Arc<Table>>>,
    /// Of each result that is carried over, by the name of its experiment, what became of a sample.
    pub audits: BTreeMap<String, deep::Audit>,
}

macro_rules! asked_for {
    ($($(#[$doc:meta])* $name:ident: $type:ty, $need:ident;)*) => {
        impl Results {
            $(
                $(#[$doc])*
                ///
                /// # Errors
                /// [`Error::NotRun`] if it was not asked for.
                pub fn $name(&self) -> Result<&$type, Error> {
                    self.$name.as_ref().ok_or(Error::NotRun(Need::$need))
                }
            )*
        }
    };
}

asked_for! {
    /// The main sweep.
    sweep: sweep::Sweep, Sweep;
    /// The repetition with another seed.
    second_seed: sweep::Sweep, SecondSeed;
    /// The map over protocols.
    protocol: protocol::ProtocolMap, Protocol;
    /// The maps of other chains.
    protocols: protocols::Protocols, Protocols;
    /// The variants.
    starts: starts::Starts, Starts;
    /// The laws.
    laws: laws::Laws, Laws;
    /// The horizon.
    horizon: horizon::Horizon, Horizon;
    /// Two masses.
    two_masses: two_masses::TwoMasses, TwoMasses;
    /// The segments.
    segments: segments::Segments, Segments;
    /// The long run.
    spacetime: spacetime::SpaceTime, SpaceTime;
    /// The methods against the truth.
    race: race::Race, Race;
    /// The bias of the methods.
    biases: bias::Biases, Biases;
    /// The scenes where methods fail.
    trials: trials::Trials, Trials;
    /// Work against size.
    scale: scale::Scale, Scale;
    /// The analytic methods.
    analytic: analytic::Analytic, Analytic;
    /// The measured times.
    measured: Measured, Measured;
    /// How hot running chains are.
    heat: heat::Heat, Heat;
    /// First impacts.
    nucleation: nucleation::Nucleation, Nucleation;
    /// What one gap sets off.
    seeds: seeds::Seeds, Seeds;
    /// Counts after a larger force.
    history: history::History, History;
    /// Whether impacts are independent.
    independence: independence::Independence, Independence;
    /// Periodic orbits of a short chain.
    orbits: orbits::Orbits, Orbits;
    /// Chains of several restitutions.
    restitution: restitution::Restitution, Restitution;
    /// Long chains, damping and other forces.
    chains: chains::Chains, Chains;
    /// The long end of the map.
    long_protocol: long::LongMap, LongProtocol;
    /// Length and transient.
    sizes: chains::Chains, Sizes;
}

impl Results {
    /// Computes what is otherwise computed when first looked at. Who works on several threads looks
    /// first.
    pub fn look(&self) {
        rayon::join(|| LazyLock::force(&self.theory), || LazyLock::force(&self.identities));
    }

    /// The tables of all results that there are, by name.
    pub fn tables(&self) -> &BTreeMap<&'static str, Arc<Table>> {
        self.tables.get_or_init(|| {
            let heat = self.heat.iter().flat_map(heat::tables::tables);
            let restitution = self.restitution.iter().flat_map(restitution::tables::tables);
            heat.chain(restitution).map(|table| (table.name(), Arc::new(table))).collect()
        })
    }

    /// One of the tables.
    ///
    /// # Errors
    /// [`Error::NotRun`] if its experiment was not asked for.
    pub fn table(&self, need: Need, name: &str) -> Result<&Table, Error> {
        self.tables().get(name).map(Arc::as_ref).ok_or(Error::NotRun(need))
    }

    /// Results of which nothing was run yet.
    pub fn empty(profile: Profile) -> Self {
        Results {
            profile,
            theory: LazyLock::new(Box::new(|| {
                theory::run(VERTICES).expect("the theory exists for the paper's N")
            })),
            identities: LazyLock::new(Box::new(|| {
                identities::run(VERTICES).expect("the theory exists for the paper's N")
            })),
            sweep: None,
            second_seed: None,
            protocol: None,
            protocols: None,
            starts: None,
            laws: None,
            horizon: None,
            two_masses: None,
            segments: None,
            spacetime: None,
            race: None,
            biases: None,
            trials: None,
            scale: None,
            analytic: None,
            measured: None,
            heat: None,
            nucleation: None,
            seeds: None,
            history: None,
            independence: None,
            orbits: None,
            restitution: None,
            chains: None,
            long_protocol: None,
            sizes: None,
            tables: OnceLock::new(),
            audits: BTreeMap::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_not_run_is_an_error() {
        let results = Results::empty(Profile::Quick);
        assert!(matches!(results.laws(), Err(Error::NotRun(Need::Laws))));
    }
}
