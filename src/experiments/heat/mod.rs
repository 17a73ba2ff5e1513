//! How hot a running chain is: the variance of the free parts, and the balance of energy that sets it.

mod realisation;
pub mod tables;

use self::realisation::realisation;
use super::ensembles::{Begun, Ensembles, Ran};
use super::{Progress, weights};
use crate::params::{Boundary, Chain, HeatParams, HeatRow};
use literate::experiments::cutting::Row;
use serde::{Deserialize, Serialize};

/// What was run: first the ensembles between walls, then those on a ring; none where the engine gave up.
pub type Heat = Ran<HeatParams, Option<Run>>;

/// One realisation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Half the sum of squares of the free amplitudes of all masses at the end.
    free: f64,
    /// The same of those that were hit in the window.
    free_of_hit: f64,
    /// Their number.
    hit: u64,
    /// Change of `free` in the window.
    changed: f64,
    /// Sum of the changes at impacts.
    gained: f64,
    /// Sum of what restitution took.
    lost: f64,
    /// Impacts of two masses in the window.
    impacts: u64,
    /// Sum of M V² over all impacts in the window.
    squares: f64,
    /// Sum of M V F.
    products: f64,
    /// Different gaps with an impact in the window.
    distinct: u64,
    /// Gaps that can close by themselves.
    closing: u64,
    /// Whether masses stayed in contact.
    contact: bool,
}

fn until(parameters: &HeatParams) -> f64 {
    parameters.protocol.transient + parameters.protocol.window
}

/// Each ensemble with its chain, those on a ring last.
fn ensembles(parameters: &HeatParams) -> impl Iterator<Item = (&HeatRow, Chain)> {
    let of = |boundary| {
        move |row: &HeatRow| Chain {
            restitution: row.restitution,
            boundary,
            ..parameters.chain.clone()
        }
    };
    let between_walls = of(parameters.chain.boundary);
    let walls = parameters.rows.iter().map(move |row| (row, between_walls(row)));
    let on_ring = of(Boundary::Ring);
    walls.chain(parameters.ring.iter().map(move |row| (row, on_ring(row))))
}

impl Ensembles for HeatParams {
    type One = Option<Run>;

    fn rows(&self) -> Vec<Row> {
        let row = |(row, chain): (&HeatRow, Chain)| Row {
            covers: format!("sigma = {}, r = {}, {:?}", row.sigma, row.restitution, chain.boundary),
            realisations: self.realisations,
            weight: weights::run(&chain, row.sigma, until(self)),
        };
        ensembles(self).map(row).collect()
    }

    fn row<'a>(&'a self, row: usize, progress: &'a Progress) -> Begun<'a, Option<Run>> {
        let Some((row, chain)) = ensembles(self).nth(row) else {
            return Ok(Box::new(|_| Ok(None)));
        };
        Ok(Box::new(move |index| realisation(self, row, &chain, index, progress)))
    }

    fn fits(&self, _: usize, run: &Option<Run>) -> bool {
        let (masses, gaps) = (self.chain.masses as u64, self.chain.gaps() as u64);
        let fits = |run: &Run| run.hit <= masses && run.closing <= gaps && run.distinct <= gaps;
        run.as_ref().is_none_or(fits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::ensembles::cutting;
    use crate::params::{Profile, Protocol};

    fn small() -> HeatParams {
        let mut parameters = HeatParams::new(Profile::Quick);
        parameters.chain.masses = 12;
        parameters.protocol = Protocol { transient: 150.0, window: 60.0 };
        parameters.rows = vec![
            HeatRow { sigma: 0.03, restitution: 0.8 },
            HeatRow { sigma: 0.3, restitution: 0.8 },
            HeatRow { sigma: 0.3, restitution: 0.5 },
        ];
        parameters.ring = parameters.rows[1..2].to_vec();
        parameters.realisations = 5;
        parameters
    }

    #[test]
    fn energy_is_accounted_for_and_a_quiet_chain_is_as_it_started() {
        let heat = cutting().run(&small(), "test", &Progress::silent()).unwrap();
        let [rising, others, ring, all] = tables::tables(&heat).try_into().unwrap();
        let of = |sigma: f64, column| rising.number(&[("sigma", sigma)], column);
        // From rest a free part has amplitudes −α and −Ω/ω β: (1 + 2)/2 of σ² in the mean. Twelve
        // masses, five times: the mean of 120 squares.
        let ratio = rising.estimates(&[("sigma", 0.03)], "sigma", "variance_ratio")[0].1;
        assert!((ratio.value - 1.5).abs() < 5.0 * ratio.error && ratio.error < 0.4, "{ratio:?}");
        assert_eq!(of(0.03, "imbalance"), Ok(0.0));
        assert!(of(0.3, "imbalance").unwrap() < 1e-10);
        assert!(
            heat.rows[1..].iter().flatten().flatten().all(|run| run.impacts > 50 && run.hit > 5)
        );
        // What a chain gains is what its balance is above one: changes of both over what restitution took.
        let tame = |column| others.number(&[("r", 0.5)], column).unwrap();
        let walls = all.number(&[], "balance").unwrap();
        assert_eq!(all.number(&[], "balance_on_ring"), ring.number(&[("sigma", 0.3)], "balance"));
        let both = 0.5 * (of(0.3, "balance").unwrap() + tame("balance"));
        assert!((walls - both).abs() < 1e-12 && (walls - 1.0).abs() < 0.2, "{walls} {both}");
        assert!(of(0.3, "variance_ratio").unwrap() > tame("variance_ratio"));
        let p = |column| of(0.3, column).unwrap();
        assert!(p("p_measured") > 0.5 && p("p_balanced") > 0.0);
        assert!((p("balanced") - 18.0).abs() < 1e-12 && (tame("balanced") - 6.0).abs() < 1e-12);
        // ω = d = 1, Ω² = 2, (ω² − Ω²)² = 1: at the rate of impacts force gives what restitution takes.
        for (r, rate, expected) in
            [(0.8, p("rate"), p("balanced_at_rate")), (0.5, tame("rate"), tame("balanced_at_rate"))]
        {
            let lost = 2.0 * ((1.0 + r) * rate) * ((1.0 + r) * rate);
            let kept = 2.0 / (1.0 + lost);
            // Of a² + b² = x² + v²/ω² what friction leaves out of the forced motion has three quarters of 2 v².
            let speed = expected - 0.75 * kept * lost + kept;
            let (given, taken) = ((1.0 + r) * kept, 0.5 * (1.0 - r * r) * speed);
            assert!((given / taken - 1.0).abs() < 1e-12, "{given} {taken}");
        }
    }

    /// Runs that are made up, so that means and ratios are known.
    #[test]
    fn tables_follow_from_the_runs_as_by_hand() {
        let mut parameters = small();
        parameters.realisations = 2;
        let run = |free: f64, hit, impacts, products| {
            let free_of_hit = 0.5 * free;
            Some(Run {
                free,
                free_of_hit,
                hit,
                impacts,
                products,
                squares: 10.0,
                closing: 3,
                ..Run::default()
            })
        };
        let part = vec![run(1.08, 4, 30, 2.0), run(3.24, 5, 60, 1.0), None];
        let heat = Heat { parameters, rows: vec![part; 4] };
        let [rising, ..] = <[_; 4]>::try_from(tables::tables(&heat)).unwrap();
        for (column, expected) in [
            ("variance_ratio", 2.16 / (12.0 * 0.09)),
            ("variance_ratio_of_hit", 2.16 / (9.0 * 0.09)),
            ("rate", 2.0 * 90.0 / (9.0 * 60.0)),
            ("balance", 3.0 / (0.5 * 0.2 * 20.0)),
            ("p_measured", 6.0 / 26.0),
        ] {
            let found = rising.number(&[("sigma", 0.3)], column).unwrap();
            assert!((found - expected).abs() < 1e-12, "{column}: {found} {expected}");
        }
    }
}
