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

use crate::experiments::sweep;
use crate::experiments::{
    BRANCHES, MEASURED, NUCLEATION, PROTOCOL, RACE, RESTITUTION, SCALE, SEEDS, SEGMENTS,
    SPACE_TIME, SWEEP,
};
use crate::experiments::{Need, Results};
use crate::params::Profile;

/// The label of an axis of σ.
const FORCING: &str = "*σ* (*d ω*^{2})";

/// A figure: its number, the experiments that it needs beside the theory, which costs nothing, and how it is drawn.
pub struct Listed {
    /// `3` for one of the paper, `s1` for one of this edition.
    pub number: &'static str,
    /// The experiments that it needs.
    pub needs: &'static [Need],
    /// Whether it shows the theory.
    theory: bool,
    draw: fn(&Results) -> Result<Figure, Error>,
}

/// Whether a figure shows the theory.
const THEORY: bool = true;

const fn figure(
    number: &'static str,
    needs: &'static [Need],
    theory: bool,
    draw: fn(&Results) -> Result<Figure, Error>,
) -> Listed {
    Listed { number, needs, theory, draw }
}

/// All figures: first the paper's, then those of this edition.
pub static ALL: [Listed; 24] = [
    figure("1", &[], !THEORY, |_| fig01::draw()),
    figure("2", &[&SWEEP], !THEORY, |all| fig02::draw(sweep::main(all)?)),
    figure("3", &[&SWEEP], !THEORY, |all| fig03::draw(sweep::main(all)?)),
    figure("4", &[], !THEORY, |_| fig04::draw()),
    figure("5", &[&SEGMENTS], !THEORY, |all| fig05::draw(all.of(&SEGMENTS)?)),
    figure("6", &[&SEGMENTS], !THEORY, |all| fig06::draw(all.of(&SEGMENTS)?)),
    figure("7", &[], THEORY, |_| fig07::draw()),
    figure("8", &[], THEORY, fig08::draw),
    figure("9", &[], THEORY, fig09::draw),
    figure("10", &[], THEORY, |_| fig10::draw()),
    figure("11", &[], THEORY, fig11::draw),
    figure("12", &[&SWEEP], THEORY, fig12::draw),
    figure("13", &[], THEORY, fig13::draw),
    figure("14", &[], THEORY, fig14::draw),
    figure("15", &[&SWEEP], THEORY, fig15::draw),
    figure("s1", &[&SPACE_TIME], !THEORY, |all| s01::draw(all.of(&SPACE_TIME)?)),
    figure("s2", &[&NUCLEATION, &SWEEP], !THEORY, s02::draw),
    figure("s3", &[&SEEDS, &SWEEP, &PROTOCOL], !THEORY, s03::draw),
    figure("s4", &[&BRANCHES, &PROTOCOL], !THEORY, s04::draw),
    figure("s5", &[], THEORY, s05::draw),
    figure("s6", &[&RESTITUTION], !THEORY, s06::draw),
    figure("s7", &[&RACE], !THEORY, |all| s07::draw(all.of(&RACE)?)),
    figure("s8", &[&RACE, &MEASURED], !THEORY, |all| s08::draw(all.of(&RACE)?, all.of(&MEASURED)?)),
    figure("s9", &[&SCALE, &MEASURED], !THEORY, |all| {
        s09::draw(all.of(&SCALE)?, all.of(&MEASURED)?)
    }),
];

/// The figure of a number.
///
/// # Errors
/// [`Error::Number`] if there is none.
pub fn find(number: &str) -> Result<&'static Listed, Error> {
    let found = ALL.iter().find(|own| own.number == number.to_lowercase());
    found.ok_or_else(|| Error::Number(number.into()))
}

impl Listed {
    /// `fig03` or `s01`: the file name of the picture without its ending.
    pub fn id(&self) -> String {
        match self.number.strip_prefix('s') {
            Some(own) => format!("s{own:0>2}"),
            None => format!("fig{:0>2}", self.number),
        }
    }

    /// The names of the experiments whose results it shows; none for a schematic.
    pub fn experiments(&self) -> Vec<&'static str> {
        let theory = self.theory.then_some("theory");
        self.needs.iter().map(|need| need.name()).chain(theory).collect()
    }

    /// Draws it.
    ///
    /// # Errors
    /// [`Error::Data`] without the results that it needs.
    pub fn draw(&self, results: &Results) -> Result<Figure, Error> {
        let sampled = self.needs.iter().any(|need| need.is_saved());
        let mut figure = (self.draw)(results)?;
        if sampled && results.profile < Profile::Full {
            let foot = format!("profile {}: not for citation", results.profile.name());
            figure = figure.with_foot(&foot)?;
        }
        let source = format!("figures::{}", figure.id);
        Ok(Figure { source, experiments: self.experiments(), ..figure })
    }
}
