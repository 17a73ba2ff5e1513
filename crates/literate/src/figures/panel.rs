//! The sheet that a figure is drawn on, and its panels: frames with two axes; [`super::series`] draws data in it and records it.
//! Both fail if a label has a character that the shipped fonts lack.

use super::axis::{Axis, Tick};
use super::drawing::{Drawing, Frame, Look};
use super::error::Error;
use super::figure::{Description, Figure};
use super::font;
use super::path::Point;
use super::record::Record;
use super::style::{Colour, HAIR, INK, SMALL, Stroke, TEXT, WIDTH};
use plotters::coord::CoordTranslate;
use plotters::coord::cartesian::Cartesian2d;
use plotters::coord::types::RangedCoordf64;
use plotters::style::text_anchor::{HPos, VPos};
use std::cell::{RefCell, RefMut};
use std::rc::Rc;

/// Axes in a frame; data is given in its own units, whatever the scales.
#[derive(Clone)]
pub struct Panel {
    pub(super) drawing: Rc<RefCell<Drawing>>,
    pub(super) plane: Cartesian2d<RangedCoordf64, RangedCoordf64>,
    /// Where it stands.
    pub frame: Frame,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    pub(super) record: Rc<RefCell<Record>>,
    pub(super) recorded: bool,
}

const TICK: i32 = 85;
const MINOR_TICK: i32 = 50;
const GAP: i32 = 70;

/// Distance from a frame to the base of the label of its upright axis, without the width of the numbers.
pub(super) const BESIDE: i32 = TICK + 4 * GAP;
/// From a frame to the top of the label below it.
pub(super) const BELOW: i32 = TICK + 3 * GAP + SMALL;

/// What stays clear around a name.
const CLEARANCE: i32 = 45;

/// From one line of words to the next.
pub(super) const LINE_HEIGHT: i32 = 340;

/// Heights on the sheet in the same order, at least `least` apart: where some are closer, they move to both sides.
pub(super) fn apart(heights: &[i32], least: i32) -> Vec<i32> {
    let mut order: Vec<usize> = (0..heights.len()).collect();
    order.sort_by_key(|&i| heights[i]);
    let mut places = heights.to_vec();
    for _ in 0..4 * heights.len() {
        for pair in order.windows(2) {
            let missing = (least - (places[pair[1]] - places[pair[0]])).max(0);
            places[pair[0]] -= missing / 2;
            places[pair[1]] += missing - missing / 2;
        }
    }
    places
}

impl Panel {
    /// A panel without anything in it yet, not even its axes.
    pub(super) fn new(drawing: &Rc<RefCell<Drawing>>, frame: Frame, x: Axis, y: Axis) -> Self {
        let record = Rc::new(RefCell::new(Record::new(&x, &y)));
        let ((from, to), (low, high)) = (x.ends(), y.ends());
        let place = (frame.left..frame.right, frame.bottom..frame.top);
        let plane = Cartesian2d::new(from..to, low..high, place);
        Panel { drawing: drawing.clone(), plane, frame, x, y, record, recorded: true }
    }

    /// Where a value stands on the sheet.
    pub fn at(&self, x: f64, y: f64) -> Point {
        self.place((self.x.position(x), self.y.position(y)))
    }

    /// Where a place on the axes stands on the sheet.
    pub(super) fn place(&self, place: (f64, f64)) -> Point {
        self.plane.translate(&place)
    }

    /// The same panel, which records into a file of its own: its name is the figure's id with these letters behind.
    pub fn with_suffix(self, suffix: &str) -> Self {
        self.record.borrow_mut().suffix = suffix.into();
        Panel { recorded: true, ..self }
    }

    /// The same panel for what is no data of its own: repeated outlines, rims, details.
    pub fn unrecorded(&self) -> Self {
        Panel { recorded: false, ..self.clone() }
    }

    pub(super) fn text(
        &self,
        text: &str,
        at: Point,
        size: i32,
        h: HPos,
        v: VPos,
    ) -> Result<(), Error> {
        self.drawing.borrow_mut().label(text, at, (size, INK, h, v), false)
    }

    /// Draws both axes: spines at the left and below, ticks outwards, numbers, labels.
    pub fn axes(&self) -> Result<(), Error> {
        let Frame { left, top, right, bottom } = self.frame;
        let mut lines = vec![(left, top), (left, bottom), (left, bottom), (right, bottom)];
        let length = |tick: &Tick| if tick.label.is_some() { TICK } else { MINOR_TICK };
        lines.extend(self.x.ticks.iter().flat_map(|tick| {
            let x = self.at(tick.at, self.y.lo).0;
            [(x, bottom), (x, bottom + length(tick))]
        }));
        lines.extend(self.y.ticks.iter().flat_map(|tick| {
            let y = self.at(self.x.lo, tick.at).1;
            [(left, y), (left - length(tick), y)]
        }));
        self.drawing.borrow_mut().strokes(&lines, Stroke::solid(INK, HAIR));
        for tick in &self.x.ticks {
            let x = self.at(tick.at, self.y.lo).0;
            if let Some(label) = tick.label.as_ref().filter(|label| !label.is_empty()) {
                let at = (x, bottom + TICK + GAP);
                self.text(label, at, SMALL, HPos::Center, VPos::Top)?;
            }
        }
        if !self.x.label.is_empty() {
            let numbers = SMALL * font::CAP_HEIGHT / font::EM;
            let at = ((left + right) / 2, bottom + TICK + numbers + 3 * GAP);
            self.text(&self.x.label, at, TEXT, HPos::Center, VPos::Top)?;
        }
        // The numbers' width decides where the label stands.
        let mut widest = 0;
        for tick in &self.y.ticks {
            let y = self.at(self.x.lo, tick.at).1;
            if let Some(label) = &tick.label {
                let at = (left - TICK - GAP * 2 / 3, y);
                self.text(label, at, SMALL, HPos::Right, VPos::Center)?;
                widest = widest.max(font::set(label)?.width * SMALL / font::EM);
            }
        }
        if !self.y.label.is_empty() {
            let at = (left - TICK - widest - 4 * GAP, (top + bottom) / 2);
            let look = (TEXT, INK, HPos::Center, VPos::Bottom);
            self.drawing.borrow_mut().label(&self.y.label, at, look, true)?;
        }
        Ok(())
    }

    /// The letter of a panel, "(a)", above its upper left corner, and behind the name of its file.
    pub fn letter(&self, text: &str) -> Result<(), Error> {
        self.record.borrow_mut().suffix = text.trim_matches(['(', ')']).into();
        let at = (self.frame.left + 60, self.frame.top - 80);
        self.text(text, at, TEXT, HPos::Left, VPos::Bottom)
    }

    /// Names a curve or a mark in its colour, near a place given in data: so many millimetres to the right of it and
    /// below it, towards which the words stand. `(1, 0)` is right of the place, `(0, -1)` above it.
    pub fn label(
        &self,
        text: &str,
        (x, y): (f64, f64),
        (right, down): (i32, i32),
        colour: Colour,
    ) -> Result<(), Error> {
        let h = [HPos::Right, HPos::Center, HPos::Left][(right.signum() + 1) as usize];
        let v = [VPos::Bottom, VPos::Center, VPos::Top][(down.signum() + 1) as usize];
        let (px, py) = self.at(x, y);
        let at = (px + 100 * right, py + 100 * down);
        self.drawing.borrow_mut().rimmed(text, at, (SMALL, colour, h, v))
    }

    /// Names something as [`Panel::label`] does, there or as near as no line and no words are in the way of what is drawn so
    /// far. A name for which there is no room is left out.
    pub fn label_nearby(
        &self,
        text: &str,
        at: (f64, f64),
        beside: (i32, i32),
        colour: Colour,
    ) -> Result<(), Error> {
        const AROUND: [(i32, i32); 8] =
            [(1, 0), (1, -1), (1, 1), (0, -1), (0, 1), (-1, -1), (-1, 1), (-1, 0)];
        let farther = (1..=3).flat_map(|far| AROUND.map(|(x, y)| (far * x, far * y)));
        let (px, py) = self.at(at.0, at.1);
        let size = [font::set(text)?.width, font::CAP_HEIGHT].map(|own| own * SMALL / font::EM);
        let is_free = |&(right, down): &(i32, i32)| {
            let from = |place: i32, own: i32, to: i32| {
                place + 100 * to - own * (1 - to.signum()) / 2 - CLEARANCE
            };
            let (left, top) = (from(px, size[0], right), from(py, size[1], down));
            let [width, height] = size.map(|own| own + 2 * CLEARANCE);
            let frame = Frame::new(left, top, left + width, top + height);
            let inside = left >= self.frame.left && frame.right <= WIDTH as i32 && top >= 0;
            inside && frame.bottom <= self.frame.bottom && self.drawing.borrow().is_free(frame)
        };
        match std::iter::once(beside).chain(farther).find(is_free) {
            Some(beside) => self.label(text, at, beside, colour),
            None => Ok(()),
        }
    }

    /// Names curves, each given by name, points and colour, at their right ends in this panel; names that would touch move
    /// apart.
    pub fn label_ends<P: AsRef<[(f64, f64)]>>(
        &self,
        curves: &[(String, P, Colour)],
    ) -> Result<(), Error> {
        let end = |points: &[(f64, f64)]| {
            let inside = |p: &&(f64, f64)| self.x.contains(p.0) && self.y.contains(p.1);
            points.iter().rfind(inside).map(|p| self.at(p.0, p.1))
        };
        let named = || {
            curves.iter().filter_map(|(text, own, look)| Some((end(own.as_ref())?, text, *look)))
        };
        let heights = apart(&named().map(|(at, ..)| at.1).collect::<Vec<_>>(), LINE_HEIGHT);
        for ((at, text, colour), y) in named().zip(heights) {
            let look = (SMALL, colour, HPos::Left, VPos::Center);
            self.drawing.borrow_mut().rimmed(text, (at.0 + 100, y), look)?;
        }
        Ok(())
    }
}

/// A figure in the making.
pub struct Sheet {
    drawing: Rc<RefCell<Drawing>>,
    records: RefCell<Vec<Rc<RefCell<Record>>>>,
}

impl Sheet {
    /// An empty sheet of column width, `height` grid units high.
    pub fn new(height: u32) -> Self {
        let drawing = Rc::new(RefCell::new(Drawing::new(height)));
        Sheet { drawing, records: RefCell::default() }
    }

    /// A panel with its axes drawn.
    pub fn panel(&self, frame: Frame, x: Axis, y: Axis) -> Result<Panel, Error> {
        let panel = Panel::new(&self.drawing, frame, x, y);
        self.records.borrow_mut().push(panel.record.clone());
        panel.axes()?;
        Ok(panel)
    }

    /// A panel with its axes and its letter.
    pub fn lettered_panel(
        &self,
        letter: &str,
        frame: Frame,
        x: Axis,
        y: Axis,
    ) -> Result<Panel, Error> {
        let panel = self.panel(frame, x, y)?;
        panel.letter(letter)?;
        Ok(panel)
    }

    /// For free drawing.
    pub fn free(&self) -> RefMut<'_, Drawing> {
        self.drawing.borrow_mut()
    }

    /// Words on the sheet.
    pub fn text(&self, text: &str, at: Point, look: Look) -> Result<(), Error> {
        self.free().label(text, at, look, false)
    }

    /// Closes a figure. Its data is what its panels have recorded, a file for each. The paper gives it its name.
    pub fn finish(self, title: &str, description: Description) -> Figure {
        let drawing = self.drawing.take();
        let records = self.records.take();
        let data = records.iter().filter_map(|record| record.borrow().file()).collect();
        Figure { title: title.into(), description, drawing, data, ..Figure::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::super::drawing::{Element, Label};
    use super::super::style::{BLUE, RED};
    use super::*;

    #[test]
    fn names_stand_beside_what_they_name() {
        let axis = || Axis::linear(0.0, 1.0, 0.5, 1, "");
        let sheet = Sheet::new(3000);
        let panel = sheet.panel(Frame::new(1000, 100, 2000, 1100), axis(), axis()).unwrap();
        panel.label("mark", (0.5, 0.5), (-1, 2), RED).unwrap();
        // The last point of the second lies outside; the ends of both are then too near for their names.
        let (low, high) = ([(0.0, 0.0), (1.0, 0.5)], [(0.9, 0.51), (1.0, 1.5)]);
        panel.label_ends(&[("low".into(), &low, BLUE), ("high".into(), &high, RED)]).unwrap();
        let drawing = sheet.finish("", Default::default()).drawing;
        let named = |element: &Element| match element {
            Element::Label(Label { words, at, colour, rim: true, .. }) => {
                Some((words.clone(), *at, *colour))
            }
            _ => None,
        };
        let names: Vec<_> = drawing.elements.iter().filter_map(named).collect();
        let of = |text: &str, at, colour| (text.to_string(), at, colour);
        assert_eq!(names[0], of("mark", (1400, 800), RED));
        assert_eq!(names[1..], [of("low", (2100, 765), BLUE), of("high", (2000, 425), RED)]);
        assert_eq!(apart(&[0, 1000, 10], 100), [-45, 1000, 55]);
    }

    #[test]
    fn a_name_gives_way_to_lines_and_words() {
        let axis = || Axis::linear(0.0, 1.0, 0.5, 1, "");
        let sheet = Sheet::new(3000);
        let panel = sheet.panel(Frame::new(1000, 100, 4000, 3000), axis(), axis()).unwrap();
        panel.guide("line", &[(0.0, 0.5), (1.0, 0.5)], Stroke::solid(BLUE, 20)).unwrap();
        for text in ["one", "two"] {
            panel.label_nearby(text, (0.5, 0.5), (1, 0), RED).unwrap();
        }
        let drawing = sheet.finish("", Default::default()).drawing;
        let places = drawing.elements.iter().filter_map(|element| match element {
            Element::Label(Label { at, rim: true, .. }) => Some(*at),
            _ => None,
        });
        // On the line there is no room, above it for the first, and below it for the other.
        assert_eq!(places.collect::<Vec<_>>(), [(2600, 1450), (2600, 1650)]);
    }
}
