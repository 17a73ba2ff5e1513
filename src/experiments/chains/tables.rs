//! What chains of other kinds say, each kind beside the paper's.

use super::run::FREQUENCIES;
use super::{Chains, Curve, Ensemble, chain, joining};
use crate::circuits::impact_probability::ImpactProbability;
use crate::circuits::nucleation::chain::half;
use crate::circuits::nucleation::reach::Reach;
use crate::experiments::protocol_tables::address;
use crate::experiments::{CHAINS, PROTOCOL, Results};
use crate::numerics::estimates::{difference, with_error};
use crate::numerics::statistics::Estimate;
use crate::params::{Chain, ChainCurve, ChainKind};
use crate::table::{Building, Table};
use crate::value::origin;

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
        .estimate("kept_half", UNIT, "where half of the chains have impacts in the end", |place| {
            place.curve.kept_half.filter(|_| place.at + 1 == place.own.transients.len())
        })
        .done();
    let starts = places(found, ChainKind::Drift);
    let starts = begin("chains.starts", &starts)
        .text_key("chain", |place| place.own.name.trim_start_matches("drift-").into());
    let damped = places(found, ChainKind::Damping);
    let damped = begin("chains.damped", &damped).key("damping", "omega", |place| place.own.damping);
    let components = places(found, ChainKind::Components);
    let components = begin("chains.components", &components)
        .key("components", "1", |place| place.own.components as f64);
    let frequencies = places(found, ChainKind::Frequency);
    let frequencies =
        begin("chains.frequencies", &frequencies)
            .key("frequency", "omega", |place| place.own.forcing_frequency);
    let there = |at: usize| {
        move |place: &Place| place.curve.kept_half_expected.map_or(f64::NAN, |own| own[at])
    };
    vec![
        lengths,
        half_height(transient(starts)).done(),
        half_height(transient(damped)).done(),
        kept_half(half_height(components))
            .computed_by(origin(one_frequency))
            .real(
                "one_frequency",
                UNIT,
                3,
                "the same expected of one, at the mean square frequency",
                |place| one_frequency(found, place.own),
            )
            .done(),
        kept_half(half_height(frequencies))
            .real("all_phases", UNIT, 3, "the same expected if all phases come", there(0))
            .real("common_period", UNIT, 3, "the same with those that do", there(1))
            .done(),
        all(found),
    ]
}

fn begin<'a>(name: &'static str, places: &'a [Place<'a>]) -> Building<'a, Place<'a>> {
    Table::of(name, places, |place| place.own.realisations)
}

fn kept_half<'a>(table: Building<'a, Place<'a>>) -> Building<'a, Place<'a>> {
    table.estimate("kept_half", UNIT, "where half of the chains have impacts", |place| {
        place.curve.kept_half
    })
}

/// The σ at which half of the chains ever have an impact, by the formula for clumps, if the force had one component
/// with the same response, at the mean square of their frequencies.
fn one_frequency(found: &Chains, own: &ChainCurve) -> f64 {
    let several = chain(&found.parameters, own);
    let square = |chain: &Chain| chain.forcing_frequency * chain.forcing_frequency;
    let natural = several.natural_frequency * several.natural_frequency;
    let others = FREQUENCIES.iter().take(own.components.saturating_sub(1));
    let mean = others.fold(square(&several), |sum, x| sum + x * natural) / own.components as f64;
    let one = Chain { forcing_frequency: mean.sqrt(), ..several.clone() };
    let reach = Reach::ever(&one, 256);
    let detuning = |chain: &Chain| (natural - square(chain)).abs();
    half(&one, &reach, &reach.every(4)) * detuning(&several) / detuning(&one)
}

/// Open gaps, silence, and sizes.
fn all(found: &Chains) -> Table {
    let chain = &found.parameters.chain;
    let lengths = || found.of(ChainKind::Length).map(|(own, _)| own.masses as f64);
    let silence = found.curve("silence");
    let first = silence.and_then(|(_, curve)| curve.rows.first());
    let total = |of: fn(&Ensemble) -> [u64; 2]| -> u64 {
        found.curves.iter().flat_map(|curve| &curve.rows).map(|row| of(row)[0]).sum()
    };
    Table::of("chains.all", &[()], |()| 0)
        .chosen("shortest", "1", "masses", |()| lengths().reduce(f64::min))
        .chosen("longest", "1", "masses", |()| lengths().reduce(f64::max))
        .chosen("transient", "1/omega", "of the paper's length", |()| {
            found.curve("length-100")?.0.transients.last().copied()
        })
        .chosen("stroke", "1/omega", "time from stroke to stroke", |()| {
            Some(found.parameters.stroke)
        })
        .chosen("sigma", UNIT, "at the rise", |()| Some(SIGMA))
        .chosen("silence_masses", "1", "short chains", |()| Some(silence?.0.masses as f64))
        .chosen("silence_until", "1/omega", "their transient", |()| {
            silence?.0.transients.last().copied()
        })
        .chosen("silence_sigma", UNIT, "their σ", |()| Some(first?.sigma))
        .computed_by(origin(open_length))
        .real("open_length", "1", 2, "masses for each open gap at the rise", |()| {
            open_length(chain, SIGMA)
        })
        .computed_by(origin(joining::join))
        .count("open", "chains with an open gap", |()| total(|row| row.chains))
        .count("open_silent", "of these, silent in the last window", |()| total(|row| row.silent))
        .count("shut", "short chains without an open gap", |()| {
            first.map_or(0, |row| row.chains[1])
        })
        .count("shut_silent", "of these, silent in the last window", |()| {
            first.map_or(0, |row| row.silent[1])
        })
        .done()
}

/// 1/P(Q > d): the forced motion of a gap between masses closes it with this probability.
fn open_length(chain: &crate::params::Chain, sigma: f64) -> f64 {
    let square = |x: f64| x * x;
    let detuning = (square(chain.natural_frequency) - square(chain.forcing_frequency)).abs();
    pxfm::f_exp(square(0.5 * chain.spacing * detuning / sigma))
}

/// Half heights without friction, which the map over protocols has, and how much they fall.
pub fn beside_map(results: &Results, _: &[Table]) -> Option<Vec<Table>> {
    let (found, map) = (results.of(&CHAINS).ok()?, results.of(&PROTOCOL).ok()?);
    let window = found.parameters.window;
    let of_map = |time| map.cell(time, window)?.half_height_all;
    let damped: Vec<_> = found.of(ChainKind::Damping).collect();
    let (strongest, curve) = *damped.last()?;
    let times = &strongest.transients;
    let undamped = Table::of("chains.undamped", times, |_| map.parameters.realisations)
        .key("transient", "1/omega", |time| *time)
        .estimate("half_height", UNIT, "of the paper's chain", |time| of_map(*time))
        .same("half_height", |time| {
            map.cell(*time, window).map(|own| address("protocol", own, "half_height_all"))
        })
        .done();
    let (from, to) = (*times.get(1)?, *times.last()?);
    let late = |at: usize| curve.half_heights.get(at).copied().flatten();
    let fall = |early: Option<Estimate>, late: Option<Estimate>| {
        early.zip(late).map(|(early, late)| difference(early, late))
    };
    // Errors as if both were of different chains, which makes them too large.
    let fall = Table::of("chains.fall", &[()], |()| map.parameters.realisations)
        .chosen("from", "1/omega", "first transient", |()| Some(from))
        .chosen("to", "1/omega", "last transient", |()| Some(to))
        .chosen("damping", "omega", "the strongest friction", |()| Some(strongest.damping))
        .computed_by(origin(beside_map))
        .estimate("undamped", UNIT, "fall of the half height without friction", |()| {
            fall(of_map(from), of_map(to))
        })
        .over(|()| strongest.realisations)
        .estimate("damped", UNIT, "the same with the strongest friction", |()| {
            fall(late(1), late(times.len() - 1))
        })
        .done();
    Some(vec![undamped, fall])
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
