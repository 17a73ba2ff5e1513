//! What results were made of: each is used again only by the code that would compute it again to the same bits.
//!
//! A change of prose, of a figure, of a verdict or of another experiment leaves it as it is.

use literate::experiments::Code;
use std::collections::BTreeMap;

/// Path and hash of Cargo.lock and of every source file.
pub const FILES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/fingerprint.rs"));

/// What all experiments depend on. An experiment that uses files of another one names them too.
const SHARED: [&str; 8] = [
    "Cargo.lock",
    "crates/numerics/src",
    "crates/impact-chain/src",
    "crates/circuits/src",
    "crates/literate/src/experiments/cutting.rs",
    "src/params.rs",
    "src/params",
    "src/experiments/ensembles.rs",
];

/// Whether a file changes no result: tables are made of results anew each time.
fn left_out(path: &str) -> bool {
    path.starts_with("src/experiments/") && path.ends_with("tables.rs")
}

/// The code of an experiment of this program: its files and folders, that of its main item first.
pub const fn code(own: &'static [&'static str]) -> Code {
    Code { own, files: made_of }
}

/// Path and hash of every file of which results are made, beside what all share of these files and folders.
fn made_of(own: &[&str]) -> BTreeMap<String, String> {
    let within = |path: &str| {
        let mut named = SHARED.iter().chain(own);
        named.any(|named| {
            path.strip_prefix(named).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
        }) && !left_out(path)
    };
    let files = FILES.iter().filter(|(path, _)| within(path));
    files.map(|(path, hash)| ((*path).into(), (*hash).into())).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{SWEEP, saved};
    use super::made_of;

    #[test]
    fn what_may_change_a_number_is_in_and_what_follows_from_results_is_not() {
        let of = |own: &[&str]| made_of(own).into_keys().collect::<Vec<String>>();
        let sweep = of(SWEEP.code.own);
        for file in [
            "Cargo.lock",
            "crates/impact-chain/src/engine.rs",
            "crates/literate/src/experiments/cutting.rs",
            "src/params/chosen.rs",
            "src/experiments/ensembles.rs",
        ] {
            assert!(sweep.iter().any(|own| own == file), "{file}");
        }
        for part in ["src/experiments/sweep", "figures/", "claims/", "report/", "horizon"] {
            assert!(!sweep.iter().any(|file| file.contains(part)), "{part}");
        }
        for own in saved().iter().flat_map(|experiment| experiment.code().own) {
            assert!(of(&[own]).iter().any(|file| file.starts_with(own)), "there is no {own}");
        }
    }
}
