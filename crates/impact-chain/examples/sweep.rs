//! How many of the gaps close in a window of time, as the forcing grows: the jump of Fig. 3 in small.
//!
//!     cargo run --release -p impact-chain --example sweep

use impact_chain::{Chain, Engine, Error, Scenario};
use impact_numerics::random::NormalPairs;
use impact_numerics::statistics::{mean, standard_error};

const REALISATIONS: u64 = 10;
const TRANSIENT: f64 = 200.0;
const WINDOW: f64 = 200.0;

fn main() -> Result<(), Error> {
    let chain = Chain { masses: 50, ..Chain::default() };
    println!("sigma  gaps that closed, of {}", chain.gaps());
    for sigma in [0.08, 0.10, 0.12, 0.14, 0.16, 0.20, 0.30] {
        let counts: Result<Vec<f64>, Error> =
            (0..REALISATIONS).map(|index| closed(&chain, sigma, index)).collect();
        let counts = counts?;
        let [mean, error] = [mean(&counts), standard_error(&counts)].map(Option::unwrap_or_default);
        println!(" {sigma:.2}  {mean:5.1} ± {error:.1}");
    }
    Ok(())
}

/// Distinct gaps that close in the window, after the transient.
fn closed(chain: &Chain, sigma: f64, index: u64) -> Result<f64, Error> {
    let scenario = Scenario::draw(chain, sigma, &mut NormalPairs::new("sweep", 2007, index));
    let mut hit = vec![false; chain.gaps()];
    Engine::new(&scenario)?.run(TRANSIENT + WINDOW, |impact| {
        hit[impact.gap] |= impact.time >= TRANSIENT;
        true
    })?;
    Ok(hit.iter().filter(|hit| **hit).count() as f64)
}
