//! The theory beside the simulation.

use crate::experiments::{Results, sweep};
use impact_chain::rise::{Counted, Mean, Row};
use literate::table::Table;
use literate::value::origin;

/// The σ at which the text sets means side by side, as far as the sweep has them.
const SIGMAS: [f64; 8] = [0.1, 0.11, 0.12, 0.13, 0.14, 0.15, 0.2, 0.3];

/// From here on σ is called large (ours).
pub(crate) const LARGE_SIGMA: f64 = 0.2;

/// A curve of the theory at any σ in its range, linear between its points.
pub(crate) fn at(curve: &[(f64, f64)], sigma: f64) -> Option<f64> {
    let w = curve.windows(2).find(|w| w[0].0 <= sigma && sigma <= w[1].0)?;
    let share = (sigma - w[0].0) / (w[1].0 - w[0].0);
    Some(w[0].1 + share * (w[1].1 - w[0].1))
}

/// Where theory and simulation lie farthest apart at large σ: their distance in gaps, σ, and both means.
fn largest_distance(sweep: &Counted, curve: &[(f64, f64)]) -> Option<[f64; 4]> {
    let rows = sweep.first().rows.iter().filter(|row| row.sigma >= LARGE_SIGMA);
    let distances = rows.filter_map(|row| {
        let (mean, theory) = (row.mean?.value, at(curve, row.sigma)?);
        Some([(mean - theory).abs(), row.sigma, theory, mean])
    });
    distances.reduce(|most, one| if most[0] >= one[0] { most } else { one })
}

/// The finest step of the grid, to a part in a million.
fn finest(sweep: &Counted) -> f64 {
    let steps = sweep.first().rows.windows(2).map(|w| w[1].sigma - w[0].sigma);
    (steps.fold(f64::INFINITY, f64::min) * 1e6).round() / 1e6
}

/// The largest increase of a mean within one and within two steps of the grid, in gaps; over the
/// finest part of the grid.
fn increases(sweep: &Counted, mean: fn(&Row) -> Option<Mean>) -> Option<[f64; 2]> {
    let points: Vec<(f64, f64)> =
        sweep.first().rows.iter().filter_map(|row| Some((row.sigma, mean(row)?.value))).collect();
    let finest = finest(sweep);
    let fine = |step: f64| step < 1.01 * finest;
    let mut found: Option<[f64; 2]> = None;
    for w in points.windows(3) {
        let [(x, a), (y, b), (z, c)] = [w[0], w[1], w[2]];
        if fine(y - x) && fine(z - y) {
            let [one, two] = found.unwrap_or([0.0; 2]);
            found = Some([one.max(b - a).max(c - b), two.max(c - a)]);
        }
    }
    found
}

/// Root mean square distance of a theory curve from the simulated means, from the first row with
/// kept realisations up to where σ is large.
fn distance(sweep: &Counted, curve: &[(f64, f64)]) -> Option<f64> {
    let rows = sweep.first().rows.iter().filter(|row| row.sigma < LARGE_SIGMA);
    let squares: Vec<f64> = rows
        .filter_map(|row| {
            let difference = row.mean?.value - at(curve, row.sigma)?;
            Some(difference * difference)
        })
        .collect();
    let count = squares.len();
    (count > 0).then(|| (squares.into_iter().sum::<f64>() / count as f64).sqrt())
}

/// What the text says of both.
pub fn tables(results: &Results, all: &[Table]) -> Option<Vec<Table>> {
    let sweep = sweep::main(results).ok()?;
    let table = |name| all.iter().find(|table| table.name() == name);
    let (curve, relation) = (table("theory.curve")?, table("theory.relation")?);
    let curves = ["simple", "higher", "rest"].map(|column| curve.points(&[], "sigma", column));
    let [simple, higher, rest] = &curves;
    let found = |number: Option<f64>| number.unwrap_or(f64::NAN);
    let rows: Vec<&Row> = sweep
        .first()
        .rows
        .iter()
        .filter(|row| SIGMAS.contains(&row.sigma) && row.kept > 0)
        .collect();
    let mean = |row: &Row, curve| found(at(curve, row.sigma));
    let means = Table::of("sweep.theory", &rows, |_| 0)
        .key("sigma", "d omega^2", |row| row.sigma)
        .computed_by(origin(at))
        .real("simple", "1", 3, "μ, simple circuits", |row| mean(row, simple))
        .real("higher", "1", 3, "μ, five classes", |row| mean(row, higher))
        .real("rest", "1", 3, "μ from rest, simple circuits", |row| mean(row, rest))
        .done();
    let far = |at: usize| largest_distance(sweep, simple).map(|far| far[at]);
    let kept = increases(sweep, |row| row.mean);
    let table = Table::of("sweep.beside_theory", &[()], |()| 0)
        .computed_by(origin(largest_distance))
        .chosen("large_sigma", "d omega^2", "from here on σ is called large", |()| {
            Some(LARGE_SIGMA)
        })
        .real("large_distance", "1", 2, "largest distance of both means at large σ", |()| {
            found(far(0))
        })
        .chosen("large_distance_at", "d omega^2", "σ of it", |()| far(1))
        .real("large_theory", "1", 3, "μ there", |()| found(far(2)))
        .real("large_mean", "1", 3, "mean of the kept there", |()| found(far(3)))
        .computed_by(origin(increases))
        .real("largest_increase", "1", 2, "of the mean of the kept in one step of σ", |()| {
            found(kept.map(|[one, _]| one))
        })
        .real("increase_of_two", "1", 2, "in two steps", |()| found(kept.map(|[_, two]| two)))
        .real("increase_of_all", "1", 2, "of the mean of all in one step", |()| {
            found(increases(sweep, |row| row.mean_all).map(|[one, _]| one))
        })
        .chosen("step", "d omega^2", "the finest of the grid", |()| Some(finest(sweep)))
        .computed_by(origin(impact_chain::rise::Curve::new))
        .real(
            "half_gap",
            "d omega^2",
            2,
            "half height of the theory less that of the simulation",
            |()| {
                let theory = relation.number(&[], "sigma_half").ok();
                found(
                    theory.zip(sweep.first().rise.half_height).map(|(own, half)| own - half.value),
                )
            },
        )
        .computed_by(origin(distance))
        .real("simple", "1", 3, "root mean square distance of the means, simple circuits", |()| {
            found(distance(sweep, simple))
        })
        .real("higher", "1", 3, "the same with five classes", |()| found(distance(sweep, higher)))
        .real("rest", "1", 3, "the same from rest", |()| found(distance(sweep, rest)))
        .done();
    Some(vec![means, table])
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_chain::rise::{Curve as Counts, Rise};
    use impact_chain::{Ensemble, Protocol};

    /// A sweep with these mean counts.
    fn sweep(means: &[(f64, f64)]) -> Counted {
        let row = |&(sigma, value): &(f64, f64)| Row {
            sigma,
            mean: Some(Mean { value, ..Mean::default() }),
            ..Row::default()
        };
        let rows = means.iter().map(row).collect();
        let curve = Counts { protocol: Protocol::default(), rows, rise: Rise::default() };
        Counted { ensemble: Ensemble::default(), runs: Vec::new(), curves: vec![curve] }
    }

    #[test]
    fn distances_are_taken_between_the_rows_of_the_curve() {
        let curve = [(0.0, 0.0), (0.4, 40.0)];
        let close = |a: Option<f64>, b: f64| (a.unwrap() - b).abs() < 1e-12;
        assert!(close(at(&curve, 0.1), 10.0));
        assert_eq!(at(&curve, 0.5), None);
        let sweep = sweep(&[(0.1, 13.0), (0.15, 11.0), (0.2, 22.0), (0.3, 25.0), (0.5, 90.0)]);
        // Below 0.2 the differences are 3 and −4, from there on 2 and −5.
        assert!(close(distance(&sweep, &curve), 12.5_f64.sqrt()));
        let [most, sigma, ..] = largest_distance(&sweep, &curve).unwrap();
        assert!(close(Some(most), 5.0) && sigma == 0.3);
    }

    #[test]
    fn increases_are_those_of_the_finest_grid() {
        let sweep = sweep(&[(0.1, 0.0), (0.11, 1.0), (0.12, 4.0), (0.13, 5.0), (0.2, 90.0)]);
        assert_eq!(increases(&sweep, |row| row.mean), Some([3.0, 4.0]));
    }
}
