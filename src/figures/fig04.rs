//! Draws Fig. 4: the graph of the periodic motions of three masses.

use super::graph::Layout;
use super::prelude::*;

pub fn draw() -> Result<Figure, Error> {
    let sheet = Sheet::new(6300);
    let layout = Layout::rectangle((2350, 1300), (6050, 5000), 480, 1900.0);
    layout.edges(&sheet, Stroke::solid(BLUE, 26))?;
    layout.vertices(&sheet, &[0, 1, 2, 3])?;

    // Each of the four vertices leads to all four.
    let (edges, arrows, pairs) = (4 * 4, 4 * 3, 4 * 3 / 2);
    let description = describe!(
        "A directed graph with the four vertices L-1, 1-2, 2-3 and 3-R at the corners \
        of a square: the impacts of three masses with the left wall, among each other and with the \
        right wall. Its {edges} edges join every vertex to every vertex: {} loops and {arrows} arrows, two of \
        opposite direction between each of the {pairs} pairs.",
        edges - arrows,
    );
    Ok(sheet.finish("The graph of three masses between walls", description))
}
