//! What is run: one file for each experiment, and the list of them ([`ALL`]): names, parameters, runs and tables. The
//! whole program uses this list. [`literate::experiments`] saves them and cuts them into units.

// Functions take parameters and results as the types that an experiment declares, also vectors.
#![allow(clippy::ptr_arg)]

pub mod accuracy;
pub mod branches;
pub mod ensembles;
pub mod horizon;
pub mod identities;
pub mod measured;
pub mod nucleation;
pub mod protocol;
pub mod replay;
pub mod seeds;
pub mod segments;
pub mod spacetime;
pub mod starts;
pub mod sweep;
pub mod theory;
pub mod two_masses;

pub(crate) mod prelude {
    pub use super::ensembles::{each, named};
    pub use super::{Error, Progress, Results, Session};
    pub use crate::params::Chain;
    pub use impact_chain::methods::State;
    pub use impact_chain::rise::{Counted, Curve};
    pub use impact_chain::{Engine, Impact, Scenario};
    pub use impact_numerics::estimates::{average, difference, share, with_error};
    pub use impact_numerics::random::NormalPairs;
    pub use impact_numerics::statistics::Estimate;
    pub use literate::table::Table;
    pub use literate::value::origin;
    pub use serde::{Deserialize, Serialize};

    /// Unit of σ and of forces.
    pub const SIGMA: &str = "d omega^2";
    /// Unit of times.
    pub const TIME: &str = "1/omega";
}

pub use impact_chain::rise;
pub use literate::experiments::{
    AnyExperiment, DerivedTables, Error, Experiment, Progress, Results, Session, Store, alive, say,
};
pub use measured::Measured;

use crate::params::{
    self, BiasParams, NucleationParams, Profile, RaceParams, Runs, ScaleParams, SeedsParams,
    TrialParams, TwoMassesParams,
};
use accuracy::{bias, race, scale, tables, trials};
use ensembles::CUTTING;
use impact_chain::rise::Counted;
use impact_chain::{Counts, Ensemble};
use literate::experiments::experiment::How::{Cut, Read, Whole};
use literate::table::Table;
use literate::{Paper, Project};

/// All experiments, in the order in which they run.
pub const ALL: &[&'static dyn AnyExperiment] = &[
    &THEORY,
    &SEGMENTS,
    &MEASURED,
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
    &NUCLEATION,
    &SEEDS,
    &RESTITUTION,
    &BRANCHES,
    &REPLAY,
];

/// Tables that need several experiments.
pub const DERIVED: [DerivedTables; 3] =
    [theory::beside::tables, seeds::compared::tables, starts::beside_theory];

/// What every result depends on.
const SHARED: &[&str] = &[
    "Cargo.lock",
    "crates/numerics/src",
    "crates/impact-chain/src",
    "crates/circuits/src",
    "crates/literate/src/experiments/cutting.rs",
    "src/params.rs",
    "src/params",
    "src/experiments/ensembles.rs",
];

/// The paper with its experiments, without figures, claims and documents.
pub fn bare() -> Paper {
    let sources = literate::sources!("src", "crates");
    let project = Project::new(sources);
    let title = "A literate, reproducible edition of Homer & Hogan (2007), Impact Dynamics of Large Dimensional Systems";
    // Tables are computed from saved results each time, so their code makes no result stale.
    let project = Project { shared: SHARED, left_out: &["/tables.rs"], ..project };
    #[cfg(feature = "embed")]
    let project =
        Project { copy: literate::texts!("templates", "benches/measured.json"), ..project };
    Paper {
        project,
        prose: "templates",
        documents: Vec::new(),
        experiments: ALL.to_vec(),
        derived: DERIVED.to_vec(),
        ..Paper::new(title, sources)
    }
}

/// The graph theory, which costs nothing and is never saved.
pub const THEORY: Experiment<serde_json::Value, ()> = Experiment {
    name: "theory",
    code: &["src/experiments/theory"],
    parameters: |_| serde_json::json!({ "N": params::VERTICES }),
    how: Read(|_| Ok(())),
    tables: |()| {
        let (theory, identities) = rayon::join(theory::tables, identities::tables);
        [theory, identities].concat()
    },
};

/// The motions of Figs. 5(b) and 6(b).
pub const SEGMENTS: Experiment<(), segments::Segments> = Experiment {
    name: "segments",
    code: &["src/experiments/segments.rs"],
    parameters: |_| (),
    how: Read(segments::read),
    tables: segments::tables,
};

/// Times that were measured once.
pub const MEASURED: Experiment<(), Measured> = Experiment {
    name: "measured",
    code: &["src/experiments/measured.rs", measured::FILE],
    parameters: |_| (),
    how: Read(Measured::committed),
    tables: measured::tables,
};

/// An experiment that is ensembles of chains.
pub type Ensembles = Experiment<Vec<Ensemble>, Vec<Counted>, Counts>;

const fn ensembles(
    name: &'static str,
    title: &'static str,
    parameters: fn(Profile) -> Vec<Ensemble>,
    tables: fn(&Vec<Counted>) -> Vec<Table>,
) -> Ensembles {
    let code = &["src/experiments/ensembles.rs"];
    Experiment { name, code, parameters, how: Cut(title, CUTTING), tables }
}

/// The main sweep of Sec. 2.
pub const SWEEP: Ensembles = ensembles("sweep", "main sweep", params::sweep, sweep::tables);

/// The rise again, with another seed.
pub const SECOND_SEED: Ensembles =
    ensembles("second_seed", "second seed", params::second_seed, sweep::of_second_seed);

/// Half height against transient and window.
pub const PROTOCOL: Ensembles =
    ensembles("protocol", "protocol map", params::protocol, protocol::tables);

/// Other starts, boundaries, restitutions and frequencies.
pub const STARTS: Ensembles = ensembles("starts", "variants", params::starts, starts::tables);

/// Chaos and its horizon.
pub const HORIZON: Experiment<Runs, horizon::Horizon> = Experiment {
    name: "horizon",
    code: &["src/experiments/horizon.rs"],
    parameters: Runs::horizon,
    how: Whole(horizon::run),
    tables: horizon::tables,
};

/// Two masses under a low force.
pub const TWO_MASSES: Experiment<TwoMassesParams, two_masses::TwoMasses> = Experiment {
    name: "two_masses",
    code: &["src/experiments/two_masses.rs"],
    parameters: TwoMassesParams::new,
    how: Whole(two_masses::run),
    tables: two_masses::tables,
};

/// One long run.
pub const SPACE_TIME: Experiment<Runs, spacetime::SpaceTime> = Experiment {
    name: "spacetime",
    code: &["src/experiments/spacetime.rs"],
    parameters: Runs::spacetime,
    how: Whole(spacetime::run),
    tables: spacetime::tables,
};

/// Every method against the true motion.
pub const RACE: Experiment<RaceParams, race::Race> = Experiment {
    name: "race",
    code: &[
        "src/experiments/accuracy/race.rs",
        "src/experiments/accuracy",
        "src/experiments/horizon.rs",
    ],
    parameters: RaceParams::new,
    how: Whole(race::run),
    tables: tables::race,
};

/// The errors of methods in the mean count.
pub const BIAS: Experiment<BiasParams, bias::Biases> = Experiment {
    name: "bias",
    code: &["src/experiments/accuracy/bias.rs", "src/experiments/accuracy"],
    parameters: BiasParams::new,
    how: Whole(bias::run),
    tables: tables::bias,
};

/// Every method in the scenes where methods fail.
pub const TRIALS: Experiment<TrialParams, trials::Trials> = Experiment {
    name: "trials",
    code: &["src/experiments/accuracy/trials.rs", "src/experiments/accuracy"],
    parameters: TrialParams::new,
    how: Whole(trials::run),
    tables: |_| Vec::new(),
};

/// Counted work against the number of masses.
pub const SCALE: Experiment<ScaleParams, scale::Scale> = Experiment {
    name: "scale",
    code: &["src/experiments/accuracy/scale.rs", "src/experiments/accuracy"],
    parameters: ScaleParams::new,
    how: Whole(scale::run),
    tables: tables::scale,
};

/// First impacts of chains from rest.
pub const NUCLEATION: Experiment<NucleationParams, nucleation::Nucleation> = Experiment {
    name: "nucleation",
    code: &["src/experiments/nucleation"],
    parameters: NucleationParams::new,
    how: Whole(nucleation::run),
    tables: nucleation::tables::tables,
};

/// How impacts spread from one gap that closes by itself.
pub const SEEDS: Experiment<SeedsParams, seeds::Seeds> = Experiment {
    name: "seeds",
    code: &["src/experiments/seeds"],
    parameters: SeedsParams::new,
    how: Whole(seeds::run),
    tables: seeds::tables::tables,
};

/// Chains of several restitutions.
pub const RESTITUTION: Ensembles =
    ensembles("restitution", "restitution", params::restitution, starts::of_restitutions);

/// Chains from rest and from above, of several lengths, after several transients.
pub const BRANCHES: Ensembles =
    ensembles("branches", "branches", params::branches, branches::tables);

/// Runs that a page repeats.
pub const REPLAY: Experiment<replay::ReplayRuns, replay::Replays> = Experiment {
    name: "replay",
    code: &["src/experiments/replay.rs"],
    parameters: replay::runs,
    how: Whole(replay::run),
    tables: replay::tables,
};
