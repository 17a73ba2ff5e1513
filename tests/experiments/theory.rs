//! Compares the tables of the theory with the circuits, with other routes and with themselves.

use impact_circuits::distribution::{Law, SampleSpace};
use impact_circuits::impact_probability::ImpactProbability;
use impact_paper::experiments::theory::{large, law};
use impact_paper::experiments::{Progress, Results, Store, THEORY, bare};
use impact_paper::params::{Profile, VERTICES};
use std::sync::LazyLock;

static RESULTS: LazyLock<Results> = LazyLock::new(|| {
    let (paper, store) = (bare(), Store::nowhere());
    let session = paper.session(None, Profile::Quick, store, Progress::silent()).unwrap();
    paper.results(&[&THEORY], &session).unwrap()
});

fn number(address: &str) -> f64 {
    RESULTS.number(address).unwrap()
}

fn mean(space: SampleSpace, vertices: usize, p: f64) -> f64 {
    Law::new(space, vertices, p).unwrap().mean()
}

/// From 50-digit arithmetic: ((1 + √101)/100)², and the 19th root of 20·80!/99!, the least.
#[test]
fn p_crit_and_p_jump_of_a_hundred_vertices() {
    assert!((number("theory.jump.p_crit") - 0.012209975124224177).abs() < 1e-17);
    assert!((number("theory.jump.p_jump") - 0.01303285872435575).abs() < 1e-17);
    assert_eq!(number("theory.jump.k_after"), 20.0);
    // Eq. (25) and the σ that it gives to the jump, from 40-digit arithmetic.
    assert!((number("theory.gap[sigma=0.12].p") / 8.87017160097868e-4 - 1.0).abs() < 1e-14);
    assert!((number("theory.relation.sigma_jump") - 0.1469211811).abs() < 5e-11);
    // For a start from rest, from 40-digit arithmetic, and 1 − (1 − p_rest)^101.
    assert!((number("theory.gap[sigma=0.12].p_rest") - 0.0309524).abs() < 1e-7);
    assert!((number("theory.gap[sigma=0.12].any_rest") - 0.958).abs() < 1e-3);
    assert!((0.099..0.1).contains(&number("theory.relation.sigma_kept_half")));
    assert!((0.07..0.09).contains(&number("theory.relation.sigma_kept_onset")));
}

#[test]
fn sigmas_invert_the_relation() {
    let p = |sigma: f64| ImpactProbability::of_paper(sigma).unwrap().p().unwrap();
    let rest = |sigma: f64| ImpactProbability::of_paper(sigma).unwrap().p_from_rest().unwrap();
    let sigma = |column: &str| number(&format!("theory.relation.{column}"));
    let leap = number("theory.jump.p_jump");
    for (found, wanted) in [
        (p(sigma("sigma_crit")), number("theory.jump.p_crit")),
        (p(sigma("sigma_jump")), leap),
        (p(sigma("sigma_jump_higher")), number("theory.higher.p_jump")),
        (rest(sigma("sigma_jump_rest")), leap),
        (mean(SampleSpace::Simple, VERTICES, p(sigma("sigma_half"))), 50.5),
        (mean(SampleSpace::FiveClasses, VERTICES, p(sigma("sigma_half_higher"))), 50.5),
        (mean(SampleSpace::Simple, VERTICES, rest(sigma("sigma_half_rest"))), 50.5),
    ] {
        assert!((found / wanted - 1.0).abs() < 1e-12, "{found} {wanted}");
    }
}

#[test]
fn large_graphs_go_on_from_the_paper() {
    let share = RESULTS.table("theory.large").unwrap().curve(&[], "n", "share").unwrap();
    assert_eq!(number("theory.large[n=100].share"), number("theory.jump.k_after") / 100.0);
    assert!(share.windows(2).all(|w| w[1].1 < w[0].1));
    // At a step both ends are drawn.
    for (x, y) in large::shares(VERTICES).concat().into_iter().step_by(40) {
        let n = VERTICES as f64;
        let sides = [1.0 - 1e-13, 1.0 + 1e-13].map(|near| law::k_star(near * x / n) as f64 / n);
        assert!(sides.contains(&y), "{x} {y} {sides:?}");
    }
}

#[test]
fn slips_of_the_paper_by_other_routes() {
    // Eq. (8) at k = N − 1 is N/(N − 1) by hand.
    assert!((number("theory.lengths.before_last") - 100.0 / 99.0).abs() < 1e-15);
    let exact = ["theory.lengths.peak", "theory.mean.at_zero", "theory.jump.k_at_one"].map(number);
    assert_eq!(exact, [99.0, 1.0, 99.0]);
    assert!((number("theory.jump.last_ratio") - 0.99).abs() < 1e-15);
    // Near the end φ(N − j)/φ(N) = N/((N − j) j!): shares of j = 0..5 over all j.
    let weight = |j: usize| 100.0 / ((100 - j) as f64 * (1..=j).product::<usize>() as f64);
    let [near_end, all] = [6, 18].map(|count| (0..count).map(weight).sum::<f64>());
    assert!((number("theory.lengths.share") / (near_end / all) - 1.0).abs() < 1e-13);
}
