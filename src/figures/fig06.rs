//! Draws Fig. 6: a circuit that is not simple, and its motion.

use super::prelude::*;
use crate::experiments::segments::Segments;

pub fn draw(all: &Segments) -> Result<Figure, Error> {
    let names = ("A circuit that is not simple, and its motion", "non-simple");
    super::fig05::draw_circuit(names, &[0, 0, 1, 0, 2, 1, 3, 3], &all.fig06)
}
