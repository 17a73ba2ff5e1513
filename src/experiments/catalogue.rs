//! The experiments that take long: their names, parameters and runs, in one list.

use super::accuracy::{analytic, bias, race, scale, trials};
use super::store::{Identity, Reason, Store, told, written};
use super::{Error, Need, Progress};
use super::{horizon, protocol, spacetime, starts, sweep, two_masses};
use crate::params::{
    AnalyticParams, BiasParams, HorizonParams, Profile, ProtocolParams, RaceParams, ScaleParams,
    SpaceTimeParams, StartsParams, SweepParams, TrialParams, TwoMassesParams,
};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// An experiment whose result is saved.
pub struct Experiment<P, T> {
    /// What it is needed for; its name is that of the experiment.
    pub need: Need,
    /// The file of its code.
    module: &'static str,
    /// Its parameters in a profile.
    parameters: fn(Profile) -> P,
    run: fn(&P, &Progress) -> Result<T, Error>,
}

impl<P: Serialize, T: Serialize + DeserializeOwned + PartialEq> Experiment<P, T> {
    /// The result: the saved one if it is fresh, else that of a run.
    ///
    /// # Errors
    /// As [`Store::get`].
    pub fn get(&self, profile: Profile, store: &Store, progress: &Progress) -> Result<T, Error> {
        let parameters = (self.parameters)(profile);
        let identity = self.identity(&parameters);
        store.get(&identity, profile, progress, || (self.run)(&parameters, progress))
    }

    fn identity(&self, parameters: &P) -> Identity {
        Identity::new(self.need.name(), self.module, parameters)
    }
}

/// What can be asked of every experiment, whatever its parameters and result are.
pub trait Saved: Sync {
    /// What it is needed for.
    fn need(&self) -> Need;

    /// What its result depends on.
    fn identity(&self, profile: Profile) -> Identity;

    /// Why its saved result is not to be used; nothing if it is fresh.
    fn stale(&self, profile: Profile, store: &Store) -> Vec<Reason>;

    /// Runs it again and compares with the fresh saved result, byte by byte.
    ///
    /// # Errors
    /// As [`Experiment::get`]; [`Error::Stale`] if there is none that is fresh.
    fn audit(&self, profile: Profile, store: &Store, progress: &Progress) -> Result<bool, Error>;
}

impl<P: Serialize, T: Serialize + DeserializeOwned + PartialEq> Saved for Experiment<P, T> {
    fn need(&self) -> Need {
        self.need
    }

    fn identity(&self, profile: Profile) -> Identity {
        Experiment::identity(self, &(self.parameters)(profile))
    }

    fn stale(&self, profile: Profile, store: &Store) -> Vec<Reason> {
        match store.look(&Saved::identity(self, profile), profile) {
            Ok(text) if serde_json::from_str::<T>(&text).is_ok() => Vec::new(),
            Ok(_) => vec![Reason::Schema],
            Err(reasons) => reasons,
        }
    }

    fn audit(&self, profile: Profile, store: &Store, progress: &Progress) -> Result<bool, Error> {
        let name = self.need.name();
        let saved = store.look(&Saved::identity(self, profile), profile);
        let saved = saved.map_err(|reasons| Error::Stale { name, why: told(&reasons) })?;
        let again = (self.run)(&(self.parameters)(profile), progress)?;
        Ok(written(name, &again)? == saved)
    }
}

/// The experiments that are saved, in the order in which they run.
pub const ALL: [&dyn Saved; 12] = [
    &SWEEP,
    &SECOND_SEED,
    &PROTOCOL,
    &STARTS,
    &HORIZON,
    &TWO_MASSES,
    &SPACE_TIME,
    &RACE,
    &BIAS,
    &TRIALS,
    &SCALE,
    &ANALYTIC,
];

/// The main sweep of Sec. 2.
pub const SWEEP: Experiment<SweepParams, sweep::Sweep> = Experiment {
    need: Need::Sweep,
    module: "src/experiments/sweep.rs",
    parameters: SweepParams::main,
    run: |parameters, progress| sweep::run(parameters, "main sweep", progress),
};

/// The rise again, with another seed.
pub const SECOND_SEED: Experiment<SweepParams, sweep::Sweep> = Experiment {
    need: Need::SecondSeed,
    module: "src/experiments/sweep.rs",
    parameters: SweepParams::second_seed,
    run: |parameters, progress| sweep::run(parameters, "second seed", progress),
};

/// Half height against transient and window.
pub const PROTOCOL: Experiment<ProtocolParams, protocol::ProtocolMap> = Experiment {
    need: Need::Protocol,
    module: "src/experiments/protocol.rs",
    parameters: ProtocolParams::new,
    run: protocol::run,
};

/// Other starts, boundaries, restitutions and frequencies.
pub const STARTS: Experiment<StartsParams, starts::Starts> = Experiment {
    need: Need::Starts,
    module: "src/experiments/starts.rs",
    parameters: StartsParams::new,
    run: starts::run,
};

/// Chaos and its horizon.
pub const HORIZON: Experiment<HorizonParams, horizon::Horizon> = Experiment {
    need: Need::Horizon,
    module: "src/experiments/horizon.rs",
    parameters: HorizonParams::new,
    run: horizon::run,
};

/// Two masses under a low force.
pub const TWO_MASSES: Experiment<TwoMassesParams, two_masses::TwoMasses> = Experiment {
    need: Need::TwoMasses,
    module: "src/experiments/two_masses.rs",
    parameters: TwoMassesParams::new,
    run: two_masses::run,
};

/// One long run.
pub const SPACE_TIME: Experiment<SpaceTimeParams, spacetime::SpaceTime> = Experiment {
    need: Need::SpaceTime,
    module: "src/experiments/spacetime.rs",
    parameters: SpaceTimeParams::new,
    run: spacetime::run,
};

/// Every method against the true motion.
pub const RACE: Experiment<RaceParams, race::Race> = Experiment {
    need: Need::Race,
    module: "src/experiments/accuracy/race.rs",
    parameters: RaceParams::new,
    run: race::run,
};

/// What methods do to the mean count.
pub const BIAS: Experiment<BiasParams, bias::Biases> = Experiment {
    need: Need::Biases,
    module: "src/experiments/accuracy/bias.rs",
    parameters: BiasParams::new,
    run: bias::run,
};

/// Every method in the scenes where methods fail.
pub const TRIALS: Experiment<TrialParams, trials::Trials> = Experiment {
    need: Need::Trials,
    module: "src/experiments/accuracy/trials.rs",
    parameters: TrialParams::new,
    run: trials::run,
};

/// Counted work against the number of masses.
pub const SCALE: Experiment<ScaleParams, scale::Scale> = Experiment {
    need: Need::Scale,
    module: "src/experiments/accuracy/scale.rs",
    parameters: ScaleParams::new,
    run: scale::run,
};

/// Ways to compute Eqs. (9) and (25).
pub const ANALYTIC: Experiment<AnalyticParams, analytic::Analytic> = Experiment {
    need: Need::Analytic,
    module: "src/experiments/accuracy/analytic.rs",
    parameters: AnalyticParams::new,
    run: analytic::run,
};
