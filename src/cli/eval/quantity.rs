//! The quantities that `eval` knows: a row each.

use super::inputs::{Inputs, Need};
use impact_paper::circuits::distribution::{Law, SampleSpace};
use impact_paper::circuits::impact_probability::ImpactProbability;
use impact_paper::circuits::{Error, counting, jump};
use impact_paper::experiments::closed::mean_count;
use impact_paper::params::Chain;
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

const N: &[Need] = &[Need::Vertices];
const N_P: &[Need] = &[Need::Vertices, Need::P];
const N_K: &[Need] = &[Need::Vertices, Need::K];
const N_P_K: &[Need] = &[Need::Vertices, Need::P, Need::K];
const SIGMA: &[Need] = &[Need::Sigma, Need::Oscillator];

use SampleSpace::{FiveClasses, Simple};

/// All quantities, in the order of the contract.
pub const QUANTITIES: &[Quantity] = &[
    Quantity {
        name: "p-crit",
        equation: "Eq. (18)",
        meaning: "p at which Φ gets a stationary point",
        needs: N,
        evaluate: |i| jump::p_crit(i.big_n()).map(Value::Float),
    },
    Quantity {
        name: "p-jump",
        equation: "Sec. 7",
        meaning: "infimum of p with k* > 1 (N ≥ 4)",
        needs: N,
        evaluate: |i| Ok(Value::Float(jump::p_jump(Simple, i.big_n())?.p)),
    },
    Quantity {
        name: "k-after-jump",
        equation: "Sec. 7",
        meaning: "k* just after the jump (N ≥ 4)",
        needs: N,
        evaluate: |i| Ok(Value::Integer(jump::p_jump(Simple, i.big_n())?.k_after)),
    },
    Quantity {
        name: "k-star",
        equation: "Sec. 6",
        meaning: "most likely number of impacts; the lowest of several",
        needs: N_P,
        evaluate: |i| Ok(Value::Integer(i.law(Simple)?.k_star())),
    },
    Quantity {
        name: "mean-impacts",
        equation: "Sec. 6",
        meaning: "μ, the expected number of impacts",
        needs: N_P,
        evaluate: |i| Ok(Value::Float(i.law(Simple)?.mean())),
    },
    Quantity {
        name: "probability",
        equation: "Eqs. (9), (10)",
        meaning: "P(X = k)",
        needs: N_P_K,
        evaluate: |i| i.law(Simple)?.probability(i.k()).map(Value::Float),
    },
    Quantity {
        name: "log-circuits",
        equation: "Eq. (7)",
        meaning: "ln φ_N(k), number of simple circuits of length k",
        needs: N_K,
        evaluate: |i| counting::log_phi(i.big_n(), i.k()).map(Value::Float),
    },
    Quantity {
        name: "p-of-sigma",
        equation: "Eqs. (20) to (25)",
        meaning: "p(σ), probability that a gap closes by itself",
        needs: SIGMA,
        evaluate: |i| i.relation()?.p().map(Value::Float),
    },
    Quantity {
        name: "log-p-of-sigma",
        equation: "Eqs. (20) to (25)",
        meaning: "ln p(σ)",
        needs: SIGMA,
        evaluate: |i| i.relation()?.log_p().map(Value::Float),
    },
    Quantity {
        name: "higher-p-jump",
        equation: "Eq. (38)",
        meaning: "p-jump of the five-class sample space (N ≥ 2)",
        needs: N,
        evaluate: |i| Ok(Value::Float(jump::p_jump(FiveClasses, i.big_n())?.p)),
    },
    Quantity {
        name: "higher-k-after-jump",
        equation: "Eq. (38)",
        meaning: "k-after-jump of the five-class sample space (N ≥ 2)",
        needs: N,
        evaluate: |i| Ok(Value::Integer(jump::p_jump(FiveClasses, i.big_n())?.k_after)),
    },
    Quantity {
        name: "higher-k-star",
        equation: "Eq. (38)",
        meaning: "k-star of the five-class sample space",
        needs: N_P,
        evaluate: |i| Ok(Value::Integer(i.law(FiveClasses)?.k_star())),
    },
    Quantity {
        name: "higher-mean-impacts",
        equation: "Eq. (38)",
        meaning: "mean-impacts of the five-class sample space",
        needs: N_P,
        evaluate: |i| Ok(Value::Float(i.law(FiveClasses)?.mean())),
    },
    Quantity {
        name: "higher-probability",
        equation: "Eq. (38)",
        meaning: "probability in the five-class sample space",
        needs: N_P_K,
        evaluate: |i| i.law(FiveClasses)?.probability(i.k()).map(Value::Float),
    },
    Quantity {
        name: "mean-count",
        equation: "Sec. S2",
        meaning: "gaps with an impact after T, within W, from rest; nothing measured",
        needs: &[Need::Sigma, Need::Protocol],
        evaluate: |i| {
            let times = [i.transient.unwrap_or(f64::NAN), i.window.unwrap_or(f64::NAN)];
            let sigma = i.sigma.unwrap_or(f64::NAN);
            Ok(Value::Float(mean_count(&i.chain(), sigma, times, DRAWN)?.value))
        },
    },
];

/// Chains that are drawn for a mean count: their number leaves some two gaps open.
const DRAWN: u64 = 300;

impl Inputs {
    /// The chain that is asked for, from rest between walls.
    fn chain(&self) -> Chain {
        let paper = Chain::default();
        Chain {
            masses: self.masses.unwrap_or(paper.masses),
            restitution: self.restitution.unwrap_or(paper.restitution),
            ..paper
        }
    }

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
