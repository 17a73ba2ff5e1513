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
mod simulated;

pub use literate::figures::*;
pub use number::Number;

use crate::experiments::{
    ANALYTIC, CHAINS, CLOSED, HEAT, INDEPENDENCE, LONG_PROTOCOL, MEASURED, NUCLEATION, PROTOCOL,
    RACE, RESTITUTION, SCALE, SEEDS, SEGMENTS, SIZES, SPACE_TIME, SWEEP,
};
use crate::experiments::{Need, Results};
use crate::params::Profile;

/// The label of an axis of σ.
const FORCING: &str = "*σ* (*d ω*^{2})";

/// A figure of the lists below.
struct Listed {
    /// The experiments that it needs, beside the theory, which costs nothing.
    needs: &'static [Need],
    /// Whether it shows the theory.
    theory: bool,
    /// Draws it, with a note about small samples.
    draw: fn(&Results, Option<&str>) -> Result<Figure, Error>,
}

/// Whether a figure shows the theory.
const THEORY: bool = true;

const fn figure(
    needs: &'static [Need],
    theory: bool,
    draw: fn(&Results, Option<&str>) -> Result<Figure, Error>,
) -> Listed {
    Listed { needs, theory, draw }
}

/// The figures of the paper.
const PAPER: [Listed; 15] = [
    figure(&[], !THEORY, |_, _| fig01::draw()),
    figure(&[&SWEEP], !THEORY, |all, note| fig02::draw(all.sweep()?, note)),
    figure(&[&SWEEP], !THEORY, |all, note| fig03::draw(all.sweep()?, note)),
    figure(&[], !THEORY, |_, _| fig04::draw()),
    figure(&[&SEGMENTS], !THEORY, |all, _| fig05::draw(all.segments()?)),
    figure(&[&SEGMENTS], !THEORY, |all, _| fig06::draw(all.segments()?)),
    figure(&[], THEORY, |all, _| fig07::draw(&all.theory)),
    figure(&[], THEORY, |all, _| fig08::draw(&all.theory)),
    figure(&[], THEORY, |all, _| fig09::draw(&all.theory)),
    figure(&[], THEORY, |all, _| fig10::draw(&all.theory)),
    figure(&[], THEORY, |all, _| fig11::draw(&all.theory)),
    figure(&[&SWEEP], THEORY, |all, note| fig12::draw(all.sweep()?, &all.theory, note)),
    figure(&[], THEORY, |all, _| fig13::draw(&all.theory)),
    figure(&[], THEORY, |all, _| fig14::draw(&all.theory)),
    figure(&[&SWEEP], THEORY, |all, note| fig15::draw(all.sweep()?, &all.theory, note)),
];

/// Figures of this edition.
const OWN: [Listed; 14] = [
    figure(&[&PROTOCOL, &LONG_PROTOCOL], !THEORY, s01::draw),
    figure(&[&SPACE_TIME], !THEORY, |all, note| s02::draw(all.spacetime()?, note)),
    figure(&[&NUCLEATION, &SWEEP], !THEORY, s03::draw),
    figure(&[&SEEDS, &SWEEP, &PROTOCOL, &CLOSED], !THEORY, s04::draw),
    figure(&[&CHAINS, &SIZES, &PROTOCOL], !THEORY, s05::draw),
    figure(&[], THEORY, |all, _| s06::draw(&all.theory.large)),
    figure(&[], THEORY, |all, _| s07::draw(&all.theory)),
    figure(&[&HEAT], !THEORY, s08::draw),
    figure(&[&INDEPENDENCE], !THEORY, s09::draw),
    figure(&[&RESTITUTION], !THEORY, s10::draw),
    figure(&[&RACE], !THEORY, |all, note| s11::draw(all.race()?, note)),
    figure(&[&RACE, &MEASURED], !THEORY, |all, note| s12::draw(all.race()?, all.measured()?, note)),
    figure(&[&SCALE, &MEASURED], !THEORY, |all, note| {
        s13::draw(all.scale()?, all.measured()?, note)
    }),
    figure(&[&ANALYTIC], !THEORY, |all, note| s14::draw(all.analytic()?, note)),
];

/// All figures: first the paper's, then our own.
pub fn all() -> impl Iterator<Item = Number> {
    (1..=Number::PAPER).map(Number::Paper).chain((1..=Number::OWN).map(Number::Own))
}

/// The figure of a number, if there is one.
fn listed(number: Number) -> Option<&'static Listed> {
    let (list, n): (&'static [Listed], u8) = match number {
        Number::Paper(n) => (&PAPER, n),
        Number::Own(n) => (&OWN, n),
    };
    list.get(usize::from(n).checked_sub(1)?)
}

/// The experiments that a figure needs, beside the theory, which costs nothing.
pub fn needs(number: Number) -> &'static [Need] {
    listed(number).map_or(&[], |figure| figure.needs)
}

/// The names of the experiments whose results a figure shows; none for a schematic.
pub fn experiments(number: Number) -> Vec<&'static str> {
    let theory = listed(number).is_some_and(|figure| figure.theory).then_some("theory");
    needs(number).iter().map(|need| need.name()).chain(theory).collect()
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
    let figure = listed(number).ok_or_else(|| Error::Number(number.to_string()))?;
    let figure = (figure.draw)(results, note)?;
    let source = format!("figures::{}", figure.id);
    Ok(Figure { source, experiments: experiments(number), ..figure })
}
