//! Lists the fifteen figures of the paper and those of this edition, one file each ([`ALL`]).
//! How each quantity looks is said once, in `encoding.rs`.

mod encoding;
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
mod prelude;
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
mod simulated;

use crate::experiments::*;
use literate::FigureSpec;

/// All figures: first the paper's, then those of this edition.
pub const ALL: [FigureSpec; 26] = [
    FigureSpec::new("fig01", &[], |_| fig01::draw()),
    FigureSpec::new("fig02", &[&MODE_JUMP], fig02::draw),
    FigureSpec::new("fig03", &[&SWEEP], fig03::draw),
    FigureSpec::new("fig04", &[], |_| fig04::draw()),
    FigureSpec::new("fig05", &[&SEGMENTS], |results| fig05::draw(results.of(&SEGMENTS)?)),
    FigureSpec::new("fig06", &[&SEGMENTS], |results| fig06::draw(results.of(&SEGMENTS)?)),
    FigureSpec::new("fig07", &[&THEORY], |_| fig07::draw()),
    FigureSpec::new("fig08", &[&THEORY], fig08::draw),
    FigureSpec::new("fig09", &[&THEORY], fig09::draw),
    FigureSpec::new("fig10", &[&THEORY], |_| fig10::draw()),
    FigureSpec::new("fig11", &[&THEORY], fig11::draw),
    FigureSpec::new("fig12", &[&SWEEP, &THEORY], fig12::draw),
    FigureSpec::new("fig13", &[&THEORY], fig13::draw),
    FigureSpec::new("fig14", &[&THEORY], fig14::draw),
    FigureSpec::new("fig15", &[&SWEEP, &THEORY], fig15::draw),
    FigureSpec::new("s01", &[&SPACE_TIME], |results| s01::draw(results.of(&SPACE_TIME)?)),
    FigureSpec::new("s02", &[&PROTOCOL], s02::draw),
    FigureSpec::new("s03", &[&NUCLEATION, &SWEEP], s03::draw),
    FigureSpec::new("s04", &[&SEEDS, &SWEEP, &PROTOCOL, &THEORY], s04::draw),
    FigureSpec::new("s05", &[&BRANCHES, &PROTOCOL, &THEORY], s05::draw),
    FigureSpec::new("s06", &[&THEORY], s06::draw),
    FigureSpec::new("s07", &[&BIAS, &MEASURED], s07::draw),
    FigureSpec::new("s08", &[&TRIALS, &PROGRAMS], s08::draw),
    FigureSpec::new("s09", &[&RACE, &MEASURED], s09::draw),
    FigureSpec::new("s10", &[&RACE, &MEASURED], s10::draw),
    FigureSpec::new("s11", &[&SCALE, &MEASURED], s11::draw),
];
