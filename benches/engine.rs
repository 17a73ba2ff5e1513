//! Cost of an impact: one chain of n masses, σ = 0.3, r = 0.8, started from rest.
//!
//! `items` are impacts, so the throughput column reads impacts per second.

use divan::Bencher;
use divan::counter::ItemsCount;
use impact_chain::{Engine, Scenario};
use impact_numerics::random::{NormalPairs, Seed};
use impact_paper::params::{Chain, Ensemble};

fn main() {
    divan::main();
}

fn scenario(masses: usize) -> Scenario {
    let chain = Chain { masses, ..Chain::default() };
    Scenario::draw(&chain, 0.3, &mut NormalPairs::new("bench", Seed(1), 0))
}

/// Runs until `until`; returns the number of impacts.
fn run(scenario: &Scenario, until: f64) -> u64 {
    let mut engine = Engine::new(scenario).expect("a start from rest has no overlap");
    engine.advance(until).expect("the work is bounded");
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

/// Sixteen realisations of the main sweep, drawn and run: first by the bare engine one by one, then
/// side by side as ensembles run and count them (`true`), with tables that are made once for a σ.
#[divan::bench(args = [0.09, 0.11, 0.14, 0.2, 0.3], consts = [false, true])]
fn counted<const TOGETHER: bool>(bencher: Bencher, sigma: f64) {
    let ensemble = Ensemble { stream: "sweep".into(), ..Ensemble::default() };
    let realisations = ensemble.prepare(sigma, &|| false);
    let counts = || realisations.count(0..16).expect("the chain is allowed");
    let impacts: u64 = counts().iter().map(|counts| counts.total.impacts).sum();
    let bencher = bencher.counter(ItemsCount::new(impacts));
    let draw =
        |i| Scenario::draw(&ensemble.chain, sigma, &mut NormalPairs::new("sweep", Seed(2007), i));
    let until = ensemble.until(sigma);
    if TOGETHER {
        bencher.bench(counts);
    } else {
        bencher.bench(|| (0..16).map(|i| run(&draw(i), until)).sum::<u64>());
    }
}
