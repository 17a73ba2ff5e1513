//! What follows from the runs.

use super::{Heat, Run, ensembles, until};
use crate::circuits;
use crate::circuits::balance::{variance_ratio, variance_ratio_at};
use crate::circuits::closed::heat::{Heat as ClosedHeat, heat as closed_heat};
use crate::circuits::closed::ordered::OrderedGas;
use crate::circuits::closed::spread::Spreading;
use crate::circuits::distribution::SampleSpace;
use crate::circuits::impact_probability::ImpactProbability;
use crate::circuits::jump;
use crate::dynamics::Scenario;
use crate::experiments::closed::MEANT_FOR;
use crate::numerics::bisection;
use crate::numerics::estimates::{average, jackknife, ratio, sums};
use crate::numerics::random::NormalPairs;
use crate::numerics::statistics::{Estimate, mean};
use crate::params::{Chain, HeatParams, HeatRow};
use crate::table::Table;
use rayon::prelude::*;

/// One ensemble.
struct Row<'a> {
    parameters: &'a HeatParams,
    row: &'a HeatRow,
    chain: Chain,
    part: &'a [Option<Run>],
    runs: Vec<&'a Run>,
    /// The closed theory, where it has a running chain.
    closed: Option<ClosedHeat>,
    /// Half the sums of squares of all free amplitudes by the closed theory and as found, run by run; none on a ring.
    all: Vec<[f64; 2]>,
}

/// All tables.
pub fn tables(heat: &Heat) -> Vec<Table> {
    let parameters = &heat.parameters;
    let mut rows = Vec::new();
    let gas = OrderedGas::new();
    for ((row, chain), part) in ensembles(parameters).zip(&heat.rows) {
        let closed = closed_heat(&gas, &chain, row.sigma).ok().flatten();
        let runs = part.iter().flatten().collect();
        let mut own = Row { parameters, row, chain, part, runs, closed, all: Vec::new() };
        own.all = own.closed_all();
        rows.push(own);
    }
    let (walls, ring) = rows.split_at(parameters.rows.len());
    // First the paper's restitution at rising σ, then other restitutions at one σ.
    let rises = |pair: &&[Row<'_>]| pair[0].row.sigma < pair[1].row.sigma;
    let rising = (1 + walls.windows(2).take_while(rises).count()).min(walls.len());
    let (rising, others) = walls.split_at(rising);
    let sigma = |row: &Row<'_>| row.row.sigma;
    // The paper's restitution stands among the others too.
    let again = |row: &&Row<'_>| rising.iter().any(|own| own.row == row.row);
    let different: Vec<&Row<'_>> =
        rising.iter().chain(others.iter().filter(|row| !again(row))).collect();
    vec![
        ensembles_by("heat.rising", rising, ("sigma", "d omega^2"), sigma),
        ensembles_by("heat.others", others, ("r", "1"), |row| row.row.restitution),
        ensembles_by("heat.ring", ring, ("sigma", "d omega^2"), sigma),
        all(parameters, &different, &ring.iter().collect::<Vec<_>>()),
    ]
}

/// Ensembles by one parameter.
fn ensembles_by(
    name: &'static str,
    rows: &[Row<'_>],
    (key, unit): (&'static str, &'static str),
    by: impl Fn(&Row<'_>) -> f64,
) -> Table {
    Table::of(name, rows, |row| row.runs.len())
        .key(key, unit, by)
        .estimate(
            "variance_ratio",
            "1",
            "s²/σ² when the window ends: mean over all masses of half the sum of squares of both free amplitudes, over σ²",
            |row| row.mean(|run| run.free / row.masses_sigma2()),
        )
        .estimate("variance_ratio_of_hit", "1", "the same of the masses that were hit in the window", |row| {
            row.ratio(|run| [run.free_of_hit, run.hit as f64 * row.sigma2()])
        })
        .real("balanced", "1", 2, "the same by the balance of rare impacts", |row| {
            variance_ratio(&row.chain).unwrap_or(f64::NAN)
        })
        .real("rate", "omega", 2, "impacts of a mass with others per unit of time, over the masses that were hit", Row::rate)
        .real("balanced_at_rate", "1", 3, "s²/σ² by the balance at that rate", |row| {
            variance_ratio_at(&row.chain, row.rate()).unwrap_or(f64::NAN)
        })
        .real("closed", "1", 3, "s²/σ² by the closed theory; none where it has no running chain", |row| {
            row.closed.map_or(f64::NAN, |own| own.free) / row.sigma2()
        })
        .real("narrower", "1", 2, "variance of a gap among ordered masses there, over twice that of a mass", |row| {
            row.closed.map_or(f64::NAN, |own| own.narrower)
        })
        .estimate("closed_over_hit", "1", "the same over what is found for the masses that were hit", |row| {
            row.closed_over_hit()
        })
        .real("closed_all", "1", 3, "s²/σ² of all masses by the closed theory, under the same forces", |row| {
            let sum: f64 = row.all.iter().map(|own| own[0]).sum();
            sum / (row.all.len() as f64 * row.masses_sigma2())
        })
        .estimate("closed_over_all", "1", "the same over what is found", |row| ratio(&row.all))
        .estimate(
            "balance",
            "1",
            "2 ⟨M V F⟩ / ((1 − r) ⟨M V²⟩) over all impacts in the window: one in a steady state",
            |row| row.ratio(|run| work(row.row, run)),
        )
        .real("imbalance", "1", 1, "change of energy less what impacts gave, over what they took; none with lasting contact", Row::imbalance)
        .estimate("mean_count", "1", "different gaps with an impact", |row| row.mean(|run| run.distinct as f64))
        .count("impacts", "impacts of two masses in the window", |row| row.sum(|run| run.impacts))
        .real("p_balanced", "1", 2, "p with free parts as hot as the balance says", |row| {
            number(variance_ratio(&row.chain).and_then(|ratio| balanced(&row.chain, row.row.sigma, ratio)))
        })
        .real("p_measured", "1", 2, "share of gaps that can close by themselves when the window ends, Y₀ + Y₁ ≥ d", |row| {
            row.sum(|run| run.closing) as f64 / (row.chain.gaps() * row.runs.len()).max(1) as f64
        })
        .done()
}

/// Numbers of all ensembles together.
fn all(parameters: &HeatParams, walls: &[&Row<'_>], ring: &[&Row<'_>]) -> Table {
    Table::of("heat.all", &[parameters], |own| own.realisations)
        .count("realisations", "chains of each ensemble", |own| own.realisations as u64)
        .chosen("transient", "1/omega", "", |own| Some(own.protocol.transient))
        .chosen("window", "1/omega", "", |own| Some(own.protocol.window))
        .chosen("sigma", "d omega^2", "where restitutions are compared", |_| {
            Some(HeatParams::SIGMA)
        })
        .count("ensembles", "different ensembles between walls", |_| walls.len() as u64)
        .real(
            "factor",
            "1",
            2,
            "factor by which the balance of rare impacts is off, root mean square of all",
            |_| factor(walls, |row| variance_ratio(&row.chain)),
        )
        .real("factor_at_rate", "1", 2, "the same of the balance at the rate of impacts", |_| {
            factor(walls, |row| variance_ratio_at(&row.chain, row.rate()))
        })
        .real("closed_hit_off", "1", 1, "largest relative difference of s² by the closed theory, of masses that were hit, where it is meant", |_| {
            largest(walls, |row| row.closed_over_hit())
        })
        .real("closed_all_off", "1", 1, "the same of all masses", |_| {
            largest(walls, |row| ratio(&row.all))
        })
        .estimate("balance", "1", "mean of the balance over the ensembles with impacts", |own| {
            balance(own.realisations, walls)
        })
        .estimate("balance_on_ring", "1", "the same on a ring", |own| {
            balance(own.realisations, ring)
        })
        .real(
            "sigma_jump",
            "d omega^2",
            3,
            "σ at which p with the balanced variance is that of the jump",
            |own| number(sigma_jump(&own.chain)),
        )
        .done()
}

fn number(found: Result<f64, circuits::Error>) -> f64 {
    found.unwrap_or(f64::NAN)
}

/// σ at which p with the balanced variance reaches the jump of the most likely number, for N gaps.
fn sigma_jump(chain: &Chain) -> Result<f64, circuits::Error> {
    let jump = jump::p_jump(SampleSpace::Simple, chain.gaps())?.p;
    let ratio = variance_ratio(chain)?;
    let reaches = |sigma: f64| balanced(chain, sigma, ratio).unwrap_or(0.0) >= jump;
    Ok(bisection::bracket(0.0, 1.0, reaches)[1])
}

/// (r, s²/σ²) by the balance of rare impacts, to be drawn.
pub fn balanced_ratio(parameters: &HeatParams) -> Vec<(f64, f64)> {
    let of = |restitution| Chain { restitution, ..parameters.chain.clone() };
    (40..100).map(|i| f64::from(i) / 100.0).map(|r| (r, number(variance_ratio(&of(r))))).collect()
}

/// p of a chain whose free parts have that variance over σ².
fn balanced(chain: &Chain, sigma: f64, ratio: f64) -> Result<f64, circuits::Error> {
    gap(chain, sigma)?.heated(ratio)?.p()
}

fn gap(chain: &Chain, sigma: f64) -> Result<ImpactProbability, circuits::Error> {
    let (d, omega, big_omega) = (chain.spacing, chain.natural_frequency, chain.forcing_frequency);
    ImpactProbability::new(sigma, d, omega, big_omega)
}

/// Sums of M V F and of (1 − r) M V²/2 over the impacts of a realisation.
fn work(row: &HeatRow, run: &Run) -> [f64; 2] {
    [run.products, 0.5 * (1.0 - row.restitution) * run.squares]
}

/// The mean over ensembles of the ratio of the two sums; a realisation has the same forces in all.
fn balance(realisations: usize, rows: &[&Row<'_>]) -> Option<Estimate> {
    let own = |row: &&Row<'_>| -> Vec<[f64; 2]> {
        row.part.iter().map(|run| run.map_or([0.0; 2], |run| work(row.row, &run))).collect()
    };
    let all: Vec<_> = rows.iter().map(own).collect();
    jackknife(realisations, |out| {
        let ratios = all.iter().map(|own| sums(own, out)).filter(|[_, below]| *below > 0.0);
        let ratios: Vec<f64> = ratios.map(|[above, below]| above / below).collect();
        mean(&ratios)
    })
}

/// By which factor a formula is off for the masses that were hit, in the root mean square over all ensembles.
fn factor(rows: &[&Row<'_>], formula: fn(&Row<'_>) -> Result<f64, circuits::Error>) -> f64 {
    let of = |row: &&Row<'_>| {
        let found = row.ratio(|run| [run.free_of_hit, run.hit as f64 * row.sigma2()])?;
        Some(pxfm::f_log(number(formula(row)) / found.value))
    };
    let logs: Vec<f64> = rows.iter().filter_map(of).collect();
    let square = logs.iter().map(|log| log * log).sum::<f64>() / logs.len().max(1) as f64;
    pxfm::f_exp(square.sqrt())
}

/// The largest difference from one, over all ensembles for which the closed theory is meant.
fn largest(walls: &[&Row<'_>], of: impl Fn(&Row<'_>) -> Option<Estimate>) -> f64 {
    let meant = walls.iter().filter(|row| row.row.restitution >= MEANT_FOR);
    meant.filter_map(|row| of(row)).map(|own| (own.value - 1.0).abs()).fold(0.0, f64::max)
}

impl Row<'_> {
    fn sigma2(&self) -> f64 {
        self.row.sigma * self.row.sigma
    }

    fn mean(&self, of: impl Fn(&Run) -> f64) -> Option<Estimate> {
        average(&self.runs.iter().map(|run| of(run)).collect::<Vec<_>>())
    }

    fn ratio(&self, of: impl Fn(&Run) -> [f64; 2]) -> Option<Estimate> {
        ratio(&self.runs.iter().map(|run| of(run)).collect::<Vec<_>>())
    }

    fn masses_sigma2(&self) -> f64 {
        self.chain.masses as f64 * self.sigma2()
    }

    fn closed_over_hit(&self) -> Option<Estimate> {
        let closed = self.closed?.free;
        self.ratio(|run| [run.hit as f64 * closed, run.free_of_hit])
    }

    fn closed_all(&self) -> Vec<[f64; 2]> {
        let own = self.parameters;
        let Ok(spreading) = Spreading::new(&self.chain) else { return Vec::new() };
        let one = |(index, run): (usize, &Option<Run>)| {
            let mut normals = NormalPairs::new(&own.stream, own.seed, index as u64);
            let scenario = Scenario::draw(&self.chain, self.row.sigma, &mut normals);
            let free = spreading.free(self.row.sigma, &scenario.forcing, until(own), &mut normals);
            Some([free.ok()?, run.as_ref()?.free])
        };
        self.part.par_iter().enumerate().filter_map(one).collect()
    }

    fn sum(&self, of: impl Fn(&Run) -> u64) -> u64 {
        self.runs.iter().map(|run| of(run)).sum()
    }

    /// Each impact is one of two masses.
    fn rate(&self) -> f64 {
        let hit = self.sum(|run| run.hit).max(1) as f64;
        2.0 * self.sum(|run| run.impacts) as f64 / (hit * self.parameters.protocol.window)
    }

    fn imbalance(&self) -> f64 {
        if self.runs.iter().any(|run| run.contact) {
            return f64::NAN;
        }
        let one = |run: &&Run| match run.lost > 0.0 {
            true => (run.changed - run.gained).abs() / run.lost,
            false => run.changed.abs(),
        };
        self.runs.iter().map(one).fold(0.0, f64::max)
    }
}
