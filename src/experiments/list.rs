//! Lists the experiments in the order in which they run, and the tables that need several.

use super::{accuracy, identities, seeds, starts, theory};
use crate::params;
use literate::experiments::experiment::How::Read;
use literate::experiments::{AnyExperiment, DerivedTables, Experiment};
use literate::{Paper, Project, Sources};

pub const ALL: &[&dyn AnyExperiment] = &[
    &THEORY,
    &super::SEGMENTS,
    &super::MEASURED,
    &super::SWEEP,
    &super::SECOND_SEED,
    &super::MODE_JUMP,
    &super::PROTOCOL,
    &super::STARTS,
    &super::HORIZON,
    &super::TWO_MASSES,
    &super::SPACE_TIME,
    &super::RACE,
    &super::BIAS,
    &super::TRIALS,
    &super::PROGRAMS,
    &super::SCALE,
    &super::NUCLEATION,
    &super::SEEDS,
    &super::RESTITUTION,
    &super::LENGTHS,
    &super::BRANCHES,
    &super::REPLAY,
];

const DERIVED: [DerivedTables; 4] = [
    theory::comparison::tables,
    seeds::compared::tables,
    starts::against_theory,
    accuracy::answers::tables,
];

/// The graph theory, which costs nothing and is never saved.
pub const THEORY: Experiment<serde_json::Value, ()> = Experiment {
    name: "theory",
    own: &["src/experiments/theory", "src/experiments/identities"],
    reads: &[],
    parameters: |_| serde_json::json!({ "N": params::VERTICES }),
    how: Read(|_| Ok(())),
    tables: |()| {
        let (theory, identities) = rayon::join(theory::tables, identities::tables);
        [theory, identities].concat()
    },
};

/// Units of work are cut in the first, and sums of their parts are rounded so.
const SHARED: &[&str] =
    &["crates/literate/src/experiments/cutting.rs", "src/experiments/ensembles.rs"];

/// Code that changes no result, and why.
const APART: &[(&str, &str)] = &[
    ("crates/literate", "runs experiments and saves their results, and computes none"),
    ("crates/sources", "hands over the source"),
    ("crates/page", "computes in the reader's browser"),
    ("README.md", "is documentation"),
    ("src/main.rs", "is the command line, as is the next"),
    ("src/cli", "starts single chains"),
    ("src/figures", "draws results"),
    ("src/claims", "judges results"),
    ("src/contents.rs", "shows results, as do the next two"),
    ("src/equations.rs", "lists equations"),
    ("src/lab.rs", "hands results to pages"),
    ("src/lib.rs", "puts the paper together"),
    ("src/experiments/mod.rs", "declares modules"),
    ("src/experiments/prelude.rs", "names what stands elsewhere"),
    ("src/experiments/list.rs", "lists experiments"),
    ("/tables.rs", "tables are computed from saved results each time"),
    ("/answers.rs", "so are these"),
    ("src/experiments/sweep.rs", "has tables only, as have the next four"),
    ("src/experiments/protocol.rs", "tables of an ensemble"),
    ("src/experiments/starts.rs", "tables of an ensemble"),
    ("src/experiments/lengths.rs", "tables of an ensemble"),
    ("src/experiments/restitution.rs", "tables of an ensemble"),
    ("src/experiments/seeds/compared.rs", "compares saved results"),
    ("templates", "numbers that it prints are parameters, which are compared"),
    ("benches", "has times, which are read and not saved"),
    ("feature embed", "puts texts into the program"),
];

/// The crates as paths of items name them, and the folders of their source.
const CRATES: &[(&str, &str)] = &[
    ("impact_numerics", "crates/numerics/src"),
    ("impact_chain", "crates/impact-chain/src"),
    ("impact_circuits", "crates/circuits/src"),
    ("literate", "crates/literate/src"),
    ("", "src"),
];

/// Returns the paper with its experiments, without figures, claims and documents.
pub fn bare() -> Paper {
    let sources = Sources {
        crates: CRATES,
        ..literate::sources!(
            "src",
            "crates/numerics/src",
            "crates/impact-chain/src",
            "crates/circuits/src",
            "crates/literate/src",
            "crates/page/src"
        )
    };
    let title = "A literate, reproducible edition of Homer & Hogan (2007), Impact Dynamics of Large Dimensional Systems";
    let project = Project { shared: SHARED, apart: APART, ..Project::new(sources) };
    #[cfg(feature = "embed")]
    let project = Project {
        copy: literate::texts!("templates", "benches/measured.json", "benches/scenes.json"),
        ..project
    };
    let mut paper = Paper {
        project,
        prose: "templates",
        experiments: ALL.to_vec(),
        derived: DERIVED.to_vec(),
        ..Paper::new(title, sources)
    };
    paper.edition.documents.clear();
    paper
}
