//! The probability that a gap closes by itself when the chain starts from rest (ours).
//!
//! Eq. (25) draws the free part of the motion independently of the forcing, with the same σ. A
//! chain that is at rest when the forcing sets in has no such freedom: its free part cancels the
//! forced position and velocity at t = 0, so with δα, δβ the differences of forcing amplitudes
//! Y_0 = √(δα² + (Ω/ω)² δβ²)/|ω² − Ω²|, which goes with Y_1. In polar form the radius integrates
//! out and one angle is left:
//!
//! p_rest = (2/π) ∫_0^{π/2} exp(−(|ω² − Ω²| d/(2σ))²/(1 + √(cos²θ + (Ω/ω)² sin²θ))²) dθ.

use super::Error;
use super::impact_probability::ImpactProbability;
use impact_numerics::double_double::DoubleDouble;
use impact_numerics::scaled::Scaled;
use std::f64::consts::FRAC_PI_2;

impl ImpactProbability {
    /// The probability that a gap closes by itself after a start from rest. The integrand is
    /// periodic and analytic, so the trapezoidal rule converges faster than any power; the largest
    /// value of the exponential is taken out first, so small values keep their digits.
    ///
    /// # Errors
    /// [`Error`] where the value is below the range of normal doubles.
    pub fn p_from_rest(&self) -> Result<f64, Error> {
        let scale = (self.half_ratio * self.detuning).square();
        let kappa = self.frequency_ratio.to_f64();
        let root = if kappa > 1.0 { self.frequency_ratio.sqrt() } else { DoubleDouble::ONE };
        let reach = Scaled::from(DoubleDouble::ONE + root);
        let (rate, reach_f64) = (scale.to_f64(), reach.to_f64());
        let least = (scale / reach.square()).to_double_double();
        let half = (-least).times_power_of_two(0.5).exp();
        // The mean is at most one. Where even this is too small it would be that of a spike, to
        // which the rule converges slowly, and for nothing.
        if half * half >= f64::MIN_POSITIVE {
            let mean =
                half_period_mean(|theta| pxfm::f_exp(-rate * excess(kappa, reach_f64, theta)));
            let p = (half * mean) * half;
            if p >= f64::MIN_POSITIVE {
                return Ok(p.min(1.0));
            }
        }
        Err(Error::underflow("p_rest(σ)", self.sigma(), "give a larger sigma"))
    }
}

/// 1/D(θ)² − 1/D_max² with D(θ) = 1 + √(cos²θ + κ sin²θ): by how much the exponent exceeds its
/// least value, without cancellation.
fn excess(kappa: f64, reach: f64, theta: f64) -> f64 {
    let (sin, cos) = pxfm::f_sincos(theta);
    let root = (cos * cos + kappa * sin * sin).sqrt();
    let away = if kappa >= 1.0 { cos } else { sin };
    let shortfall = (kappa - 1.0).abs() * away * away / (kappa.max(1.0).sqrt() + root);
    let d = 1.0 + root;
    shortfall * (reach + d) / (d * d * reach * reach)
}

/// The mean of an even function of period π over [0, π/2], by the trapezoidal rule with as many
/// intervals as it takes (at most 2^20).
fn half_period_mean(f: impl Fn(f64) -> f64) -> f64 {
    let mut intervals = 32;
    let mut sum = 0.5 * (f(0.0) + f(FRAC_PI_2));
    sum = (1..intervals).fold(sum, |s, i| s + f(FRAC_PI_2 * i as f64 / intervals as f64));
    loop {
        let coarse = sum / intervals as f64;
        let midpoint = |i: usize| f(FRAC_PI_2 * (i as f64 + 0.5) / intervals as f64);
        sum = (0..intervals).fold(sum, |s, i| s + midpoint(i));
        intervals *= 2;
        let fine = sum / intervals as f64;
        if (fine - coarse).abs() <= 4.0 * f64::EPSILON * fine || intervals >= 1 << 20 {
            return fine;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_numerics::quadrature::GaussLegendre;

    #[test]
    fn agrees_with_gauss_quadrature_of_the_plain_integrand() {
        for (sigma, omega, forcing) in
            [(0.12, 1.0, 2.0_f64.sqrt()), (0.2, 1.0, 0.5), (1.0, 2.0, 3.0)]
        {
            let law = ImpactProbability::new(sigma, 1.0, omega, forcing).unwrap();
            let rate = (omega * omega - forcing * forcing) / (2.0 * sigma);
            let plain = GaussLegendre::new(40).integrate_panels(0.0, FRAC_PI_2, 8, |theta| {
                let (sin, cos) = pxfm::f_sincos(theta);
                let d =
                    1.0 + (cos * cos + (forcing / omega * sin) * (forcing / omega * sin)).sqrt();
                pxfm::f_exp(-(rate / d) * (rate / d))
            }) / FRAC_PI_2;
            let ours = law.p_from_rest().unwrap();
            assert!((ours / plain - 1.0).abs() < 1e-13, "{sigma}: {ours} {plain}");
        }
    }

    #[test]
    fn the_far_tail_keeps_its_digits_or_says_that_it_is_gone() {
        let p = |sigma| ImpactProbability::of_paper(sigma).unwrap().p_from_rest();
        // Laplace's method: leading exponent 1/(4σ² (1 + √2)²), so this ratio is near 4.
        let log = |sigma: f64| -pxfm::f_log(p(sigma).unwrap());
        assert!((log(0.01) / log(0.02) - 4.0).abs() < 0.1);
        assert!(p(0.001).is_err());
    }
}
