//! What chains of other kinds say, each kind beside the paper's.

use super::{Chains, Curve, joining};
use crate::params::{Chain, ChainCurve, ChainKind};
use impact_circuits::impact_probability::ImpactProbability;
use impact_numerics::estimates::{difference, with_error};
use impact_numerics::statistics::Estimate;
use literate::table::{Building, Table};
use literate::value::origin;

/// The σ of which the text speaks: at the rise.
const SIGMA: f64 = 0.12;

const UNIT: &str = "d omega^2";

/// A curve after one of its transients.
struct Place<'a> {
    own: &'a ChainCurve,
    curve: &'a Curve,
    at: usize,
}

impl Place<'_> {
    fn transient(&self) -> f64 {
        self.own.transients[self.at]
    }

    fn half_height(&self) -> Option<Estimate> {
        self.curve.half_heights[self.at]
    }
}

fn places(found: &Chains, kind: ChainKind) -> Vec<Place<'_>> {
    let of = |(own, curve): (_, _)| after(own, curve);
    found.of(kind).flat_map(of).collect()
}

fn after<'a>(own: &'a ChainCurve, curve: &'a Curve) -> impl Iterator<Item = Place<'a>> {
    (0..own.transients.len()).map(move |at| Place { own, curve, at })
}

fn half_height<'a>(table: Building<'a, Place<'a>>) -> Building<'a, Place<'a>> {
    table.computed_by(origin(joining::curve)).estimate(
        "half_height",
        UNIT,
        "σ where the mean over all chains passes half of all gaps",
        Place::half_height,
    )
}

fn transient<'a>(table: Building<'a, Place<'a>>) -> Building<'a, Place<'a>> {
    table.key("transient", "1/omega", Place::transient)
}

fn masses<'a>(table: Building<'a, Place<'a>>) -> Building<'a, Place<'a>> {
    table.key("masses", "1", |place| place.own.masses as f64)
}

/// All tables.
pub fn tables(found: &Chains) -> Vec<Table> {
    let mut lengths = places(found, ChainKind::Length);
    lengths.sort_by(|a, b| {
        a.transient().total_cmp(&b.transient()).then(a.own.masses.cmp(&b.own.masses))
    });
    let lengths = masses(transient(begin("chains.lengths", &lengths)));
    let lengths = half_height(lengths)
        .estimate("width", UNIT, "from a tenth to nine tenths of all gaps", |place| {
            place.curve.widths[place.at]
        })
        .done();
    let starts = places(found, ChainKind::Drift);
    let starts = begin("chains.starts", &starts)
        .text_key("chain", |place| place.own.name.trim_start_matches("drift-").into());
    vec![lengths, half_height(transient(starts)).done(), all(found)]
}

fn begin<'a>(name: &'static str, places: &'a [Place<'a>]) -> Building<'a, Place<'a>> {
    Table::of(name, places, |place| place.own.realisations)
}

/// Sizes, and the length in which one open gap is to be expected.
fn all(found: &Chains) -> Table {
    let chain = &found.parameters.chain;
    let lengths = || found.of(ChainKind::Length).map(|(own, _)| own.masses as f64);
    Table::of("chains.all", &[()], |()| 0)
        .chosen("shortest", "1", "masses", |()| lengths().reduce(f64::min))
        .chosen("longest", "1", "masses", |()| lengths().reduce(f64::max))
        .chosen("sigma", UNIT, "at the rise", |()| Some(SIGMA))
        .computed_by(origin(open_length))
        .real("open_length", "1", 2, "masses for each open gap at the rise", |()| {
            open_length(chain, SIGMA)
        })
        .done()
}

/// 1/P(Q > d): the forced motion of a gap between masses closes it with this probability.
fn open_length(chain: &Chain, sigma: f64) -> f64 {
    let square = |x: f64| x * x;
    let detuning = (square(chain.natural_frequency) - square(chain.forcing_frequency)).abs();
    pxfm::f_exp(square(0.5 * chain.spacing * detuning / sigma))
}

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

/// Half heights by length and transient.
pub fn sizes(found: &Chains) -> Vec<Table> {
    let all = places(found, ChainKind::Length);
    let longest = all.iter().map(|place| place.own.masses).max();
    let lead = |place: &Place| {
        let same = |other: &&Place| {
            other.transient() == place.transient() && Some(other.own.masses) == longest
        };
        let last = all.iter().find(same).filter(|_| Some(place.own.masses) != longest)?;
        Some(difference(place.half_height()?, last.half_height()?))
    };
    let table = half_height(masses(transient(begin("sizes.places", &all))))
        .estimate(
            "length",
            "1",
            "ℓ = ln 2/2p: to which each gap that closes by itself has sent impacts, to both sides",
            |place| growth_length(&found.parameters.chain, place.half_height()?),
        )
        .estimate("lead", UNIT, "how much lower it is in the longest chains", lead)
        .done();
    vec![table]
}
