use super::*;
use crate::params::{Boundary, Profile, Start};
use impact_chain::{Engine, Scenario};
use impact_numerics::random::NormalPairs;

fn curve(masses: usize) -> ChainCurve {
    ChainCurve {
        kind: ChainKind::Length,
        name: "test".into(),
        masses,
        start: Start::Rest,
        boundary: Boundary::Walls,
        sigmas: vec![0.1, 0.2],
        transients: vec![20.0, 100.0],
        realisations: 4,
    }
}

fn parameters(curves: Vec<ChainCurve>) -> ChainsParams {
    ChainsParams { window: 50.0, piece: 10, curves, ..ChainsParams::new(Profile::Quick) }
}

#[test]
fn windows_of_each_profile_do_not_overlap_and_names_differ() {
    let profiles = [Profile::Quick, Profile::Full].map(ChainsParams::new);
    for parameters in profiles.into_iter().chain([ChainsParams::sizes(Profile::Quick)]) {
        let mut names = std::collections::BTreeSet::new();
        for own in &parameters.curves {
            assert!(names.insert(&own.name), "{}", own.name);
            assert!(own.sigmas.is_sorted() && !own.sigmas.is_empty(), "{own:?}");
            let apart = |pair: &[f64]| pair[0] + parameters.window <= pair[1];
            assert!(own.transients.windows(2).all(apart), "{own:?}");
        }
    }
}

#[test]
fn pieces_make_up_the_chain() {
    assert_eq!(pieces(11, 1000), [11]);
    assert_eq!(pieces(101, 10), [10, 10, 10, 10, 10, 10, 10, 10, 10, 11]);
    assert_eq!(pieces(100_001, 1000).iter().sum::<usize>(), 100_001);
}

/// Of 40 masses with random free parts at σ = 0.3 nine chains of ten overlap at the start.
#[test]
fn starts_that_overlap_are_left_out() {
    let overlapping = ChainCurve { start: Start::Random, sigmas: vec![0.3], ..curve(40) };
    let found = CUTTING.run(&parameters(vec![overlapping]), "test", &Progress::silent()).unwrap();
    let [row] = &found.curves[0].rows[..] else { panic!() };
    assert!(row.failed > 0 && row.runs.len() as u64 + row.failed == 4, "{row:?}");
}

#[test]
fn counts_are_those_of_the_sweep_and_of_all_pieces() {
    let parameters = parameters(vec![curve(40)]);
    let found = CUTTING.run(&parameters, "test", &Progress::silent()).unwrap();
    let [row, hot] = &found.curves[0].rows[..] else { panic!() };
    assert_eq!((row.runs.len(), row.failed, row.runs[0].counts.len()), (4, 0, 2));
    assert!(hot.runs.iter().all(|run| run.counts[1].len() == 4));
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, 2);
    let chain = Chain { masses: 40, ..Chain::default() };
    let scenario = Scenario::draw(&chain, 0.2, &mut normals);
    let mut hit = [false; 41];
    let mut engine = Engine::new(&scenario).unwrap();
    engine
        .run(150.0, |impact| {
            hit[impact.gap] |= impact.time > 100.0;
            true
        })
        .unwrap();
    let all: u32 = hot.runs[2].counts[1].iter().sum();
    assert_eq!(all, hit.iter().map(|&hit| u32::from(hit)).sum::<u32>());
}
