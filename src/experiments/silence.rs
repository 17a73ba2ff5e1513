//! Whether impacts ever end: chains that were hit, and when they are hit again; and how far impacts come, beside the closed theory.
//!
//! They do not. Let the last impact of a chain be at a gap of width d + R cos(ωt + φ) + Q cos(Ωt + ψ) afterwards, for ever. It is zero at the impact and
//! rises at r V > 0 there, so its least value over all phases is below zero: R + Q > d. As ω and Ω have no common period the phases come as near to
//! the least value as one likes, and the gap closes. Contact is no way out: a shut gap is pressed by a force whose mean opens it, for the springs
//! part the masses, so contact ends; the width has vanishing first and second derivatives then, which at its least it cannot have.

use super::ensembles::{Begun, Ensembles, Ran, Running, count};
use super::{Error, Progress, weights};
use crate::circuits::closed::spread::Spreading;
use crate::dynamics::Scenario;
use crate::numerics::estimates::{average, ratio};
use crate::numerics::random::NormalPairs;
use crate::numerics::statistics::Estimate;
use crate::params::{Chain, Profile, SEED};
use crate::table::Table;
use literate::experiments::cutting::Row as Work;
use serde::{Deserialize, Serialize};

/// What is run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SilenceParams {
    /// Restitution r, standard deviation σ and number of chains of each row.
    pub rows: Vec<(f64, f64, usize)>,
    /// Number of masses n.
    pub masses: usize,
    /// Transient T and window W.
    pub times: [f64; 2],
    /// So long a chain that is silent in the window is waited for.
    pub patience: f64,
    /// Name of the random stream.
    pub stream: String,
    /// Master seed.
    pub seed: u64,
}

impl SilenceParams {
    /// The sizes of each profile.
    pub fn new(profile: Profile) -> Self {
        let (few, transient) = match profile {
            Profile::Full | Profile::Deep => (1, 4000.0),
            Profile::Ci => (10, 1000.0),
            Profile::Quick => (20, 500.0),
        };
        let rows = [
            (0.3, 0.1, 200),
            (0.6, 0.1, 200),
            (0.6, 0.12, 100),
            (0.6, 0.14, 100),
            (0.8, 0.08, 600),
            (0.8, 0.1, 200),
            (0.8, 0.12, 100),
            (0.9, 0.1, 200),
        ];
        SilenceParams {
            rows: rows.map(|(r, sigma, chains)| (r, sigma, chains / few)).into(),
            masses: Chain::default().masses,
            times: [transient, 200.0],
            patience: 1e6,
            stream: "silence".into(),
            seed: SEED,
        }
    }

    fn chain(&self, row: usize) -> Chain {
        Chain { restitution: self.rows[row].0, masses: self.masses, ..Chain::default() }
    }
}

/// One chain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Gaps that were hit in the transient.
    pub reached: u64,
    /// Those of them with an impact in the window.
    pub active: u64,
    /// All gaps with an impact in the window.
    pub count: u64,
    /// When the first impact after the transient comes; none if it was waited for in vain.
    pub next: Option<f64>,
    /// What the closed theory expects for `reached`, under the same forces.
    pub expected: f64,
}

/// For each row its chains; none where the engine gave up.
pub type Silence = Ran<SilenceParams, Option<Run>>;

impl Ensembles for SilenceParams {
    type One = Option<Run>;

    fn rows(&self) -> Vec<Work> {
        let until = self.times[0] + self.times[1];
        let row = |(at, &(r, sigma, realisations)): (usize, &(f64, f64, usize))| {
            let weight = weights::run(&self.chain(at), sigma, until) + 50 * self.masses as u64;
            Work { covers: format!("r = {r}, sigma = {sigma}"), realisations, weight }
        };
        self.rows.iter().enumerate().map(row).collect()
    }

    fn row<'a>(&'a self, row: usize, progress: &'a Progress) -> Begun<'a, Option<Run>> {
        let (chain, (_, sigma, _)) = (self.chain(row), self.rows[row]);
        let fault = |source| Error::failed("silence", source);
        let spreading = Spreading::new(&chain).map_err(fault)?;
        Ok(Box::new(move |index| {
            let mut normals = NormalPairs::new(&self.stream, self.seed, index);
            let scenario = Scenario::draw(&chain, sigma, &mut normals);
            let Some(mut run) = simulated(self, &scenario, progress)? else { return Ok(None) };
            let drawn = spreading.drawn(sigma, &scenario.forcing).map_err(fault)?;
            run.expected = drawn.mean_counts(&[[0.0, self.times[0]]], &mut normals)[0];
            Ok(Some(run))
        }))
    }

    fn fits(&self, _: usize, run: &Option<Run>) -> bool {
        let gaps = self.masses as u64 + 1;
        run.is_none_or(|run| {
            run.reached.max(run.count) <= gaps && run.active <= run.reached.min(run.count)
        })
    }
}

fn simulated(
    parameters: &SilenceParams,
    scenario: &Scenario,
    progress: &Progress,
) -> Result<Option<Run>, Error> {
    let [transient, window] = parameters.times;
    let mut motion = Running::new(scenario, "silence", progress)?;
    let (mut before, mut within) = (vec![false; scenario.gaps()], vec![false; scenario.gaps()]);
    let mut next = None;
    let mut ran = motion.go(transient, |impact| before[impact.gap] = true)?
        && motion.go(transient + window, |impact| {
            within[impact.gap] = true;
            next.get_or_insert(impact.time);
        })?;
    let [reached, count] = [&before, &within].map(|hit| count(hit));
    if reached > 0 && count == 0 {
        ran &= motion.go_while(transient + parameters.patience, |impact| {
            next = Some(impact.time);
            false
        })?;
    }
    let active = before.iter().zip(&within).filter(|(a, b)| **a && **b).count() as u64;
    Ok(ran.then_some(Run { reached, active, count, next, expected: 0.0 }))
}

/// One row.
struct Row<'a> {
    at: (f64, f64),
    end: f64,
    runs: Vec<&'a Run>,
}

impl Row<'_> {
    /// Chains that were hit in the transient and in the window were not.
    fn silent(&self) -> impl Iterator<Item = &&Run> {
        self.runs.iter().filter(|run| run.reached > 0 && run.count == 0)
    }

    fn mean(&self, of: impl Fn(&Run) -> f64) -> Option<Estimate> {
        average(&self.runs.iter().map(|run| of(run)).collect::<Vec<_>>())
    }
}

/// All tables.
pub fn tables(silence: &Silence) -> Vec<Table> {
    let parameters = &silence.parameters;
    let end = parameters.times.iter().sum();
    let both = parameters.rows.iter().zip(&silence.rows);
    let row = |(&(r, sigma, _), part)| -> Row<'_> {
        let part: &Vec<Option<Run>> = part;
        Row { at: (r, sigma), end, runs: part.iter().flatten().collect() }
    };
    let rows: Vec<Row<'_>> = both.map(row).collect();
    let of = Table::of("silence.rows", &rows, |row| row.runs.len())
        .key("r", "1", |row| row.at.0)
        .key("sigma", "d omega^2", |row| row.at.1)
        .count("hit", "chains with an impact in the transient", |row| {
            row.runs.iter().filter(|run| run.reached > 0).count() as u64
        })
        .count("silent", "of these, without an impact in the window", |row| {
            row.silent().count() as u64
        })
        .count("resumed", "of these, with an impact later", |row| {
            row.silent().filter(|run| run.next.is_some()).count() as u64
        })
        .real(
            "latest",
            "1/omega",
            2,
            "the latest of these impacts, since the window's end",
            |row| row.silent().filter_map(|run| run.next).fold(f64::NAN, f64::max) - row.end,
        )
        .estimate("reached", "1", "gaps that were hit in the transient, mean of all", |row| {
            row.mean(|run| run.reached as f64)
        })
        .estimate("reached_expected", "1", "the same by the closed theory, same forces", |row| {
            row.mean(|run| run.expected)
        })
        .estimate("quiet", "1", "share of these without an impact in the window", |row| {
            let pair = |run: &&Run| [(run.reached - run.active) as f64, run.reached as f64];
            ratio(&row.runs.iter().map(pair).collect::<Vec<_>>())
        })
        .done();
    let sum = |of: fn(&Row<'_>) -> usize| rows.iter().map(of).sum::<usize>() as u64;
    let whole = Table::of("silence.all", &[parameters], |_| 0)
        .chosen("transient", "1/omega", "", |own| Some(own.times[0]))
        .chosen("window", "1/omega", "", |own| Some(own.times[1]))
        .count("silent", "chains that were hit and are silent in the window", |_| {
            sum(|row| row.silent().count())
        })
        .count("resumed", "of these, with an impact later", |_| {
            sum(|row| row.silent().filter(|run| run.next.is_some()).count())
        })
        .done();
    vec![of, whole]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Engine;

    #[test]
    fn tables_by_hand() {
        let mut parameters = SilenceParams::new(Profile::Quick);
        (parameters.rows, parameters.times) = (vec![(0.6, 0.1, 4)], [500.0, 200.0]);
        let run = |reached, active, count, next| {
            Some(Run { reached, active, count, next, expected: 6.0 })
        };
        let rows = vec![vec![
            run(0, 0, 0, None),
            run(5, 2, 3, Some(501.0)),
            run(3, 0, 0, Some(900.0)),
            run(2, 0, 0, None),
            None,
        ]];
        let [rows, all] = <[_; 2]>::try_from(tables(&Silence { parameters, rows })).unwrap();
        let of = |column: &str| rows.number(&[("sigma", 0.1)], column).unwrap();
        assert_eq!(["hit", "silent", "resumed"].map(of), [3.0, 2.0, 1.0]);
        assert_eq!(["latest", "reached"].map(of), [200.0, 2.5]);
        assert_eq!(["quiet", "reached_expected"].map(of), [0.8, 6.0]);
        assert_eq!(all.number(&[], "resumed"), Ok(1.0));
    }

    /// Silent chains are waited for, and no others; they are found again by runs without a break.
    #[test]
    fn silent_chains_are_hit_again() {
        let parameters = SilenceParams {
            rows: vec![(0.3, 0.12, 120), (0.8, 0.02, 2)],
            masses: 20,
            times: [400.0, 50.0],
            ..SilenceParams::new(Profile::Quick)
        };
        let found = crate::experiments::ensembles::cutting()
            .run(&parameters, "test", &Progress::silent())
            .unwrap();
        assert!(found.rows[1].iter().all(|run| *run == Some(Run::default())));
        let mut silent = 0;
        for (index, run) in (0_u64..).zip(&found.rows[0]) {
            let run = run.unwrap();
            assert_eq!(run.next.is_some(), run.reached > 0 || run.count > 0, "{run:?}");
            let Some(next) = run.next.filter(|_| run.count == 0) else { continue };
            silent += 1;
            let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
            let mut times = Vec::new();
            let scenario = Scenario::draw(&parameters.chain(0), 0.12, &mut normals);
            let mut engine = Engine::new(&scenario).unwrap();
            engine
                .run(next + 1e-9, |impact| {
                    times.push(impact.time);
                    true
                })
                .unwrap();
            let [.., before, last] = times[..] else { panic!("{times:?}") };
            assert!(before <= 400.0 && last == next && next > 450.0, "{before} {next}");
        }
        assert!(silent > 3, "{silent}");
    }
}
