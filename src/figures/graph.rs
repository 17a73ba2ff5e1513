//! Draws the graph of three masses between walls: vertices, edges, loops, and circuits on it.

use super::prelude::*;

/// Names of the vertices, in the order of the gaps.
pub const NAMES: [&str; 4] = ["L-1", "1-2", "2-3", "3-R"];

/// The name of a gap as it is printed, with a dash.
pub fn name(gap: usize) -> String {
    NAMES.get(gap).unwrap_or(&"?").replace('-', "–")
}

/// Where the four vertices stand, clockwise from the upper left, and how large they are.
pub struct Layout {
    centres: [(i32, i32); 4],
    radius: i32,
    /// How far a loop reaches out.
    reach: f64,
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
    fn edge(&self, from: usize, to: usize) -> Vec<(i32, i32)> {
        let (a, b) = (self.centre(from), self.centre(to));
        let control = if from == to {
            let (first, last) = (self.centre(0), self.centre(2));
            let sx = (a.0 - (first.0 + last.0) / 2.0).signum();
            let sy = (a.1 - (first.1 + last.1) / 2.0).signum();
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

    pub fn edges(&self, sheet: &Sheet, stroke: Stroke) -> Drawn {
        for edge in 0..16 {
            sheet.area.draw(&arrow(self.edge(edge / 4, edge % 4), stroke))?;
        }
        Ok(())
    }

    /// Draws the vertices; those that are `visited` stand out.
    pub fn vertices(&self, sheet: &Sheet, visited: &[usize]) -> Drawn {
        for (vertex, &centre) in self.centres.iter().enumerate() {
            let (ink, width) = if visited.contains(&vertex) { (INK, 30) } else { (GREY, HAIR) };
            let ring = (Symbol::Ring, self.radius, Stroke::solid(ink, width));
            sheet.area.draw(&markers(vec![centre], ring))?;
            let style = words(TEXT, ink, HPos::Center, VPos::Center);
            sheet.area.draw_text(&name(vertex), &style, centre)?;
        }
        Ok(())
    }

    /// Draws a circuit: its edges, each with the number of its step.
    pub fn circuit(&self, sheet: &Sheet, order: &[usize], colour: RGBColor) -> Drawn {
        let steps = || order.iter().zip(order.iter().cycle().skip(1)).zip(1..);
        for ((&from, &to), _) in steps() {
            sheet.area.draw(&arrow(self.edge(from, to), Stroke::solid(colour, 42)))?;
        }
        for ((&from, &to), step) in steps() {
            // Off the middle, where the diagonals cross.
            let share = if from.abs_diff(to) == 2 { 24 } else { 50 };
            let path = self.edge(from, to);
            let at = path[path.len() * share / 100];
            sheet
                .area
                .draw(&markers(vec![at], (Symbol::Ring, 150, Stroke::solid(colour, HAIR))))?;
            let style = words(SMALL, INK, HPos::Center, VPos::Center);
            sheet.area.draw_text(&i32::to_string(&step), &style, at)?;
        }
        Ok(())
    }
}

fn bezier(a: (f64, f64), c: [(f64, f64); 2], b: (f64, f64), t: f64) -> (f64, f64) {
    let s = 1.0 - t;
    let w = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
    let at = |p: [f64; 4]| w[0] * p[0] + w[1] * p[1] + w[2] * p[2] + w[3] * p[3];
    (at([a.0, c[0].0, c[1].0, b.0]), at([a.1, c[0].1, c[1].1, b.1]))
}

fn distance(p: (f64, f64), q: (f64, f64)) -> f64 {
    let (dx, dy) = (p.0 - q.0, p.1 - q.1);
    (dx * dx + dy * dy).sqrt()
}
