//! What the stock elements of plotters lack on our backend: dashed curves, filled areas with one
//! edge, compact markers and arrows. Each is a plotters element, in any coordinates.

use std::fmt::Write as _;

use plotters::element::{Drawable, PointCollection};
use plotters_backend::{BackendCoord, DrawingErrorKind};

use super::Error;
use super::backend::Svg;
use super::style::{Colour, Mark, Stroke};

type Drawn = Result<(), DrawingErrorKind<Error>>;

/// A line through points.
#[derive(Debug)]
pub struct Curve<C> {
    /// The points, in the coordinates of the area that it is drawn on.
    pub points: Vec<C>,
    /// Its line.
    pub stroke: Stroke,
    /// Whether its end carries an arrow head.
    pub arrow: bool,
}

/// A filled polygon without an edge.
#[derive(Debug)]
pub struct Area<C> {
    /// The corners.
    pub points: Vec<C>,
    /// Colour.
    pub fill: Colour,
    /// Opacity in hundredths.
    pub opacity: u8,
}

/// Upright ticks at thousands of points; those in one row that touch are one stroke.
#[derive(Debug)]
pub struct Ticks<C> {
    /// Their middles.
    pub points: Vec<C>,
    /// Their width, in grid units.
    pub width: i32,
    /// Colour; its thickness is their height.
    pub stroke: Stroke,
}

/// Equal markers at many points.
#[derive(Debug)]
pub struct Marks<C> {
    /// Where they stand.
    pub points: Vec<C>,
    /// Shape.
    pub mark: Mark,
    /// Half their width, in grid units.
    pub half: i32,
    /// Line of open shapes, colour of filled ones.
    pub stroke: Stroke,
}

impl<'a, C: 'a> PointCollection<'a, C> for &'a Curve<C> {
    type Point = &'a C;
    type IntoIter = &'a [C];
    fn point_iter(self) -> &'a [C] {
        &self.points
    }
}

impl<'a, C: 'a> PointCollection<'a, C> for &'a Area<C> {
    type Point = &'a C;
    type IntoIter = &'a [C];
    fn point_iter(self) -> &'a [C] {
        &self.points
    }
}

impl<'a, C: 'a> PointCollection<'a, C> for &'a Ticks<C> {
    type Point = &'a C;
    type IntoIter = &'a [C];
    fn point_iter(self) -> &'a [C] {
        &self.points
    }
}

impl<'a, C: 'a> PointCollection<'a, C> for &'a Marks<C> {
    type Point = &'a C;
    type IntoIter = &'a [C];
    fn point_iter(self) -> &'a [C] {
        &self.points
    }
}

/// Length and half width of an arrow head on a line of the given thickness.
fn head_size(width: u32) -> (f64, f64) {
    let width = f64::from(width);
    (90.0 + 2.6 * width, 34.0 + 1.1 * width)
}

impl<C> Drawable<Svg> for Curve<C> {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        pos: I,
        svg: &mut Svg,
        _: (u32, u32),
    ) -> Drawn {
        let mut path: Vec<BackendCoord> = pos.collect();
        path.dedup();
        if !self.arrow {
            svg.polyline(path, &self.stroke);
            return Ok(());
        }
        // The line ends inside the head; a short last stretch must not turn the head, so its
        // direction is taken over at least its own length.
        let Some(&tip) = path.last() else { return Ok(()) };
        let (length, half) = head_size(self.stroke.width);
        let distance = |p: &BackendCoord| {
            let (dx, dy) = (f64::from(tip.0 - p.0), f64::from(tip.1 - p.1));
            (dx, dy, (dx * dx + dy * dy).sqrt())
        };
        while path.len() > 1 && path.last().is_some_and(|p| distance(p).2 < length) {
            path.pop();
        }
        let Some((dx, dy, d)) = path.last().map(distance).filter(|&(.., d)| d > 0.0) else {
            return Ok(());
        };
        let (ux, uy) = (dx / d, dy / d);
        let at = |along: f64, aside: f64| {
            let x = f64::from(tip.0) - along * ux - aside * uy;
            let y = f64::from(tip.1) - along * uy + aside * ux;
            (x.round() as i32, y.round() as i32)
        };
        path.push(at(0.75 * length, 0.0));
        svg.polyline(path, &self.stroke);
        svg.polygon(
            [tip, at(length, half), at(0.75 * length, 0.0), at(length, -half)],
            self.stroke.colour,
            100,
        );
        Ok(())
    }
}

impl<C> Drawable<Svg> for Area<C> {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        pos: I,
        svg: &mut Svg,
        _: (u32, u32),
    ) -> Drawn {
        svg.polygon(pos, self.fill, self.opacity);
        Ok(())
    }
}

impl<C> Drawable<Svg> for Ticks<C> {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        pos: I,
        svg: &mut Svg,
        _: (u32, u32),
    ) -> Drawn {
        let mut places: Vec<BackendCoord> = pos.map(|(x, y)| (y, x)).collect();
        places.sort_unstable();
        let mut d = String::new();
        for run in places.chunk_by(|a, b| a.0 == b.0 && b.1 - a.1 <= self.width) {
            if let (Some((y, first)), Some((_, last))) = (run.first(), run.last()) {
                let _ = write!(d, "M{},{y}h{}", first - self.width / 2, last - first + self.width);
            }
        }
        svg.path(&d, &self.stroke, None);
        Ok(())
    }
}

impl<C> Drawable<Svg> for Marks<C> {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        pos: I,
        svg: &mut Svg,
        _: (u32, u32),
    ) -> Drawn {
        let mut d = String::new();
        let r = self.half;
        for (x, y) in pos {
            let _ = match self.mark {
                Mark::Cross => write!(
                    d,
                    "M{},{}l{},{}m0,{}l{},{}",
                    x - r,
                    y - r,
                    2 * r,
                    2 * r,
                    -2 * r,
                    -2 * r,
                    2 * r
                ),
                Mark::Plus => {
                    write!(d, "M{},{y}h{}M{x},{}v{}", x - r, 2 * r, y - r, 2 * r)
                }
                Mark::Disc | Mark::Ring => {
                    write!(
                        d,
                        "M{},{y}a{r},{r} 0 1 0 {},0a{r},{r} 0 1 0 {},0z",
                        x - r,
                        2 * r,
                        -2 * r
                    )
                }
                Mark::Square | Mark::OpenSquare => {
                    write!(d, "M{},{}h{}v{}h{}z", x - r, y - r, 2 * r, 2 * r, -2 * r)
                }
                Mark::Triangle | Mark::OpenTriangle => {
                    write!(d, "M{x},{}l{r},{}h{}z", y - r, 2 * r, -2 * r)
                }
                Mark::Diamond | Mark::OpenDiamond => {
                    write!(d, "M{x},{}l{r},{r}l{},{r}l{},{}z", y - r, -r, -r, -r)
                }
            };
        }
        let fill = match self.mark {
            Mark::Disc | Mark::Square | Mark::Diamond | Mark::Triangle => Some(self.stroke.colour),
            Mark::Ring | Mark::OpenSquare | Mark::OpenDiamond | Mark::OpenTriangle => {
                Some(super::style::WHITE)
            }
            Mark::Cross | Mark::Plus => None,
        };
        svg.path(&d, &self.stroke, fill);
        Ok(())
    }
}
