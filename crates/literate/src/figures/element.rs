//! What the stock elements of plotters lack: dashed curves, filled areas with one edge, compact
//! markers and arrows. Each is a plotters element, in any coordinates.

use plotters::element::{Drawable, PointCollection};
use plotters_backend::{BackendCoord, DrawingErrorKind};

use super::Error;
use super::drawing::{Drawing, Element, Geometry, Paint, Step};
use super::panel::Frame;
use super::style::{Colour, Mark, Stroke, WHITE};

/// What is drawn at some points.
#[derive(Clone, Debug)]
pub enum Look {
    /// A line through them.
    Curve(Stroke),
    /// A straight stroke from each first point to the second.
    Strokes(Stroke),
    /// A line that ends in an arrow head.
    Arrow(Stroke),
    /// A polygon without an edge; opacity in hundredths.
    Area(Colour, u8),
    /// Upright ticks of a width in grid units, as high as the stroke is thick; those in one row that touch are
    /// one stroke.
    Ticks(i32, Stroke),
    /// Equal markers: shape, half their width in grid units, line of open shapes and colour of filled ones.
    Marks(Mark, i32, Stroke),
    /// No point: a series begins.
    Open(String, Frame),
    /// No point: it ends.
    Close,
}

/// An element: points in the coordinates of the area that it is drawn on, and their look.
#[derive(Clone, Debug)]
pub struct Drawn<C>(pub Vec<C>, pub Look);

impl<'a, C: 'a> PointCollection<'a, C> for &'a Drawn<C> {
    type Point = &'a C;
    type IntoIter = &'a [C];
    fn point_iter(self) -> &'a [C] {
        &self.0
    }
}

impl<C> Drawable<Drawing> for Drawn<C> {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        pos: I,
        drawing: &mut Drawing,
        _: (u32, u32),
    ) -> Result<(), DrawingErrorKind<Error>> {
        match &self.1 {
            Look::Curve(stroke) => drawing.polyline(through(pos), *stroke),
            Look::Strokes(stroke) => {
                let ends: Vec<BackendCoord> = pos.collect();
                let strokes = ends.chunks_exact(2).flat_map(|pair| {
                    let (dx, dy) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
                    [Step::Begin(pair[0]), Step::LineBy((dx, dy))]
                });
                let paint = Paint { fill: None, stroke: Some(*stroke) };
                drawing.shape(Geometry::Path(strokes.collect()), paint);
            }
            Look::Arrow(stroke) => arrow(through(pos), stroke, drawing),
            Look::Area(colour, opacity) => {
                let fill = Some((*colour, *opacity));
                drawing.shape(Geometry::Polygon(pos.collect()), Paint { fill, stroke: None });
            }
            Look::Ticks(width, stroke) => {
                let paint = Paint { fill: None, stroke: Some(*stroke) };
                drawing.shape(Geometry::Path(ticks(pos, *width)), paint);
            }
            Look::Marks(mark, half, stroke) => {
                let path = pos.flat_map(|at| outline(*mark, *half, at)).collect();
                let inside = match mark {
                    Mark::Disc | Mark::Square | Mark::Diamond | Mark::Triangle => {
                        Some(stroke.colour)
                    }
                    Mark::Ring | Mark::OpenSquare | Mark::OpenDiamond | Mark::OpenTriangle => {
                        Some(WHITE)
                    }
                    Mark::Cross | Mark::Plus => None,
                };
                let fill = inside.map(|colour| (colour, 100));
                drawing.shape(Geometry::Path(path), Paint { fill, stroke: Some(*stroke) });
            }
            Look::Open(name, frame) => drawing.elements.push(Element::Open(name.clone(), *frame)),
            Look::Close => drawing.elements.push(Element::Close),
        }
        Ok(())
    }
}

/// Points of a line, without repetitions.
fn through(pos: impl Iterator<Item = BackendCoord>) -> Vec<BackendCoord> {
    let mut path: Vec<_> = pos.collect();
    path.dedup();
    path
}

/// Length and half width of an arrow head on a line of the given thickness.
fn head_size(width: u32) -> (f64, f64) {
    let width = f64::from(width);
    (90.0 + 2.6 * width, 34.0 + 1.1 * width)
}

/// The line ends inside the head; a short last stretch must not turn the head, so its direction is taken over
/// at least its own length.
fn arrow(mut path: Vec<BackendCoord>, stroke: &Stroke, drawing: &mut Drawing) {
    let Some(&tip) = path.last() else { return };
    let (length, half) = head_size(stroke.width);
    let distance = |p: &BackendCoord| {
        let (dx, dy) = (f64::from(tip.0 - p.0), f64::from(tip.1 - p.1));
        (dx, dy, (dx * dx + dy * dy).sqrt())
    };
    while path.len() > 1 && path.last().is_some_and(|p| distance(p).2 < length) {
        path.pop();
    }
    let Some((dx, dy, d)) = path.last().map(distance).filter(|&(.., d)| d > 0.0) else {
        return;
    };
    let (ux, uy) = (dx / d, dy / d);
    let at = |along: f64, aside: f64| {
        let x = f64::from(tip.0) - along * ux - aside * uy;
        let y = f64::from(tip.1) - along * uy + aside * ux;
        (x.round() as i32, y.round() as i32)
    };
    path.push(at(0.75 * length, 0.0));
    drawing.polyline(path, *stroke);
    let head = vec![tip, at(length, half), at(0.75 * length, 0.0), at(length, -half)];
    let fill = Some((stroke.colour, 100));
    drawing.shape(Geometry::Polygon(head), Paint { fill, stroke: None });
}

fn ticks(pos: impl Iterator<Item = BackendCoord>, width: i32) -> Vec<Step> {
    let mut places: Vec<BackendCoord> = pos.map(|(x, y)| (y, x)).collect();
    places.sort_unstable();
    let mut path = Vec::new();
    for run in places.chunk_by(|a, b| a.0 == b.0 && b.1 - a.1 <= width) {
        if let (Some((y, first)), Some((_, last))) = (run.first(), run.last()) {
            path.extend([Step::Begin((first - width / 2, *y)), Step::Side(last - first + width)]);
        }
    }
    path
}

/// One marker with half the width `r`.
fn outline(mark: Mark, r: i32, (x, y): BackendCoord) -> Vec<Step> {
    use Step::{Begin, BeginBy, Close, Down, HalfCircle, LineBy, Side};
    match mark {
        Mark::Cross => vec![
            Begin((x - r, y - r)),
            LineBy((2 * r, 2 * r)),
            BeginBy((0, -2 * r)),
            LineBy((-2 * r, 2 * r)),
        ],
        Mark::Plus => vec![Begin((x - r, y)), Side(2 * r), Begin((x, y - r)), Down(2 * r)],
        Mark::Disc | Mark::Ring => {
            vec![Begin((x - r, y)), HalfCircle(2 * r), HalfCircle(-2 * r), Close]
        }
        Mark::Square | Mark::OpenSquare => {
            vec![Begin((x - r, y - r)), Side(2 * r), Down(2 * r), Side(-2 * r), Close]
        }
        Mark::Triangle | Mark::OpenTriangle => {
            vec![Begin((x, y - r)), LineBy((r, 2 * r)), Side(-2 * r), Close]
        }
        Mark::Diamond | Mark::OpenDiamond => {
            vec![Begin((x, y - r)), LineBy((r, r)), LineBy((-r, r)), LineBy((-r, -r)), Close]
        }
    }
}
