//! Computes the relation of p and σ (Sec. 8): the probability that a gap closes by itself.
//!
//! The gap of two neighbours never closes while Y_0 + Y_1/|ω² − Ω²| < d, with Y_0 and Y_1 the
//! amplitudes of its free and forced parts. As printed, Eq. (25) is one minus a double integral,
//! which loses every digit for small σ. Both amplitudes are Rayleigh distributed, so the integral
//! is elementary: complete the square in the convolution. With s ≤ t the two numbers d/(2σ) and
//! |ω² − Ω²| d/(2σ) in order of size, and r = s/t,
//!
//! p = (e^{−s²} + r² e^{−t²})/(1 + r²)
//!     + √π s r (1 + r²)^{−3/2} e^{−s²/(1 + r²)} (erf(t/√(1 + r²)) + erf(s r/√(1 + r²))),
//!
//! a sum of positive terms: nothing cancels, for any ω, Ω, d and σ.
//!
//! Eq. (25) draws the free part of the motion independently of the forcing, with the same σ. A
//! chain that is at rest when the forcing sets in has no such random part: its free part cancels
//! the forced position and velocity at t = 0, so with δα, δβ the differences of forcing amplitudes
//! Y_0 = √(δα² + (Ω/ω)² δβ²)/|ω² − Ω²|, which goes with Y_1. In polar form the radius integrates
//! out and one angle is left (not in the paper):
//!
//! p_rest = (2/π) ∫_0^{π/2} exp(−(|ω² − Ω²| d/(2σ))²/(1 + √(cos²θ + (Ω/ω)² sin²θ))²) dθ.

use impact_chain::{Chain, Error, check_range};
use impact_numerics::double_double::DoubleDouble;
use impact_numerics::quadrature::GaussLegendre;
use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

/// The v above which 1 − e^{−v²} is 1 as a double.
const SATURATED: f64 = 6.25;

/// Order of the quadratures: many more points than the smooth integrands need.
const POINTS: usize = 48;

/// Where the exponent E of p is below this, p is 1 − (1 − p): the rounding of 1 − p is then below
/// the last bit of p.
const SMALL_EXPONENT: f64 = 0.01;

/// Beyond this exponent s is above 1e135, where squares of double-doubles lose digits.
const LARGEST_EXPONENT: f64 = 1e270;

/// The law by which a gap closes by itself, for one σ, spacing d, ω and Ω.
#[derive(Clone, Copy, Debug)]
pub struct ImpactProbability {
    sigma: f64,
    spacing: f64,
    /// d/(2σ).
    spacing_over_two_sigma: DoubleDouble,
    /// |ω² − Ω²|.
    detuning: DoubleDouble,
    /// (Ω/ω)².
    squared_frequency_ratio: DoubleDouble,
}

/// **Eq. (22)**
///
/// Returns the density of Y_0 at x ≥ 0: Rayleigh, as both differences are normal, of variance 2σ².
///
/// **Eq. (21)** (step towards (22)): Y = √((α_{j+1} − α_j)² + (β_{j+1} − β_j)²), the amplitude of
/// one harmonic of a gap.
pub fn density_free(x: f64, sigma: f64) -> f64 {
    density_forced(x, sigma, 1.0)
}

/// **Eq. (23)**
///
/// Returns the density of Y_1/|ω² − Ω²| at x ≥ 0, `detuning` = |ω² − Ω²|.
pub fn density_forced(x: f64, sigma: f64, detuning: f64) -> f64 {
    let rate = detuning / (2.0 * sigma);
    2.0 * rate * rate * x * pxfm::f_exp(-(rate * x) * (rate * x))
}

fn dd(x: f64) -> DoubleDouble {
    DoubleDouble::from(x)
}

fn square(x: DoubleDouble) -> DoubleDouble {
    x * x
}

/// Squares a frequency. The double nearest to √2 stands for √2: taking the double itself would
/// change p by 1e−13 in the tail.
fn square_of_frequency(frequency: f64) -> DoubleDouble {
    if frequency == SQRT_2 { dd(2.0) } else { square(dd(frequency)) }
}

/// Returns (1 − e^{−x})/x.
fn saturation(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { -pxfm::f_expm1(-x) / x }
}

/// Creates the error of a positive quantity that is below the range of doubles at a σ.
fn underflow(quantity: &str, sigma: f64, remedy: &str) -> Error {
    let problem = format!("{quantity} is below the range of double precision at σ = {sigma:e}");
    Error::input("sigma", problem, remedy)
}

/// p = `factor` · e^{−`exponent`}.
struct LeadingTerm {
    exponent: DoubleDouble,
    factor: f64,
}

impl ImpactProbability {
    /// Creates the law of the spacing d and the frequencies ω and Ω ≠ ω of a chain.
    pub fn new(sigma: f64, chain: &Chain) -> Result<Self, Error> {
        let &Chain { spacing, natural_frequency: omega, forcing_frequency: forcing, .. } = chain;
        check_range("sigma", sigma, 1e-300, 1e6)?;
        // The ranges of a scenario.
        check_range("spacing", spacing, 1e-6, 1e6)?;
        check_range("omega", omega, 1e-3, 1e3)?;
        check_range("forcing-frequency", forcing, 1e-3, 1e3)?;
        // Both squares are exact to 106 bits.
        let difference = square_of_frequency(omega) - square_of_frequency(forcing);
        let detuning = if difference.hi < 0.0 { -difference } else { difference };
        if detuning.hi == 0.0 {
            let problem = format!("Ω = ω = {omega:?} is resonance, where amplitudes grow for ever");
            return Err(Error::input("forcing-frequency", problem, "give Ω different from ω"));
        }
        Ok(ImpactProbability {
            sigma,
            spacing,
            spacing_over_two_sigma: dd(spacing) / dd(sigma) * 0.5,
            detuning,
            squared_frequency_ratio: square_of_frequency(forcing) / square_of_frequency(omega),
        })
    }

    /// Creates the law of the paper's chain, ω = 1, Ω = √2, d = 1 (Fig. 11).
    pub fn of_paper(sigma: f64) -> Result<Self, Error> {
        Self::new(sigma, &Chain::default())
    }

    /// Returns s ≤ t: d over twice the wider and the narrower Rayleigh scale.
    fn reduced_spacings(&self) -> (DoubleDouble, DoubleDouble) {
        let free = self.spacing_over_two_sigma;
        let forced = free * self.detuning;
        if free <= forced { (free, forced) } else { (forced, free) }
    }

    // listing: leading
    /// Returns the exponent E and the factor B of p = B e^{−E}, both without cancellation.
    fn leading(&self) -> LeadingTerm {
        let (s, t) = self.reduced_spacings();
        let ratio = s / t;
        let sum = DoubleDouble::ONE + square(ratio);
        let decay = |exponent: DoubleDouble| (-exponent).exp();
        let (r, one_r) = (ratio.to_f64(), sum.to_f64());
        let free = decay(square(s * ratio) / sum);
        let forced = decay(square(t) / sum);
        let root = one_r.sqrt();
        let mixed = pxfm::f_erf(t.to_f64() / root) + pxfm::f_erf((s * ratio).to_f64() / root);
        let weight = PI.sqrt() * (s * ratio).to_f64() / (one_r * root);
        let factor = (free + r * r * forced) / one_r + weight * mixed;
        LeadingTerm { exponent: square(s) / sum, factor }
    }
    // end

    /// **Eq. (25)**
    ///
    /// Returns p(σ), the probability that a gap closes by itself, in closed form and to about 1e−15
    /// relative at the exact doubles given.
    pub fn p(&self) -> Result<f64, Error> {
        let LeadingTerm { exponent, factor } = self.leading();
        if exponent.to_f64() < SMALL_EXPONENT {
            return Ok(1.0 - self.complement());
        }
        // Half the exponent twice: the exponential must not underflow before its factor acts.
        let half = (-exponent).times_power_of_two(0.5).exp();
        let p = (half * factor) * half;
        if p >= f64::MIN_POSITIVE {
            return Ok(p.min(1.0));
        }
        Err(underflow("p(σ)", self.sigma, "ask for log-p-of-sigma"))
    }

    /// Returns ln p(σ), to about 1e−15 relative for every σ.
    pub fn log_p(&self) -> Result<f64, Error> {
        let LeadingTerm { exponent, factor } = self.leading();
        if exponent.hi.is_nan() || exponent.hi > LARGEST_EXPONENT {
            return Err(underflow("ln p(σ)", self.sigma, "give a larger sigma"));
        }
        // Above p = 1/2, and not only near 1 as p, by 1 − p: there ln B and E cancel.
        let complement = if exponent.hi < 1.0 { self.complement() } else { 1.0 };
        if complement < 0.5 {
            return Ok(pxfm::f_log1p(-complement));
        }
        Ok((dd(pxfm::f_log(factor)) - exponent).to_f64())
    }

    /// **Eq. (20)**
    ///
    /// Returns 1 − p = P(Y_0 + Y_1/|ω² − Ω²| < d), the probability that the gap never closes,
    /// accurate even when it is tiny (large σ): an integral over the wider amplitude of positive
    /// terms.
    pub fn complement(&self) -> f64 {
        let (s, t) = self.reduced_spacings();
        let (s2, t_value) = (square(s).to_f64(), t.to_f64());
        let rule = GaussLegendre::new(POINTS);
        let wide = |u: f64| 2.0 * u * pxfm::f_exp(-s2 * u * u);
        if t_value <= SATURATED {
            let t2 = t_value * t_value;
            let narrow = |w: f64| w * w * saturation(t2 * w * w);
            let integral = rule.integrate(0.0, 1.0, |u| wide(u) * narrow(1.0 - u));
            return (square(s) * square(t) * integral).to_f64();
        }
        // A layer of width SATURATED/t below u = 1; before it the inner probability is 1.
        let edge = 1.0 - SATURATED / t_value;
        let before = edge * edge * saturation(s2 * edge * edge);
        let layer = rule.integrate_panels(0.0, SATURATED, 4, |v| {
            wide(1.0 - v / t_value) * -pxfm::f_expm1(-v * v)
        });
        (square(s) * (before + layer / t_value)).to_f64()
    }

    /// **Eq. (24)**
    ///
    /// Returns p by quadrature of the double integral that Eq. (25) prints, in `panels` × `panels`
    /// panels: 1 − p is the convolution of both densities. No digit of a small p is kept.
    pub fn p_by_double_integral(&self, panels: usize) -> f64 {
        let (q2, sigma2) = (square(self.detuning).to_f64(), self.sigma * self.sigma);
        let rule = GaussLegendre::new(20);
        let integral = rule.integrate_panels(0.0, self.spacing, panels, |x| {
            rule.integrate_panels(0.0, x, panels, |t| {
                let rest = x - t;
                let free = pxfm::f_exp(-t * t / (4.0 * sigma2));
                let forced = pxfm::f_exp(-q2 * rest * rest / (4.0 * sigma2));
                t * rest * free * forced
            })
        });
        1.0 - q2 / (4.0 * sigma2 * sigma2) * integral
    }

    /// Returns p from rest. The trapezoidal rule converges fast as the integrand is periodic; the
    /// largest value of the exponential is taken out first, so small values keep their digits.
    pub fn p_from_rest(&self) -> Result<f64, Error> {
        let scale = square(self.spacing_over_two_sigma * self.detuning);
        let kappa = self.squared_frequency_ratio.to_f64();
        let root =
            if kappa > 1.0 { self.squared_frequency_ratio.sqrt() } else { DoubleDouble::ONE };
        let reach = DoubleDouble::ONE + root;
        let (rate, reach_f64) = (scale.to_f64(), reach.to_f64());
        let least = scale / square(reach);
        let half = (-least).times_power_of_two(0.5).exp();
        // Where even this is too small the mean would be that of a spike: slow, and in vain.
        if half * half >= f64::MIN_POSITIVE {
            let decay = |theta| pxfm::f_exp(-rate * excess(kappa, reach_f64, theta));
            let p = (half * half_period_mean(decay)) * half;
            if p >= f64::MIN_POSITIVE {
                return Ok(p.min(1.0));
            }
        }
        Err(underflow("p_rest(σ)", self.sigma, "give a larger sigma"))
    }
}

/// Returns 1/D(θ)² − 1/D_max², D(θ) = 1 + √(cos²θ + κ sin²θ), without cancellation.
fn excess(kappa: f64, reach: f64, theta: f64) -> f64 {
    let (sin, cos) = pxfm::f_sincos(theta);
    let root = (cos * cos + kappa * sin * sin).sqrt();
    let away = if kappa >= 1.0 { cos } else { sin };
    let shortfall = (kappa - 1.0).abs() * away * away / (kappa.max(1.0).sqrt() + root);
    let d = 1.0 + root;
    shortfall * (reach + d) / (d * d * reach * reach)
}

/// Returns the mean of an even function of period π; at most 2^20 trapezoidal intervals.
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

    #[test]
    fn densities_by_hand_and_the_printed_integral() {
        // x/(2σ²) e^{−x²/(4σ²)}; with a detuning of 2 the scale is half as large.
        assert!((density_free(2.0, 1.0) - (-1.0_f64).exp()).abs() < 1e-15);
        assert!((density_free(2.0, 2.0) - 0.25 * (-0.25_f64).exp()).abs() < 1e-15);
        assert!((density_forced(1.0, 1.0, 2.0) - 2.0 * (-1.0_f64).exp()).abs() < 1e-15);
        for [sigma, spacing, forcing] in [[0.3, 1.0, SQRT_2], [0.7, 2.0, 1.6]] {
            let chain = Chain { spacing, forcing_frequency: forcing, ..Chain::default() };
            let law = ImpactProbability::new(sigma, &chain).unwrap();
            let off = law.p_by_double_integral(3) - law.p().unwrap();
            assert!(off.abs() < 1e-12, "{off}");
        }
    }

    /// The mean of exp(−2x sin² θ) is e^−x I₀(x), for a large x (2πx)^−½ (1 + 1/8x + …): a spike.
    #[test]
    fn the_mean_of_a_spike_is_a_bessel_function() {
        let x = 1e6_f64;
        let mean = half_period_mean(|theta| (-2.0 * x * theta.sin().powi(2)).exp());
        let exact = (1.0 + 0.125 / x + 9.0 / (128.0 * x * x)) / (std::f64::consts::TAU * x).sqrt();
        assert!((mean / exact - 1.0).abs() < 1e-13, "{mean} {exact}");
    }
}
