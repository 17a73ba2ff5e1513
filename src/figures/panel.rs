//! A panel: a frame on the sheet with its two axes, and what may be drawn in it.
//!
//! plotters moves points that lie outside a range onto the frame, which makes curves silently
//! false. Here such a point is an error, unless the caller asks for a cut at the frame.

use plotters::coord::Shift;
use plotters::coord::cartesian::Cartesian2d;
use plotters::coord::types::RangedCoordf64;
use plotters::drawing::DrawingArea;
use plotters::element::{Drawable, PointCollection, Text};
use plotters::style::text_anchor::{HPos, VPos};

use super::axis::Axis;
use super::backend::Svg;
use super::clip::clip;
use super::element::{Area, Curve, Marks};
use super::style::{self, Colour, HAIR, INK, Mark, SMALL, Stroke, TEXT};
use super::{Error, font};

type Plane = Cartesian2d<RangedCoordf64, RangedCoordf64>;

/// A rectangle of the sheet in grid units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Left edge.
    pub left: i32,
    /// Upper edge.
    pub top: i32,
    /// Right edge.
    pub right: i32,
    /// Lower edge.
    pub bottom: i32,
}

impl Frame {
    /// A frame from its edges.
    pub const fn new(left: i32, top: i32, right: i32, bottom: i32) -> Self {
        Frame { left, top, right, bottom }
    }
}

/// What to do with data outside the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// It is a mistake.
    Refuse,
    /// The panel shows a part of the data on purpose: cut at the frame.
    Cut,
}

/// Axes in a frame; data is given in axis coordinates.
pub struct Panel {
    sheet: DrawingArea<Svg, Shift>,
    plane: DrawingArea<Svg, Plane>,
    /// Where it stands.
    pub frame: Frame,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Size of the numbers at the ticks.
    pub numbers: i32,
}

const TICK: i32 = 85;
const MINOR_TICK: i32 = 50;
const GAP: i32 = 70;

impl Panel {
    /// A panel without anything in it yet, not even its axes.
    pub fn new(sheet: &DrawingArea<Svg, Shift>, frame: Frame, x: Axis, y: Axis) -> Self {
        let plane = sheet.clone().apply_coord_spec(Plane::new(
            x.lo..x.hi,
            y.lo..y.hi,
            (frame.left..frame.right, frame.bottom..frame.top),
        ));
        Panel { sheet: sheet.clone(), plane, frame, x, y, numbers: SMALL }
    }

    /// Where a value stands on the sheet.
    pub fn at(&self, x: f64, y: f64) -> (i32, i32) {
        self.plane.map_coordinate(&(x, y))
    }

    fn put<E>(&self, element: &E) -> Result<(), Error>
    where
        E: Drawable<Svg>,
        for<'a> &'a E: PointCollection<'a, (i32, i32)>,
    {
        Ok(self.sheet.draw(element)?)
    }

    fn line(&self, a: (i32, i32), b: (i32, i32)) -> Result<(), Error> {
        let stroke = Stroke::solid(INK, HAIR);
        self.put(&Curve { points: vec![a, b], stroke, arrow: false })
    }

    fn text(&self, text: &str, at: (i32, i32), size: i32, h: HPos, v: VPos) -> Result<(), Error> {
        self.put(&Text::new(text.to_string(), at, style::text(size, INK, h, v)))
    }

    /// Draws both axes: spines at the left and below, ticks outwards, numbers, labels.
    ///
    /// # Errors
    /// If a label has a character that the shipped fonts lack.
    pub fn axes(&self) -> Result<(), Error> {
        let Frame { left, top, right, bottom } = self.frame;
        self.line((left, top), (left, bottom))?;
        self.line((left, bottom), (right, bottom))?;
        for tick in &self.x.ticks {
            let x = self.at(tick.at, self.y.lo).0;
            let length = if tick.label.is_some() { TICK } else { MINOR_TICK };
            self.line((x, bottom), (x, bottom + length))?;
            if let Some(label) = tick.label.as_ref().filter(|label| !label.is_empty()) {
                let at = (x, bottom + TICK + GAP);
                self.text(label, at, self.numbers, HPos::Center, VPos::Top)?;
            }
        }
        if !self.x.label.is_empty() {
            let below = bottom + TICK + GAP + cap(self.numbers) + 2 * GAP;
            let at = ((left + right) / 2, below);
            self.text(&self.x.label, at, TEXT, HPos::Center, VPos::Top)?;
        }
        self.vertical()
    }

    /// The vertical axis: its numbers' width decides where its label stands.
    fn vertical(&self) -> Result<(), Error> {
        let Frame { left, top, bottom, .. } = self.frame;
        let mut widest = 0;
        for tick in &self.y.ticks {
            let y = self.at(self.x.lo, tick.at).1;
            let length = if tick.label.is_some() { TICK } else { MINOR_TICK };
            self.line((left, y), (left - length, y))?;
            if let Some(label) = &tick.label {
                let at = (left - TICK - GAP * 2 / 3, y);
                self.text(label, at, self.numbers, HPos::Right, VPos::Center)?;
                widest = widest.max(font::set(label)?.width * self.numbers / font::EM);
            }
        }
        if !self.y.label.is_empty() {
            let at = (left - TICK - widest - 3 * GAP, (top + bottom) / 2);
            let look = style::upwards(style::text(TEXT, INK, HPos::Center, VPos::Bottom));
            self.put(&Text::new(self.y.label.clone(), at, look))?;
        }
        Ok(())
    }

    /// The letter of a panel, "(a)", above its upper left corner.
    ///
    /// # Errors
    /// If a label has a character that the shipped fonts lack.
    pub fn letter(&self, text: &str) -> Result<(), Error> {
        let at = (self.frame.left + 60, self.frame.top - 80);
        self.text(text, at, TEXT, HPos::Left, VPos::Bottom)
    }

    /// Words at a place given in data.
    ///
    /// # Errors
    /// If a label has a character that the shipped fonts lack.
    pub fn note(
        &self,
        text: &str,
        (x, y): (f64, f64),
        (dx, dy): (i32, i32),
        look: (i32, Colour, HPos, VPos),
    ) -> Result<(), Error> {
        let (px, py) = self.at(x, y);
        let style = style::text(look.0, look.1, look.2, look.3);
        self.put(&Text::new(text.to_string(), (px + dx, py + dy), style))
    }

    fn check(&self, name: &str, points: &[(f64, f64)]) -> Result<(), Error> {
        match points.iter().find(|p| !(self.x.holds(p.0) && self.y.holds(p.1))) {
            Some(&(x, y)) => Err(Error::Outside { series: name.into(), x, y }),
            None => Ok(()),
        }
    }

    fn series<E>(&self, name: &str, elements: &[E]) -> Result<(), Error>
    where
        E: Drawable<Svg>,
        for<'a> &'a E: PointCollection<'a, (f64, f64)>,
    {
        let Frame { left, top, right, bottom } = self.frame;
        super::sheet::group(
            &self.sheet,
            &format!(
                "class=\"data\" data-name=\"{}\" data-frame=\"{left} {top} {right} {bottom}\"",
                super::backend::escape(name)
            ),
            || elements.iter().try_for_each(|e| self.plane.draw(e).map_err(Error::from)),
        )
    }

    /// A curve.
    ///
    /// # Errors
    /// [`Error::Outside`] if a point lies outside the frame and `outside` refuses that.
    pub fn curve(
        &self,
        name: &str,
        points: &[(f64, f64)],
        stroke: Stroke,
        outside: Outside,
    ) -> Result<(), Error> {
        if outside == Outside::Refuse {
            self.check(name, points)?;
        }
        if let Some(&(x, y)) = points.iter().find(|p| !(p.0.is_finite() && p.1.is_finite())) {
            return Err(Error::Outside { series: name.into(), x, y });
        }
        let inside: Vec<_> = match outside {
            Outside::Cut => points.to_vec(),
            // At most a rounding error is cut off here.
            Outside::Refuse => points
                .iter()
                .map(|p| (p.0.clamp(self.x.lo, self.x.hi), p.1.clamp(self.y.lo, self.y.hi)))
                .collect(),
        };
        let parts = clip(&inside, (self.x.lo, self.x.hi), (self.y.lo, self.y.hi));
        let curves: Vec<_> =
            parts.into_iter().map(|points| Curve { points, stroke, arrow: false }).collect();
        self.series(name, &curves)
    }

    /// Markers; points outside the frame are left out if `outside` cuts.
    ///
    /// # Errors
    /// [`Error::Outside`] if a point lies outside the frame and `outside` refuses that.
    pub fn marks(
        &self,
        name: &str,
        points: &[(f64, f64)],
        (mark, half, stroke): (Mark, i32, Stroke),
        outside: Outside,
    ) -> Result<(), Error> {
        if outside == Outside::Refuse {
            self.check(name, points)?;
        }
        let points =
            points.iter().copied().filter(|p| self.x.holds(p.0) && self.y.holds(p.1)).collect();
        self.series(name, &[Marks { points, mark, half, stroke }])
    }

    /// A filled polygon, all of it inside the frame.
    ///
    /// # Errors
    /// [`Error::Outside`] if a corner lies outside the frame.
    pub fn area(
        &self,
        name: &str,
        points: &[(f64, f64)],
        fill: Colour,
        opacity: u8,
    ) -> Result<(), Error> {
        self.check(name, points)?;
        self.series(name, &[Area { points: points.to_vec(), fill, opacity }])
    }

    /// Bars from `low` to `high` at each x, with caps of the given half width.
    ///
    /// # Errors
    /// [`Error::Outside`] if an end lies outside the frame.
    pub fn bars(
        &self,
        name: &str,
        bars: &[(f64, f64, f64)],
        half: i32,
        stroke: Stroke,
    ) -> Result<(), Error> {
        let ends: Vec<_> = bars.iter().flat_map(|&(x, a, b)| [(x, a), (x, b)]).collect();
        self.check(name, &ends)?;
        let width = (self.x.hi - self.x.lo) / f64::from(self.frame.right - self.frame.left);
        let cap = f64::from(half) * width;
        let line = |a, b| Curve { points: vec![a, b], stroke, arrow: false };
        let mut parts = Vec::new();
        for &(x, low, high) in bars {
            parts.push(line((x, low), (x, high)));
            if half > 0 {
                let (a, b) = ((x - cap).max(self.x.lo), (x + cap).min(self.x.hi));
                parts.push(line((a, low), (b, low)));
                parts.push(line((a, high), (b, high)));
            }
        }
        self.series(name, &parts)
    }
}

fn cap(size: i32) -> i32 {
    size * font::CAP_HEIGHT / font::EM
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::sheet::Sheet;
    use crate::figures::style::GREEN;

    fn panel() -> Panel {
        let sheet = Sheet::new(3000, None).unwrap();
        let axis = || Axis::linear(0.0, 1.0, 0.5, 1, "");
        sheet.panel(Frame::new(1000, 100, 2000, 1100), axis(), axis()).unwrap()
    }

    #[test]
    fn data_outside_the_frame_is_an_error_and_not_moved_onto_it() {
        let panel = panel();
        let line = Stroke::solid(GREEN, 30);
        let beyond = [(0.5, 0.5), (0.6, 1.1)];
        let drawn = panel.curve("curve", &beyond, line, Outside::Refuse);
        assert!(matches!(drawn, Err(Error::Outside { y: 1.1, .. })));
        panel.curve("curve", &beyond, line, Outside::Cut).unwrap();
        let marks = panel.marks("marks", &beyond, (Mark::Disc, 30, line), Outside::Refuse);
        assert!(matches!(marks, Err(Error::Outside { .. })));
        assert!(panel.area("area", &beyond, GREEN, 50).is_err());
        assert!(panel.bars("bars", &[(0.5, 0.1, 1.1)], 20, line).is_err());
        assert!(panel.curve("nan", &[(0.1, f64::NAN)], line, Outside::Cut).is_err());
    }

    #[test]
    fn a_wall_touched_within_rounding_is_inside() {
        let line = Stroke::solid(GREEN, 30);
        panel().curve("wall", &[(0.0, -1e-17), (1.0, 1.0 + 1e-15)], line, Outside::Refuse).unwrap();
    }

    #[test]
    fn corners_of_the_axes_are_corners_of_the_frame() {
        let panel = panel();
        assert_eq!(panel.at(0.0, 0.0), (1000, 1100));
        assert_eq!(panel.at(1.0, 1.0), (2000, 100));
    }
}
