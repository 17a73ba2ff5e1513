//! The graph of three masses between walls, drawn: vertices, edges, loops, and circuits on it.

use super::prelude::*;

/// Names of the vertices, in the order of the gaps.
pub const NAMES: [&str; 4] = ["L-1", "1-2", "2-3", "3-R"];

/// The name of a gap as it is printed, with a dash.
pub fn name(gap: usize) -> String {
    NAMES.get(gap).unwrap_or(&"?").replace('-', "–")
}

/// Where the four vertices stand, clockwise from the upper left, and how large they are.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    /// Centres.
    pub centres: [(i32, i32); 4],
    /// Radius of a vertex.
    pub radius: i32,
    /// How far a loop reaches out.
    pub reach: f64,
}

impl Layout {
    /// A rectangle with the given upper left and lower right vertices.
    pub const fn rectangle(a: (i32, i32), b: (i32, i32), radius: i32, reach: f64) -> Self {
        Layout { centres: [a, (b.0, a.1), b, (a.0, b.1)], radius, reach }
    }

    fn centre(&self, vertex: usize) -> (f64, f64) {
        let (x, y) = self.centres[vertex];
        (f64::from(x), f64::from(y))
    }

    /// The edge from one vertex to another as a path that starts and ends at their circles. The
    /// two directions of a pair bend to opposite sides; a loop leaves its corner outwards.
    pub fn edge(&self, from: usize, to: usize) -> Vec<(i32, i32)> {
        let (a, b) = (self.centre(from), self.centre(to));
        let control = if from == to {
            let middle = self.middle();
            let (sx, sy) = ((a.0 - middle.0).signum(), (a.1 - middle.1).signum());
            // Two control points, turned by about 45 degrees to either side of the diagonal.
            let (near, far) = (0.12 * self.reach, self.reach);
            let one = (a.0 + sx * far, a.1 + sy * near);
            let two = (a.0 + sx * near, a.1 + sy * far);
            // Clockwise at every corner.
            if sx * sy < 0.0 { [one, two] } else { [two, one] }
        } else {
            let (dx, dy) = (b.0 - a.0, b.1 - a.1);
            let bow = 0.13;
            let c = ((a.0 + b.0) / 2.0 + bow * dy, (a.1 + b.1) / 2.0 - bow * dx);
            let towards =
                |p: (f64, f64)| (p.0 + 2.0 / 3.0 * (c.0 - p.0), p.1 + 2.0 / 3.0 * (c.1 - p.1));
            [towards(a), towards(b)]
        };
        let clear = f64::from(self.radius);
        (0..=96)
            .map(|i| bezier(a, control, b, f64::from(i) / 96.0))
            .filter(|&p| distance(p, a) > clear && distance(p, b) > clear + 25.0)
            .map(|p| (p.0.round() as i32, p.1.round() as i32))
            .collect()
    }

    fn middle(&self) -> (f64, f64) {
        let (a, b) = (self.centre(0), self.centre(2));
        ((a.0 + b.0) / 2.0, (a.1 + b.1) / 2.0)
    }

    /// Draws all sixteen edges.
    pub fn edges(&self, sheet: &Sheet, stroke: Stroke) -> Result<(), Error> {
        for from in 0..4 {
            for to in 0..4 {
                sheet.free().arrow(self.edge(from, to), stroke);
            }
        }
        Ok(())
    }

    /// Draws the vertices; those that are `visited` stand out.
    pub fn vertices(&self, sheet: &Sheet, visited: &[usize]) -> Result<(), Error> {
        for (vertex, &centre) in self.centres.iter().enumerate() {
            let on = visited.contains(&vertex);
            let (edge, ink) =
                if on { (Stroke::solid(INK, 30), INK) } else { (Stroke::solid(GREY, HAIR), GREY) };
            sheet.free().disc(centre, self.radius, WHITE, edge);
            sheet.text(&name(vertex), centre, (TEXT, ink, HPos::Center, VPos::Center))?;
        }
        Ok(())
    }

    /// Draws a circuit: its edges, each with the number of its step.
    pub fn circuit(&self, sheet: &Sheet, order: &[usize], colour: Colour) -> Result<(), Error> {
        let steps: Vec<_> =
            (0..order.len()).map(|i| self.edge(order[i], order[(i + 1) % order.len()])).collect();
        for path in &steps {
            sheet.free().arrow(path.clone(), Stroke::solid(colour, 42));
        }
        for (i, path) in steps.iter().enumerate() {
            // Off the middle, where the diagonals cross.
            let crosses = order[i].abs_diff(order[(i + 1) % order.len()]) == 2;
            let share = if crosses { 24 } else { 50 };
            let at = path[path.len() * share / 100];
            sheet.free().disc(at, 150, WHITE, Stroke::solid(colour, HAIR));
            let number = (i + 1).to_string();
            sheet.text(&number, at, (SMALL, INK, HPos::Center, VPos::Center))?;
        }
        Ok(())
    }
}

fn bezier(a: (f64, f64), c: [(f64, f64); 2], b: (f64, f64), t: f64) -> (f64, f64) {
    let s = 1.0 - t;
    let w = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
    let x = w[0] * a.0 + w[1] * c[0].0 + w[2] * c[1].0 + w[3] * b.0;
    let y = w[0] * a.1 + w[1] * c[0].1 + w[2] * c[1].1 + w[3] * b.1;
    (x, y)
}

fn distance(p: (f64, f64), q: (f64, f64)) -> f64 {
    let (dx, dy) = (p.0 - q.0, p.1 - q.1);
    (dx * dx + dy * dy).sqrt()
}
