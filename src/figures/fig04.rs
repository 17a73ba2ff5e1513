//! Fig. 4: the graph of the periodic motions of three masses.

use super::graph::Layout;
use super::prelude::*;

pub fn draw() -> Result<Figure, Error> {
    let sheet = Sheet::new(6300);
    let layout = Layout::rectangle((2350, 1300), (6050, 5000), 480, 1900.0);
    layout.edges(&sheet, Stroke::solid(BLUE, 26))?;
    layout.vertices(&sheet, &[0, 1, 2, 3])?;

    let description =
        "A directed graph with the four vertices L-1, 1-2, 2-3 and 3-R at the corners \
        of a square: the impacts of three masses with the left wall, among each other and with the \
        right wall. Its 16 edges join every vertex to every vertex: 4 loops and 12 arrows, two of \
        opposite direction between each of the 6 pairs."
            .to_string();
    Ok(sheet.finish("fig04", "The graph of three masses between walls", description))
}
