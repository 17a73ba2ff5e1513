//! Fig. 6: a circuit that is not simple, and its motion.

use super::motion::{self, Circuit};
use super::prelude::*;
use crate::experiments::segments::Segments;

pub fn draw(segments: &Segments) -> Result<Figure, Error> {
    let circuit = Circuit {
        figure: 6,
        title: "A circuit that is not simple, and its motion",
        order: &[0, 0, 1, 0, 2, 1, 3, 3],
        kind: "non-simple",
    };
    motion::draw(&circuit, &segments.fig06)
}
