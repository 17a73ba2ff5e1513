//! The fifteen figures of the paper and those of this edition, one a file; each returns an SVG
//! string and its data.

mod fig01;
mod fig02;
mod fig03;
mod fig04;
mod fig05;
mod fig06;
mod fig07;
mod fig08;
mod fig09;
mod fig10;
mod fig11;
mod fig12;
mod fig13;
mod fig14;
mod fig15;
mod graph;
mod motion;
mod number;
mod rivals;
mod s01;
mod s02;
mod s03;
mod s04;
mod s05;
mod s06;
mod s07;
mod s08;
mod s09;
mod s10;
mod s11;
mod s12;
mod s13;
mod s14;
mod s15;
mod s16;
mod simulated;

pub use literate::figures::*;
pub use number::Number;

use crate::experiments::catalogue::{
    ANALYTIC, BIAS, CHAINS, HEAT, INDEPENDENCE, LONG_PROTOCOL, MEASURED, NUCLEATION, ORBITS,
    PROTOCOL, PROTOCOLS, RACE, RESTITUTION, SCALE, SEEDS, SEGMENTS, SIZES, SPACE_TIME, SWEEP,
};
use crate::experiments::{Need, Results};
use crate::params::Profile;

/// All figures: first the paper's, then our own.
pub fn all() -> impl Iterator<Item = Number> {
    (1..=Number::PAPER).map(Number::Paper).chain((1..=Number::OWN).map(Number::Own))
}

/// The experiments that a figure needs, beside the theory, which costs nothing.
pub fn needs(number: Number) -> Vec<Need> {
    match number {
        Number::Paper(2 | 3 | 12 | 15) => vec![&SWEEP],
        Number::Paper(5 | 6) => vec![&SEGMENTS],
        Number::Own(1) => vec![&PROTOCOL, &LONG_PROTOCOL, &PROTOCOLS],
        Number::Own(2) => vec![&SPACE_TIME],
        Number::Own(3) => vec![&NUCLEATION, &SWEEP],
        Number::Own(4) => vec![&SEEDS, &SWEEP, &PROTOCOL],
        Number::Own(7) => vec![&HEAT],
        Number::Own(8) => vec![&INDEPENDENCE],
        Number::Own(9) => vec![&ORBITS],
        Number::Own(10) => vec![&RESTITUTION],
        Number::Own(11) => vec![&CHAINS, &SIZES, &PROTOCOL],
        Number::Own(12) => vec![&RACE],
        Number::Own(13) => vec![&RACE, &MEASURED],
        Number::Own(14) => vec![&BIAS],
        Number::Own(15) => vec![&SCALE, &MEASURED],
        Number::Own(16) => vec![&ANALYTIC],
        _ => vec![],
    }
}

/// The names of the experiments whose results a figure shows; none for a schematic.
pub fn experiments(number: Number) -> Vec<&'static str> {
    let theory = matches!(number, Number::Paper(7..=15) | Number::Own(5 | 6)).then_some("theory");
    needs(number).into_iter().map(|need| need.name()).chain(theory).collect()
}

/// Draws one figure.
///
/// # Errors
/// [`Error::Number`] if there is none, [`Error::Data`] without the results that it needs.
pub fn draw(number: Number, results: &Results) -> Result<Figure, Error> {
    let note = match results.profile {
        Profile::Full | Profile::Deep => None,
        Profile::Ci => Some("profile ci: not for citation"),
        Profile::Quick => Some("profile quick: not for citation"),
    };
    let figure = match number {
        Number::Paper(1) => fig01::draw(),
        Number::Paper(2) => fig02::draw(results.sweep()?, note),
        Number::Paper(3) => fig03::draw(results.sweep()?, note),
        Number::Paper(4) => fig04::draw(),
        Number::Paper(5) => fig05::draw(results.segments()?),
        Number::Paper(6) => fig06::draw(results.segments()?),
        Number::Paper(7) => fig07::draw(&results.theory),
        Number::Paper(8) => fig08::draw(&results.theory),
        Number::Paper(9) => fig09::draw(&results.theory),
        Number::Paper(10) => fig10::draw(&results.theory),
        Number::Paper(11) => fig11::draw(&results.theory),
        Number::Paper(12) => fig12::draw(results.sweep()?, &results.theory, note),
        Number::Paper(13) => fig13::draw(&results.theory),
        Number::Paper(14) => fig14::draw(&results.theory),
        Number::Paper(15) => fig15::draw(results.sweep()?, &results.theory, note),
        Number::Own(1) => s01::draw(results, note),
        Number::Own(2) => s02::draw(results.spacetime()?, note),
        Number::Own(3) => s03::draw(results, note),
        Number::Own(4) => s04::draw(results, note),
        Number::Own(5) => s05::draw(&results.theory.large),
        Number::Own(6) => s06::draw(&results.theory),
        Number::Own(7) => s07::draw(results, note),
        Number::Own(8) => s08::draw(results, note),
        Number::Own(9) => s09::draw(results, note),
        Number::Own(10) => s10::draw(results, note),
        Number::Own(11) => {
            s11::draw(results.chains()?, results.sizes()?, results.protocol()?, note)
        }
        Number::Own(12) => s12::draw(results.race()?, note),
        Number::Own(13) => s13::draw(results.race()?, results.measured()?, note),
        Number::Own(14) => s14::draw(results.biases()?, note),
        Number::Own(15) => s15::draw(results.scale()?, results.measured()?, note),
        Number::Own(16) => s16::draw(results.analytic()?, note),
        _ => Err(Error::Number(number.to_string())),
    }?;
    let source = format!("figures::{}", figure.id);
    Ok(Figure { source, experiments: experiments(number), ..figure })
}
