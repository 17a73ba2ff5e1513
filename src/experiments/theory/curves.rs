//! Curves over p and over σ: Figs. 9, 11, 12 and 15.

use super::{Curve, CurveRow, MeanRow, MostLikely, RelationRow, Scalars, Step};
use crate::params::Grid;
use impact_circuits::distribution::{Law, SampleSpace};
use impact_circuits::impact_probability::ImpactProbability;
use impact_circuits::{Error, jump};
use rayon::prelude::*;

/// The σ axis of Figs. 11, 12 and 15: 0.02 to 0.4 in steps of 0.001, finer where circuits of higher order add most.
fn sigmas() -> Vec<f64> {
    Grid::default().and(20, 139, 1, 1000).and(700, 760, 1, 5000).and(153, 400, 1, 1000).values()
}

/// Fig. 9: k* with its exact steps, μ on two grids.
pub fn most_likely(vertices: usize, scalars: &Scalars) -> Result<MostLikely, Error> {
    let mut steps =
        vec![Step { p: 0.0, k_star: 1 }, Step { p: scalars.p_jump, k_star: scalars.k_after_jump }];
    for k in scalars.k_after_jump..vertices.saturating_sub(1) {
        steps.push(Step { p: jump::step(vertices, k), k_star: k + 1 });
    }
    // Finest where μ rises, up to p = 0.05.
    let whole = Grid::default().and(0, 49, 1, 1000).and(10, 200, 1, 200).values();
    let inset = Grid::default().and(0, 400, 1, 10_000).values();
    let means = |grid: Vec<f64>| -> Result<Vec<MeanRow>, Error> {
        grid.into_iter().map(|p| mean_row(vertices, p)).collect()
    };
    Ok(MostLikely { steps, mean: means(whole)?, mean_inset: means(inset)? })
}

fn mean(space: SampleSpace, vertices: usize, p: f64) -> Result<f64, Error> {
    Ok(Law::new(space, vertices, p)?.mean())
}

fn mean_row(vertices: usize, p: f64) -> Result<MeanRow, Error> {
    Ok(MeanRow {
        p,
        mean: mean(SampleSpace::Simple, vertices, p)?,
        mean_higher: mean(SampleSpace::FiveClasses, vertices, p)?,
    })
}

/// Fig. 11.
pub fn relation() -> Result<Vec<RelationRow>, Error> {
    let row = |sigma| {
        let law = ImpactProbability::of_paper(sigma)?;
        Ok(RelationRow { sigma, p: law.p()?, p_rest: law.p_from_rest()? })
    };
    sigmas().into_par_iter().map(row).collect()
}

/// Figs. 12 and 15, the theory for one N, along the relation of Fig. 11.
pub fn curve(vertices: usize, relation: &[RelationRow]) -> Result<Curve, Error> {
    let row = |&RelationRow { sigma, p, p_rest, .. }: &RelationRow| {
        Ok(CurveRow {
            sigma,
            simple: mean(SampleSpace::Simple, vertices, p)?,
            higher: mean(SampleSpace::FiveClasses, vertices, p)?,
            simple_rest: mean(SampleSpace::Simple, vertices, p_rest)?,
        })
    };
    let rows = relation.iter().map(row).collect::<Result<_, Error>>()?;
    Ok(Curve { vertices, rows })
}
