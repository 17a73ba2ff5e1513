//! Compares the theory with the simulation.

use crate::experiments::prelude::*;
use crate::experiments::sweep;
use impact_chain::rise::Mean;

/// From here on σ is called large (ours).
pub(crate) const LARGE_SIGMA: f64 = 0.2;

/// Returns the value of a curve at any σ in its range, linear between its points, or `None`
/// outside.
pub(crate) fn interpolate(curve: &[(f64, f64)], sigma: f64) -> Option<f64> {
    let w = curve.windows(2).find(|w| w[0].0 <= sigma && sigma <= w[1].0)?;
    let share = (sigma - w[0].0) / (w[1].0 - w[0].0);
    Some(w[0].1 + share * (w[1].1 - w[0].1))
}

/// Returns where means and theory lie farthest apart at large σ: their distance in gaps, the σ, the
/// theory and the mean there.
pub(crate) fn largest_distance(means: &[(f64, f64)], curve: &[(f64, f64)]) -> Option<[f64; 4]> {
    let large = means.iter().filter(|(sigma, _)| *sigma >= LARGE_SIGMA);
    let distances = large.filter_map(|&(sigma, mean)| {
        let theory = interpolate(curve, sigma)?;
        Some([(mean - theory).abs(), sigma, theory, mean])
    });
    distances.reduce(|most, one| if most[0] >= one[0] { most } else { one })
}

/// Returns the largest increase of a mean in one and in two steps of σ, where these are `finest`.
fn increases(means: &[(f64, f64)], finest: f64) -> Option<[f64; 2]> {
    let fine = |w: &[(f64, f64)]| w.windows(2).all(|w| w[1].0 - w[0].0 < 1.01 * finest);
    let steps = means.windows(3).filter(|w| fine(w)).map(|w| [w[0].1, w[1].1, w[2].1]);
    let rises = steps.map(|[a, b, c]| [(b - a).max(c - b), c - a]);
    rises.reduce(|a, b| [a[0].max(b[0]), a[1].max(b[1])]).map(|rise| rise.map(|x| x.max(0.0)))
}

/// Returns the root mean square distance of a curve from means, at the σ that both have.
pub(crate) fn root_mean_square(means: &[(f64, f64)], curve: &[(f64, f64)]) -> Option<f64> {
    let both = means.iter().filter_map(|&(sigma, mean)| Some(mean - interpolate(curve, sigma)?));
    let squares: Vec<f64> = both.map(|difference| difference * difference).collect();
    (!squares.is_empty()).then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
}

/// Returns the root mean square distance of a curve from the means at which σ is not yet large.
pub(crate) fn distance(means: &[(f64, f64)], curve: &[(f64, f64)]) -> Option<f64> {
    let small = means.iter().copied().filter(|(sigma, _)| *sigma < LARGE_SIGMA);
    root_mean_square(&small.collect::<Vec<_>>(), curve)
}

pub fn tables(results: &Results, computed: &[Table]) -> Option<Vec<Table>> {
    let sweep = sweep::main_sweep(results).ok()?;
    let table = |name| computed.iter().find(|table| table.name() == name);
    let (curve, relation) = (table("theory.curve")?, table("theory.relation")?);
    let column = |name| curve.curve(&[], "sigma", name).ok();
    let (simple, higher) = (&column("simple")?, &column("higher")?);
    let rows = &sweep.first_curve().rows;
    let means_by = |mean: fn(&RisePoint) -> Option<Mean>| -> Vec<(f64, f64)> {
        rows.iter().filter_map(|row| Some((row.sigma, mean(row)?.value))).collect()
    };
    let means = means_by(|row| row.mean);
    // To a part in a million.
    let steps = rows.windows(2).map(|w| w[1].sigma - w[0].sigma);
    let finest = (steps.fold(f64::INFINITY, f64::min) * 1e6).round() / 1e6;
    let far = |place: usize| largest_distance(&means, simple).map(|far| far[place]);
    const HALF_GAP: &str = "half height of the theory less that of the simulation";
    const SIMPLE: &str = "root mean square distance of the means, simple circuits";
    let of_active = increases(&means, finest);
    let of_all = increases(&means_by(|row| row.mean_all), finest);
    let half = sweep.first_curve().rise.half_height.zip(relation.number(&[], "sigma_half").ok());
    let half_gap = half.map(|(half, theory)| theory - half.value);
    let table = Table::builder("sweep.against_theory", &[()], |()| 0)
        .table_computed_by(origin(largest_distance))
        .chosen("large_sigma", SIGMA, "from here on σ is called large", |()| Some(LARGE_SIGMA))
        .real("large_distance", "1", 2, "largest distance of both means at large σ", |()| far(0))
        .chosen("large_distance_at", SIGMA, "σ of it", |()| far(1))
        .computed_by(origin(largest_distance), &["large_distance_at"])
        .real("large_theory", "1", 3, "μ there", |()| far(2))
        .real("large_mean", "1", 3, "simulated mean there", |()| far(3))
        .real("largest_increase", "1", 2, "of the simulated mean in one step", |()| {
            Some(of_active?[0])
        })
        .real("increase_of_two", "1", 2, "in two steps", |()| Some(of_active?[1]))
        .real("increase_of_all", "1", 2, "of the mean of all in one step", |()| Some(of_all?[0]))
        .computed_by(origin(increases), &["largest_increase", "increase_of_two", "increase_of_all"])
        .chosen("step", SIGMA, "the finest of the grid", |()| Some(finest))
        .real("half_gap", SIGMA, 2, HALF_GAP, |()| half_gap)
        .computed_by(origin(Curve::new), &["half_gap"])
        .real("simple", "1", 3, SIMPLE, |()| distance(&means, simple))
        .real("higher", "1", 3, "the same with five classes", |()| distance(&means, higher))
        .computed_by(origin(distance), &["simple", "higher"])
        .done();
    Some(vec![table])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_taken_between_the_rows_of_the_curve() {
        let curve = [(0.0, 0.0), (0.4, 40.0)];
        let close = |a: Option<f64>, b: f64| (a.unwrap() - b).abs() < 1e-12;
        assert!(close(interpolate(&curve, 0.1), 10.0));
        assert_eq!(interpolate(&curve, 0.5), None);
        let means = [(0.1, 13.0), (0.15, 11.0), (0.2, 22.0), (0.3, 25.0), (0.5, 90.0)];
        // Below 0.2 the differences are 3 and −4, from there on 2 and −5.
        assert!(close(distance(&means, &curve), 12.5_f64.sqrt()));
        let [most, sigma, ..] = largest_distance(&means, &curve).unwrap();
        assert!(close(Some(most), 5.0) && sigma == 0.3);
    }

    #[test]
    fn increases_are_those_of_the_finest_grid() {
        let means = [(0.1, 0.0), (0.11, 1.0), (0.12, 4.0), (0.13, 5.0), (0.2, 90.0)];
        assert_eq!(increases(&means, 0.01), Some([3.0, 4.0]));
    }
}
