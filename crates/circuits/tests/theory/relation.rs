//! Compares Eqs. (20) to (25) with quadrature in 57-digit arithmetic.

use crate::{Big, Gauss, big, exp, int, relative_error};
use impact_chain::Chain;
use impact_circuits::impact_probability::ImpactProbability;
use std::f64::consts::SQRT_2;

/// The parameters of one case, σ, d, ω, Ω as exact numbers; √2 for the double nearest to it.
struct Case {
    s: Big,
    q: Big,
    d: Big,
}

impl Case {
    fn new(sigma: f64, d: f64, omega: f64, forcing: f64) -> Self {
        let exact = |x: f64| if x == SQRT_2 { int(2).sqrt() } else { big(x) };
        let (w, f) = (exact(omega), exact(forcing));
        let difference = (w.clone() - &f) * (w + f);
        let q = if difference < Big::ZERO { -difference } else { difference };
        Case { s: big(sigma), q, d: big(d) }
    }

    fn exponent(&self, x: &Big) -> Big {
        x.clone() * x / (int(4) * &self.s * &self.s)
    }

    /// e^E p with E the least exponent of the convolution: the probability that Y_0 alone exceeds
    /// d, plus the integral over Y_0 = x < d of the probability that the rest exceeds d − x. All
    /// terms positive; the integral is cut to 24 widths around its peak, which loses e^{−288}.
    fn scaled_p(&self, gauss: &Gauss) -> (Big, Big) {
        let q2 = self.q.clone() * &self.q;
        let one_q2 = int(1) + &q2;
        let least = self.exponent(&self.d) * &q2 / &one_q2;
        let peak = self.d.clone() * &q2 / &one_q2;
        let width = self.s.clone() * (int(2) / &one_q2).sqrt();
        let reach = int(24) * &width;
        let low = if peak > reach { peak.clone() - &reach } else { int(0) };
        let high = if peak.clone() + &reach < self.d { peak + reach } else { self.d.clone() };
        let integral = gauss.integrate(&low, &high, 6, |x| {
            let rest = (self.d.clone() - &x) * &self.q;
            let exponent = self.exponent(&x) + self.exponent(&rest) - &least;
            x / (int(2) * &self.s * &self.s) * exp(-exponent)
        });
        let alone = exp(least.clone() - self.exponent(&self.d));
        (least, alone + integral)
    }

    /// 1 − p: an integral of positive terms.
    fn complement(&self, gauss: &Gauss) -> Big {
        gauss.integrate(&int(0), &self.d, 6, |x| {
            let rest = (self.d.clone() - &x) * &self.q;
            let inner = int(1) - exp(-self.exponent(&rest));
            let free = exp(-self.exponent(&x));
            x / (int(2) * &self.s * &self.s) * free * inner
        })
    }
}

/// (d, ω, Ω): the paper's, unequal scales both ways, nearly equal scales, and near resonance.
const SETTINGS: [(f64, f64, f64); 7] = [
    (1.0, 1.0, SQRT_2),
    (1.0, 1.0, 3.0),
    (1.0, 1.0, 1.1),
    (0.3, 2.0, 1.5),
    (1.0, 1.0, SQRT_2 * (1.0 + 1e-9)),
    (1.0, 1.0, 1.000_000_1),
    (1e-3, 1.0, 2.0),
];

/// p, 1 − p and ln p, each where doubles have it; ln p near p = 1 by the complement.
#[test]
fn closed_forms_agree_with_quadrature_to_the_last_digits() {
    let gauss = Gauss::new(20);
    for (d, omega, forcing) in SETTINGS {
        let (spacing, natural_frequency, forcing_frequency) = (d, omega, forcing);
        let chain = Chain { spacing, natural_frequency, forcing_frequency, ..Chain::default() };
        for over_d in
            [1e-25, 1e-20, 1e-3, 0.0125, 0.0135, 0.02, 0.05, 0.15, 0.4, 0.5, 1.0, 10.0, 1e6]
        {
            let sigma = over_d * d;
            let case = format!("d {d} ω {omega} Ω {forcing} σ {sigma}");
            let law = ImpactProbability::new(sigma, &chain).unwrap();
            let exact_case = Case::new(sigma, d, omega, forcing);
            let (least, factor) = exact_case.scaled_p(&gauss);
            let mut log = factor.ln() - &least;
            let exact = exp(-least) * factor;
            match law.p() {
                Err(error) => {
                    assert!(error.to_string().contains("below the range"), "{case}");
                    assert!(exact < big(f64::MIN_POSITIVE), "{case}");
                }
                Ok(p) => assert!(relative_error(p, &exact) < 5e-15, "{case}: {p}"),
            }
            if over_d >= 0.4 {
                let rest = exact_case.complement(&gauss);
                // Where p is nearly 1, to its last bit.
                let last = relative_error(law.p().unwrap(), &(int(1) - rest.clone()));
                assert!(over_d < 10.0 || last < 1.2e-16, "{case}: {last}");
                assert!(relative_error(law.complement(), &rest) < 5e-15, "{case}");
                log = (int(1) - rest).ln();
            }
            assert!(relative_error(law.log_p().unwrap(), &log) < 5e-15, "{case}");
        }
    }
}

#[test]
fn a_logarithm_below_the_range_of_doubles_is_refused() {
    let log = |sigma| ImpactProbability::of_paper(sigma).unwrap().log_p();
    assert!(log(1e-130).is_ok());
    for sigma in [1e-140, 1e-155] {
        assert!(log(sigma).unwrap_err().to_string().contains("below the range"), "{sigma}");
    }
}

#[test]
fn start_from_rest_against_the_trapezoidal_rule_in_high_precision() {
    // Periodic and analytic: 200 points are exact to far more digits than a double has.
    let points = 200;
    let pi = int(4) * int(1).atan();
    for sigma in [0.0135, 0.05, 0.12, 0.5, 3.0] {
        let s = int(1) / (int(2) * big(sigma));
        let rate = s.clone() * s;
        let mut sum = int(0);
        for i in 0..points {
            let (sin, _) = (pi.clone() * int(2 * i + 1) / int(4 * points)).sin_cos();
            let d = int(1) + (int(1) + sin.clone() * sin).sqrt();
            sum += exp(-rate.clone() / (d.clone() * d));
        }
        let ours = ImpactProbability::of_paper(sigma).unwrap().p_from_rest().unwrap();
        let error = relative_error(ours, &(sum / int(points)));
        assert!(error < 1e-14, "σ = {sigma}: {error:e}");
    }
}
