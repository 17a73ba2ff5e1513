//! Fig. 5: a simple circuit and its motion.

use super::prelude::*;
use crate::experiments::segments::Segments;

pub fn draw(all: &Segments) -> Result<Figure, Error> {
    let names = ("A simple circuit and its motion", "simple");
    super::motion::draw(names, &[0, 1, 3], &all.fig05)
}
