//! The mean count by the closed theory ([`circuits::closed`](crate::circuits::closed)), beside chains that are run under the
//! same forces.

use super::weights;
use super::{Error, Progress};
use crate::circuits::closed::spread::Spreading;
use crate::dynamics::{self, Engine, Scenario};
use crate::numerics::estimates::{average, half_height, jackknife, rise, with_error};
use crate::numerics::random::NormalPairs;
use crate::numerics::statistics::{Estimate, mean};
use crate::params::{Chain, Grid, Profile, SEED};
use crate::table::Table;
use literate::experiments::cutting::{Cutting, Row, Unit};
use literate::experiments::progress::Stage;
use serde::{Deserialize, Serialize};

/// What is compared.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClosedParams {
    /// Restitution r and number of masses n of each kind of chain, and how many are drawn at each σ.
    pub chains: Vec<(f64, usize, usize)>,
    /// Standard deviations σ, rising.
    pub sigmas: Vec<f64>,
    /// Transients T and windows W, rising; all are counted in the same runs.
    pub protocols: Vec<[f64; 2]>,
    /// Name of the random stream.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

impl ClosedParams {
    /// The sizes of each profile.
    pub fn new(profile: Profile) -> Self {
        let (chains, step, last): (&[(f64, usize, usize)], _, _) = match profile {
            Profile::Full | Profile::Deep => (
                &[(0.6, 100, 400), (0.8, 100, 400), (0.9, 100, 400), (0.8, 1000, 40)],
                5,
                [4000.0, 200.0],
            ),
            Profile::Ci => (&[(0.6, 100, 8), (0.8, 100, 8), (0.9, 100, 8)], 10, [1000.0, 200.0]),
            Profile::Quick => (&[(0.6, 100, 3), (0.8, 100, 3), (0.9, 100, 3)], 20, [500.0, 200.0]),
        };
        let first = [[100.0, 100.0], [500.0, 200.0]];
        let mut protocols = first.to_vec();
        protocols.extend([last].into_iter().filter(|own| !first.contains(own)));
        ClosedParams {
            chains: chains.to_vec(),
            sigmas: Grid::default().and(80, 165, step, 1000).values(),
            protocols,
            stream: "closed".into(),
            seed: SEED,
        }
    }

    fn chain(&self, kind: usize) -> Chain {
        let (restitution, masses, _) = self.chains[kind];
        Chain { restitution, masses, ..Chain::default() }
    }

    /// Kind and σ of a row.
    fn at(&self, row: usize) -> (usize, f64) {
        (row / self.sigmas.len(), self.sigmas[row % self.sigmas.len()])
    }
}

/// The least r for which the theory is meant: below, much of what was reached falls quiet for long.
pub const MEANT_FOR: f64 = 0.7;

/// One chain, for each protocol: the gaps with an impact when it is run, and the number that the theory expects.
pub type Counts = Option<Vec<(u64, f64)>>;

/// Some chains of one row.
pub type Part = Vec<Counts>;

/// All chains.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Closed {
    /// What was compared.
    pub parameters: ClosedParams,
    /// For each kind of chain, for each σ, its chains.
    pub rows: Vec<Part>,
}

/// The experiment in units of work.
pub const CUTTING: Cutting<ClosedParams, Part, Closed> = Cutting { rows, part, fits, join };

fn rows(parameters: &ClosedParams) -> Vec<Row> {
    let until: f64 = parameters.protocols.last().map_or(0.0, |own| own.iter().sum());
    let row = |at: usize| {
        let (kind, sigma) = parameters.at(at);
        let (r, n, realisations) = parameters.chains[kind];
        let chain = parameters.chain(kind);
        let weight = weights::run(&chain, sigma, until) + 5000 * n as u64 / 100;
        Row { covers: format!("r = {r}, n = {n}, sigma = {sigma}"), realisations, weight }
    };
    (0..parameters.chains.len() * parameters.sigmas.len()).map(row).collect()
}

fn part(
    parameters: &ClosedParams,
    unit: &Unit,
    stage: &Stage,
    progress: &Progress,
) -> Result<Part, Error> {
    let (kind, sigma) = parameters.at(unit.row);
    let chain = parameters.chain(kind);
    let spreading = Spreading::new(&chain).map_err(|source| Error::failed("closed", source))?;
    unit.each(stage, |index| {
        progress.check()?;
        let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
        let scenario = Scenario::draw(&chain, sigma, &mut normals);
        let Some(found) = simulated(parameters, &scenario, progress)? else { return Ok(None) };
        let drawn = spreading
            .drawn(sigma, &scenario.forcing)
            .map_err(|source| Error::failed("closed", source))?;
        let expected = drawn.mean_counts(&parameters.protocols, &mut normals);
        Ok(Some(found.into_iter().zip(expected).collect()))
    })
}

/// Gaps with an impact in each window, in one run; windows do not overlap. None where the engine gave up.
fn simulated(
    parameters: &ClosedParams,
    scenario: &Scenario,
    progress: &Progress,
) -> Result<Option<Vec<u64>>, Error> {
    let fault = |source| Error::failed("closed", source);
    let mut engine = Engine::new(scenario).map_err(fault)?;
    let mut counts = Vec::new();
    for [transient, window] in &parameters.protocols {
        let mut hit = vec![false; scenario.forcing.len() + 1];
        let run = engine.run(*transient, |_| !progress.stopped()).and_then(|()| {
            engine.run(transient + window, |impact| {
                hit[impact.gap] = true;
                !progress.stopped()
            })
        });
        match run {
            Ok(()) => (),
            Err(dynamics::Error::Work { .. }) => return Ok(None),
            Err(source) => return Err(fault(source)),
        }
        progress.check()?;
        counts.push(hit.into_iter().map(u64::from).sum());
    }
    Ok(Some(counts))
}

fn fits(parameters: &ClosedParams, unit: &Unit, runs: &Part) -> bool {
    let gaps = parameters.chains[parameters.at(unit.row).0].1 + 1;
    let fits = |own: &Vec<(u64, f64)>| {
        let within = |pair: &(u64, f64)| {
            pair.0 <= gaps as u64 && (0.0..=gaps as f64 * (1.0 + 1e-12)).contains(&pair.1)
        };
        own.len() == parameters.protocols.len() && own.iter().all(within)
    };
    runs.len() == unit.realisations.len() && runs.iter().flatten().all(fits)
}

pub(crate) fn join(
    parameters: &ClosedParams,
    parts: Vec<Vec<Part>>,
    progress: &Progress,
) -> Result<Closed, Error> {
    progress.check()?;
    let rows = parts.into_iter().map(|parts| parts.concat()).collect();
    Ok(Closed { parameters: parameters.clone(), rows })
}

/// One kind of chain by one protocol, over all σ.
struct Line<'a> {
    closed: &'a Closed,
    kind: usize,
    protocol: usize,
}

impl Line<'_> {
    fn times(&self) -> [f64; 2] {
        self.closed.parameters.protocols[self.protocol]
    }

    fn gaps(&self) -> f64 {
        self.closed.parameters.chains[self.kind].1 as f64 + 1.0
    }

    /// Counts at a place of σ: as found, and as expected, of the same chains.
    fn counts(&self, place: usize) -> [Vec<f64>; 2] {
        let sigmas = self.closed.parameters.sigmas.len();
        let part = &self.closed.rows[self.kind * sigmas + place];
        let own = part.iter().flatten().map(|own| own[self.protocol]);
        own.map(|(found, expected)| (found as f64, expected)).unzip::<_, _, Vec<_>, Vec<_>>().into()
    }

    fn samples(&self) -> [Vec<Vec<f64>>; 2] {
        let places = 0..self.closed.parameters.sigmas.len();
        places.map(|place| self.counts(place).into()).unzip::<_, _, Vec<_>, Vec<_>>().into()
    }

    /// Half height as found, as expected, and the second less the first, of the same chains.
    fn halves(&self) -> [Option<Estimate>; 3] {
        let sigmas = &self.closed.parameters.sigmas;
        let ([found, expected], half) = (self.samples(), self.gaps() / 2.0);
        let members = found.iter().chain(&expected).map(Vec::len).min().unwrap_or(0);
        let apart = jackknife(members, |out| {
            Some(rise(sigmas, &expected, half, out)? - rise(sigmas, &found, half, out)?)
        });
        [half_height(sigmas, &found, half), half_height(sigmas, &expected, half), apart]
    }

    /// The root of the mean square difference of the mean counts, over the σ at which either is between a twentieth and
    /// nineteen twentieths.
    fn off(&self) -> f64 {
        let mean = |own: &[f64]| own.iter().sum::<f64>() / own.len() as f64;
        let inside = |x: f64| (0.05 * self.gaps()..=0.95 * self.gaps()).contains(&x);
        let [found, expected] = self.samples();
        let pairs = found.iter().zip(&expected).map(|(a, b)| (mean(a), mean(b)));
        let pairs: Vec<_> = pairs.filter(|(a, b)| inside(*a) || inside(*b)).collect();
        let squares: f64 = pairs.iter().map(|(a, b)| (a - b) * (a - b)).sum();
        (squares / pairs.len() as f64).sqrt()
    }
}

/// The growth of regions at one σ: what share 1 − s = e^{−2ρℓ} is left at the density ρ of seeds and the length ℓ to which each has
/// grown, so ρ drops out of d ln ℓ/d ln t between two times. As found, as expected, and the second less the first, of the same chains.
fn growth(closed: &Closed, kind: usize, place: usize) -> [Option<Estimate>; 3] {
    let last = closed.parameters.protocols.len() - 1;
    let lines = [last.saturating_sub(1), last].map(|protocol| Line { closed, kind, protocol });
    let ends = lines.each_ref().map(|line| line.times().iter().sum::<f64>());
    let counts = lines.each_ref().map(|line| line.counts(place));
    let exponent = |which: usize, out| {
        let lengths = counts.each_ref().map(|own| {
            let share = left_out(&own[which], out)? / lines[0].gaps();
            (share > 0.0 && share < 1.0).then(|| -pxfm::f_log1p(-share))
        });
        let [before, after] = lengths;
        Some(pxfm::f_log(after? / before?) / pxfm::f_log(ends[1] / ends[0]))
    };
    let members = counts[0][0].len();
    let apart = jackknife(members, |out| Some(exponent(1, out)? - exponent(0, out)?));
    [jackknife(members, |out| exponent(0, out)), jackknife(members, |out| exponent(1, out)), apart]
}

/// The mean of all but one.
fn left_out(sample: &[f64], out: Option<usize>) -> Option<f64> {
    let kept = sample.iter().enumerate().filter(|(at, _)| Some(*at) != out);
    mean(&kept.map(|(_, x)| *x).collect::<Vec<_>>())
}

/// How regions grow in the longest chains, at each σ between the last two protocols.
fn drift(closed: &Closed) -> Table {
    let own = &closed.parameters;
    let longest = (0..own.chains.len()).max_by_key(|kind| own.chains[*kind].1).unwrap_or(0);
    let exponents: Vec<(f64, [Option<Estimate>; 3])> = (own.sigmas.iter().enumerate())
        .map(|(place, sigma)| (*sigma, growth(closed, longest, place)))
        .filter(|(_, own)| own.iter().all(Option::is_some))
        .collect();
    Table::of("closed.drift", &exponents, |_| own.chains[longest].2)
        .key("sigma", "d omega^2", |(sigma, _)| *sigma)
        .estimate(
            "found",
            "1",
            "d ln ℓ/d ln t of the length to which a region is active",
            |(_, own)| own[0],
        )
        .estimate("expected", "1", "the same by the closed theory, same forces", |(_, own)| own[1])
        .estimate("apart", "1", "expected less found", |(_, own)| own[2])
        .done()
}

/// All tables.
pub fn tables(closed: &Closed) -> Vec<Table> {
    let own = &closed.parameters;
    let kinds = 0..own.chains.len();
    let line = |kind, protocol| Line { closed, kind, protocol };
    let lines: Vec<Line<'_>> = kinds
        .flat_map(|kind| (0..own.protocols.len()).map(move |protocol| line(kind, protocol)))
        .collect();
    let cells: Vec<(&Line<'_>, usize)> = lines
        .iter()
        .flat_map(|line| (0..own.sigmas.len()).map(move |place| (line, place)))
        .collect();
    let chain = |line: &Line<'_>| own.chains[line.kind];
    let counts = Table::of("closed.counts", &cells, |(line, _)| chain(line).2)
        .key("r", "1", |(line, _)| chain(line).0)
        .key("masses", "1", |(line, _)| chain(line).1 as f64)
        .key("transient", "1/omega", |(line, _)| line.times()[0])
        .key("sigma", "d omega^2", |(_, place)| own.sigmas[*place])
        .estimate("found", "1", "different gaps with an impact, mean of all", |(line, place)| {
            average(&line.counts(*place)[0])
        })
        .estimate("expected", "1", "the same by the closed theory, same forces", |(line, place)| {
            average(&line.counts(*place)[1])
        })
        .done();
    let halves: Vec<(&Line<'_>, [Option<Estimate>; 3])> =
        lines.iter().map(|line| (line, line.halves())).collect();
    let rises = Table::of("closed.rise", &halves, |(line, _)| chain(line).2)
        .key("r", "1", |(line, _)| chain(line).0)
        .key("masses", "1", |(line, _)| chain(line).1 as f64)
        .key("transient", "1/omega", |(line, _)| line.times()[0])
        .chosen("window", "1/omega", "", |(line, _)| Some(line.times()[1]))
        .estimate("found", "d omega^2", "half height of the mean of all", |(_, own)| own[0])
        .estimate("expected", "d omega^2", "the same by the closed theory", |(_, own)| own[1])
        .estimate("apart", "d omega^2", "expected less found, of the same forces", |(_, own)| {
            own[2]
        })
        .real(
            "off",
            "1",
            2,
            "root mean square difference of the counts over the rise, in gaps",
            |(line, _)| line.off(),
        )
        .done();
    let meant = |line: &&(&Line<'_>, [Option<Estimate>; 3])| chain(line.0).0 >= MEANT_FOR;
    let apart = halves.iter().filter(meant).filter_map(|(_, own)| own[2]);
    let apart = apart.map(|own| own.value.abs()).fold(0.0, f64::max);
    let masses = |which: fn(usize, usize) -> usize| {
        own.chains.iter().map(|chain| chain.1).reduce(which).unwrap_or(0)
    };
    let [shortest, longest] = [masses(usize::min), masses(usize::max)];
    let off = |masses: usize| {
        let own = halves.iter().filter(meant).filter(|(line, _)| chain(line).1 == masses);
        own.map(|(line, _)| line.off()).fold(0.0, f64::max)
    };
    let all = Table::of("closed.all", &[own], |own| own.chains[0].2)
        .count("realisations", "chains at each σ", |own| own.chains[0].2 as u64)
        .count("sigmas", "values of σ", |own| own.sigmas.len() as u64)
        .chosen("meant_for", "1", "least r for which the theory is meant", |_| Some(MEANT_FOR))
        .real("apart", "d omega^2", 2, "largest difference of half heights from there on", |_| {
            apart
        })
        .real("off", "1", 2, "largest difference of counts there, in the shortest chains", |_| {
            off(shortest)
        })
        .real("off_longest", "1", 2, "the same in the longest", |_| off(longest))
        .chosen("longest", "1", "masses of these", |_| Some(longest as f64))
        .chosen("from", "1/omega", "end of the last window but one", |own| {
            own.protocols.iter().rev().nth(1).map(|own| own[0] + own[1])
        })
        .chosen("to", "1/omega", "end of the last window", |own| {
            own.protocols.last().map(|own| own[0] + own[1])
        })
        .done();
    vec![counts, rises, drift(closed), all]
}

/// The expected mean count of a chain from rest, with its sampling error, from so many drawn chains.
///
/// # Errors
/// As [`Spreading::mean_counts`].
pub fn mean_count(
    chain: &Chain,
    sigma: f64,
    times: [f64; 2],
    chains: u64,
) -> Result<Estimate, crate::circuits::Error> {
    let found = Spreading::new(chain)?.mean_counts(sigma, &[times], chains, SEED)?;
    Ok(found.first().copied().unwrap_or(with_error(0.0, 0.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn made() -> Closed {
        let parameters = ClosedParams {
            chains: vec![(0.8, 9, 3)],
            sigmas: vec![0.1, 0.2, 0.3],
            protocols: vec![[10.0, 10.0]],
            ..ClosedParams::new(Profile::Quick)
        };
        // Means as found 0, 5, 10, as expected 2, 8, 10.
        let row = |found: [u64; 3], expected: f64| -> Part {
            found.iter().map(|own| Some(vec![(*own, expected)])).collect()
        };
        let rows = vec![row([0; 3], 2.0), row([4, 5, 6], 8.0), row([10; 3], 10.0)];
        Closed { parameters, rows }
    }

    #[test]
    fn half_heights_and_distances_by_hand() {
        let tables = tables(&made());
        let keys = [("r", 0.8), ("masses", 9.0), ("transient", 10.0)];
        let of = |column: &str| tables[1].number(&keys, column).unwrap();
        assert!((of("found") - 0.2).abs() < 1e-12);
        assert!((of("expected") - 0.15).abs() < 1e-12 && (of("apart") + 0.05).abs() < 1e-12);
        // At the first two σ one of both is inside the rise: 2 and 3 apart.
        assert!((of("off") - 6.5_f64.sqrt()).abs() < 1e-12);
        let all = tables.last().unwrap();
        assert_eq!(all.number(&[], "off"), Ok(of("off")));
        assert!((all.number(&[], "apart").unwrap() - 0.05).abs() < 1e-12);
        let keys = [("r", 0.8), ("masses", 9.0), ("transient", 10.0), ("sigma", 0.2)];
        assert_eq!(tables[0].number(&keys, "found").unwrap(), 5.0);
    }

    /// Shares that leave e^{−1} and e^{−3} at times 20 and 60 have grown as t, those that leave as much at both not at all.
    #[test]
    fn growth_by_hand() {
        let mut closed = made();
        closed.parameters.protocols = vec![[10.0, 10.0], [50.0, 10.0]];
        let shares = [-1.0, -3.0].map(|log: f64| -10.0 * pxfm::f_expm1(log));
        let run = Some(vec![(5, shares[0]), (5, shares[1])]);
        closed.rows = vec![vec![run; 3]; 3];
        let found = growth(&closed, 0, 0).map(|own| own.unwrap().value);
        for (found, expected) in found.into_iter().zip([0.0, 1.0, 1.0]) {
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
        assert_eq!(drift(&closed).values("sigma"), [0.1, 0.2, 0.3]);
    }

    #[test]
    fn a_unit_has_what_was_asked() {
        let parameters = ClosedParams {
            chains: vec![(0.8, 20, 2), (0.6, 30, 2)],
            sigmas: vec![0.02, 0.3],
            protocols: vec![[100.0, 60.0], [300.0, 60.0]],
            ..ClosedParams::new(Profile::Quick)
        };
        let found = CUTTING.run(&parameters, "test", &Progress::silent()).unwrap();
        for (at, row) in found.rows.iter().enumerate() {
            let (kind, sigma) = parameters.at(at);
            let gaps = parameters.chains[kind].1 as f64 + 1.0;
            for (count, expected) in row.iter().flatten().flatten() {
                // Far below the rise none, far above it all.
                let whole = if sigma < 0.1 { 0.0 } else { gaps };
                assert!((*count as f64 - whole).abs() < 0.2 * gaps, "{sigma} {count}");
                assert!((expected - whole).abs() < 0.2 * gaps, "{sigma} {expected}");
            }
        }
    }
}
