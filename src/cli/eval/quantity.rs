//! The quantities that `eval` knows: a row each.

use super::inputs::{Inputs, Need};
use impact_circuits::distribution::{Law, SampleSpace};
use impact_circuits::impact_probability::ImpactProbability;
use impact_circuits::{Error, counting, jump};
use serde::Serialize;

/// A result: floats keep their decimal point, integers have none.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// A double.
    Float(f64),
    /// A count.
    Integer(usize),
}

impl Value {
    /// Whether JSON can hold it.
    pub fn is_finite(self) -> bool {
        match self {
            Value::Float(x) => x.is_finite(),
            Value::Integer(_) => true,
        }
    }
}

/// One quantity of the theory.
pub struct Quantity {
    /// Its name on the command line.
    pub name: &'static str,
    /// Where the paper has it.
    pub equation: &'static str,
    /// What it is.
    pub meaning: &'static str,
    /// What it depends on; anything else is refused.
    pub needs: &'static [Need],
    /// Computes it.
    pub evaluate: fn(&Inputs) -> Result<Value, Error>,
}

const fn quantity(
    [name, equation, meaning]: [&'static str; 3],
    needs: &'static [Need],
    evaluate: fn(&Inputs) -> Result<Value, Error>,
) -> Quantity {
    Quantity { name, equation, meaning, needs, evaluate }
}

const N: &[Need] = &[Need::Vertices];
const N_P: &[Need] = &[Need::Vertices, Need::P];
const N_K: &[Need] = &[Need::Vertices, Need::K];
const N_P_K: &[Need] = &[Need::Vertices, Need::P, Need::K];
const SIGMA: &[Need] = &[Need::Sigma, Need::Oscillator];

use SampleSpace::{FiveClasses, Simple};

/// All quantities, in the order of the contract.
pub const QUANTITIES: &[Quantity] = &[
    quantity(["p-crit", "Eq. (18)", "p at which Φ gets a stationary point"], N, |i| {
        jump::p_crit(i.big_n()).map(Value::Float)
    }),
    quantity(["p-jump", "Sec. 7", "infimum of p with k* > 1 (N ≥ 4)"], N, |i| {
        Ok(Value::Float(jump::p_jump(Simple, i.big_n())?.p))
    }),
    quantity(["k-after-jump", "Sec. 7", "k* just after the jump (N ≥ 4)"], N, |i| {
        Ok(Value::Integer(jump::p_jump(Simple, i.big_n())?.k_after))
    }),
    quantity(
        ["k-star", "Sec. 6", "most likely number of impacts; the lowest of several"],
        N_P,
        |i| Ok(Value::Integer(i.law(Simple)?.k_star())),
    ),
    quantity(["mean-impacts", "Sec. 6", "μ, the expected number of impacts"], N_P, |i| {
        Ok(Value::Float(i.law(Simple)?.mean()))
    }),
    quantity(["probability", "Eqs. (9), (10)", "P(X = k)"], N_P_K, |i| {
        i.law(Simple)?.probability(i.k()).map(Value::Float)
    }),
    quantity(
        ["log-circuits", "Eq. (7)", "ln φ_N(k), number of simple circuits of length k"],
        N_K,
        |i| counting::log_phi(i.big_n(), i.k()).map(Value::Float),
    ),
    quantity(
        ["p-of-sigma", "Eqs. (20) to (25)", "p(σ), probability that a gap closes by itself"],
        SIGMA,
        |i| i.relation()?.p().map(Value::Float),
    ),
    quantity(["log-p-of-sigma", "Eqs. (20) to (25)", "ln p(σ)"], SIGMA, |i| {
        i.relation()?.log_p().map(Value::Float)
    }),
    quantity(
        ["higher-p-jump", "Eq. (38)", "p-jump of the five-class sample space (N ≥ 2)"],
        N,
        |i| Ok(Value::Float(jump::p_jump(FiveClasses, i.big_n())?.p)),
    ),
    quantity(
        ["higher-k-after-jump", "Eq. (38)", "k-after-jump of the five-class sample space (N ≥ 2)"],
        N,
        |i| Ok(Value::Integer(jump::p_jump(FiveClasses, i.big_n())?.k_after)),
    ),
    quantity(["higher-k-star", "Eq. (38)", "k-star of the five-class sample space"], N_P, |i| {
        Ok(Value::Integer(i.law(FiveClasses)?.k_star()))
    }),
    quantity(
        ["higher-mean-impacts", "Eq. (38)", "mean-impacts of the five-class sample space"],
        N_P,
        |i| Ok(Value::Float(i.law(FiveClasses)?.mean())),
    ),
    quantity(
        ["higher-probability", "Eq. (38)", "probability in the five-class sample space"],
        N_P_K,
        |i| i.law(FiveClasses)?.probability(i.k()).map(Value::Float),
    ),
];

impl Inputs {
    fn law(&self, space: SampleSpace) -> Result<Law, Error> {
        Law::new(space, self.big_n(), self.p.unwrap_or_default())
    }

    fn relation(&self) -> Result<ImpactProbability, Error> {
        let or_nan = |x: Option<f64>| x.unwrap_or(f64::NAN);
        ImpactProbability::new(
            or_nan(self.sigma),
            or_nan(self.spacing),
            or_nan(self.omega),
            or_nan(self.forcing_frequency),
        )
    }
}
