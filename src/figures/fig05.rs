//! Fig. 5: a simple circuit and its motion.

use super::motion::{self, Circuit};
use super::prelude::*;
use crate::experiments::segments::Segments;

pub fn draw(segments: &Segments) -> Result<Figure, Error> {
    let circuit = Circuit {
        figure: 5,
        title: "A simple circuit and its motion",
        order: &[0, 1, 3],
        kind: "simple",
    };
    motion::draw(&circuit, &segments.fig05)
}
