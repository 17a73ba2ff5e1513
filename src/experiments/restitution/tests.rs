use super::hot::hot;
use super::tables::tables;
use super::*;
use crate::params::{Profile, Protocol};
use impact_numerics::quadrature::GaussLegendre;
use pxfm::{f_cbrt, f_exp, f_lgamma};

fn small() -> RestitutionParams {
    let mut parameters = RestitutionParams::new(Profile::Quick);
    parameters.chain.masses = 12;
    parameters.protocol = Protocol { transient: 60.0, window: 60.0 };
    parameters.restitutions = vec![0.0, 0.8];
    parameters.sigmas = vec![0.03, 0.3, 0.6];
    parameters.realisations = 6;
    parameters.heated = vec![0.9, 1.0];
    parameters.ends = vec![25.0, 50.0, 100.0];
    parameters
}

/// Runs that are made up, so that means, ratios and half heights are known.
#[test]
fn tables_follow_from_the_runs_as_by_hand() {
    let mut parameters = small();
    parameters.restitutions = vec![0.5, 0.8];
    parameters.sigmas = vec![0.1, 0.2];
    parameters.realisations = 2;
    parameters.heated = vec![0.9];
    let run =
        |distinct, impacts: &[u64]| Some(Run { distinct, impacts: impacts.to_vec(), phases: 0 });
    // 13 gaps: half is 6.5. Means 1 and 12 at r = 0.5, 5.5 and 9 at r = 0.8.
    let row = |a, b| vec![run(a, &[0, 3]), run(b, &[9, 6])];
    let rows = vec![
        row(0, 2),
        row(11, 13),
        row(5, 6),
        row(8, 10),
        vec![run(1, &[50, 100, 400]), run(1, &[50, 100, 400])],
    ];
    let made = Restitution { parameters: parameters.clone(), rows };
    let [rise, curves, heating, heated, all] = tables(&made).try_into().unwrap();
    let near =
        |own: f64, expected: f64| assert!((own - expected).abs() < 1e-12, "{own} {expected}");
    let keys = [("r", 0.5), ("sigma", 0.1)];
    near(rise.number(&keys, "mean_count").unwrap(), 1.0);
    near(rise.number(&keys, "impacts").unwrap(), 4.5 / 60.0);
    near(curves.number(&[("r", 0.5)], "half_height").unwrap(), 0.1 + 0.1 * 5.5 / 11.0);
    near(curves.number(&[("r", 0.8)], "half_height").unwrap(), 0.1 + 0.1 / 3.5);
    near(all.number(&[], "shift").unwrap(), 0.1 / 3.5 - 0.05);
    let at = |end: f64| heating.number(&[("r", 0.9), ("window_end", end)], "impacts").unwrap();
    [(25.0, 2.0), (50.0, 4.0), (100.0, 8.0)]
        .into_iter()
        .for_each(|(end, rate)| near(at(end), rate));
    near(heated.number(&[("r", 0.9)], "exponent").unwrap(), 1.0);
}

/// ω = d = 1 and the density exp(−|v|³/c), c = 9 σ² t/2: the mean distance over pairs.
#[test]
fn hot_chains_by_other_integrals() {
    let chain = crate::params::Chain::default();
    let rule = GaussLegendre::new(16);
    let weight = |x: f64| f_exp(-x * x * x);
    let all = f_exp(f_lgamma(1.0 / 3.0)) / 3.0;
    // Of equal signs |x − y|, of unequal ones x + y: together the larger of both.
    let below = |x: f64| weight(x) * rule.integrate_panels(0.0, x, 32, |y| x * weight(y));
    let distance = 2.0 * rule.integrate_panels(0.0, 4.0, 32, below) / (all * all);
    for (begin, end) in [(0.0, 25.0), (400.0, 800.0)] {
        let (sigma, found) = (0.3, hot(&chain, 0.3, begin, end));
        // t = x³ takes the root out of the integrand.
        let times = rule.integrate_panels(f_cbrt(begin), f_cbrt(end), 1, |x| 3.0 * x * x * x);
        let mean = times / (end - begin);
        let rate = chain.gaps() as f64 * 0.5 * distance * mean * f_cbrt(4.5 * sigma * sigma);
        assert!((found / rate - 1.0).abs() < 1e-9, "{found} {rate}");
    }
}
