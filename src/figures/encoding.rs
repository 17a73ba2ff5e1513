//! Says once how each quantity looks in all figures, and what its axis is called.
//!
//! Red is what the simulation counts, purple the most likely number, green the theory and blue its
//! higher orders, as in the captions of Figs. 12, 13 and 15. The labs of the pages have the same
//! colours and dashes; blue dots are the reader's own chains there.

use crate::params::MethodName;
use literate::figures::prelude::*;

/// A quantity: its name, its line, and its mark.
pub struct Look {
    pub name: &'static str,
    pub line: Stroke,
    pub mark: Marker,
}

impl Look {
    const fn new(name: &'static str, colour: RGBColor, dash: Dash, symbol: Symbol) -> Look {
        let mark = (symbol, LARGE, Stroke::dashed(colour, THIN, dash));
        Look { name, line: Stroke::dashed(colour, LINE, dash), mark }
    }

    pub const ACTIVE: Look = Look::new("mean of chains with an impact", RED, SOLID, Symbol::Cross);
    pub const ALL: Look = Look::new("mean of all chains", RED, SHORT, Symbol::Ring);
    pub const SHARE: Look = Look::new("share of chains with an impact", RED, SOLID, Symbol::Plus);
    pub const MODE: Look = Look::new("most likely number", PURPLE, SOLID, Symbol::OpenDiamond);
    pub const THEORY: Look = Look::new("theory, Eq. (25)", GREEN, SOLID, Symbol::Disc);
    pub const REST: Look = Look::new("theory, from rest", GREEN, SHORT, Symbol::Ring);
    pub const HIGHER: Look = Look::new("with higher orders", BLUE, LONG, Symbol::Disc);
    pub const SEEDS: Look = Look::new("from seeds", INK, SOLID, Symbol::OpenSquare);
}

/// The labels of an axis of σ, and of half heights.
pub const SIGMA_LABEL: &str = "*σ* (*d ω*^{2})";
pub const HALF_HEIGHT_LABEL: &str = "*σ*_{1/2} (*d ω*^{2})";

/// Makes the axis of a number of the `n` gaps, up to a little more, with a number every `step`.
pub fn gaps_axis(n: usize, step: f64) -> Axis {
    let label = format!("gaps with an impact (of {n})");
    Axis::linear(0.0, 1.06 * n as f64, step, (step / 10.0) as u32, &label)
        .column("gaps with an impact (1)")
}

/// The mark of a method, whose line joins its settings. The engine is red, methods of fixed steps
/// have colours of their own, all others are grey.
pub fn method(method: MethodName) -> Marker {
    let (mark, size, colour) = match method {
        MethodName::Certified => return (Symbol::Disc, LARGE + 12, Stroke::solid(RED, LINE)),
        MethodName::Sampled => (Symbol::Ring, MEDIUM + 4, GREY),
        MethodName::Advancement => (Symbol::OpenSquare, MEDIUM, GREY),
        MethodName::RungeKutta => (Symbol::Disc, MEDIUM, GREY),
        MethodName::MoreauJean => (Symbol::Plus, MEDIUM + 14, BLUE),
        MethodName::Penalty => (Symbol::OpenTriangle, MEDIUM + 4, PURPLE),
        MethodName::VerletAbreast => (Symbol::Square, MEDIUM, ORANGE),
        MethodName::Verlet | MethodName::Truth => (Symbol::Cross, MEDIUM, ORANGE),
    };
    (mark, size, Stroke::solid(colour, THIN))
}
