//! What an experiment depends on, as the build script reads it.

#[path = "../../build/depends.rs"]
mod build;

use build::{Source, files};

fn source(files: &[(&str, &str)]) -> Source {
    files.iter().map(|(path, text)| ((*path).to_string(), (*text).to_string())).collect()
}

fn found(source: &Source, root: &str) -> Vec<String> {
    files(source, root).into_iter().collect()
}

#[test]
fn a_change_that_matters_is_seen_and_another_is_not() {
    let source = source(&[
        (
            "src/params.rs",
            "mod chosen;\nmod far;\npub use chosen::*;\npub use far::FarParams;\npub use impact_chain::Chain;\n",
        ),
        ("src/params/chosen.rs", "pub const SEED: u64 = 1;\n"),
        ("src/params/far.rs", "pub struct FarParams;\n"),
        ("crates/impact-chain/src/lib.rs", "mod engine;\nmod contact;\npub use engine::Engine;\n"),
        ("crates/impact-chain/src/engine.rs", "use impact_numerics::clock;\npub struct Engine;\n"),
        // Methods of a type stand where they belong, not where it is defined.
        ("crates/impact-chain/src/contact.rs", "impl super::Engine {}\n"),
        ("crates/numerics/src/lib.rs", "pub mod clock;\n"),
        ("crates/numerics/src/clock.rs", ""),
        ("crates/circuits/src/lib.rs", ""),
        (
            "src/experiments/mod.rs",
            "pub mod near;\npub mod far;\npub mod watch;\npub use literate::experiments::{Error, cutting::Unit};\n",
        ),
        ("src/lib.rs", "pub use literate::digest;\n"),
        ("crates/literate/src/lib.rs", "pub mod digest;\npub mod experiments;\n"),
        ("crates/literate/src/digest.rs", ""),
        (
            "crates/literate/src/experiments/mod.rs",
            "pub mod cutting;\nmod error;\npub use error::Error;\n",
        ),
        (
            "crates/literate/src/experiments/error.rs",
            "use impact_circuits::X;\npub enum Error {}\n",
        ),
        ("crates/literate/src/experiments/cutting.rs", "pub struct Unit;\n"),
        (
            "src/experiments/near.rs",
            "use super::{Error, Unit, watch::{self, Watch as Seen}};\nuse literate::digest::sha256;\nuse crate::params::{Chain, SEED};\nuse impact_chain::Engine;\npub struct Near;\n",
        ),
        ("src/experiments/watch.rs", "pub struct Watch;\n"),
        ("src/experiments/chain.rs", "use crate::params::Chain;\n"),
        (
            "src/experiments/far.rs",
            "//! Beside [`super::near`].\nuse crate::params::FarParams;\n#[cfg(test)]\nmod tests { use super::super::near; }\n",
        ),
        ("src/experiments/more.rs", "impl From<u8> for super::watch::Watch {}\n"),
        // Another type of the same name.
        ("src/experiments/namesake.rs", "pub struct Near;\nimpl Near {}\n"),
    ]);
    let near = [
        "crates/impact-chain/src/contact.rs",
        "crates/impact-chain/src/engine.rs",
        "crates/impact-chain/src/lib.rs",
        "crates/literate/src/digest.rs",
        "crates/literate/src/experiments/cutting.rs",
        "crates/numerics/src/clock.rs",
        "crates/numerics/src/lib.rs",
        "src/experiments/more.rs",
        "src/experiments/near.rs",
        "src/experiments/watch.rs",
        "src/params/chosen.rs",
    ];
    assert_eq!(found(&source, "src/experiments/near.rs"), near);
    // The chain's own types stand beside the engine, whoever hands them on; and a crate is one thing.
    let chain = [&near[..3], &near[5..7], &["src/experiments/chain.rs"]].concat();
    assert_eq!(found(&source, "src/experiments/chain.rs"), chain);
    let far = ["src/experiments/far.rs", "src/params/far.rs"];
    assert_eq!(found(&source, "src/experiments/far.rs"), far);
}

/// The real source: every experiment that simulates depends on the engine, and on no other
/// experiment unless it runs it.
#[test]
fn the_sweep_depends_on_the_engine_and_not_on_the_scenes() {
    let mut source = Source::new();
    for folder in ["src", "crates"] {
        read(std::path::Path::new(env!("CARGO_MANIFEST_DIR")), folder, &mut source);
    }
    let sweep = found(&source, "src/experiments/sweep/mod.rs");
    for (paths, depends) in [
        ("crates/impact-chain/src/simulation.rs crates/impact-chain/src/contact.rs", true),
        ("crates/numerics/src/screen.rs src/experiments/rise.rs src/params/chosen.rs", true),
        ("src/experiments/horizon.rs src/experiments/accuracy/scenes.rs", false),
        ("src/experiments/results.rs src/params/spacetime.rs", false),
    ] {
        for path in paths.split(' ') {
            assert_eq!(sweep.contains(&path.into()), depends, "{path}: {sweep:?}");
            assert!(source.contains_key(path), "there is no {path}");
        }
    }
}

/// Tables are made of results, so a column can change without a run: nothing that runs may read them. The list hands
/// tables out, and what is compared stands beside tables.
#[test]
fn what_runs_reads_no_table() {
    let mut source = Source::new();
    read(std::path::Path::new(env!("CARGO_MANIFEST_DIR")), "src/experiments", &mut source);
    let may = ["tables.rs", "tests.rs", "compared.rs", "src/experiments/mod.rs"];
    source.retain(|path, _| !may.iter().any(|end| path.ends_with(end)));
    for (path, text) in &source {
        let code = text.split("#[cfg(test)]").next().unwrap();
        assert!(!code.contains("tables::"), "{path} reads tables");
    }
    assert!(source.len() > 40, "{}", source.len());
}

fn read(root: &std::path::Path, folder: &str, into: &mut Source) {
    for entry in std::fs::read_dir(root.join(folder)).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let path = format!("{folder}/{name}");
        if name.ends_with(".rs") {
            into.insert(path.clone(), std::fs::read_to_string(root.join(&path)).unwrap());
        } else if root.join(&path).is_dir() {
            read(root, &path, into);
        }
    }
}
