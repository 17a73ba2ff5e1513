//! Cost of an impact: one chain of n masses, σ = 0.3, r = 0.8, started from rest.
//!
//! `items` are impacts, so the throughput column reads impacts per second.

use divan::Bencher;
use divan::counter::ItemsCount;
use impact_chain::{Engine, Scenario};
use impact_numerics::random::NormalPairs;
use impact_paper::params::{Chain, Ensemble};

fn main() {
    divan::main();
}

fn scenario(masses: usize) -> Scenario {
    let chain = Chain { masses, ..Chain::default() };
    Scenario::draw(&chain, 0.3, &mut NormalPairs::new("bench", 1, 0))
}

/// Runs until `until`; returns the number of impacts.
fn run(scenario: &Scenario, until: f64) -> u64 {
    let mut engine = Engine::new(scenario).expect("a start from rest has no overlap");
    engine.run(until, |_| true).expect("the work is bounded");
    engine.counters().impacts
}

/// About 16 000 impacts at every n.
#[divan::bench(args = [20, 100, 1_000, 10_000])]
fn impacts(bencher: Bencher, masses: usize) {
    let scenario = scenario(masses);
    let until = 70_000.0 / masses as f64;
    let count = run(&scenario, until);
    bencher.counter(ItemsCount::new(count)).bench(|| run(divan::black_box(&scenario), until));
}

/// A realisation of the main sweep at each σ, first by the bare engine, then as ensembles run and
/// count it.
#[divan::bench(args = [(0.16, false), (0.16, true), (0.3, false), (0.3, true)])]
fn counted(bencher: Bencher, (sigma, counts): (f64, bool)) {
    let ensemble = Ensemble { stream: "sweep".into(), ..Ensemble::default() };
    let realisation = || ensemble.realisation(sigma, 0, || false).expect("the chain is allowed");
    let mut normals = NormalPairs::new("sweep", 2007, 0);
    let scenario = Scenario::draw(&ensemble.chain, sigma, &mut normals);
    let bencher = bencher.counter(ItemsCount::new(realisation().total.impacts));
    if counts {
        bencher.bench(realisation);
    } else {
        bencher.bench(|| run(divan::black_box(&scenario), ensemble.until(sigma)));
    }
}
