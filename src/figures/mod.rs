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
mod simulated;

pub use literate::figures::*;
pub use number::Number;

use crate::experiments::sweep;
use crate::experiments::{
    BRANCHES, MEASURED, NUCLEATION, PROTOCOL, RACE, RESTITUTION, SCALE, SEEDS, SEGMENTS,
    SPACE_TIME, SWEEP,
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
    /// Draws it.
    draw: fn(&Results) -> Result<Figure, Error>,
}

/// Whether a figure shows the theory.
const THEORY: bool = true;

const fn figure(
    needs: &'static [Need],
    theory: bool,
    draw: fn(&Results) -> Result<Figure, Error>,
) -> Listed {
    Listed { needs, theory, draw }
}

/// The figures of the paper.
const PAPER: [Listed; 15] = [
    figure(&[], !THEORY, |_| fig01::draw()),
    figure(&[&SWEEP], !THEORY, |all| fig02::draw(sweep::main(all)?)),
    figure(&[&SWEEP], !THEORY, |all| fig03::draw(sweep::main(all)?)),
    figure(&[], !THEORY, |_| fig04::draw()),
    figure(&[&SEGMENTS], !THEORY, |all| fig05::draw(all.of(&SEGMENTS)?)),
    figure(&[&SEGMENTS], !THEORY, |all| fig06::draw(all.of(&SEGMENTS)?)),
    figure(&[], THEORY, |_| fig07::draw()),
    figure(&[], THEORY, fig08::draw),
    figure(&[], THEORY, fig09::draw),
    figure(&[], THEORY, |_| fig10::draw()),
    figure(&[], THEORY, fig11::draw),
    figure(&[&SWEEP], THEORY, fig12::draw),
    figure(&[], THEORY, fig13::draw),
    figure(&[], THEORY, fig14::draw),
    figure(&[&SWEEP], THEORY, fig15::draw),
];

/// Figures of this edition.
const OWN: [Listed; 9] = [
    figure(&[&SPACE_TIME], !THEORY, |all| s01::draw(all.of(&SPACE_TIME)?)),
    figure(&[&NUCLEATION, &SWEEP], !THEORY, s02::draw),
    figure(&[&SEEDS, &SWEEP, &PROTOCOL], !THEORY, s03::draw),
    figure(&[&BRANCHES, &PROTOCOL], !THEORY, s04::draw),
    figure(&[], THEORY, s05::draw),
    figure(&[&RESTITUTION], !THEORY, s06::draw),
    figure(&[&RACE], !THEORY, |all| s07::draw(all.of(&RACE)?)),
    figure(&[&RACE, &MEASURED], !THEORY, |all| s08::draw(all.of(&RACE)?, all.of(&MEASURED)?)),
    figure(&[&SCALE, &MEASURED], !THEORY, |all| s09::draw(all.of(&SCALE)?, all.of(&MEASURED)?)),
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
    let figure = listed(number).ok_or_else(|| Error::Number(number.to_string()))?;
    let sampled =
        figure.needs.iter().any(|need| need.is_saved()) && results.profile < Profile::Full;
    let samples = sampled.then(|| format!("profile {}: not for citation", results.profile.name()));
    let mut drawn = (figure.draw)(results)?;
    if let Some(foot) = samples {
        drawn = drawn.with_foot(&foot)?;
    }
    let figure = drawn;
    let source = format!("figures::{}", figure.id);
    Ok(Figure { source, experiments: experiments(number), ..figure })
}
