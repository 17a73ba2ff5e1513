//! The experiments that take long: their names, parameters and runs, in one list.

use super::Need;
use super::accuracy::{analytic, bias, race, scale, trials};
use super::deep::Deep;
use super::experiment::How::{Cut, Whole};
use super::{
    chains, heat, history, horizon, independence, long, nucleation, orbits, protocol, protocols,
    restitution, seeds, spacetime, starts, sweep, tally, two_masses, weights,
};
use crate::params::{
    AnalyticParams, BiasParams, ChainsParams, HeatParams, HistoryParams, HorizonParams,
    IndependenceParams, NucleationParams, OrbitsParams, Profile, ProtocolParams, ProtocolsParams,
    RaceParams, RestitutionParams, ScaleParams, SeedsParams, SpaceTimeParams, StartsParams,
    SweepParams, TrialParams, TwoMassesParams,
};

pub use super::experiment::{Experiment, Saved};

/// The experiments that are saved, in the order in which they run.
const ALL: [&dyn Saved; 23] = [
    &SWEEP,
    &SECOND_SEED,
    &PROTOCOL,
    &PROTOCOLS,
    &STARTS,
    &HORIZON,
    &TWO_MASSES,
    &SPACE_TIME,
    &RACE,
    &BIAS,
    &TRIALS,
    &SCALE,
    &ANALYTIC,
    &HEAT,
    &NUCLEATION,
    &SEEDS,
    &HISTORY,
    &INDEPENDENCE,
    &ORBITS,
    &RESTITUTION,
    &CHAINS,
    &LONG_PROTOCOL,
    &SIZES,
];

/// Those of them that take long: a run of the profile `deep`, which is committed.
const LONG: [&dyn Saved; 11] = [
    &SECOND_SEED,
    &PROTOCOL,
    &PROTOCOLS,
    &STARTS,
    &BIAS,
    &HEAT,
    &INDEPENDENCE,
    &RESTITUTION,
    &CHAINS,
    &LONG_PROTOCOL,
    &SIZES,
];

/// The experiments of a profile: the deep one has those that take long, all others have all.
pub fn of(profile: Profile) -> &'static [&'static dyn Saved] {
    match profile {
        Profile::Deep => &LONG,
        _ => &ALL,
    }
}

/// The main sweep of Sec. 2.
pub const SWEEP: Experiment<SweepParams, sweep::Sweep, tally::Tally> = Experiment {
    need: Need::Sweep,
    module: "src/experiments/sweep.rs",
    parameters: SweepParams::main,
    how: Cut("main sweep", sweep::CUTTING),
};

/// The rise again, with another seed.
pub const SECOND_SEED: Deep<SweepParams, sweep::Sweep, tally::Tally> = Deep::new(
    Need::SecondSeed,
    "src/experiments/sweep.rs",
    SweepParams::second_seed,
    ("second seed", sweep::CUTTING),
);

/// Half height against transient and window.
pub const PROTOCOL: Deep<ProtocolParams, protocol::ProtocolMap, protocol::Part> = Deep::new(
    Need::Protocol,
    "src/experiments/protocol.rs",
    ProtocolParams::new,
    ("protocol map", protocol::CUTTING),
);

/// The same for other starts and ends.
pub const PROTOCOLS: Deep<ProtocolsParams, protocols::Protocols, protocol::Part> = Deep::new(
    Need::Protocols,
    "src/experiments/protocols.rs",
    ProtocolsParams::new,
    ("maps of other chains", protocols::CUTTING),
);

/// Other starts, boundaries, restitutions and frequencies.
pub const STARTS: Deep<StartsParams, starts::Starts, tally::Tally> = Deep::new(
    Need::Starts,
    "src/experiments/starts.rs",
    StartsParams::new,
    ("variants", starts::CUTTING),
);

/// Chaos and its horizon.
pub const HORIZON: Experiment<HorizonParams, horizon::Horizon> = Experiment {
    need: Need::Horizon,
    module: "src/experiments/horizon.rs",
    parameters: HorizonParams::new,
    how: Whole {
        run: horizon::run,
        weight: |p| 3 * p.realisations as u64 * weights::run(&p.chain, p.sigma, p.until) / 2,
    },
};

/// Two masses under a low force.
pub const TWO_MASSES: Experiment<TwoMassesParams, two_masses::TwoMasses> = Experiment {
    need: Need::TwoMasses,
    module: "src/experiments/two_masses.rs",
    parameters: TwoMassesParams::new,
    how: Whole {
        run: two_masses::run,
        weight: |p| p.directions as u64 * p.times.iter().map(|time| *time as u64).sum::<u64>() / 3,
    },
};

/// One long run.
pub const SPACE_TIME: Experiment<SpaceTimeParams, spacetime::SpaceTime> = Experiment {
    need: Need::SpaceTime,
    module: "src/experiments/spacetime.rs",
    parameters: SpaceTimeParams::new,
    how: Whole { run: spacetime::run, weight: |p| 8 * weights::run(&p.chain, p.sigma, p.until) },
};

/// Every method against the true motion.
pub const RACE: Experiment<RaceParams, race::Race> = Experiment {
    need: Need::Race,
    module: "src/experiments/accuracy/race.rs",
    parameters: RaceParams::new,
    how: Whole { run: race::run, weight: |p| 30_000 * (p.chains * p.settings.len()) as u64 },
};

/// What methods do to the mean count.
pub const BIAS: Deep<BiasParams, bias::Biases, bias::Part> = Deep::new(
    Need::Biases,
    "src/experiments/accuracy/bias.rs",
    BiasParams::new,
    ("bias of methods", bias::CUTTING),
);

/// Every method in the scenes where methods fail.
pub const TRIALS: Experiment<TrialParams, trials::Trials> = Experiment {
    need: Need::Trials,
    module: "src/experiments/accuracy/trials.rs",
    parameters: TrialParams::new,
    how: Whole {
        run: trials::run,
        weight: |p| if p.short { 100_000 } else { 1_100_000 } * p.settings.len() as u64,
    },
};

/// Counted work against the number of masses.
pub const SCALE: Experiment<ScaleParams, scale::Scale> = Experiment {
    need: Need::Scale,
    module: "src/experiments/accuracy/scale.rs",
    parameters: ScaleParams::new,
    how: Whole { run: scale::run, weight: |p| 300_000 + 7 * p.masses.iter().sum::<usize>() as u64 },
};

/// Ways to compute Eqs. (9) and (25).
pub const ANALYTIC: Experiment<AnalyticParams, analytic::Analytic> = Experiment {
    need: Need::Analytic,
    module: "src/experiments/accuracy/analytic.rs",
    parameters: AnalyticParams::new,
    how: Whole { run: analytic::run, weight: |p| 3 * p.sizes.iter().sum::<usize>() as u64 / 2 },
};

/// How hot running chains are.
pub const HEAT: Deep<HeatParams, heat::Heat, heat::Part> =
    Deep::new(Need::Heat, "src/experiments/heat/mod.rs", HeatParams::new, ("heat", heat::CUTTING));

/// First impacts of chains from rest.
pub const NUCLEATION: Experiment<NucleationParams, nucleation::Nucleation, nucleation::Part> =
    Experiment {
        need: Need::Nucleation,
        module: "src/experiments/nucleation.rs",
        parameters: NucleationParams::new,
        how: Cut("first impacts", nucleation::CUTTING),
    };

/// What one gap that closes by itself sets off.
pub const SEEDS: Experiment<SeedsParams, seeds::Seeds, seeds::Part> = Experiment {
    need: Need::Seeds,
    module: "src/experiments/seeds/mod.rs",
    parameters: SeedsParams::new,
    how: Cut("seeds", seeds::CUTTING),
};

/// Chains that are heated first.
pub const HISTORY: Experiment<HistoryParams, history::History, history::Part> = Experiment {
    need: Need::History,
    module: "src/experiments/history.rs",
    parameters: HistoryParams::new,
    how: Cut("history", history::CUTTING),
};

/// Whether impacts are independent.
pub const INDEPENDENCE: Deep<IndependenceParams, independence::Independence, independence::Part> =
    Deep::new(
        Need::Independence,
        "src/experiments/independence/mod.rs",
        IndependenceParams::new,
        ("independence", independence::CUTTING),
    );

/// Periodic orbits of a short chain.
pub const ORBITS: Experiment<OrbitsParams, orbits::Orbits> = Experiment {
    need: Need::Orbits,
    module: "src/experiments/orbits/mod.rs",
    parameters: OrbitsParams::new,
    how: Whole { run: orbits::run, weight: |p| 60 * orbits::starts(p) },
};

/// Long chains, damping and other forces.
pub const CHAINS: Deep<ChainsParams, chains::Chains, chains::Part> = Deep::new(
    Need::Chains,
    "src/experiments/chains/mod.rs",
    ChainsParams::new,
    ("long chains", chains::CUTTING),
);

/// Chains of several restitutions.
pub const RESTITUTION: Deep<RestitutionParams, restitution::Restitution, restitution::Part> =
    Deep::new(
        Need::Restitution,
        "src/experiments/restitution/mod.rs",
        RestitutionParams::new,
        ("restitution", restitution::CUTTING),
    );

/// The long end of the map over transients and windows.
pub const LONG_PROTOCOL: Deep<ProtocolParams, long::LongMap, protocol::Part> = Deep {
    from: Profile::Quick,
    distance: Some(long::distance),
    ..Deep::new(
        Need::LongProtocol,
        "src/experiments/long.rs",
        ProtocolParams::long,
        ("long protocol map", long::CUTTING),
    )
};

/// Chains of several lengths after several transients.
pub const SIZES: Deep<ChainsParams, chains::Chains, chains::Part> = Deep {
    from: Profile::Quick,
    ..Deep::new(
        Need::Sizes,
        "src/experiments/chains/mod.rs",
        ChainsParams::sizes,
        ("length and transient", chains::CUTTING),
    )
};
