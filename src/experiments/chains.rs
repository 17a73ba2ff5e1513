//! Chains of several lengths, random starts and rings, after several transients.

use super::starts::HALF_HEIGHT;
use impact_chain::Chain;
use impact_chain::rise::{Counted, Curve};
use literate::table::Table;
use literate::value::origin;

/// The σ of which the text speaks: at the rise.
const SIGMA: f64 = 0.12;

const UNIT: &str = "d omega^2";

/// Whether an ensemble is there for its length.
pub fn is_length(own: &Counted) -> bool {
    own.ensemble.name.starts_with("length")
}

/// All tables.
pub fn tables(found: &Vec<Counted>) -> Vec<Table> {
    let mut rows: Vec<(&Counted, &Curve)> = Vec::new();
    for own in found {
        rows.extend(own.curves.iter().map(|curve| (own, curve)));
    }
    let transient = |row: &(&Counted, &Curve)| row.1.protocol.transient;
    let half = |row: &(&Counted, &Curve)| row.1.rise.half_height_all;
    let realisations = |row: &(&Counted, &Curve)| row.0.ensemble.realisations;
    let (mut lengths, starts): (Vec<_>, Vec<_>) =
        rows.into_iter().partition(|(own, _)| is_length(own));
    let masses = |own: &Counted| own.ensemble.chain.masses;
    lengths
        .sort_by(|a, b| transient(a).total_cmp(&transient(b)).then(masses(a.0).cmp(&masses(b.0))));
    let of_length = Table::of("chains.lengths", &lengths, realisations)
        .key("transient", "1/omega", transient)
        .key("masses", "1", |row| masses(row.0) as f64)
        .computed_by(origin(Curve::new))
        .estimate("half_height", UNIT, HALF_HEIGHT, half)
        .estimate("width", UNIT, "from a tenth to nine tenths of all gaps", |row| row.1.rise.width)
        .done();
    let of_start = Table::of("chains.starts", &starts, realisations)
        .text_key("chain", |row| row.0.ensemble.name.clone())
        .key("transient", "1/omega", transient)
        .computed_by(origin(Curve::new))
        .estimate("half_height", UNIT, HALF_HEIGHT, half)
        .done();
    let all = || lengths.iter().map(|row| masses(row.0) as f64);
    let all = Table::of("chains.all", &[()], |()| 0)
        .chosen("shortest", "1", "masses", |()| all().reduce(f64::min))
        .chosen("longest", "1", "masses", |()| all().reduce(f64::max))
        .chosen("sigma", UNIT, "at the rise", |()| Some(SIGMA))
        .computed_by(origin(open_length))
        .real("open_length", "1", 2, "masses for each open gap at the rise", |()| {
            open_length(&Chain::default(), SIGMA)
        })
        .done();
    vec![of_length, of_start, all]
}

/// 1/P(Q > d): the forced motion of a gap between masses closes it with this probability.
fn open_length(chain: &Chain, sigma: f64) -> f64 {
    let square = |x: f64| x * x;
    let detuning = (square(chain.natural_frequency) - square(chain.forcing_frequency)).abs();
    pxfm::f_exp(square(0.5 * chain.spacing * detuning / sigma))
}
