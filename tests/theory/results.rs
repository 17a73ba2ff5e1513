//! What the figures draw: consistency of the results with the circuits and with themselves.

use impact_circuits::distribution::{Law, SampleSpace};
use impact_circuits::impact_probability::ImpactProbability;
use impact_circuits::{counting, jump};
use impact_paper::experiments::theory::{self, Theory};
use impact_paper::params::VERTICES;
use std::sync::LazyLock;

static THEORY: LazyLock<Theory> = LazyLock::new(|| theory::run(VERTICES).expect("N = 100"));

fn k_star(p: f64) -> usize {
    Law::new(SampleSpace::Simple, VERTICES, p).unwrap().k_star()
}

#[test]
fn results_survive_saving_and_hold_finite_numbers_only() {
    let json = serde_json::to_string(&*THEORY).unwrap();
    // NaN and infinities are written as null, which is read back as no number.
    assert_eq!(serde_json::from_str::<Theory>(&json).unwrap(), *THEORY);
    assert!(theory::run(3).is_err());
}

#[test]
fn distributions_have_total_one() {
    let one = |values: &[f64]| (values.iter().sum::<f64>() - 1.0).abs() < 1e-13;
    assert!(one(&THEORY.simple_circuits.share));
    assert_eq!(THEORY.distributions.len(), 4);
    for d in &THEORY.distributions {
        assert!(d.probability.len() == VERTICES && one(&d.probability));
        let mean: f64 = d.probability.iter().enumerate().map(|(i, q)| (i + 1) as f64 * q).sum();
        assert!((mean / d.mean - 1.0).abs() < 1e-13);
        let top = d.probability.iter().copied().fold(0.0, f64::max);
        assert_eq!(d.probability[d.k_star - 1], top);
    }
    for h in THEORY.higher.iter().chain(&THEORY.convergence) {
        assert!(one(&h.total) && one(&h.simple));
        for k in 0..VERTICES {
            let added: f64 = h.classes.iter().map(|class| class.probability[k]).sum();
            assert!((added - h.total[k]).abs() <= 1e-14 * h.total[k]);
        }
        assert!((h.classes.iter().map(|class| class.share).sum::<f64>() - 1.0).abs() < 1e-13);
        assert!(h.mean > h.mean_simple && h.total_variation > 0.0 && h.total_variation < 1.0);
    }
}

#[test]
fn steps_of_figure_9_are_where_k_star_changes() {
    let steps = &THEORY.most_likely.steps;
    assert_eq!((steps[0].p, steps[0].k_star), (0.0, 1));
    assert_eq!(steps.last().unwrap().k_star, k_star(1.0));
    for pair in steps.windows(2) {
        assert!(pair[0].p < pair[1].p && pair[0].k_star < pair[1].k_star);
        let p = pair[1].p;
        assert_eq!(k_star(p * (1.0 - 1e-14)), pair[0].k_star);
        assert_eq!(k_star(p * (1.0 + 1e-14)), pair[1].k_star);
    }
    for rows in [&THEORY.most_likely.mean, &THEORY.most_likely.mean_inset] {
        assert_eq!((rows[0].p, rows[0].mean, rows[0].mean_higher), (0.0, 1.0, 1.0));
        assert!(rows.windows(2).all(|w| w[0].p < w[1].p && w[0].mean < w[1].mean));
    }
}

#[test]
fn figure_10_shows_four_different_stages() {
    let [a, b, c, d] = THEORY.mechanism.as_slice() else { panic!("four rows") };
    let scalars = &THEORY.scalars;
    assert_eq!((a.p, b.p), (0.0, scalars.p_crit));
    assert!(b.p < c.p && c.p < scalars.p_jump && scalars.p_jump < d.p);
    assert_eq!([a.k_star, b.k_star, c.k_star], [1, 1, 1]);
    assert!(d.k_star >= scalars.k_after_jump && a.zeros.is_none());
    let rises = |row: &theory::Mechanism| row.phi_over_gamma.windows(2).any(|w| w[1] > w[0]);
    assert_eq!([a, b, c, d].map(rises), [false, false, true, true]);
    let largest = |row: &theory::Mechanism| row.f.iter().map(|q| q.y).fold(f64::MIN, f64::max);
    assert!(largest(a) < 0.0 && largest(b) <= 1e-12 && largest(c) > 0.0);
    assert_eq!(a.f.last().unwrap().y, -(VERTICES as f64 + 1.0));
    let [minus, plus] = b.zeros.unwrap();
    assert!(minus == plus && jump::f(VERTICES, b.p, plus).abs() < 1e-12);
}

#[test]
fn sigmas_of_the_scalars_invert_the_relation() {
    let p = |sigma: f64| ImpactProbability::of_paper(sigma).unwrap().p().unwrap();
    let rest = |sigma: f64| ImpactProbability::of_paper(sigma).unwrap().p_from_rest().unwrap();
    for s in [&THEORY.scalars, &THEORY.scalars_walls] {
        let pairs = [
            (p(s.sigma_crit), s.p_crit),
            (p(s.sigma_jump), s.p_jump),
            (p(s.higher_sigma_jump), s.higher_p_jump),
            (rest(s.sigma_jump_rest), s.p_jump),
        ];
        for (found, wanted) in pairs {
            assert!((found / wanted - 1.0).abs() < 1e-13, "{found} {wanted}");
        }
        let mean = |space, p| Law::new(space, s.vertices, p).unwrap().mean();
        let middle = (s.vertices + 1) as f64 / 2.0;
        let halves = [
            mean(SampleSpace::Simple, p(s.sigma_half)),
            mean(SampleSpace::FiveClasses, p(s.higher_sigma_half)),
            mean(SampleSpace::Simple, rest(s.sigma_half_rest)),
        ];
        assert!(halves.iter().all(|m| (m / middle - 1.0).abs() < 1e-12), "{halves:?}");
    }
    assert_eq!(THEORY.scalars_walls.vertices, VERTICES + 1);
}

#[test]
fn curves_follow_relation_and_distribution() {
    for (row, simulated) in THEORY.relation.iter().zip(&THEORY.curve.rows) {
        assert_eq!(row.sigma, simulated.sigma);
        assert_eq!(simulated.simple, Law::new(SampleSpace::Simple, 100, row.p).unwrap().mean());
        assert!(simulated.higher >= simulated.simple, "{simulated:?}");
        let rest = (row.p_rest > row.p) == (simulated.simple_rest > simulated.simple);
        assert!(rest || row.p_rest < 1e-15, "{row:?} {simulated:?}");
    }
    assert!(THEORY.relation.windows(2).all(|w| w[0].p < w[1].p && w[0].p_rest < w[1].p_rest));
    // Doubles nearest to round values, so that rows can be looked up by σ.
    for sigma in [0.02, 0.12, 0.147, 0.15, 0.4] {
        assert!(THEORY.relation.iter().any(|row| row.sigma == sigma), "{sigma}");
    }
}

#[test]
fn slips_of_the_paper_by_other_routes() {
    let slips = &THEORY.slips;
    // Eq. (8) at k = N − 1 is N/(N − 1) by hand.
    assert!((slips.ratio_before_last - 100.0 / 99.0).abs() < 1e-15);
    assert_eq!((slips.longest_peak, slips.mean_at_zero, slips.k_star_at_one), (99, 1.0, 99));
    assert!((slips.last_ratio_at_one - 0.99).abs() < 1e-15);
    // Near the end φ(N − j)/φ(N) = N/((N − j) j!): shares of j = 0..3 over all j.
    let weight = |j: usize| 100.0 / ((100 - j) as f64 * (1..=j).product::<usize>() as f64);
    let near_end: f64 = (0..4).map(weight).sum();
    let all: f64 = (0..18).map(weight).sum();
    assert!((slips.share_near_end / (near_end / all) - 1.0).abs() < 1e-13);
    let first = slips.first_local_maximum;
    assert_eq!((first.numerator as f64 / first.denominator as f64, first.k), (first.p, 9));
    assert_eq!(jump::f(VERTICES, 0.0, 9.0) + first.p * jump::slope_in_p(VERTICES, 9.0), 0.0);
    assert!(first.p > THEORY.scalars.p_crit && first.p < THEORY.scalars.p_jump);
    assert_eq!(slips.missing_factor, VERTICES as f64);
    // At p = 0.005 nearly all weight is at small k, where class sums are short: direct.
    let share = slips.simple_shares.iter().find(|s| s.x == 0.005).unwrap().y;
    let (mut simple, mut all) = (0.0, 0.0);
    for k in 1..=70_usize {
        let (x, n) = (k as f64, counting::phi_scaled(VERTICES, k).to_f64());
        let power = |e: usize| (0..e).fold(1.0, |w, _| w * 0.005);
        let two = if k == 2 { 1.0 } else { (x - 1.0) * x * x * (x + 1.0) / 8.0 };
        let single = if k == 1 { 0.0 } else { 1.0 };
        let higher = x * x / 2.0 * power(k + 1)
            + x * x * (x + 1.0) / 6.0 * power(k + 2)
            + x * x * (x + 1.0) * (x + 2.0) / 24.0 * power(k + 3);
        simple += n * power(k);
        all += n * (power(k) + single * higher + two * power(k + 2));
    }
    assert!((share / (simple / all) - 1.0).abs() < 1e-9, "{share} {}", simple / all);
}

#[test]
fn large_graphs_go_on_from_the_paper() {
    let (large, scalars) = (&THEORY.large, &THEORY.scalars);
    let own = large.jumps.iter().find(|own| own.vertices == VERTICES).unwrap();
    assert_eq!((own.p, own.k_after), (scalars.p_jump, scalars.k_after_jump));
    assert!(large.jumps.windows(2).all(|w| w[1].share < w[0].share && w[1].p_n < w[0].p_n));
    for own in &large.shares {
        let after = own.rows.iter().skip_while(|row| row.y * own.vertices as f64 <= 1.0);
        assert!(after.clone().count() > 100);
        for row in after.step_by(40) {
            let p = row.x / own.vertices as f64;
            // At a step both ends are drawn, and just beyond the jump the last bit of p N times 1/N may fall
            // before it.
            let share = |p: f64| {
                let law = Law::new(SampleSpace::Simple, own.vertices, p).unwrap();
                law.k_star() as f64 / own.vertices as f64
            };
            let sides = [share(p * (1.0 - 1e-13)), share(p * (1.0 + 1e-13))];
            assert!(sides.contains(&row.y), "{row:?} {sides:?}");
        }
    }
}
