//! Draws Fig. 5: (a) a simple circuit on the graph, (b) a motion with the same impacts in this
//! order; Fig. 6 is drawn in the same way.

use super::graph::{Layout, NAMES, name};
use super::prelude::*;
use crate::experiments::segments::{Segment, Segments};

/// Colour and dash of each mass.
const MASSES: [(RGBColor, Dash); 3] = [(BLUE, SOLID), (GREEN, LONG), (ORANGE, ALTERNATE)];

pub fn draw(all: &Segments) -> Result<Figure, Error> {
    draw_circuit(("A simple circuit and its motion", "simple"), &[0, 1, 3], &all.fig05)
}

/// Draws a circuit, given by the gaps in the order of their impacts, and its motion.
pub fn draw_circuit(
    (title, kind): (&str, &str),
    order: &[usize],
    segment: &Segment,
) -> Result<Figure, Error> {
    let sheet = Sheet::new(9250);
    let layout = Layout::rectangle((2700, 1150), (5700, 3400), 400, 2000.0);
    layout.edges(&sheet, Stroke::solid(PALE, HAIR))?;
    layout.circuit(&sheet, order, RED)?;
    layout.vertices(&sheet, order)?;
    let style = words(TEXT, INK, HPos::Left, VPos::Bottom);
    sheet.area.draw_text("(a)", &style, (260, 350))?;

    let duration = segment.until - segment.from;
    let walls = (segment.masses + 1) as f64;
    let x = Axis::linear(0.0, duration, 1.0, 5, "time *t* (1/*ω*)");
    // With room for the walls.
    let y = Axis::linear(-0.16, walls + 0.16, 1.0, 1, "position *x*_{*j*} / *d*");
    let panel = sheet.panel(Frame::new(1200, 4900, 8000, 8500), x, y)?;
    panel.set_suffix("b");
    sheet.area.draw_text("(b)", &style, (260, 4690))?;
    motion(&panel, segment, order.len())?;
    let names: Vec<&str> = order.iter().map(|&gap| NAMES[gap]).collect();
    let description = describe!(
        "(a) The graph of three masses with a {kind} circuit in red: {}. (b) Positions of the three masses against time, \
         over {} time units of a simulated motion, a segment and not a periodic orbit; each impact has \
         the number of the edge that leaves its vertex.",
        names.join(", "),
        short(duration, 3),
    );
    Ok(sheet.finish(title, description))
}

/// Walls, equilibria, paths and impacts; each impact has the number of the edge that leaves it.
fn motion(panel: &Panel, segment: &Segment, length: usize) -> Drawn {
    let (from, d) = (segment.from, segment.spacing);
    let walls = (segment.masses + 1) as f64;
    for j in 1..=segment.masses {
        panel.level("equilibrium", j as f64, Stroke::solid(PALE, HAIR))?;
    }
    for (inner, outer) in [(0.0, panel.y.lo), (walls, panel.y.hi)] {
        let wall = [(panel.x.lo, inner), (panel.x.hi, outer)];
        panel.area.draw(&Rectangle::new(wall, PALE.filled()))?;
        panel.level("wall", inner, Stroke::solid(INK, THIN))?;
    }
    let times = || segment.times.iter().map(|time| time - from);
    let paths = segment.positions.iter().map(|path| times().zip(path.iter().map(|x| x / d)));
    let paths: Vec<Vec<(f64, f64)>> = paths.map(Iterator::collect).collect();
    for (j, points) in paths.iter().enumerate() {
        let (colour, dash) = MASSES[j % MASSES.len()];
        panel.curve(&format!("mass {}", j + 1), points, Stroke::dashed(colour, LINE, dash))?;
    }
    let ends = (1..).zip(&paths).zip(MASSES);
    let ends = ends.map(|((j, path), look)| (format!("*x*_{{{j}}}"), path, look.0));
    panel.label_ends(&ends.collect::<Vec<_>>())?;
    let hits: Vec<_> =
        segment.impacts.iter().map(|hit| (hit.time - from, hit.position / d)).collect();
    panel.unrecorded().markers("impacts", &hits, (Symbol::Ring, 70, Stroke::solid(RED, 24)))?;
    for (i, (hit, at)) in segment.impacts.iter().zip(&hits).enumerate() {
        panel.record(&format!("impact {}", name(hit.gap)), [*at]);
        let down = if at.1 > walls - 0.5 { 2 } else { -1 };
        panel.label_nearby(&(i % length + 1).to_string(), *at, (0, down), RED)?;
    }
    Ok(())
}
