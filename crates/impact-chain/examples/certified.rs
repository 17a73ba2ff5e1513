//! How long a chaotic run can be trusted: twins whose amplitudes differ in the last bit leave it there.
//!
//!     cargo run --release -p impact-chain --example certified

use impact_chain::{Chain, Error, Scenario, certify, rounding};
use impact_numerics::random::NormalPairs;

fn main() -> Result<(), Error> {
    let chain = Chain::default();
    for sigma in [0.05, 0.15, 0.30] {
        let scenario = Scenario::draw(&chain, sigma, &mut NormalPairs::new("certified", 2007, 0));
        let found = certify(&scenario, 500.0, |_| true)?;
        print!("sigma = {sigma:.2}: {} impacts can be trusted, ", found.impacts);
        match found.horizon {
            Some(time) => print!("up to t = {time:.1}"),
            None => print!("all that there are"),
        }
        if let Some(rate) = found.growth {
            print!("; errors grow as exp({rate:.2} t)");
        }
        // What the arithmetic can add to a gap, as a part of the distance d between masses.
        println!("; rounding moves a gap by at most {:.0e} d", rounding::width(&scenario));
    }
    Ok(())
}
