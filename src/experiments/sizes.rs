//! Half heights by length and transient.

use super::starts::half_height;
use impact_chain::Chain;
use impact_chain::rise::{Counted, Curve};
use impact_circuits::impact_probability::ImpactProbability;
use impact_numerics::estimates::{difference, with_error};
use impact_numerics::statistics::Estimate;
use literate::table::Table;
use literate::value::origin;

/// ln 2/2p at a half height: regions of this length to both sides of seeds of density p leave half of all gaps.
fn growth_length(chain: &Chain, at: Estimate) -> Option<Estimate> {
    let (omega, big_omega) = (chain.natural_frequency, chain.forcing_frequency);
    let length = |sigma: f64| {
        let p = ImpactProbability::new(sigma, chain.spacing, omega, big_omega).ok()?.p_from_rest();
        Some(0.5 * std::f64::consts::LN_2 / p.ok()?)
    };
    let [below, above] = [-0.5, 0.5].map(|share| length(at.value + share * at.error));
    Some(with_error(length(at.value)?, (below? - above?).abs()))
}

/// All tables.
pub fn tables(found: &Vec<Counted>) -> Vec<Table> {
    let masses = |own: &Counted| own.ensemble.chain.masses;
    let transient = |own: &Counted| own.first().protocol.transient;
    let longest = found.iter().map(masses).max();
    let lead = |own: &Counted| {
        let same =
            |other: &&Counted| transient(other) == transient(own) && Some(masses(other)) == longest;
        let last = found.iter().find(same).filter(|_| Some(masses(own)) != longest)?;
        Some(difference(half_height(own)?, half_height(last)?))
    };
    let table = Table::of("sizes.places", found, |own| own.ensemble.realisations)
        .key("transient", "1/omega", transient)
        .key("masses", "1", |own| masses(own) as f64)
        .computed_by(origin(Curve::new))
        .estimate(
            "half_height",
            "d omega^2",
            "σ where the mean over all chains passes half of all gaps",
            half_height,
        )
        .estimate(
            "length",
            "1",
            "ℓ = ln 2/2p: to which each gap that closes by itself has sent impacts, to both sides",
            |own| growth_length(&own.ensemble.chain, half_height(own)?),
        )
        .estimate("lead", "d omega^2", "how much lower it is in the longest chains", lead)
        .done();
    vec![table]
}
