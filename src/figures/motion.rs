//! Figs. 5 and 6: (a) a circuit on the graph, (b) a motion with the same impacts in this order.

use super::graph::{Layout, NAMES, name};
use super::prelude::*;
use crate::experiments::segments::Segment;

/// Colour and dash of each mass.
const MASSES: [(Colour, Dash); 3] =
    [(BLUE, Dash::Solid), (GREEN, Dash::Long), (ORANGE, Dash::Alternate)];

/// Draws one of the two figures; `order` are the gaps in the order of their impacts.
pub fn draw(
    (id, title, kind): (&str, &str, &str),
    order: &[usize],
    segment: &Segment,
) -> Result<Figure, Error> {
    let sheet = Sheet::new(9250);
    let layout = Layout::rectangle((2700, 1150), (5700, 3400), 400, 2000.0);
    layout.edges(&sheet, Stroke::solid(PALE, HAIR));
    layout.circuit(&sheet, order, RED)?;
    layout.vertices(&sheet, order)?;
    let look = (TEXT, INK, HPos::Left, VPos::Bottom);
    sheet.text(LETTERS[0], (260, 350), look)?;

    let duration = segment.until - segment.from;
    let walls = (segment.masses + 1) as f64;
    let x = time_axis(duration);
    let y = Axis::linear(0.0, walls, 1.0, 1, "position *x*_{*j*} / *d*");
    let panel = sheet.panel(Frame::new(1200, 4900, 8000, 8500), x, y)?;
    let panel = panel.file("b");
    sheet.text(LETTERS[1], (260, 4690), look)?;
    motion(&panel, segment, order.len())?;
    let names: Vec<&str> = order.iter().map(|&gap| NAMES[gap]).collect();
    let description = seen!(
        "(a) The graph of three masses with a {kind} circuit in red: {}. (b) Positions of the three masses against time, \
         over {} time units of a simulated motion, a segment and not a periodic orbit; each impact has the name of its \
         vertex and the number of the edge that leaves it.",
        names.join(", "),
        short(duration, 3),
    );
    Ok(sheet.finish(id, title, description))
}

fn time_axis(duration: f64) -> Axis {
    let label = "time *t* (1/*ω*)";
    let step = [0.5, 1.0, 2.0, 5.0, 10.0, 20.0].into_iter().find(|s| duration / s <= 8.0);
    let step = step.unwrap_or(50.0);
    Axis::linear(0.0, duration, step, if step == 2.0 { 2 } else { 5 }, label)
}

/// Walls, equilibria, paths and impacts; these have the number of the edge that leaves them in (a).
fn motion(panel: &Panel, segment: &Segment, length: usize) -> Result<(), Error> {
    let (from, d) = (segment.from, segment.spacing);
    let walls = (segment.masses + 1) as f64;
    for j in 1..=segment.masses {
        panel.level("equilibrium", j as f64, Stroke::solid(PALE, HAIR))?;
    }
    panel.level("wall", 0.0, Stroke::solid(INK, LINE))?;
    panel.level("wall", walls, Stroke::solid(INK, LINE))?;
    let paths: Vec<Vec<(f64, f64)>> = segment
        .positions
        .iter()
        .map(|path| segment.times.iter().zip(path).map(|(t, x)| (t - from, x / d)).collect())
        .collect();
    for (j, points) in paths.iter().enumerate() {
        let (colour, dash) = MASSES[j % MASSES.len()];
        let name = format!("mass {}", j + 1);
        panel.curve(&name, points, Stroke::dashed(colour, LINE, dash), Outside::Refuse)?;
    }
    let names: Vec<_> = (1..=paths.len()).map(|j| format!("*x*_{{{j}}}")).collect();
    let ends = names.iter().zip(&paths).zip(MASSES);
    let ends: Vec<_> = ends.map(|((name, path), look)| (&name[..], &path[..], look.0)).collect();
    panel.ends(&ends)?;
    let hits: Vec<_> =
        segment.impacts.iter().map(|hit| (hit.time - from, hit.position / d)).collect();
    let ring = (Mark::Ring, 70, Stroke::solid(RED, 24));
    panel.quiet().marks("impacts", &hits, ring, Outside::Refuse)?;
    let names: Vec<_> = segment.impacts.iter().map(|hit| name(hit.gap)).collect();
    for (name, hit) in names.iter().zip(&hits) {
        panel.record(&format!("impact {name}"), [*hit]);
    }
    let numbered = names.iter().enumerate().map(|(i, name)| match i < length {
        true => format!("{}: {name}", i + 1),
        // The first impact again.
        false => (i % length + 1).to_string(),
    });
    name_impacts(panel, &hits, &numbered.collect::<Vec<_>>(), &paths)
}

/// Where a name may stand beside its impact, the best places first, as [`Panel::label`] takes them.
const PLACES: [(i32, i32); 12] = [
    (0, -1),
    (0, 1),
    (1, 1),
    (1, -1),
    (2, 0),
    (1, -2),
    (3, 1),
    (3, -1),
    (0, -2),
    (4, -1),
    (-1, -1),
    (0, -3),
];

/// Names the impacts, each at the first place where no path, no equilibrium and no other name is in its way.
fn name_impacts(
    panel: &Panel,
    hits: &[(f64, f64)],
    names: &[String],
    paths: &[Vec<(f64, f64)>],
) -> Result<(), Error> {
    let lines: Vec<Vec<(i32, i32)>> =
        paths.iter().map(|path| path.iter().map(|p| panel.at(p.0, p.1)).collect()).collect();
    let marks: Vec<_> = hits.iter().map(|hit| panel.at(hit.0, hit.1)).collect();
    let mut taken: Vec<(i32, i32)> = Vec::new();
    for (i, &(x, y)) in marks.iter().enumerate() {
        let half = 45 * names[i].chars().count() as i32;
        let middle = |place: &(i32, i32)| {
            (x + 100 * place.0 + half * place.0.signum(), y + 100 * place.1 + 80 * place.1.signum())
        };
        let frame = panel.frame;
        let free = |place: &(i32, i32)| {
            let (px, py) = middle(place);
            let near = |q: (i32, i32), w: i32, h: i32| (q.0 - px).abs() < w && (q.1 - py).abs() < h;
            let inside = px > frame.left + half + 80
                && px < frame.right - half - 30
                && py > frame.top - 200
                && py < frame.bottom - 110;
            let rests = |j: usize| (panel.at(0.0, j as f64).1 - py).abs() < 120;
            let crossed = (1..=paths.len()).any(rests)
                || lines.iter().any(|line| {
                    line.windows(2)
                        .any(|w| (0..=8).any(|k| near(between(w[0], w[1], k), half + 25, 115)))
                });
            let others = marks.iter().enumerate().any(|(j, &m)| j != i && near(m, half + 60, 170));
            inside && !crossed && !others && !taken.iter().any(|&t| near(t, 2 * half + 80, 210))
        };
        let place = PLACES.iter().find(|place| free(place)).unwrap_or(&PLACES[0]);
        panel.label(&names[i], hits[i], *place, RED)?;
        taken.push(middle(place));
    }
    Ok(())
}

/// The point `eighths`/8 of the way from `a` to `b`.
fn between(a: (i32, i32), b: (i32, i32), eighths: i32) -> (i32, i32) {
    (a.0 + (b.0 - a.0) * eighths / 8, a.1 + (b.1 - a.1) * eighths / 8)
}
