//! Makes the paper with its experiments alone, and names what all saved results depend on.

use super::list::{ALL, DERIVED};
use literate::{Paper, Project};

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
