//! Adds the elements that plotters lacks: lines with a pattern of dashes, arrows, symbols with an
//! edge, and dense ticks.

use super::drawing::{Drawing, Outcome};
use super::path::{Point, Step, circle, polygon, polyline};
use super::style::{SOLID, Stroke, Symbol, WHITE};
use plotters::element::{
    Cross, Drawable, DynElement, IntoDynElement, PathElement, PointCollection,
};
use plotters::style::ShapeStyle;
use plotters_backend::{BackendCoord, DrawingBackend};
use std::iter::once;

/// Symbol, half its width, and the line of an open symbol, whose colour fills a closed one.
pub type Marker = (Symbol, i32, Stroke);

type Draw = dyn Fn(&mut Drawing, Vec<Point>) -> Outcome;

/// An element that plotters lacks: points, and how it is drawn at their places on the sheet.
pub struct CustomElement<C> {
    points: Vec<C>,
    draw: Box<Draw>,
}

impl<C> CustomElement<C> {
    pub(super) fn new(
        points: Vec<C>,
        draw: impl Fn(&mut Drawing, Vec<Point>) -> Outcome + 'static,
    ) -> Self {
        CustomElement { points, draw: Box::new(draw) }
    }
}

impl<'a, C> PointCollection<'a, C> for &'a CustomElement<C> {
    type Point = &'a C;
    type IntoIter = &'a [C];

    fn point_iter(self) -> &'a [C] {
        &self.points
    }
}

impl<C> Drawable<Drawing> for CustomElement<C> {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        points: I,
        drawing: &mut Drawing,
        _: (u32, u32),
    ) -> Outcome {
        (self.draw)(drawing, points.collect())
    }
}

/// Makes a line through points: an element of plotters if it is solid.
pub fn line<C: Clone + 'static>(points: Vec<C>, stroke: Stroke) -> DynElement<'static, Drawing, C> {
    if stroke.dash == SOLID {
        return PathElement::new(points, stroke).into_dyn();
    }
    let dashed = move |drawing: &mut Drawing, mut points: Vec<Point>| {
        points.dedup();
        drawing.shape(polyline(points), None, Some(stroke));
        Ok(())
    };
    CustomElement::new(points, dashed).into_dyn()
}

/// Makes ticks as high as the stroke is thick; those in one row that touch are one stroke.
pub fn ticks<C>(points: Vec<C>, width: i32, stroke: Stroke) -> CustomElement<C> {
    CustomElement::new(points, move |drawing, mut points| {
        points.sort_unstable_by_key(|&(x, y)| (y, x));
        for run in points.chunk_by(|(x, y), (next_x, next_y)| y == next_y && next_x - x <= width) {
            let [(first_x, y), (last_x, _)] = [run[0], run[run.len() - 1]];
            let (left, right) = (first_x - width / 2, last_x - width / 2 + width);
            drawing.draw_line((left, y), (right, y), &ShapeStyle::from(stroke))?;
        }
        Ok(())
    })
}

/// Makes a solid line that ends in an arrow head, inside it. A short last stretch must not turn the
/// head, so its direction is taken over at least its length.
pub fn arrow<C>(points: Vec<C>, stroke: Stroke) -> CustomElement<C> {
    let width = f64::from(stroke.width);
    // Of the head, with half its width; a thick line has a larger one.
    let (length, half) = (90.0 + 2.6 * width, 34.0 + 1.1 * width);
    CustomElement::new(points, move |drawing, mut path| {
        let Some(&tip) = path.last() else { return Ok(()) };
        let to_tip = |p: &Point| {
            let (dx, dy) = (f64::from(tip.0 - p.0), f64::from(tip.1 - p.1));
            (dx, dy, (dx * dx + dy * dy).sqrt())
        };
        while path.len() > 1 && path.last().is_some_and(|p| to_tip(p).2 < length) {
            path.pop();
        }
        let Some((dx, dy, distance)) = path.last().map(to_tip).filter(|&(.., d)| d > 0.0) else {
            return Ok(());
        };
        let (ux, uy) = (dx / distance, dy / distance);
        let at = |along: f64, aside: f64| {
            let x = f64::from(tip.0) - along * ux - aside * uy;
            let y = f64::from(tip.1) - along * uy + aside * ux;
            (x.round() as i32, y.round() as i32)
        };
        path.push(at(0.75 * length, 0.0));
        let style = ShapeStyle::from(stroke);
        drawing.draw_path(path, &style)?;
        let head = [tip, at(length, half), at(0.75 * length, 0.0), at(length, -half)];
        drawing.fill_polygon(head, &style.color)
    })
}

/// Makes equal symbols at points, as one path, whose edge is solid.
pub fn markers<C>(points: Vec<C>, (symbol, r, line): Marker) -> CustomElement<C> {
    let stroke = Stroke::solid(line.colour, line.width);
    CustomElement::new(points, move |drawing, points| {
        let mut path: Vec<Step> = Vec::new();
        for (x, y) in points {
            let mut sides = |places: &[Point]| {
                let places = places.iter().map(|(right, down)| (x + right * r, y + down * r));
                path.extend(polygon(places));
            };
            match symbol {
                Symbol::Cross => Cross::new((), r, stroke).draw(once((x, y)), drawing, (0, 0))?,
                Symbol::Plus => {
                    path.extend(polyline([(x - r, y), (x + r, y)]));
                    path.extend(polyline([(x, y - r), (x, y + r)]));
                }
                Symbol::Disc | Symbol::Ring => path.extend(circle((x, y), r)),
                Symbol::Square | Symbol::OpenSquare => sides(&[(-1, -1), (1, -1), (1, 1), (-1, 1)]),
                Symbol::OpenTriangle => sides(&[(-1, 1), (0, -1), (1, 1)]),
                Symbol::OpenDiamond => sides(&[(0, -1), (1, 0), (0, 1), (-1, 0)]),
            }
        }
        let fill = match symbol {
            Symbol::Disc | Symbol::Square => Some((line.colour, 100)),
            Symbol::Cross => return Ok(()),
            Symbol::Plus => None,
            _ => Some((WHITE, 100)),
        };
        drawing.shape(path, fill, Some(stroke));
        Ok(())
    })
}
