//! Lists the fifteen figures of the paper and those of this edition, one file each ([`ALL`]).
//!
//! Colours follow the captions of Figs. 12, 13 and 15: the simulation is red, simple circuits are
//! green, higher-order circuits blue.

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
use crate::experiments::{AnyExperiment, Results};
use crate::experiments::{
    BIAS, BRANCHES, MEASURED, NUCLEATION, PROTOCOL, RACE, SCALE, SEEDS, SEGMENTS, SPACE_TIME,
    SWEEP, THEORY,
};
use literate::FigureSpec;

#[track_caller]
const fn drawing(
    name: &'static str,
    needs: &'static [&'static dyn AnyExperiment],
    draw: fn(&Results) -> Result<Figure, Error>,
) -> FigureSpec {
    FigureSpec::new(name, needs, draw)
}

/// All figures: first the paper's, then those of this edition.
pub const ALL: [FigureSpec; 24] = [
    drawing("fig01", &[], |_| fig01::draw()),
    drawing("fig02", &[&SWEEP], |all| fig02::draw(sweep::main(all)?)),
    drawing("fig03", &[&SWEEP], fig03::draw),
    drawing("fig04", &[], |_| fig04::draw()),
    drawing("fig05", &[&SEGMENTS], |all| fig05::draw(all.of(&SEGMENTS)?)),
    drawing("fig06", &[&SEGMENTS], |all| fig06::draw(all.of(&SEGMENTS)?)),
    drawing("fig07", &[&THEORY], |_| fig07::draw()),
    drawing("fig08", &[&THEORY], fig08::draw),
    drawing("fig09", &[&THEORY], fig09::draw),
    drawing("fig10", &[&THEORY], |_| fig10::draw()),
    drawing("fig11", &[&THEORY], fig11::draw),
    drawing("fig12", &[&SWEEP, &THEORY], fig12::draw),
    drawing("fig13", &[&THEORY], fig13::draw),
    drawing("fig14", &[&THEORY], fig14::draw),
    drawing("fig15", &[&SWEEP, &THEORY], fig15::draw),
    drawing("s01", &[&SPACE_TIME], |all| s01::draw(all.of(&SPACE_TIME)?)),
    drawing("s02", &[&NUCLEATION, &SWEEP], s02::draw),
    drawing("s03", &[&SEEDS, &SWEEP, &PROTOCOL, &THEORY], s03::draw),
    drawing("s04", &[&BRANCHES, &PROTOCOL, &THEORY], s04::draw),
    drawing("s05", &[&THEORY], s05::draw),
    drawing("s06", &[&RACE], |all| s06::draw(all.of(&RACE)?)),
    drawing("s07", &[&RACE, &MEASURED], |all| s07::draw(all.of(&RACE)?, all.of(&MEASURED)?)),
    drawing("s08", &[&BIAS, &MEASURED], |all| s08::draw(all.of(&BIAS)?, all.of(&MEASURED)?)),
    drawing("s09", &[&SCALE, &MEASURED], |all| s09::draw(all.of(&SCALE)?, all.of(&MEASURED)?)),
];
