//! The rise in a chain of yours: how many of its gaps close in a window of time, as the forcing grows (Fig. 3 in small).
//!
//!     cargo run --release -p impact-chain --example sweep

use impact_chain::rise::Curve;
use impact_chain::{Chain, Counts, Ensemble, Error, Protocol};

fn main() -> Result<(), Error> {
    let ensemble = Ensemble {
        chain: Chain { masses: 50, restitution: 0.8, ..Chain::default() },
        sigmas: vec![0.08, 0.10, 0.11, 0.12, 0.13, 0.14, 0.16, 0.20],
        protocols: vec![Protocol { transient: 200.0, window: 200.0 }],
        realisations: 20,
        ..Ensemble::default()
    };
    let at = |sigma: &f64| (0..20).map(|i| ensemble.realisation(*sigma, i, || false)).collect();
    let counts = ensemble.sigmas.iter().map(at).collect::<Result<Vec<Counts>, Error>>()?;
    let curve = Curve::new(&ensemble, &counts, 0);
    for row in &curve.rows {
        let mean = row.mean_all.unwrap_or_default();
        let error = mean.error.unwrap_or_default();
        println!(
            "σ = {:.2}: {:5.1} ± {error:.1} of {} gaps",
            row.sigma,
            mean.value,
            ensemble.chain.gaps()
        );
    }
    let half = curve.rise.half_height_all.expect("it rises through half of all gaps");
    println!("half height at σ = {:.3} ± {:.3}", half.value, half.error);
    Ok(())
}
